#pragma once
/// The iteration of an island by a team of groups: what `iterateIsland` of core/contact/contact_iteration.cpp does.

#include "gpu/device/team.hpp"
#include "gpu/solve/sweep_chunk.hpp"

namespace gambeson::gpu {

/// Which island a group works on, as which of how many.
struct SolveJob {
  int island, rank, groups;
  int* arrived;  ///< of the team's barrier
};

template <class Group>
class IslandSweeps {
 public:
  struct Shared {
    PartTotals swept, looked;
  };
  using Team = TeamOf<Group>;

  /// `room`: for so many vectors in shared memory.
  GAMBESON_HD IslandSweeps(const SolveData& data, const SweepLimits& limits, Shared& shared, Vec3* room, int vectors)
      : d_(data), limits_(limits), shared_(shared), room_(room), vectors_(vectors) {}

  /// An island of one chunk, by one group.
  GAMBESON_HD void runAlone(const Group& group, int number) const {
    SolveIsland island = d_.islands[number];
    if (const int points = island.free_end - island.free_point; 2 * points <= vectors_)
      runAlone(group, island, room_, room_ + points);
    else
      runAlone(group, island, d_.spilled + island.free_point, d_.spilled_before + island.free_point);
    leave(group, island, number);
  }
  /// One of several chunks, by a team.
  GAMBESON_HD void runTeam(const Group& group, const SolveJob& job) const {
    SolveIsland island = d_.islands[job.island];
    runTeam(group, Team(group, job.rank, job.groups, job.arrived), island);
    if (job.rank == 0) leave(group, island, job.island);
  }

 private:
  using Lanes = typename Group::template PerLane<LaneTotals<Group::kQuads>>;

  GAMBESON_HD void leave(const Group& group, const SolveIsland& island, int number) const {
    group.each([&](int lane) {
      if (lane == 0) d_.islands_now[number] = island;
    });
  }

  /// Lanes of this group begin with copies of what they take.
  GAMBESON_HD void startRows(const Group& group, int begin, int end) const {
    group.each([&](int lane) {
      for (int k = begin + lane; k < end; k += Group::kLanes) RowState::of(d_.state, k).put(d_.state_now, k);
    });
  }

  GAMBESON_HD void runAlone(const Group& group, SolveIsland& island, Vec3* moved, Vec3* before) const {
    const SolveChunk chunk = d_.chunks[island.chunk];
    const int first = island.free_point, points = island.free_end - first;
    startRows(group, chunk.row, chunk.row_end);
    group.each([&](int lane) {
      for (int f = lane; f < points; f += Group::kLanes) {
        moved[f] = d_.moved[d_.free[first + f]];
        before[f] = d_.moved_before[d_.free[first + f]];
      }
    });
    ChunkSweep<Group> sweep(group, d_, chunk);
    double caution = 0;  // that the paces are for
    while (goesOn(island, limits_)) {
      if (const double c = cautionOf(island); caution != c) {
        caution = c;
        sweep.setPace(caution);
        group.sync();
      }
      sweep.begin();
      const Ahead ahead = aheadOf(island.momentum);
      group.each([&](int lane) {
        for (int f = lane; f < points; f += Group::kLanes) moved[f] = wentOn(moved[f], before[f], island.beta);
      });
      group.sync();
      Lanes totals;
      sweep.run(moved, island.beta, totals);
      group.gather(totals, shared_.swept);
      group.sync();
      const Totals swept = totalOf(shared_.swept);
      if (sweptWith(swept.largest, limits_, island)) {
        Lanes looks;
        sweep.look(moved, looks);
        group.gather(looks, shared_.looked);
        group.sync();
        lookedAt(totalOf(shared_.looked).largest, limits_, island);
      }
      goOn(swept.sum, limits_, ahead, island);
    }
    group.each([&](int lane) {
      for (int f = lane; f < points; f += Group::kLanes) {
        d_.moved_now[d_.free[first + f]] = moved[f];
        d_.moved_before_now[d_.free[first + f]] = before[f];
      }
    });
  }

  /// Where a point goes on to along its last change, by beta of it.
  GAMBESON_HD static Vec3 wentOn(const Vec3& now, Vec3& before, double beta) {
    const Vec3 then = now + beta * (now - before);
    before = now;
    return then;
  }

