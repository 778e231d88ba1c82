#include "cases/study/uncertainty.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/ticks.hpp"

namespace gambeson::study {

const char* Headline::name() const {
  const char* const names[]{"peak torque", "root mean square torque", "pressure, mean", "pressure, peak"};
  return names[static_cast<int>(quantity)];
}

std::optional<double> Headline::in(const RunNumbers& run) const {
  if (!run.good) return {};
  if (isTorque()) {
    const JointNumbers* j = run.joint(of);
    if (!j) return {};
    return quantity == Quantity::peak ? std::abs(j->peak_Nm) : j->rms_Nm;
  }
  const ComfortNumbers* c = run.comfortOf(of);
  if (!c) return {};
  return quantity == Quantity::mean_pressure ? c->mean_Pa : c->peak_Pa;
}

std::optional<double> BarredNumber::relative() const {
  const auto whole = bar.combined();
  return whole && value > 0 ? std::optional(*whole / value) : std::nullopt;
}

double CourseDifference::larger() const { return std::max(peak, rms); }

namespace {

constexpr double kSameTime_s = 1e-9;

/// Numbers over time.
struct Course {
  const std::vector<double>&time_s, &value;

  /// The largest size from `from_s` to `to_s` on.
  double largest(double from_s, double to_s) const {
    double most = 0;
    for (std::size_t i = 0; i < time_s.size() && time_s[i] <= to_s; ++i)
      if (time_s[i] >= from_s) most = std::max(most, std::abs(value[i]));
    return most;
  }
};

std::optional<CourseDifference> differenceOf(const Course& a, const Course& b, double from_s, double to_s) {
  double peak_a = 0, peak_b = 0, sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < a.time_s.size() && a.time_s[i] <= to_s; ++i) {
    if (a.time_s[i] < from_s) continue;
    if (i >= b.time_s.size() || std::abs(b.time_s[i] - a.time_s[i]) > kSameTime_s) return {};
    peak_a = std::max(peak_a, std::abs(a.value[i]));
    peak_b = std::max(peak_b, std::abs(b.value[i]));
    sum += (a.value[i] - b.value[i]) * (a.value[i] - b.value[i]);
    ++count;
  }
  if (!(peak_a > 0)) return {};
  return CourseDifference{std::abs(peak_a - peak_b) / peak_a, std::sqrt(sum / count) / peak_a};
}

}  // namespace

std::optional<CourseDifference> differenceOf(const RunNumbers& first, const RunNumbers& second,
                                             const std::string& joint, double from_s, double to_s) {
  const JointNumbers *a = first.joint(joint), *b = second.joint(joint);
  if (!a || !b) return {};
  return differenceOf(Course{first.time_s, a->torque_Nm}, Course{second.time_s, b->torque_Nm}, from_s, to_s);
}

std::optional<double> meshPart(const RunNumbers& coarse, const RunNumbers& fine, const std::string& joint,
                               About about) {
  if (!coarse.good || !fine.good || fine.control_points <= coarse.control_points) return {};
  const RunNumbers &at = about == About::coarse ? coarse : fine, &other = about == About::coarse ? fine : coarse;
  const auto d = differenceOf(at, other, joint, at.counted_from_s, 1e300);
  if (d) return meshBar(d->larger(), coarse.control_points, fine.control_points, about);
  // Courses that are not at the same times leave the peaks.
  const JointNumbers *a = at.joint(joint), *b = other.joint(joint);
  if (!a || !b || a->peak_Nm == 0) return {};
  return meshBar(std::abs(std::abs(a->peak_Nm) - std::abs(b->peak_Nm)) / std::abs(a->peak_Nm), coarse.control_points,
                 fine.control_points, about);
}

