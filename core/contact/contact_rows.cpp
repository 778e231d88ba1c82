#include "core/contact/contact_rows.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "core/contact/projecting_hold.hpp"
#include "core/contact/row_order.hpp"
#include "core/math/parallel.hpp"

namespace gambeson {
namespace {

/// The rows that each sample has on cloth, by sample: w.first_on_cloth and w.on_cloth.
void listOnCloth(std::span<const ContactRow> rows, int samples, ContactWork& w) {
  const auto each = [&](const auto& visit) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (rows[i].contact.kind != ContactKind::sample_on_cloth) continue;
      visit(rows[i].contact.sample, static_cast<int>(i));
      if (rows[i].partner >= 0) visit(rows[i].partner, static_cast<int>(i));
    }
  };
  w.first_on_cloth.assign(samples + 1, 0);
  each([&](int sample, int) { ++w.first_on_cloth[sample + 1]; });
  for (int s = 0; s < samples; ++s) w.first_on_cloth[s + 1] += w.first_on_cloth[s];
  w.on_cloth.resize(w.first_on_cloth[samples]);
  each([&](int sample, int row) { w.on_cloth[w.first_on_cloth[sample]++] = row; });
  for (int s = samples; s > 0; --s) w.first_on_cloth[s] = w.first_on_cloth[s - 1];
  w.first_on_cloth[0] = 0;
}

/// How many rows of a sample lie on the side of it that `normal` points from.
int sharedBy(std::span<const ContactRow> rows, int sample, const Vec3& normal, const ContactWork& w) {
  int count = 0;
  for (int k = w.first_on_cloth[sample]; k < w.first_on_cloth[sample + 1]; ++k) {
    const Contact& c = rows[w.on_cloth[k]].contact;
    count += (c.sample == sample ? 1 : -1) * dot(c.normal, normal) > 0;
  }
  return std::max(1, count);
}

}  // namespace

void shareAreas(std::span<const ContactRow> rows, const SparseRows& WT, std::span<const double> area,
                std::span<const double> inverse_mass, ContactWork& w) {
  const int n = static_cast<int>(rows.size());
  w.on_body.assign(area.size(), 0);
  for (const ContactRow& row : rows)
    if (row.contact.onBody()) ++w.on_body[row.contact.sample];
  listOnCloth(rows, static_cast<int>(area.size()), w);
  w.area_of.resize(n);
  forAll(Each::sum, n, [&](int i) {
    const ContactRow& row = rows[i];
    const Stencil& stencil = row.stencil;
    bool moves = false;
    for (int k = 0; k < stencil.count && !moves; ++k)
      for (int e = WT.offsets[stencil.sample[k]]; e < WT.offsets[stencil.sample[k] + 1] && !moves; ++e)
        moves = stencil.weight[k] * WT.values[e] != 0 && inverse_mass[WT.columns[e]] > 0;
    double a = 0;
    const ContactKind kind = row.contact.kind;
    if (kind == ContactKind::edge_on_edge || kind == ContactKind::restoring ||
        (row.contact.onBody() && stencil.count > 1)) {
      for (int k = 0; k < stencil.count; ++k) a += 0.125 * std::abs(stencil.weight[k]) * area[stencil.sample[k]];
    } else if (kind == ContactKind::sample_on_cloth) {
      a = 0.5 * area[row.contact.sample] / sharedBy(rows, row.contact.sample, row.contact.normal, w);
      if (row.partner >= 0) a += 0.5 * area[row.partner] / sharedBy(rows, row.partner, -row.contact.normal, w);
    } else {
      a = area[row.contact.sample] / w.on_body[row.contact.sample];
    }
    w.area_of[i] = moves && !row.fixed ? a : 0;
  });
}

