#include "core/cloth/joined_cloth.hpp"

#include <algorithm>

#include "core/cloth/free_blocks.hpp"
#include "core/math/instruction_sets.hpp"

namespace gambeson {
namespace {

/// Rows of all parts, columns shifted by `first_column` of each.
void appendRows(const SparseRows& rows, int first_column, SparseRows& out) {
  for (int r = 0; r < rows.rows(); ++r) {
    for (int k = rows.offsets[static_cast<std::size_t>(r)]; k < rows.offsets[static_cast<std::size_t>(r) + 1]; ++k)
      out.add(first_column + rows.columns[static_cast<std::size_t>(k)], rows.values[static_cast<std::size_t>(k)]);
    out.endRow();
  }
}

template <class T, class More>
void append(std::vector<T>& to, const More& more) {
  to.insert(to.end(), more.begin(), more.end());
}

template <class T>
std::span<T> range(std::span<T> all, std::size_t from, std::size_t end) {
  return all.empty() ? all : all.subspan(from, end - from);
}

/// Points of all parts come first, then the rates of all, three in a block: blocks of rates may fall into two.
class JoinedTangent : public ClothTangent {
 public:
  explicit JoinedTangent(const JoinedCloth& cloth) : cloth_(cloth) {
    std::vector<std::vector<int>> elements;
    for (std::size_t i = 0; i < cloth.parts().size(); ++i) {
      parts_.push_back(cloth.parts()[i]->tangent());
      const BlockMatrix& K = parts_.back()->sparsity();
      for (int r = 0; r < K.rows(); ++r)
        for (long k = K.offsets[static_cast<std::size_t>(r)]; k < K.offsets[static_cast<std::size_t>(r) + 1]; ++k) {
          std::vector<int> rows;
          for (const int row : {r, K.columns[static_cast<std::size_t>(k)]})
            for (int d = 0; d < 3; ++d)
              if (const int at = componentOf(i, 3 * row + d); at >= 0) rows.push_back(at / 3);
          std::sort(rows.begin(), rows.end());
          rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
          elements.push_back(std::move(rows));
        }
    }
    sparsity_ = blockSparsity(cloth.map().T.column_count + cloth.innerBlocks(), elements);
  }
  const BlockMatrix& sparsity() const override { return sparsity_; }
  void assemble(const ClothState& state, ClothWork& work, BlockMatrix& K, const ForceTerms& terms) const override {
    if (K.columns.size() != sparsity_.columns.size() || K.offsets != sparsity_.offsets) K = sparsity_;
    K.values.assign(9 * K.columns.size(), 0.0);
    work.parts.resize(parts_.size());
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      BlockMatrix own = parts_[i]->sparsity();
      parts_[i]->assemble(cloth_.stateOf(state, i), work.parts[i], own, terms);
      addPart(i, own, K);
    }
  }
  void holdIdle(const ClothState& state, BlockMatrix& K) const override {
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      BlockMatrix own = parts_[i]->sparsity();
      own.values.assign(9 * own.columns.size(), 0.0);
      parts_[i]->holdIdle(cloth_.stateOf(state, i), own);
      addPart(i, own, K);
    }
  }
  void assembleDamping(const ClothState& state, ClothWork& work, BlockMatrix& D) const override {
    if (D.columns.size() != sparsity_.columns.size() || D.offsets != sparsity_.offsets) D = sparsity_;
    D.values.resize(9 * D.columns.size());
    work.parts.resize(parts_.size());
    std::size_t at = 0;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      BlockMatrix own;
      parts_[i]->assembleDamping(cloth_.stateOf(state, i), work.parts[i], own);
      std::copy(own.values.begin(), own.values.end(), D.values.begin() + static_cast<long>(at));
      at += own.values.size();
    }
  }

 private:
  /// Of a component of a part's blocks; -1: it fills a block up.
  int componentOf(std::size_t part, int component) const {
    const int points = 3 * (cloth_.firstFree(part + 1) - cloth_.firstFree(part)), rate = component - points;
    if (rate < 0) return 3 * cloth_.firstFree(part) + component;
    if (rate >= cloth_.firstRate(part + 1) - cloth_.firstRate(part)) return -1;
    return 3 * cloth_.map().T.column_count + cloth_.firstRate(part) + rate;
  }
  void addPart(std::size_t part, const BlockMatrix& own, BlockMatrix& K) const {
    for (int r = 0; r < own.rows(); ++r)
      for (long k = own.offsets[static_cast<std::size_t>(r)]; k < own.offsets[static_cast<std::size_t>(r) + 1]; ++k)
        addBlock(part, r, own.columns[static_cast<std::size_t>(k)], own.values.data() + 9 * k, K);
  }
  void addBlock(std::size_t part, int row, int column, const double* values, BlockMatrix& K) const {
    for (int e = 0; e < 9; ++e) {
      const int r = componentOf(part, 3 * row + e / 3), c = componentOf(part, 3 * column + e % 3);
      if (r < 0 || c < 0 || r / 3 > c / 3) continue;
      K.values[static_cast<std::size_t>(9 * K.find(r / 3, c / 3) + 3 * (r % 3) + c % 3)] += values[e];
      // A block that was none of the diagonal and is now: its mirror image.
      if (row != column && r / 3 == c / 3)
        K.values[static_cast<std::size_t>(9 * K.find(r / 3, c / 3) + 3 * (c % 3) + r % 3)] += values[e];
    }
  }

  const JoinedCloth& cloth_;
  std::vector<std::unique_ptr<ClothTangent>> parts_;
  BlockMatrix sparsity_;
};

