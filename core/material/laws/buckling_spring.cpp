#include "core/material/laws/buckling_spring.hpp"

#include <algorithm>
#include <cmath>

namespace gambeson {
namespace {

/// s = sinc a - cos a over a^2, and (3 s - a sin a) over a^4: by their series where their terms cancel.
struct Arc {
  double s, h;
  explicit Arc(double a) {
    const double t = a * a;
    if (a < 0.1) {
      s = 1.0 / 3 - t * (1.0 / 30 - t * (1.0 / 840 - t / 45360));
      h = 1.0 / 15 - t * (1.0 / 210 - t * (1.0 / 7560 - t / 498960));
    } else {
      const double difference = std::sin(a) / a - std::cos(a);
      s = difference / t;
      h = (3 * difference - a * std::sin(a)) / (t * t);
    }
  }
};

}  // namespace

double inverseSinc(double x) {
  const double u = 1 - x;
  if (u <= 0) return 0;
  if (u < 1e-4) return std::sqrt(u * (6 + u * (1.8 + 0.822857142857 * u)));
  double a = std::sqrt(u * (6 + 3.8696 * u));  // exact to first order, and at pi
  for (int k = 0; k < 5; ++k) a -= (std::sin(a) / a - x) * a / (std::cos(a) - std::sin(a) / a);
  return a;
}

double bucklingForce(double rigidity, double length, double a) { return -4 * rigidity / (length * length * Arc(a).s); }

BucklingSpring::BucklingSpring(double rigidity_Nm2, double length_m, double start_N_per_m)
    : rigidity_(rigidity_Nm2), length_(length_m), start_(start_N_per_m) {
  const auto missing = [&](double shorter) {
    return start_ * shorter + bucklingForce(rigidity_, length_, inverseSinc(1 - shorter / length_));
  };
  double low = 0, high = length_;
  if (missing(high) < 0) {
    begins_ = length_;
    return;
  }
  for (int k = 0; k < 80 && low < high; ++k) {
    const double middle = 0.5 * (low + high);
    (missing(middle) < 0 ? low : high) = middle;
  }
  begins_ = high;
  const double a = inverseSinc(1 - begins_ / length_);
  offset_J_ = 0.5 * start_ * begins_ * begins_ - 2 * rigidity_ * a * a / length_;
}

SpringAnswer<double> BucklingSpring::answer(double length2) const {
  SpringAnswer<double> out;
  const double d = std::sqrt(length2), shorter = length_ - d;
  if (!(shorter > 0)) return out;
  if (shorter <= begins_) {
    const double force = -start_ * shorter;
    out = {0.5 * start_ * shorter * shorter, force / std::sqrt(length2 + spring_least_m2), start_, 0};
  } else {
    const double a = inverseSinc(d / length_);
    const Arc arc(a);
    out.energy = 2 * rigidity_ * a * a / length_ + offset_J_;
    out.per_length = bucklingForce(rigidity_, length_, a) / std::sqrt(length2 + spring_least_m2);
    // df/dd = (df/da)/(dd/da) with d = L sinc a, dd/da = -L a s, s and h as in Arc.
    out.along = 4 * rigidity_ * arc.h / (length_ * length_ * length_ * arc.s * arc.s * arc.s);
  }
  out.across = out.per_length;
  return out;
}

}  // namespace gambeson