namespace {

/// The free points of a row that can move, each once, from `first` on; how many.
int reachOf(const ContactRow& row, const SparseRows& WT, std::span<const double> inverse_mass, int first,
            ContactWork& w) {
  int* const points = w.reach_point.data() + first;
  double* const weights = w.reach_weight.data() + first;
  int count = 0;
  for (int j = 0; j < row.stencil.count; ++j) {
    const int s = row.stencil.sample[j], seen = count;
    for (int e = WT.offsets[s]; e < WT.offsets[s + 1]; ++e) {
      const int f = WT.columns[e];
      const double weight = row.stencil.weight[j] * WT.values[e];
      if (weight == 0 || !(inverse_mass[f] > 0)) continue;
      const int at = static_cast<int>(std::find(points, points + seen, f) - points);
      if (at < seen) {
        weights[at] += weight;
      } else {
        points[count] = f;
        weights[count++] = weight;
      }
    }
  }
  return count;
}

std::span<const int> pointsOf(const ContactWork& w, int row) {
  return std::span(w.reach_point).subspan(static_cast<std::size_t>(w.reach[row].first), w.reach[row].count);
}

const ProjectingHold* projectingHold(const ContactWork& w) {
  return w.hold && w.hold->projects() ? static_cast<const ProjectingHold*>(w.hold) : nullptr;
}

/// Sorts w.order by islands.
void findIslands(int free_count, ContactWork& w) {
  w.islands.clear();
  const ProjectingHold* const projecting = projectingHold(w);
  if (w.hold && !projecting) {
    if (!w.order.empty()) w.islands.emplace_back().row_end = static_cast<int>(w.order.size());
    return;
  }
  w.tied_to.resize(free_count, -1);
  w.number.resize(free_count);
  const auto root = [&](int f) {
    while (w.tied_to[f] != f) f = w.tied_to[f] = w.tied_to[w.tied_to[f]];
    return f;
  };
  for (int i : w.order)
    for (int f : pointsOf(w, i)) w.tied_to[f] = f;
  int held = -1;  // the root of what the hold takes hold of
  if (projecting)
    for (int i : w.order)
      for (int f : pointsOf(w, i)) {
        if (projecting->ties(f).points.empty()) continue;
        f = root(f);
        if (held < 0) held = f;
        w.tied_to[std::max(held, f)] = std::min(held, f);
        held = std::min(held, f);
      }
  std::vector<int>& of = w.island_of;  // first a free point of the row, then its island
  of.resize(w.order.size());
  for (std::size_t k = 0; k < w.order.size(); ++k) {
    const std::span<const int> points = pointsOf(w, w.order[k]);
    int first = root(points[0]);
    for (int f : points.subspan(1)) {
      f = root(f);
      w.tied_to[std::max(first, f)] = std::min(first, f);
      first = std::min(first, f);
    }
    of[k] = first;
  }
  for (int f : of) w.number[root(f)] = -1;
  for (int& f : of) {
    int& number = w.number[root(f)];
    if (number < 0) {
      number = static_cast<int>(w.islands.size());
      w.islands.emplace_back().held = held >= 0 && root(f) == root(held);
    }
    f = number;
    ++w.islands[f].row_end;
  }
  int begin = 0;
  for (ContactWork::Island& island : w.islands) {
    island.row = begin;
    begin += island.row_end;
    island.row_end = island.row;  // grows as the rows come
  }
  w.unsorted = w.order;
  for (std::size_t k = 0; k < of.size(); ++k) w.order[w.islands[of[k]].row_end++] = w.unsorted[k];
}

/// Free points that the rows touch, in the order of the rows, and the rows' weights at these.
void touchPoints(int free_count, ContactWork& w) {
  w.free_slot.resize(free_count, -1);
  for (int f : w.free_points) w.free_slot[f] = -1;
  w.free_points.clear();
  w.points.offsets.assign(1, 0);
  w.points.columns.clear();
  w.points.values.clear();
  for (ContactWork::Island& island : w.islands) {
    island.free_point = static_cast<int>(w.free_points.size());
    for (int k = island.row; k < island.row_end; ++k) {
      const ContactWork::Reach& reach = w.reach[w.order[k]];
      for (int e = reach.first; e < reach.first + reach.count; ++e) {
        int& slot = w.free_slot[w.reach_point[e]];
        if (slot < 0) {
          slot = static_cast<int>(w.free_points.size());
          w.free_points.push_back(w.reach_point[e]);
        }
        w.points.add(slot, w.reach_weight[e]);
      }
      w.points.endRow();
    }
    island.free_end = static_cast<int>(w.free_points.size());
  }
  w.points.column_count = static_cast<int>(w.free_points.size());
  if (!w.hold) return;
  w.hold->touch(w.free_points);
  w.columns = transpose(w.points);
}

/// w.pushes, where something projects: of held islands what goes along with the points of a row too.
void pushPoints(std::span<const double> inverse_mass, ContactWork& w) {
  const ProjectingHold* const projecting = projectingHold(w);
  if (!projecting) return;
  std::vector<PointTies> ties;
  for (const int f : w.free_points) ties.push_back(projecting->ties(f));
  SparseRows& pushes = w.pushes;
  pushes.offsets.assign(1, 0);
  pushes.columns.clear();
  pushes.values.clear();
  pushes.column_count = w.points.column_count;
  w.push_at.assign(w.free_points.size(), -1);
  for (int row = 0; row < w.points.rows(); ++row) {
    const int begin = pushes.offsets.back();
    const auto add = [&](int slot, double value) {
      if (w.push_at[slot] < 0) {
        w.push_at[slot] = static_cast<int>(pushes.columns.size());
        pushes.add(slot, value);
      } else {
        pushes.values[w.push_at[slot]] += value;
      }
    };
    for (int e = w.points.offsets[row]; e < w.points.offsets[row + 1]; ++e) {
      const int slot = w.points.columns[e];
      add(slot, w.points.values[e] * inverse_mass[w.free_points[slot]]);
    }
    for (int e = w.points.offsets[row]; e < w.points.offsets[row + 1]; ++e) {
      const PointTies& of = ties[w.points.columns[e]];
      for (std::size_t k = 0; k < of.points.size(); ++k)
        if (const int slot = w.free_slot[of.points[k]]; slot >= 0) add(slot, -w.points.values[e] * of.values[k]);
    }
    for (std::size_t k = begin; k < pushes.columns.size(); ++k) w.push_at[pushes.columns[k]] = -1;
    pushes.endRow();
  }
}

}  // namespace

