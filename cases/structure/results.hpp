#pragma once
/// What a run of a structure leaves: path.csv, shape.csv, frames, pictures, summary.json, report.html.

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "analysis/report/report.hpp"
#include "cases/structure/measure.hpp"
#include "core/io/recording.hpp"
#include "core/motion/motion_audit.hpp"

namespace gambeson {

/// Of path.csv where the sheet touches something: work of contact on it since the start.
constexpr const char* contact_work_column = "contact_work_J";

/// path.csv as it grows.
struct PathTable {
  std::vector<std::string> columns;
  std::vector<std::vector<double>> rows;
  /// One value per row; empty where there is no such column.
  std::vector<double> column(const std::string& name) const;
};

/// What contacts came to, over the run.
struct ContactFacts {
  long unsolved = 0;     ///< steps whose contacts were not solved within the tolerance
  long pinched = 0;      ///< steps that let something pass, because no step was short enough
  double deepest_m = 0;  ///< of a sample inside an obstacle
  int crossings = 0;     ///< where the sheet passes through itself or a mesh in the last step
  double work_J = 0;     ///< on the sheet
};

/// What the run knows of itself.
struct StructureFacts {
  bool finished = false;
  std::string why;  ///< else
  long points = 0, factorisations = 0, iterations = 0;
  int jumps = 0;  ///< of load steps over limit points; of arc length: where the path bent too much for the arcs
  std::vector<double> limit_points, bifurcations, jumped_at;  ///< of arc length: the factors of the points after them
  double rounded = 0;  ///< largest relative residual of points that rounding kept above the tolerance; 0: none
  long projections = 0, limits_missed = 0;  ///< of strain limits, and steps that did not reach the tolerance
  double limit_residual = 0;                ///< the largest after a step
  double wall_s = 0, build_s = 0, solve_s = 0;
  int threads = 1;
  std::optional<MotionAudit> audit;
  std::optional<ContactFacts> contact;
  /// Of a sheet whose law is an energy at a point: of the recorded state with the most points beyond what it knows;
  /// where the path ends since points find no answer, of the last state tried.
  LawRange law_range;
  long unanswered_tries = 0;  ///< states that were tried and given up since points found no answer
};

struct ModeRow {
  double omega_rad_per_s = 0, residual = 0, rounding = 0;
};

/// Frame number `index` (frames count up, factors of a path need not).
Frame frameOf(const MeshShape& shape, int index, double at);

/// All obstacles as one surface, for frames and pictures: its triangles, and its vertices at a time.
std::vector<std::array<int, 3>> obstacleTriangles(const StructureModel& model);
std::vector<Vec3> obstacleVertices(const StructureModel& model, double time_s);

/// The load factor, time or mode of a frame.
double frameValue(const Frame& frame);

/// shape.csv: patch, u, v (fractions), rest X_m ... and current x_m ... of the mesh.
void writeShapeTable(const PlaceMesh& mesh, const MeshShape& shape, const std::filesystem::path& csv);

/// summary.json; all but "timings" is decided by the case alone.
void writeStructureSummary(const StructureCase& c, const StructureModel& model, const PathTable& path,
                           const std::vector<ModeRow>& modes, const MeasuredState& last, const PlaceMesh& mesh,
                           const MeshShape& shape, const StructureFacts& facts, const std::vector<AuditCheck>& checks,
                           const std::filesystem::path& json);

/// A picture of a frame, colours from 0 to the largest value of the frame.
void renderStructure(const StructureCase& c, const RecordingLayout& layout, const Frame& frame,
                     const StructurePicture& picture, const std::filesystem::path& png);

/// The page, from the files in a results folder. `pictures` with captions.
void writeStructurePage(const StructureCase& c, const std::filesystem::path& results,
                        const std::vector<Picture>& pictures, const std::filesystem::path& html);

/// The pictures that the case asks for, of the frames of a folder; one that fails leaves its reason.
std::vector<Picture> takeStructurePictures(const StructureCase& c, const std::filesystem::path& results,
                                           const std::filesystem::path& folder, std::vector<std::string>& failures);

}  // namespace gambeson
