#pragma once
/// The forces of a NURBS shell on a device.

#include <algorithm>
#include <tuple>
#include <type_traits>

#include "core/cloth/shell/nurbs_shell.hpp"
#include "core/error.hpp"
#include "gpu/forces/blocks.hpp"
#include "gpu/forces/flat_shell.hpp"
#include "gpu/forces/forces.hpp"
#include "gpu/forces/sliced_rows.hpp"

namespace gambeson::gpu {

/// What is compiled; the first is what is quick.
using QuadTiles = std::tuple<QuadTile<12, 8, 1>, QuadTile<8, 12, 1>, QuadTile<8, 8, 2>>;
using QuadStrips = std::tuple<QuadStrip<64, 2>, QuadStrip<32, 4>, QuadStrip<32, 3>>;

/// f(type, index) for the k-th type of a tuple.
template <class Tuple, class F, std::size_t kAt = 0>
void withType(int k, const F& f) {
  if constexpr (kAt < std::tuple_size_v<Tuple>) {
    if (k == static_cast<int>(kAt))
      f(std::type_identity<std::tuple_element_t<kAt, Tuple>>{});
    else
      withType<Tuple, F, kAt + 1>(k, f);
  }
}

/// From so many cells on strips are quicker.
constexpr long kStripCells = 30000;
/// Blocks of a strip that a device is given.
constexpr int kStripBlocks = 528;

template <class Device>
class ShellForces final : public Forces {
  template <class T>
  using Buffer = typename Device::template Buffer<T>;

 public:
  ShellForces(const NurbsShell& cloth, const ForceOptions& options) : options_(options) {
    FlatShell flat = flatShell(cloth.elements(), options.general_cells);
    points_ = flat.points;
    gauss_points_ = flat.gauss_points;
    std::vector<Point4> rest(static_cast<std::size_t>(points_));
    for (int i = 0; i < points_; ++i) {
      const Vec3& x = cloth.rest()[static_cast<std::size_t>(i)];
      rest[static_cast<std::size_t>(i)] = {x.x, x.y, x.z, flat.weights[static_cast<std::size_t>(i)]};
    }
    put(rest, position_);
    weights_ = flat.weights;
    force_ = Buffer<Point4>(static_cast<std::size_t>(points_));
    putMap(cloth.map());
    putQuads(flat.quads);
    put(flat.quads.laws, own_.sheets);
    putCells(flat);
    putSeams(flat.seams);
    put(flat.first_slot, first_slot_);
    put(flat.slot_list, slot_list_);
    put(flat.gathered, gathered_);
    slot_ = Buffer<Vec3>(static_cast<std::size_t>(flat.slots));
    trial_ = Buffer<double>(cloth.historySize());
    committed_ = Buffer<double>(cloth.historySize());
  }

  int points() const override { return points_; }
  int freePoints() const override { return free_points_; }
  ForceArrays arrays() override {
    return {freePosition(),
            position_.data(),
            force_.data(),
            freeForceData(),
            motion_ ? motion_->velocity().data() : nullptr,
            motion_ ? motion_->acceleration().data() : nullptr};
  }

  void setFree(std::span<const Vec3> p) override {
    if (identity_) return setPositions(p);
    std::vector<Point4> all;
    for (const Vec3& x : p) all.push_back({x.x, x.y, x.z, 0});
    queue_.upload(std::span<const Point4>(all), free_position_);
  }
  void setPositions(std::span<const Vec3> q) override {
    std::vector<Point4> all;
    for (std::size_t i = 0; i < q.size(); ++i) all.push_back({q[i].x, q[i].y, q[i].z, weights_[i]});
    queue_.upload(std::span<const Point4>(all), position_);
  }
  void setHistory(std::span<const double> committed, double elapsed_s) override {
    elapsed_s_ = elapsed_s;
    has_history_ = !committed.empty();
    if (has_history_) queue_.upload(committed, committed_);
  }

  void placePoints() override { placePoints(queue_); }
  void evaluate() override { give(queue_); }
  void freeForces() override { freeForces(queue_); }
  void commitHistory() override { commitHistory(queue_); }

  void setLoads(const PointLoads& loads) override { motion_.emplace(queue_, loads); }
  void setAnchors(std::span<const Vec3> anchors, std::span<const Vec3> normals) override {
    motion().setAnchors(queue_, anchors, normals);
  }
  void setVelocities(std::span<const Vec3> v) override { motion().setVelocities(queue_, v); }
  void accelerate(const Vec3& air, double half_step_s) override { accelerate(queue_, air, half_step_s); }