namespace {

/// The run that tells a part of the bar of `reference`; null without one that is good.
const RunNumbers* runOf(const Study& s, const std::vector<RunNumbers>& runs, std::size_t reference, BarPart part) {
  for (std::size_t i = 0; i < s.variants.size(); ++i)
    if (s.variants[i].part == part && s.variants[i].reference == static_cast<int>(reference) && runs[i].good)
      return &runs[i];
  return nullptr;
}

/// The course of a number in a run; nothing where the run has none.
std::optional<Course> courseOf(const RunNumbers& run, const Headline& what) {
  if (what.isTorque()) {
    const JointNumbers* j = run.joint(what.of);
    return j ? std::optional(Course{run.time_s, j->torque_Nm}) : std::nullopt;
  }
  const ComfortNumbers* c = run.comfortOf(what.of);
  if (!c) return {};
  return Course{run.pressure_time_s,
                what.quantity == Headline::Quantity::mean_pressure ? c->mean_so_far_Pa : c->largest_Pa};
}

/// Of the value: that of its course until the run with half steps ends, of the largest by then. A mean pressure is
/// compared as it is where that run ends.
std::optional<double> stepPart(const RunNumbers& run, const RunNumbers& half, const Headline& what, std::string& why) {
  const auto whole = courseOf(run, what), part = courseOf(half, what);
  if (!whole || !part) return {};
  const double from_s = run.counted_from_s;
  if (part->time_s.empty() || part->time_s.back() <= from_s) {
    why = fmt::format("the run with half steps ends at {} s, before torques count; a longer step_duration shows more",
                      formatNumber(half.recorded_to_s));
    return {};
  }
  const bool is_mean = what.quantity == Headline::Quantity::mean_pressure;
  const double to_s = part->time_s.back() + kSameTime_s;
  constexpr double enough = 0.2;  // of the whole run's: a smaller one says little of it
  const auto d = differenceOf(*whole, *part, is_mean ? to_s - 2 * kSameTime_s : from_s, to_s);
  if (!d || whole->largest(from_s, to_s) < enough * whole->largest(from_s, whole->time_s.back())) {
    why = fmt::format(
        "until the run with half steps ends, at {} s, less than a fifth of the peak is reached; a longer "
        "step_duration shows more",
        formatNumber(half.recorded_to_s));
    return {};
  }
  return stepBar(d->larger());
}

std::optional<double> meshPartOf(const RunNumbers& run, const RunNumbers& fine, const Headline& what, double value) {
  if (what.isTorque()) return meshPart(run, fine, what.of, About::coarse);
  const auto other = what.in(fine);
  if (!other || fine.control_points <= run.control_points) return {};
  return meshBar(std::abs(*other - value) / value, run.control_points, fine.control_points, About::coarse);
}

/// A finer run that the study has by itself: of a variant with "finer", or on the axis of meshes.
const RunNumbers* ownFiner(const Study& s, const std::vector<RunNumbers>& runs, std::size_t reference) {
  const Variant& v = s.variants[reference];
  const RunNumbers* finest = nullptr;
  for (std::size_t i = 0; i < s.variants.size(); ++i) {
    const Variant& w = s.variants[i];
    bool same = w.part == BarPart::none && (w.grid || w.finer) && w.levels.size() == v.levels.size();
    for (std::size_t a = 0; same && a < s.axes.size(); ++a)
      same = w.levels[a] == v.levels[a] || (w.grid && s.axes[a].role == Role::mesh);
    if (same && !s.axes.empty() && runs[i].good && runs[i].control_points > runs[reference].control_points &&
        (!finest || runs[i].control_points > finest->control_points))
      finest = &runs[i];
  }
  return finest;
}

}  // namespace

Budget budgetOf(const Study& s, const std::vector<RunNumbers>& runs, std::size_t reference,
                const std::vector<Headline>& numbers) {
  Budget budget;
  budget.reference = reference;
  const RunNumbers& run = runs[reference];
  const RunNumbers* half = runOf(s, runs, reference, BarPart::step);
  const RunNumbers* fine = runOf(s, runs, reference, BarPart::mesh);
  if (!fine) fine = ownFiner(s, runs, reference);
  if (s.uncertainty->step && !half) budget.no_step = "its run failed";
  std::vector<std::vector<double>> scores;
  std::vector<const RunNumbers*> samples;
  for (std::size_t i = 0; i < s.variants.size(); ++i) {
    const Variant& v = s.variants[i];
    if (v.part != BarPart::fabric || v.reference != static_cast<int>(reference)) continue;
    if (!runs[i].good) {
      ++budget.failed;
      continue;
    }
    scores.push_back(v.scores);
    samples.push_back(&runs[i]);
  }
  budget.samples = static_cast<int>(samples.size());
  const std::size_t least = s.uncertainty->spreads.size() + 4;  // three runs and up tell how far a line is off
  const bool enough = !samples.empty() && samples.size() >= least;
  if (s.uncertainty->runs > 0 && !enough)
    budget.no_fabric = fmt::format("{} of {} samples failed", budget.failed, s.uncertainty->runs);
  for (const Headline& what : numbers) {
    const auto value = what.in(run);
    if (!value || !(*value > 0)) continue;
    BarredNumber n{what, *value, {}, {}};
    if (fine)
      if (const auto part = meshPartOf(run, *fine, what, *value)) n.bar.mesh = *part * *value;
    if (half)
      if (const auto part = stepPart(run, *half, what, budget.no_step)) n.bar.step = *part * *value;
    if (enough) {
      std::vector<double> y;
      for (const RunNumbers* sample : samples) y.push_back(what.in(*sample).value_or(std::nan("")));
      if (std::all_of(y.begin(), y.end(), [](double v) { return std::isfinite(v); })) {
        n.fabric = fitSpread(scores, y);
        n.bar.fabric = kCoverage * n.fabric->deviation();
      }
    }
    budget.numbers.push_back(std::move(n));
  }
  return budget;
}

