#pragma once
/// From the triangles of a scan to one closed surface.

#include <string>
#include <vector>

#include "core/contact/obstacle.hpp"

namespace gambeson {

/// What was found and mended, for the user.
struct RepairReport {
  std::vector<std::string> notes;
};

/// The largest part of the mesh (by area), its vertices at one place (within 1/200,000 of the mesh's size) made one,
/// triangles without area or said twice left out, oriented outward, and holes whose rim is at most `close_share` of its
/// height long (flat ones twice that) closed by a fan about the rim's mean. Parts of less than a hundredth of the body's area are left out.
/// Throws InputError with `file`, the place in the file's own coordinates and a way out: edges of more than two
/// triangles, surfaces that have but one side, two bodies, holes that are longer.
TriangleMesh repaired(const TriangleMesh& raw, double close_share, const std::string& file, RepairReport& report);

/// Handles of a closed surface: 0 of a body whose limbs touch nothing, one more for each loop that a limb closes.
int handlesOf(const TriangleMesh& mesh);

}  // namespace gambeson
