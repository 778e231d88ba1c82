#pragma once
/// Sweeps over a chunk of rows by a group of quads: colours one after the other, a quad a row.

#include "gpu/solve/solve_data.hpp"

namespace gambeson::gpu {

/// A row as a lane of a quad has it when the row's turn comes: nothing of it depends on other rows of the sweep.
struct LaneRow {
  int row = -1;  ///< none
  int count;     ///< of the lane's entries
  int more;      ///< where its others begin
  RowFacts facts;
  RowState state;
  RowPace pace;
  int point[kKept];
  double weight[kKept], push[kKept];
};

template <class Group>
class ChunkSweep {
 public:
  template <class T>
  using PerLane = typename Group::template PerLane<T>;
  using Lanes = PerLane<LaneTotals<Group::kQuads>>;

  GAMBESON_HD ChunkSweep(const Group& group, const SolveData& data, const SolveChunk& chunk)
      : group_(group), d_(data), chunk_(chunk) {}

  /// Bounds and lengths of the steps.
  GAMBESON_HD void setPace(double caution) const {
    group_.each([&](int lane) {
      for (int k = chunk_.row + lane; k < chunk_.row_end; k += Group::kLanes) {
        SolveRow row;
        row.own = d_.own[k], row.slope = d_.slope[k], row.compliance = RowFacts::of(d_.facts, k).compliance;
        const double bound = stepBound(row, caution);
        RowPace{bound, 1 / bound}.put(d_.pace, k);
      }
    });
  }

  /// Loads the first rows.
  GAMBESON_HD void begin() {
    group_.each([&](int lane) { load(0, row_[0][lane], lane); });
  }

  /// Takes the rows, after `begin`; `moved`: velocities of the chunk's points. Adds to the lanes' totals. Lanes have
  /// not met after the last rows.
  GAMBESON_HD void run(Vec3* moved, double beta, Lanes& totals) {
    const int turns = kRounds * (chunk_.step_end - chunk_.step);
    // Two places for rows, so that none is copied from one to the other.
    for (int turn = 0; turn < turns; turn += 2) {
      take(turn, turns, row_[0], row_[1], moved, beta, totals);
      if (turn + 1 < turns) take(turn + 1, turns, row_[1], row_[0], moved, beta, totals);
    }
  }

  /// The largest squared residual of the rows as it is defined, in the lanes' totals.
  GAMBESON_HD void look(const Vec3* moved, Lanes& totals) {
    for (int first = chunk_.row; first < chunk_.row_end; first += Group::kQuads) {
      group_.each([&](int lane) {
        const int row = first + lane / kQuad;
        Vec3 part{};
        if (row < chunk_.row_end) {
          const RowEntries entries = d_.entries[row];
          for (int e = lane % kQuad; e < entries.count; e += kQuad) {
            const int at = e < kPlaces ? placeOf(row, e) : entries.more + e - kPlaces;
            part += d_.weight[at] * moved[d_.point[at]];
          }
        }
        velocity_[lane] = part;
      });
      group_.sumOfQuads(velocity_);
      group_.each([&](int lane) {
        const int row = first + lane / kQuad;
        if (row >= chunk_.row_end) return;
        SolveRow facts = rowOf(RowFacts::of(d_.facts, row));
        facts.slope = d_.slope[row];
        totals[lane].largest =
            std::max(totals[lane].largest, residual2(velocity_[lane], RowState::of(d_.state_now, row).now, facts));
      });
    }
  }

 private:
  using SolveRow = ContactWork::Row;
  static constexpr int kRounds = kSumLanes / Group::kQuads;
  struct Kept {
    Vec3 of[kKept];
  };

  GAMBESON_HD static SolveRow rowOf(const RowFacts& f) {
    SolveRow row;
    row.normal = f.normal, row.drift = f.drift;
    row.friction = f.friction, row.drag = f.drag, row.compliance = f.compliance;
    return row;
  }

