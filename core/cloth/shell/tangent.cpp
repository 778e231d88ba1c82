#include "core/cloth/shell/tangent.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <tuple>

#include "core/cloth/draft/hinge.hpp"
#include "core/cloth/free_blocks.hpp"
#include "core/math/parallel.hpp"

namespace gambeson {
namespace {

/// Scratch of a batch: what stays in a core's second-level cache.
constexpr long kBatchDoubles = 1 << 17;

std::vector<int> nodesOf(const ShellBlock& b, int cell) {
  const int nn = b.nodeCount(), group = cell / b.lanes, lane = cell % b.lanes;
  std::vector<int> nodes(nn);
  for (int k = 0; k < nn; ++k) nodes[k] = b.nodes[(static_cast<long>(group) * nn + k) * b.lanes + lane];
  return nodes;
}

BlockMatrix sparsityOf(const Shell& shell, const FreeMap& map) {
  std::vector<std::vector<int>> elements;
  for (const ShellPart& part : shell.parts())
    for (int cell = 0; cell < part.cell_count; ++cell) elements.push_back(nodesOf(part.block, cell));
  for (const HingePoint& h : shell.hinges()) elements.push_back(h.columns);
  for (const GapPoint& g : shell.gaps()) elements.push_back(g.columns);
  return blockSparsity(map, elements);
}

}  // namespace

/// `elements`: control points, and the first slot of the pairs.
void Tangent::addBatch(const FreeMap& map, const Batch& batch,
                       const std::vector<std::pair<std::vector<int>, int>>& elements) {
  struct Entry {
    long block;
    Source source;
  };
  std::vector<Entry> entries;
  const SparseRows& T = map.T;
  for (const auto& [nodes, first] : elements) {
    const int n = static_cast<int>(nodes.size());
    for (int I = 0; I < n; ++I)
      for (int J = 0; J < n; ++J) {
        const int low = std::min(I, J), high = std::max(I, J);
        const int slot = first + (low * n - low * (low - 1) / 2 + high - low) * 9 * batch.stride;
        for (int a = T.offsets[nodes[I]]; a < T.offsets[nodes[I] + 1]; ++a)
          for (int b = T.offsets[nodes[J]]; b < T.offsets[nodes[J] + 1]; ++b)
            // Below the diagonal the transpose stands for it.
            if (T.columns[a] <= T.columns[b])
              entries.push_back({sparsity_.find(T.columns[a], T.columns[b]), {slot, I > J, T.values[a] * T.values[b]}});
      }
  }
  std::stable_sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.block < b.block; });
  Batch done = batch;
  done.first_sum = static_cast<long>(sum_block_.size());
  for (std::size_t k = 0; k < entries.size(); ++k) {
    assert(entries[k].block >= 0);
    if (k == 0 || entries[k].block != entries[k - 1].block) {
      sum_block_.push_back(entries[k].block);
      sum_offsets_.push_back(sum_offsets_.back());
    }
    sources_.push_back(entries[k].source);
    ++sum_offsets_.back();
  }
  done.end_sum = static_cast<long>(sum_block_.size());
  batches_.push_back(done);
}

Tangent::Tangent(const Shell& shell, const FreeMap& map) : sparsity_(sparsityOf(shell, map)) {
  for (std::size_t p = 0; p < shell.parts().size(); ++p) {
    const ShellBlock& b = shell.parts()[p].block;
    const long group_doubles = long{9} * b.pairCount() * b.lanes;
    const int groups = static_cast<int>(std::max(1L, kBatchDoubles / group_doubles));
    for (int first = 0; first < b.groups; first += groups) {
      const int count = std::min(groups, b.groups - first);
      std::vector<std::pair<std::vector<int>, int>> elements;
      for (int cell = first * b.lanes; cell < std::min((first + count) * b.lanes, shell.parts()[p].cell_count); ++cell)
        elements.push_back(
            {nodesOf(b, cell), static_cast<int>((cell / b.lanes - first) * group_doubles + cell % b.lanes)});
      addBatch(map, {Batch::cells, static_cast<int>(p), first, count, b.lanes, count * group_doubles, 0, 0}, elements);
    }
  }
  std::vector<const std::vector<int>*> hinges, gaps;
  for (const HingePoint& h : shell.hinges()) hinges.push_back(&h.columns);
  for (const GapPoint& g : shell.gaps()) gaps.push_back(&g.columns);
  addSeamBatches(map, Batch::hinges, hinges);
  addSeamBatches(map, Batch::gaps, gaps);
}