  std::vector<Vec3> velocity() override { return vectors(motion().velocity()); }
  std::vector<Vec3> acceleration() override { return vectors(motion().acceleration()); }
  std::vector<Vec3> force() override { return vectors(force_); }
  std::vector<Vec3> freeForce() override { return vectors(identity_ ? force_ : free_force_); }
  std::vector<double> history() override { return queue_.download(trial_, trial_.size()); }

  double medianMicroseconds(int passes) override {
    constexpr int kInARow = 10;
    typename Device::Replay replay(queue_, [&] {
      for (int i = 0; i < kInARow; ++i) give(queue_);
    });
    replay.run(queue_);
    std::vector<double> times;
    for (int i = 0; i < passes; ++i)
      times.push_back(1e3 / kInARow * Device::milliseconds(queue_, [&] { replay.run(queue_); }));
    std::ranges::sort(times);
    return times[times.size() / 2];
  }

  // The same, given to a queue of whoever steps.
  void placePoints(typename Device::Queue& queue) {
    if (!identity_) queue.forEach(points_, MapPoints{map_.view(), free_position_.data(), position_.data()});
  }
  void freeForces(typename Device::Queue& queue) {
    if (!identity_) queue.forEach(free_points_, MapPoints{transpose_.view(), force_.data(), free_force_.data()});
  }
  void commitHistory(typename Device::Queue& queue) {
    if (trial_.size() == 0) return;
    has_history_ = true;
    queue.forEach(static_cast<int>(trial_.size()), CopyNumbers{trial_.data(), committed_.data()});
  }
  void accelerate(typename Device::Queue& queue, const Vec3& air, double half_step_s) {
    motion().give(queue, freePosition(), freeForceData(), air, half_step_s);
  }
  void setAnchors(typename Device::Queue& queue, std::span<const Vec3> anchors) {
    motion().setAnchors(queue, anchors, anchors);  // kernels set the normals
  }
  std::vector<double> committedHistory() { return queue_.download(committed_, committed_.size()); }
  Point4* springNormals() { return motion().normals(); }
  /// Values of all points from those of free ones: in `room`, or these themselves where all points are free.
  const Point4* mapped(typename Device::Queue& queue, const Buffer<Point4>& of_free, Buffer<Point4>& room) const {
    if (identity_) return of_free.data();
    queue.forEach(points_, MapPoints{map_.view(), of_free.data(), room.data()});
    return room.data();
  }
  void setElapsed(double elapsed_s) { elapsed_s_ = elapsed_s; }
  /// The kernels of one evaluation.
  void give(typename Device::Queue& queue) {
    const HistoryArrays history{has_history_ ? committed_.data() : nullptr, trial_.size() > 0 ? trial_.data() : nullptr,
                                elapsed_s_};
    giveSeamSlots(queue, position_.data());
    giveCells(queue, own_, history, position_.data(), force_.data());
  }

  // Evaluations elsewhere, with other laws: whatever a step reads stays. Their laws have no history.
  struct OfCells {
    Buffer<PointNumbers<double>> law;
    Buffer<double> laws;
  };
  /// Laws as an evaluation reads them.
  struct Laws {
    Buffer<PlainNumbers> sheets;
    std::vector<OfCells> buffers;
    std::vector<CellArrays> cells;
    bool seams = true;
  };
  /// What several terms leave of the laws, each at its steepest.
  std::vector<Laws> steepest(const NurbsShell& cloth, std::span<const ForceTerms> terms) {
    const FlatShell flat = flatShell(cloth.elements(), options_.general_cells);
    std::vector<Laws> all;
    for (ForceTerms of : terms) {
      of.steepest = true;
      const FlatLaws from = flatLaws(flat, of);
      Laws& to = all.emplace_back();
      to.seams = of.seams;
      put(from.sheets, to.sheets);
      for (std::size_t k = 0; k < from.cells.size(); ++k) {
        OfCells& room = to.buffers.emplace_back();
        put(std::vector<PointNumbers<double>>{from.cells[k].law}, room.law);
        put(from.cells[k].laws, room.laws);
        CellArrays& cells = to.cells.emplace_back(own_.cells[k]);
        cells.law = room.law.data();
        cells.laws = room.laws.size() > 0 ? room.laws.data() : nullptr;
        cells.use = from.cells[k].use;
      }
    }
    return all;
  }
  /// Into `force`, by these laws. Positions carry the weights.
  void give(typename Device::Queue& queue, const Laws& laws, const Point4* position, Point4* force) {
    if (laws.seams)
      giveSeamSlots(queue, position);
    else if (hinges_ + gaps_ > 0)
      queue.zero(slot_);
    giveCells(queue, laws, {}, position, force);
  }
  bool hasSeams() const { return hinges_ + gaps_ > 0; }
  /// What seams alone give.
  void giveSeams(typename Device::Queue& queue, const Point4* position, Point4* force) {
    giveSeamSlots(queue, position);
    queue.forEach(points_, GatherSeams{first_slot_.data(), slot_list_.data(), hinge_slot_, slot_.data(), force});
  }
  /// Weights of the control points.
  const std::vector<double>& weights() const { return weights_; }
  /// Whether all points are free, and what there is no T for.
  bool allFree() const { return identity_; }
  SlicedView map() const { return map_.view(); }
  SlicedView transposed() const { return transpose_.view(); }
  PointMotion<Device>& motion() {
    if (!motion_) throw RunError("forces on a device: setLoads comes before what moves");
    return *motion_;
  }

