#include "gpu/forces/flat_shell.hpp"

#include <algorithm>
#include <cstring>
#include <map>

#include "core/material/fabric_law.hpp"

namespace gambeson::gpu {
namespace {

/// Whether the kernels of quadratic cells have what the cells of a block need, but for their laws.
bool isQuad(const ShellBlock& b) {
  return b.p == 2 && b.q == 2 && b.gu == 2 && b.gv == 2 && !b.scattered && !b.assumed && !b.rest_curvature;
}

/// The laws of a point as the kernels of quadratic cells have them, if they are plain.
std::optional<PlainNumbers> plainNumbers(const PointLaw& law) {
  const Section& section = law.section;
  const auto none = [](const Voigt& v, std::initializer_list<int> entries) {
    return std::all_of(entries.begin(), entries.end(), [&](int i) { return v[static_cast<std::size_t>(i)] == 0; });
  };
  const bool zheng = law.kind == BendingLaws::kind<ZhengBending>;
  if ((law.kind != 0 && !zheng) || law.tension != 0 || law.shear != std::array<double, 3>{} ||
      !none(section.A, {4, 5}) || !none(section.B, {0, 1, 2, 3, 4, 5}) || !none(section.D, {3, 4, 5}))
    return std::nullopt;
  PlainNumbers n;
  n.membrane = {section.A[0], section.A[1], section.A[3], section.A[2]};
  std::copy_n(section.D.begin(), 3, n.D);
  n.zheng = zheng;
  if (zheng) {
    n.k0 = law.numbers[0];
    n.kr = law.numbers[1];
    n.inverse_kr2 = 1 / (n.kr * n.kr);
    for (int i = 0; i < 2; ++i) n.steep[i] = 2 * n.D[i] * std::sqrt(n.k0 / n.kr);
  }
  n.jams = law.jam_N_per_m > 0;
  n.jam_N_per_m = law.jam_N_per_m;
  n.jam_s = law.jam_s;
  return n;
}

/// The cells of a part that belong to one patch: which of its first control points they start at.
struct PatchCells {
  std::vector<std::array<int, 2>> at;  ///< row and column
  std::vector<int> cell;               ///< of the part
  std::vector<int> columns, rows;      ///< distinct, ascending
};

std::vector<int> distinct(const std::vector<std::array<int, 2>>& at, std::size_t k) {
  std::vector<int> list;
  for (const auto& a : at) list.push_back(a[k]);
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
  return list;
}

class Flattener {
 public:
  Flattener(const Shell& shell, bool general_alone)
      : shell_(shell), general_alone_(general_alone), offsets_(controlOffsets(shell.garment())) {
    out_.points = shell.controlCount();
    out_.gauss_points = shell.gaussPoints();
    for (const NurbsPatch& patch : shell.garment().patches)
      out_.weights.insert(out_.weights.end(), patch.weights.begin(), patch.weights.end());
    slots_.resize(static_cast<std::size_t>(out_.points));
    summed_.assign(static_cast<std::size_t>(out_.points), false);
  }

  FlatShell flat() {
    for (const ShellPart& part : shell_.parts()) {
      std::vector<int> others;
      for (const auto& [p, cells] : cellsByPatch(part))
        if (!addSheet(part, p, cells)) others.insert(others.end(), cells.cell.begin(), cells.cell.end());
      if (!others.empty()) addCells(part, std::move(others));
    }
    addSeams();
    closeSlots();
    return std::move(out_);
  }

 private:
  int firstNode(const ShellBlock& b, int cell) const {
    return b.nodes[static_cast<std::size_t>(cell / b.lanes) * b.nodeCount() * b.lanes + cell % b.lanes];
  }
  const NurbsPatch& patch(int p) const { return shell_.garment().patches[static_cast<std::size_t>(p)]; }

  std::map<int, PatchCells> cellsByPatch(const ShellPart& part) const {
    std::map<int, PatchCells> all;
    for (int c = 0; c < part.cell_count; ++c) {
      const int node = firstNode(part.block, c);
      const int p = static_cast<int>(std::upper_bound(offsets_.begin(), offsets_.end(), node) - offsets_.begin()) - 1;
      const int local = node - offsets_[static_cast<std::size_t>(p)], nu = patch(p).u.count();
      all[p].at.push_back({local / nu, local % nu});
      all[p].cell.push_back(c);
    }
    for (auto& entry : all) {
      entry.second.rows = distinct(entry.second.at, 0);
      entry.second.columns = distinct(entry.second.at, 1);
    }
    return all;
  }

