#pragma once
/// The contact solve of a step on a device, from rows to velocities: solveContacts of core/contact/response.cpp where
/// nothing holds the points together and friction is Coulomb's. The same order of rows, sums and decisions.

#include <algorithm>
#include <optional>

#include "core/motion/model.hpp"
#include "gpu/near/uploaded.hpp"
#include "gpu/solve/run_islands.hpp"
#include "gpu/step/colour_rows.hpp"
#include "gpu/step/solve_chunks.hpp"
#include "gpu/step/solve_islands.hpp"

namespace gambeson::gpu {

template <class Device>
class StepSolve {
 public:
  template <class T>
  using Buffer = typename Device::template Buffer<T>;
  using Queue = typename Device::Queue;

  /// WT, WTt and inverse masses are on the device already.
  StepSolve(Queue& queue, const Model& model, const SlicedRows<Device>& WT, const SlicedRows<Device>& WTt,
            const Buffer<double>& inverse_mass, const Buffer<double>& density)
      : queue_(queue),
        parameters_(model.contact),
        points_(model.freeCount()),
        samples_(model.surface.size()),
        area_m2_(uploaded<Device>(queue, model.surface.area_m2)),
        of_obstacle_(uploaded<Device>(queue, frictionOfObstacles(model))),
        of_sample_(uploaded<Device>(queue, frictionOfSamples(model))),
        place_of_sample_(uploaded<Device>(queue, model.place)),
        facts_(1),
        limits_(1),
        list_sum_(kRowLists * samples_) {
    for (int s = 0; s < samples_; ++s)
      most_of_sample_ = std::max(most_of_sample_, model.surface.WT.offsets[s + 1] - model.surface.WT.offsets[s]);
    m_ = {WT.view(),
          WTt.view(),
          inverse_mass.data(),
          area_m2_.data(),
          density.data(),
          of_obstacle_.data(),
          of_sample_.data(),
          (model.contact.on_cloth ? *model.contact.on_cloth : model.contact.friction).kinetic,
          points_,
          samples_,
          place_of_sample_.data(),
          static_cast<int>(model.place.size())};
    const auto points = static_cast<std::size_t>(points_), samples = static_cast<std::size_t>(samples_);
    for (Buffer<int>* lists : {&of_list_, &list_begin_}) *lists = Buffer<int>(kRowLists * samples);
    on_body_ = Buffer<int>(samples);
    sample_sum_ = Buffer<Vec3>(samples), sample_velocity_ = Buffer<Vec3>(samples);
    family_of_sample_ = Buffer<FamilySums>(samples), family_of_point_ = Buffer<FamilySums>(points);
    for (Buffer<Vec3>* of_points : {&predicted_, &moved_, &moved_before_, &spilled_before_})
      *of_points = Buffer<Vec3>(points);
    for (Buffer<int>* of_points : {&tied_, &size_, &number_, &free_points_}) *of_points = Buffer<int>(points);
    makeBits(kFirstBits);
  }

  /// Given without waiting: solves for rows whose terms and tractions at the start are set; leaves tractions and
  /// impulses in them, and the velocities of the free points in `solved`.
  void give(const StepRows& rows, double dt_s, const Buffer<Point4>& predictor, Buffer<Point4>& solved) {
    makeRoom(static_cast<std::size_t>(rows.room));
    const SolveLimits limits{parameters_.tolerance_m_per_s2 * dt_s, parameters_.max_iterations};
    queue_.uploadLater(std::span<const SolveLimits>(&limits, 1), limits_);
    const Arrays arrays{rows, predictor.data(), solved.data()};
    if (!pass_ || !(arrays == recorded_)) {
      recorded_ = arrays;
      pass_.emplace(queue_, [this] { run(); });
    }
    pass_->run(queue_);
  }
  /// Of the solve that was given last, on the device.
  const Buffer<SolveFacts>& facts() const { return facts_; }
  /// Whether there was room for it. Where the points of rows, or of parts of islands, had none, nothing is solved and
  /// the rows' tractions stand as they were; there is room now.
  bool took(const SolveFacts& facts) {
    if (facts.reach > reach_point_.size()) {
      reach_room_ = std::max<std::size_t>(2 * reach_room_, facts.reach);
      makeReach();
      ++repeats_;
      return false;
    }
    if (facts.bits > bits_.size()) {
      makeBits(std::max<std::size_t>(2 * bits_.size(), facts.bits));
      ++repeats_;
      return false;
    }
    return true;
  }
  static ContactSolve report(const SolveFacts& facts) {
    ContactSolve report;
    report.residual_m_per_s = facts.residual_m_per_s;
    report.converged = facts.converged;
    report.iterations = facts.iterations;
    return report;
  }
  int repeats() const { return repeats_; }  ///< for want of room, since the start

