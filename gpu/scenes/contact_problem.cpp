#include "gpu/scenes/contact_problem.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/contact/contact_iteration.hpp"
#include "core/contact/contact_rows.hpp"
#include "core/contact/halving.hpp"
#include "core/contact/iteration_lanes.hpp"
#include "gpu/scenes/random.hpp"

namespace gambeson::gpu {
namespace {

/// Adds w times the basis of quadratic cells at (u, v), in cells, of a sheet whose points begin at `first`.
void addSample(int cells, int first, double u, double v, SparseRows& WT) {
  const auto basis = [&](double x, double b[3]) {
    const int cell = std::min(cells - 1, static_cast<int>(x));
    const double t = x - cell;
    b[0] = 0.5 * (1 - t) * (1 - t), b[1] = 0.5 + t - t * t, b[2] = 0.5 * t * t;
    return cell;
  };
  double bu[3], bv[3];
  const int iu = basis(u, bu), iv = basis(v, bv);
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i)
      if (bu[i] * bv[j] != 0) WT.add(first + iu + i + (cells + 2) * (iv + j), bu[i] * bv[j]);
  WT.endRow();
}

}  // namespace

ContactProblem contactStack(const StackSize& size, std::uint64_t seed) {
  constexpr double kCell_m = 12.8e-3, kDensity = 3;
  const int cells = size.cells, across = cells + 2, samples = 2 * cells + 1;
  Random random(seed);
  ContactProblem p;
  p.name = std::to_string(size.layers) + " layers of " + std::to_string(cells) + " x " + std::to_string(cells);
  p.WT.column_count = size.layers * across * across;
  p.goal_m_per_s = 1e-7;
  const auto sampleAt = [&](int layer, int i, int j) { return (layer * samples + j) * samples + i; };
  const auto atEnd = [&](int i) { return i == 0 || i == samples - 1 ? 0.5 : 1.0; };
  std::vector<Vec3> at;
  for (int l = 0; l < size.layers; ++l)
    for (int j = 0; j < samples; ++j)
      for (int i = 0; i < samples; ++i) {
        addSample(cells, l * across * across, i / 2.0, j / 2.0, p.WT);
        at.push_back({i / 2.0, j / 2.0, 0.1 * l});
      }
  p.place = halvedPlaces(at);
  for (int l = 0; l < size.layers; ++l)
    for (int j = 0; j < samples; ++j)
      for (int i = 0; i < samples; ++i) {
        if (random.even() > 2 * size.share - 1) continue;
        ContactRow row;
        row.contact.sample = sampleAt(l, i, j);
        row.contact.obstacle = l == 0 ? 0 : -1;
        row.contact.kind = l == 0 ? ContactKind::sample_on_body : ContactKind::sample_on_cloth;
        row.stencil.add(row.contact.sample, 1);
        if (l > 0) {
          const double s = 0.5 + 0.5 * random.even(), t = (1 - s) * (0.5 + 0.5 * random.even());
          const int a = std::min(i, samples - 2), b = std::min(j, samples - 2);
          row.stencil.add(sampleAt(l - 1, a, b), -(1 - s - t));
          row.stencil.add(sampleAt(l - 1, a + 1, b), -s);
          row.stencil.add(sampleAt(l - 1, a, b + 1), -t);
        }
        const double x = 0.2 * random.even(), y = 0.2 * random.even();
        row.contact.normal = normalized(Vec3{x, y, 1});
        row.body_velocity = 0.01 * random.evenVec() + Vec3{0, 0, 0.002};
        row.compliance = l == 0 ? 1e-6 : 0;
        p.rows.push_back(row);
        p.area.push_back(atEnd(i) * atEnd(j) * kCell_m * kCell_m / 4 * (l == 0 ? 1 : 0.5));
        p.slope.push_back((l == 0 ? 1 : 2) / kDensity + row.compliance);
        p.friction.push_back(0.2);
      }
  const auto share = [&](int i) {
    return i == 0 || i == across - 1 ? 1 / 6.0 : i == 1 || i == across - 2 ? 5 / 6.0 : 1;
  };
  for (int l = 0; l < size.layers; ++l)
    for (int j = 0; j < across; ++j)
      for (int i = 0; i < across; ++i) {
        p.inverse_mass.push_back(1 / (kDensity * kCell_m * kCell_m * share(i) * share(j)));
        p.velocity.push_back(0.05 * random.evenVec() - Vec3{0, 0, 0.05});
      }
  p.traction.assign(p.rows.size(), {});
  return p;
}

ContactProblem besides(const std::vector<ContactProblem>& problems) {
  ContactProblem all;
  for (const ContactProblem& p : problems) {
    const int points = all.WT.column_count, samples = all.WT.rows();
    all.goal_m_per_s = p.goal_m_per_s;
    all.name += (all.name.empty() ? "" : ", ") + p.name;
    for (ContactRow row : p.rows) {
      row.contact.sample += samples;
      for (int k = 0; k < row.stencil.count; ++k) row.stencil.sample[k] += samples;
      all.rows.push_back(row);
    }
    for (int s = 0; s < p.WT.rows(); ++s) {
      for (int e = p.WT.offsets[s]; e < p.WT.offsets[s + 1]; ++e) all.WT.add(points + p.WT.columns[e], p.WT.values[e]);
      all.WT.endRow();
    }
    all.WT.column_count += p.WT.column_count;
    for (int place : p.place) all.place.push_back(samples + place);
    const auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
    append(all.inverse_mass, p.inverse_mass), append(all.velocity, p.velocity), append(all.area, p.area);
    append(all.slope, p.slope), append(all.friction, p.friction), append(all.traction, p.traction);
  }
  return all;
}

