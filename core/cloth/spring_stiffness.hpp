#pragma once
/// The stiffness of a spring between two points, on free points.

#include <array>

#include "core/cloth/free_map.hpp"
#include "core/material/laws/spring.hpp"
#include "core/math/block_matrix.hpp"

namespace gambeson {

/// K += Tᵀ S T with S = +-(along u uᵀ + across (1 - u uᵀ)) of a spring from corner[0] to corner[1], `way` = x1 - x0
/// [m]. `definite`: a slope across below 0, of a pressed spring, counts as 0. The pair is in the sparsity of K.
void addSpringStiffness(const FreeMap& map, const std::array<int, 2>& corner, const Vec3& way,
                        const SpringAnswer<double>& answer, bool definite, BlockMatrix& K);

}  // namespace gambeson
