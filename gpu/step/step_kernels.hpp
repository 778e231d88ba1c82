#pragma once
/// Kernels of a step (core/motion/step.cpp) over free points, samples and rows.

#include "core/contact/response.hpp"
#include "gpu/forces/sliced_rows.hpp"
#include "gpu/near/raise.hpp"
#include "gpu/near/near_search.hpp"
#include "gpu/near/warm_starts.hpp"
#include "gpu/step/impact_kernels.hpp"
#include "gpu/step/solve_rows.hpp"
#include "gpu/step/step_rows.hpp"

namespace gambeson::gpu {

GAMBESON_HD inline Point4 point4(const Vec3& v) { return {v.x, v.y, v.z, 0.0}; }
GAMBESON_HD inline bool isFinite(const Vec3& v) {
  const double zero = 0 * (v.x + v.y + v.z);
  return zero == 0;
}

/// What the motion of a step shows of frequencies (ControlledSteps::shownFrequency2).
struct MotionSum {
  double force2 = 0, way2 = 0;
  GAMBESON_HD void add(const MotionSum& more) { force2 += more.force2, way2 += more.way2; }
};

/// What a step has been found to be. Counts and largest values only: no order of lanes shows.
struct StepFacts {
  int not_finite = 0;  ///< velocities at the start that are not
  int lost = 0;        ///< likewise positions and accelerations at the end
  int inside = 0;      ///< samples that are inside of a body
  int cloth_contacts = 0;
  int active = 0;                          ///< rows that carry something
  int pressing = 0;                        ///< of these, such as press on their layer
  Count highest_gap = 0, largest_way = 0;  ///< inOrder: of minus the gaps; of ways, in sides of their cells
  Count most_jerk = 0;                     ///< likewise, squared, over squared lengths [1/s^4]
  MotionSum motion;

