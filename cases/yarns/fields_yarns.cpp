/// Detail of fields.hpp: the tables of the weave and of its yarns.

#include <fmt/format.h>

#include "cases/input/table.hpp"
#include "cases/yarns/fields.hpp"

namespace gambeson::schema {
namespace {

constexpr int kMostYarns = 64;  ///< of a repeat, either way

const std::vector<std::pair<std::string, WeavePattern>>& patterns() {
  static const std::vector<std::pair<std::string, WeavePattern>> words{{"plain", WeavePattern::plain},
                                                                       {"twill", WeavePattern::twill},
                                                                       {"satin", WeavePattern::satin},
                                                                       {"matrix", WeavePattern::matrix}};
  return words;
}

std::string wordOf(WeavePattern pattern) {
  for (const auto& [word, p] : patterns())
    if (p == pattern) return word;
  return "";
}

void readMatrix(const Entry& p, WeaveCase& w) {
  if (p.node.type != JsonNode::Type::list || p.node.children.empty() || p.node.children.size() > kMostYarns)
    p.fail(
        fmt::format("expected a list of 1 to {} rows, such as [[1, 0], [0, 1]], not {}", kMostYarns, describe(p.node)));
  w.matrix.clear();
  for (std::size_t j = 0; j < p.node.children.size(); ++j) {
    const Entry row = p.item(j);
    if (row.node.type != JsonNode::Type::list || row.node.children.empty() || row.node.children.size() > kMostYarns)
      row.fail(fmt::format("expected a list of 1 to {} crossings, 0 (weft over) or 1 (warp over), not {}", kMostYarns,
                           describe(row.node)));
    w.matrix.emplace_back();
    for (std::size_t i = 0; i < row.node.children.size(); ++i)
      w.matrix.back().push_back(readInteger(row.item(i), between(0, 1)));
  }
}

std::optional<JsonNode> writeMatrix(const WeaveCase& w) {
  if (w.matrix.empty()) return std::nullopt;
  JsonNode rows = emptyList();
  for (const std::vector<int>& row : w.matrix) {
    JsonNode list = emptyList();
    for (const int over : row) list.children.push_back(nodeOf(static_cast<double>(over)));
    rows.children.push_back(std::move(list));
  }
  return rows;
}

/// Keys that belong to another pattern, and those that this one needs.
void checkPattern(const Entry& p, WeaveCase& w) {
  for (const auto& [key, pattern] : {std::pair("over", WeavePattern::twill), std::pair("under", WeavePattern::twill),
                                     std::pair("ends", WeavePattern::satin), std::pair("step", WeavePattern::satin),
                                     std::pair("matrix", WeavePattern::matrix)}) {
    if (w.pattern != pattern && p.node.find(key))
      p.failAt(key, fmt::format("goes with pattern {}; this is {}", wordOf(pattern), wordOf(w.pattern)));
    if (w.pattern == pattern && !p.node.find(key)) p.failAt(key, fmt::format("is required of a {}", wordOf(pattern)));
  }
  if (w.pattern == WeavePattern::twill && *w.over + *w.under > kMostYarns)
    p.failAt("over", fmt::format("{} over and {} under are too many; allowed: at most {} together", *w.over, *w.under,
                                 kMostYarns));
}

Object moduliTable() {
  using M = YarnModuli;
  const Range modulus = aboveTo(0, 1e18);
  return Table<M>("Moduli of a yarn")
      .number("young", &M::young_Pa, "Pa", modulus, "Young's modulus along the yarn")
      .required()
      .number("axial_shear", &M::shear_Pa, "Pa", modulus,
              "shear modulus of fibres along each other; some hundredth of young in a yarn, which lets crimp go by "
              "shear rather than by bending")
      .required()
      .number("transverse_young", &M::transverse_young_Pa, "Pa", modulus, "solids: Young's modulus across the yarn")
      .defaultsTo("required with yarns solid")
      .number("poisson_axial", &M::poisson_axial, "", any(),
              "solids: contraction across the yarn, of its extension; its square below young/transverse_young (1 - "
              "poisson_transverse)/2")
      .defaultsTo("required with yarns solid")
      .number("poisson_transverse", &M::poisson_transverse, "", any(),
              "solids: contraction across by extension across, between -1 and 1")
      .defaultsTo("poisson_axial, as Bonet and Burton have it")
      .build();
}

Object isotropicTable() {
  using I = IsotropicYarn;
  return Table<I>("Moduli of an isotropic yarn")
      .number("young", &I::young_Pa, "Pa", aboveTo(0, 1e18), "Young's modulus")
      .required()
      .number("poisson", &I::poisson, "", any(), "Poisson's ratio, between -1 and 0.5")
      .required()
      .check([](const Entry& p, const I& i) {
        if (!(i.poisson > -1 && i.poisson < 0.5))
          p.failAt("poisson", fmt::format("{:g} is out of range; allowed: > -1 and < 0.5", i.poisson));
      })
      .build();
}

Object sectionTable() {
  using S = RodSection;
  const Range stiff = aboveTo(0, 1e18);
  return Table<S>("Stiffness of a yarn's section")
      .number("stretch", &S::stretch_N, "N", stiff, "EA")
      .required()
      .number("shear_across", &S::shear_across_N, "N", stiff, "k GA, of the force across the yarn in the cloth")
      .required()
      .number("shear_through", &S::shear_through_N, "N", stiff, "k GA, of the force through the cloth")
      .required()
      .number("torsion", &S::torsion_Nm2, "N m^2", between(0, 1e18), "GJ")
      .required()
      .number("bending_through", &S::bending_through_Nm2, "N m^2", stiff, "EI, of curves that leave the cloth (crimp)")
      .required()
      .number("bending_in_plane", &S::bending_in_plane_Nm2, "N m^2", stiff, "EI, of curves in the cloth")
      .required()
      .build();
}

}  // namespace

Object weaveTable() {
  using W = WeaveCase;
  return Table<W>("Weave")
      .choice("pattern", &W::pattern, patterns(),
              "plain: over one, under one; twill: each warp yarn over some weft yarns and under some, shifted by one "
              "from weft to weft; satin: under one of some, shifted by more; matrix: as drawn")
      .required()
      .integer("over", &W::over, 1, kMostYarns, "twill: weft yarns that a warp yarn goes over")
      .integer("under", &W::under, 1, kMostYarns, "twill: weft yarns that it goes under")
      .integer("ends", &W::ends, 5, kMostYarns, "satin: yarns of the repeat")
      .integer("step", &W::step, 2, kMostYarns, "satin: shift from weft to weft, without a factor in common with ends")
      .custom(fieldOf("matrix", Kind::lists, "", between(0, 1),
                      "rows, one for each weft yarn: 1 where the warp yarn lies over it, 0 where it lies under"),
              readMatrix, writeMatrix)
      .check([](const Entry& p, WeaveCase& w) { checkPattern(p, w); })
      .build();
}

Object yarnTable() {
  using Y = YarnCase;
  const Range length = aboveTo(0, 1e3);
  const auto shape = [](auto member) {
    return [member](auto& y) -> auto& { return y.shape.*member; };
  };
  return Table<Y>("Yarn")
      .number("spacing", shape(&WovenYarn::spacing_m), "m", length,
              "between the middles of neighbouring yarns of this direction")
      .required()
      .number(
          "amplitude", shape(&WovenYarn::amplitude_m), "m", between(0, 1e3),
          "how far the yarn's middle leaves the middle of the cloth: half sine waves between crossings on different "
          "sides; yarns touch at rest where the amplitudes of weft and warp add up to their half thicknesses")
      .required()
      .number("half_width", shape(&WovenYarn::half_width_m), "m", length,
              "half axis of the elliptical section, across the yarn in the cloth; at most half of spacing")
      .required()
      .number("half_thickness", shape(&WovenYarn::half_thickness_m), "m", length,
              "half axis of the section, through the cloth")
      .required()
      .alternative<YarnModuli>("moduli", &Y::stiffness, moduliTable(), "of a massive elliptical section of fibres")
      .in("stiffness")
      .alternative<IsotropicYarn>("isotropic", &Y::stiffness, isotropicTable(),
                                  "of a massive elliptical section that is the same in all directions")
      .in("stiffness")
      .alternative<RodSection>("section", &Y::stiffness, sectionTable(), "stiffness of the section of a rod as a whole")
      .in("stiffness")
      .oneOf("stiffness", true)
      .build();
}

}  // namespace gambeson::schema
