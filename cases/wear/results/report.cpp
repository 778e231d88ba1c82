/// Detail of write.hpp: report.html from the measured numbers.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "analysis/ticks.hpp"
#include "cases/runs/run_identity.hpp"
#include "cases/wear/results/check_words.hpp"
#include "cases/wear/results/girths.hpp"
#include "cases/wear/results/joint_words.hpp"
#include "cases/wear/results/stretch_checks.hpp"
#include "cases/wear/results/write.hpp"

namespace gambeson {
namespace {

std::string titleOf(const JointMeasure& m) { return m.movement.empty() ? m.part : m.part + " " + m.movement; }

Tone toneOf(const std::string& side) {
  return side == "left" ? Tone::left : side == "right" ? Tone::right : Tone::third;
}

std::string capital(std::string s) {
  if (!s.empty()) s[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(s[0])));
  return s;
}

void addJoints(const Scenario& s, const Measured& m, ReportInput& in) {
  const Trust trust = trustOf(in);
  for (const JointMeasure& j : m.joints) {
    if (j.prismatic || !isTouched(j)) continue;
    JointSummary summary;
    summary.joint = j.movement.empty() ? j.part : j.part + " (" + j.movement + ")";
    summary.side = j.side;
    summary.peak_Nm = j.peak.value;
    summary.peak_time_s = j.peak.time_s;
    summary.cause = causeOf(j, m.strides);
    summary.rms_Nm = j.rms;
    if (j.natural_Nm) {
      summary.natural_percent = 100 * std::abs(j.peak.value) / *j.natural_Nm;
      summary.natural_Nm = *j.natural_Nm;
      if (const Light light = shownLight(effortOf(s.definition.comfort, j), trust); light != Light::unknown)
        summary.light = nameOf(light);
    }
    if (j.peak.value != 0) {
      summary.drag_percent = 100 * j.drag_at_peak / j.peak.value;
      summary.friction_percent = 100 * j.friction_at_peak / j.peak.value;
    }
    in.joints.push_back(std::move(summary));
  }
}

/// One plot per movement, both sides in it.
void addPlots(const Measured& m, ReportInput& in) {
  std::vector<TimeMark> marks;
  if (m.strides)
    for (int k = 0; k <= m.strides->count && m.strides->start_s + k * m.strides->time_s < m.recorded_end_s + 1e-9; ++k)
      marks.push_back(
          {m.strides->start_s + k * m.strides->time_s, k < m.strides->count ? fmt::format("stride {}", k + 1) : "end"});
  std::vector<std::string> titles;
  for (const JointMeasure& j : m.joints)
    if (isTouched(j) && std::find(titles.begin(), titles.end(), titleOf(j)) == titles.end())
      titles.push_back(titleOf(j));
  for (const std::string& title : titles) {
    Plot plot{capital(title), "", {}, marks, true};
    std::string unit = "Nm";
    const JointMeasure* highest = nullptr;
    for (const JointMeasure& j : m.joints)
      if (isTouched(j) && titleOf(j) == title) {
        if (!highest || std::abs(j.peak.value) > std::abs(highest->peak.value)) highest = &j;
        unit = j.prismatic ? "N" : "Nm";
        std::string name = j.side.empty() ? j.name : j.side;
        std::replace(name.begin(), name.end(), '_', ' ');
        plot.series.push_back({name, unit, m.added.time_s, m.added.of(j.joint), toneOf(j.side)});
      }
    plot.caption = signOf(highest->movement);
    if (!highest->prismatic) plot.peak_note = nameOf(pushOf(highest->peak.value, highest->rate_at_peak));
    plot.mark_from_s = m.counted_from_s;
    plot.title += unit == "N" ? ": added force" : ": added torque";
    in.torques.push_back(std::move(plot));
  }
}

void addContact(const Measured& m, bool chart_too, ReportInput& in) {
  BarChart chart{"Share of each segment in the contact",
                 "%",
                 "Of the impulse of the contact force over the motion; segments that nothing touched are left out.",
                 {}};
  Table table{"Contact force per segment",
              "Force: the vector sum on the segment, opposite pressures cancel. Pressing and friction: sums of "
              "magnitudes, which do not.",
              {"segment", "peak [N]", "at [s]", "mean [N]", "share [%]", "pressing, mean [N]", "friction, mean [N]"},
              {}};
  std::vector<const BodyMeasure*> order;
  for (const BodyMeasure& b : m.contact)
    if (b.contact.impulse_Ns > 0) order.push_back(&b);
  std::stable_sort(order.begin(), order.end(), [](auto* a, auto* b) { return a->contact.share > b->contact.share; });
  for (const BodyMeasure* b : order) {
    std::string name = b->contact.segment;
    std::replace(name.begin(), name.end(), '_', ' ');
    chart.bars.push_back({name, 100 * b->contact.share});
    table.rows.push_back({name, b->contact.peak_N, TableCell(fmt::format("{:.2f}", b->contact.peak_time_s)),
                          b->contact.mean_N, TableCell(100 * b->contact.share), b->normal_N, b->friction_N});
    table.rows.back()[2].number = true;
  }
  if (chart_too && !chart.bars.empty()) in.contact_charts.push_back(std::move(chart));
  in.contact_tables.push_back(std::move(table));
}

void addStress(const Scenario& s, const Measured& m, ReportInput& in) {
  Table table{
      "Stress (the largest pull, per metre of width) and stretch of each patch",
      "By area over all frames of the motion: 95 % of a patch carries at most p95, 99 % at most p99. " +
          stretchMeaning(s.definition, m.stretch),
      {"patch", "median [N/m]", "p95 [N/m]", "p99 [N/m]", "largest [N/m]", "at [s]", "stretch, p99 [%]", "largest [%]"},
      {}};
  for (std::size_t r = 0; r < m.stress.size(); ++r) {
    const StressSummary& k = m.stress[r];
    std::string name = m.regions.names[r];
    std::replace(name.begin(), name.end(), '_', ' ');
    table.rows.push_back({name, k.p50_N_per_m, k.p95_N_per_m, k.p99_N_per_m, k.max_N_per_m,
                          TableCell(fmt::format("{:.2f}", k.max_time_s)), 100 * k.p99_strain, 100 * k.max_strain});
    table.rows.back()[5].number = true;
  }
  in.stress_tables.push_back(std::move(table));
}

void addGirths(const Measured& m, ReportInput& in) {
  Table table{
      "Girths of the body and of what is worn",
      "As the motion begins: the body by the tape, and the cloth that goes around it in the same plane, as it was cut "
      "and as it is worn. Ease is what it was cut wider than the body; where it is negative the cloth has to stretch.",
      {"zone", "garment", "body [cm]", "cut [cm]", "ease [cm]", "ease [%]", "worn [cm]"},
      {}};
  for (const GirthMeasure& g : m.girths) {
    std::string zone = g.zone;
    std::replace(zone.begin(), zone.end(), '_', ' ');
    if (g.worn.empty()) table.rows.push_back({zone, "", TableCell(100 * g.body_m, 4), "", "", "", ""});
    for (const GirthMeasure::Worn& w : g.worn)
      table.rows.push_back({zone, w.garment, TableCell(100 * g.body_m, 4), TableCell(100 * w.rest_m, 4),
                            TableCell(100 * (w.rest_m - g.body_m)), TableCell(100 * (w.rest_m / g.body_m - 1)),
                            TableCell(100 * w.length_m, 4)});
  }
  if (!table.rows.empty()) in.stress_tables.push_back(std::move(table));
}

void addSupports(const Measured& m, ReportInput& in) {
  if (m.supports.empty()) return;
  Table table{"Forces of the supports on the cloth",
              "Means over the motion in world axes; sinking of the edge against what it hangs on.",
              {"support", "mean x [N]", "mean y [N]", "mean z [N]", "peak [N]", "largest sinking [mm]"},
              {}};
  for (const SupportMeasure& s : m.supports)
    table.rows.push_back({s.name, s.mean_N.x, s.mean_N.y, s.mean_N.z, s.peak_N,
                          s.springs ? TableCell(1e3 * s.largest_drop_m) : TableCell("held")});
  in.support_tables.push_back(std::move(table));
}

void addRepeatability(const Measured& m, ReportInput& in) {
  const auto told = [](const std::optional<Likeness>& l) { return l && std::isfinite(l->correlation); };
  const bool again =
      std::any_of(m.joints.begin(), m.joints.end(), [&](const JointMeasure& j) { return told(j.second_stride); });
  Table table{"How well the strides repeat",
              std::string(again ? "The second stride's added torque against the first's; the left side's, half a "
                                  "stride later, against the right's."
                                : "The left side's added torque, half a stride later, against the right's.") +
                  " A correlation of 1 is the same course over time. Joints without a torque are left out.",
              {"joint"},
              {}};
  if (again) table.columns.insert(table.columns.end(), {"second stride: correlation", "RMS difference [%]"});
  table.columns.insert(table.columns.end(), {"other side: correlation", "RMS difference [%]"});
  const auto cells = [&](const std::optional<Likeness>& l, std::vector<TableCell>& row) {
    if (told(l))
      row.insert(row.end(), {TableCell(l->correlation), TableCell(100 * l->relative)});
    else
      row.insert(row.end(), {TableCell(""), TableCell("")});
  };
  for (const JointMeasure& j : m.joints) {
    if (!told(j.second_stride) && !told(j.other_side)) continue;
    std::vector<TableCell> row{TableCell(titleOf(j) + (j.side.empty() ? "" : ", " + j.side))};
    if (again) cells(j.second_stride, row);
    cells(j.other_side, row);
    table.rows.push_back(std::move(row));
  }
  if (!table.rows.empty()) in.fact_tables.push_back(std::move(table));
}

/// Joints beyond which the garment touches nothing; empty where there are none.
std::string untouchedOf(const Measured& m) {
  std::string names;
  for (const JointMeasure& j : m.joints)
    if (!isTouched(j)) names += (names.empty() ? "" : ", ") + titleOf(j) + (j.side.empty() ? "" : " " + j.side);
  return names;
}

/// What a run without torques shows.
std::string outcomeOf(const Measured& m) {
  const BodyMeasure* top = nullptr;
  for (const BodyMeasure& b : m.contact)
    if (!top || b.contact.peak_N > top->contact.peak_N) top = &b;
  std::string s;
  if (top && top->contact.impulse_Ns > 0)
    s = fmt::format("Largest contact force: {} N, on the {}, at {:.2f} s; {} N in the mean over the motion.",
                    formatNumber(top->contact.peak_N), top->contact.segment, top->contact.peak_time_s,
                    formatNumber(top->contact.mean_N));
  long most = 0, tangles = 0, left = 0;
  double free_s = 0;
  for (const CollisionWindow& w : m.steps.collisions) {
    most = std::max(most, w.cloth_contacts);
    tangles = std::max(tangles, w.intersections);
    left = w.intersections;
    if (w.intersections > 0) free_s = w.end_s;
  }
  const auto add = [&](const std::string& sentence) { s += (s.empty() ? "" : " ") + sentence; };
  if (most > 0) add(fmt::format("Cloth touches cloth in up to {} places at a time.", most));
  if (!m.memory.rows.empty()) {
    double set = 0, friction = 1;
    for (const MemoryMeasure::Of& of : m.memory.rows.back())
      set = std::max(set, of.largest_set_per_m), friction = std::min(friction, of.least_friction_left);
    if (set > 0)
      add(
          fmt::format("Folds have set in the cloth, up to a curvature of {} 1/m; at least {} % of its friction in "
                      "bending is left.",
                      formatNumber(set), formatNumber(100 * friction)));
  }
  if (tangles > 0)
    add(left > 0
            ? fmt::format("Cloth passes through something in {} places at the end.", left)
            : fmt::format("It passed through something in {} places, and is free from {:.2f} s on.", tangles, free_s));
  return s.empty() ? "Nothing touched anything in this run." : s;
}

/// What of the motion was played, where that is not what the page is to judge.
void sayPlayed(const Measured& m, ReportInput& in) {
  using Played = Measured::Played;
  switch (m.played) {
    case Played::nothing:
      in.warnings.push_back(
          fmt::format("The run ended at {:.2f} s, while the garment was put on: nothing of the motion was played, and "
                      "nothing is measured.",
                      m.recorded_end_s));
      break;
    case Played::lead_in:
      in.warnings.push_back(
          fmt::format("The run ended at {:.2f} s, in the lead-in: the first stride begins at {:.2f} s. What follows "
                      "is of the lead-in alone and is compared with no task.",
                      m.recorded_end_s, m.strides->start_s));
      in.no_share = "no stride was played";
      in.task.clear();
      break;
    case Played::part_of_a_stride:
      in.notes.push_back(
          fmt::format("The run ended at {:.2f} s, in the first stride ({:.2f} to {:.2f} s): peaks and means are of "
                      "the lead-in and of what was played of that stride.",
                      m.recorded_end_s, m.strides->start_s, m.strides->start_s + m.strides->time_s));
      return;
    case Played::strides:
      return;
  }
  in.played = false;
}

/// What made the steps, where that was not the processor alone.
void addDevice(const DeviceFacts& d, ReportInput& in) {
  if (d.kind == DeviceKind::cpu) return;
  const std::string kernels = "kernels of the device: " + d.kernels;
  in.facts.push_back(
      {"Device", d.kind == DeviceKind::cuda
                     ? fmt::format("{}, driver {}, this program has {}; {}", d.gpu, d.driver, d.runtime, kernels)
                     : "the processor with the kernels of a GPU, whose bits it has (--device reference); " + kernels});
  std::string by_cpu =
      fmt::format("{} of {} ({} %)", d.by_cpu, d.steps,
                  formatNumber(100.0 * static_cast<double>(d.by_cpu) / static_cast<double>(std::max(1L, d.steps))));
  std::string reasons;
  for (const auto& [why, count] : d.reasons) reasons += fmt::format("{}{} {}", reasons.empty() ? "" : ", ", why, count);
  if (!reasons.empty()) by_cpu += ": " + reasons;
  if (d.repeated > 0) by_cpu += fmt::format("; {} passes were repeated with more room for their lists", d.repeated);
  in.facts.push_back({"Steps handed to the CPU", by_cpu});
}

std::string duration(double s) {
  if (s < 1e-3) return formatNumber(1e6 * s) + " µs";
  return s < 1 ? formatNumber(1e3 * s) + " ms" : formatNumber(s) + " s";
}

}  // namespace

