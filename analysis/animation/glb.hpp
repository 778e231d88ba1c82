#pragma once
/// An animated scene as one binary glTF 2.0 file (.glb), with KHR_mesh_quantization.
///
/// The root turns our axes (z up, x forward) into those of glTF (y up, z forward); below it everything is in ours.
/// Fixed and skinned meshes have single precision, and normals. A mesh whose vertices move has one morph target for
/// each time after the first, and weights that change linearly from one to the next. Its positions are whole numbers of
/// 16 bits times a quantum q, about an origin that follows the middle of its bounding box: the node's scale is q, the
/// node's translation the origin. Rounded are the positions, not the displacements, so that errors do not add:
///   |x - x_file| <= sqrt(3) q / 2,  q = largest coordinate about the origin, or change of it since the first time /
///   32766.
/// Vertex colours are linear, 16 bits.

#include <string>

#include "analysis/animation/scene.hpp"

namespace gambeson {

struct Glb {
  std::string bytes;
  double error_m = 0;  ///< largest distance of a moving mesh's vertex from where it was, at any of the times
};

/// Times count from the first one. Throws RunError where the file would be larger than the format can say (4 GiB), and
/// std::logic_error for a scene that does not fit together.
Glb encodeGlb(const AnimatedScene& scene);

/// How large a .glb becomes with the number F of its times [bytes]: of_time F + of_pair F (F - 1) + the rest. Of each
/// time there are 28 bytes of a node that moves, 8 of a vertex that moves by itself; of each pair 4 of such a mesh,
/// whose morph targets have a weight each at every time.
struct GlbSize {
  double rest = 0, of_time = 0, of_pair = 0;
  double bytes(std::size_t times) const;
  /// The most times of a file of at most so many bytes; 0 where there is none.
  std::size_t most(double bytes) const;
};

/// From a scene of a few times, the first and the last among them: within 1 % of what encodeGlb makes of all.
GlbSize glbSize(const AnimatedScene& few);

}  // namespace gambeson
