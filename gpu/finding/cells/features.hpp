#pragma once
/// From pairs of triangles to pairs of vertices and faces and of edges: each triangle stands for what is its own
/// (owners.hpp), and boxes of features are compared again (Wong 2014, section 5.3.5).

#include "gpu/finding/cells/owners.hpp"
#include "gpu/finding/float_dop.hpp"
#include "gpu/finding/pair.hpp"

namespace gambeson::gpu {

/// N: 3 for vertices and faces, 4 for edges.
template <int N, bool kTallied>
struct PairsOfOwners {
  static constexpr int kResident = 32;
  static constexpr int kGathered = 256;
  struct Shared {
    Gathered<Pair, kGathered> found;
  };

  List<Pair> of_owners;
  const Owner* owner;
  const FloatBox *box, *vertex_box;
  const FloatDop *dop, *vertex_dop;  ///< null: none
  List<Pair> pairs;
  Count* tally;  ///< boxes that have been compared

  template <class Group>
  GAMBESON_HD void operator()(const Group& group, Shared& shared, int index, int groups) const {
    typename Group::template PerLane<bool> on;
    typename Group::template PerLane<Pair> of;
    const Count n = of_owners.size(), step = static_cast<Count>(groups) * Group::kLanes;
    int found = 0;
    for (Count first = static_cast<Count>(index) * Group::kLanes; first < n; first += step) {
      group.each([&](int lane) {
        const Count i = first + static_cast<Count>(lane);
        on[lane] = i < n;
        if (on[lane]) of[lane] = of_owners.items[i];
      });
      if constexpr (N == 3) {
        for (int k = 0; k < 3; ++k) {
          test(group, shared, found, on,
               [&](int lane, Pair& pair) { return vertexIn(of[lane].first, k, of[lane].second, pair); });
          test(group, shared, found, on,
               [&](int lane, Pair& pair) { return vertexIn(of[lane].second, k, of[lane].first, pair); });
        }
      } else {
        for (int k = 0; k < 9; ++k)
          test(group, shared, found, on,
               [&](int lane, Pair& pair) { return edges(of[lane].first, k / 3, of[lane].second, k % 3, pair); });
      }
    }
    if (found > 0) shared.found.flush(group, found, pairs);
  }

 private:
  enum class Answer { none, apart, meet };

  template <class Group, class Ask>
  GAMBESON_HD void test(const Group& group, Shared& shared, int& found,
                        const typename Group::template PerLane<bool>& on, Ask&& ask) const {
    typename Group::template PerLane<bool> asked, meets;
    typename Group::template PerLane<Pair> pair;
    group.each([&](int lane) {
      const Answer answer = on[lane] ? ask(lane, pair[lane]) : Answer::none;
      asked[lane] = answer != Answer::none;
      meets[lane] = answer == Answer::meet;
    });
    if constexpr (kTallied) {
      const int tested = lanesIn(group.ballot(asked));
      if (tested > 0) group.once([&] { return fetchAdd(tally, static_cast<Count>(tested)); });
    }
    shared.found.add(group, meets, pair, found);
    if (found > kGathered - Group::kLanes) shared.found.flush(group, found, pairs);
  }

  /// The vertex at a corner of one, if its own, and the face of the other.
  GAMBESON_HD Answer vertexIn(int one, int corner, int other, Pair& pair) const {
    const Owner &a = owner[one], &b = owner[other];
    const int v = a.corner[corner];
    if ((a.own_corner >> corner & 1) == 0 || b.face < 0 || v == b.corner[0] || v == b.corner[1] || v == b.corner[2])
      return Answer::none;
    pair = {v, b.face};
    if (!meet(vertex_box[v], box[other])) return Answer::apart;
    return vertex_dop == nullptr || meet(vertex_dop[v], dop[other]) ? Answer::meet : Answer::apart;
  }
  GAMBESON_HD Answer edges(int one, int side, int other, int other_side, Pair& pair) const {
    const Owner &a = owner[one], &b = owner[other];
    const int e = a.edge[side], f = b.edge[other_side];
    if (e < 0 || f < 0) return Answer::none;
    const int p[2] = {a.corner[side], a.corner[(side + 1) % 3]};
    const int q[2] = {b.corner[other_side], b.corner[(other_side + 1) % 3]};
    if (p[0] == q[0] || p[0] == q[1] || p[1] == q[0] || p[1] == q[1]) return Answer::none;
    pair = e < f ? Pair{e, f} : Pair{f, e};
    if (!meet(joined(vertex_box[p[0]], vertex_box[p[1]]), joined(vertex_box[q[0]], vertex_box[q[1]])))
      return Answer::apart;
    if (vertex_dop == nullptr) return Answer::meet;
    return meet(primitiveDop<2>(p, vertex_dop), primitiveDop<2>(q, vertex_dop)) ? Answer::meet : Answer::apart;
  }
};

}  // namespace gambeson::gpu
