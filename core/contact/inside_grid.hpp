#pragma once
/// Inside or outside of a closed surface by look-up, for points that are not close to it.

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "core/contact/box.hpp"

namespace gambeson {

/// Cells that no triangle comes into form connected parts that the surface does not cross, so one exact answer
/// serves a part. Cells that a triangle's box and plane both touch stay undecided. Valid for the positions that it
/// was built from.
class InsideGrid {
 public:
  enum class Cube : unsigned char { undecided, outside, inside };

  InsideGrid() = default;
  /// `triangles` are the surface; is_inside answers for one point of each part. Cells are cubes, `resolution` of them
  /// along the longest side of the bounds.
  InsideGrid(std::span<const std::array<Vec3, 3>> triangles, const std::function<bool(const Vec3&)>& is_inside,
             int resolution);

  Cube at(const Vec3& p) const {
    if (cells_.empty()) return Cube::undecided;
    int index[3];
    for (int i = 0; i < 3; ++i) {
      const double t = (p[i] - origin_[i]) * per_cell_;
      if (!(t >= 0 && t < size_[i])) return Cube::undecided;
      index[i] = static_cast<int>(t);
    }
    return cells_[(static_cast<std::size_t>(index[2]) * size_[1] + index[1]) * size_[0] + index[0]];
  }

 private:
  Vec3 origin_;
  double per_cell_ = 0;
  int size_[3] = {0, 0, 0};
  std::vector<Cube> cells_;
};

}  // namespace gambeson