  /// The one law of some cells' points; none: there are several.
  std::optional<PointLaw> lawOf(const ShellPart& part, const std::vector<int>& cells) const {
    const ShellBlock& b = part.block;
    if (b.laws.empty()) return part.law.point;
    std::optional<std::array<double, kLawDoubles>> one;
    for (const int c : cells)
      for (long g = 0; g < 4; ++g) {
        std::array<double, kLawDoubles> law;
        for (int k = 0; k < kLawDoubles; ++k)
          law[static_cast<std::size_t>(k)] =
              b.laws[static_cast<std::size_t>(((c / b.lanes * 4 + g) * kLawDoubles + k) * b.lanes + c % b.lanes)];
        if (one && *one != law) return std::nullopt;
        one = law;
      }
    PointLaw law;
    std::memcpy(static_cast<void*>(&law), one->data(), sizeof law);
    return law;
  }

  bool addSheet(const ShellPart& part, int p, const PatchCells& cells) {
    const ShellBlock& b = part.block;
    if (general_alone_ || !isQuad(b) || cells.cell.size() != cells.columns.size() * cells.rows.size()) return false;
    const auto point = lawOf(part, cells.cell);
    const auto law = point ? plainNumbers(*point) : std::nullopt;
    if (!law) return false;
    FlatQuads& q = out_.quads;
    const int across = static_cast<int>(cells.columns.size()), along = static_cast<int>(cells.rows.size());
    const int points_u = patch(p).u.count(), points_v = patch(p).v.count();
    q.sheets.push_back({across, along, points_u, points_v, offsets_[static_cast<std::size_t>(p)],
                        static_cast<int>(q.function_u.size()), static_cast<int>(q.function_v.size()),
                        static_cast<int>(q.touched_u.size()), static_cast<int>(q.touched_v.size()),
                        static_cast<int>(q.laws.size()), static_cast<long>(q.rest.size()), b.rational});
    q.laws.push_back(*law);
    q.points.push_back(*point);
    q.blocks.push_back(&part.law);
    const long L = b.lanes;
    // Row by row.
    std::vector<int> sorted(cells.cell.size());
    const auto placeOf = [](const std::vector<int>& list, int value) {
      return static_cast<std::size_t>(std::lower_bound(list.begin(), list.end(), value) - list.begin());
    };
    for (std::size_t i = 0; i < cells.cell.size(); ++i)
      sorted[placeOf(cells.rows, cells.at[i][0]) * cells.columns.size() + placeOf(cells.columns, cells.at[i][1])] =
          cells.cell[i];
    const auto add = [&](const std::vector<int>& first, const AlignedVector<double>& basis, std::vector<int>& function,
                         std::vector<double>& bases, std::vector<Touched>& touched, int points, auto&& cell_of) {
      function.insert(function.end(), first.begin(), first.end());
      for (int i = 0; i < static_cast<int>(first.size()); ++i)
        for (int k = 0; k < 18; ++k) {
          const long c = cell_of(i);
          bases.push_back(basis[static_cast<std::size_t>((c / L * 18 + k) * L + c % L)]);
        }
      const std::size_t at = touched.size();
      touched.resize(at + static_cast<std::size_t>(points), Touched{{-1, -1, -1}, -1});
      for (int i = 0; i < static_cast<int>(first.size()); ++i)
        for (int a = 0; a < 3; ++a) {
          Touched& t = touched[at + static_cast<std::size_t>(first[static_cast<std::size_t>(i)] + a)];
          t.cell[a] = i;
          t.last = std::max(t.last, i);
        }
    };
    add(cells.columns, b.basis_u, q.function_u, q.basis_u, q.touched_u, points_u,
        [&](int i) { return sorted[static_cast<std::size_t>(i)]; });
    add(cells.rows, b.basis_v, q.function_v, q.basis_v, q.touched_v, points_v,
        [&](int j) { return sorted[static_cast<std::size_t>(j) * cells.columns.size()]; });
    const std::size_t count = cells.cell.size(), first = q.rest.size();
    const int numbers = b.pointDoubles();
    q.rest.resize(first + 4 * count * static_cast<std::size_t>(numbers));
    for (std::size_t at = 0; at < count; ++at) {
      const long c = sorted[at], group = c / L;
      for (long g = 0; g < 4; ++g)
        for (int k = 0; k < numbers; ++k) {
          const double x = b.points[static_cast<std::size_t>(((group * 4 + g) * numbers + k) * L + c % L)];
          // The denominator as what it multiplies by.
          q.rest[first + 4 * (at * static_cast<std::size_t>(numbers) + static_cast<std::size_t>(k)) +
                 static_cast<std::size_t>(g)] = k == 5 ? 1 / x : x;
        }
    }
    q.cells += static_cast<long>(count);
    for (int i = offsets_[static_cast<std::size_t>(p)]; i < offsets_[static_cast<std::size_t>(p) + 1]; ++i)
      summed_[static_cast<std::size_t>(i)] = true;
    return true;
  }

