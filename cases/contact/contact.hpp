#pragma once
/// What the cloth of a case touches beside itself and a human, and how.

#include <filesystem>
#include <optional>
#include <string>
#include <variant>

#include "cases/contact/drive.hpp"
#include "core/contact/response.hpp"
#include "core/math/vec.hpp"
#include "human/body/mesh_sequence.hpp"

namespace gambeson {

struct EllipsoidObstacle {
  Vec3 semi_axes_m, center_m;
};

/// Exact where rings and segments are 0; otherwise a mesh of `rings` bands from pole to pole and `segments` around (z
/// is the axis), 2 segments (rings - 1) triangles.
struct SphereObstacle {
  double radius_m = 0;
  Vec3 center_m;
  int rings = 0, segments = 0;
};

/// A square of edge size_m about `point`, seen from the side of its unit normal.
struct PlaneObstacle {
  Vec3 point_m;
  Vec3 normal{0, 0, 1};
  double size_m = 2;
};

/// A ring about `axis` (unit), as a mesh of rings x segments x 2 triangles.
struct TorusObstacle {
  double radius_m = 0, tube_m = 0;  ///< of the ring's middle line, and of the tube about it
  Vec3 center_m;
  Vec3 axis{0, 0, 1};
  int segments = 48, rings = 16;  ///< around the axis, around the tube
};

/// A mesh file, in metres times `scale`, moved by `position`.
struct MeshObstacle {
  std::filesystem::path file;
  double scale = 1;
  Vec3 position_m;
};

/// What the human of the case steps over, as a box across the way: its place, depth and height are the motion's.
struct HurdleObstacle {
  double width_m = 2;  ///< to both sides together
};

/// A body as snapshots of its surface.
struct SequenceObstacle : SequenceOptions {};

struct ObstacleCase {
  std::string name;  ///< also the segment that forces are counted under; unique
  std::variant<EllipsoidObstacle, SphereObstacle, PlaneObstacle, TorusObstacle, MeshObstacle, HurdleObstacle,
               SequenceObstacle>
      shape;
  Vec3 velocity_m_per_s;
  Drive drive;                          ///< beside that velocity
  std::optional<FrictionLaw> friction;  ///< with cloth, where it differs
};

struct ContactCase {
  std::optional<double> layer_m;              ///< of all cloth; the thickness of each fabric where absent
  bool self = true;                           ///< cloth touches cloth
  FrictionLaw friction = 0.3;                 ///< between cloth and bodies
  std::optional<FrictionLaw> friction_cloth;  ///< between cloth and cloth, where it differs
  double relaxation_s = 0.01;                 ///< tau in k = 1 - exp(-dt/tau) of the separation correction
  double compliance_m_per_Pa = 1e-9;
  double tolerance = 1e-3;  ///< residual of the contacts of a step, of g dt
  int max_iterations = 8000;
  ContactMethod method = ContactMethod::together;
  double penalty_Pa_per_m = 0;  ///< of ContactMethod::penalty
  bool newton = false;          ///< ContactParameters::newton
};

/// "Coulomb friction 0.3, the same for sticking and sliding".
std::string inWords(const FrictionLaw& law);

/// What a run with a method of contact of its own assumes; empty where all contacts are solved together.
std::string inWords(const ContactCase& contact);

/// `gravity_m_per_s2`: what a tolerance is a part of; 0: that of the earth. `obstacles`: those of the case, which come
/// behind `bodies` others (of the human) in the list of obstacles.
ContactParameters contactOf(const ContactCase& c, double gravity_m_per_s2, std::span<const ObstacleCase> obstacles,
                            std::size_t bodies);

}  // namespace gambeson
