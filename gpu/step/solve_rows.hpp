#pragma once
/// What the rows of a step are to its solve, on a device: what core/contact/contact_rows.cpp and response.cpp make of
/// rows before and between sweeps, a row, a sample or a point at a time, with the same sums in the same order.

#include "core/contact/row_sweep.hpp"
#include "gpu/forces/sliced_rows.hpp"
#include "gpu/near/raise.hpp"
#include "gpu/solve/solve_data.hpp"
#include "gpu/step/step_rows.hpp"

namespace gambeson::gpu {

/// What does not change from step to step.
struct SolveModel {
  SlicedView WT, WTt;
  const double* inverse_mass;             ///< of free points
  const double *area_m2, *density;        ///< of samples
  const double *of_obstacle, *of_sample;  ///< mu of an obstacle, below 0: that of the sample
  double on_cloth;                        ///< mu of cloth on cloth
  int points, samples;
  const int* place;  ///< of samples, of so many: core's Model::place
  int places;
};

/// How far a solve may go.
struct SolveLimits {
  double tolerance_m_per_s;
  int most;  ///< iterations
};

/// What is known of a solve on its way. Counts and largest values only: no order of lanes shows.
struct SolveFacts {
  Count residual = 0, left_out = 0;  ///< inOrder: of islands, and squared of rows that are left out [m/s]
  Count largest = 0;                 ///< inOrder: of what the tractions at the start ask for [m/s]
  int iterations = 0, undone = 0;    ///< of islands: most, and how many are not done
  int joins = 0;                     ///< rows that are left out and would be penetrated
  int islands = 0, rows = 0, points = 0;
  int most_rows = 0;         ///< of an island
  int parts = 0, large = 0;  ///< of islands: those that become chunks, and islands of several
  int cut = 0;               ///< parts of these
  int chunk_points = 0;      ///< theirs, behind all points
  Count bits = 0;            ///< words that islands of several parts ask for; above the room: there are too few
  Count reach = 0;           ///< entries of the points of rows that were asked for; above the room: there are too few
  int others = 0;            ///< entries of rows that have no fixed place
  SweepLimits limits{};      ///< of the sweeps that are next, or were last
  bool ended = false;        ///< iterating
  double residual_m_per_s = 0;  ///< as a report has it
  bool converged = false;       ///< likewise
};
GAMBESON_HD inline double numberOf(Count order) { return order == 0 ? 0.0 : fromOrder(order); }

/// Of each sample: rows that have it in their stencils, on-cloth rows that it is nearest in, rows that begin with it.
enum RowsOfSample : int { kParts, kOnCloth, kBegins, kRowLists };
constexpr int kPartsOfRow = 8;  ///< five samples of a stencil, two of rows on cloth, the one that it begins with

struct SolveRows {
  StepRows rows;
  int *of_sample, *begin;  ///< lengths of the lists of kRowLists * samples, and where they begin
  int* on_body;            ///< rows of each sample on bodies
  int *place, *listed;     ///< kPartsOfRow to a row: its number in a list; row * kPartsOfRow + part
  // Of rows.
  double *area_m2, *friction, *slope;
  Vec3* start;            ///< v - drift as the points would move without any contact
  Vec3* sample_velocity;  ///< as the points move
  char* in;               ///< is iterated on
  RowState* state;
  // Of points.
  const Vec3* predicted;
  Vec3 *moved, *moved_before;
  SolveFacts* facts;