 private:
  /// Below 0: the sample's.
  static std::vector<double> frictionOfObstacles(const Model& m) {
    std::vector<double> mu(m.obstacles.size(), -1);
    for (std::size_t o = 0; o < mu.size() && o < m.contact.of_obstacle.size(); ++o)
      if (m.contact.of_obstacle[o]) mu[o] = m.contact.of_obstacle[o]->kinetic;
    return mu;
  }
  static std::vector<double> frictionOfSamples(const Model& m) {
    std::vector<double> mu(static_cast<std::size_t>(m.surface.size()), m.contact.friction.kinetic);
    for (std::size_t s = 0; s < mu.size() && s < m.contact.garment_of_sample.size(); ++s) {
      const auto garment = static_cast<std::size_t>(m.contact.garment_of_sample[s]);
      if (garment < m.contact.of_garment.size() && m.contact.of_garment[garment])
        mu[s] = m.contact.of_garment[garment]->kinetic;
    }
    return mu;
  }

  void makeRoom(std::size_t room) {
    if (room <= start_.size()) return;
    packed_ = static_cast<std::size_t>(inRowBlocks(static_cast<int>(room)));
    for (Buffer<int>* of_rows :
         {&reach_first_, &reach_count_, &island_, &rank_, &kept_island_, &ordered_, &colour_, &key_, &order_, &part_of_,
          &part_at_, &parts_, &place_in_order_, &root_, &island_points_, &island_parts_, &island_bits_, &steps_})
      *of_rows = Buffer<int>(room);
    position_ = Buffer<Count>(room), part_ = Buffer<IslandPart>(room);
    largest2_ = Buffer<double>(2 * room), against_ = Buffer<double>(2 * room);
    const std::size_t large = room / kWholeIsland + 1;
    large_ = Buffer<LargeIsland>(large), arrived_ = Buffer<int>(large);
    for (Buffer<int>* of_parts : {&place_, &listed_}) *of_parts = Buffer<int>(kPartsOfRow * room);
    for (Buffer<double>* of_rows : {&row_area_, &friction_, &row_slope_, &row_own_, &own_, &slope_})
      *of_rows = Buffer<double>(room);
    start_ = Buffer<Vec3>(room), row_drift_ = Buffer<Vec3>(room);
    in_ = Buffer<char>(room);
    row_state_ = Buffer<RowState>(room), state_ = Buffer<double>(packed_ * RowState::kNumbers);
    row_facts_ = Buffer<double>(packed_ * RowFacts::kNumbers), pace_ = Buffer<double>(packed_ * RowPace::kNumbers);
    entries_ = Buffer<RowEntries>(room);
    islands_ = Buffer<SolveIsland>(room), kept_islands_ = Buffer<SolveIsland>(room);
    chunks_ = Buffer<SolveChunk>(room);
    reach_room_ = std::max(reach_room_, room * static_cast<std::size_t>(most_of_sample_));
    makeReach();
  }
  /// Arrays of the points that rows move. What rows have beyond kPlaces is less than all.
  void makeReach() {
    pass_.reset();
    const std::size_t entries = packed_ * kPlaces + reach_room_;
    reach_point_ = Buffer<int>(reach_room_), reach_weight_ = Buffer<double>(reach_room_);
    point_ = Buffer<int>(entries), weight_ = Buffer<double>(entries), push_ = Buffer<double>(entries);
  }

  /// Arrays of the bits of parts of islands, and of the points of these: with a row for each part, and as many more,
  /// less than sixteen points a word.
  void makeBits(std::size_t words) {
    pass_.reset();
    bits_ = Buffer<std::uint32_t>(words), before_ = Buffer<int>(words);
    const std::size_t points = static_cast<std::size_t>(points_) + 16 * words;
    taken_ = Buffer<std::uint32_t>(kColourWords * points), rows_at_ = Buffer<std::uint32_t>(points);
    chunk_points_ = Buffer<ChunkPoint>(points);
    spilled_ = Buffer<Vec3>(points);
  }

