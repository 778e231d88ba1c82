#include "core/contact/contact_rows.hpp"

#include <algorithm>
#include <cmath>

namespace gambeson {
namespace {

/// W_T of the samples and free points that the rows touch.
void touched(std::span<const ContactRow> rows, const SparseRows& WT, ContactWork& w) {
  w.sample_slot.resize(WT.rows(), -1);
  w.free_slot.resize(WT.column_count, -1);
  for (int s : w.samples) w.sample_slot[s] = -1;
  for (int f : w.free_points) w.free_slot[f] = -1;
  w.samples.clear();
  w.free_points.clear();
  const auto clear = [](SparseRows& m) {
    m.offsets.assign(1, 0);
    m.columns.clear();
    m.values.clear();
  };
  clear(w.stencils);
  for (int i : w.order) {
    const Stencil& stencil = rows[i].stencil;
    for (int k = 0; k < stencil.count; ++k) {
      int& slot = w.sample_slot[stencil.sample[k]];
      if (slot < 0) {
        slot = static_cast<int>(w.samples.size());
        w.samples.push_back(stencil.sample[k]);
      }
      w.stencils.add(slot, stencil.weight[k]);
    }
    w.stencils.endRow();
  }
  w.stencils.column_count = static_cast<int>(w.samples.size());
  w.of_sample = transpose(w.stencils);
  clear(w.rows);
  for (int s : w.samples) {
    for (int k = WT.offsets[s]; k < WT.offsets[s + 1]; ++k) {
      int& slot = w.free_slot[WT.columns[k]];
      if (slot < 0) {
        slot = static_cast<int>(w.free_points.size());
        w.free_points.push_back(WT.columns[k]);
      }
      w.rows.add(slot, WT.values[k]);
    }
    w.rows.endRow();
  }
  if (w.hold) w.hold->touch(w.free_points);
  w.rows.column_count = static_cast<int>(w.free_points.size());
  w.columns = transpose(w.rows);
}

/// Ranges of the islands in the samples and free points, which come in the order of the rows.
void rangeIslands(ContactWork& w) {
  int sample = 0, free_point = 0, chunk = 0;
  for (ContactWork::Island& island : w.islands) {
    island.sample = sample;
    island.free_point = free_point;
    island.chunk = chunk;
    for (int e = w.stencils.offsets[island.row]; e < w.stencils.offsets[island.row_end]; ++e)
      sample = std::max(sample, w.stencils.columns[e] + 1);
    for (int e = w.rows.offsets[island.sample]; e < w.rows.offsets[sample]; ++e)
      free_point = std::max(free_point, w.rows.columns[e] + 1);
    island.sample_end = sample;
    island.free_end = free_point;
    chunk += island.row_end - island.row;  // at least as many as there are
  }
  w.largest2.resize(chunk);
  w.against.resize(chunk);
}

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
  for (int i = 0; i < n; ++i) {
    const ContactRow& row = rows[i];
    const Stencil& stencil = row.stencil;
    bool moves = false;
    for (int k = 0; k < stencil.count && !moves; ++k)
      for (int e = WT.offsets[stencil.sample[k]]; e < WT.offsets[stencil.sample[k] + 1] && !moves; ++e)
        moves = WT.values[e] != 0 && inverse_mass[WT.columns[e]] > 0;
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
  }
}

void findIslands(std::span<const ContactRow> rows, const SparseRows& WT, std::span<const double> inverse_mass,
                 ContactWork& w) {
  if (w.hold) {
    w.islands.assign(w.order.empty() ? 0 : 1, {});
    if (!w.islands.empty()) w.islands[0].row_end = static_cast<int>(w.order.size());
    return;
  }
  w.tied_to.resize(WT.column_count, -1);
  const auto root = [&](int f) {
    while (w.tied_to[f] != f) f = w.tied_to[f] = w.tied_to[w.tied_to[f]];
    return f;
  };
  // The points of a row that can move, and one of each sample that has none: it ties the rows that touch this sample,
  // which is gathered with one island.
  const auto points = [&](int i, const auto& visit) {
    const Stencil& stencil = rows[i].stencil;
    for (int k = 0; k < stencil.count; ++k) {
      const int first = WT.offsets[stencil.sample[k]], end = WT.offsets[stencil.sample[k] + 1];
      bool moves = false;
      for (int e = first; e < end; ++e) {
        if (!(inverse_mass[WT.columns[e]] > 0)) continue;
        visit(WT.columns[e]);
        moves = true;
      }
      if (!moves) visit(WT.columns[first]);
    }
  };
  for (int i : w.order) points(i, [&](int f) { w.tied_to[f] = f; });
  std::vector<int>& of = w.island_of;  // first a free point of the row, then its island
  of.resize(w.order.size());
  for (std::size_t k = 0; k < w.order.size(); ++k) {
    int first = -1;
    points(w.order[k], [&](int f) {
      f = root(f);
      if (first >= 0) w.tied_to[std::max(first, f)] = std::min(first, f);
      first = first < 0 ? f : std::min(first, f);
    });
    of[k] = first;
  }
  w.islands.clear();
  w.number.resize(WT.column_count);
  for (int f : of) w.number[root(f)] = -1;
  for (int& f : of) {
    int& number = w.number[root(f)];
    if (number < 0) {
      number = static_cast<int>(w.islands.size());
      w.islands.emplace_back();
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

void restrict(std::span<const ContactRow> rows, const SparseRows& WT, std::span<const double> inverse_mass,
              std::span<const double> density, std::span<const Vec3> velocity, ContactWork& w) {
  findIslands(rows, WT, inverse_mass, w);
  touched(rows, WT, w);
  rangeIslands(w);
  const int n = static_cast<int>(w.order.size()), samples = static_cast<int>(w.samples.size()),
            free_count = static_cast<int>(w.free_points.size());
  w.facts.resize(n);
  w.row_area.resize(n);
  w.traction.resize(n);
  for (auto* rows_of : {&w.point, &w.candidate, &w.previous}) rows_of->resize(n);
  w.impulse.resize(samples);
  w.velocity.resize(samples);
  w.free_velocity.resize(free_count);
  w.base.resize(free_count);
  w.moved.resize(free_count);
  w.inverse_mass.resize(free_count);
  for (int k = 0; k < n; ++k) {
    const ContactRow& row = rows[w.order[k]];
    w.row_area[k] = w.area_of[w.order[k]];
    const double slope = slopeOf(row, density);
    const RowSlip& slip = w.slip[w.order[k]];
    w.facts[k] = {row.contact.normal, driftOf(row), slip.friction, slip.drag, row.compliance, slope, slope};
  }
  for (int f = 0; f < free_count; ++f) {
    const Vec3& v = velocity[w.free_points[f]];
    w.base[f] = {{v.x, v.y, v.z, 0}};
    w.inverse_mass[f] = inverse_mass[w.free_points[f]];
  }
}

void smoothWarm(std::span<const ContactRow> rows, std::span<const Vec3> warm, ContactWork& w) {
  constexpr double kMix = 0.2;
  const Vec3 side{0.6180, 0.4142, 0.7321};
  const int n = static_cast<int>(w.order.size()), free_count = static_cast<int>(w.free_points.size());
  for (int at = 0; at < n; ++at) w.traction[at] = warm[w.order[at]];
  // Bodies, then both sides of the cloth.
  for (int family = 0; family < 3; ++family) {
    const auto smoothed = [&](int at) {
      const ContactRow& row = rows[w.order[at]];
      if (warm[w.order[at]] == Vec3{}) return false;
      if (family == 0) return row.contact.onBody() && row.stencil.count == 1;
      return row.contact.kind == ContactKind::sample_on_cloth && (dot(row.contact.normal, side) > 0) == (family == 1);
    };
    const auto part = [&](int at) {
      const Vec3& t = warm[w.order[at]];
      return family == 0 ? t : Vec3{dot(t, rows[w.order[at]].contact.normal), 0, 0};
    };
    const auto sampleOf = [&](int at) { return w.sample_slot[rows[w.order[at]].contact.sample]; };
    bool any = false;
    w.weight.assign(w.samples.size(), 0);
    w.sample_impulse.assign(w.samples.size(), Vec3{});
    for (int at = 0; at < n; ++at) {
      if (!smoothed(at)) continue;
      any = true;
      w.weight[sampleOf(at)] += w.row_area[at];
      w.sample_impulse[sampleOf(at)] += w.row_area[at] * part(at);
    }
    if (!any) continue;
    for (int f = 0; f < free_count; ++f) {
      Vec3 sum{};
      double total = 0;
      for (int k = w.columns.offsets[f]; k < w.columns.offsets[f + 1]; ++k) {
        sum += w.columns.values[k] * w.sample_impulse[w.columns.columns[k]];
        total += w.columns.values[k] * w.weight[w.columns.columns[k]];
      }
      w.free_velocity[f] = total > 0 ? sum / total : Vec3{};
    }
    for (int at = 0; at < n; ++at) {
      if (!smoothed(at)) continue;
      Vec3 smooth{};
      for (int k = w.rows.offsets[sampleOf(at)]; k < w.rows.offsets[sampleOf(at) + 1]; ++k)
        smooth += w.rows.values[k] * w.free_velocity[w.rows.columns[k]];
      const Vec3 change = kMix * (smooth - part(at));
      w.traction[at] += family == 0 ? change : change.x * rows[w.order[at]].contact.normal;
    }
  }
}

}  // namespace gambeson
