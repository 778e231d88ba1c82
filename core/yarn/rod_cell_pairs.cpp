/// RodCell: which pairs of sections touch, and where.

#include "core/yarn/line_contact.hpp"
#include "core/yarn/rod_cell.hpp"

namespace gambeson {

RodCell::PairPlace RodCell::pairAt(const CellFaces& faces, std::span<const Pose> sections, int pair) const {
  const Pair& p = pairs_[pair];
  const Pose first = place(faces, sections, p.first).pose, second = place(faces, sections, p.second).pose;
  if (p.above == 0) return {first, second, p.lengths_m2, 0, {}};
  const Vec3 apart = first.origin - second.origin;
  double normal = 0;
  if (design_.touch == RodTouch::section)
    normal = p.lengths_m2 * crossing_.evaluate(first, second, p.above, false).pressing;
  else if (norm2(apart) < touch_m_ * touch_m_)
    normal = -p.lengths_m2 * lineContact(design_.compression, touch_m_, norm(apart)).first;
  return {first, second, p.lengths_m2, normal, crossing_.meeting_m(first, second)};
}

/// Whether the middles of a pair are farther apart than those of any pair that touches, and seen with less trouble.
bool RodCell::isFar(const CellFaces& faces, std::span<const Pose> sections, const Pair& pair, double part) const {
  const Vec3 apart = originOf(faces, sections, pair.first) - originOf(faces, sections, pair.second);
  const double reach = (1 + part) * (pair.above == 0 ? beside_[pair.first.direction].reach_m() : crossing_reach_m_);
  return norm2(apart) > reach * reach;
}

/// Whether a pair touches when its points are nearer by a part of their distance.
bool RodCell::touches(const Pair& pair, const Pose& first, const Pose& second, double part) const {
  if (design_.touch == RodTouch::axis) {
    const double reach = touch_m_ * (1 + part);
    return norm2(first.origin - second.origin) < reach * reach;
  }
  if (pair.above != 0) return crossing_.distance_m(first, second, pair.above) < touch_m_ * (1 + part);
  const BesideContact& beside = beside_[pair.first.direction];
  return beside.distance(first, second) < 1 + part;
}

SectionPair RodCell::evaluateSections(const Pair& pair, const Pose& first, const Pose& second, bool tangent) const {
  return pair.above != 0 ? crossing_.evaluate(first, second, pair.above, tangent)
                         : beside_[pair.first.direction].evaluate(first, second, tangent);
}

std::vector<int> RodCell::nearPairs(const CellFaces& faces, std::span<const Pose> sections, double part) const {
  std::vector<int> near;
  for (std::size_t k = 0; k < pairs_.size(); ++k) {
    const Pair& pair = pairs_[k];
    if (isFar(faces, sections, pair, part)) continue;
    if (touches(pair, place(faces, sections, pair.first).pose, place(faces, sections, pair.second).pose, part))
      near.push_back(static_cast<int>(k));
  }
  return near;
}

}  // namespace gambeson
