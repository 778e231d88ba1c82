#pragma once
/// What contacts start from and leave to the next step, by sorted key, as core's step_rows has it: rows of samples on
/// cloth that are new take the mean of what the sample has borne, and two samples that are one contact leave what they
/// bore to both.

#include "core/motion/warm_start.hpp"
#include "gpu/near/contact_order.hpp"

namespace gambeson::gpu {

/// What a contact has left.
struct WarmEntry {
  ContactKey key;
  WarmStart start;
};

GAMBESON_HD inline ContactKey keyOf(const ContactFacts& f) { return {f.kind, f.sample, f.obstacle, f.feature}; }

/// Of each contact, in their order; tractions by `scale`. Slip of a contact that is not known: -1.
struct MatchWarm {
  List<WarmEntry> left;  ///< sorted
  const double* scale;
  WarmStart* start;

  GAMBESON_HD void operator()(const ContactFacts& f, Count i) const {
    const ContactKey key = gpu::keyOf(f);
    const int n = static_cast<int>(left.size());
    const auto keyOf = [&](int k) { return left.items[k].key; };
    const int at = firstNotLess(key, n, keyOf);
    WarmStart warm;
    if (at < n && keyOf(at) == key) {
      warm = left.items[at].start;
    } else {
      if (f.kind == kSampleOnCloth) {
        const ContactKey of_sample{f.kind, f.sample, std::numeric_limits<int>::min(), std::numeric_limits<int>::min()};
        const auto borne = [&](int k) { return left.items[k].start; };
        warm = meanAround(of_sample, f.normal, firstNotLess(of_sample, n, keyOf), n, keyOf, borne);
      }
      warm.slip_m_per_s = -1;
    }
    warm.traction = *scale * warm.traction;
    start[i] = warm;
  }
};

/// What a contact leaves: its own entry and, of two samples, the other's; none where it has borne nothing.
struct WarmLeft {
  const WarmStart* borne;
  ContactSlots slots;

  GAMBESON_HD int count(const ContactFacts& f, Count i) const {
    const WarmStart& b = borne[i];
    if (b.traction == Vec3{} && b.mean_Pa == 0) return 0;
    return f.partner >= 0 ? 2 : 1;
  }
  GAMBESON_HD WarmEntry entry(const ContactFacts& f, Count i, int which) const {
    if (which == 0) return {gpu::keyOf(f), borne[i]};
    WarmStart other = borne[i];
    other.traction = -other.traction;
    return {{f.kind, f.partner, f.obstacle, -1}, other};
  }
  GAMBESON_HD int slot(const ContactFacts& f, int which) const {
    return slots.of(f.kind, which == 0 ? f.sample : f.partner);
  }
};

struct CountLeft {
  WarmLeft left;
  int *of_slot, *place;  ///< of each entry, two for each contact
  Count* count;
  GAMBESON_HD void operator()(const ContactFacts& f, Count i) const {
    const int n = left.count(f, i);
    for (int k = 0; k < n; ++k) place[2 * i + static_cast<Count>(k)] = fetchAdd(&of_slot[left.slot(f, k)], 1);
    if (n > 0) fetchAdd(count, static_cast<Count>(n));
  }
};
/// Numbers of entries, those of a slot together.
struct PlaceLeft {
  WarmLeft left;
  const int *begin, *place;
  int* placed;
  Count room;
  GAMBESON_HD void operator()(const ContactFacts& f, Count i) const {
    const int n = left.count(f, i);
    for (int k = 0; k < n; ++k) {
      const Count entry = 2 * i + static_cast<Count>(k);
      const Count at = static_cast<Count>(begin[left.slot(f, k)] + place[entry]);
      if (at < room) placed[at] = static_cast<int>(entry);
    }
  }
};
/// Sorted by key, those of the same key as their contacts come.
struct RankLeft {
  WarmLeft left;
  const ContactFacts* facts;
  const int *begin, *of_slot, *placed;
  WarmEntry* sorted;
  Count room;
  GAMBESON_HD void operator()(const ContactFacts& f, Count i) const {
    const int n = left.count(f, i);
    for (int k = 0; k < n; ++k) {
      const int mine = static_cast<int>(2 * i) + k, slot = left.slot(f, k);
      const WarmEntry entry = left.entry(f, i, k);
      const Count from = static_cast<Count>(begin[slot]);
      const Count end = std::min(from + static_cast<Count>(of_slot[slot]), room);
      Count at = from;
      for (Count j = from; j < end; ++j) {
        const int other = placed[j];
        const Count contact = static_cast<Count>(other) / 2;
        const ContactKey key = left.entry(facts[contact], contact, other % 2).key;
        at += key < entry.key || (key == entry.key && other < mine);
      }
      if (at < room) sorted[at] = entry;
    }
  }
};

struct CopyLeft {
  WarmEntry* to;
  GAMBESON_HD void operator()(const WarmEntry& entry, Count i) const { to[i] = entry; }
};

template <class Device>
class WarmStarts {
 public:
  template <class T>
  using Buffer = typename Device::template Buffer<T>;
  using Queue = typename Device::Queue;

