/// Detail of write.hpp: summary.json.

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "cases/cloth/thread_strains.hpp"
#include "cases/cloth/usual.hpp"
#include "cases/runs/run_identity.hpp"
#include "cases/wear/case/fields.hpp"
#include "cases/wear/results/stretch_checks.hpp"
#include "cases/wear/results/write.hpp"
#include "core/io/own_file.hpp"

namespace gambeson {
namespace {

using Json = nlohmann::ordered_json;

Json list(const Vec3& v) { return {v.x, v.y, v.z}; }

Json likeness(const Likeness& l) {
  return {{"correlation", l.correlation},
          {"rms_difference", l.rms_difference},
          {"rms_difference_ratio", l.relative},
          {"samples", l.samples}};
}

Json jointJson(const JointMeasure& m, const std::optional<Strides>& strides, const ComfortCase& comfort) {
  const std::string unit = m.prismatic ? "_N" : "_Nm";
  Json j{{"joint", m.name}, {"side", m.side}};
  j["peak" + unit] = m.peak.value;
  j["peak_time_s"] = m.peak.time_s;
  j["cause"] = causeOf(m, strides);
  j["rms" + unit] = m.rms;
  if (const auto& g = m.segments)
    j["by_segments"] = {{"peak" + unit, g->peak.value},
                        {"peak_time_s", g->peak.time_s},
                        {"at_peak" + unit, g->at_peak},
                        {"border_2cm_proximal" + unit, g->border_proximal},
                        {"border_2cm_distal" + unit, g->border_distal}};
  if (m.standing) j["standing" + unit] = *m.standing;
  j["drag_at_peak" + unit] = m.drag_at_peak;
  j["friction_at_peak" + unit] = m.friction_at_peak;
  j["friction_rms" + unit] = m.friction_rms;
  if (m.peak.value != 0) j["friction_share_at_peak"] = m.friction_at_peak / m.peak.value;
  j["joint_at_peak"] = m.position_at_peak;
  j["joint_rate_at_peak"] = m.rate_at_peak;
  if (m.natural_Nm) {
    j["natural_peak_Nm"] = *m.natural_Nm;
    j["percent_of_natural"] = 100 * std::abs(m.peak.value) / *m.natural_Nm;
    j["effort"] = nameOf(effortOf(comfort, m));
    if (m.held && m.held->foot_part > 0)
      j["natural_is_held"] = {{"foot_share_of_weight", m.held->foot_part}, {"lever_m", m.held->lever_m}};
  }
  j["normal_mean_N"] = m.normal_N;
  j["friction_mean_N"] = m.friction_N;
  if (m.phase_at_peak) j["stride_phase_at_peak"] = *m.phase_at_peak;
  if (m.phase_of_highest) j["stride_phase_of_highest_joint_value"] = *m.phase_of_highest;
  if (m.lead_in_peak) j["lead_in_peak"] = {{"value", m.lead_in_peak->value}, {"time_s", m.lead_in_peak->time_s}};
  if (strides)
    for (const Peak& p : m.stride_peaks)
      j["stride_peaks"].push_back(
          {{"value", p.value}, {"time_s", p.time_s}, {"stride_phase", strides->phase(p.time_s, m.side)}});
  if (m.second_stride) j["second_stride_against_first"] = likeness(*m.second_stride);
  if (m.other_side) j["left_half_a_stride_later_against_right"] = likeness(*m.other_side);
  return j;
}

Json stressJson(const Measured& m) {
  Json all = Json::array();
  for (std::size_t r = 0; r < m.stress.size(); ++r) {
    const StressSummary& s = m.stress[r];
    all.push_back({{"region", m.regions.names[r]},
                   {"p50_N_per_m", s.p50_N_per_m},
                   {"p95_N_per_m", s.p95_N_per_m},
                   {"p99_N_per_m", s.p99_N_per_m},
                   {"max_N_per_m", s.max_N_per_m},
                   {"max_time_s", s.max_time_s},
                   {"p99_strain", s.p99_strain},
                   {"max_strain", s.max_strain},
                   {"max_strain_time_s", s.max_strain_time_s}});
  }
  return all;
}

/// Zheng 2013, table 4.1: means over the steps that looked for intersections.
Json searchesJson(const RunFacts& f) {
  const auto phase = [&](const char* name) {
    for (const auto& [of, seconds] : f.phases_s)
      if (of == name) return seconds;
    return 0.0;
  };
  const double finding = phase("finding intersections"), freeing = phase("freeing intersections");
  const auto mean_ms = [&](double seconds) { return 1e3 * seconds / static_cast<double>(f.searches); };
  Json j{{"steps", f.searches},
         {"step_ms", mean_ms(f.searched_steps_s)},
         {"finding_ms", mean_ms(finding)},
         {"freeing_ms", mean_ms(freeing)}};
  if (finding + freeing > 0) j["share_of_freeing"] = freeing / (finding + freeing);
  if (f.searched_steps_s > 0) j["share_of_the_step"] = (finding + freeing) / f.searched_steps_s;
  return j;
}

Json collisionsJson(const Measured& m) {
  CollisionWindow all;
  all.smallest_gap_m = std::numeric_limits<double>::infinity();
  double flagged_s = -1, apart_s = 0;
  double farthest = -std::numeric_limits<double>::infinity();  ///< smallest gap of a window, the largest
  bool touched = false;
  long flagged = 0;
  for (const CollisionWindow& w : m.steps.collisions) {
    all.contacts = std::max(all.contacts, w.contacts);
    all.cloth_contacts = std::max(all.cloth_contacts, w.cloth_contacts);
    all.impacts += w.impacts;
    all.impact_zones += w.impact_zones;
    all.cut_steps += w.cut_steps;
    all.pinched += w.pinched;
    all.intersections = std::max(all.intersections, w.intersections);
    all.way_cells = std::max(all.way_cells, w.way_cells);
    touched = touched || w.contacts > 0;
    if (touched && w.contacts == 0) apart_s += w.end_s - w.start_s;
    if (touched) farthest = std::max(farthest, w.contacts > 0 ? w.smallest_gap_m : farthest);
    if (w.contacts > 0) all.smallest_gap_m = std::min(all.smallest_gap_m, w.smallest_gap_m);
    flagged += w.pinched > 0;
    if (w.pinched > 0 && flagged_s < 0) flagged_s = w.start_s;
  }
  Json j{{"most_contacts", all.contacts},
         {"most_contacts_of_cloth_with_cloth", all.cloth_contacts},
         {"impacts", all.impacts},
         {"rigid_zones", all.impact_zones},
         {"cut_steps", all.cut_steps},
         {"pinched_samples", all.pinched},
         {"flagged_windows", flagged},
         {"most_intersections", all.intersections},
         {"intersections_at_end", m.steps.collisions.empty() ? 0 : m.steps.collisions.back().intersections},
         {"largest_way_of_a_sample_in_cells", all.way_cells},
         {"largest_residual_m_per_s", m.steps.largest_residual_m_per_s},
         {"unconverged_steps", m.steps.unconverged},
         {"without_contact_after_the_first_s", apart_s},
         {"work_of_restoring_J", m.energy.restoring}};
  if (touched) j["smallest_gap_m"] = all.smallest_gap_m;
  if (touched) j["largest_smallest_gap_of_a_window_m"] = farthest;
  const CollisionTable table = collisionTable(m.steps.collisions);
  j["windows"] = {{"columns", table.columns}, {"rows", table.rows}};
  if (flagged_s >= 0) j["first_pinched_at_s"] = flagged_s;
  return j;
}

/// Time means of sums of magnitudes; ratios of what nothing presses on are left out.
Json zonesJson(const ZonesMeasure& m) {
  Json j{{"rows", Json::array()}};
  for (std::size_t g = 0; g < m.groups.size(); ++g)
    for (std::size_t z = 0; z < m.names.size(); ++z)
      if (const ZoneForce& f = m.mean[g][z]; f.force_N > 0)
        j["rows"].push_back({{"zone", m.names[z]},
                             {"layer", m.groups[g].garment},
                             {"press", m.groups[g].press == Press::belt   ? "belt"
                                       : m.groups[g].press == Press::held ? "springs"
                                                                          : "free"},
                             {"force_N", f.force_N},
                             {"normal_N", f.normal_N},
                             {"friction_N", f.friction_N}});
  std::vector<std::string> zones = m.names;
  for (const std::string& name : m.names)
    if (name.ends_with("_left")) zones.push_back(name.substr(0, name.size() - 5));  // both sides
  for (const bool free : {false, true}) {
    Json& of = j[free ? "without_belt_and_springs" : "all"];
    const ZoneForce total = m.of("", free);
    of["sum"] = {{"force_N", total.force_N}, {"normal_N", total.normal_N}, {"friction_N", total.friction_N}};
    for (const std::string& zone : zones) {
      const ZoneForce f = m.of(zone, free);
      of[zone] = {{"force_N", f.force_N},
                  {"normal_N", f.normal_N},
                  {"friction_N", f.friction_N},
                  {"mean_resultant_N", m.resultantOf(zone, free)}};
      if (total.normal_N > 0) of[zone]["normal_share"] = f.normal_N / total.normal_N;
    }
    const ZoneForce shoulder = m.of("shoulder", free), thigh = m.of("thigh", free);
    const double left = m.of("shoulder_left", free).force_N;
    if (total.normal_N > 0)
      of["normal_share_of_shoulder_and_thigh"] = (shoulder.normal_N + thigh.normal_N) / total.normal_N;
    if (shoulder.force_N > 0) of["thigh_to_shoulder"] = thigh.force_N / shoulder.force_N;
    if (left > 0) of["right_to_left_shoulder"] = m.of("shoulder_right", free).force_N / left;
    // Of each side's resultant: what pushes it, without what squeezes it.
    const double push = m.resultantOf("shoulder", free), push_left = m.resultantOf("shoulder_left", free);
    if (push > 0) of["thigh_to_shoulder_resultants"] = m.resultantOf("thigh", free) / push;
    if (push_left > 0) of["right_to_left_shoulder_resultants"] = m.resultantOf("shoulder_right", free) / push_left;
  }
  return j;
}

/// Means over the frames that count; "up" is against gravity.
Json strapsJson(const StrapsMeasure& m, const Vec3& gravity) {
  const double g = norm(gravity);
  if (m.cuts.empty() || !(g > 0)) return nullptr;
  const Vec3 up = -gravity / g;
  Json j{{"cuts", Json::array()}};
  double pull = 0;
  for (std::size_t c = 0; c < m.cuts.size() && c < m.mean.pull_N.size(); ++c) {
    const Vec3& f = m.mean.pull_N[c];
    pull += dot(f, up);
    j["cuts"].push_back({{"cut", m.cuts[c].name}, {"width_m", m.cuts[c].width_m}, {"pull_N", Json{f.x, f.y, f.z}}});
  }
  const double weight = -dot(m.mean.weight_N, up), contact = dot(m.mean.contact_N, up);
  j["width_m"] = m.width_m();
  j["pull_up_N"] = pull;
  j["weight_below_N"] = weight;
  j["contact_below_up_N"] = contact;
  // What the other garments bear of the straps' garment.
  j["weight_on_cloth_below_N"] = weight - pull - contact;
  const double all = -dot(m.mean.all_weight_N, up);
  j["all_weight_below_N"] = all;
  j["all_contact_below_up_N"] = dot(m.mean.all_contact_N, up);
  j["supports_up_N"] = dot(m.mean.supports_N, up);
  if (weight > 0) j["balance_error"] = (pull + dot(m.mean.all_contact_N + m.mean.supports_N, up) - all) / weight;
  if (m.width_m() > 0) j["pull_up_N_per_m"] = pull / m.width_m();
  return j;
}

Json auditJson(const Case& definition, const Measured& m) {
  Json all = Json::array();
  std::vector<AuditCheck> checks = auditOf(m);
  for (AuditCheck& c : stretchChecks(definition, m.stretch)) checks.push_back(std::move(c));
  for (const AuditCheck& c : checks)
    all.push_back({{"check", c.name}, {"value", c.value}, {"limit", c.limit}, {"unit", c.unit}, {"holds", c.holds()}});
  return all;
}

Json recordedJson(const RecordedRange& r) {
  const auto three = [](const std::array<float, 3>& v) { return Json{double(v[0]), double(v[1]), double(v[2])}; };
  return {{"last_frame_low_m", three(r.low)},
          {"last_frame_high_m", three(r.high)},
          {"stress_low_N_per_m", double(r.stress_low)},
          {"stress_high_N_per_m", double(r.stress_high)},
          {"last_frame_stress_low_N_per_m", double(r.last_stress_low)},
          {"last_frame_stress_high_N_per_m", double(r.last_stress_high)}};
}

}  // namespace

void writeSummary(const Scenario& s, const RecordingReader& recording, const Measured& m, const RunFacts& facts,
                  const std::filesystem::path& file) {
  const RunIdentity identity(recording.layout().identity);
  Json j{{"name", s.definition.name},
         {"version", facts.version},
         {"case_hash", identity.case_hash},
         {"kernels", identity.kernels}};
  if (identity.on_device) j["steps_on"] = "device";
  const Case& written = s.definition;
  if (const auto unusual = unusualNumbers(schema::caseTable(), schema::writeObject(schema::caseTable(), &written));
      !unusual.empty())
    j["unusual"] = unusual;
  j["recorded_from_s"] = s.start_s;
  j["recorded_to_s"] = m.recorded_end_s;
  j["planned_to_s"] = s.end_s;
  const FactorsCase& f = s.definition.factors;
  j["factors"] = {{"thickness", f.thickness}, {"bending", f.bending}, {"membrane", f.membrane},
                  {"weight", f.weight},       {"inertia", f.inertia}, {"drag", f.drag},
                  {"friction", f.friction}};
  j["garments"] = Json::array();
  for (const GarmentMeasure& l : garmentMeasuresOf(s)) {
    Json garment{{"garment", l.name},    {"fabric", l.fabric},           {"mass_kg", l.mass_kg},
                 {"area_m2", l.area_m2}, {"thickness_m", l.thickness_m}, {"control_points", l.control_points}};
    if (l.varies()) garment["thickness_range_m"] = {l.least_thickness_m, l.largest_thickness_m};
    j["garments"].push_back(std::move(garment));
  }
  j["counted_from_s"] = m.counted_from_s;
  j["control_points"] = s.model->cloth->points();
  j["samples"] = s.model->surface.size();
  j["sign"] = signRule();
  j["joints"] = Json::array();
  for (const JointMeasure& joint : m.joints) j["joints"].push_back(jointJson(joint, m.strides, s.definition.comfort));
  if (const JointMeasure* top = m.highest()) j["highest"] = top->name;
  const char* const played[]{"nothing", "the lead-in", "part of a stride", "strides"};
  if (m.strides || m.played == Measured::Played::nothing) j["played"] = played[static_cast<int>(m.played)];
  if (m.strides && m.played >= Measured::Played::part_of_a_stride)
    j["strides"] = {{"start_s", m.strides->start_s}, {"time_s", m.strides->time_s}, {"count", m.strides->count}};
  if (s.feet && m.playedToTheEnd(s))
    j["feet"] = {{"slip_m", s.feet->slip_m},
                 {"slip_m_per_s", s.feet->slip_m_per_s},
                 {"penetration_m", s.feet->penetration_m},
                 {"hover_m", s.feet->hover_m}};
  if (const auto stairs = s.motion ? s.motion->stairs() : std::nullopt)
    j["stairs"] = {{"rise_m", stairs->rise_m}, {"tread_m", stairs->tread_m}};
  j["contact_regions"] = Json::array();
  for (const RegionMeasure& r : m.contact_regions)
    j["contact_regions"].push_back({{"name", r.name},
                                    {"mean_x_N", r.mean_N.x},
                                    {"mean_y_N", r.mean_N.y},
                                    {"mean_z_N", r.mean_N.z},
                                    {"mean_normal_N", r.normal_N},
                                    {"mean_friction_N", r.friction_N}});
  if (m.law_range.points > 0) j["law_range"] = {{"points", m.law_range.points}, {"most_beyond", m.law_range.beyond}};
  j["body_zones"] = zonesJson(m.zones);
  j["comfort"] = Json::object();
  for (const ComfortMeasure& c : m.comfort)
    j["comfort"][c.zone] = {
        {"light", nameOf(c.light())},   {"mean_Pa", c.mean_Pa},           {"peak_Pa", c.peak_Pa},
        {"peak_time_s", c.peak_time_s}, {"dose_kPa_min", c.dose_kPa_min}, {"above_amber_m2", c.amber_m2},
        {"amber_Pa", c.limit.amber_Pa}, {"red_Pa", c.limit.red_Pa},       {"peak_limit_Pa", c.limit.peak_Pa},
        {"peak_during", c.peak_during}};
  if (Json straps = strapsJson(m.straps, s.model->environment.gravity_m_per_s2); !straps.is_null())
    j["straps"] = std::move(straps);
  j["contact"] = Json::array();
  for (const BodyMeasure& b : m.contact)
    j["contact"].push_back({{"segment", b.contact.segment},
                            {"peak_N", b.contact.peak_N},
                            {"peak_time_s", b.contact.peak_time_s},
                            {"mean_N", b.contact.mean_N},
                            {"share", b.contact.share},
                            {"normal_mean_N", b.normal_N},
                            {"friction_mean_N", b.friction_N}});
  for (const TouchMeasure& t : m.touch)
    j["touch_at_end"][t.body] = {{"normal_N", t.normal_N},
                                 {"area_m2", t.area_m2},
                                 {"radius_m", t.radius_m()},
                                 {"force_radius_m", t.force_radius_m}};
  j["supports"] = Json::array();
  for (const SupportMeasure& g : m.supports)
    j["supports"].push_back({{"support", g.name},
                             {"mean_on_cloth_N", list(g.mean_N)},
                             {"peak_N", g.peak_N},
                             {"peak_time_s", g.peak_time_s},
                             {"largest_drop_m", g.largest_drop_m}});
  j["stress"] = stressJson(m);
  double strain = 0;
  for (const StressSummary& r : m.stress) strain = std::max(strain, r.max_strain);
  j["largest_strain"] = strain;
  if (!m.thread_strains.empty()) j["thread_strain"] = threadStrainSummary(m.thread_strains);
  j["deepest_penetration_m"] = m.steps.deepest_m;
  j["deepest_penetration_time_s"] = m.steps.deepest_time_s;
  if (m.surface_depth)
    j["deepest_penetration_of_finer_surface"] = {{"deepest_m", m.surface_depth->deepest_m},
                                                 {"time_s", m.surface_depth->time_s},
                                                 {"points", m.surface_depth->points}};
  if (m.seam_gap)
    j["widest_seam_gap"] = {{"gap_m", m.seam_gap->gap_m},
                            {"cells", m.seam_gap->cells},
                            {"time_s", m.seam_gap->time_s},
                            {"at_m", {m.seam_gap->at_m.x, m.seam_gap->at_m.y, m.seam_gap->at_m.z}}};
  j["momentum"] = {{"largest_error_ratio", m.steps.momentum_error}, {"at_s", m.steps.momentum_error_time_s}};
  j["energy"] = {{"change_J", m.energy.change},
                 {"work_contact_J", m.energy.contact},
                 {"work_contact_friction_J", m.energy.friction},
                 {"work_contact_separation_J", m.energy.separation},
                 {"work_drag_J", m.energy.drag},
                 {"dissipated_J", m.energy.dissipated},
                 {"work_supports_J", m.energy.supports},
                 {"drift_J", m.energy.drift()},
                 {"sum_of_absolute_works_J", m.energy.absolute},
                 {"lift_by_1_mm_J", m.energy.lift},
                 {"drift_ratio", m.energy.relative()}};
  if (m.energy.lost > 0) j["energy"]["lost_energy_J"] = m.energy.lost;
  if (m.energy.integrator) j["energy"]["work_integrator_J"] = *m.energy.integrator;
  if (std::isfinite(m.sticking.bodies)) j["sticking"]["bodies"] = m.sticking.bodies;
  if (std::isfinite(m.sticking.cloth)) j["sticking"]["cloth"] = m.sticking.cloth;
  if (!m.memory.rows.empty()) {
    Json patches = Json::array();
    for (std::size_t p = 0; p < m.memory.patches.size(); ++p) {
      const MemoryMeasure::Of& of = m.memory.rows.back()[p];
      patches.push_back({{"patch", m.memory.patches[p]},
                         {"set_1_per_m", of.set_per_m},
                         {"largest_set_1_per_m", of.largest_set_per_m},
                         {"friction_left", of.friction_left},
                         {"least_friction_left", of.least_friction_left}});
    }
    j["memory"] = patches;
  }
  j["steps"] = {{"count", m.steps.steps},
                {"smallest_s", m.steps.shortest_s},
                {"mean_s", m.steps.mean_s},
                {"largest_s", m.steps.longest_s},
                {"governing_term", m.steps.governing},
                {"governing_shares",
                 {{"membrane", m.steps.shares[0]},
                  {"bending", m.steps.shares[1]},
                  {"seam", m.steps.shares[2]},
                  {"spring", m.steps.shares[3]}}},
                {"largest_frequency_rad_per_s", m.steps.frequency_rad_per_s},
                {"largest_frequency_time_s", m.steps.frequency_time_s}};
  j["contact_solver"] = {{"unconverged_steps", m.steps.unconverged},
                         {"yielded_steps", m.steps.yielded},
                         {"largest_residual_m_per_s", m.steps.largest_residual_m_per_s},
                         {"mean_iterations", m.steps.mean_iterations},
                         {"impacts", m.steps.impacts}};
  if (m.steps.solves > 0)
    j["velocity_solver"] = {{"mean_iterations", m.steps.solve_iterations / static_cast<double>(m.steps.solves)},
                            {"largest_missed_impulse_ratio", m.steps.largest_missed_impulse}};
  j["collisions"] = collisionsJson(m);
  if (m.limited)
    j["strain_limit"] = {
        {"largest_residual", m.steps.largest_limit_residual},
        {"largest_residual_settling", m.steps.largest_limit_residual_settling},
        {"projections", m.steps.projections},
        {"projections_per_step",
         m.steps.steps > 0 ? static_cast<double>(m.steps.projections) / static_cast<double>(m.steps.steps) : 0},
        {"steps", m.steps.limited},
        {"unconverged_steps", m.steps.unlimited},
        {"work_J", m.energy.limit}};
  j["stretch"] = Json::array();
  for (const Stretch& k : m.stretch)
    j["stretch"].push_back({{"garment", k.garment},
                            {"along", k.along},
                            {"limit", k.limit},
                            {"stated", k.stated},
                            {"p99_strain", k.most},
                            {"max_strain", k.largest},
                            {"holds", k.holds()}});
  j["girths"] = Json::array();
  for (const GirthMeasure& g : m.girths) {
    Json worn = Json::array();
    for (const GirthMeasure::Worn& w : g.worn)
      worn.push_back(
          {{"garment", w.garment}, {"length_m", w.length_m}, {"rest_m", w.rest_m}, {"ease_m", w.rest_m - g.body_m}});
    j["girths"].push_back({{"zone", g.zone}, {"body_m", g.body_m}, {"worn", worn}});
  }
  j["too_short"] = Json::array();
  for (const ShortMeasure& t : m.too_short)
    for (const Girth& g : t.at)
      j["too_short"].push_back({{"garment", t.garment},
                                {"height_m", g.height_m},
                                {"rest_m", g.rest_m},
                                {"worn_m", g.worn_m},
                                {"short_m", g.short_m()}});
  if (s.definition.human && s.definition.human->measures) {
    MeasuresReport report;
    makeManikin(*s.definition.human->measures, &report);
    j["manikin_girths"] = Json::array();
    for (const MadeGirth& g : report.girths)
      j["manikin_girths"].push_back({{"girth", g.name}, {"asked_m", g.asked_m}, {"made_m", g.made_m}});
  }
  j["audit"] = auditJson(s.definition, m);
  if (m.recorded) j["recording"] = recordedJson(*m.recorded);
  Json phases = Json::object();
  for (const auto& [name, seconds] : facts.phases_s) phases[name] = seconds;
  Json columns{"start_s", "end_s"};
  for (const auto& phase : facts.phases_s) columns.push_back(phase.first);
  Json windows = Json::array();
  for (const WindowTimes& w : facts.windows) windows.push_back(w.row());
  j["timings"] = {{"wall_s", facts.wall_s},
                  {"threads", facts.threads},
                  {"resumed", facts.resumed},
                  {"phases_s", phases},
                  {"windows", {{"columns", columns}, {"rows", windows}}}};
  if (facts.searches > 0) j["timings"]["intersections"] = searchesJson(facts);
  writeOwnFile(file, j.dump(2) + "\n");
}

}  // namespace gambeson