  void addCells(const ShellPart& part, std::vector<int> list) {
    const ShellBlock& b = part.block;
    FlatCells cells;
    cells.block = &b;
    cells.block_law = &part.law;
    cells.law = numbersOf(part.law.point);
    cells.shape = {.lanes = b.lanes,
                   .cells = static_cast<int>(list.size()),
                   .list = nullptr,
                   .p = b.p,
                   .q = b.q,
                   .gu = b.gu,
                   .gv = b.gv,
                   .point_doubles = b.pointDoubles(),
                   .rational = b.rational,
                   .scattered = b.scattered,
                   .rest_curvature = b.rest_curvature,
                   .nodes = nullptr,
                   .weights = nullptr,
                   .basis_u = nullptr,
                   .basis_v = nullptr,
                   .shapes = nullptr,
                   .points = nullptr,
                   .first_point = nullptr,
                   .law = nullptr,
                   .laws = nullptr,
                   .use = part.law.use,
                   .history_size = part.law.use.historySize(),
                   .history_first = b.history_first,
                   .first_slot = out_.slots};
    const int nodes = b.nodeCount();
    for (const int c : list)
      for (int k = 0; k < nodes; ++k)
        addSlot(b.nodes[(static_cast<std::size_t>(c / b.lanes) * nodes + k) * b.lanes + c % b.lanes]);
    cells.list = std::move(list);
    out_.cells.push_back(std::move(cells));
  }

  void addSlot(int point) { slots_[static_cast<std::size_t>(point)].push_back(out_.slots++); }

  void addSeams() {
    FlatSeams& s = out_.seams;
    s.hinge_slot = out_.slots;
    for (const HingePoint& h : shell_.hinges()) {
      for (std::size_t k = 0; k < h.columns.size(); ++k) {
        s.hinge_column.push_back(h.columns[k]);
        s.hinge_rows.insert(s.hinge_rows.end(), {h.t[k], h.a[k], h.b[k]});
        addSlot(h.columns[k]);
      }
      s.first_hinge.push_back(static_cast<int>(s.hinge_column.size()));
      s.hinge_numbers.insert(s.hinge_numbers.end(), {h.stiffness_length, h.theta0});
    }
    s.gap_slot = out_.slots;
    for (const GapPoint& g : shell_.gaps()) {
      for (std::size_t k = 0; k < g.columns.size(); ++k) {
        s.gap_column.push_back(g.columns[k]);
        s.gap_row.push_back(g.row[k]);
        addSlot(g.columns[k]);
      }
      s.first_gap.push_back(static_cast<int>(s.gap_column.size()));
      s.gap_stiffness.push_back(g.stiffness_N_per_m);
    }
  }

  void closeSlots() {
    for (int i = 0; i < out_.points; ++i)
      if (!summed_[static_cast<std::size_t>(i)]) out_.gathered.push_back(i);
    if (out_.slots == 0 && out_.gathered.empty()) return;
    out_.first_slot.push_back(0);
    for (const std::vector<int>& list : slots_) {
      out_.slot_list.insert(out_.slot_list.end(), list.begin(), list.end());
      out_.first_slot.push_back(static_cast<int>(out_.slot_list.size()));
    }
  }

