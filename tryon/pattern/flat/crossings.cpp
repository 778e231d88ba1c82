#include "tryon/pattern/flat/crossings.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace gambeson {
namespace {

/// The sum of six products and differences of doubles, exactly: parts that do not overlap, in increasing size.
class ExactSum {
 public:
  void addProduct(double a, double b) {
    const double p = a * b;
    add(std::fma(a, b, -p));
    add(p);
  }
  int sign() const { return size_ == 0 ? 0 : part_[size_ - 1] > 0 ? 1 : -1; }

 private:
  void add(double b) {  // Shewchuk 1997, GROW-EXPANSION, zeros left out
    std::size_t kept = 0;
    double carry = b;
    for (std::size_t i = 0; i < size_; ++i) {
      const double sum = carry + part_[i], virt = sum - carry;
      const double rest = (carry - (sum - virt)) + (part_[i] - virt);
      if (rest != 0) part_[kept++] = rest;
      carry = sum;
    }
    if (carry != 0) part_[kept++] = carry;
    size_ = kept;
  }
  std::array<double, 12> part_{};
  std::size_t size_ = 0;
};

bool same(Vec2 a, Vec2 b) { return a.x == b.x && a.y == b.y; }

bool within(double x, double a, double b) { return std::min(a, b) <= x && x <= std::max(a, b); }

/// Whether a point on the line through a and b lies between them.
bool between(Vec2 p, Vec2 a, Vec2 b) { return within(p.x, a.x, b.x) && within(p.y, a.y, b.y); }

struct Line {
  int polygon, number;
  Vec2 a, b;
};

/// On which side of the way prev -> at -> next a point lies: 1 left, -1 right, 0 on it.
int sideOfWay(Vec2 prev, Vec2 at, Vec2 next, Vec2 p) {
  const int in = turnSign(prev, at, p), out = turnSign(at, next, p), bend = turnSign(prev, at, next);
  const auto ahead = [](Vec2 from, Vec2 to, Vec2 x) {  // on the line, on this side of `from`
    return (x.x - from.x) * (to.x - from.x) + (x.y - from.y) * (to.y - from.y) > 0;
  };
  if ((out == 0 && ahead(at, next, p)) || (in == 0 && ahead(at, prev, p))) return 0;
  if (bend > 0) return in > 0 && out > 0 ? 1 : -1;
  if (bend < 0) return in < 0 && out < 0 ? -1 : 1;
  return in;  // straight on; a way that turns back has no sides, and 0 only where p lies on it
}

}  // namespace

int turnSign(Vec2 a, Vec2 b, Vec2 c) {
  const double left = (a.x - c.x) * (b.y - c.y), right = (a.y - c.y) * (b.x - c.x), det = left - right;
  // (3 + 16 u) u, u = 2^-53: Shewchuk 1997, section 4.3
  if (std::abs(det) > 3.3306690738754716e-16 * (std::abs(left) + std::abs(right))) return det > 0 ? 1 : -1;
  ExactSum sum;
  sum.addProduct(a.x, b.y);
  sum.addProduct(-a.x, c.y);
  sum.addProduct(-c.x, b.y);
  sum.addProduct(-a.y, b.x);
  sum.addProduct(a.y, c.x);
  sum.addProduct(c.y, b.x);
  return sum.sign();
}

int windingOf(std::span<const Vec2> polygon, Vec2 p) {
  int winding = 0;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec2 a = polygon[k], b = polygon[(k + 1) % polygon.size()];
    if (a.y <= p.y && b.y > p.y && turnSign(a, b, p) > 0) ++winding;
    if (a.y > p.y && b.y <= p.y && turnSign(a, b, p) < 0) --winding;
  }
  return winding;
}