  /// Of every chunk of the island that falls to this group, phase by phase; the team meets between them.
  template <class Visit>
  GAMBESON_HD void eachChunk(const Team& team, const SolveIsland& island, bool meets, const Visit& visit) const {
    for (int c = island.chunk, in_phase = 0; c < island.chunk_end; ++c, ++in_phase) {
      if (c > island.chunk && d_.chunks[c].phase != d_.chunks[c - 1].phase) {
        in_phase = 0;
        if (meets) team.sync();
      }
      if (in_phase % team.groups() == team.rank()) visit(c);
    }
  }
  /// The velocities of a chunk's points, where lanes reach them. With `beta` points that no chunk of the sweep had
  /// before go on along their last change, by beta of it.
  GAMBESON_HD Vec3* fetch(const Group& group, const SolveChunk& chunk, const double* beta) const {
    const int points = chunk.point_end - chunk.point;
    Vec3* const moved = points <= vectors_ ? room_ : d_.spilled + chunk.point;
    group.sync();  // all have left the chunk before
    group.each([&](int lane) {
      for (int p = lane; p < points; p += Group::kLanes) {
        const ChunkPoint point = d_.chunk_points[chunk.point + p];
        moved[p] = current(d_.moved_now[point.point]);
        if (beta && point.first) moved[p] = wentOn(moved[p], d_.moved_before_now[point.point], *beta);
      }
    });
    group.sync();
    return moved;
  }
  /// Where a chunk's totals stand in a sweep: groups that are in the next one already write beside what others read.
  GAMBESON_HD static int placeOf(int c, const SolveIsland& island) { return 2 * c + island.iterations % 2; }
  /// The totals of a chunk, by one lane.
  GAMBESON_HD void keep(const Group& group, const Lanes& totals, PartTotals& shared, int place, bool with_sum) const {
    group.gather(totals, shared);
    group.sync();
    group.each([&](int lane) {
      if (lane != 0) return;
      const Totals total = totalOf(shared);
      d_.largest2[place] = total.largest;
      if (with_sum) d_.against[place] = total.sum;
    });
  }
  /// Over the chunks of an island.
  GAMBESON_HD Totals overChunks(const Group& group, const SolveIsland& island) const {
    Lanes totals;
    group.sync();
    group.each([&](int lane) {
      LaneTotals<Group::kQuads>& mine = totals[lane];
      for (int part = lane / kQuad; part < kSumLanes; part += Group::kQuads)
        for (int c = island.chunk + part; c < island.chunk_end; c += kSumLanes) {
          mine.part[part / Group::kQuads] += current(d_.against[placeOf(c, island)]);
          mine.largest = std::max(mine.largest, current(d_.largest2[placeOf(c, island)]));
        }
    });
    group.gather(totals, shared_.swept);
    group.sync();
    return totalOf(shared_.swept);
  }

  GAMBESON_HD void runTeam(const Group& group, const Team& team, SolveIsland& island) const {
    const int first = island.free_point, points = island.free_end - first;
    eachChunk(team, island, false, [&](int c) { startRows(group, d_.chunks[c].row, d_.chunks[c].row_end); });
    group.each([&](int lane) {
      for (int f = team.rank() * Group::kLanes + lane; f < points; f += team.groups() * Group::kLanes) {
        const int at = d_.free[first + f];
        d_.moved_now[at] = d_.moved[at];
        d_.moved_before_now[at] = d_.moved_before[at];
      }
    });
    team.sync();
    double caution = 0;  // that the paces are for
    while (goesOn(island, limits_)) {
      if (const double c = cautionOf(island); caution != c) {
        caution = c;
        eachChunk(team, island, false, [&](int i) { ChunkSweep<Group>(group, d_, d_.chunks[i]).setPace(caution); });
        group.sync();
      }
      const Ahead ahead = aheadOf(island.momentum);
      eachChunk(team, island, true, [&](int c) {
        const SolveChunk chunk = d_.chunks[c];
        ChunkSweep<Group> sweep(group, d_, chunk);
        sweep.begin();
        Vec3* const moved = fetch(group, chunk, &island.beta);
        Lanes totals;
        sweep.run(moved, island.beta, totals);
        keep(group, totals, shared_.looked, placeOf(c, island), true);
        group.each([&](int lane) {
          for (int p = lane; p < chunk.point_end - chunk.point; p += Group::kLanes)
            d_.moved_now[d_.chunk_points[chunk.point + p].point] = moved[p];
        });
      });
      team.sync();
      const Totals swept = overChunks(group, island);
      if (sweptWith(swept.largest, limits_, island)) {
        team.sync();  // all have seen what the sweep left
        eachChunk(team, island, false, [&](int c) {
          const SolveChunk chunk = d_.chunks[c];
          const Vec3* const moved = fetch(group, chunk, nullptr);
          Lanes totals;
          ChunkSweep<Group>(group, d_, chunk).look(moved, totals);
          keep(group, totals, shared_.looked, placeOf(c, island), false);
        });
        team.sync();
        lookedAt(overChunks(group, island).largest, limits_, island);
      }
      goOn(swept.sum, limits_, ahead, island);
    }
  }

  const SolveData& d_;
  const SweepLimits& limits_;
  Shared& shared_;
  Vec3* room_;
  int vectors_;
};

}  // namespace gambeson::gpu