  double smallest_gap_m() const {
    return highest_gap == 0 ? std::numeric_limits<double>::max() : -fromOrder(highest_gap);
  }
  double mostJerk() const { return most_jerk == 0 ? 0 : fromOrder(most_jerk); }
  double way() const { return largest_way == 0 ? 0 : fromOrder(largest_way); }
};

/// What a step starts from, of free points.
struct PointState {
  const Point4 *position, *velocity, *acceleration, *pressed;
};

/// v at the half step without what this step's contacts give (eq. 3.11).
struct Predict {
  PointState in;
  double half_s;
  Point4* predictor;
  StepFacts* facts;
  GAMBESON_HD void operator()(int i) const {
    const Vec3 v = (vec(in.velocity[i]) + half_s * vec(in.acceleration[i])) - half_s * vec(in.pressed[i]);
    predictor[i] = point4(v);
    if (!isFinite(v)) fetchAdd(&facts->not_finite, 1);
  }
};

/// Where a sample goes; nowhere without a number.
GAMBESON_HD inline Vec3 movedBy(const Vec3& way, const Vec3& from) { return isFinite(way) ? from + way : from; }

/// Where samples are, and where they go at these velocities of the free points.
struct PlaceSamples {
  SlicedView WT;
  const Point4 *position, *velocity;
  double dt_s;
  Vec3 *x0, *x1;
  GAMBESON_HD void operator()(int s) const {
    x0[s] = vec(WT.times(s, position));
    x1[s] = movedBy(dt_s * vec(WT.times(s, velocity)), x0[s]);
  }
};
struct MoveSamples {
  SlicedView WT;
  const Point4* velocity;
  double dt_s;
  const Vec3* x0;
  Vec3* x1;
  GAMBESON_HD void operator()(int s) const { x1[s] = movedBy(dt_s * vec(WT.times(s, velocity)), x0[s]); }
};

/// Pressures that count in the mean of what lasts (lastingPressure).
GAMBESON_HD inline double countsAtMost(double mean_Pa, double density) { return 2 * mean_Pa + 9.81 * density; }

GAMBESON_HD inline double densityOf(const ContactStencil& at, const double* density) {
  double sum = 0;
  for (int k = 0; k < at.count; ++k)
    if (at.weight[k] > 0) sum += at.weight[k] * density[at.sample[k]];
  return sum;
}

struct CopyCount {
  const Count* from;
  Count* to;
  GAMBESON_HD void operator()(int) const { *to = *from; }
};
struct CopyPoints {
  const Point4* from;
  Point4* to;
  GAMBESON_HD void operator()(int i) const { to[i] = from[i]; }
};

/// Vertices of a skin at both ends of the step.
struct PlaceSkin {
  const Vec3* bent;  ///< at the start, then at the end
  int vertices;
  Vec3 *x0, *x1;
  GAMBESON_HD void operator()(int v) const { x0[v] = bent[v], x1[v] = bent[vertices + v]; }
};
/// Of springs above a body that deforms, its normal under them (AnchorFrames::normal).
struct SpringNormals {
  const std::array<int, 3>* triangle;  ///< of each spring, -1: none
  const Vec3* x1;
  Point4* normal;
  GAMBESON_HD void operator()(int k) const {
    const int a = triangle[k][0];
    normal[k] = a < 0 ? Point4{} : point4(normalized(cross(x1[triangle[k][1]] - x1[a], x1[triangle[k][2]] - x1[a])));
  }
};

/// What persistent rows ask for, and where their solve starts (setPersistent of core/motion/step_rows.cpp).
struct SetTerms {
  StepRows rows;
  const WarmStart* warm;
  const double* density;
  double dt_s, kept, compliance_m_per_Pa, freed_m_per_s;
  GAMBESON_HD void operator()(const ContactFacts& f, Count i) const {
    const WarmStart& from = warm[i];
    const double rho = densityOf(rows.stencil[i], density);
    RowTerms t;
    t.mean_Pa = from.mean_Pa;
    const double depth = f.layer_m - f.gap_m;
    t.target_m_per_s = depth > 0 ? kept * depth / dt_s : depth / dt_s;
    if (atLayer(f.gap_m, f.layer_m)) {
      const double last = dot(from.traction, f.normal) / dt_s, gives = kept * compliance_m_per_Pa / dt_s;
      constexpr double kFast_mps = 5;
      double counted = from.mean_Pa > 0 ? 1.0 : 0.0;
      if (last > 0) {
        const double lasts = countsAtMost(from.mean_Pa, rho) / last, beyond = 1 - rho * kFast_mps / (dt_s * last);
        counted = lasts < 1 ? lasts : 1.0;
        if (beyond > counted) counted = beyond;
      }
      t.target_m_per_s -= gives * (1 - kept) * from.mean_Pa;
      t.compliance = gives * kept * counted / dt_s;
    }
    if (f.gap_m < 0 && t.target_m_per_s > freed_m_per_s) t.target_m_per_s = freed_m_per_s;
    rows.terms[i] = t;
    rows.traction[i] = from.traction;
    rows.impulse[i] = {};
  }
};

/// A pass of the search looks anew.
struct ForgetSeen {
  StepFacts* facts;
  GAMBESON_HD void operator()(int) const { facts->inside = facts->cloth_contacts = 0, facts->highest_gap = 0; }
};
/// What a pass of the search says of samples and of its contacts.
struct LookAtSamples {
  const char* inside;
  StepFacts* facts;
  GAMBESON_HD void operator()(int s) const {
    if (inside[s]) fetchAdd(&facts->inside, 1);
  }
};
struct LookAtContacts {
  const ContactStencil* stencil;
  const double* layer_m;  ///< of the samples
  StepFacts* facts;
  GAMBESON_HD void operator()(const ContactFacts& f, Count i) const {
    const bool body = f.kind == kSampleOnBody || f.kind == kEdgeOnBody;
    if (!body) fetchAdd(&facts->cloth_contacts, 1);
    double stands_out = 0;  // what the layer has of the clearance
    if (body) {
      double cloth = 0;
      for (int k = 0; k < stencil[i].count; ++k)
        cloth += std::abs(stencil[i].weight[k]) * layer_m[stencil[i].sample[k]];
      stands_out = f.clearance_m > cloth ? f.clearance_m - cloth : 0.0;
    }
    raise(&facts->highest_gap, inOrder(-(f.gap_m - stands_out)));
  }
};

/// The end of a step is looked at anew.
struct ForgetEnd {
  StepFacts* facts;
  GAMBESON_HD void operator()(int) const {
    facts->lost = facts->active = facts->pressing = 0;
    facts->largest_way = facts->most_jerk = 0;
  }
};
/// Where free points are at the end of the step.
struct MovePoints {
  const Point4 *from, *velocity;
  double dt_s;
  Point4* to;  ///< keeps its fourth number
  StepFacts* facts;
  GAMBESON_HD void operator()(int i) const {
    const Vec3 x = vec(from[i]) + dt_s * vec(velocity[i]);
    to[i].x = x.x, to[i].y = x.y, to[i].z = x.z;
    if (!isFinite(x)) fetchAdd(&facts->lost, 1);
  }
};
struct LookAtWays {
  const Vec3 *x0, *x1;
  const double* cell_m;
  StepFacts* facts;
  GAMBESON_HD void operator()(int s) const { raise(&facts->largest_way, inOrder(norm(x1[s] - x0[s]) / cell_m[s])); }
};

/// What rows leave: their part that lasts (pressingAccelerations), what the next step starts from (keepWarm), and
/// whether they carry anything.
struct LookAtRows {
  StepRows rows;
  const Count* contacts;  ///< the first so many are no appended impacts
  const double* density;
  double dt_s, kept;  ///< 1 - exp(-dt/tau)
  WarmStart* borne;
  double* share;  ///< of the impulse that lasts; 0: none
  int* active;
  StepFacts* facts;
  GAMBESON_HD void operator()(int k) const {
    const Count i = static_cast<Count>(k);
    active[k] = 0;
    if (i >= rows.size()) return;
    const ContactFacts& f = rows.facts[i];
    const RowTerms& t = rows.terms[i];
    const bool carries = !(rows.impulse[i] == Vec3{});
    share[i] = 0;
    if (carries) {
      active[k] = 1;
      fetchAdd(&facts->active, 1);
    }
    const double rho = densityOf(rows.stencil[i], density);
    const double pressed = dot(rows.traction[i], f.normal) / dt_s;
    const bool on_layer = atLayer(f.gap_m, f.layer_m);
    if (carries && t.impact == 0 && on_layer) {
      share[i] = pressed > 0 ? std::min(1.0, countsAtMost(t.mean_Pa, rho) / pressed) : 0.0;
      fetchAdd(&facts->pressing, 1);
    }
    if (i >= *contacts) return;
    borne[i] = {};
    if (t.impact != 0 || (t.mean_Pa == 0 && rows.traction[i] == Vec3{})) return;
    const double pressure = on_layer ? pressed : 0.0;
    borne[i].traction = rows.traction[i];
    borne[i].mean_Pa = t.mean_Pa + kept * (std::min(pressure, countsAtMost(t.mean_Pa, rho)) - t.mean_Pa);
  }
};

/// What rows give each sample, those of a sample in the order of the rows.
struct CountParts {
  StepRows rows;
  const double* share;
  int* of_sample;
  int* place;  ///< of each part, five to a row
  GAMBESON_HD void operator()(int k) const {
    const Count i = static_cast<Count>(k);
    if (i >= rows.size() || share[i] == 0) return;
    for (int j = 0; j < rows.stencil[i].count; ++j)
      place[5 * i + static_cast<Count>(j)] = fetchAdd(&of_sample[rows.stencil[i].sample[j]], 1);
  }
};
struct PlaceParts {
  StepRows rows;
  const double* share;
  const int *begin, *place;
  int* part;
  GAMBESON_HD void operator()(int k) const {
    const Count i = static_cast<Count>(k);
    if (i >= rows.size() || share[i] == 0) return;
    for (int j = 0; j < rows.stencil[i].count; ++j) {
      const Count at = 5 * i + static_cast<Count>(j);
      part[begin[rows.stencil[i].sample[j]] + place[at]] = static_cast<int>(at);
    }
  }
};
struct AddParts {
  StepRows rows;
  const double* share;
  const int *begin, *of_sample;
  int* part;
  Point4* sum;
  GAMBESON_HD void operator()(int s) const {
    int* const mine = part + begin[s];
    const int n = of_sample[s];
    for (int a = 1; a < n; ++a) {  // few
      const int one = mine[a];
      int b = a;
      for (; b > 0 && mine[b - 1] > one; --b) mine[b] = mine[b - 1];
      mine[b] = one;
    }
    Vec3 all{};
    for (int a = 0; a < n; ++a) {
      const int row = mine[a] / 5;
      all += (share[row] * rows.stencil[row].weight[mine[a] % 5]) * rows.impulse[row];
    }
    sum[s] = point4(all);
  }
};

/// What lasts of the contacts as accelerations of the free points, and the velocity that the forces start from.
struct PressPoints {
  SlicedView WTt;
  const Point4* sample_sum;
  const double* inverse_mass;
  double dt_s, half_s;
  const Point4* velocity;
  Point4 *pressed, *start;
  GAMBESON_HD void operator()(int i) const {
    const Vec3 c = (inverse_mass[i] / dt_s) * vec(WTt.times(i, sample_sum));
    pressed[i] = point4(c);
    start[i] = point4(vec(velocity[i]) + half_s * c);
  }
};

struct MotionOfPoint {
  const double* mass;
  const Point4 *position, *moved, *acceleration, *next;
  GAMBESON_HD MotionSum operator()(int i) const {
    return {mass[i] * norm2(vec(next[i]) - vec(acceleration[i])), mass[i] * norm2(vec(moved[i]) - vec(position[i]))};
  }
};
struct Jerk {
  const Point4 *acceleration, *next;
  Point4* to;
  GAMBESON_HD void operator()(int i) const { to[i] = point4(vec(next[i]) - vec(acceleration[i])); }
};
struct LookAtJerk {
  const NetEdge* net;
  const Point4* jerk;  ///< of control points
  StepFacts* facts;
  GAMBESON_HD void operator()(int e) const {
    raise(&facts->most_jerk, inOrder(norm2(vec(jerk[net[e].second]) - vec(jerk[net[e].first])) * net[e].per_length2));
  }
};
struct TakeSum {
  const MotionSum* from;
  StepFacts* facts;
  GAMBESON_HD void operator()(int) const { facts->motion = *from; }
};

/// All of a row that carries something, for the ledger of the step.
struct CarryingRow {
  ContactFacts facts;
  ContactStencil stencil;
  BodyTouch touch;
  RowTerms terms;
  Vec3 traction, impulse;
};
struct GatherRows {
  StepRows rows;
  const int *active, *place;
  CarryingRow* to;
  int room;
  GAMBESON_HD void operator()(int k) const {
    const Count i = static_cast<Count>(k);
    if (i >= rows.size() || active[k] == 0 || place[k] >= room) return;
    to[place[k]] = {rows.facts[i], rows.stencil[i], rows.touch[i], rows.terms[i], rows.traction[i], rows.impulse[i]};
  }
};

/// Arrays of points side by side, to be taken along in one piece.
struct GatherPoints {
  const Point4 *velocity, *acceleration, *pressed, *force;  ///< force: null where it is left out
  int n;
  Vec3* to;
  StepFacts* facts;
  GAMBESON_HD void operator()(int i) const {
    to[i] = vec(velocity[i]), to[n + i] = vec(acceleration[i]), to[2 * n + i] = vec(pressed[i]);
    if (force) to[3 * n + i] = vec(force[i]);
    if (!isFinite(vec(acceleration[i]))) fetchAdd(&facts->lost, 1);
  }
};

/// All that the host must know before it goes on.
struct StepCounts {
  StepFacts step;
  SolveFacts solve;
  Count rows;
  Count near[kNearLists], impacts[kImpactCounts];
};
struct CollectCounts {
  const StepFacts* step;
  const SolveFacts* solve;
  const Count *rows, *near, *impacts;  ///< impacts: null where there are none
  StepCounts* to;
  GAMBESON_HD void operator()(int i) const {
    if (i == 0) to->step = *step, to->solve = *solve, to->rows = *rows;
    if (i < kNearLists) to->near[i] = near[i];
    if (i < kImpactCounts) to->impacts[i] = impacts ? impacts[i] : 0;
  }
};
struct TakeOver {
  const Point4 *position, *velocity, *acceleration, *pressed;
  Point4 *position_to, *velocity_to, *acceleration_to, *pressed_to;
  GAMBESON_HD void operator()(int i) const {
    position_to[i] = position[i], velocity_to[i] = velocity[i];
    acceleration_to[i] = acceleration[i], pressed_to[i] = pressed[i];
  }
};

}  // namespace gambeson::gpu