class JoinedStress : public StressView {
 public:
  explicit JoinedStress(const JoinedCloth& cloth) : cloth_(cloth) {
    for (const auto& part : cloth.parts()) {
      parts_.push_back(part->stress());
      first_.push_back(first_.back() + parts_.back()->cells());
    }
  }
  std::size_t cells() const override { return first_.back(); }
  std::vector<Sample> means(const ClothState& state, const More& more) const override {
    std::vector<Sample> all;
    for (std::size_t i = 0; i < parts_.size(); ++i)
      append(all, parts_[i]->means(cloth_.stateOf(state, i), moreOf(i, more)));
    return all;
  }
  PrincipalStress at(const ClothState& state, int patch, Vec2 uv, std::span<const Sample> means,
                     const More& more) const override {
    const auto [i, own] = cloth_.partOf(patch);
    return parts_[i]->at(cloth_.stateOf(state, i), own, uv, meansOf(i, means), moreOf(i, more));
  }
  PlaneTensor strainAt(const ClothState& state, int patch, Vec2 uv, std::span<const Sample> means) const override {
    const auto [i, own] = cloth_.partOf(patch);
    return parts_[i]->strainAt(cloth_.stateOf(state, i), own, uv, meansOf(i, means));
  }

 private:
  std::span<const Sample> meansOf(std::size_t part, std::span<const Sample> means) const {
    return means.empty() ? means : means.subspan(first_[part], first_[part + 1] - first_[part]);
  }
  More moreOf(std::size_t part, const More& more) const {
    if (!more) return {};
    return [&more, first = cloth_.firstPatch(part)](int patch, Vec2 uv) { return more(first + patch, uv); };
  }

  const JoinedCloth& cloth_;
  std::vector<std::unique_ptr<StressView>> parts_;
  std::vector<std::size_t> first_{0};  ///< means of each part, and the end
};

class JoinedMounting : public Mounting {
 public:
  explicit JoinedMounting(const JoinedCloth& cloth) : c_(cloth) {}

