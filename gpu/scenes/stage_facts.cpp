#include "gpu/scenes/stage_facts.hpp"

#include <fmt/format.h>

#include "gpu/finding/hash.hpp"

namespace gambeson::gpu {

Facts factsOf(ImpactSearch& search) {
  const BothSizes sizes = search.sizes();
  Facts facts;
  for (int k = 0; k < kPairKinds; ++k) {
    const PairKind kind{k};
    facts[k] = {sizes[k], hashOf(std::span<const Pair>(search.pairs(kind))),
                hashOf(std::span<const Hit>(search.hits(kind)))};
  }
  return facts;
}

std::string print(const Facts& facts) {
  std::string text;
  for (int k = 0; k < kPairKinds; ++k) {
    const auto& [sizes, pairs, hits] = facts[k];
    text += fmt::format("  {}: {} pairs {:016x}, {} open, {} hard, {} hits {:016x}\n", k == 0 ? "points" : "edges ",
                        sizes.pairs, pairs, sizes.open, sizes.hard, sizes.hits, hits);
  }
  return text;
}

std::vector<Scene> manifestScenes() {
  std::vector<Scene> scenes;
  scenes.push_back(flyingBalls(40));
  scenes.push_back(wavySheets(3, 30));
  scenes.push_back(fallingSheets(24));
  return scenes;
}

BothSizes roomFor(const Mesh& mesh) {
  const auto vertices = static_cast<unsigned long long>(mesh.vertices);
  const ListSizes points{96 * vertices + 1024, 16 * vertices + 1024, 4 * vertices + 1024, 4 * vertices + 1024};
  return {points, {2 * points.pairs, 3 * points.open, 3 * points.hard, 3 * points.hits}};
}

}  // namespace gambeson::gpu
