#pragma once
/// Lists of a pass of the search for what is near, and its contacts sorted.

#include <algorithm>

#include "gpu/finding/pair.hpp"
#include "gpu/near/contact_order.hpp"
#include "gpu/near/near_search.hpp"

namespace gambeson::gpu {

/// What is counted, at the start of a pass.
struct ClearLists {
  Count* count;
  int *contact_slot, slots;

  GAMBESON_HD void operator()(int i) const {
    if (i < kNearLists) count[i] = 0;
    if (i < slots) contact_slot[i] = 0;
  }
};

template <class Device>
class NearLists {
 public:
  template <class T>
  using Buffer = typename Device::template Buffer<T>;
  using Queue = typename Device::Queue;

  NearLists(int samples, int cloth_edges)
      : slots_{samples, cloth_edges},
        count_(kNearLists),
        contact_slot_(static_cast<std::size_t>(slots_.count())),
        contact_begin_(static_cast<std::size_t>(slots_.count())),
        contact_sum_(slots_.count()) {}

  /// Lists that have another room are made anew.
  void make(const NearSizes& room) {
    room_ = room;
    for (const NearList which : {kClothPoints, kClothEdges, kOpenPoints, kOpenEdges, kBodyPoints, kCorners, kBodyEdges})
      makeOne(pairs_[which], which);
    makeOne(found_, kContacts), makeOne(placed_, kContacts);
    makeOne(facts_, kContacts), makeOne(stencil_, kContacts), makeOne(touch_, kContacts);
  }
  template <class T>
  void makeOne(Buffer<T>& items, NearList which) {
    if (items.size() == room_[which] && items.size() > 0) return;
    items = Buffer<T>();  // its memory first
    items = Buffer<T>(room_[which]);
  }
  const NearSizes& room() const { return room_; }
  /// Room for a pass of these sizes.
  NearSizes needed(const NearSizes& need) const {
    NearSizes room = room_;
    for (std::size_t k = 0; k < room.size(); ++k)
      if (need[k] > room[k]) room[k] = std::max(2 * room[k], need[k]);
    return room;
  }
  const Count* counts() const { return count_.data(); }
  NearSizes sizes(Queue& queue) {
    const std::vector<Count> count = queue.download(count_, kNearLists);
    NearSizes sizes{};
    std::copy(count.begin(), count.end(), sizes.begin());
    return sizes;
  }

  void clear(Queue& queue) {
    queue.forEach(std::max(int{kNearLists}, slots_.count()),
                  ClearLists{count_.data(), contact_slot_.data(), slots_.count()});
  }
  template <class T>
  List<T> list(Buffer<T>& items, NearList which) {
    return {items.data(), count_.data() + which, items.size()};
  }
  List<Pair> pairs(NearList which) { return list(pairs_[which], which); }
  FoundList found() { return {list(found_, kContacts), contact_slot_.data(), slots_}; }
  const ContactSlots& slots() const { return slots_; }

  void sort(Queue& queue) {
    contact_sum_.run(queue, contact_slot_, contact_begin_);
    const List<FoundContact> all = list(found_, kContacts);
    queue.forItems(all, PlaceContacts{slots_, contact_begin_.data(), placed_.data(), placed_.size()});
    queue.forItems(all, RankContacts{slots_,
                                     contact_begin_.data(),
                                     contact_slot_.data(),
                                     all,
                                     placed_.data(),
                                     {facts_.data(), stencil_.data(), touch_.data()}});
  }
  List<ContactFacts> facts() { return list(facts_, kContacts); }
  ContactStencil* stencils() { return stencil_.data(); }
  BodyTouch* touches() { return touch_.data(); }
  NearContacts download(Queue& queue) { return download(queue, sizes(queue)[kContacts]); }
  /// The first n of what the arrays of contacts hold, which others may have gone on with.
  NearContacts download(Queue& queue, std::size_t n) {
    return {queue.download(facts_, n), queue.download(stencil_, n), queue.download(touch_, n)};
  }

 private:
  ContactSlots slots_;
  NearSizes room_{};
  Buffer<Count> count_;
  Buffer<int> contact_slot_, contact_begin_;
  typename Device::ExclusiveSum contact_sum_;
  Buffer<Pair> pairs_[kNearLists];
  Buffer<FoundContact> found_;
  Buffer<int> placed_;
  Buffer<ContactFacts> facts_;
  Buffer<ContactStencil> stencil_;
  Buffer<BodyTouch> touch_;
};

}  // namespace gambeson::gpu
