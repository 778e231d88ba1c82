#pragma once
/// What bent cloth remembers, as pictures and tables show it: the curvature that is set in it, and how much of its
/// friction is left.

#include <span>
#include <string>
#include <vector>

#include "core/motion/model.hpp"

namespace gambeson {

/// At the samples. Of cloth that remembers neither: no set, and all of its friction.
struct ClothMemory {
  std::vector<double> set_per_m;      ///< norm of the tensor of curvature without moment, sqrt(k11^2 + k22^2 + 2 k12^2)
  std::vector<double> friction_left;  ///< phi, 1 of new cloth
};

/// Reads the history of the laws with friction in bending (FrictionInBending). Constant after it is made; lives no
/// longer than the model.
class ClothMemoryView {
 public:
  explicit ClothMemoryView(const Model& model);

  /// Whether any of the cloth has such a law.
  bool any() const { return any_; }
  /// Each sample has the mean of the nearest points of its patch that remember; a vertex of those in the triangles
  /// about it.
  ClothMemory at(std::span<const double> history) const;

  /// Columns of the table "memory" behind start_s and end_s: of each patch the mean of the set over its area, the
  /// largest, the mean of the friction left, and the least.
  static constexpr std::size_t kColumns = 4;
  static std::vector<std::string> columns(const std::vector<std::string>& patch_names);
  std::vector<double> row(std::span<const double> history, int patches) const;

 private:
  static constexpr int kNearest = 4;
  enum class Kind { none, apart, tensor };
  struct Point {
    std::size_t first = 0, stride = 1;
    Kind kind = Kind::none;
    int line = 0;  ///< numbers of each of its lines
  };
  const Model& model_;
  bool any_ = false;
  std::vector<Point> points_;
  std::vector<std::vector<int>> near_;  ///< of each sample, indices in points_
};

}  // namespace gambeson