void startProblem(const ContactProblem& p, ContactWork& w) {
  const int n = static_cast<int>(p.rows.size());
  w.hold = nullptr;
  w.area_of = p.area;
  w.slip.assign(n, {});
  for (int i = 0; i < n; ++i) w.slip[i].friction = p.friction[i];
  w.reach.assign(n, {});
  w.reach_point.clear();
  w.reach_weight.clear();
  w.order.resize(n);
  std::iota(w.order.begin(), w.order.end(), 0);
  std::erase_if(w.order, [&](int i) { return w.area_of[i] == 0; });
  std::stable_sort(w.order.begin(), w.order.end(),
                   [&](int a, int b) { return p.rows[a].stencil.sample[0] < p.rows[b].stencil.sample[0]; });
  reachRows(p.rows, p.WT, p.inverse_mass, p.velocity, w);
  const std::vector<double> density(p.WT.rows(), 1.0);
  restrict(p.rows, p.WT.column_count, p.inverse_mass, density, p.place, p.velocity, w);
  w.impulses.assign(n, {});
  for (std::size_t k = 0; k < w.order.size(); ++k) {
    w.facts[k].slope = w.facts[k].largest = p.slope[w.order[k]];
    w.traction[k] = projected(p.traction[w.order[k]], w.facts[k]);
    w.impulses[w.order[k]] = w.row_area[k] * w.traction[k];
  }
  spreadImpulses(p.rows, p.WT, p.inverse_mass, w.impulses, w);
  startIteration(w);
}

std::vector<int> gradientIterations(const ContactProblem& p, const ContactWork& w, int most) {
  const int n = static_cast<int>(w.order.size()), points = static_cast<int>(w.free_points.size());
  // Sizes of the weights, for the bounds: of a row at a point, over its samples.
  std::vector<double> size(w.points.values.size());
  for (int k = 0; k < n; ++k) {
    const Stencil& stencil = p.rows[w.order[k]].stencil;
    for (int e = w.points.offsets[k]; e < w.points.offsets[k + 1]; ++e)
      for (int j = 0; j < stencil.count; ++j)
        for (int s = p.WT.offsets[stencil.sample[j]]; s < p.WT.offsets[stencil.sample[j] + 1]; ++s)
          if (p.WT.columns[s] == w.free_points[w.points.columns[e]])
            size[e] += std::abs(stencil.weight[j] * p.WT.values[s]);
  }
  const auto bounds = [&](const auto& carries, int begin, int end, std::vector<double>& moved,
                          std::vector<double>& of) {
    for (int k = begin; k < end; ++k)
      for (int e = w.points.offsets[k]; e < w.points.offsets[k + 1]; ++e) moved[w.points.columns[e]] = 0;
    for (int k = begin; k < end; ++k)
      if (carries(k))
        for (int e = w.points.offsets[k]; e < w.points.offsets[k + 1]; ++e)
          moved[w.points.columns[e]] += w.inverse_mass[w.points.columns[e]] * (w.row_area[k] * size[e]);
    for (int k = begin; k < end; ++k) {
      of[k] = w.facts[k].compliance;
      for (int e = w.points.offsets[k]; e < w.points.offsets[k + 1]; ++e) of[k] += size[e] * moved[w.points.columns[e]];
    }
  };
  std::vector<double> of_points(points), bound(n), largest(n);
  bounds([](int) { return true; }, 0, n, of_points, largest);
  std::vector<Vec3> candidate(n), previous(n), moved(points);
  std::vector<char> marked(n, 0);
  std::vector<int> iterations;
  for (int k = 0; k < n; ++k) {
    largest[k] = std::max(largest[k], w.facts[k].slope);
    candidate[k] = previous[k] = w.traction[k];
  }
  for (ContactWork::Island island : w.islands) {
    int count = 0;
    for (bool done = false; count < most && !done; ++count) {
      for (int f = island.free_point; f < island.free_end; ++f) moved[f] = vec(w.base[f]);
      for (int k = island.row; k < island.row_end; ++k) {
        const Vec3 now = candidate[k];
        marked[k] = island.beta == 0 ? !(now == Vec3{}) : marked[k] || !(now == Vec3{});
        candidate[k] = now + island.beta * (now - previous[k]);
        previous[k] = now;
        for (int e = w.points.offsets[k]; e < w.points.offsets[k + 1]; ++e) {
          const int f = w.points.columns[e];
          moved[f] += (w.inverse_mass[f] * w.row_area[k] * w.points.values[e]) * candidate[k];
        }
      }
      bounds([&](int k) { return marked[k] != 0; }, island.row, island.row_end, of_points, bound);
      double against = 0, largest2 = 0;
      for (int k = island.row; k < island.row_end; ++k) {
        Vec3 v{};
        for (int e = w.points.offsets[k]; e < w.points.offsets[k + 1]; ++e)
          v += w.points.values[e] * moved[w.points.columns[e]];
        const double inverse = marked[k] && bound[k] < largest[k] ? std::max(bound[k], 0.05 * largest[k]) : largest[k];
        const Vec3 from = candidate[k];
        candidate[k] = projected(from - (1 / inverse) * missing(v, from, w.facts[k]), w.facts[k]);
        const Vec3 way = candidate[k] - from;
        largest2 = std::max(largest2, norm2(way) * (inverse * inverse));
        against -= w.row_area[k] * inverse * dot(way, candidate[k] - previous[k]);
      }
      done = std::sqrt(largest2) <= p.goal_m_per_s;
      advance(against, island);
    }
    iterations.push_back(count);
  }
  return iterations;
}

}  // namespace gambeson::gpu
