#include "cases/yarns/cell_file.hpp"

#include "cases/input/table.hpp"
#include "cases/input/wrong_entry.hpp"
#include "cases/yarns/design.hpp"
#include "cases/yarns/design_rows.hpp"
#include "cases/yarns/rules.hpp"
#include "core/error.hpp"

namespace gambeson::schema {
namespace {

struct CellFileInput : CellDesign {
  std::string name;
};

Object makeTable() {
  using C = CellFileInput;
  Table<C> table("Yarns of a cell");
  const auto unread = [&](const char* key) {
    table.custom(
        fieldOf(key, Kind::any, "", any(), "not of its yarns"), [](const Entry&, C&) {},
        [](const C&) { return std::optional<JsonNode>(); });
  };
  table.custom(
      fieldOf("kind", Kind::choice, "", any(), "of the case"), [](const Entry& p, C&) { readChoice(p, {"cell"}); },
      [](const C&) { return std::optional<JsonNode>(); });
  table.text("name", &C::name, "of the case");
  addDesign(table);
  addSolver(table);
  for (const char* key : {"description", "loads", "bars", "solids", "output"}) unread(key);
  table.custom(
      fieldOf("friction", Kind::any, "", any(), "refused"),
      [](const Entry& p, C&) {
        p.fail("an energy has none, which a fabric's law is; allowed with law.cell: no friction");
      },
      [](const C&) { return std::optional<JsonNode>(); });
  table.custom(
      fieldOf("extent", Kind::any, "", any(), "of a cell that bends"),
      [](const Entry& p, C&) { readChoice(p, {"full"}); }, [](const C&) { return std::optional<JsonNode>(); });
  return table.build();
}

const Object& cellFileTable() {
  static const Object table = makeTable();
  return table;
}

}  // namespace

CellFile readCellFile(const Entry& entry) {
  // Of a case of another kind no key is known.
  if (const JsonNode* kind = entry.node.find("kind")) readChoice(entry.member(*kind), {"cell"});
  CellFileInput in;
  readObject(cellFileTable(), entry, &in);
  if (!entry.recorded) applyDesignRules(entry, in);
  return {in.name, in};
}

JsonNode nodeOf(const CellFile& cell) {
  CellFileInput in;
  static_cast<CellDesign&>(in) = cell.design;
  in.name = cell.name;
  return writeObject(cellFileTable(), &in);
}

std::shared_ptr<const CellEnergy> energyOf(const Entry& entry, const CellFile& cell) {
  if (cell.design.yarns != YarnModel::rod)
    entry.failAt("yarns", "is not solved at every point of a cloth; allowed where a fabric's law is a cell: rod");
  try {
    return std::make_shared<const CellEnergy>(rodDesign(cell.design), equilibriumOptions(cell.design.solver));
  } catch (const InputError& e) {
    sayAt(entry, e);
  } catch (const RunError& e) {
    entry.fail(std::string("no cloth can be made of this cell: at rest ") + e.what());
  }
}

}  // namespace gambeson::schema
