#pragma once
/// What a run of a structure writes of each state: named points and edges, energies, whole shapes.

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "cases/structure/build.hpp"

namespace gambeson {

/// A state as measured: of small displacements (a linear static case, a mode) or of any.
struct MeasuredState {
  double at = 0;                    ///< factor, time or number of the mode
  std::vector<Vec3> q;              ///< control points; of small displacements: rest + displacements
  std::vector<Vec3> velocity;       ///< of control points; empty where there is none
  std::vector<Vec3> reaction_N;     ///< on the free points: what supports push with
  std::vector<Vec3> turning_Nm;     ///< on the directors: what supports turn them with; empty: there are none
  std::vector<Vec2> limit_N_per_m;  ///< field of limitStress where strain is limited; else empty
  std::vector<double> history;      ///< committed there, of a static path; else empty
  double strain_energy_J = 0;
  bool small = false;  ///< strains and forces are those of the linearised sheet
};

/// Measures a point of a static path. `linear`: forces, energy and stress are linear in the displacements.
/// `history`: committed there.
MeasuredState measureStatic(const Structure& s, std::span<const double> y, double factor, bool linear,
                            std::span<const double> history = {});
/// `step_s`: of the last step, over which the motion of supports is differentiated as the solver does; 0: none yet.
/// Reactions are without contact: where the sheet touches, what supports push with is known of a step only
/// (StepResult::held_impulses).
MeasuredState measureDynamic(const StructureModel& model, const State& state, bool lumped_mass, double step_s);
/// The shape of a mode, its largest displacement `amplitude_m`.
MeasuredState measureMode(const Structure& s, std::span<const double> y, double factor, std::span<const double> shape,
                          double amplitude_m);

/// Resultants and strains of a state (core/cloth/stress.hpp); of small displacements by their derivative at
/// rest. Lives no longer than the model.
class StressState {
 public:
  /// `everywhere`: the means of all cells are taken at once, for many places.
  StressState(const StructureModel& model, const MeasuredState& state, bool everywhere);
  PrincipalStress at(int patch, Vec2 uv) const;

 private:
  StressView::More more() const;

  const StructureModel& model_;
  std::vector<StressView::Sample> means_;
  std::vector<Vec3> q_;
  std::vector<double> history_;
  std::vector<Vec2> limit_;
  double part_ = 1;  ///< of the displacements, in q_
};

/// Named points and edges of the case.
class Probes {
 public:
  Probes(const StructureCase& c, const StructureModel& model, const StructureOptions& options);
  /// Modal: displacements alone. Of a point: NAME_ux_m, _uy_m, _uz_m, (dynamic: _vx_m_per_s ...), _n1_N_per_m,
  /// _n2_N_per_m, _e1, _e2, _rx_N ... (of a support at the point alone, with what is tied to it). Of an edge: mean
  /// displacement NAME_ux_m ..., reaction NAME_rx_N ..., and its moment about the mean of the edge's points now
  /// NAME_mx_Nm ....
  const std::vector<std::string>& columns() const { return columns_; }
  std::vector<double> values(const MeasuredState& state) const;

 private:
  struct PointProbe {
    int patch = 0;
    Vec2 uv;
    std::vector<std::pair<int, double>> control;  ///< points and their parts of the place
    std::vector<int> free;                        ///< whose reactions count
  };
  struct EdgeProbe {
    std::vector<double> weight;  ///< of control points, sum 1: mean along the edge at rest
    std::vector<int> free;       ///< whose reactions count
    std::set<int> directors;     ///< whose moments count
  };
  const StructureModel* model_;
  const Structure* structure_;
  bool with_velocity_ = false, displacements_only_ = false;
  std::vector<PointProbe> points_;
  std::vector<EdgeProbe> edges_;
  std::vector<std::string> columns_;
};

/// Values at the points of a mesh.
struct MeshShape {
  std::vector<Vec3> rest, x, normal;
  std::vector<PrincipalStress> stress;
};
MeshShape shapeOf(const StructureModel& model, const PlaceMesh& mesh, const MeasuredState& state);

}  // namespace gambeson
