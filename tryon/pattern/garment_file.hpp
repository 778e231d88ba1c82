#pragma once
/// Garments as files that a designer can edit (JSON). The fabric is not part of them.
///
///   {"format": "gambeson garment 1", "name": "shorts",
///    "patches": [{"degree": [2, 2],                  of u, of v
///                 "knots_u": [...], "knots_v": [...],
///                 "weft": [0, 0, 1],                 projected on the surface
///                 "points_m": [[x, y, z], ...],      u runs fastest
///                 "name": "front",                   what tables call it, optional: patch_0, patch_1, ...
///                 "weights": [...],                  optional: all 1
///                 "placed_m": [[x, y, z], ...],      optional: where it starts, if not at rest
///                 "trim": {"loops": [[{"degree": 1, "knots": [...], "points": [[u, v], ...], "weights": [...]},
///                                     ...]],         closed chains of curves; clockwise: a hole
///                          "points_per_piece": 0, "unused_fraction": 0.01}}],   both optional (core/nurbs/trim.hpp)
///    "seams": [{"a": {"patch": 0, "side": "u0", "reversed": false}, "b": {...},   reversed is optional
///               "kind": "G1",                        or "C0"
///               "stiffness_N": 0,                    rotational spring [N m/(m rad)], optional
///               "first_cell": 3}],                   optional: the whole of a on a part of b, from this cell of b on
///    "edges": [{"name": "waist", "of": [{"patch": 0, "side": "v1"}, ...]}]}   what supports may name, optional
/// Unknown keys are errors.

#include <filesystem>

#include "core/cloth/draft/garment.hpp"

namespace gambeson {

/// Reads and validates (check.hpp); throws InputError with the file and the line or key.
Garment loadGarment(const std::filesystem::path& path);

/// Writes what loadGarment reads back to the bit. Throws RunError where the file cannot be written.
void writeGarment(const Garment& garment, const std::filesystem::path& path);

}  // namespace gambeson
