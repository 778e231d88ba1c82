/// Detail of fields.hpp: the table of `regions` of garments.

#include <fmt/format.h>

#include <cmath>

#include "cases/cloth/fields.hpp"
#include "cases/cloth/regions.hpp"
#include "cases/input/table.hpp"

namespace gambeson::schema {
namespace {

void addRange(Table<RegionRectangle>& table, const char* key, std::array<double, 2> RegionRectangle::*range,
              const std::string& doc) {
  Field field = fieldOf(key, Kind::numbers, "", between(0, 1), doc);
  field.default_note = "[0, 1]: all of it";
  table.custom(
      field,
      [range, allowed = field.range](const Entry& p, RegionRectangle& part) {
        const std::vector<double> both = readNumbers(p, "", allowed);
        if (both.size() != 2) p.fail(fmt::format("has {} numbers; allowed: 2, from and to", both.size()));
        for (std::size_t k = 0; k < 2; ++k)
          if (!(std::abs(100 * both[k] - std::round(100 * both[k])) < 1e-9))
            p.item(k).fail(fmt::format("{} is no hundredth; allowed: 0, 0.01, .. 1", both[k]));
        if (!(both[0] < both[1])) p.fail(fmt::format("[{}, {}] is empty; allowed: from below to", both[0], both[1]));
        part.*range = {both[0], both[1]};
      },
      [range](const RegionRectangle& part) {
        return std::optional(nodeOfList({(part.*range)[0], (part.*range)[1]}));
      });
}

Object partTable() {
  Table<RegionRectangle> table("Part of a region");
  table.text("patch", &RegionRectangle::patch, "its name as tables call it (\"trunk_left\")")
      .defaultsTo("every patch of the garment");
  addRange(
      table, "u", &RegionRectangle::u,
      "from and to, in hundredths of the patch's u (of shorts around the body, of their left half from front to back, "
      "of the right from back to front); a border within a cell is as sharp as the cell");
  addRange(table, "v", &RegionRectangle::v, "the same along v (of drafted garments upwards)");
  return table.build();
}

}  // namespace

Object regionsTable() {
  return Table<RegionCase>("Region of a garment")
      .text("name", &RegionCase::name, "what studies and tables call it; no two of a case alike")
      .required()
      .list("parts", &RegionCase::parts, partTable(), "rectangles of patches; no two share cloth")
      .defaultsTo("all of the garment")
      .number("thickness", &RegionCase::thickness, "", aboveTo(0, 100),
              "factor on the fabric's thickness: mass and membrane stiffness follow it in proportion, bending with its "
              "cube, springs along seams not; contact keeps the local thickness unless contact.layer is given")
      .build();
}

}  // namespace gambeson::schema
