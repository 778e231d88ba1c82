#include "human/skin_part.hpp"

namespace gambeson {
namespace {

/// Rows of a list, first[v] to first[v + 1].
template <class T>
void takeRows(std::span<const int> vertices, const std::vector<int>& first, const std::vector<int>& index,
              const std::vector<T>& value, std::vector<int>& part_first, std::vector<int>& part_index,
              std::vector<T>& part_value) {
  if (first.empty()) return;
  part_first = {0};
  for (const int v : vertices) {
    part_index.insert(part_index.end(), index.begin() + first[v], index.begin() + first[v + 1]);
    part_value.insert(part_value.end(), value.begin() + first[v], value.begin() + first[v + 1]);
    part_first.push_back(static_cast<int>(part_index.size()));
  }
}

}  // namespace

Skin skinPart(const Skin& skin, std::span<const int> vertices) {
  Skin part;
  part.bind = skin.bind;
  part.bends = skin.bends;
  part.crease_gap_m = skin.crease_gap_m;
  std::vector<int> at(skin.rest.vertices.size(), -1);
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    at[static_cast<std::size_t>(vertices[i])] = static_cast<int>(i);
    part.rest.vertices.push_back(skin.rest.vertices[static_cast<std::size_t>(vertices[i])]);
    part.segment.push_back(skin.segment[static_cast<std::size_t>(vertices[i])]);
  }
  takeRows(vertices, skin.first, skin.link, skin.weight, part.first, part.link, part.weight);
  takeRows(vertices, skin.bend_first, skin.bend, skin.share, part.bend_first, part.bend, part.share);
  for (const SkinCrease& crease : skin.creases) {
    SkinCrease own;
    own.bend = crease.bend;
    for (std::size_t i = 0; i < crease.vertex.size(); ++i) {
      const int to = at[static_cast<std::size_t>(crease.vertex[i])];
      if (to < 0) continue;
      own.vertex.push_back(to);
      own.side.push_back(crease.side[i]);
      own.strength.push_back(crease.strength[i]);
    }
    part.creases.push_back(std::move(own));
  }
  return part;
}

}  // namespace gambeson
