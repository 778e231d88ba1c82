/// Detail of measure.hpp: what the cloth bears away from its borders, how it is bent, and what its straps carry: from
/// the frames.

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "analysis/sheet_cells.hpp"
#include "analysis/turning.hpp"
#include "cases/wear/recording/recorder.hpp"
#include "cases/wear/results/measure.hpp"
#include "cases/wear/results/vector_columns.hpp"
#include "cases/wear/results/write.hpp"
#include "core/error.hpp"
#include "core/io/csv.hpp"
#include "core/math/carried_error.hpp"
#include "core/math/parallel.hpp"
#include "tryon/strap_cut.hpp"

namespace gambeson {

std::vector<Vec3> vectorsOf(const std::vector<float>& v) {
  std::vector<Vec3> out(v.size() / 3);
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = {v[3 * i], v[3 * i + 1], v[3 * i + 2]};
  return out;
}

std::vector<Vec3> controlsOf(const Frame& frame) {
  for (const Field& f : frame.control_fields)
    if (f.name == "position") return vectorsOf(f.data);
  throw RunError("the recording has no control points");
}

namespace {

/// Half an eighth of a turn more than straight: outlines of trimmed edges are polygons.
constexpr double kReentrant = 1.125 * std::numbers::pi;

/// The cell between knots that each triangle lies in: cells of the samples' grid divide it.
std::vector<int> cellsOf(const Scenario& s) {
  const Surface& surface = s.model->surface;
  std::vector<int> cells = surface.triangle_cell;
  for (std::size_t t = 0; t < cells.size(); ++t) {
    const auto p = static_cast<std::size_t>(surface.triangle_patch[t]);
    const int per = std::max(1, s.samples_per_cell[p]), across = surface.patch_grid_size[p][0] - 1;
    cells[t] = cells[t] % across / per + across * (cells[t] / across / per);
  }
  return cells;
}

struct Areas {
  const Scenario& s;
  std::vector<Vec3> rest_m;  ///< of the samples
  std::vector<double> inner_m2, clear_m2, mass_kg;

  explicit Areas(const Scenario& scenario) : s(scenario) {
    const Surface& surface = s.model->surface;
    rest_m.resize(static_cast<std::size_t>(surface.size()));
    surface.W.multiply<Vec3>(s.model->cloth->rest(), rest_m);
    const std::vector<int> cells = cellsOf(s);
    const SheetMesh mesh{surface.triangles, surface.triangle_patch, cells, rest_m};
    const std::vector<char> inner = innerSamples(mesh), clear = clearOfCorners(mesh, kReentrant);
    inner_m2.assign(rest_m.size(), 0);
    clear_m2.assign(rest_m.size(), 0);
    for (std::size_t i = 0; i < rest_m.size(); ++i) {
      if (inner[i]) inner_m2[i] = surface.area_m2[i];
      if (clear[i]) clear_m2[i] = surface.area_m2[i];
      mass_kg.push_back(surface.area_m2[i] * s.model->density_kg_per_m2[i]);
    }
  }