  explicit WarmStarts(const ContactSlots& slots)
      : slots_(slots),
        of_slot_(static_cast<std::size_t>(slots.count())),
        begin_(static_cast<std::size_t>(slots.count())),
        count_(1),
        scale_(1),
        sum_(slots.count()) {}

  /// For so many contacts; what is known stays.
  void makeRoom(Queue& queue, Count room) {
    if (room <= start_.size()) return;
    Buffer<WarmEntry> entries(2 * room);
    queue.forItems(left(), CopyLeft{entries.data()});
    queue.wait();
    entries_ = std::move(entries);
    place_ = Buffer<int>(2 * room), placed_ = Buffer<int>(2 * room);
    start_ = Buffer<WarmStart>(room), borne_ = Buffer<WarmStart>(room);
  }
  /// What is known at first. `scale`: of this step over the last one.
  void set(Queue& queue, std::span<const WarmEntry> sorted, double scale) {
    if (sorted.size() > entries_.size()) entries_ = Buffer<WarmEntry>(sorted.size());
    if (!sorted.empty()) queue.upload(sorted, entries_);
    const Count n = sorted.size();
    queue.upload(std::span<const Count>(&n, 1), count_);
    setScale(queue, scale);
  }
  void setScale(Queue& queue, double scale) { queue.uploadLater(std::span<const double>(&scale, 1), scale_); }

  void match(Queue& queue, const List<ContactFacts>& facts) {
    queue.forItems(facts, MatchWarm{left(), scale_.data(), start_.data()});
  }
  /// Of each contact, on the device; and where what they have borne may be written.
  const WarmStart* started() const { return start_.data(); }
  WarmStart* borne() { return borne_.data(); }
  std::vector<WarmStart> starts(Queue& queue, std::size_t n) { return queue.download(start_, n); }

  /// `borne` by the contacts, in their order, on the device: becomes what is known.
  void keep(Queue& queue, const List<ContactFacts>& facts, const WarmStart* borne) {
    const WarmLeft leaves{borne, slots_};
    queue.zero(of_slot_);
    queue.zero(count_);
    queue.forItems(facts, CountLeft{leaves, of_slot_.data(), place_.data(), count_.data()});
    sum_.run(queue, of_slot_, begin_);
    queue.forItems(facts, PlaceLeft{leaves, begin_.data(), place_.data(), placed_.data(), placed_.size()});
    queue.forItems(facts, RankLeft{leaves, facts.items, begin_.data(), of_slot_.data(), placed_.data(), entries_.data(),
                                   std::min(entries_.size(), placed_.size())});
  }
  void keep(Queue& queue, const List<ContactFacts>& facts, std::span<const WarmStart> borne) {
    if (!borne.empty()) queue.upload(borne, borne_);
    keep(queue, facts, borne_.data());
  }
  std::vector<WarmEntry> kept(Queue& queue) { return queue.download(entries_, queue.download(count_, 1)[0]); }

 private:
  List<WarmEntry> left() { return {entries_.data(), count_.data(), entries_.size()}; }

  ContactSlots slots_;
  Buffer<WarmEntry> entries_;
  Buffer<int> place_, placed_, of_slot_, begin_;
  Buffer<Count> count_;
  Buffer<double> scale_;
  Buffer<WarmStart> start_, borne_;
  typename Device::ExclusiveSum sum_;
};

}  // namespace gambeson::gpu