  GAMBESON_HD int list(int samples, RowsOfSample which, int sample) const { return which * samples + sample; }
  GAMBESON_HD bool onCloth(int i) const { return rows.facts[i].kind == kSampleOnCloth && rows.facts[i].obstacle < 0; }
};

/// sum_k row[k] v[column[k]], as core sums it.
GAMBESON_HD inline Vec3 sumOver(const SlicedView& rows, int row, const Vec3* v) {
  Vec3 sum{};
  const int at = rows.first[row >> 5] + (row & 31);
  for (int k = 0; k < rows.length[row]; ++k) sum += rows.value[at + 32 * k] * v[rows.column[at + 32 * k]];
  return sum;
}

struct ClearRowLists {
  SolveRows s;
  int samples;
  GAMBESON_HD void operator()(int k) const {
    if (k == 0) *s.facts = {};
    s.of_sample[k] = 0;
    if (k < samples) s.on_body[k] = 0;
  }
};

struct CountRows {
  SolveRows s;
  int samples;
  GAMBESON_HD void operator()(int i) const {
    const ContactStencil& at = s.rows.stencil[i];
    const ContactFacts& f = s.rows.facts[i];
    int* const place = s.place + kPartsOfRow * i;
    for (int j = 0; j < at.count; ++j) place[j] = fetchAdd(&s.of_sample[s.list(samples, kParts, at.sample[j])], 1);
    if (s.onCloth(i)) {
      place[5] = fetchAdd(&s.of_sample[s.list(samples, kOnCloth, f.sample)], 1);
      if (f.partner >= 0) place[6] = fetchAdd(&s.of_sample[s.list(samples, kOnCloth, f.partner)], 1);
    }
    place[7] = fetchAdd(&s.of_sample[s.list(samples, kBegins, at.sample[0])], 1);
    if (f.obstacle >= 0) fetchAdd(&s.on_body[f.sample], 1);
  }
};
struct PlaceRows {
  SolveRows s;
  int samples;
  GAMBESON_HD void operator()(int i) const {
    const ContactStencil& at = s.rows.stencil[i];
    const ContactFacts& f = s.rows.facts[i];
    const auto put = [&](RowsOfSample which, int sample, int part) {
      s.listed[s.begin[s.list(samples, which, sample)] + s.place[kPartsOfRow * i + part]] = kPartsOfRow * i + part;
    };
    for (int j = 0; j < at.count; ++j) put(kParts, at.sample[j], j);
    if (s.onCloth(i)) {
      put(kOnCloth, f.sample, 5);
      if (f.partner >= 0) put(kOnCloth, f.partner, 6);
    }
    put(kBegins, at.sample[0], 7);
  }
};
/// A list in the order of rows and their parts; few.
struct SortRows {
  SolveRows s;
  GAMBESON_HD void operator()(int list) const {
    int* const mine = s.listed + s.begin[list];
    const int n = s.of_sample[list];
    for (int a = 1; a < n; ++a) {
      const int one = mine[a];
      int b = a;
      for (; b > 0 && mine[b - 1] > one; --b) mine[b] = mine[b - 1];
      mine[b] = one;
    }
  }
};

struct MoveSamplesWith {
  SlicedView WT;
  const Vec3* points;
  Vec3* samples;
  GAMBESON_HD void operator()(int sample) const { samples[sample] = sumOver(WT, sample, points); }
};

/// Area, friction and slope of a row, how it would move without contacts, and whether it carried something.
struct StartRows {
  SolveModel m;
  SolveRows s;
  GAMBESON_HD void operator()(int i) const {
    const ContactStencil& at = s.rows.stencil[i];
    const ContactFacts& f = s.rows.facts[i];
    const RowTerms& t = s.rows.terms[i];
    s.area_m2[i] = moves(at) ? areaOf(i) : 0;
    double mu = m.on_cloth;
    if (f.obstacle >= 0) {
      mu = m.of_obstacle[f.obstacle];
      if (mu < 0) mu = m.of_sample[at.sample[0]];
    }
    s.friction[i] = mu;
    double slope = 0;
    for (int j = 0; j < at.count; ++j) slope += std::abs(at.weight[j]) / m.density[at.sample[j]];
    s.slope[i] = slope + t.compliance;
    s.start[i] = velocityOf(i);
    s.in[i] = s.area_m2[i] > 0 && !(s.rows.traction[i] == Vec3{});
  }

  /// Relative velocity less drift.
  GAMBESON_HD Vec3 velocityOf(int i) const {
    const ContactFacts& f = s.rows.facts[i];
    const ContactStencil& at = s.rows.stencil[i];
    Vec3 all = -(f.body_velocity + s.rows.terms[i].target_m_per_s * f.normal);
    for (int j = 0; j < at.count; ++j) all += at.weight[j] * s.sample_velocity[at.sample[j]];
    return all;
  }

