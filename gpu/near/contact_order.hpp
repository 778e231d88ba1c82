#pragma once
/// Contacts sorted without their number: each counts itself for its slot, sums of the counts say where slots begin, and
/// each counts which of its slot come before it (as gpu/finding/hit_order.hpp has it for hits).

#include "gpu/device/list.hpp"
#include "gpu/near/contact.hpp"

namespace gambeson::gpu {

/// A slot for each sample on a body, each sample on cloth, each edge on edges, and each sample whose triangle or edge
/// is on a sharp part of a body, in the order of rows.
struct ContactSlots {
  int samples, edges;  ///< of cloth

  GAMBESON_HD int count() const { return 3 * samples + edges; }
  GAMBESON_HD int of(int kind, int sample) const {
    return kind == kSampleOnBody    ? sample
           : kind == kSampleOnCloth ? samples + sample
           : kind == kEdgeOnEdge    ? 2 * samples + sample
                                    : 2 * samples + edges + sample;
  }
  GAMBESON_HD int of(const ContactFacts& f) const { return of(f.kind, f.sample); }
};

/// Where contacts go, in no order, and how many each slot has.
struct FoundList {
  List<FoundContact> list;
  int* of_slot;
  ContactSlots slots;

  template <class Group>
  GAMBESON_HD void add(const Group& group, const typename Group::template PerLane<bool>& on,
                       typename Group::template PerLane<FoundContact>& found) const {
    group.each([&](int lane) {
      if (on[lane]) found[lane].place = fetchAdd(&of_slot[slots.of(found[lane].facts)], 1);
    });
    append(group, on, found, list);
  }
  /// By one lane alone.
  GAMBESON_HD void add(FoundContact& found) const {
    found.place = fetchAdd(&of_slot[slots.of(found.facts)], 1);
    const Count at = fetchAdd(list.count, Count{1});
    if (at < list.room) list.items[at] = found;
  }
};

/// Numbers of found contacts, those of a slot together.
struct PlaceContacts {
  ContactSlots slots;
  const int* begin;
  int* placed;
  Count room;

  GAMBESON_HD void operator()(const FoundContact& found, Count i) const {
    // Those that the list had no room for have been counted as well.
    const Count at = static_cast<Count>(begin[slots.of(found.facts)] + found.place);
    if (at < room) placed[at] = static_cast<int>(i);
  }
};

/// The sorted arrays.
struct ContactArrays {
  ContactFacts* facts;
  ContactStencil* stencil;
  BodyTouch* touch;
};

struct RankContacts {
  ContactSlots slots;
  const int *begin, *of_slot;
  List<FoundContact> found;
  const int* placed;
  ContactArrays out;

  GAMBESON_HD void operator()(const FoundContact& mine, Count i) const {
    const int slot = slots.of(mine.facts);
    const Count from = static_cast<Count>(begin[slot]);
    const Count end = std::min(from + static_cast<Count>(of_slot[slot]), found.room);
    Count at = from;
    const Count size = found.size();
    for (Count k = from; k < end; ++k) {
      const int other = placed[k];
      // Where the list ran over, some were never placed: what is there then is of no use, and the pass is repeated.
      if (static_cast<Count>(other) < size && static_cast<Count>(other) != i)
        at += comesBefore(found.items[other].facts, mine.facts);
    }
    if (at >= found.room) return;
    out.facts[at] = mine.facts;
    out.stencil[at] = mine.stencil;
    out.touch[at] = mine.touch;
  }
};

}  // namespace gambeson::gpu
