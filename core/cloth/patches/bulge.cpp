#include "core/cloth/patches/bulge.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

namespace gambeson {
namespace {

struct Term {
  int sample = 0;
  double weight = 0;
};
using Terms = std::vector<Term>;

/// -h^2/8 of the second derivative between the neighbours k and k + 1 of a line of samples: from these and a third one,
/// of the same cell if there is one. None where trimming has left none.
std::optional<Terms> along(const std::vector<double>& parameters, int per_cell, int k, const auto& sample) {
  const int n = static_cast<int>(parameters.size());
  const bool back = k > 0 && (per_cell < 2 ? true : k % per_cell > 0);
  const int first = back || k + 2 >= n ? k - 1 : k;
  if (first < 0) return {};
  const double a = parameters[first], b = parameters[first + 1], c = parameters[first + 2];
  const double h = parameters[k + 1] - parameters[k], scale = -h * h / 8;
  const Terms terms{{sample(first), 2 * scale / ((b - a) * (c - a))},
                    {sample(first + 1), -2 * scale / ((b - a) * (c - b))},
                    {sample(first + 2), 2 * scale / ((c - b) * (c - a))}};
  if (std::any_of(terms.begin(), terms.end(), [](const Term& t) { return t.sample < 0; })) return {};
  return terms;
}

class Builder {
 public:
  explicit Builder(int samples) : ends_(samples) { out_.middle.column_count = samples; }

  void add(int a, int b, Terms terms, bool edge = true) {
    std::sort(terms.begin(), terms.end(), [](const Term& s, const Term& t) { return s.sample < t.sample; });
    for (std::size_t k = 0; k < terms.size(); ++k) {
      double weight = terms[k].weight;
      for (; k + 1 < terms.size() && terms[k + 1].sample == terms[k].sample; ++k) weight += terms[k + 1].weight;
      out_.middle.add(terms[k].sample, weight);
    }
    out_.ends.push_back({a, b});
    for (int end : {a, b}) ends_[end].push_back({out_.middle.rows(), edge ? 1.0 : 0.0});
    out_.middle.endRow();
  }
  Bulges done() {
    out_.of_sample.column_count = out_.middle.rows();
    for (const Terms& rows : ends_) {
      for (const Term& t : rows) out_.of_sample.add(t.sample, t.weight);
      out_.of_sample.endRow();
    }
    return std::move(out_);
  }

 private:
  Bulges out_;
  std::vector<Terms> ends_;  ///< rows, and whether they are edges
};

}  // namespace

Bulges buildBulges(const Garment& garment, const Surface& surface, std::span<const int> per_cell) {
  Builder builder(surface.size());
  for (std::size_t p = 0; p < garment.patches.size(); ++p) {
    const auto [nu, nv] = surface.patch_grid_size[p];
    const std::vector<double> us = sampleParameters(garment.patches[p].u, per_cell[p]);
    const std::vector<double> vs = sampleParameters(garment.patches[p].v, per_cell[p]);
    const auto sample = [&, nu = nu](int i, int j) { return surface.patch_grid[p][i + nu * j]; };
    const auto alongU = [&](int i, int j) { return along(us, per_cell[p], i, [&](int k) { return sample(k, j); }); };
    const auto alongV = [&](int i, int j) { return along(vs, per_cell[p], j, [&](int k) { return sample(i, k); }); };
    for (int j = 0; j < nv; ++j)
      for (int i = 0; i < nu; ++i) {
        if (i + 1 < nu)
          if (const auto terms = alongU(i, j)) builder.add(sample(i, j), sample(i + 1, j), *terms);
        if (j + 1 < nv)
          if (const auto terms = alongV(i, j)) builder.add(sample(i, j), sample(i, j + 1), *terms);
        if (i + 1 == nu || j + 1 == nv) continue;
        Terms middle;
        bool whole = true;
        for (const auto& side : {alongU(i, j), alongU(i, j + 1), alongV(i, j), alongV(i + 1, j)}) {
          whole = whole && side;
          if (side)
            for (const Term& t : *side) middle.push_back({t.sample, 0.5 * t.weight});
        }
        if (!whole) continue;
        const int a = sample(i, j), b = sample(i + 1, j), c = sample(i + 1, j + 1), d = sample(i, j + 1);
        const auto diagonal = [&](int from, int to, double twist, bool edge) {
          Terms terms = middle;
          for (const Term& t : {Term{a, twist}, Term{b, -twist}, Term{c, twist}, Term{d, -twist}}) terms.push_back(t);
          builder.add(from, to, std::move(terms), edge);
        };
        const bool first = (i + j) % 2 == 0;  // is an edge of the triangles
        diagonal(a, c, -0.25, first);
        diagonal(b, d, 0.25, !first);
      }
  }
  return builder.done();
}

}  // namespace gambeson
