#pragma once
/// What a persistent contact starts from: what the last step has left, by sorted key. Detail of step_rows.cpp, for host
/// and device.

#include "core/math/vec.hpp"

namespace gambeson {

/// A contact by its key (the order of WarmContact and of rows).
struct ContactKey {
  int kind = 0, sample = 0, obstacle = 0, feature = 0;
};
GAMBESON_HD inline bool operator<(const ContactKey& a, const ContactKey& b) {
  if (a.kind != b.kind) return a.kind < b.kind;
  if (a.sample != b.sample) return a.sample < b.sample;
  if (a.obstacle != b.obstacle) return a.obstacle < b.obstacle;
  return a.feature < b.feature;
}
GAMBESON_HD inline bool operator==(const ContactKey& a, const ContactKey& b) { return !(a < b) && !(b < a); }

/// Traction times time, the pressure that has lasted, and the speed of slip where friction depends on it.
struct WarmStart {
  Vec3 traction;
  double mean_Pa = 0;
  double slip_m_per_s = 0;
};

/// The first of n whose key is not less. keyOf(k) tells that of number k.
template <class KeyOf>
GAMBESON_HD int firstNotLess(const ContactKey& key, int n, const KeyOf& keyOf) {
  int from = 0;
  while (n > 0) {
    const int half = n / 2;
    if (keyOf(from + half) < key) {
      from += half + 1;
      n -= half + 1;
    } else {
      n = half;
    }
  }
  return from;
}

/// A sample's feet move from feature to feature, and there may be one or several of them: a new one on cloth starts
/// from what those on its side have borne in the mean. `first`: the first of n of that kind and sample.
template <class KeyOf, class Borne>
GAMBESON_HD WarmStart meanAround(const ContactKey& key, const Vec3& normal, int first, int n, const KeyOf& keyOf,
                                 const Borne& borne) {
  WarmStart mean;
  int count = 0;
  for (int k = first; k < n && keyOf(k).kind == key.kind && keyOf(k).sample == key.sample; ++k) {
    const WarmStart one = borne(k);
    if (!(dot(one.traction, normal) > 0)) continue;
    mean.traction += one.traction;
    mean.mean_Pa += one.mean_Pa;
    ++count;
  }
  if (count == 0) return mean;
  mean.traction *= 1.0 / count;
  mean.mean_Pa /= count;
  return mean;
}

}  // namespace gambeson
