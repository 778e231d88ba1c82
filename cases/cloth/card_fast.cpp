/// Detail of card_fields.hpp: a sheet of FAST, and what it says in the terms of the other tests.

#include <cmath>

#include "cases/cloth/card_fields.hpp"
#include "cases/cloth/card_terms.hpp"

namespace gambeson::schema {
namespace {

constexpr double kAgree = 0.03;
constexpr const char* kExtensions[3] = {"E5", "E20", "E100"};

void takeTension(const Entry& p, const Entry& sheet, FabricCard& c) {
  const auto& E = c.fast->extension;
  if (!E[0].any() && !E[1].any() && !E[2].any()) return;
  if (c.tensile) p.failAt("tensile", "is said by E100 of FAST too; give one of them");
  for (std::size_t k = 0; k < 3; ++k)
    if (!E[k].any()) sheet.failAt(kExtensions[k], "is required beside the other extensions: E5, E20 and E100");
  CardTensile t;
  const bool apart = E[0].apart() || E[1].apart() || E[2].apart();
  for (int i = 0; i < 2; ++i) {
    std::vector<TensilePoint> points;
    for (std::size_t k = 0; k < 3; ++k) {
      if (!points.empty() && !(E[k].of(i) > points.back()[0]))
        sheet.failAt(E[k].both ? kExtensions[k] : fmt::format("{}_{}", kExtensions[k], i == 0 ? "weft" : "warp"),
                     fmt::format("contradicts {}: {:.4g} % under a greater load must be more than {:.4g} %",
                                 kExtensions[k - 1], 100 * E[k].of(i), 100 * points.back()[0]));
      points.push_back({E[k].of(i), lab::kFastLoads_N_per_m[k]});
    }
    (!apart ? t.curves.both : i == 0 ? t.curves.weft : t.curves.warp) = std::move(points);
  }
  c.tensile = std::move(t);
}

void takeShear(const Entry& p, const Entry& sheet, FabricCard& c) {
  const CardFast& f = *c.fast;
  if (!f.bias && !f.shear_N_per_m) return;
  if (c.shear) p.failAt("shear", "is said by EB5 or G of FAST too; give one of them");
  const double G = f.bias ? lab::shearOfBias(*f.bias) : *f.shear_N_per_m;
  if (f.shear_N_per_m && !(std::abs(*f.shear_N_per_m / G - 1) <= kAgree))
    sheet.failAt("G", fmt::format("contradicts EB5: 123/EB5 is {:.4g} N/m, not {:.4g}; leave out what is wrong", G,
                                  *f.shear_N_per_m));
  c.shear.emplace();
  c.shear->rigidity.both = G;
}

void takeBending(const Entry& p, const Entry& sheet, FabricCard& c) {
  const CardFast& f = *c.fast;
  if (!f.length_m.any() && !f.rigidity.any()) return;
  if (p.node.find("bending")) p.failAt("bending", "is said by C or B of FAST too; give one of them");
  if (f.length_m.any() && !c.weight_kg_per_m2) p.failAt("W", "is required where FAST has C: B = W g C^3");
  if (!f.length_m.any()) {
    c.bending.rigidity = f.rigidity;
    return;
  }
  c.bending.length_m = f.length_m;
  for (int i = 0; i < 2 && f.rigidity.any(); ++i)
    if (const double B = lab::rigidityOfLength(f.length_m.of(i), *c.weight_kg_per_m2);
        !(std::abs(f.rigidity.of(i) / B - 1) <= kAgree))
      sheet.failAt(f.rigidity.both ? "B"
                   : i == 0        ? "B_weft"
                                   : "B_warp",
                   fmt::format("contradicts C and W: W g C^3 is {:.4g} N m, not {:.4g}; leave out what is wrong", B,
                               f.rigidity.of(i)));
}

}  // namespace

Object fastTable() {
  using F = CardFast;
  Table<F> table("FAST of a card");
  for (std::size_t k = 0; k < 3; ++k) {
    const auto of = [k](std::optional<double> CardNumber::*which) {
      return [=](auto& t) -> auto& { return t.extension[k].*which; };
    };
    const std::string key = kExtensions[k];
    labNumber(table, key, of(&CardNumber::both), "", "2.1 %", between(1e-5, 0.5),
              fmt::format("extension under {} gf/cm, a part or in %", key.substr(1)), "none");
    labNumber(table, key + "_weft", of(&CardNumber::weft), "", "2.1 %", between(1e-5, 0.5),
              "the same along the weft (2)", key);
    labNumber(table, key + "_warp", of(&CardNumber::warp), "", "2.1 %", between(1e-5, 0.5),
              "the same along the warp (1)", key);
  }
  labNumber(table, "EB5", &F::bias, "", "3 %", between(1e-4, 0.5),
            "extension along the bias under 5 gf/cm: G = 5 gf/cm/(4 EB5), printed as 123/EB5", "none");
  labNumber(table, "G", &F::shear_N_per_m, "N/m", "41 N/m", between(1e-2, 1e6), "shear rigidity, of EB5", "of EB5");
  byDirection(table, "C", &F::length_m, "m", "18 mm", between(1e-4, 1),
              "bending length of FAST-2 (C2 along the weft, C1 along the warp): B = W g C^3", "none");
  byDirection(table, "B", &F::rigidity, "N m", "11 uN m", aboveTo(0, 1), "bending rigidity, of C and the weight",
              "of C");
  labNumber(table, "ST", &F::surface_thickness_m, "m", "0.1 mm", between(0, 0.05),
            "surface thickness, T2 - T100; for the record", "none");
  table.check([](const Entry& p, const F& f) {
    for (std::size_t k = 0; k < 3; ++k) checkDirections(p, kExtensions[k], f.extension[k]);
    checkDirections(p, "C", f.length_m);
    checkDirections(p, "B", f.rigidity);
  });
  return table.build();
}

void takeFast(const Entry& p, FabricCard& c) {
  const Entry sheet = p.member(*p.node.find("FAST"));
  takeTension(p, sheet, c);
  takeShear(p, sheet, c);
  takeBending(p, sheet, c);
}

}  // namespace gambeson::schema