  SolveRows view(const StepRows& rows) {
    return {rows,
            of_list_.data(),
            list_begin_.data(),
            on_body_.data(),
            place_.data(),
            listed_.data(),
            row_area_.data(),
            friction_.data(),
            row_slope_.data(),
            start_.data(),
            sample_velocity_.data(),
            in_.data(),
            row_state_.data(),
            predicted_.data(),
            moved_.data(),
            moved_before_.data(),
            facts_.data()};
  }
  IslandOrder islands(const SolveRows& s) {
    return {s,
            {reach_first_.data(), reach_count_.data(), reach_point_.data(), reach_weight_.data(), reach_point_.size()},
            row_own_.data(),
            row_drift_.data(),
            island_.data(),
            rank_.data(),
            kept_island_.data(),
            position_.data(),
            ordered_.data(),
            colour_.data(),
            key_.data(),
            order_.data(),
            part_of_.data(),
            part_at_.data(),
            part_.data(),
            parts_.data(),
            tied_.data(),
            size_.data(),
            number_.data(),
            free_points_.data(),
            taken_.data(),
            rows_at_.data(),
            chunk_points_.data(),
            bits_.data(),
            before_.data(),
            bits_.size(),
            root_.data(),
            island_points_.data(),
            island_parts_.data(),
            island_bits_.data(),
            large_.data(),
            islands_.data(),
            kept_islands_.data(),
            chunks_.data(),
            steps_.data()};
  }

  void run() {
    const SolveRows s = view(recorded_.rows);
    const IslandOrder o = islands(s);
    start(s, recorded_.predictor);
    order(o, false);
    queue_.repeatWhile(NextSweeps{o, limits_.data()}, [&] {
      sweep(o);
      queue_.doIf(EndSweeps{facts_.data(), limits_.data()}, [&] { order(o, true); });
    });
    queue_.forEachOf(s.rows, EndRows{o});
    queue_.forEach(samples_, SpreadSamples{s, samples_, sample_sum_.data()});
    queue_.forEach(points_, EndPoints{{m_, sample_sum_.data(), predicted_.data()}, recorded_.solved});
  }
  /// What rows are, and where the iteration starts from.
  void start(const SolveRows& s, const Point4* predictor) {
    queue_.forEach(kRowLists * samples_, ClearRowLists{s, samples_});
    queue_.forEach(points_, ToVectors{predictor, predicted_.data()});
    queue_.forEachOf(s.rows, CountRows{s, samples_});
    list_sum_.run(queue_, of_list_, list_begin_);
    queue_.forEachOf(s.rows, PlaceRows{s, samples_});
    queue_.forEach(kRowLists * samples_, SortRows{s});
    const StartRows rows{m_, s};
    moveSamples(predicted_);
    queue_.forEachOf(s.rows, rows);
    queue_.forEach(samples_, SmoothSamples{s, samples_, family_of_sample_.data()});
    queue_.forEach(points_, SmoothPoints{m_, family_of_sample_.data(), family_of_point_.data()});
    queue_.forEachOf(s.rows, SmoothRows{m_, s, family_of_point_.data()});
    queue_.forEach(samples_, SpreadSamples{s, samples_, sample_sum_.data()});
    queue_.forEach(points_, StartPoints{{m_, sample_sum_.data(), predicted_.data()}, s.moved, s.moved_before});
    moveSamples(moved_);
    queue_.forEachOf(s.rows, LookAtLeftOut{rows, nullptr, nullptr});
    queue_.forEachOf(s.rows, ForgetReach{islands(s)});
  }
  /// Islands and the order of rows; `goes_on`: there were islands before.
  void order(const IslandOrder& o, bool goes_on) {
    // The rows by what they begin with stand behind the other lists.
    const RowsInOrder sorted{listed_.data(), list_begin_.data() + kBegins * samples_};
    const StepRows& rows = o.s.rows;
    using Group = typename Device::Group;
    queue_.forEach(std::max(1, points_), ClearPoints{o, points_});
    queue_.forResidentGroups(TiePoints<Group>{m_, o});
    queue_.forEachOf(rows, NumberIslands{o});
    queue_.forEachOf(rows, PlaceIslands{o});
    queue_.forEachOf(rows, PlaceInIslands{m_, o, sorted});
    queue_.forResidentGroups(NumberPoints<Group>{o});
    queue_.forEachOf(rows, SortByPosition{o, sorted});
    queue_.forEachOf(rows, CutIslands{m_, o});
    queue_.doIf(AnyLarge{facts_.data()}, [&] {
      queue_.forEachOf(rows, PlaceBits{o});
      queue_.forEachOf(rows, FindBits{o});
      queue_.forEachOf(ClearBits{o}, ClearBits{o});
      queue_.forResidentGroups(MarkPoints<Group>{o});
      queue_.forResidentGroups(CountBits<Group>{o});
      queue_.forResidentGroups(PhaseParts<Group>{o});
    });
    queue_.forResidentGroups(ColourRows<Group>{o});
    queue_.forEachOf(rows, SortByColour{o});
    queue_.forResidentGroups(EndIslands<Group>{o, goes_on});
    queue_.forResidentGroups(EndChunks<Group>{o});
    queue_.forResidentGroups(FillRows<Group>{m_, o, row_facts_.data(), own_.data(), slope_.data(), entries_.data(),
                                             state_.data(), place_in_order_.data(), static_cast<int>(packed_) * kPlaces,
                                             point_.data(), weight_.data(), push_.data()});
  }
  /// Velocities of the samples.
  void moveSamples(const Buffer<Vec3>& points) {
    queue_.forEach(samples_, MoveSamplesWith{m_.WT, points.data(), sample_velocity_.data()});
  }
  void sweep(const IslandOrder& o) {
    SolveData data{};
    data.islands = data.islands_now = islands_.data();
    data.chunks = chunks_.data(), data.steps = steps_.data();
    data.facts = row_facts_.data(), data.own = own_.data(), data.slope = slope_.data();
    data.entries = entries_.data();
    data.state = data.state_now = state_.data();
    data.pace = pace_.data();
    data.point = point_.data(), data.weight = weight_.data(), data.push = push_.data();
    data.free = free_points_.data();
    data.moved = data.moved_now = moved_.data();
    data.moved_before = data.moved_before_now = moved_before_.data();
    data.chunk_points = chunk_points_.data();
    data.largest2 = largest2_.data(), data.against = against_.data();
    data.spilled = spilled_.data(), data.spilled_before = spilled_before_.data();
    const IslandRun islands{data,          &facts_.data()->limits, &facts_.data()->islands,
                            large_.data(), &facts_.data()->large,  arrived_.data()};
    RunIslands<Device>::runSmall(queue_, islands);
    queue_.doIf(AnyLarge{facts_.data()}, [&] {
      queue_.forEach(static_cast<int>(arrived_.size()), ClearArrived{arrived_.data()});
      RunIslands<Device>::runLarge(queue_, islands);
    });
    queue_.forEachOf(o.s.rows, LookAtIslands{o});
    moveSamples(moved_);
    queue_.forEachOf(o.s.rows, LookAtLeftOut{{m_, o.s}, state_.data(), place_in_order_.data()});
  }