 private:
  GAMBESON_HD bool moves(const ContactStencil& at) const {
    for (int j = 0; j < at.count; ++j) {
      const int row = at.sample[j], first = m.WT.first[row >> 5] + (row & 31);
      for (int k = 0; k < m.WT.length[row]; ++k)
        if (at.weight[j] * m.WT.value[first + 32 * k] != 0 && m.inverse_mass[m.WT.column[first + 32 * k]] > 0)
          return true;
    }
    return false;
  }
  GAMBESON_HD double areaOf(int i) const {
    const ContactStencil& at = s.rows.stencil[i];
    const ContactFacts& f = s.rows.facts[i];
    double a = 0;
    if (f.kind == kEdgeOnEdge || (f.obstacle >= 0 && at.count > 1)) {
      for (int k = 0; k < at.count; ++k) a += 0.125 * std::abs(at.weight[k]) * m.area_m2[at.sample[k]];
    } else if (f.kind == kSampleOnCloth) {
      a = 0.5 * m.area_m2[f.sample] / sharedBy(f.sample, f.normal);
      if (f.partner >= 0) a += 0.5 * m.area_m2[f.partner] / sharedBy(f.partner, -f.normal);
    } else {
      a = m.area_m2[f.sample] / s.on_body[f.sample];
    }
    return a;
  }
  /// How many rows of a sample lie on the side of it that `normal` points from.
  GAMBESON_HD int sharedBy(int sample, const Vec3& normal) const {
    const int list = s.list(m.samples, kOnCloth, sample), begin = s.begin[list], end = begin + s.of_sample[list];
    int count = 0;
    for (int k = begin; k < end; ++k) {
      const ContactFacts& f = s.rows.facts[s.listed[k] / kPartsOfRow];
      count += (f.sample == sample ? 1 : -1) * dot(f.normal, normal) > 0;
    }
    return count > 1 ? count : 1;
  }
};

/// Families whose starts are smoothed: on bodies, and on the two sides of cloth; -1: none (smoothWarm).
GAMBESON_HD inline int familyOf(const SolveRows& s, int i) {
  if (!s.in[i]) return -1;
  const ContactFacts& f = s.rows.facts[i];
  if (f.obstacle >= 0) return s.rows.stencil[i].count == 1 ? 0 : -1;
  if (f.kind != kSampleOnCloth) return -1;
  const Vec3 side{0.6180, 0.4142, 0.7321};
  return dot(f.normal, side) > 0 ? 1 : 2;
}

/// Sums of a family over the rows of a sample, and over the samples of a point.
struct FamilySums {
  Vec3 on_body;
  double body_area = 0;
  double side[2] = {}, side_area[2] = {};
};
struct SmoothSamples {
  SolveRows s;
  int samples;
  FamilySums* of_sample;
  GAMBESON_HD void operator()(int sample) const {
    FamilySums sums;
    const int list = s.list(samples, kBegins, sample), begin = s.begin[list], end = begin + s.of_sample[list];
    for (int k = begin; k < end; ++k) {
      const int i = s.listed[k] / kPartsOfRow, family = familyOf(s, i);
      if (family < 0) continue;
      const Vec3& t = s.rows.traction[i];
      if (family == 0) {
        sums.on_body += s.area_m2[i] * t;
        sums.body_area += s.area_m2[i];
      } else {
        sums.side[family - 1] += s.area_m2[i] * dot(t, s.rows.facts[i].normal);
        sums.side_area[family - 1] += s.area_m2[i];
      }
    }
    of_sample[sample] = sums;
  }
};
struct SmoothPoints {
  SolveModel m;
  const FamilySums* of_sample;
  FamilySums* of_point;  ///< means where there is any
  GAMBESON_HD void operator()(int f) const {
    FamilySums sums;
    const int at = m.WTt.first[f >> 5] + (f & 31);
    for (int k = 0; k < m.WTt.length[f]; ++k) {
      const double N = m.WTt.value[at + 32 * k];
      const FamilySums& add = of_sample[m.WTt.column[at + 32 * k]];
      sums.on_body += N * add.on_body;
      sums.body_area += N * add.body_area;
      for (int j = 0; j < 2; ++j) {
        sums.side[j] += N * add.side[j];
        sums.side_area[j] += N * add.side_area[j];
      }
    }
    if (sums.body_area > 0) sums.on_body = sums.on_body / sums.body_area;
    for (int j = 0; j < 2; ++j)
      if (sums.side_area[j] > 0) sums.side[j] = sums.side[j] / sums.side_area[j];
    of_point[f] = sums;
  }
};
/// Where the iteration of a row starts, with the impulse of that.
struct SmoothRows {
  SolveModel m;
  SolveRows s;
  const FamilySums* of_point;
  GAMBESON_HD void operator()(int i) const {
    constexpr double kMix = 0.2;
    const ContactFacts& f = s.rows.facts[i];
    Vec3 start{};
    if (s.in[i]) {
      const Vec3 warm = start = s.rows.traction[i];
      if (const int family = familyOf(s, i); family >= 0) {
        const Vec3 part = family == 0 ? warm : Vec3{dot(warm, f.normal), 0, 0};
        Vec3 smooth{};
        double whole = 0;
        const int row = f.sample, at = m.WT.first[row >> 5] + (row & 31);
        for (int k = 0; k < m.WT.length[row]; ++k) {
          const int point = m.WT.column[at + 32 * k];
          const double N = m.WT.value[at + 32 * k];
          if (!(m.inverse_mass[point] > 0)) continue;
          smooth += N * (family == 0 ? of_point[point].on_body : Vec3{of_point[point].side[family - 1], 0, 0});
          whole += N;
        }
        if (whole > 0) {
          const Vec3 change = kMix * (smooth / whole - part);
          start += family == 0 ? change : change.x * f.normal;
        }
      }
      if (!(start == Vec3{})) start = project(start, f.normal, s.friction[i], 0.0);
    }
    s.state[i] = {start, start};
    s.rows.impulse[i] = s.area_m2[i] * start;
  }
};

/// What the rows' impulses are together on a sample, and what they do to a point (spreadImpulses).
struct SpreadSamples {
  SolveRows s;
  int samples;
  Vec3* sum;
  GAMBESON_HD void operator()(int sample) const {
    const int list = s.list(samples, kParts, sample), begin = s.begin[list], end = begin + s.of_sample[list];
    Vec3 all{};
    for (int k = begin; k < end; ++k) {
      const int i = s.listed[k] / kPartsOfRow, part = s.listed[k] % kPartsOfRow;
      if (s.rows.impulse[i] == Vec3{}) continue;
      all += s.rows.stencil[i].weight[part] * s.rows.impulse[i];
    }
    sum[sample] = all;
  }
};
struct SpreadPoints {
  SolveModel m;
  const Vec3 *sum, *from;  ///< from: without contacts
  GAMBESON_HD Vec3 operator()(int f) const {
    Vec3 change = sumOver(m.WTt, f, sum);
    change *= m.inverse_mass[f];
    return from[f] + change;
  }
};
struct StartPoints {
  SpreadPoints spread;
  Vec3 *moved, *moved_before;
  GAMBESON_HD void operator()(int f) const { moved[f] = moved_before[f] = spread(f); }
};
struct EndPoints {
  SpreadPoints spread;
  Point4* to;
  GAMBESON_HD void operator()(int f) const {
    const Vec3 v = spread(f);
    to[f] = {v.x, v.y, v.z, 0.0};
  }
};
struct ToVectors {
  const Point4* from;
  Vec3* to;
  GAMBESON_HD void operator()(int f) const { to[f] = vec(from[f]); }
};

/// Rows that are left out and would be penetrated join; the largest squared residual of those left out. The others take
/// what sweeps have found.
struct LookAtLeftOut {
  StartRows rows;
  const double* swept;  ///< RowState; none: before the first one
  const int* place;
  GAMBESON_HD void operator()(int i) const {
    const SolveRows& s = rows.s;
    if (s.in[i]) {
      if (swept)
        s.state[i] = RowState::of(swept, place[i]);
      else
        raise(&s.facts->largest, inOrder(s.slope[i] * norm(s.state[i].now)));
      return;
    }
    if (s.area_m2[i] == 0) return;
    const Vec3& normal = s.rows.facts[i].normal;
    const Vec3 v = rows.velocityOf(i);
    if (!(dot(v, normal) < 0)) return;
    s.in[i] = 1;
    fetchAdd(&s.facts->joins, 1);
    raise(&s.facts->left_out, inOrder(norm2(project(-v, normal, s.friction[i], 0.0))));
  }
};

}  // namespace gambeson::gpu