Meetings meetingsOf(const std::vector<std::vector<Vec2>>& polygons) {
  std::vector<Line> lines;
  for (std::size_t p = 0; p < polygons.size(); ++p)
    for (std::size_t k = 0; k < polygons[p].size(); ++k)
      lines.push_back(
          {static_cast<int>(p), static_cast<int>(k), polygons[p][k], polygons[p][(k + 1) % polygons[p].size()]});
  std::sort(lines.begin(), lines.end(), [](const Line& s, const Line& t) {
    const double x = std::min(s.a.x, s.b.x), y = std::min(t.a.x, t.b.x);
    return x != y ? x < y : s.polygon != t.polygon ? s.polygon < t.polygon : s.number < t.number;
  });
  Meetings found;
  const auto point = [&](int polygon, int k) {
    const std::vector<Vec2>& p = polygons[static_cast<std::size_t>(polygon)];
    const int n = static_cast<int>(p.size());
    return p[static_cast<std::size_t>((k % n + n) % n)];
  };
  const auto cross = [&](const Line& s, const Line& t, Vec2 at) {
    if (found.crossing.empty()) found.crossing.push_back({s.polygon, s.number, t.polygon, t.number, at});
  };
  const auto touch = [&](const Line& s, const Line& t, Vec2 at) {
    if (found.touch.empty()) found.touch.push_back({s.polygon, s.number, t.polygon, t.number, at});
  };
  // The start of t on the line s.
  const auto startOn = [&](const Line& t, const Line& s) {
    if (turnSign(s.a, s.b, t.a) != 0 || !between(t.a, s.a, s.b) || same(t.a, s.b)) return;
    const Vec2 prev = same(t.a, s.a) ? point(s.polygon, s.number - 1) : s.a;
    const Vec2 back = point(t.polygon, t.number - 1);
    const int one = sideOfWay(prev, t.a, s.b, back), other = sideOfWay(prev, t.a, s.b, t.b);
    if (one * other < 0)
      cross(s, t, t.a);
    else
      touch(s, t, t.a);
  };
  for (std::size_t i = 0; i < lines.size() && found.crossing.empty(); ++i) {
    const Line& s = lines[i];
    const double end = std::max(s.a.x, s.b.x);
    for (std::size_t j = i + 1; j < lines.size() && std::min(lines[j].a.x, lines[j].b.x) <= end; ++j) {
      const Line& t = lines[j];
      if (std::max(t.a.y, t.b.y) < std::min(s.a.y, s.b.y) || std::max(s.a.y, s.b.y) < std::min(t.a.y, t.b.y)) continue;
      const int n = static_cast<int>(polygons[static_cast<std::size_t>(s.polygon)].size());
      const bool s_then_t = s.polygon == t.polygon && (s.number + 1) % n == t.number;
      const bool t_then_s = s.polygon == t.polygon && (t.number + 1) % n == s.number;
      if (s_then_t || t_then_s) {
        const Line &first = s_then_t ? s : t, &second = s_then_t ? t : s;
        if (n > 2 && turnSign(first.a, first.b, second.b) == 0 &&
            (first.a.x - first.b.x) * (second.b.x - first.b.x) + (first.a.y - first.b.y) * (second.b.y - first.b.y) > 0)
          touch(first, second, first.b);  // turns back on itself
        continue;
      }
      const int a = turnSign(s.a, s.b, t.a), b = turnSign(s.a, s.b, t.b);
      const int c = turnSign(t.a, t.b, s.a), d = turnSign(t.a, t.b, s.b);
      if (a * b < 0 && c * d < 0) {
        const double along = static_cast<double>((t.a.x - s.a.x) * (t.b.y - t.a.y) - (t.a.y - s.a.y) * (t.b.x - t.a.x)),
                     whole = (s.b.x - s.a.x) * (t.b.y - t.a.y) - (s.b.y - s.a.y) * (t.b.x - t.a.x);
        const double u = whole != 0 ? std::clamp(along / whole, 0.0, 1.0) : 0.5;
        cross(s, t, {s.a.x + u * (s.b.x - s.a.x), s.a.y + u * (s.b.y - s.a.y)});
      } else {
        startOn(t, s);
        if (!same(s.a, t.a)) startOn(s, t);
      }
    }
  }
  return found;
}

}  // namespace gambeson
