#include "core/cloth/draft/fields.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "core/cloth/draft/garment.hpp"
#include "core/error.hpp"
#include "core/material/fabric_law.hpp"

namespace gambeson {
namespace {

/// Uniform open knots on [0, 1] for `count` functions; degree 0 has one function a cell.
double splineAlong(int degree, int count, double s, const auto& value) {
  if (degree == 0) return value(std::min(static_cast<int>(s * count), count - 1));
  const KnotVector knots = uniformKnots(degree, count - degree);
  const int span = findSpan(knots, s);
  std::array<double, 4> basis{};
  basisDerivatives(knots, span, s, 0, std::span(basis.data(), degree + 1));
  double sum = 0;
  for (int k = 0; k <= degree; ++k) sum += basis[k] * value(span - degree + k);
  return sum;
}

Vec2 fraction(const NurbsPatch& p, Vec2 uv) {
  return {(uv.x - p.u.front()) / (p.u.back() - p.u.front()), (uv.y - p.v.front()) / (p.v.back() - p.v.front())};
}

const PatchFields* fieldsOf(const Garment& g, int patch) { return g.fields.empty() ? nullptr : &g.fields[patch]; }

/// (1 - w) a + w b of all that the laws read; of Young's moduli and Poisson's ratio through the plane-stress stiffness
///   Q11 = E1 / s, Q22 = E2 / s, Q12 = nu E2 / s, s = 1 - nu^2 E2 / E1,
/// which is positive definite between two that are. Moduli and ratio mixed one by one need not be.
Fabric mixture(const Fabric& a, const Fabric& b, double w) {
  Fabric f = a;
  for (double Fabric::*member :
       {&Fabric::thickness_m, &Fabric::density_kg_per_m3, &Fabric::shear_Pa, &Fabric::jam_area})
    f.*member = mix(a.*member, b.*member, w);
  for (double ShearFriction::*member :
       {&ShearFriction::rise_N_per_m, &ShearFriction::span, &ShearFriction::growth_N_per_m})
    f.shear_friction.*member = mix(a.shear_friction.*member, b.shear_friction.*member, w);
  std::visit(
      [&]<class L>(const L& law) {
        if constexpr (requires { L::mixed(law, law, w); }) f.law = L::mixed(law, std::get<L>(b.law), w);
      },
      a.law);
  const auto stiffness = [](const Fabric& g) {
    const double s = 1 - g.poisson * g.poisson * g.young_warp_Pa / g.young_weft_Pa;
    return std::array{g.young_weft_Pa / s, g.young_warp_Pa / s, g.poisson * g.young_warp_Pa / s};
  };
  const auto in_a = stiffness(a), in_b = stiffness(b);
  const double Q11 = mix(in_a[0], in_b[0], w), Q22 = mix(in_a[1], in_b[1], w), Q12 = mix(in_a[2], in_b[2], w),
               s = 1 - Q12 * Q12 / (Q11 * Q22);
  f.young_weft_Pa = Q11 * s;
  f.young_warp_Pa = Q22 * s;
  f.poisson = Q12 / Q22;
  return f;
}

/// Laws that are an energy at a point can neither be mixed nor made thicker.
void checkPointEnergies(const Garment& g, int patch, const std::string& at) {
  if (!fabricVaries(g, patch) || fabricOfPatch(g, patch)) return;
  const PatchFields& f = g.fields[static_cast<std::size_t>(patch)];
  std::vector<double> numbers{0};
  if (f.material) numbers = f.material->values;
  for (double number : numbers)
    for (double k : {std::floor(number), std::ceil(number)}) {
      const Fabric& fabric = k == 0 ? g.fabric : g.other_fabrics[static_cast<std::size_t>(k) - 1];
      if (fabric.energy)
        throw InputError({"", 0, at + (f.thickness ? "thickness" : "material")},
                         "a fabric whose law is a table is one over a whole patch");
    }
}

}  // namespace

void validate(const PatchField& f) {
  const auto reject = [](const char* key, const std::string& reason) { throw InputError({"", 0, key}, reason); };
  if (f.degree < 0 || f.degree > 3) reject("degree", "must be 0 to 3");
  if (f.count_u < f.degree + 1 || f.count_v < f.degree + 1)
    reject("values", "must have at least degree + 1 = " + std::to_string(f.degree + 1) + " entries in each direction");
  if (f.values.size() != static_cast<std::size_t>(f.count_u) * f.count_v)
    reject("values", "must be a full rectangle of count_u x count_v numbers");
  for (double v : f.values)
    if (!std::isfinite(v)) reject("values", "must be finite");
}

double fieldAt(const PatchField& f, Vec2 st) {
  const double s = std::clamp(st.x, 0.0, 1.0), t = std::clamp(st.y, 0.0, 1.0);
  return splineAlong(f.degree, f.count_v, t, [&](int j) {
    return splineAlong(f.degree, f.count_u, s, [&](int i) { return f.values[i + f.count_u * j]; });
  });
}

Fabric fabricAt(const Garment& g, int patch, Vec2 uv) {
  const PatchFields* fields = fieldsOf(g, patch);
  if (!fields) return g.fabric;
  const Vec2 st = fraction(g.patches[patch], uv);
  Fabric f = g.fabric;
  if (fields->material) {
    const double m = fieldAt(*fields->material, st);
    const int last = static_cast<int>(g.other_fabrics.size());
    const int k = std::clamp(static_cast<int>(std::floor(m)), 0, last), next = std::min(k + 1, last);
    const auto pick = [&](int i) -> const Fabric& { return i == 0 ? g.fabric : g.other_fabrics[i - 1]; };
    const double w = std::clamp(m - k, 0.0, 1.0);
    f = w == 0 ? pick(k) : mixture(pick(k), pick(next), w);
  }
  if (fields->thickness) {
    const double factor = fieldAt(*fields->thickness, st);
    f.thickness_m *= factor;
    std::visit([&](auto& law) { law.thicken(factor); }, f.law);
  }
  return f;
}

double surfaceDensityAt(const Garment& g, int patch, Vec2 uv) { return fabricAt(g, patch, uv).surfaceDensity(); }

double fibreAngleAt(const Garment& g, int patch, Vec2 uv) {
  const PatchFields* fields = fieldsOf(g, patch);
  return fields && fields->fibre_angle ? fieldAt(*fields->fibre_angle, fraction(g.patches[patch], uv)) : 0;
}

bool fabricVaries(const Garment& g, int patch) {
  const PatchFields* fields = fieldsOf(g, patch);
  return fields && (fields->thickness || fields->material);
}

std::optional<int> fabricOfPatch(const Garment& g, int patch) {
  if (!fabricVaries(g, patch)) return 0;
  const PatchFields& fields = *fieldsOf(g, patch);
  if (fields.thickness) return std::nullopt;
  const std::vector<double>& values = fields.material->values;
  const double first = values.front();
  if (first != std::floor(first) || std::any_of(values.begin(), values.end(), [&](double v) { return v != first; }))
    return std::nullopt;
  return static_cast<int>(first);
}

void validateFields(const Garment& g) {
  if (g.fields.empty()) return;
  if (g.fields.size() != g.patches.size()) throw InputError({"", 0, "fields"}, "one entry for each patch is needed");
  for (std::size_t p = 0; p < g.fields.size(); ++p) {
    const std::string at = "fields[" + std::to_string(p) + "].";
    const auto check = [&](const char* name, const std::optional<PatchField>& field) {
      if (!field) return;
      try {
        validate(*field);
      } catch (const InputError& e) {
        throw InputError({"", 0, at + name + "." + e.where().key}, e.reason());
      }
    };
    const PatchFields& f = g.fields[p];
    check("thickness", f.thickness);
    check("fibre_angle", f.fibre_angle);
    check("material", f.material);
    // A B-spline lies within the range of its coefficients.
    if (f.thickness)
      for (double v : f.thickness->values)
        if (!(v > 0)) throw InputError({"", 0, at + "thickness.values"}, "must be > 0");
    if (f.material) {
      const double last = static_cast<double>(g.other_fabrics.size());
      for (double v : f.material->values)
        if (!(v >= 0 && v <= last))
          throw InputError(
              {"", 0, at + "material.values"},
              "must be between 0 and " + std::to_string(g.other_fabrics.size()) + ", the number of other materials");
    }
    checkPointEnergies(g, static_cast<int>(p), at);
    if (f.material) {
      // What a point remembers lies in one order in all of a block.
      const LawUse use = lawUse(g.fabric);
      for (const Fabric& other : g.other_fabrics)
        if (const LawUse more = lawUse(other);
            (use.shears || more.shears) && (use.shears != more.shears || use.historySize() != more.historySize()))
          throw InputError({"", 0, at + "material"},
                           "fabrics with friction in shear stand beside others only with the same laws");
      const bool whole = f.material->degree == 0 && std::all_of(f.material->values.begin(), f.material->values.end(),
                                                                [](double v) { return v == std::floor(v); });
      if (whole) continue;
      const auto [low, high] = std::minmax_element(f.material->values.begin(), f.material->values.end());
      const int first_used = static_cast<int>(std::floor(*low)), last_used = static_cast<int>(std::ceil(*high));
      const auto pick = [&](int k) -> const Fabric& { return k == 0 ? g.fabric : g.other_fabrics[k - 1]; };
      for (int k = first_used; k <= last_used; ++k) {
        if (pick(k).laminate())
          throw InputError({"", 0, at + "material"}, "laminates cannot be mixed: use degree 0 and whole numbers");
        if (pick(k).law.index() != pick(first_used).law.index() ||
            pick(k).tension_field != pick(first_used).tension_field)
          throw InputError({"", 0, at + "material"}, "only fabrics with the same laws can be mixed");
      }
    }
  }
}

}  // namespace gambeson