  PlaceRow place(int patch, Vec2 uv) const override {
    const auto [i, own] = c_.partOf(patch);
    PlaceRow row = of(i).place(own, uv);
    for (int& column : row.columns) column += c_.firstPoint(i);
    return row;
  }
  PlaceRow weft(int patch, Vec2 uv) const override {
    const auto [i, own] = c_.partOf(patch);
    PlaceRow row = of(i).weft(own, uv);
    for (int& column : row.columns) column += c_.firstPoint(i);
    return row;
  }
  std::vector<int> edgePoints(const PatchEdge& edge, int rows) const override {
    const auto [i, own] = ownEdge(edge);
    std::vector<int> points = of(i).edgePoints(own, rows);
    for (int& p : points) p += c_.firstPoint(i);
    return points;
  }
  double edgeLength(const PatchEdge& edge) const override {
    const auto [i, own] = ownEdge(edge);
    return of(i).edgeLength(own);
  }
  std::vector<LinearConstraint> holdEdge(const PatchEdge& edge, std::span<const Vec3> directions,
                                         const Prescribed& motion) const override {
    const auto [i, own] = ownEdge(edge);
    return shifted(i, of(i).holdEdge(own, directions, motion));
  }
  std::vector<LinearConstraint> holdPlace(int patch, Vec2 uv, std::span<const Vec3> directions,
                                          const Prescribed& motion) const override {
    const auto [i, own] = c_.partOf(patch);
    return shifted(i, of(i).holdPlace(own, uv, directions, motion));
  }
  std::vector<LinearConstraint> clampEdge(const PatchEdge& edge) const override {
    const auto [i, own] = ownEdge(edge);
    return shifted(i, of(i).clampEdge(own));
  }
  std::vector<LinearConstraint> mirrorEdge(const PatchEdge& edge, const Vec3& normal) const override {
    const auto [i, own] = ownEdge(edge);
    return shifted(i, of(i).mirrorEdge(own, normal));
  }
  std::vector<LinearConstraint> tieEdge(const PatchEdge& edge, const Vec3& direction) const override {
    const auto [i, own] = ownEdge(edge);
    return shifted(i, of(i).tieEdge(own, direction));
  }
  std::vector<LinearConstraint> turnEdge(const PatchEdge& edge, const Vec3& turn_rad, int program) const override {
    const auto [i, own] = ownEdge(edge);
    return shifted(i, of(i).turnEdge(own, turn_rad, program));
  }
  std::vector<Vec3> edgeForce(const PatchEdge& edge, const Vec3& force_N_per_m) const override {
    const auto [i, own] = ownEdge(edge);
    return among(i, of(i).edgeForce(own, force_N_per_m));
  }
  std::vector<Vec3> surfaceForce(int patch, const Vec3& force_N_per_m2) const override {
    const auto [i, own] = c_.partOf(patch);
    return among(i, of(i).surfaceForce(own, force_N_per_m2));
  }
  std::vector<Vec3> placeForce(int patch, Vec2 uv, const Vec3& force_N) const override {
    const auto [i, own] = c_.partOf(patch);
    return among(i, of(i).placeForce(own, uv, force_N));
  }
  std::vector<Vec3> weightForce(const Vec3& gravity_m_per_s2) const override {
    std::vector<Vec3> all;
    for (std::size_t i = 0; i < c_.parts().size(); ++i) append(all, of(i).weightForce(gravity_m_per_s2));
    return all;
  }
  std::vector<FollowingLoad> pressure(int patch, double pressure_Pa) const override {
    const auto [i, own] = c_.partOf(patch);
    return shifted(i, of(i).pressure(own, pressure_Pa));
  }
  std::vector<FollowingLoad> edgeMoment(const PatchEdge& edge, double moment_N) const override {
    const auto [i, own] = ownEdge(edge);
    return shifted(i, of(i).edgeMoment(own, moment_N));
  }

 private:
  const Mounting& of(std::size_t part) const { return c_.parts()[part]->mounting(); }
  std::pair<std::size_t, PatchEdge> ownEdge(PatchEdge edge) const {
    const auto [i, own] = c_.partOf(edge.patch);
    edge.patch = own;
    return {i, edge};
  }
  std::vector<LinearConstraint> shifted(std::size_t part, std::vector<LinearConstraint> all) const {
    for (LinearConstraint& c : all) {
      for (auto& term : c.terms) term.first += c_.firstPoint(part);
      for (auto& inner : c.inner) inner.first += c_.firstRate(part);
    }
    return all;
  }
  std::vector<FollowingLoad> shifted(std::size_t part, std::vector<FollowingLoad> all) const {
    for (FollowingLoad& load : all) {
      for (int& column : load.columns) column += c_.firstPoint(part);
      for (auto& inner : load.inner) inner.first += c_.firstRate(part);
    }
    return all;
  }
  std::vector<Vec3> among(std::size_t part, const std::vector<Vec3>& own) const {
    std::vector<Vec3> all(static_cast<std::size_t>(c_.points()));
    std::copy(own.begin(), own.end(), all.begin() + c_.firstPoint(part));
    return all;
  }

