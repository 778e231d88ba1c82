#pragma once
/// Garments as files that a designer can edit (JSON). The fabric is not part of them.
///
///   {"format": "gambeson garment 1", "name": "shorts",
///    "patches": [{"degree": [2, 2],                  of u, of v
///                 "knots_u": [...], "knots_v": [...],
///                 "weft": [0, 0, 1],                 projected on the surface
///                 "points_m": [[x, y, z], ...],      u runs fastest
///                 "weights": [...]}],                optional: all 1
///    "seams": [{"a": {"patch": 0, "side": "u0", "reversed": false}, "b": {...},   reversed is optional
///               "kind": "G1",                        or "C0"
///               "stiffness_N": 0}]}                  rotational spring [N m/(m rad)], optional
/// Unknown keys are errors.

#include <filesystem>

#include "core/sheet/garment.hpp"

namespace gambeson {

/// Reads and validates (check.hpp); throws InputError with the file and the line or key.
Garment loadGarment(const std::filesystem::path& path);

/// Writes what loadGarment reads back to the bit. Throws RunError where the file cannot be written.
void writeGarment(const Garment& garment, const std::filesystem::path& path);

}  // namespace gambeson
