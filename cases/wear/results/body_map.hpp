#pragma once
/// The pressure on the body itself, place by place: of a skin its vertices, of other bodies the vertices of meshes laid
/// on their shapes. Places are material: they move with the body, so that what they bear can be followed over time.

#include <optional>

#include "cases/wear/scene/scenario.hpp"
#include "core/contact/mesh_surface.hpp"
#include "core/io/recording.hpp"

namespace gambeson {

/// What a sensor of this width would show: at each vertex the normal force over the area of all vertices within half
/// the width (along straight lines, facing the same way, on the same shape, at rest). Areas are those of the body now;
/// a sample's force goes to the corners of the triangle at its foot by their weights there, as the triangle's area goes
/// to its corners, so that an even pressure is shown as it is.
class BodyMap {
 public:
  static constexpr double kCell_m = 0.012;  ///< edges of meshes laid on shapes, at most, up to 100,000 triangles

  /// Of the human's body alone; the scenario has one.
  BodyMap(const Scenario& scenario, double sensor_m);

  std::size_t size() const { return zone_.size(); }
  const std::vector<int>& zone() const { return zone_; }        ///< of each vertex, index in zoneNames
  const std::vector<double>& area_m2() const { return area_; }  ///< at rest
  /// Of each vertex, in the frame's window [Pa].
  std::vector<double> pressure(const Frame& frame) const;

  /// Its surfaces as they are at rest: a mesh for each shape, in the shape's frame, or the skin.
  struct Surface {
    int obstacle = 0, first = 0;  ///< first of its vertices, of all
    const TriangleMesh* mesh = nullptr;
  };
  std::vector<Surface> surfaces() const;

  /// The body's surfaces at a time: one per shape, or the skin; the vertices of all of them are numbered through.
  std::vector<TriangleMesh> meshes(double time_s) const;

 private:
  struct Part {
    int obstacle = 0, first = 0;
    TriangleMesh mesh;                   ///< in the body's frame, or the skin at rest
    std::optional<MeshSurface> surface;  ///< of it; not of a skin
  };

  const Scenario& scenario_;
  std::vector<Part> parts_;
  std::vector<int> zone_;
  std::vector<double> area_;
  std::vector<int> first_, near_;  ///< vertices around each, itself among them
};

/// What each place of the body bears over the motion.
struct BodyLoads {
  std::vector<double> peak_Pa, peak_time_s, mean_Pa;  ///< of each vertex; means from `from_s` on
  /// Of each zone [frame][index in zoneNames], in the frames from `from_s` on [Pa]: the largest of its vertices then,
  /// and the largest mean over time of one vertex, had the motion ended there.
  std::vector<std::vector<double>> largest_Pa, mean_so_far_Pa;
  std::vector<double> time_s;  ///< of these frames
};
BodyLoads bodyLoads(const BodyMap& map, const RecordingReader& recording, double from_s);

}  // namespace gambeson
