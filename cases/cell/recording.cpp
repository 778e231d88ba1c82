#include "cases/cell/recording.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cases/runs/frame_field.hpp"
#include "cases/runs/recorded_case.hpp"
#include "cases/runs/run_identity.hpp"
#include "core/error.hpp"
#include "core/math/instruction_sets.hpp"

namespace gambeson {
namespace {

constexpr const char* kTable = "curves";
constexpr const char *kMembrane = "membrane_N_per_m", *kBending = "bending_Nm", *kReached = "reached", *kWhy = "why",
                     *kFrames = "frames";

/// Columns of the table before those of curves.csv.
constexpr const char* kPath = "path";

std::vector<std::int64_t> bytesOf(const std::string& text) { return {text.begin(), text.end()}; }

RecordingLayout layoutOf(const CellCase& c, const CellEngine& engine) {
  RecordingLayout layout;
  layout.identity = RunIdentity(caseIdentity(c), widestInstructionSet(), DeviceKind::cpu).text();
  layout.metadata = writeCase(c);
  layout.triangles = engine.surface().triangles;
  layout.tables[kTable] = curveColumns(c);
  layout.tables[kTable].insert(layout.tables[kTable].begin(), kPath);
  return layout;
}

RecordingLayout layoutIn(const std::filesystem::path& results) {
  RecordingLayout layout = readLayout(results);
  requireRecordedCase(results, layout);
  return layout;
}

template <class T>
std::vector<T> valuesOf(const std::map<std::string, std::vector<T>>& from, const std::string& name) {
  const auto at = from.find(name);
  return at == from.end() ? std::vector<T>{} : at->second;
}

std::string textOf(const Checkpoint& checkpoint) {
  std::string text;
  for (const std::int64_t byte : valuesOf(checkpoint.integers, kWhy)) text += static_cast<char>(byte);
  return text;
}

template <std::size_t n>
std::optional<std::array<double, n>> arrayOf(const Checkpoint& checkpoint, const std::string& name) {
  const std::vector<double> values = valuesOf(checkpoint.reals, name);
  if (values.size() != n) return {};
  std::array<double, n> out{};
  std::copy(values.begin(), values.end(), out.begin());
  return out;
}

}  // namespace

std::vector<std::string> curveColumns(const CellCase& c) {
  std::vector<std::string> columns{"part",
                                   "e11",
                                   "e22",
                                   "e12",
                                   "curvature_per_m",
                                   "n11_N_per_m",
                                   "n22_N_per_m",
                                   "n12_N_per_m",
                                   "moment_N",
                                   "s11_GPa",
                                   "s22_GPa",
                                   "s12_GPa",
                                   "energy_J_per_m2",
                                   "lost_J_per_m2",
                                   "tension_weft_N",
                                   "tension_warp_N",
                                   "stable",
                                   "iterations",
                                   "residual",
                                   "rounded"};
  if (c.yarns == YarnModel::solid)
    columns.insert(columns.end(), {"mean_s11_GPa", "mean_s22_GPa", "mean_s12_GPa", "passed_m"});
  return columns;
}

CellRecorder::CellRecorder(const CellCase& c, const CellEngine& engine, const std::filesystem::path& out, bool resume)
    : c_(c), engine_(engine) {
  const RecordingLayout layout = layoutOf(c, engine);
  if (!resume) {
    writer_.emplace(RecordingWriter::create(out, layout));
    return;
  }
  Checkpoint last;
  writer_.emplace(RecordingWriter::resume(out, layout, last));
  units_ = closedSegments(out);
  const std::vector<std::int64_t> counts = valuesOf(last.integers, kFrames);
  if (counts.size() != 2) throw InputError({out.string(), 0, ""}, "the recording there is not of a cell");
  frames_ = static_cast<int>(counts[0]);
  rows_ = static_cast<int>(counts[1]);
}

void CellRecorder::keep(const YarnShape& shape, double row) {
  Frame frame;
  frame.time_s = frames_++;
  std::vector<float> stress, direction, rows;
  for (std::size_t i = 0; i < shape.vertices.size(); ++i) {
    for (int k = 0; k < 3; ++k) frame.positions.push_back(static_cast<float>(shape.vertices[i][k]));
    stress.push_back(static_cast<float>(shape.stress_Pa[i]));
    direction.push_back(engine_.surface().direction[i]);
    rows.push_back(static_cast<float>(row));
  }
  frame.sample_fields.push_back({"stress", "Pa", 1, std::move(stress)});
  frame.sample_fields.push_back({"direction", "", 1, std::move(direction)});
  frame.sample_fields.push_back({"row", "", 1, std::move(rows)});
  if (!shape.pressure_Pa.empty())
    frame.sample_fields.push_back({"pressure", "Pa", 1, {shape.pressure_Pa.begin(), shape.pressure_Pa.end()}});
  writer_->append(std::move(frame));
}

void CellRecorder::close(const std::map<std::string, std::vector<double>>& reals,
                         const std::map<std::string, std::vector<std::int64_t>>& integers) {
  Checkpoint checkpoint;
  checkpoint.time_s = frames_ - 1;
  checkpoint.reals = reals;
  checkpoint.integers = integers;
  checkpoint.integers[kFrames] = {frames_, rows_};
  writer_->closeSegment(checkpoint);
  ++units_;
}

void CellRecorder::add(const RestStiffness& rest) {
  keep(engine_.specimen()->shape(), -1);
  std::map<std::string, std::vector<double>> reals;
  if (rest.membrane_N_per_m) reals[kMembrane] = {rest.membrane_N_per_m->begin(), rest.membrane_N_per_m->end()};
  if (rest.bending_Nm) reals[kBending] = {rest.bending_Nm->begin(), rest.bending_Nm->end()};
  close(reals, {{kWhy, bytesOf(rest.why)}});
}

void CellRecorder::add(const WalkedPath& path) {
  for (const WalkedRow& row : path.rows) {
    const BalancedCell& p = row.point;
    const CellResultants& n = p.resultants;
    const double to_GPa = 1e-9 / *c_.height_m;
    std::vector<double> values{static_cast<double>(units_),
                               row.part,
                               p.load.e11,
                               p.load.e22,
                               0.5 * p.load.g12,
                               p.load.curvature_per_m,
                               n.n11,
                               n.n22,
                               n.n12,
                               n.moment_N,
                               to_GPa * n.n11,
                               to_GPa * n.n22,
                               to_GPa * n.n12,
                               n.energy_J_per_m2,
                               p.lost_J_per_m2,
                               p.tension_N[along_weft],
                               p.tension_N[along_warp],
                               p.stable ? 1. : 0.,
                               static_cast<double>(p.iterations),
                               p.residual,
                               p.rounded ? 1. : 0.};
    if (c_.yarns == YarnModel::solid) {
      for (const double s : p.mean_stress_Pa) values.push_back(1e-9 * s);
      values.push_back(p.passed_m);
    }
    writer_->append(TableRow{kTable, std::move(values)});
    if (row.shape) keep(*row.shape, rows_);
    ++rows_;
  }
  close({}, {{kReached, {path.reached ? 1 : 0}}, {kWhy, bytesOf(path.why)}});
}

RecordedCell::RecordedCell(const std::filesystem::path& results)
    : c_((layoutIn(results), readRecordedCellCase(caseFile(results)))),
      reader_(results),
      curves_(reader_.table(kTable)) {
  const Checkpoint rest = reader_.checkpoint(0);
  rest_ = {arrayOf<9>(rest, kMembrane), arrayOf<3>(rest, kBending), textOf(rest)};
  const int walked = std::min(reader_.checkpointCount() - 1, static_cast<int>(c_.paths.size()));
  const std::vector<double>& path_of = curves_.column(kPath);
  std::int64_t frames = 1;  // of the units before
  for (int k = 1; k <= walked; ++k) {
    const Checkpoint end = reader_.checkpoint(k);
    const std::vector<std::int64_t> reached = valuesOf(end.integers, kReached),
                                    counts = valuesOf(end.integers, kFrames);
    if (reached.size() != 1 || counts.size() != 2)
      throw InputError({results.string(), 0, ""}, "the recording there is not of a cell");
    RecordedPath& path = paths_.emplace_back(RecordedPath{
        curves_.where([&](std::size_t row) { return path_of[row] == k; }), reached[0] != 0, textOf(end), {}});
    if (counts[0] > frames) path.last_frame = static_cast<int>(counts[0]) - 1;
    frames = counts[0];
  }
}

bool RecordedCell::whole() const {
  return paths_.size() == c_.paths.size() &&
         std::all_of(paths_.begin(), paths_.end(), [](const RecordedPath& p) { return p.reached; });
}

CellLoad RecordedCell::loadOf(const Frame& frame) const {
  const Field& rows = fieldOf(frame, "row");
  const double row = rows.data.empty() ? -1 : rows.data[0];
  if (row < 0) return {};
  if (!(row < static_cast<double>(curves_.rows())))
    throw RunError("a shape of the recording is of no row of its table");
  const auto at = static_cast<std::size_t>(row);
  CellLoad load{curves_.column("e11")[at], curves_.column("e22")[at], 2 * curves_.column("e12")[at],
                curves_.column("curvature_per_m")[at], 0};
  const auto path = static_cast<std::size_t>(curves_.column(kPath)[at]);
  if (path < 1 || path > c_.paths.size()) throw RunError("a row of the recording is of no load of its case");
  load.direction_rad = targetOf(c_.paths[path - 1].load, 1).load.direction_rad;
  return load;
}

}  // namespace gambeson
