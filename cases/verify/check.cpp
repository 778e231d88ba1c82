/// Detail of verify.hpp: comparisons of measured numbers with published ones. What is not a number never passes.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/course.hpp"
#include "cases/input/schema.hpp"
#include "cases/verify/verify.hpp"
#include "core/error.hpp"

namespace gambeson::verify {

Nearest nearestOnPolyline(const std::vector<double>& x, const std::vector<double>& y, double px, double py, double sx,
                          double sy) {
  Nearest best{std::numeric_limits<double>::infinity(), 0, 0};
  const auto consider = [&](double qx, double qy) {
    const double d = std::hypot((qx - px) / sx, (qy - py) / sy);
    if (d < best.distance) best = {d, qx, qy};
  };
  for (std::size_t i = 0; i < x.size(); ++i) {
    consider(x[i], y[i]);
    if (i == 0) continue;
    const double dx = (x[i] - x[i - 1]) / sx, dy = (y[i] - y[i - 1]) / sy, length2 = dx * dx + dy * dy;
    if (!(length2 > 0)) continue;
    const double t = ((px - x[i - 1]) / sx * dx + (py - y[i - 1]) / sy * dy) / length2;
    if (t > 0 && t < 1) consider(x[i - 1] + t * (x[i] - x[i - 1]), y[i - 1] + t * (y[i] - y[i - 1]));
  }
  return best;
}

std::size_t Numbers::find(const std::string& column) const {
  const auto it = std::find(columns.begin(), columns.end(), column);
  if (it == columns.end())
    throw RunError(fmt::format("there is no column \"{}\"; there are: {}", column, schema::joined(columns)));
  return static_cast<std::size_t>(it - columns.begin());
}

namespace {

std::vector<double> columnOf(const Numbers& t, const std::string& name, double scale, double offset) {
  const std::size_t c = t.find(name);
  std::vector<double> values;
  for (const auto& row : t.rows) values.push_back(scale * row[c] + offset);
  return values;
}

/// y at x = at, linear between the rows of the first interval that holds `at`.
double interpolate(const std::vector<double>& x, const std::vector<double>& y, double at) {
  double span = 0;
  for (const double v : x) span = std::max(span, std::abs(v));
  for (std::size_t i = 0; i < x.size(); ++i)
    if (std::abs(x[i] - at) <= 1e-9 * span) return y[i];
  for (std::size_t i = 1; i < x.size(); ++i)
    if ((x[i - 1] - at) * (x[i] - at) < 0) return y[i - 1] + (at - x[i - 1]) / (x[i] - x[i - 1]) * (y[i] - y[i - 1]);
  throw RunError(fmt::format("the run's table does not reach {}", at));
}

/// y where x = at is a row.
double hit(const std::vector<double>& x, const std::vector<double>& y, double at) {
  double span = 0;
  for (const double v : x) span = std::max(span, std::abs(v));
  for (std::size_t i = 0; i < x.size(); ++i)
    if (std::abs(x[i] - at) <= 1e-9 * span) return y[i];
  throw RunError(fmt::format("the run's table has no row at {}", at));
}

double numberOf(const Quantity& q, const std::string& run, const RunNumbers& numbers) {
  if (!q.summary.empty()) return q.convert(numbers.summary(run, q.summary));
  const Numbers& t = numbers.table(run, q.table);
  if (t.rows.empty()) throw RunError(fmt::format("{} of run {} has no rows", q.table, run));
  const std::vector<double> y = columnOf(t, q.column, q.scale, q.offset);
  if (!q.at) return y.back();
  return interpolate(columnOf(t, q.along.empty() ? t.columns.front() : q.along, 1, 0), y, *q.at);
}

double numberOf(const Quantity& q, const RunNumbers& numbers) {
  std::vector<double> all;
  double sum = 0;
  for (const std::string& run : q.runs) all.push_back(numberOf(q, run, numbers)), sum += all.back();
  for (const double v : all)
    if (!std::isfinite(v)) return v;
  std::sort(all.begin(), all.end());
  const std::size_t n = all.size();
  switch (q.of) {
    case Quantity::Of::median:
      return 0.5 * (all[(n - 1) / 2] + all[n / 2]);
    case Quantity::Of::mean:
      return sum / static_cast<double>(n);
    case Quantity::Of::least:
      return all.front();
    case Quantity::Of::largest:
      return all.back();
  }
  return all.front();
}

/// Reference, tolerance and verdict for a measured number.
void decide(const Check& c, double measured, Result& r) {
  r.measured = measured;
  if (c.reference) {
    r.reference = c.reference;
    r.tolerance = c.absolute ? *c.absolute : *c.relative * std::abs(*c.reference);
    r.passed = std::abs(measured - *c.reference) <= *r.tolerance;
  } else if (c.at_least) {
    r.reference = c.at_least;
    r.passed = measured >= *c.at_least;
    r.note = "at least" + (r.note.empty() ? "" : "; " + r.note);
  } else if (!c.at_most) {
    r.passed = true;
  } else {
    r.reference = c.at_most;
    r.passed = measured <= *c.at_most;
    r.note = "at most" + (r.note.empty() ? "" : "; " + r.note);
  }
}

Result resultOf(const Reference& reference, const Check& c, const std::string& run, bool gated) {
  Result r;
  r.id = reference.id;
  r.source = reference.source;
  r.quantity = gated || run.empty() ? c.quantity : c.quantity + " (" + run + ")";
  const bool deviation = c.kind == Check::Kind::curve || c.kind == Check::Kind::table;
  r.unit = deviation && c.unit.empty() ? "of the largest" : c.unit;
  r.item = c.item;
  if (c.priority == Check::Priority::must) r.priority = "must";
  if (c.priority == Check::Priority::should) r.priority = "should";
  if (c.priority == Check::Priority::nice) r.priority = "nice";
  r.gated = gated && c.gates();
  r.note = c.note;
  if (!c.gates()) r.why = c.why.empty() ? reference.why : c.why;
  return r;
}

/// Does `fill`, and fails the result where a number is missing.
template <class Fill>
Result attempt(Result r, Fill fill) {
  try {
    fill(r);
    if (r.measured && !std::isfinite(*r.measured)) {
      r.passed = false;
      r.measured.reset();
      r.note = "not a finite number";
    }
  } catch (const std::exception& e) {
    r.passed = false;
    r.measured.reset();
    r.note = e.what();
  }
  return r;
}

double valueOf(const Check& c, const std::string& instead, const RunNumbers& numbers) {
  const auto number = [&](Quantity q) {
    // A coarser mesh takes the place of the mesh that is gated, wherever that one is used.
    if (!instead.empty())
      for (std::string& run : q.runs)
        if (run == c.of.runs.front()) run = instead;
    return numberOf(q, numbers);
  };
  double v = number(c.of);
  if (c.minus) v -= number(*c.minus);
  if (c.period) v = wrapped(v, *c.period);
  if (c.over) v /= number(*c.over);
  return v;
}

Course courseOf(const RunCourse& h, const RunNumbers& numbers) {
  const Numbers& t = numbers.table(h.run, h.table);
  Course course;
  std::vector<std::size_t> at;
  for (const std::string& name : h.columns) at.push_back(t.find(name));
  for (const auto& row : t.rows) {
    course.time_s.push_back(row.front());
    double v = h.of == RunCourse::Of::largest ? -std::numeric_limits<double>::infinity() : 0;
    for (const std::size_t c : at)
      if (h.of == RunCourse::Of::magnitude)
        v = std::hypot(v, row[c]);
      else if (h.of != RunCourse::Of::largest)
        v += row[c];
      else if (!(v >= row[c]))  // a NaN wins
        v = row[c];
    if (h.of == RunCourse::Of::mean) v /= static_cast<double>(at.size());
    course.value.push_back(h.scale * v);
  }
  return course;
}

double measureOf(const Check& c, const RunNumbers& numbers, Shown& shown) {
  const auto part = [&](const RunCourse& h) {
    return within(courseOf(h, numbers), h.from_s.value_or(c.from_s), h.to_s.value_or(c.to_s));
  };
  Course a = part(*c.first), b;
  const auto show = [&](const RunCourse& h, const Course& x) {
    shown.measured.push_back({h.run + ": " + schema::joined(h.columns), x.time_s, x.value});
  };
  show(*c.first, a);
  if (c.second) {
    switch (c.course) {
      case Check::Course::peak_ratio:
      case Check::Course::mean_ratio:
      case Check::Course::peak_time:
      case Check::Course::last_ratio:
      case Check::Course::half_time:
        b = part(*c.second);
        break;
      default:
        b = resampled(courseOf(*c.second, numbers), a, c.shift_s);
        b = within(b, a.time_s.front(), a.time_s.back());
    }
    show(*c.second, b);
  }
  switch (c.course) {
    case Check::Course::correlation:
      return correlation(a.value, b.value);
    case Check::Course::difference:
      return differenceOverPeak(a.value, b.value);
    case Check::Course::rank:
      return rankCorrelation(a.time_s, a.value);
    case Check::Course::peak:
      return largestOf(a.value).value;
    case Check::Course::peak_ratio:
      return largestOf(a.value).value / largestOf(b.value).value;
    case Check::Course::peak_time: {
      const auto most = std::max_element(b.value.begin(), b.value.end()) - b.value.begin();
      return a.time_s[largestOf(a.value).at] - b.time_s[static_cast<std::size_t>(most)];
    }
    case Check::Course::mean:
      return meanOf(a.value);
    case Check::Course::mean_ratio:
      return meanOf(a.value) / meanOf(b.value);
    case Check::Course::growth:
      return std::abs(a.value.back() / a.value.front());
    case Check::Course::last_ratio:
      return std::abs(a.value.back() / b.value.back());
    case Check::Course::other_at_peak: {
      const Largest most = largestOf(a.value);
      return std::abs(b.value[most.at]) / most.value;
    }
    case Check::Course::greater_share:
      return greaterShare(a.value, b.value);
    case Check::Course::linearity: {
      const double r = correlation(a.time_s, a.value);
      return r * r;
    }
    case Check::Course::half_time:
      return halfTime(a) - halfTime(b);
  }
  return 0;
}

/// Judges the gated run, then the others in the order in which they are written (coarse to fine), so that the page
/// shows convergence.
template <class Measure>
void judgeEach(const Reference& reference, const Check& c, const std::string& gated, Measure measure, Judged& out) {
  out.results.push_back(attempt(resultOf(reference, c, gated, true), [&](Result& r) { measure(gated, true, r); }));
  for (const std::string& run : c.also) {
    out.results.push_back(attempt(resultOf(reference, c, run, false), [&](Result& r) { measure(run, false, r); }));
    out.results.back().other_run = true;
    if (out.results.back().measured) out.convergence.emplace_back(run, *out.results.back().measured);
  }
  if (!c.also.empty() && out.results.front().measured)
    out.convergence.emplace_back(gated, *out.results.front().measured);
}

/// Column `name` of the published table.
std::vector<double> published(const Reference& reference, const std::string& name) {
  const auto& all = reference.table.columns;
  const auto c = static_cast<std::size_t>(std::find(all.begin(), all.end(), name) - all.begin());
  std::vector<double> values;
  for (const auto& row : reference.table.rows) values.push_back(row[c]);
  return values;
}

double largestOf(const std::vector<double>& v) {
  double most = 0;
  for (const double x : v) most = std::max(most, std::abs(x));
  return most;
}

/// curve: distance of each published point from the run's polyline, both axes divided by their largest published
/// value. table: |y - published y| at the published x, over the column's largest value.
void judgeRows(const Reference& reference, const Check& c, const RunNumbers& numbers, Judged& out) {
  const std::vector<double> px = published(reference, c.x.reference), py = published(reference, c.y.reference);
  const double sx = largestOf(px), sy = largestOf(py);
  std::vector<bool> row_gated(px.size(), true);
  if (c.reported) {
    const std::vector<double> v = published(reference, c.reported->column);
    for (std::size_t i = 0; i < v.size(); ++i) row_gated[i] = !(v[i] >= c.reported->from && v[i] <= c.reported->to);
  }
  Shown shown;
  shown.title = c.quantity;
  shown.x_name = c.x.reference;
  shown.y_name = c.y.reference;
  shown.reference = {"published", px, py};
  double worst_reported = 0;
  const auto measure = [&](const std::string& run, bool gated, Result& r) {
    r.reference = 0;
    r.tolerance = c.bound;
    const Numbers& t = numbers.table(run, c.file);
    if (t.rows.empty()) throw RunError(fmt::format("{} of run {} has no rows", c.file, run));
    const std::vector<double> x = columnOf(t, c.x.column, c.x.scale, c.x.offset);
    const std::vector<double> y = columnOf(t, c.y.column, c.y.scale, c.y.offset);
    shown.measured.push_back({run, x, y});
    if (std::any_of(x.begin(), x.end(), [](double v) { return !std::isfinite(v); }) ||
        std::any_of(y.begin(), y.end(), [](double v) { return !std::isfinite(v); }))
      throw RunError(fmt::format("{} of run {} holds numbers that are not finite", c.file, run));
    double worst = 0;
    for (std::size_t i = 0; i < px.size(); ++i) {
      Shown::Row row{px[i], py[i], px[i], 0, 0, row_gated[i]};
      if (c.kind == Check::Kind::curve) {
        const Nearest near = nearestOnPolyline(x, y, px[i], py[i], sx, sy);
        row.measured_x = near.x;
        row.measured_y = near.y;
        row.deviation = near.distance;
      } else {
        row.measured_y = c.interpolated ? interpolate(x, y, px[i]) : hit(x, y, px[i]);
        row.deviation = std::abs(row.measured_y - py[i]) / sy;
      }
      if (gated) shown.rows.push_back(row);
      if (row.gated)
        worst = std::max(worst, row.deviation);
      else if (gated)
        worst_reported = std::max(worst_reported, row.deviation);
    }
    r.measured = worst;
    r.passed = worst <= c.bound;
  };
  judgeEach(reference, c, c.run, measure, out);
  // The finest mesh is drawn last and named last.
  if (!shown.measured.empty() && shown.measured.front().name == c.run)
    std::rotate(shown.measured.begin(), shown.measured.begin() + 1, shown.measured.end());
  if (c.reported && out.results.front().measured) {
    Result r = resultOf(reference, c, "", true);
    r.quantity = fmt::format("{}, rows {} to {} of {} (reported)", c.quantity, c.reported->from, c.reported->to,
                             c.reported->column);
    r.measured = worst_reported;
    r.reference = 0;
    r.tolerance = c.bound;
    r.passed = worst_reported <= c.bound;
    r.gated = false;
    out.results.push_back(r);
  }
  out.shown = std::move(shown);
}

/// Order p of |u_h - u|^power = C h^p between the last two runs. Without the limit u, from three: with
/// d_i = u_i - u_{i+1} and sizes in geometric progression, |d_1/d_2|^power = (h_1/h_2)^p.
void judgeRate(const Reference& reference, const Check& c, const RunNumbers& numbers, Judged& out) {
  Shown shown;
  shown.title = c.quantity;
  shown.x_name = "size";
  shown.y_name = c.exact ? "error" : "difference to the next finer";
  shown.logarithmic = true;
  out.results.push_back(attempt(resultOf(reference, c, "", true), [&](Result& r) {
    std::vector<double> u, error;
    for (const std::string& run : c.runs) {
      u.push_back(numberOf(c.of, run, numbers));
      out.convergence.emplace_back(run, u.back());
    }
    const std::size_t n = u.size();
    if (c.exact)
      for (const double v : u) error.push_back(std::pow(std::abs(v - *c.exact), c.power));
    else
      for (std::size_t i = 0; i + 1 < n; ++i) error.push_back(std::pow(std::abs(u[i] - u[i + 1]), c.power));
    const std::size_t m = error.size();
    if (!(error[m - 1] > 0)) throw RunError("the error of the finest run is 0: there is no rate");
    shown.measured.push_back({"measured", {c.sizes.begin(), c.sizes.begin() + static_cast<std::ptrdiff_t>(m)}, error});
    decide(c, std::log(error[m - 2] / error[m - 1]) / std::log(c.sizes[m - 2] / c.sizes[m - 1]), r);
    if (!c.reference) return;
    // A line of the published slope through the finest error.
    shown.reference.name = fmt::format("order {}", *c.reference);
    for (std::size_t i = 0; i < m; ++i) {
      shown.reference.x.push_back(c.sizes[i]);
      shown.reference.y.push_back(error[m - 1] * std::pow(c.sizes[i] / c.sizes[m - 1], *c.reference));
    }
  }));
  out.shown = std::move(shown);
}

void judgeCourse(const Reference& reference, const Check& c, const RunNumbers& numbers, Judged& out) {
  Shown shown;
  shown.title = c.item.empty() ? c.quantity : c.item + ": " + c.quantity;
  shown.x_name = "time [s]";
  shown.y_name = c.unit;
  out.results.push_back(
      attempt(resultOf(reference, c, "", true), [&](Result& r) { decide(c, measureOf(c, numbers, shown), r); }));
  if (!shown.measured.empty()) out.shown = std::move(shown);
}

/// Number of crests of a closed profile, or mean distance of the crests of an open one.
void judgeWaves(const Reference& reference, const Check& c, const RunNumbers& numbers, Judged& out) {
  Shown shown;
  shown.title = c.quantity;
  shown.x_name = c.x.column;
  shown.y_name = c.with ? "radius" : c.y.column;
  const auto wavesOf = [&](const std::string& run) {
    Numbers t = numbers.table(run, c.file);
    if (c.where)
      std::erase_if(t.rows, [column = t.find(c.where->column), &w = *c.where](const std::vector<double>& row) {
        return !(row[column] >= w.from && row[column] <= w.to);
      });
    const std::vector<double> x = columnOf(t, c.x.column, c.x.scale, c.x.offset);
    std::vector<double> y = columnOf(t, c.y.column, c.y.scale, c.y.offset);
    if (c.with) {
      const std::vector<double> z = columnOf(t, c.with->column, c.with->scale, c.with->offset);
      for (std::size_t i = 0; i < y.size(); ++i) y[i] = std::hypot(y[i], z[i]);
    }
    if (y.size() < 3) throw RunError(fmt::format("{} of run {} has less than three rows", c.file, run));
    for (std::size_t i = 0; i < y.size(); ++i)
      if (!std::isfinite(x[i]) || !std::isfinite(y[i]))
        throw RunError(fmt::format("{} of run {} holds numbers that are not finite", c.file, run));
    shown.measured.push_back({run, x, y});
    const auto [low, high] = std::minmax_element(y.begin(), y.end());
    const std::vector<std::size_t> at = crests(y, c.prominence * (*high - *low), c.closed);
    if (c.closed) return static_cast<double>(at.size());
    if (at.size() < 2) throw RunError(fmt::format("run {} has {} crests: no distance", run, at.size()));
    return std::abs(x[at.back()] - x[at.front()]) / static_cast<double>(at.size() - 1);
  };
  if (c.runs.empty()) {
    judgeEach(
        reference, c, c.run, [&](const std::string& run, bool, Result& r) { decide(c, wavesOf(run), r); }, out);
  } else {
    out.results.push_back(attempt(resultOf(reference, c, "", true), [&](Result& r) {
      const auto medianOf = [&](const std::vector<std::string>& runs) {
        std::vector<double> all;
        for (const std::string& run : runs) {
          all.push_back(wavesOf(run));
          out.convergence.emplace_back(run, all.back());
        }
        std::sort(all.begin(), all.end());
        return 0.5 * (all[(all.size() - 1) / 2] + all[all.size() / 2]);
      };
      Check goal = c;
      if (!c.reference_runs.empty()) goal.reference = medianOf(c.reference_runs);
      decide(goal, medianOf(c.runs), r);
    }));
  }
  out.shown = std::move(shown);
}

/// Wavelength or angle of straight wrinkles.
void judgeWrinkles(const Reference& reference, const Check& c, const RunNumbers& numbers, Judged& out) {
  Shown shown;
  shown.title = c.quantity + ": middle line";
  shown.x_name = c.x.column;
  shown.y_name = c.height.column;
  const auto measure = [&](const std::string& run, bool, Result& r) {
    const Numbers& t = numbers.table(run, c.file);
    const Wrinkles found =
        wrinklesOf(columnOf(t, c.x.column, c.x.scale, c.x.offset), columnOf(t, c.y.column, c.y.scale, c.y.offset),
                   columnOf(t, c.height.column, c.height.scale, c.height.offset), c.margin, c.prominence);
    shown.measured.push_back({run, found.x, found.w});
    decide(c, c.measure == Check::Measure::angle ? found.angle_deg : found.wavelength, r);
  };
  judgeEach(reference, c, c.run, measure, out);
  out.shown = std::move(shown);
}

}  // namespace

Judged judge(const Reference& reference, const Check& check, const RunNumbers& numbers) {
  Judged out;
  switch (check.kind) {
    case Check::Kind::value:
      judgeEach(
          reference, check, check.of.runs.size() == 1 ? check.of.runs.front() : "",
          [&](const std::string& run, bool gated, Result& r) {
            decide(check, valueOf(check, gated ? "" : run, numbers), r);
          },
          out);
      break;
    case Check::Kind::course:
      judgeCourse(reference, check, numbers, out);
      break;
    case Check::Kind::curve:
    case Check::Kind::table:
      judgeRows(reference, check, numbers, out);
      break;
    case Check::Kind::rate:
      judgeRate(reference, check, numbers, out);
      break;
    case Check::Kind::waves:
      judgeWaves(reference, check, numbers, out);
      break;
    case Check::Kind::wrinkles:
      judgeWrinkles(reference, check, numbers, out);
      break;
  }
  return out;
}

}  // namespace gambeson::verify
