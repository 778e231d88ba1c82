#include "human/motion/curve.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace gambeson {
namespace {

class SampledMotion final : public Motion {
 public:
  SampledMotion(std::vector<double> times, std::vector<MotionColumn> columns, Posture rest)
      : times_(std::move(times)), columns_(std::move(columns)), rest_(std::move(rest)) {}
  double duration() const override { return times_.back(); }
  Posture at(double time_s) const override {
    const double t = std::clamp(time_s, 0.0, duration());
    const std::size_t i =
        std::clamp<std::size_t>(
            static_cast<std::size_t>(std::upper_bound(times_.begin(), times_.end(), t) - times_.begin()), 1,
            times_.size() - 1) -
        1;
    const double h = times_[i + 1] - times_[i], u = (t - times_[i]) / h, w = 1 - u;
    Posture p = rest_;
    Vec3 turn;
    bool turned = false;
    for (const MotionColumn& c : columns_) {
      const double x = w * w * (1 + 2 * u) * c.x[i] + u * u * (1 + 2 * w) * c.x[i + 1] +
                       h * u * w * (w * c.slope[i] - u * c.slope[i + 1]);
      if (c.joint >= 0)
        p.q[c.joint] = x;
      else if (c.root < 3)
        p.root.origin[c.root] = x;
      else
        turn[c.root - 3] = x, turned = true;
    }
    if (turned) p.root.rotation = rotationOf(turn);
    return p;
  }

 private:
  std::vector<double> times_;
  std::vector<MotionColumn> columns_;
  Posture rest_;
};

}  // namespace

std::vector<double> monotoneSlopes(const std::vector<double>& t, const std::vector<double>& x) {
  const std::size_t n = t.size();
  std::vector<double> h(n - 1), d(n - 1), m(n);
  for (std::size_t i = 0; i + 1 < n; ++i) h[i] = t[i + 1] - t[i], d[i] = (x[i + 1] - x[i]) / h[i];
  if (n == 2) return {d[0], d[0]};
  for (std::size_t i = 1; i + 1 < n; ++i)
    if (d[i - 1] * d[i] > 0) {
      const double w1 = 2 * h[i] + h[i - 1], w2 = h[i] + 2 * h[i - 1];
      m[i] = (w1 + w2) / (w1 / d[i - 1] + w2 / d[i]);
    }
  const auto end = [](double h0, double h1, double d0, double d1) {
    const double s = ((2 * h0 + h1) * d0 - h0 * d1) / (h0 + h1);
    if (s * d0 <= 0) return 0.0;
    return d0 * d1 < 0 && std::abs(s) > 3 * std::abs(d0) ? 3 * d0 : s;
  };
  m[0] = end(h[0], h[1], d[0], d[1]);
  m[n - 1] = end(h[n - 2], h[n - 3], d[n - 2], d[n - 3]);
  return m;
}

std::vector<double> splineSlopes(const std::vector<double>& t, const std::vector<double>& x) {
  const std::size_t n = t.size();
  std::vector<double> h(n - 1), d(n - 1), m(n), c(n);
  for (std::size_t i = 0; i + 1 < n; ++i) h[i] = t[i + 1] - t[i], d[i] = (x[i + 1] - x[i]) / h[i];
  if (n == 2) return {d[0], d[0]};
  m[0] = ((2 * h[0] + h[1]) * d[0] - h[0] * d[1]) / (h[0] + h[1]);
  // Second derivatives agree at knot i: m[i-1] / h[i-1] + 2 m[i] (1 / h[i-1] + 1 / h[i]) + m[i+1] / h[i]
  //   = 3 (d[i-1] / h[i-1] + d[i] / h[i]); diagonally dominant, solved by elimination.
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double a = 1 / h[i - 1], b = 1 / h[i], pivot = 2 * (a + b) - a * c[i - 1];
    c[i] = b / pivot;
    m[i] = (3 * (a * d[i - 1] + b * d[i]) - a * m[i - 1]) / pivot;
  }
  m[n - 1] = ((2 * h[n - 2] + h[n - 3]) * d[n - 2] - h[n - 2] * d[n - 3]) / (h[n - 2] + h[n - 3]);
  for (std::size_t i = n - 2; i > 0; --i) m[i] -= c[i] * m[i + 1];
  return m;
}

Mat3 rotationOf(const Vec3& turn) {
  return rotationAbout({0, 0, 1}, turn.z) * rotationAbout({0, 1, 0}, turn.y) * rotationAbout({1, 0, 0}, turn.x);
}

Vec3 anglesOf(const Mat3& R) {
  return {std::atan2(R.b.z, R.c.z), std::asin(std::clamp(-R.a.z, -1.0, 1.0)), std::atan2(R.a.y, R.a.x)};
}

std::unique_ptr<Motion> makeSampledMotion(std::vector<double> times, std::vector<MotionColumn> columns, Posture rest) {
  assert(times.size() >= 2 && times.front() == 0);
  return std::make_unique<SampledMotion>(std::move(times), std::move(columns), std::move(rest));
}

}  // namespace gambeson
