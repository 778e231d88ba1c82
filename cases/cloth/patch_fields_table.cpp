/// Detail of fields.hpp: the table of `fields`, of the sheets of structures and of garments.

#include <fmt/format.h>

#include "cases/cloth/fields.hpp"
#include "cases/cloth/patch_fields.hpp"
#include "cases/input/table.hpp"

namespace gambeson::schema {
namespace {

Object patchFieldTable(const std::string& unit, const Range& range, const std::string& title) {
  using F = PatchField;
  Field values =
      fieldOf("values", Kind::lists, unit, range, "rows along v of values along u; each count at least degree + 1");
  values.required = true;
  return Table<F>(title)
      .integer("degree", &F::degree, 0, 3,
               "between the values: 0 constant by rectangle, 1 bilinear, 2 and 3 smooth (B-spline coefficients)")
      .custom(
          values,
          [unit, range](const Entry& p, F& f) {
            if (p.node.type != JsonNode::Type::list || p.node.children.empty())
              p.fail("expected a list of rows of numbers, not " + describe(p.node));
            f.values.clear();
            f.count_v = static_cast<int>(p.node.children.size());
            for (std::size_t i = 0; i < p.node.children.size(); ++i) {
              const std::vector<double> row = readNumbers(p.item(i), unit, range);
              if (i == 0) f.count_u = static_cast<int>(row.size());
              if (static_cast<int>(row.size()) != f.count_u)
                p.item(i).fail(
                    fmt::format("has {} values, the first row {}; allowed: the same", row.size(), f.count_u));
              f.values.insert(f.values.end(), row.begin(), row.end());
            }
          },
          [](const F& f) {
            JsonNode list = emptyList();
            const std::size_t n = static_cast<std::size_t>(f.count_u);
            for (std::size_t j = 0; j * n + n <= f.values.size(); ++j)
              list.children.push_back(nodeOfList(
                  {f.values.begin() + static_cast<long>(j * n), f.values.begin() + static_cast<long>(j * n + n)}));
            return std::optional(list);
          })
      .check([](const Entry& p, const F& f) {
        if (f.count_u < f.degree + 1 || f.count_v < f.degree + 1)
          p.failAt("values", fmt::format("{} x {} values are too few for degree {}; allowed: at least {} x {}",
                                         f.count_u, f.count_v, f.degree, f.degree + 1, f.degree + 1));
      })
      .build();
}

/// A patch by its number or its name.
Field patchField(FieldsOf of) {
  const bool sheet = of == FieldsOf::sheet;
  Field f = fieldOf("patch", Kind::any, "", between(0, 10000),
                    sheet ? "which patch: its number, or its name in a garment file; pieces of a built shape are "
                            "counted along u, then along v"
                          : "which patch: its number, or its name as tables call it (\"front\")");
  f.default_note = sheet ? "0" : "every patch that no other entry is of";
  return f;
}

}  // namespace

Object fieldsTable(FieldsOf of) {
  using F = FieldsCase;
  const bool sheet = of == FieldsOf::sheet;
  const Field patch = patchField(of);
  const auto thickness = [](auto& f) -> auto& { return f.fields.thickness; };
  const auto angle = [](auto& f) -> auto& { return f.fields.fibre_angle; };
  const auto material = [](auto& f) -> auto& { return f.fields.material; };
  const std::string what = sheet ? "material" : "fabric";
  return Table<F>("Fields over a patch")
      .custom(
          patch,
          [range = patch.range](const Entry& p, F& f) {
            if (p.node.type == JsonNode::Type::text)
              f.name = readText(p);
            else
              f.patch = readInteger(p, range);
          },
          [](const F& f) -> std::optional<JsonNode> {
            if (!f.name.empty()) return nodeOf(f.name);
            return f.patch ? std::optional(nodeOf(static_cast<double>(*f.patch))) : std::nullopt;
          })
      .object("thickness", thickness, patchFieldTable("", aboveTo(0, 100), "Thickness field"),
              fmt::format("thickness as a multiple of the {}'s; mass and membrane stiffness follow it in proportion, "
                          "bending with its cube{}",
                          what, sheet ? "" : ", and contact keeps the local thickness unless contact.layer is given"))
      .defaultsTo("the " + what + "'s")
      .object("fibre_angle", angle, patchFieldTable("rad", between(-7, 7), "Fibre angle field"),
              "turns the weft about the normal")
      .defaultsTo("none")
      .object("material", material, patchFieldTable("", between(0, 1000), "Material field"),
              fmt::format("0: the {0}, k: other_{0}s[k - 1]; between whole numbers the stiffness (in plane stress), "
                          "thickness, density and bending rigidities of the two are mixed linearly",
                          what))
      .defaultsTo(fmt::format("the {} everywhere", what))
      .check([sheet](const Entry&, F& f) {
        if (sheet && f.name.empty() && !f.patch) f.patch = 0;
      })
      .build();
}

}  // namespace gambeson::schema