/// `columns`: the control points of each hinge or gap.
void Tangent::addSeamBatches(const FreeMap& map, Batch::Kind kind,
                             const std::vector<const std::vector<int>*>& columns) {
  const int count = static_cast<int>(columns.size());
  for (int first = 0, end = 0; first < count; first = end) {
    std::vector<std::pair<std::vector<int>, int>> elements;
    long doubles = 0;
    for (; end < count && (end == first || doubles < kBatchDoubles); ++end) {
      elements.push_back({*columns[end], static_cast<int>(doubles)});
      seam_slot_[kind].push_back(doubles);
      doubles += 9 * static_cast<long>(columns[end]->size() * (columns[end]->size() + 1) / 2);
    }
    addBatch(map, {kind, 0, first, end - first, 1, doubles, 0, 0}, elements);
  }
}

void Tangent::assemble(const Shell& shell, const ClothState& state, ClothWork& work, BlockMatrix& K,
                       const ForceTerms& terms) const {
  if (K.columns.size() != sparsity_.columns.size() || K.offsets != sparsity_.offsets) K = sparsity_;
  std::fill(K.values.begin(), K.values.end(), 0.0);
  long most = 0;
  for (const Batch& batch : batches_) most = std::max(most, batch.doubles);
  work.tangent_slots.resize(most);
  double* slots = work.tangent_slots.data();
  for (const Batch& batch : batches_) {
    if (batch.kind == Batch::cells ? !terms.membrane && !terms.bending : !terms.seams) continue;
    if (batch.kind != Batch::cells) {
      using Blocks = std::vector<std::array<double, 9>>;
      forAllWith<Blocks>(Each::element, batch.first, batch.first + batch.count, [&](Blocks& blocks, int i) {
        const bool hinge = batch.kind == Batch::hinges;
        if (hinge) hingeStiffness(shell.hinges()[i], state.q, blocks, terms.definite);
        if (!hinge) gapStiffness(shell.gaps()[i], blocks);
        const std::size_t n = hinge ? shell.hinges()[i].columns.size() : shell.gaps()[i].columns.size();
        double* out = slots + seam_slot_[batch.kind][i];
        for (std::size_t I = 0; I < n; ++I)
          for (std::size_t J = I; J < n; ++J) out = std::copy(blocks[I * n + J].begin(), blocks[I * n + J].end(), out);
      });
    } else if (const ShellPart& part = shell.parts()[batch.part]; part.points) {
      part.points->tangent(state, terms, batch.first, batch.count, slots);
    } else {
      const BlockLaw law = withHistory(withTerms(part.law, terms), part.block.history_first, state, {});
      shell.kernels().tangent(part.block, law, reinterpret_cast<const double*>(state.q.data()), batch.first,
                              batch.count, slots);
    }
    const long stride = batch.stride;
    forAll(Each::element, batch.first_sum, batch.end_sum, [&](long s) {
      double* out = &K.values[9 * sum_block_[s]];
      for (long k = sum_offsets_[s]; k < sum_offsets_[s + 1]; ++k) {
        const Source& source = sources_[k];
        const double* in = slots + source.slot;
        const double w = source.weight;
        if (source.transposed)
          for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) out[3 * i + j] += w * in[(3 * j + i) * stride];
        else
          for (int i = 0; i < 9; ++i) out[i] += w * in[i * stride];
      }
    });
  }
}

}  // namespace gambeson