  /// Takes the rows of a turn; meanwhile the next ones come.
  GAMBESON_HD void take(int turn, int turns, PerLane<LaneRow>& row, PerLane<LaneRow>& next, Vec3* moved, double beta,
                        Lanes& totals) {
    group_.each([&](int lane) {
      if (row[lane].row >= 0) velocity_[lane] = partOfVelocity(moved, row[lane], kept_[lane].of);
      load(turn + 1, next[lane], lane);
    });
    group_.sumOfQuads(velocity_);
    group_.each([&](int lane) {
      if (row[lane].row >= 0) take(row[lane], velocity_[lane], kept_[lane].of, moved, beta, lane, totals[lane]);
    });
    if ((turn + 1) % kRounds == 0 && turn + 1 < turns) group_.sync();
  }

  /// The row of a lane's quad in a turn: a step has kRounds of them.
  GAMBESON_HD void load(int turn, LaneRow& r, int lane) const {
    const int step = chunk_.step + turn / kRounds, round = turn % kRounds;
    r.row = -1;
    if (step >= chunk_.step_end) return;
    const int first = d_.steps[step], end = step + 1 < chunk_.step_end ? d_.steps[step + 1] : chunk_.row_end;
    const int quad = lane / kQuad, ahead = (quad - (first - chunk_.row)) & (Group::kQuads - 1);
    const int row = first + ahead + round * Group::kQuads;
    if (row >= end) return;
    const RowEntries entries = d_.entries[row];
    r.row = row;
    r.facts = RowFacts::of(d_.facts, row);
    r.state = RowState::of(d_.state_now, row);
    r.pace = RowPace::of(d_.pace, row);
    const int mine = lane % kQuad, places = placeOf(row, mine);
#ifdef __CUDA_ARCH__
#pragma unroll
#endif
    for (int j = 0; j < kKept; ++j) {
      r.point[j] = d_.point[places + kRowBlock * kQuad * j];
      r.weight[j] = d_.weight[places + kRowBlock * kQuad * j];
      r.push[j] = d_.push[places + kRowBlock * kQuad * j];
    }
    r.more = entries.more + mine;
    r.count = (entries.count - mine + kQuad - 1) / kQuad;
  }

  /// The part of a row's velocity that a lane sums; keeps the velocities of the points that it has. Places without an
  /// entry add nothing.
  GAMBESON_HD Vec3 partOfVelocity(const Vec3* moved, const LaneRow& r, Vec3* kept) const {
    Vec3 part{};
#ifdef __CUDA_ARCH__
#pragma unroll
#endif
    for (int j = 0; j < kKept; ++j) {
      kept[j] = moved[r.point[j]];
      part += r.weight[j] * kept[j];
    }
    for (int j = kKept; j < r.count; ++j) {
      const int e = r.more + kQuad * (j - kKept);
      part += d_.weight[e] * moved[d_.point[e]];
    }
    return part;
  }

  GAMBESON_HD void take(const LaneRow& r, const Vec3& velocity, const Vec3* kept, Vec3* moved, double beta, int lane,
                        LaneTotals<Group::kQuads>& total) const {
    const Vec3 now = r.state.now, from = now + beta * (now - r.state.before);
    const Vec3 after = takenFrom(from, velocity, r.pace.length, rowOf(r.facts)), way = after - from;
    if (!(way == Vec3{})) {
      const Vec3 impulse = r.facts.area * way;
#ifdef __CUDA_ARCH__
#pragma unroll
#endif
      for (int j = 0; j < kKept; ++j) {
        const Vec3 then = kept[j] + r.push[j] * impulse;
        if (j < r.count) moved[r.point[j]] = then;
      }
      for (int j = kKept; j < r.count; ++j) {
        const int e = r.more + kQuad * (j - kKept);
        moved[d_.point[e]] += d_.push[e] * impulse;
      }
    }
    total.largest = std::max(total.largest, foundResidual2(way, r.pace.bound));
    total.part[kRounds == 1 ? 0 : (r.row - chunk_.row) % kSumLanes / Group::kQuads] +=
        againstGradient(r.facts.area, r.pace.bound, way, after - now);
    if (lane % kQuad == 0) RowState{after, now}.put(d_.state_now, r.row);
  }

  const Group& group_;
  const SolveData& d_;
  const SolveChunk& chunk_;
  PerLane<LaneRow> row_[2];
  PerLane<Vec3> velocity_;
  PerLane<Kept> kept_;
};

}  // namespace gambeson::gpu
