#include "exact_impact.hpp"

#include <algorithm>
#include <cmath>

namespace gambeson::exact {

namespace {

void trim(Poly& p) {
  while (!p.empty() && p.back() == 0) p.pop_back();
}

Poly operator+(const Poly& a, const Poly& b) {
  Poly c(std::max(a.size(), b.size()));
  for (std::size_t i = 0; i < a.size(); ++i) c[i] += a[i];
  for (std::size_t i = 0; i < b.size(); ++i) c[i] += b[i];
  trim(c);
  return c;
}
Poly operator-(const Poly& a, const Poly& b) {
  Poly c(std::max(a.size(), b.size()));
  for (std::size_t i = 0; i < a.size(); ++i) c[i] += a[i];
  for (std::size_t i = 0; i < b.size(); ++i) c[i] -= b[i];
  trim(c);
  return c;
}
Poly operator*(const Poly& a, const Poly& b) {
  if (a.empty() || b.empty()) return {};
  Poly c(a.size() + b.size() - 1);
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.size(); ++j) c[i + j] += a[i] * b[j];
  trim(c);
  return c;
}

Poly derivative(const Poly& p) {
  Poly d;
  for (std::size_t i = 1; i < p.size(); ++i) d.push_back(p[i] * static_cast<unsigned long>(i));
  trim(d);
  return d;
}

void makePrimitive(Poly& p) {
  mpz_class g = 0;
  for (const mpz_class& c : p) g = gcd(g, c);
  if (g > 1)
    for (mpz_class& c : p) c /= g;
}

/// A positive multiple of the remainder of a by b.
Poly remainder(Poly a, const Poly& b) {
  const mpz_class lead = abs(b.back());
  const int s = sgn(b.back());
  while (a.size() >= b.size()) {
    const mpz_class top = s * a.back();
    const std::size_t shift = a.size() - b.size();
    for (mpz_class& c : a) c *= lead;
    for (std::size_t i = 0; i < b.size(); ++i) a[shift + i] -= top * b[i];
    trim(a);
  }
  makePrimitive(a);
  return a;
}

Poly gcdOf(Poly a, Poly b) {
  while (!b.empty()) {
    Poly r = remainder(std::move(a), b);
    a = std::move(b);
    b = std::move(r);
  }
  makePrimitive(a);
  return a;
}

/// a / b where b divides a (up to a positive or negative rational factor).
Poly quotient(Poly a, const Poly& b) {
  if (a.size() < b.size()) return {};
  Poly q(a.size() - b.size() + 1);
  while (a.size() >= b.size()) {
    const std::size_t shift = a.size() - b.size();
    const mpz_class top = a.back();
    for (mpz_class& c : a) c *= b.back();
    for (mpz_class& c : q) c *= b.back();
    q[shift] += top;
    for (std::size_t i = 0; i < b.size(); ++i) a[shift + i] -= top * b[i];
    trim(a);
  }
  trim(q);
  makePrimitive(q);
  return q;
}

/// Sign of p(x).
int signOf(const Poly& p, const Dyadic& x) {
  if (p.empty()) return 0;
  mpz_class s = p.back();
  for (std::size_t i = p.size() - 1; i-- > 0;) s = s * x.n + (p[i] << (x.k * (p.size() - 1 - i)));
  return sgn(s);
}

void sameScale(Dyadic& a, Dyadic& b) {
  if (a.k < b.k) a.n <<= b.k - a.k, a.k = b.k;
  if (b.k < a.k) b.n <<= a.k - b.k, b.k = a.k;
}

Dyadic middle(Dyadic a, Dyadic b) {
  sameScale(a, b);
  return {a.n + b.n, a.k + 1};
}

int compare(Dyadic a, Dyadic b) {
  sameScale(a, b);
  return cmp(a.n, b.n);
}

Dyadic dyadic(double t) {
  int e = 0;
  const double m = std::frexp(t, &e);  // t = m 2^e
  Dyadic d{mpz_class(std::ldexp(m, 53)), 0};
  e -= 53;
  if (e >= 0)
    d.n <<= static_cast<unsigned>(e);
  else
    d.k = static_cast<unsigned>(-e);
  return d;
}

/// One sign of p on all of [lo, hi], from its Bernstein coefficients; 0 where they do not tell. Degree up to 4.
int signOnInterval(const Poly& p, Dyadic lo, Dyadic hi) {
  if (p.empty()) return 0;
  sameScale(lo, hi);
  const int n = static_cast<int>(p.size()) - 1;
  const mpz_class width = hi.n - lo.n;
  Poly a(p.size());  // 2^(kn) p((lo + width s) / 2^k) in powers of s
  for (int i = 0; i <= n; ++i) a[i] = p[i] << (lo.k * (n - i));
  for (int i = 0; i < n; ++i)
    for (int j = n - 1; j >= i; --j) a[j] += lo.n * a[j + 1];
  mpz_class power = 1;
  for (int i = 1; i <= n; ++i) power *= width, a[i] *= power;
  static const int choose[5][5] = {{1, 0, 0, 0, 0}, {1, 1, 0, 0, 0}, {1, 2, 1, 0, 0}, {1, 3, 3, 1, 0}, {1, 4, 6, 4, 1}};
  int sign = 2;
  for (int i = 0; i <= n; ++i) {
    mpz_class b = 0;
    for (int j = 0; j <= i; ++j) b += a[j] * (12 * choose[i][j] / choose[n][j]);
    const int s = sgn(b);
    if (s == 0 || (sign != 2 && s != sign)) return 0;
    sign = s;
  }
  return sign;
}

struct Sturm {
  std::vector<Poly> chain;
  explicit Sturm(const Poly& p) : chain{p, derivative(p)} {
    while (!chain.back().empty()) {
      Poly r = remainder(chain[chain.size() - 2], chain.back());
      for (mpz_class& c : r) c = -c;
      chain.push_back(std::move(r));
    }
    chain.pop_back();
  }
  int changes(const Dyadic& x) const {
    int n = 0, last = 0;
    for (const Poly& p : chain) {
      const int s = signOf(p, x);
      if (s != 0 && last != 0 && s != last) ++n;
      if (s != 0) last = s;
    }
    return n;
  }
};

void isolate(const Poly& g, const Sturm& sturm, const Dyadic& lo, int at_lo, const Dyadic& hi, int at_hi,
             std::vector<Root>& out) {
  const int count = at_lo - at_hi;  // roots in (lo, hi]
  if (count == 0) return;
  if (count == 1) {
    if (signOf(g, hi) == 0) {
      out.push_back({g, hi, hi, true});
      return;
    }
    if (signOf(g, lo) != 0) {
      out.push_back({g, lo, hi, false});
      return;
    }
  }
  const Dyadic m = middle(lo, hi);
  const int at_m = sturm.changes(m);
  isolate(g, sturm, lo, at_lo, m, at_m, out);
  isolate(g, sturm, m, at_m, hi, at_hi, out);
}

void refine(Root& r) {
  if (r.exact) return;
  const Dyadic m = middle(r.lo, r.hi);
  const int s = signOf(r.poly, m);
  if (s == 0) {
    r.lo = r.hi = m;
    r.exact = true;
  } else {
    (s == signOf(r.poly, r.lo) ? r.lo : r.hi) = m;
  }
}

const Dyadic kZero{0, 0}, kOne{1, 0};

using PolyVec = std::array<Poly, 3>;
PolyVec operator-(const PolyVec& a, const PolyVec& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Poly dotOf(const PolyVec& a, const PolyVec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
PolyVec crossOf(const PolyVec& a, const PolyVec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// The four motions as integer polynomials, in units of a power of two.
std::array<PolyVec, 4> motion(const FourPoints& x0, const FourPoints& x1) {
  int low = 5000;
  const auto each = [&](auto&& f) {
    for (int i = 0; i < 4; ++i)
      for (int k = 0; k < 3; ++k) f(i, k, x0[i][k], x1[i][k]);
  };
  const auto exponent = [&](double x) {
    if (x == 0) return;
    int e = 0;
    std::frexp(x, &e);
    low = std::min(low, e - 53);
  };
  each([&](int, int, double a, double b) { exponent(a), exponent(b); });
  const auto integer = [&](double x) -> mpz_class {
    if (x == 0) return 0;
    int e = 0;
    const double m = std::frexp(x, &e);
    return mpz_class(std::ldexp(m, 53)) << static_cast<unsigned>(e - 53 - low);
  };
  std::array<PolyVec, 4> out;
  each([&](int i, int k, double a, double b) {
    const mpz_class start = integer(a);
    out[i][k] = {start, integer(b) - start};
    trim(out[i][k]);
  });
  return out;
}

bool vanishes(const PolyVec& v, Root& r) {
  return signAt(v[0], r) == 0 && signAt(v[1], r) == 0 && signAt(v[2], r) == 0;
}

/// Is p on the segment ab (which may be a point)?
bool onSegment(const PolyVec& p, const PolyVec& a, const PolyVec& b, Root& r) {
  const PolyVec pa = p - a, pb = p - b;
  return signAt(dotOf(pa, pb), r) <= 0 && vanishes(crossOf(pa, pb), r);
}

bool inTriangle(const std::array<PolyVec, 4>& x, Root& r) {
  const PolyVec &p = x[0], &a = x[1], &b = x[2], &c = x[3];
  const PolyVec n = crossOf(b - a, c - a);
  if (vanishes(n, r)) return onSegment(p, a, b, r) || onSegment(p, b, c, r) || onSegment(p, c, a, r);
  return signAt(dotOf(n, crossOf(b - a, p - a)), r) >= 0 && signAt(dotOf(n, crossOf(c - b, p - b)), r) >= 0 &&
         signAt(dotOf(n, crossOf(a - c, p - c)), r) >= 0 && signAt(dotOf(n, p - a), r) == 0;
}

bool segmentsMeet(const std::array<PolyVec, 4>& x, Root& r) {
  const PolyVec &a = x[0], &b = x[1], &c = x[2], &d = x[3];
  const PolyVec e = b - a, f = d - c, w = c - a, n = crossOf(e, f);
  if (vanishes(n, r))
    return onSegment(a, c, d, r) || onSegment(b, c, d, r) || onSegment(c, a, b, r) || onSegment(d, a, b, r);
  // a + s e = c + t f: s n.n = (w x f).n, t n.n = (w x e).n
  const Poly n2 = dotOf(n, n), s = dotOf(crossOf(w, f), n), t = dotOf(crossOf(w, e), n);
  return signAt(dotOf(n, w), r) == 0 && signAt(s, r) >= 0 && signAt(n2 - s, r) >= 0 && signAt(t, r) >= 0 &&
         signAt(n2 - t, r) >= 0;
}

/// Times at which p may come onto the segment ab in a motion that stays in one plane.
void arrivals(const PolyVec& p, const PolyVec& a, const PolyVec& b, std::vector<Root>& out) {
  const PolyVec pa = p - a, pb = p - b;
  PolyVec area = crossOf(pa, pb);
  const Poly* f = nullptr;
  for (const Poly& c : area)
    if (!c.empty()) f = &c;
  const Poly along = dotOf(pa, pb);
  if (!f) f = &along;  // all on one line at all times: it comes in through an end
  if (f->empty()) return;
  for (Root& r : rootsInUnit(*f)) out.push_back(std::move(r));
}

template <class Meets>
Impacts impacts(const std::array<PolyVec, 4>& x, const Poly& coplanar, const std::vector<std::array<int, 3>>& segments,
                const Meets& meets) {
  std::vector<Root> candidates;
  if (!coplanar.empty()) {
    if (signOnInterval(coplanar, kZero, kOne) != 0) return {};
    candidates = rootsInUnit(coplanar);
  } else {
    candidates.push_back({{}, kZero, kZero, true});
    for (const auto& [p, a, b] : segments) arrivals(x[p], x[a], x[b], candidates);
  }
  Impacts out;
  for (Root& r : candidates)
    if (meets(x, r)) out.times.push_back(std::move(r));
  return out;
}

using RationalVec = std::array<mpq_class, 3>;
bool within(const RationalVec& d, double distance) {
  const mpq_class limit(distance);
  return d[0] * d[0] + d[1] * d[1] + d[2] * d[2] <= limit * limit;
}
mpq_class positionAt(double x0, double x1, double t) {
  const mpq_class a(x0), b(x1), s(t);
  return a + s * (b - a);
}

}  // namespace

std::vector<Root> rootsInUnit(const Poly& f) {
  std::vector<Root> out;
  if (f.size() < 2) return out;
  Poly g = f;
  makePrimitive(g);
  const Poly common = gcdOf(g, derivative(g));
  if (common.size() > 1) g = quotient(g, common);
  if (signOf(g, kZero) == 0) out.push_back({g, kZero, kZero, true});
  const Sturm sturm(g);
  isolate(g, sturm, kZero, sturm.changes(kZero), kOne, sturm.changes(kOne), out);
  return out;
}

int signAt(const Poly& h, Root& r) {
  if (h.empty()) return 0;
  if (h.size() == 1) return sgn(h[0]);
  for (int i = 0;; ++i) {
    if (r.exact) return signOf(h, r.lo);
    if (const int s = signOnInterval(h, r.lo, r.hi)) return s;
    if (i == 3) {  // zero there? Where both have a common root in the interval.
      const Poly common = gcdOf(r.poly, h);
      if (common.size() > 1) {
        const Sturm sturm(common);  // a factor of a square-free polynomial
        if (sturm.changes(r.lo) - sturm.changes(r.hi) > 0) return 0;
      }
    }
    for (int k = 0; k < 12; ++k) refine(r);
  }
}

bool Impacts::before(double t) const {
  const Dyadic at = dyadic(t);
  return std::any_of(times.begin(), times.end(), [&](const Root& r) {
    if (r.exact) return compare(r.lo, at) < 0;
    if (compare(at, r.lo) <= 0) return false;
    if (compare(at, r.hi) >= 0) return true;
    const int s = signOf(r.poly, at);
    return s != 0 && s != signOf(r.poly, r.lo);
  });
}

double Impacts::firstAbout() const {
  double first = INFINITY;
  for (Root r : times) {
    for (int i = 0; i < 45; ++i) refine(r);
    first = std::min(first, mpq_class(mpq_class(r.hi.n) / mpq_class(mpz_class(1) << r.hi.k)).get_d());
  }
  return first;
}

Impacts pointTriangle(const FourPoints& x0, const FourPoints& x1) {
  const auto x = motion(x0, x1);
  const Poly f = dotOf(crossOf(x[2] - x[1], x[3] - x[1]), x[0] - x[1]);
  return impacts(x, f, {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}}, inTriangle);
}

Impacts edgeEdge(const FourPoints& x0, const FourPoints& x1) {
  const auto x = motion(x0, x1);
  const Poly f = dotOf(crossOf(x[1] - x[0], x[3] - x[2]), x[2] - x[0]);
  return impacts(x, f, {{0, 2, 3}, {1, 2, 3}, {2, 0, 1}, {3, 0, 1}}, segmentsMeet);
}

bool pointTriangleWithin(const FourPoints& x0, const FourPoints& x1, double t, double u, double v, double distance) {
  RationalVec d;
  const mpq_class U(u);
  mpq_class V(v);
  if (U + V > 1) V = 1 - U;  // where rounding left the edge bc
  for (int k = 0; k < 3; ++k) {
    const auto at = [&](int i) { return positionAt(x0[i][k], x1[i][k], t); };
    d[k] = at(0) - ((1 - U - V) * at(1) + U * at(2) + V * at(3));
  }
  return u >= 0 && v >= 0 && u <= 1 && within(d, distance);
}

bool edgeEdgeWithin(const FourPoints& x0, const FourPoints& x1, double t, double u, double v, double distance) {
  RationalVec d;
  const mpq_class U(u), V(v);
  for (int k = 0; k < 3; ++k) {
    const auto at = [&](int i) { return positionAt(x0[i][k], x1[i][k], t); };
    d[k] = (1 - U) * at(0) + U * at(1) - ((1 - V) * at(2) + V * at(3));
  }
  return u >= 0 && u <= 1 && v >= 0 && v <= 1 && within(d, distance);
}

}  // namespace gambeson::exact