  /// What a recording is of.
  struct Arrays {
    StepRows rows;
    const Point4* predictor;
    Point4* solved;
    bool operator==(const Arrays&) const = default;
  };

  static constexpr std::size_t kFirstBits = 2048;

  Queue& queue_;
  const ContactParameters& parameters_;
  int points_, samples_, most_of_sample_ = 0, repeats_ = 0;
  std::size_t packed_ = 0, reach_room_ = 0;
  Buffer<double> area_m2_, of_obstacle_, of_sample_;
  Buffer<int> place_of_sample_;
  SolveModel m_;
  Buffer<SolveFacts> facts_;
  Buffer<SolveLimits> limits_;
  typename Device::ExclusiveSum list_sum_;
  Buffer<int> of_list_, list_begin_, on_body_, place_, listed_;
  Buffer<Vec3> sample_sum_, predicted_, moved_, moved_before_, spilled_, spilled_before_, start_, row_drift_,
      sample_velocity_;
  Buffer<FamilySums> family_of_sample_, family_of_point_;
  Buffer<double> row_facts_, state_, pace_;  ///< packed
  Buffer<double> row_area_, friction_, row_slope_, row_own_, own_, slope_, reach_weight_, weight_, push_;
  Buffer<char> in_;
  Buffer<RowState> row_state_;
  Buffer<int> reach_first_, reach_count_, reach_point_, island_, rank_, kept_island_, ordered_, colour_, key_, order_,
      part_of_, part_at_, parts_, place_in_order_, root_, island_points_, island_parts_, island_bits_, steps_, point_;
  Buffer<Count> position_;
  Buffer<IslandPart> part_;
  Buffer<LargeIsland> large_;
  Buffer<int> arrived_;  ///< of teams
  Buffer<double> largest2_, against_;
  Buffer<int> tied_, size_, number_, free_points_;
  Buffer<std::uint32_t> taken_, rows_at_, bits_;
  Buffer<int> before_;
  Buffer<ChunkPoint> chunk_points_;
  Buffer<RowEntries> entries_;
  Buffer<SolveIsland> islands_, kept_islands_;
  Buffer<SolveChunk> chunks_;
  Arrays recorded_{};
  std::optional<typename Device::Replay> pass_;
};

}  // namespace gambeson::gpu