 private:
  void giveSeamSlots(typename Device::Queue& queue, const Point4* position) {
    Vec3* const slot = slot_.data();
    queue.forEach(hinges_, HingeForces{first_hinge_.data(), hinge_column_.data(), hinge_rows_.data(),
                                       hinge_numbers_.data(), position, slot + hinge_slot_});
    queue.forEach(gaps_, GapForces{first_gap_.data(), gap_column_.data(), gap_row_.data(), gap_stiffness_.data(),
                                   position, slot + gap_slot_});
  }
  /// With what seams have left in their slots.
  void giveCells(typename Device::Queue& queue, const Laws& laws, const HistoryArrays& history, const Point4* position,
                 Point4* force) {
    Vec3* const slot = slot_.data();
    for (const CellArrays& cells : laws.cells) queue.forGroups(cells.cells, CellForces{cells, history, position, slot});
    const MoreSlots more{slot_.size() > 0 ? first_slot_.data() : nullptr, slot_list_.data(), slot};
    if (works_.size() > 0) {
      const auto run = [&]<class Kernel>(std::type_identity<Kernel>) {
        runQuads<Kernel>(queue, more, laws, position, force);
      };
      if (strips_)
        withType<QuadStrips>(size_, run);
      else
        withType<QuadTiles>(size_, run);
    }
    queue.forEach(static_cast<int>(gathered_.size()),
                  GatherSlots{gathered_.data(), first_slot_.data(), slot_list_.data(), slot, force});
  }

  template <class List, class T>
  void put(const List& from, Buffer<T>& to) {
    to = Buffer<T>(from.size());
    if (!from.empty()) queue_.upload(std::span<const T>(from.data(), from.size()), to);
  }
  Point4* freePosition() { return identity_ ? position_.data() : free_position_.data(); }
  const Point4* freeForceData() { return identity_ ? force_.data() : free_force_.data(); }
  std::vector<Vec3> vectors(const Buffer<Point4>& from) {
    std::vector<Vec3> out;
    for (const Point4& p : queue_.download(from, from.size())) out.push_back(vec(p));
    return out;
  }

  void putMap(const FreeMap& map) {
    free_points_ = map.T.column_count;
    identity_ = free_points_ == points_;
    for (int i = 0; identity_ && i < points_; ++i)
      identity_ = map.T.offsets[i] == i && map.T.columns[i] == i && map.T.values[i] == 1;
    if (identity_) return;
    map_ = SlicedRows<Device>(queue_, map.T);
    transpose_ = SlicedRows<Device>(queue_, map.Tt);
    free_position_ = Buffer<Point4>(static_cast<std::size_t>(free_points_));
    free_force_ = Buffer<Point4>(static_cast<std::size_t>(free_points_));
    const std::vector<Point4> all = queue_.download(position_, position_.size());
    std::vector<Point4> start;
    for (const int home : map.home) {
      const Point4& p = all[static_cast<std::size_t>(home)];
      start.push_back({p.x, p.y, p.z, 0});
    }
    queue_.upload(std::span<const Point4>(start), free_position_);
  }

  void putQuads(const FlatQuads& quads) {
    put(quads.function_u, function_u_);
    put(quads.function_v, function_v_);
    put(quads.basis_u, basis_u_);
    put(quads.basis_v, basis_v_);
    put(quads.touched_u, touched_u_);
    put(quads.touched_v, touched_v_);
    put(quads.rest, rest_);
    strips_ = options_.path == QuadPath::strips || (options_.path == QuadPath::automatic && quads.cells > kStripCells);
    size_ = std::max(0, options_.size);
    if (quads.sheets.empty()) return;
    std::vector<QuadWork> works;
    if (strips_)
      withType<QuadStrips>(size_, [&]<class Kernel>(std::type_identity<Kernel>) {
        int rows = options_.strip_rows;
        if (rows <= 0) {
          // As many rows as leave every block one strip.
          const double owned = Kernel::kCellsU - 2;
          double all = 0;
          for (const QuadSheet& s : quads.sheets) all += s.points_v * std::ceil(s.points_u / owned);
          const int blocks = kStripBlocks / 4 * Kernel::kResident;
          rows = std::max(1, static_cast<int>(std::ceil(all / blocks)));
        }
        works = stripsOf(quads, Kernel::kCellsU, rows);
      });
    else
      withType<QuadTiles>(size_, [&]<class Kernel>(std::type_identity<Kernel>) {
        works = tilesOf(quads, Kernel::kCellsU, Kernel::kCellsV);
      });
    put(works, works_);
  }