  const Shell& shell_;
  bool general_alone_;
  std::vector<int> offsets_;
  std::vector<std::vector<int>> slots_;  ///< of each control point
  std::vector<bool> summed_;             ///< by a sheet
  FlatShell out_;
};

constexpr int kAnyNumber = 1 << 30;

/// Control points along one direction that a block takes, and the cells that touch them: at most `cells` of these, at
/// most `points` of those.
struct Span {
  int point, point_end, cell, cell_end;
};
std::vector<Span> spansOf(const Touched* touched, const int* function, int count, int cells, int points) {
  const auto first = [&](int i) {
    int least = touched[i].last;
    for (const int c : touched[i].cell)
      if (c >= 0) least = std::min(least, c);
    return least;
  };
  std::vector<Span> spans;
  for (int at = 0; at < count;) {
    Span span{at, at, first(at), 0};
    const auto fits = [&](int last) {
      return last - span.cell < cells && function[last] + 3 - function[span.cell] <= roomFor(cells);
    };
    while (span.point_end < count && span.point_end - at < points && fits(touched[span.point_end].last))
      span.cell_end = touched[span.point_end++].last + 1;
    spans.push_back(span);
    at = span.point_end;
  }
  return spans;
}

std::vector<QuadWork> worksOf(const FlatQuads& quads, int cells_u, int cells_v, int points_v) {
  std::vector<QuadWork> works;
  for (const QuadSheet& s : quads.sheets) {
    const auto across = spansOf(quads.touched_u.data() + s.first_point_u, quads.function_u.data() + s.first_column,
                                s.points_u, cells_u, s.points_u);
    const auto along = spansOf(quads.touched_v.data() + s.first_point_v, quads.function_v.data() + s.first_row,
                               s.points_v, cells_v, points_v);
    for (const Span& v : along)
      for (const Span& u : across)
        works.push_back({s, u.cell, u.cell_end, v.cell, v.cell_end, u.point, u.point_end, v.point, v.point_end});
  }
  return works;
}

}  // namespace

FlatShell flatShell(const Shell& shell, bool general_alone) { return Flattener(shell, general_alone).flat(); }

FlatLaws flatLaws(const FlatShell& flat, const ForceTerms& terms) {
  FlatLaws out;
  for (std::size_t k = 0; k < flat.quads.laws.size(); ++k) {
    PointNumbers<double> numbers = numbersOf(flat.quads.points[k]);
    leaveOut(withTerms(*flat.quads.blocks[k], terms), numbers);
    PointLaw law;
    std::memcpy(static_cast<void*>(&law), &numbers, sizeof law);
    out.sheets.push_back(plainNumbers(law).value());
  }
  for (const FlatCells& from : flat.cells) {
    const BlockLaw law = withTerms(*from.block_law, terms);
    FlatLaws::OfCells& to = out.cells.emplace_back();
    to.law = from.law;
    leaveOut(law, to.law);
    to.use = law.evaluated();
    const ShellBlock& b = *from.block;
    to.laws.assign(b.laws.begin(), b.laws.end());
    const std::size_t L = static_cast<std::size_t>(b.lanes), groups = b.laws.size() / (L * kLawDoubles);
    for (std::size_t at = 0; at < groups * L; ++at) {
      const std::size_t first = at / L * kLawDoubles * L + at % L;
      PointNumbers<double> numbers;
      double* const number = reinterpret_cast<double*>(&numbers);
      for (std::size_t k = 0; k < kLawDoubles; ++k) number[k] = to.laws[first + k * L];
      leaveOut(law, numbers);
      for (std::size_t k = 0; k < kLawDoubles; ++k) to.laws[first + k * L] = number[k];
    }
  }
  return out;
}

std::optional<std::string> notCarried(const Shell& shell) {
  for (const ShellPart& part : shell.parts()) {
    if (part.block.assumed) return "assumed strains";
    if (part.law.use.shears) return "friction in shear";
  }
  return std::nullopt;
}

std::vector<QuadWork> tilesOf(const FlatQuads& quads, int cells_u, int cells_v) {
  return worksOf(quads, cells_u, cells_v, kAnyNumber);
}

std::vector<QuadWork> stripsOf(const FlatQuads& quads, int cells_u, int rows) {
  return worksOf(quads, cells_u, kAnyNumber, rows);
}

}  // namespace gambeson::gpu