  const JoinedCloth& c_;
};

}  // namespace

JoinedCloth::JoinedCloth(std::vector<std::unique_ptr<const Cloth>> parts) : parts_(std::move(parts)) {
  int garments = 0;
  for (const auto& part : parts_) {
    append(rest_, part->rest());
    appendRows(part->map().T, free_.back(), map_.T);
    for (int home : part->map().home) map_.home.push_back(point_.back() + home);
    int most = 0;
    for (ClothPatch p : part->patches()) {
      most = std::max(most, p.garment);
      p.garment += garments;
      p.first_point += point_.back();
      p.end_point += point_.back();
      patches_.push_back(p);
    }
    garments += most + 1;
    patch_.push_back(static_cast<int>(patches_.size()));
    point_.push_back(static_cast<int>(rest_.size()));
    free_.push_back(free_.back() + part->map().T.column_count);
    history_.push_back(history_.back() + part->historySize());
    values_.push_back(values_.back() + part->innerValues());
    rates_.push_back(rates_.back() + part->innerRates());
  }
  map_.T.column_count = free_.back();
  map_.Tt = transpose(map_.T);
  mounting_ = std::make_unique<JoinedMounting>(*this);
}

JoinedCloth::~JoinedCloth() = default;

std::pair<std::size_t, int> JoinedCloth::partOf(int patch) const {
  std::size_t part = 0;
  while (part + 1 < parts_.size() && patch_[part + 1] <= patch) ++part;
  return {part, patch - patch_[part]};
}

ClothState JoinedCloth::stateOf(const ClothState& s, std::size_t i) const {
  return {s.q.subspan(static_cast<std::size_t>(point_[i]), static_cast<std::size_t>(point_[i + 1] - point_[i])),
          range(s.inner, values_[i], values_[i + 1]), range(s.history, history_[i], history_[i + 1]),
          range(s.v, static_cast<std::size_t>(point_[i]), static_cast<std::size_t>(point_[i + 1])), s.elapsed_s};
}

/// The bits of all hang on those vectors that any part is computed in.
std::string JoinedCloth::kernels() const {
  for (const auto& part : parts_)
    if (part->kernels() != kOneForAll) return part->kernels();
  return kOneForAll;
}

std::string JoinedCloth::describePoint(int point) const {
  std::size_t part = 0;
  while (point_[part + 1] <= point) ++part;
  return parts_[part]->describePoint(point - point_[part]) + " of garment " +
         std::to_string(patches_[static_cast<std::size_t>(patch_[part])].garment);
}

Vec2 JoinedCloth::placeOfDraft(int patch, Vec2 uv) const {
  const auto [i, own] = partOf(patch);
  return parts_[i]->placeOfDraft(own, uv);
}

int JoinedCloth::draftPoints() const {
  int sum = 0;
  for (const auto& part : parts_) sum += part->draftPoints();
  return sum;
}

std::vector<Vec3> JoinedCloth::fromDraft(std::span<const Vec3> control) const {
  std::vector<Vec3> all;
  std::size_t first = 0;
  for (const auto& part : parts_) {
    const auto count = static_cast<std::size_t>(part->draftPoints());
    append(all, part->fromDraft(control.subspan(first, count)));
    first += count;
  }
  return all;
}