ReportInput reportInput(const Scenario& s, const Measured& m, const RunFacts& facts, const std::string& identity,
                        const std::vector<Picture>& pictures) {
  ReportInput in;
  in.title = s.definition.name;
  in.description = s.definition.description;
  if (s.definition.analysis.task == Task::natural_walk) in.task = "level walking at natural speed";
  if (s.definition.analysis.task == Task::natural_stairs) in.task = "climbing stairs";
  if (s.definition.analysis.task == Task::aiming) in.task = "taking aim, held still";
  if (m.recorded_end_s < s.end_s - 1e-9)
    in.warnings.push_back(
        fmt::format("The run stopped at {:.2f} s of {:.2f} s: what follows is only what was recorded until then.",
                    m.recorded_end_s, s.end_s));
  for (const ShortMeasure& t : m.too_short) in.warnings.push_back(capital(doesNotFit(t)) + ".");
  for (const std::string& note : s.notes) {
    const bool key = note.substr(0, note.find(' ')).find('.') != std::string::npos;  // "fabric.thickness: .."
    in.notes.push_back((key ? note : capital(note)) + ".");
  }
  in.found = s.facts;
  sayPlayed(m, in);
  in.audit = auditOf(m);
  for (AuditCheck& c : stretchChecks(s.definition, m.stretch)) in.audit.push_back(std::move(c));
  for (AuditCheck& c : in.audit)
    if (!c.holds()) {
      const CheckWords words = checkWords(c.name, c.value, c.limit, c.unit);
      c.wrong = words.wrong;
      c.spoils = words.order;
      c.meaning += ". " + words.means;
    }
  in.stretch = m.stretch;
  addJoints(s, m, in);
  addPlots(m, in);
  if (s.human) addZones(m, in);
  if (!m.contact.empty()) addContact(m, !s.human, in);
  addComfort(s, m, in);
  addCollisions(m, in);
  if (m.played == Measured::Played::nothing)
    in.outcome = "No result: nothing of the motion was played.";
  else if (in.joints.empty())
    in.outcome = m.joints.empty()
                     ? outcomeOf(m)
                     : "The garment touches nothing that a joint moves: no torque tells what it costs. " + outcomeOf(m);
  addStress(s, m, in);
  addGirths(m, in);
  addSupports(m, in);
  addMemory(m, in);
  in.pictures = pictures;
  in.assumptions = assumptionsOf(s, m);
  if (const std::string names = untouchedOf(m); !names.empty())
    in.assumptions.push_back("Left out, as the garment touches nothing that they move: " + names + ".");
  const RunIdentity made(identity);
  in.facts = {
      {"Garment", fmt::format("{} control points, {} contact samples, {}", s.model->cloth->points(),
                              s.model->surface.size(), fmt::join(s.fabric_names, ", "))},
      {"Steps", std::to_string(m.steps.steps)},
      {"Smallest time step",
       fmt::format("{}; governed by the {} term", duration(m.steps.shortest_s), m.steps.governing)},
      {"Mean time step", duration(m.steps.mean_s)},
      {"Largest stretch",
       [&] {
         double e = 0, most = 0;
         for (const StressSummary& r : m.stress) e = std::max(e, r.max_strain), most = std::max(most, r.p99_strain);
         return fmt::format("{} %; 99 % of every patch stays below {} %", formatNumber(100 * e),
                            formatNumber(100 * most));
       }()},
      {"Computed in", fmt::format("{}; threads: {}; kernels: {}{}", duration(facts.wall_s), facts.threads, made.kernels,
                                  facts.resumed ? "; resumed, the time is of the last part" : "")},
      {"Gambeson", facts.version},
      {"Case hash", made.case_hash}};
  addDevice(facts.device, in);
  addRepeatability(m, in);
  if (!facts.phases_s.empty()) {
    Table timings{"Where the time went", "", {"phase", "time [s]", "share [%]"}, {}};
    double sum = 0;
    for (const auto& [name, seconds] : facts.phases_s) sum += seconds;
    for (const auto& [name, seconds] : facts.phases_s)
      timings.rows.push_back({name, seconds, TableCell(sum > 0 ? 100 * seconds / sum : 0)});
    in.fact_tables.push_back(std::move(timings));
    Plot over_time{"Time of each phase", "Of each window; the three largest phases.", {}, {}, false};
    std::vector<std::size_t> order(facts.phases_s.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return facts.phases_s[a].second > facts.phases_s[b].second; });
    for (std::size_t k = 0; k < std::min<std::size_t>(3, order.size()); ++k) {
      Series series{facts.phases_s[order[k]].first, "ms", {}, {}, static_cast<Tone>(k)};
      for (const WindowTimes& w : facts.windows) {
        series.time_s.push_back(0.5 * (w.start_s + w.end_s));
        series.values.push_back(1e3 * w.phases_s[order[k]]);
      }
      over_time.series.push_back(std::move(series));
    }
    if (!facts.windows.empty()) in.fact_plots.push_back(std::move(over_time));
  }
  return in;
}

}  // namespace gambeson