  template <class Kernel>
  void runQuads(typename Device::Queue& queue, const MoreSlots& more, const Laws& laws, const Point4* position,
                Point4* force) {
    const QuadSheets sheets{
        function_u_.data(), function_v_.data(), basis_u_.data(), basis_v_.data(), touched_u_.data(),
        touched_v_.data(),  rest_.data(),       position,        force,           laws.sheets.data()};
    Blocks<Device>::run(queue, static_cast<int>(works_.size()), Kernel{sheets, more, works_.data()});
  }

  struct CellBuffers {
    Buffer<int> nodes, list;
    Buffer<double> weights, basis_u, basis_v, shapes, points;
    Buffer<long> first_point;
  };
  void putCells(const FlatShell& flat) {
    for (const FlatCells& from : flat.cells) {
      CellBuffers& to = cell_buffers_.emplace_back();
      OfCells& of = own_.buffers.emplace_back();
      const ShellBlock& b = *from.block;
      put(b.nodes, to.nodes);
      put(from.list, to.list);
      put(b.weights, to.weights);
      put(b.basis_u, to.basis_u);
      put(b.basis_v, to.basis_v);
      put(b.shapes, to.shapes);
      put(b.points, to.points);
      put(b.laws, of.laws);
      put(b.first_point, to.first_point);
      put(std::vector<PointNumbers<double>>{from.law}, of.law);
      CellArrays a = from.shape;
      a.nodes = to.nodes.data();
      a.list = to.list.data();
      a.weights = to.weights.data();
      a.basis_u = to.basis_u.data();
      a.basis_v = to.basis_v.data();
      a.shapes = to.shapes.data();
      a.points = to.points.data();
      a.first_point = to.first_point.data();
      a.law = of.law.data();
      a.laws = b.laws.empty() ? nullptr : of.laws.data();
      own_.cells.push_back(a);
    }
  }

  void putSeams(const FlatSeams& seams) {
    hinges_ = seams.hinges();
    gaps_ = seams.gaps();
    hinge_slot_ = seams.hinge_slot;
    gap_slot_ = seams.gap_slot;
    put(seams.first_hinge, first_hinge_);
    put(seams.hinge_column, hinge_column_);
    put(seams.hinge_rows, hinge_rows_);
    put(seams.hinge_numbers, hinge_numbers_);
    put(seams.first_gap, first_gap_);
    put(seams.gap_column, gap_column_);
    put(seams.gap_row, gap_row_);
    put(seams.gap_stiffness, gap_stiffness_);
  }

  ForceOptions options_;
  typename Device::Queue queue_;
  int points_ = 0, free_points_ = 0, size_ = 0;
  long gauss_points_ = 0;
  bool identity_ = true, strips_ = false, has_history_ = false;
  double elapsed_s_ = 0;
  std::vector<double> weights_;
  Buffer<Point4> position_, force_, free_position_, free_force_;
  SlicedRows<Device> map_, transpose_;
  std::optional<PointMotion<Device>> motion_;
  // Quadratic cells.
  Buffer<int> function_u_, function_v_;
  Buffer<double> basis_u_, basis_v_, rest_;
  Buffer<Touched> touched_u_, touched_v_;
  Buffer<QuadWork> works_;
  // Other cells.
  std::vector<CellBuffers> cell_buffers_;
  Laws own_;  ///< of all cells, as they are
  Buffer<double> committed_, trial_;
  // Seams.
  int hinges_ = 0, gaps_ = 0, hinge_slot_ = 0, gap_slot_ = 0;
  Buffer<int> first_hinge_, hinge_column_, first_gap_, gap_column_;
  Buffer<double> hinge_rows_, hinge_numbers_, gap_row_, gap_stiffness_;
  // What elements leave for control points.
  Buffer<int> first_slot_, slot_list_, gathered_;
  Buffer<Vec3> slot_;
};

template <class Device>
std::unique_ptr<Forces> forcesOn(const Cloth& cloth, const ForceOptions& options) {
  if (const auto missing = notCarried(cloth)) throw RunError("forces on a device do not carry " + *missing);
  return std::make_unique<ShellForces<Device>>(dynamic_cast<const NurbsShell&>(cloth), options);
}

}  // namespace gambeson::gpu