Surface JoinedCloth::surface(std::span<const int> per_cell) const {
  Surface all;
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const Surface s = parts_[i]->surface(
        per_cell.subspan(static_cast<std::size_t>(patch_[i]), static_cast<std::size_t>(patch_[i + 1] - patch_[i])));
    const int first = all.size();
    appendRows(s.W, point_[i], all.W);
    append(all.area_m2, s.area_m2);
    for (const auto& [a, b, c] : s.triangles) all.triangles.push_back({first + a, first + b, first + c});
    for (const auto& [a, b] : s.twins) all.twins.push_back({first + a, first + b});
    for (int p : s.triangle_patch) all.triangle_patch.push_back(patch_[i] + p);
    append(all.triangle_cell, s.triangle_cell);
    for (int p : s.patch) all.patch.push_back(patch_[i] + p);
    append(all.parameters, s.parameters);
    append(all.patch_grid_size, s.patch_grid_size);
    for (std::vector<int> grid : s.patch_grid) {
      for (int& k : grid)
        if (k >= 0) k += first;
      all.patch_grid.push_back(std::move(grid));
    }
    for (std::size_t p = 0; p < s.patch_grid.size(); ++p) {
      all.edge_samples.push_back(s.edge_samples.empty() ? std::vector<std::vector<int>>{} : s.edge_samples[p]);
      for (std::vector<int>& side : all.edge_samples.back())
        for (int& k : side) k += first;
    }
  }
  all.W.column_count = points();
  all.WT = multiply(all.W, map_.T);
  all.WTt = transpose(all.WT);
  return all;
}

Bulges JoinedCloth::bulges(const Surface&, std::span<const int> per_cell) const {
  Bulges all;
  int samples = 0, rows = 0;
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const auto own =
        per_cell.subspan(static_cast<std::size_t>(patch_[i]), static_cast<std::size_t>(patch_[i + 1] - patch_[i]));
    const Surface s = parts_[i]->surface(own);
    const Bulges b = parts_[i]->bulges(s, own);
    appendRows(b.middle, samples, all.middle);
    appendRows(b.of_sample, rows, all.of_sample);
    for (const auto& [from, to] : b.ends) all.ends.push_back({samples + from, samples + to});
    samples += s.size();
    rows += b.middle.rows();
  }
  all.middle.column_count = samples;
  all.of_sample.column_count = rows;
  return all;
}

SparseRows JoinedCloth::finer(int fineness, std::span<const int> per_cell) const {
  SparseRows all;
  for (std::size_t i = 0; i < parts_.size(); ++i)
    appendRows(parts_[i]->finer(fineness, per_cell.subspan(static_cast<std::size_t>(patch_[i]),
                                                           static_cast<std::size_t>(patch_[i + 1] - patch_[i]))),
               point_[i], all);
  all.column_count = points();
  return all;
}

PlaceMesh JoinedCloth::placeMesh(int per_cell) const {
  PlaceMesh all;
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const PlaceMesh m = parts_[i]->placeMesh(per_cell);
    const int first = static_cast<int>(all.uv.size());
    for (int p : m.patch) all.patch.push_back(patch_[i] + p);
    append(all.uv, m.uv);
    append(all.fraction, m.fraction);
    for (const auto& [a, b, c] : m.triangles) all.triangles.push_back({first + a, first + b, first + c});
  }
  return all;
}

Fabric JoinedCloth::fabricAt(int patch, Vec2 uv) const {
  const auto [i, own] = partOf(patch);
  return parts_[i]->fabricAt(own, uv);
}

double JoinedCloth::cellAt(int patch, Vec2 uv) const {
  const auto [i, own] = partOf(patch);
  return parts_[i]->cellAt(own, uv);
}

std::vector<NetEdge> JoinedCloth::net() const {
  std::vector<NetEdge> all;
  for (std::size_t i = 0; i < parts_.size(); ++i)
    for (NetEdge e : parts_[i]->net()) all.push_back({point_[i] + e.first, point_[i] + e.second, e.per_length2});
  return all;
}

std::vector<double> JoinedCloth::areas() const {
  std::vector<double> all;
  for (const auto& part : parts_) append(all, part->areas());
  return all;
}

std::vector<double> JoinedCloth::masses() const {
  std::vector<double> all;
  for (const auto& part : parts_) append(all, part->masses());
  return all;
}

std::vector<double> JoinedCloth::evenedMasses(double share) const {
  std::vector<double> all;
  for (const auto& part : parts_) append(all, part->evenedMasses(share));
  return all;
}