Vec3 velocityAt(const ContactRow& row, const SparseRows& WT, std::span<const Vec3> velocity) {
  Vec3 all = -driftOf(row);
  for (int j = 0; j < row.stencil.count; ++j) {
    Vec3 v{};
    for (int e = WT.offsets[row.stencil.sample[j]]; e < WT.offsets[row.stencil.sample[j] + 1]; ++e)
      v += WT.values[e] * velocity[WT.columns[e]];
    all += row.stencil.weight[j] * v;
  }
  return all;
}

void reachRows(std::span<const ContactRow> rows, const SparseRows& WT, std::span<const double> inverse_mass,
               std::span<const Vec3> velocity, ContactWork& w) {
  w.unsorted.clear();
  int room = static_cast<int>(w.reach_point.size());
  for (int i : w.order) {
    if (w.reach[i].count >= 0) continue;
    w.unsorted.push_back(i);
    w.reach[i].first = room;
    for (int j = 0; j < rows[i].stencil.count; ++j) {
      const int s = rows[i].stencil.sample[j];
      room += WT.offsets[s + 1] - WT.offsets[s];
    }
  }
  w.reach_point.resize(room);
  w.reach_weight.resize(room);
  forAll(Each::sum, static_cast<int>(w.unsorted.size()), [&](int k) {
    const ContactRow& row = rows[w.unsorted[k]];
    ContactWork::Reach& reach = w.reach[w.unsorted[k]];
    reach.count = reachOf(row, WT, inverse_mass, reach.first, w);
    reach.start = velocityAt(row, WT, velocity);
  });
}

void restrict(std::span<const ContactRow> rows, int free_count, std::span<const double> inverse_mass,
              std::span<const double> density, std::span<const int> place, std::span<const Vec3> velocity,
              ContactWork& w) {
  findIslands(free_count, w);
  orderRows(rows, place, free_count, w);
  touchPoints(free_count, w);
  pushPoints(inverse_mass, w);
  const int n = static_cast<int>(w.order.size()), touched = static_cast<int>(w.free_points.size());
  w.inverse_mass.resize(touched);
  for (auto* of_points : {&w.base, &w.moved, &w.moved_before}) of_points->resize(touched);
  for (int f = 0; f < touched; ++f) {
    const Vec3& v = velocity[w.free_points[f]];
    w.base[f] = {{v.x, v.y, v.z, 0}};
    w.inverse_mass[f] = inverse_mass[w.free_points[f]];
  }
  w.facts.resize(n);
  w.row_area.resize(n);
  w.traction.resize(n);
  for (auto* of_rows : {&w.point, &w.candidate, &w.previous}) of_rows->resize(n);
  const SparseRows* const pushes = projectingHold(w) ? &w.pushes : nullptr;  // which begin with the row's own points
  forAll(Each::sum, n, [&](int k) {
    const int i = w.order[k];
    const ContactRow& row = rows[i];
    const RowSlip& slip = w.slip[i];
    w.row_area[k] = w.area_of[i];
    double own = 0;
    Vec3 moves{};  // of its points as they would move without contacts
    for (int e = w.points.offsets[k], p = pushes ? pushes->offsets[k] : 0; e < w.points.offsets[k + 1]; ++e, ++p) {
      const int f = w.points.columns[e];
      own +=
          pushes ? w.points.values[e] * pushes->values[p] : w.points.values[e] * w.points.values[e] * w.inverse_mass[f];
      const double* lane = w.base[f].lane;
      moves += w.points.values[e] * Vec3{lane[0], lane[1], lane[2]};
    }
    const double slope = slopeOf(row, density);
    // What held points do is a part of the drift.
    w.facts[k] = {row.contact.normal,  moves - w.reach[i].start,
                  slip.friction,       slip.drag,
                  row.compliance,      slope,
                  own * w.row_area[k], slope};
  });
}

namespace {

/// Calls visit(sample) for the samples that are marked, in their order, and leaves none.
template <class Visit>
void eachMarked(ContactWork::OnSamples& sums, const Visit& visit) {
  for (std::size_t s = 0; s < sums.marked.size(); ++s)
    if (std::exchange(sums.marked[s], 0)) visit(static_cast<int>(s));
}

}  // namespace

