#include "cases/structure/results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "cases/cloth/thread_strains.hpp"
#include "cases/cloth/usual.hpp"
#include "cases/runs/check_json.hpp"
#include "cases/structure/fields.hpp"
#include "cases/structure/run.hpp"
#include "cases/structure/self_crossings.hpp"
#include "core/error.hpp"
#include "core/io/csv.hpp"
#include "core/io/own_file.hpp"

namespace gambeson {

std::vector<double> PathTable::column(const std::string& name) const {
  const auto at = std::find(columns.begin(), columns.end(), name) - columns.begin();
  std::vector<double> values;
  if (at < std::ssize(columns))
    for (const auto& row : rows) values.push_back(row[static_cast<std::size_t>(at)]);
  return values;
}

namespace {

using Json = nlohmann::ordered_json;

const char* kindName(StructureKind kind) {
  return kind == StructureKind::statics ? "static" : kind == StructureKind::dynamics ? "dynamic" : "modal";
}

/// The columns NAME_... of the last row, without the name: {"ux_m": 0.1, ...}.
Json valuesOf(const PathTable& path, const std::string& name) {
  Json j{{"name", name}};
  if (path.rows.empty()) return j;
  for (std::size_t k = 0; k < path.columns.size(); ++k)
    if (path.columns[k].starts_with(name + "_")) {
      // "a" must not take the columns of "a_b": what follows is one of our own names.
      const std::string rest = path.columns[k].substr(name.size() + 1);
      static const std::vector<std::string> ours{
          "ux_m", "uy_m", "uz_m", "vx_m_per_s", "vy_m_per_s", "vz_m_per_s", "n1_N_per_m", "n2_N_per_m",
          "e1",   "e2",   "rx_N", "ry_N",       "rz_N",       "mx_Nm",      "my_Nm",      "mz_Nm"};
      if (std::find(ours.begin(), ours.end(), rest) != ours.end()) j[rest] = path.rows.back()[k];
    }
  return j;
}

Json lawRangeOf(const StructureFacts& facts) {
  const LawRange& range = facts.law_range;
  Json j{{"points", range.points}, {"most_beyond", range.beyond}};
  if (range.unanswered > 0) j["unanswered"] = range.unanswered;
  if (facts.unanswered_tries > 0) j["tries_without_answer"] = facts.unanswered_tries;
  return j;
}

void addField(Frame& frame, const std::string& name, const std::string& unit, int components, std::vector<float> data) {
  frame.sample_fields.push_back({name, unit, components, std::move(data)});
}

}  // namespace

Frame frameOf(const MeshShape& shape, int index, double at) {
  Frame frame;
  frame.time_s = index;
  std::vector<float> displacement, n1, n2, e1, e2;
  for (std::size_t k = 0; k < shape.x.size(); ++k) {
    for (int c = 0; c < 3; ++c) {
      frame.positions.push_back(static_cast<float>(shape.x[k][c]));
      displacement.push_back(static_cast<float>(shape.x[k][c] - shape.rest[k][c]));
    }
    n1.push_back(static_cast<float>(shape.stress[k].principal1_N_per_m));
    n2.push_back(static_cast<float>(shape.stress[k].principal2_N_per_m));
    e1.push_back(static_cast<float>(shape.stress[k].strain1));
    e2.push_back(static_cast<float>(shape.stress[k].strain2));
  }
  addField(frame, "displacement", "m", 3, std::move(displacement));
  addField(frame, "stress1", "N/m", 1, std::move(n1));
  addField(frame, "stress2", "N/m", 1, std::move(n2));
  addField(frame, "strain1", "", 1, std::move(e1));
  addField(frame, "strain2", "", 1, std::move(e2));
  addField(frame, "at", "", 1, std::vector<float>(shape.x.size(), static_cast<float>(at)));
  return frame;
}

double frameValue(const Frame& frame) {
  for (const Field& f : frame.sample_fields)
    if (f.name == "at" && !f.data.empty()) return f.data[0];
  return 0;
}

void writeShapeTable(const PlaceMesh& mesh, const MeshShape& shape, const std::filesystem::path& csv) {
  std::vector<std::vector<double>> rows;
  for (std::size_t k = 0; k < mesh.uv.size(); ++k)
    rows.push_back({static_cast<double>(mesh.patch[k]), mesh.fraction[k].x, mesh.fraction[k].y, shape.rest[k].x,
                    shape.rest[k].y, shape.rest[k].z, shape.x[k].x, shape.x[k].y, shape.x[k].z,
                    shape.stress[k].principal1_N_per_m, shape.stress[k].principal2_N_per_m, shape.stress[k].strain1,
                    shape.stress[k].strain2});
  writeCsv(csv, {"patch", "u", "v", "X_m", "Y_m", "Z_m", "x_m", "y_m", "z_m", "n1_N_per_m", "n2_N_per_m", "e1", "e2"},
           rows);
}

void writeStructureSummary(const StructureCase& c, const StructureModel& model, const PathTable& path,
                           const std::vector<ModeRow>& modes, const MeasuredState& last, const PlaceMesh& mesh,
                           const MeshShape& shape, const StructureFacts& facts, const std::vector<AuditCheck>& checks,
                           const std::filesystem::path& file) {
  const Structure& s = *model.structure;
  Json j{{"name", c.name},
         {"kind", kindName(c.kind)},
         {"version", GAMBESON_VERSION},
         {"case_hash", caseIdentity(c)},
         {"kernels", s.cloth->kernels()},
         {"finished", facts.finished}};
  if (!facts.finished) j["why"] = facts.why;
  const schema::Object& table = schema::structureTable(c.kind);
  if (const auto unusual = unusualNumbers(table, schema::writeObject(table, &c)); !unusual.empty())
    j["unusual"] = unusual;
  double area = 0, mass = 0;
  for (const double a : s.area_m2) area += a;
  for (const double m : s.lumped_kg) mass += m;
  j["patches"] = s.cloth->patches().size();
  j["control_points"] = s.cloth->points();
  j["unknowns"] = s.dofs.unknowns();
  j["area_m2"] = area;
  if (mass > 0) j["mass_kg"] = mass;  // a static case may have no density
  if (c.kind == StructureKind::modal) {
    Json list = Json::array();
    for (const ModeRow& m : modes)
      list.push_back({{"omega_rad_per_s", m.omega_rad_per_s},
                      {"frequency_Hz", m.omega_rad_per_s / (2 * std::numbers::pi)},
                      {"residual", m.residual},
                      {"rounding", m.rounding}});
    j["modes"] = list;
  } else {
    // The largest component is what codes give that look at their vector of unknowns.
    double control = 0, component = 0, displacement = 0, stress = 0, strain = 0;
    for (std::size_t k = 0; k < last.q.size(); ++k) {
      const Vec3 u = last.q[k] - s.cloth->rest()[k];
      control = std::max(control, norm(u));
      component = std::max({component, std::abs(u.x), std::abs(u.y), std::abs(u.z)});
    }
    for (std::size_t k = 0; k < shape.x.size(); ++k) {
      displacement = std::max(displacement, norm(shape.x[k] - shape.rest[k]));
      stress = std::max(stress, shape.stress[k].principal1_N_per_m);
      strain = std::max(strain, shape.stress[k].strain1);
    }
    j[c.kind == StructureKind::statics ? "factor" : "time_s"] = last.at;
    if (c.kind == StructureKind::statics) {
      j["jumps"] = facts.jumps;
      j["rounded_residual"] = facts.rounded;
      if (c.statics.arc_length)
        j["arc_length"] = {{"limit_points", facts.limit_points},
                           {"bifurcations", facts.bifurcations},
                           {"unknown_before", facts.jumped_at}};
    }
    j["strain_energy_J"] = last.strain_energy_J;
    j["largest_displacement_m"] = displacement;
    j["largest_control_displacement_m"] = control;
    j["largest_control_component_m"] = component;
    j["largest_stress_N_per_m"] = stress;
    j["largest_strain"] = strain;
    j["self_crossings"] = selfCrossings(shape.x, mesh.triangles);
    if (c.kind == StructureKind::dynamics && !path.rows.empty()) {
      for (const char* energy : {"kinetic_energy_J", "total_energy_J"}) j[energy] = path.column(energy).back();
    }
    j["points"] = Json::array();
    for (const OutputPoint& p : c.output.points) j["points"].push_back(valuesOf(path, p.name));
    j["edges"] = Json::array();
    for (const OutputEdge& e : c.output.edges) j["edges"].push_back(valuesOf(path, e.name));
  }
  if (!path.rows.empty() && c.output.thread_strains) {
    const auto first = std::find(path.columns.begin(), path.columns.end(), ThreadStrains::columns().front());
    j["thread_strain"] = threadStrainSummary(path.rows, static_cast<std::size_t>(first - path.columns.begin()));
  }
  if (c.strain_limit)
    j["strain_limit"] = {
        {"largest_residual", facts.limit_residual},
        {"projections", facts.projections},
        {"projections_per_step",
         facts.points > 0 ? static_cast<double>(facts.projections) / static_cast<double>(facts.points) : 0},
        {"unconverged_steps", facts.limits_missed}};
  if (facts.law_range.points > 0) j["law_range"] = lawRangeOf(facts);
  if (facts.contact)
    j["contact"] = {{"unsolved_steps", facts.contact->unsolved},
                    {"pinched_steps", facts.contact->pinched},
                    {"deepest_penetration_m", facts.contact->deepest_m},
                    {"crossings", facts.contact->crossings},
                    {"work_J", facts.contact->work_J}};
  if (facts.audit) {
    const MotionAudit& a = *facts.audit;
    Json audit;
    const auto part = [](double gap, double of) { return of > 0 ? gap / of : 0; };
    if (a.hasEnergy()) {
      audit["energy_gap_J"] = a.energyGap();
      audit["largest_energy_gap_J"] = a.largestEnergyGap();
      audit["works_J"] = a.works();
      if (a.integratorEnergy() != 0) audit["work_integrator_J"] = a.integratorEnergy();
      audit["energy_gap_over_works"] = part(a.largestEnergyGap(), a.works());
    }
    audit["largest_momentum_gap_Ns"] = a.largestMomentumGap();
    audit["impulses_Ns"] = a.impulses();
    audit["momentum_gap_over_impulses"] = part(a.largestMomentumGap(), a.impulses());
    j["audit"] = audit;
  }
  j["checks"] = checkJson(checks);
  j["solver"] = {{c.kind == StructureKind::dynamics ? "steps" : "points", facts.points},
                 {"iterations", facts.iterations},
                 {"factorisations", facts.factorisations}};
  j["timings"] = {
      {"wall_s", facts.wall_s}, {"build_s", facts.build_s}, {"solve_s", facts.solve_s}, {"threads", facts.threads}};
  writeOwnFile(file, j.dump(2) + "\n");
}

}  // namespace gambeson
