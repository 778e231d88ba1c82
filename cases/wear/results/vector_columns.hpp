#pragma once
/// Three columns of a recorded table that are one vector.

#include <string>

#include "core/io/recorded_table.hpp"
#include "core/math/vec.hpp"

namespace gambeson {

/// The vector whose parts are the columns `before` x `after`, y and z: "pelvis_J" and "_Ns", say. The table must live
/// on.
class VectorColumns {
 public:
  VectorColumns(const RecordedTable& table, const std::string& before, const std::string& after)
      : x_(table.column(before + "x" + after)),
        y_(table.column(before + "y" + after)),
        z_(table.column(before + "z" + after)) {}
  Vec3 operator[](std::size_t row) const { return {x_[row], y_[row], z_[row]}; }

 private:
  const std::vector<double>&x_, &y_, &z_;
};

}  // namespace gambeson