SparseRows JoinedCloth::consistentMass() const {
  SparseRows all;
  for (std::size_t i = 0; i < parts_.size(); ++i) appendRows(parts_[i]->consistentMass(), point_[i], all);
  all.column_count = points();
  return all;
}

SewnRows JoinedCloth::sewnRows() const {
  SewnRows all;
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const SewnRows part = parts_[i]->sewnRows();
    appendRows(part.C, point_[i], all.C);
    appendRows(part.pairs, point_[i], all.pairs);
    all.length_m.insert(all.length_m.end(), part.length_m.begin(), part.length_m.end());
    all.hat_m.insert(all.hat_m.end(), part.hat_m.begin(), part.hat_m.end());
    all.cell_m.insert(all.cell_m.end(), part.cell_m.begin(), part.cell_m.end());
    const int first = all.seam.empty() ? 0 : all.seam.back() + 1;
    for (const int seam : part.seam) all.seam.push_back(first + seam);
  }
  all.C.column_count = all.pairs.column_count = points();
  return all;
}

void JoinedCloth::force(const ClothState& state, const ClothForce& out, ClothWork& work,
                        const ForceTerms& terms) const {
  work.parts.resize(parts_.size());
  if (out.energy) *out.energy = {};
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    ClothEnergy energy;
    const auto first = static_cast<std::size_t>(point_[i]), end = static_cast<std::size_t>(point_[i + 1]);
    parts_[i]->force(stateOf(state, i),
                     {range(out.points, first, end), range(out.inner, rates_[i], rates_[i + 1]),
                      range(out.history, history_[i], history_[i + 1]), out.energy ? &energy : nullptr},
                     work.parts[i], terms);
    if (!out.energy) continue;
    out.energy->stored += energy.stored;
    out.energy->lost += energy.lost;
  }
}

void JoinedCloth::steepForce(const ClothState& state, const ClothForce& out, ClothWork& work, ForceTerms terms,
                             const StrainBox& within) const {
  work.parts.resize(parts_.size());
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const auto first = static_cast<std::size_t>(point_[i]), end = static_cast<std::size_t>(point_[i + 1]);
    parts_[i]->steepForce(stateOf(state, i),
                          {range(out.points, first, end), range(out.inner, rates_[i], rates_[i + 1]), {}, nullptr},
                          work.parts[i], terms, within);
  }
}

bool JoinedCloth::damps() const {
  return std::any_of(parts_.begin(), parts_.end(), [](const auto& part) { return part->damps(); });
}

void JoinedCloth::dampingForce(const ClothState& state, const ClothForce& out, ClothWork& work) const {
  work.parts.resize(parts_.size());
  if (out.energy) *out.energy = {};
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    ClothEnergy energy;
    parts_[i]->dampingForce(
        stateOf(state, i),
        {range(out.points, static_cast<std::size_t>(point_[i]), static_cast<std::size_t>(point_[i + 1])),
         {},
         {},
         out.energy ? &energy : nullptr},
        work.parts[i]);
    if (out.energy) out.energy->power_W += energy.power_W;
  }
}

std::unique_ptr<ClothTangent> JoinedCloth::tangent() const { return std::make_unique<JoinedTangent>(*this); }

void JoinedCloth::startHistory(std::span<double> history) const {
  for (std::size_t i = 0; i < parts_.size(); ++i) parts_[i]->startHistory(range(history, history_[i], history_[i + 1]));
}

std::vector<HistoryPlace> JoinedCloth::historyPlaces() const {
  std::vector<HistoryPlace> all;
  for (std::size_t i = 0; i < parts_.size(); ++i)
    for (HistoryPlace p : parts_[i]->historyPlaces()) {
      p.patch += patch_[i];
      p.first += history_[i];
      all.push_back(p);
    }
  return all;
}

void JoinedCloth::startInner(std::span<double> value) const {
  for (std::size_t i = 0; i < parts_.size(); ++i) parts_[i]->startInner(range(value, values_[i], values_[i + 1]));
}

void JoinedCloth::innerMasses(std::span<double> mass) const {
  for (std::size_t i = 0; i < parts_.size(); ++i) parts_[i]->innerMasses(range(mass, rates_[i], rates_[i + 1]));
}