void spreadImpulses(std::span<const ContactRow> rows, const SparseRows& WT, std::span<const double> inverse_mass,
                    std::span<const Vec3> impulses, ContactWork& w) {
  ContactWork::OnSamples& sums = w.spread;
  sums.marked.resize(WT.rows());
  sums.sum.resize(WT.rows());
  w.change.assign(WT.column_count, Vec3{});
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (impulses[i] == Vec3{}) continue;
    for (int j = 0; j < rows[i].stencil.count; ++j) {
      const int s = rows[i].stencil.sample[j];
      if (!std::exchange(sums.marked[s], 1)) sums.sum[s] = {};
      sums.sum[s] += rows[i].stencil.weight[j] * impulses[i];
    }
  }
  eachMarked(sums, [&](int s) {
    for (int e = WT.offsets[s]; e < WT.offsets[s + 1]; ++e) w.change[WT.columns[e]] += WT.values[e] * sums.sum[s];
  });
  forAll(Each::value, WT.column_count, [&](int f) { w.change[f] *= inverse_mass[f]; });
}

namespace {

/// The rows that are smoothed together: those of bodies, then those of each side of the cloth.
constexpr int kFamilies = std::tuple_size_v<decltype(ContactWork::smoothed)>;

/// Takes the warm starts of one family towards their smooth part, in w.start.
void smoothFamily(int family, std::span<const ContactRow> rows, const SparseRows& WT,
                  std::span<const double> inverse_mass, std::span<const Vec3> warm, ContactWork& w) {
  constexpr double kMix = 0.2;
  const Vec3 side{0.6180, 0.4142, 0.7321};
  const int n = static_cast<int>(rows.size());
  ContactWork::OnSamples& sums = w.smoothed[static_cast<std::size_t>(family)];
  const auto isOne = [&](int i) {
    const ContactRow& row = rows[i];
    if (!w.in[i] || warm[i] == Vec3{}) return false;
    if (family == 0) return row.contact.onBody() && row.stencil.count == 1;
    return row.contact.kind == ContactKind::sample_on_cloth && (dot(row.contact.normal, side) > 0) == (family == 1);
  };
  const auto part = [&](int i) {
    const Vec3& t = warm[i];
    return family == 0 ? t : Vec3{dot(t, rows[i].contact.normal), 0, 0};
  };
  sums.marked.resize(WT.rows());
  sums.sum.resize(WT.rows());
  sums.area.resize(WT.rows());
  bool any = false;
  for (int i = 0; i < n; ++i) {
    if (!isOne(i)) continue;
    const int s = rows[i].contact.sample;
    if (!std::exchange(sums.marked[s], 1)) sums.sum[s] = {}, sums.area[s] = 0;
    sums.sum[s] += w.area_of[i] * part(i);
    sums.area[s] += w.area_of[i];
    any = true;
  }
  if (!any) return;
  sums.free_area.assign(WT.column_count, 0);
  sums.free_sum.assign(WT.column_count, Vec3{});
  eachMarked(sums, [&](int s) {
    for (int e = WT.offsets[s]; e < WT.offsets[s + 1]; ++e) {
      sums.free_area[WT.columns[e]] += WT.values[e] * sums.area[s];
      sums.free_sum[WT.columns[e]] += WT.values[e] * sums.sum[s];
    }
  });
  for (int f = 0; f < WT.column_count; ++f)
    if (sums.free_area[f] > 0) sums.free_sum[f] = sums.free_sum[f] / sums.free_area[f];
  for (int i = 0; i < n; ++i) {
    if (!isOne(i)) continue;
    Vec3 smooth{};
    double whole = 0;  // of the points that can move
    const int s = rows[i].contact.sample;
    for (int e = WT.offsets[s]; e < WT.offsets[s + 1]; ++e) {
      const int f = WT.columns[e];
      if (!(inverse_mass[f] > 0)) continue;
      smooth += WT.values[e] * sums.free_sum[f];
      whole += WT.values[e];
    }
    if (!(whole > 0)) continue;
    const Vec3 change = kMix * (smooth / whole - part(i));
    w.start[i] += family == 0 ? change : change.x * rows[i].contact.normal;
  }
}

}  // namespace

void smoothWarm(std::span<const ContactRow> rows, const SparseRows& WT, std::span<const double> inverse_mass,
                std::span<const Vec3> warm, ContactWork& w) {
  const int n = static_cast<int>(rows.size());
  w.start.resize(n);
  forAll(Each::value, n, [&](int i) { w.start[i] = w.in[i] ? warm[i] : Vec3{}; });
  const auto smooth = [&](int family) { smoothFamily(family, rows, WT, inverse_mass, warm, w); };
  forAllUneven(n < static_cast<int>(Each::sum) ? Each::value : Each::much, kFamilies, smooth);
}

}  // namespace gambeson