namespace {

std::string shareText(double share) { return fmt::format("{:.0f} %", 100 * share); }

/// "of the bending rigidity"
std::string spreadName(const std::string& name) {
  return name == "bending" ? "the bending rigidity" : name == "friction" ? "friction" : "the " + name;
}

/// The whole bar with a part of it, given as its half width, that many times smaller.
double barWith(const BarredNumber& n, double part, double times) {
  const double whole = *n.bar.combined();
  return std::sqrt(std::max(0.0, whole * whole - part * part * (1 - 1 / (times * times))));
}

}  // namespace

std::vector<std::string> adviceOf(const Study& s, const BarredNumber& n) {
  std::vector<std::string> all;
  const auto whole = n.bar.combined();
  if (!whole || !(*whole > 0)) return all;
  const std::string unit = n.what.unit();
  const auto say = [&](double half) { return fmt::format("\u00b1 {} {}", formatNumber(half, 2), unit); };
  const BarPart most = n.bar.largest();
  const double part = *n.bar.of(most);
  const char* const causes[]{"", "the mesh", "the step", "the fabric\u2019s spread"};
  const double share = n.bar.share(most);
  all.push_back(fmt::format("{} of {} comes from {} ({} of the sum of squares).",
                            share > 0.9   ? "Nearly all"
                            : share > 0.5 ? "Most"
                                          : "The largest part",
                            say(*whole), causes[static_cast<int>(most)], shareText(share)));
  if (most == BarPart::mesh)
    all.push_back(
        fmt::format("First compute with finer cells: half of their size would leave {}.", say(barWith(n, part, 4))));
  if (most == BarPart::step)
    all.push_back(
        fmt::format("First compute with shorter steps: half of them would leave {}.", say(barWith(n, part, 2))));
  if (!n.fabric) return all;
  // What of the fabric to measure better, were it measured twice as well.
  const SpreadFit& fit = *n.fabric;
  const auto best = std::max_element(fit.variance.begin(), fit.variance.end());
  const double scatter = fit.residual * fit.residual;
  const StudiedSpread& spread = s.uncertainty->spreads[static_cast<std::size_t>(best - fit.variance.begin())];
  if (*best > scatter)
    all.push_back(
        fmt::format("Of the fabric, measure {} better: it makes {} of the spread. Known within {} % instead of {} %, "
                    "it would leave "
                    "{}.",
                    spreadName(spread.name), shareText(*best / fit.total()), formatNumber(50 * spread.deviation, 2),
                    formatNumber(100 * spread.deviation, 2), say(barWith(n, kCoverage * std::sqrt(*best), 2))));
  else if (fit.total() > 0) {
    const std::string now = say(*whole), then = say(barWith(n, kCoverage * std::sqrt(*best), 2));
    all.push_back(fmt::format(
        "{} of the fabric\u2019s spread follows none of its numbers by itself: numbers that work together, and what "
        "differs "
        "from run to run as cloth folds or slips otherwise. To measure {} better would {}.",
        shareText(scatter / fit.total()), spreadName(spread.name),
        now == then ? "hardly change it" : fmt::format("take it from {} to {}", now, then)));
  }
  return all;
}

}  // namespace gambeson::study
