#include "gpu/solve/flat_solve.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "core/contact/iteration_lanes.hpp"

namespace gambeson::gpu {

FlatSolve flatSolve(const ContactWork& w) {
  FlatSolve flat;
  const int rows = static_cast<int>(w.order.size()), points = static_cast<int>(w.free_points.size());
  flat.islands = w.islands;
  const auto packed = static_cast<std::size_t>(inRowBlocks(rows));
  flat.facts.resize(packed * RowFacts::kNumbers), flat.state.resize(packed * RowState::kNumbers);
  flat.point.resize(packed * kPlaces);
  flat.weight.resize(flat.point.size());
  flat.push.resize(flat.point.size());
  for (int k = 0; k < rows; ++k) {
    const ContactWork::Row& f = w.facts[k];
    RowFacts{f.normal, f.drift, f.friction, f.drag, f.compliance, w.row_area[k]}.put(flat.facts.data(), k);
    flat.own.push_back(f.own);
    flat.slope.push_back(f.slope);
    RowState{vec(w.candidate[k]), vec(w.previous[k])}.put(flat.state.data(), k);
  }
  for (int f = 0; f < points; ++f) {
    flat.moved.push_back(vec(w.moved[f]));
    flat.moved_before.push_back(vec(w.moved_before[f]));
  }
  flat.free.resize(points);
  std::iota(flat.free.begin(), flat.free.end(), 0);
  std::vector<int> number(points, -1);
  std::vector<char> had(points, 0);
  for (std::size_t c = 0; c + 1 < w.chunks.size(); ++c) {
    SolveChunk chunk{w.chunks[c].row,
                     w.chunks[c + 1].row,
                     static_cast<int>(flat.steps.size()),
                     0,
                     static_cast<int>(flat.chunk_points.size()),
                     0,
                     w.chunks[c].phase};
    for (int k = chunk.row; k < chunk.row_end; ++k) {
      if (k == chunk.row || w.colour[k] != w.colour[k - 1] || k - flat.steps.back() == kSumLanes)
        flat.steps.push_back(k);
      const int first = w.points.offsets[k];
      flat.entries.push_back({w.points.offsets[k + 1] - first, static_cast<int>(flat.point.size())});
      for (int e = first; e < w.points.offsets[k + 1]; ++e) {
        const int f = w.points.columns[e];
        if (number[f] < 0) {
          number[f] = static_cast<int>(flat.chunk_points.size()) - chunk.point;
          flat.chunk_points.push_back({f, !std::exchange(had[f], 1)});
        }
        const std::size_t at =
            e - first < kPlaces ? static_cast<std::size_t>(placeOf(k, e - first)) : flat.point.size();
        if (at == flat.point.size()) flat.point.push_back(0), flat.weight.push_back(0), flat.push.push_back(0);
        flat.point[at] = number[f];
        flat.weight[at] = w.points.values[e];
        flat.push[at] = w.points.values[e] * w.inverse_mass[f];
      }
    }
    chunk.step_end = static_cast<int>(flat.steps.size());
    chunk.point_end = static_cast<int>(flat.chunk_points.size());
    for (int p = chunk.point; p < chunk.point_end; ++p) number[flat.chunk_points[p].point] = -1;
    flat.chunks.push_back(chunk);
  }
  const auto parts = [&](int i) { return w.islands[i].chunk_end - w.islands[i].chunk; };
  const auto size = [&](int i) { return w.islands[i].row_end - w.islands[i].row; };
  flat.by_size.resize(w.islands.size());
  std::iota(flat.by_size.begin(), flat.by_size.end(), 0);
  std::stable_sort(flat.by_size.begin(), flat.by_size.end(),
                   [&](int a, int b) { return (parts(a) > 1) != (parts(b) > 1) ? parts(a) > 1 : size(a) > size(b); });
  for (int i : flat.by_size) flat.small += parts(i) > 1;
  return flat;
}

}  // namespace gambeson::gpu