  std::vector<PatchMeasure> patchesOf(const Frame& frame, std::span<const Vec3> q) const {
    const Surface& surface = s.model->surface;
    const std::vector<float>& stress = fieldOf(frame, "stress").data;
    std::vector<double> bend(stress.size());
    CarriedError error;
    forAll(Each::much, surface.size(), [&](int i) {
      error.guard(i, [&] { bend[i] = s.model->cloth->bendAt(q, surface.patch[i], surface.parameters[i]); });
    });
    error.rethrow();
    const int patches = static_cast<int>(s.patch_names.size());
    const std::vector<double> curvature = regionRms(surface.patch, surface.area_m2, bend, patches);
    const std::vector<Turning> turning = turningOf(surface.patch, mass_kg, vectorsOf(frame.positions),
                                                   vectorsOf(fieldOf(frame, "velocity").data), patches);
    std::vector<PatchMeasure> out(s.patch_names.size());
    std::vector<std::vector<double>> value(out.size()), weight(out.size());
    for (std::size_t p = 0; p < out.size(); ++p) {
      const double none = std::numeric_limits<double>::quiet_NaN();
      out[p] = {none, none, none, curvature[p], turning[p]};
    }
    const auto most = [](double& so_far, double x) { so_far = so_far >= x ? so_far : x; };
    for (std::size_t i = 0; i < stress.size(); ++i) {
      const auto p = static_cast<std::size_t>(surface.patch[i]);
      if (clear_m2[i] > 0) most(out[p].clear_max_N_per_m, stress[i]);
      if (!(inner_m2[i] > 0)) continue;
      most(out[p].inner_max_N_per_m, stress[i]);
      value[p].push_back(stress[i]);
      weight[p].push_back(inner_m2[i]);
    }
    for (std::size_t p = 0; p < out.size(); ++p)
      if (!value[p].empty()) out[p].inner_p95_N_per_m = weightedPercentile(value[p], weight[p], 0.95);
    return out;
  }
};

/// Weight and contact of what hangs from the cuts.
void addBelow(const Scenario& s, const Frame& frame, std::span<const double> below, Vec3& weight_N, Vec3& contact_N) {
  const Model& m = *s.model;
  const std::vector<Vec3> contact = vectorsOf(fieldOf(frame, "contact_force").data);
  std::vector<double> w(contact.size());
  m.surface.W.multiply<double>(below, w);
  for (std::size_t i = 0; i < w.size(); ++i) {
    weight_N += w[i] * m.surface.area_m2[i] * m.density_kg_per_m2[i] * m.environment.gravity_m_per_s2;
    contact_N += w[i] * contact[i];
  }
}

/// Of all supports, in the window that ends with the frame.
Vec3 supportsAt(const Scenario& s, const RecordedTable& table, double time_s) {
  const std::vector<double>&start = table.column("start_s"), &end = table.column("end_s");
  for (std::size_t w = 0; w < table.rows(); ++w) {
    if (std::abs(end[w] - time_s) > 1e-6) continue;
    Vec3 sum{};
    for (const std::string& name : supportNames(s))
      sum += VectorColumns(table, name + "_", "_Ns")[w] / (end[w] - start[w]);
    return sum;
  }
  throw RunError("a frame of the recording is not at the end of a window");
}

void add(StrapsMeasure::At& sum, const StrapsMeasure::At& at) {
  sum.pull_N.resize(at.pull_N.size());
  for (std::size_t c = 0; c < at.pull_N.size(); ++c) sum.pull_N[c] += at.pull_N[c];
  sum.weight_N += at.weight_N;
  sum.contact_N += at.contact_N;
  sum.all_weight_N += at.all_weight_N;
  sum.all_contact_N += at.all_contact_N;
  sum.supports_N += at.supports_N;
}

void divide(StrapsMeasure::At& sum, double n) {
  for (Vec3& f : sum.pull_N) f = f / n;
  for (Vec3* f : {&sum.weight_N, &sum.contact_N, &sum.all_weight_N, &sum.all_contact_N, &sum.supports_N}) *f = *f / n;
}

}  // namespace

void measureCloth(const Scenario& s, const RecordingReader& recording, Measured& out) {
  const Areas areas(s);
  const Cloth& cloth = *s.model->cloth;
  const std::vector<StrapCut> cuts =
      s.definition.strain_limit ? std::vector<StrapCut>{} : strapCuts(cloth, s.patch_names);
  const std::vector<double> own = weightsBelow(cloth, cuts, true), all = weightsBelow(cloth, cuts, false);
  const RecordedTable supports = recording.table("supports");
  ClothWork work;
  for (const StrapCut& cut : cuts)
    out.straps.cuts.push_back(
        {s.patch_names[static_cast<std::size_t>(cut.patch)] + (cut.at_end ? " end" : " start"), cut.width_m});
  StrapsMeasure& straps = out.straps;
  double count = 0;
  for (int k = 0; k < recording.frameCount(); ++k) {
    if (recording.time(k) <= 1e-9) continue;
    const Frame frame = recording.frame(k);
    const std::vector<Vec3> q = controlsOf(frame);
    out.cloth_time_s.push_back(frame.time_s);
    out.cloth.push_back(areas.patchesOf(frame, q));
    if (cuts.empty()) continue;
    StrapsMeasure::At at;
    at.time_s = frame.time_s;
    at.pull_N = strapPulls(cloth, q, cuts, work);
    addBelow(s, frame, own, at.weight_N, at.contact_N);
    addBelow(s, frame, all, at.all_weight_N, at.all_contact_N);
    at.supports_N = supportsAt(s, supports, frame.time_s);
    straps.at.push_back(at);
    if (frame.time_s < out.counted_from_s - 1e-9) continue;
    ++count;
    add(straps.mean, at);
  }
  if (count > 0) divide(straps.mean, count);
}

void writeCloth(const std::filesystem::path& dir, const Scenario& s, const Measured& m) {
  std::vector<std::string> columns{"time_s"};
  for (const std::string& name : s.patch_names)
    for (const char* what :
         {"_inner_p95_N_per_m", "_inner_max_N_per_m", "_clear_max_N_per_m", "_curvature_rms_1_per_m",
          "_turning_x_rad_per_s", "_turning_y_rad_per_s", "_turning_z_rad_per_s", "_Lx_Nms", "_Ly_Nms", "_Lz_Nms"})
      columns.push_back(name + what);
  std::vector<std::vector<double>> rows;
  for (std::size_t k = 0; k < m.cloth.size(); ++k) {
    rows.push_back({m.cloth_time_s[k]});
    for (const PatchMeasure& p : m.cloth[k]) {
      const Vec3 &w = p.turning.rate_rad_per_s, &L = p.turning.momentum_Nms;
      rows.back().insert(rows.back().end(), {p.inner_p95_N_per_m, p.inner_max_N_per_m, p.clear_max_N_per_m,
                                             p.curvature_rms_1_per_m, w.x, w.y, w.z, L.x, L.y, L.z});
    }
  }
  writeCsv(dir / "patches.csv", columns, rows);
  if (m.straps.cuts.empty()) return;
  columns = {"time_s"};
  for (const auto& cut : m.straps.cuts)
    for (const char* axis : {"_x_N", "_y_N", "_z_N"}) columns.push_back(cut.name + axis);
  for (const char* name : {"weight_below", "contact_below", "all_weight_below", "all_contact_below", "supports"})
    for (const char* axis : {"_x_N", "_y_N", "_z_N"}) columns.push_back(std::string(name) + axis);
  rows.clear();
  for (const StrapsMeasure::At& at : m.straps.at) {
    rows.push_back({at.time_s});
    for (const Vec3& f : at.pull_N) rows.back().insert(rows.back().end(), {f.x, f.y, f.z});
    for (const Vec3& f : {at.weight_N, at.contact_N, at.all_weight_N, at.all_contact_N, at.supports_N})
      rows.back().insert(rows.back().end(), {f.x, f.y, f.z});
  }
  writeCsv(dir / "straps.csv", columns, rows);
}

}  // namespace gambeson
