#include "gpu/check_broad.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "gpu/scenes/stage_facts.hpp"

namespace gambeson::gpu {

namespace {

struct Named {
  const char* name;
  Broad broad;
};
constexpr Named kNamed[] = {{"lbvh", Broad::lbvh},
                            {"vss", Broad::vss},
                            {"vss-pieces", Broad::vssPieces},
                            {"otg", Broad::otg},
                            {"grid", Broad::grid}};

std::unique_ptr<ImpactSearch> searched(const Scene& scene, const SearchOptions& options, const BothSizes& room,
                                       bool cuda) {
  auto search =
      cuda ? searchOnCuda(scene.mesh, scene.x0, options, room) : searchOnReference(scene.mesh, scene.x0, options, room);
  search->setMotion(scene.x0, scene.x1);
  search->find(Trees::rebuilt);
  return search;
}

bool sameHits(const Facts& a, const Facts& b) {
  return a[0].hits_hash == b[0].hits_hash && a[1].hits_hash == b[1].hits_hash;
}

void printRow(const char* name, const Facts& facts, ImpactSearch& search, const BroadSettings& settings) {
  const BroadFacts broad = search.broadFacts();
  const auto million = [](auto n) { return 1e-6 * static_cast<double>(n); };
  const double whole = search.medianMilliseconds(Trees::rebuilt, settings.passes);
  const double alone = search.medianMilliseconds(Trees::rebuilt, settings.passes, Part::broad);
  fmt::print("  {:<10} {:>9.3f} {:>9.3f} {:>8.3f} {:>8.3f} {:>8.3f} {:>7.1f} {:>9.3f} {:>9.3f} {:>9} {:>9} {:016x}\n",
             name, million(broad.tests), million(broad.boxes_of_triangles), million(broad.pairs_of_triangles),
             million(broad.boxes_of_features), million(broad.registrations), million(broad.bytes), alone, whole,
             facts[0].sizes.pairs, facts[1].sizes.pairs, facts[0].pairs_hash + facts[1].pairs_hash);
  if (broad.registrations_of.size() > 1)
    fmt::print("             registrations by level: {}\n", fmt::join(broad.registrations_of, " "));
  if (search.repeats() > 0) fmt::print("             passes repeated for want of room: {}\n", search.repeats());
  if (!settings.stages) return;
  for (const auto& [stage, ms] : search.stageTimes(settings.passes)) fmt::print("    {:<24} {:.4f} ms\n", stage, ms);
}

int checkScene(const Scene& scene, Bounds bounds, const BroadSettings& settings) {
  SearchOptions options = scene.options;
  options.bounds = bounds;
  BothSizes room = roomFor(scene.mesh);
  int different = 0;
  const auto expect = [&](const char* what, bool same) {
    if (!same) fmt::print("  {} DIFFERENT\n", what);
    different += !same;
  };
  Facts truth;
  {
    const auto first = searched(scene, options, room, settings.cuda);
    truth = factsOf(*first);
    room = {truth[0].sizes, truth[1].sizes};
    if (bounds == Bounds::polytopes) {
      options.bounds = Bounds::boxes;
      expect("hits within boxes",
             sameHits(factsOf(*searched(scene, options, roomFor(scene.mesh), settings.cuda)), truth));
      options.bounds = bounds;
    }
  }
  for (const auto& [name, broad] : kNamed) {
    if (std::ranges::find(settings.names, name) == settings.names.end()) continue;
    options.broad = broad;
    const auto search = searched(scene, options, room, settings.cuda);
    const Facts facts = factsOf(*search);
    if (broad == Broad::vssPieces)
      expect("hits", sameHits(facts, truth));
    else
      expect("candidates and hits", facts == truth);
    printRow(name, facts, *search, settings);
    expect("once more", factsOf(*search) == facts);
    if (settings.cuda && settings.against_reference) {
      const auto reference = searched(scene, options, room, false);
      expect("the reference's candidates and hits", factsOf(*reference) == facts);
      expect("the reference's tests", reference->broadFacts().tests == search->broadFacts().tests);
      expect("the reference's boxes",
             reference->broadFacts().boxes_of_features == search->broadFacts().boxes_of_features);
    }
    std::fflush(stdout);
  }
  return different;
}

}  // namespace

std::vector<std::string> broadNames() {
  std::vector<std::string> names;
  for (const Named& n : kNamed) names.emplace_back(n.name);
  return names;
}

int checkBroad(std::span<const Scene> scenes, const BroadSettings& settings) {
  int different = 0;
  for (const Scene& scene : scenes)
    for (const Bounds bounds : {Bounds::boxes, Bounds::polytopes}) {
      fmt::print("{}: {} vertices, {} faces, {} edges; {}\n", scene.name, scene.mesh.vertices, scene.mesh.faces.size(),
                 scene.mesh.edges.size(), bounds == Bounds::boxes ? "boxes" : "polytopes of 18 faces");
      fmt::print(
          "             10^6 tests, of boxes of triangles, pairs, boxes of features, registrations; MB; ms of pairs, "
          "of a "
          "pass; candidates\n");
      different += checkScene(scene, bounds, settings);
    }
  return different;
}

}  // namespace gambeson::gpu