void JoinedCloth::dropIdle(std::span<const double> value, std::span<double> rate) const {
  for (std::size_t i = 0; i < parts_.size(); ++i)
    parts_[i]->dropIdle(range(value, values_[i], values_[i + 1]), range(rate, rates_[i], rates_[i + 1]));
}

bool JoinedCloth::turnsInner() const {
  return std::any_of(parts_.begin(), parts_.end(), [](const auto& part) { return part->turnsInner(); });
}

void JoinedCloth::advance(std::span<const double> value, std::span<const double> rate, double dt_s,
                          std::span<double> out) const {
  for (std::size_t i = 0; i < parts_.size(); ++i)
    parts_[i]->advance(range(value, values_[i], values_[i + 1]), range(rate, rates_[i], rates_[i + 1]), dt_s,
                       range(out, values_[i], values_[i + 1]));
}

std::unique_ptr<StressView> JoinedCloth::stress() const { return std::make_unique<JoinedStress>(*this); }

PointState JoinedCloth::stateAt(const ClothState& state, int patch, Vec2 uv) const {
  const auto [i, own] = partOf(patch);
  return parts_[i]->stateAt(stateOf(state, i), own, uv);
}

double JoinedCloth::bendAt(const ClothState& state, int patch, Vec2 uv) const {
  const auto [i, own] = partOf(patch);
  return parts_[i]->bendAt(stateOf(state, i), own, uv);
}

std::vector<std::pair<int, Vec2>> JoinedCloth::lawPlaces() const {
  std::vector<std::pair<int, Vec2>> all;
  for (std::size_t i = 0; i < parts_.size(); ++i)
    for (const auto& [patch, uv] : parts_[i]->lawPlaces()) all.emplace_back(patch_[i] + patch, uv);
  return all;
}

std::optional<StrainBox> JoinedCloth::lawStrains(const ClothState& state) const {
  std::optional<StrainBox> all;
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const std::optional<StrainBox> own = parts_[i]->lawStrains(stateOf(state, i));
    if (own && all)
      all->add(*own);
    else if (own)
      all = own;
  }
  return all;
}

LawRange JoinedCloth::lawRange(const ClothState& state) const {
  LawRange all;
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    all.add(parts_[i]->lawRange(stateOf(state, i)), patch_[i]);
  }
  return all;
}

bool JoinedCloth::springsAtRest(double length_m) const {
  return std::any_of(parts_.begin(), parts_.end(), [&](const auto& part) { return part->springsAtRest(length_m); });
}

StrainRows JoinedCloth::strainRows(Mobility mobility, LimitPoints points) const {
  StrainRows all;
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    StrainRows own = parts_[i]->strainRows(
        {std::vector<double>(static_cast<std::size_t>(free_[i + 1] - free_[i]), 1.0), {}}, points);
    const int first = all.rows();
    for (StrainPoint p : own.points) {
      p.patch += patch_[i];
      for (int& row : p.row)
        if (row >= 0) row += first;
      all.points.push_back(p);
    }
    appendRows(own.B, free_[i], all.B);
    append(all.area_m2, own.area_m2);
    for (std::size_t d = 0; d < 2; ++d) appendRows(own.field_of_row[d], first, all.field_of_row[d]);
    all.parts.push_back(std::move(own));
  }
  all.B.column_count = free_.back();
  for (SparseRows& field : all.field_of_row) field.column_count = all.rows();
  all.mobility = std::move(mobility);
  completeRows(all);
  return all;
}

Vec2 JoinedCloth::limitStressAt(const StrainRows& rows, std::span<const Vec2> field, int patch, Vec2 uv) const {
  const auto [i, own] = partOf(patch);
  std::size_t first = 0;
  for (std::size_t k = 0; k < i; ++k) first += static_cast<std::size_t>(rows.parts[k].field_of_row[0].rows());
  return parts_[i]->limitStressAt(
      rows.parts[i], field.subspan(first, static_cast<std::size_t>(rows.parts[i].field_of_row[0].rows())), own, uv);
}

}  // namespace gambeson
