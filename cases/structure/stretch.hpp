#pragma once
/// How far a sheet is stretched along weft and warp against what its fabrics are meant for.

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "analysis/report/report.hpp"
#include "cases/structure/measure.hpp"

namespace gambeson {

/// Of all states of a path or of a motion that have a row. Lives no longer than the model and the mesh.
class StretchTally {
 public:
  StretchTally(const StructureCase& c, const StructureModel& model, const PlaceMesh& mesh);
  void add(const MeasuredState& state);
  /// One for each direction in which a fabric states a limit; the least where several do.
  std::vector<AuditCheck> checks() const;

 private:
  struct Along {
    std::optional<double> limit;  ///< Green-Lagrange strain
    std::string fabric;           ///< whose limit that is
    double most = 0;
  };
  std::array<Along, 2> along_;  ///< weft, warp
  const StructureModel& model_;
  const PlaceMesh& mesh_;
  std::unique_ptr<StressView> stress_;  ///< null where nothing is limited
};

}  // namespace gambeson
