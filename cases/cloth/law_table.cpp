#include "cases/cloth/law_table.hpp"

#include <fmt/format.h>

#include <array>
#include <utility>
#include <vector>

#include "cases/input/table.hpp"
#include "cases/input/wrong_entry.hpp"
#include "core/error.hpp"
#include "core/io/own_file.hpp"
#include "core/material/table/law_table.hpp"

namespace gambeson {
namespace schema {
namespace {

/// Lists of numbers as they stand in the file, where those of a node follow each other.
struct GridInput {
  std::vector<double> e11, e22, g12;
};
struct MembraneInput {
  GridInput grid;
  std::vector<double> energy;
};
struct BendingInput {
  GridInput grid;
  std::vector<double> moment, rigidity;
};
struct LawFileInput {
  int version = 1;
  bool even_in_shear = false;
  MembraneInput membrane;
  BendingInput bending;
  LawProvenance provenance;
};

constexpr int kVersion = 1;

template <class T, class Get>
void numbers(Table<T>& table, const std::string& key, Get get, const std::string& unit, const std::string& doc) {
  table.custom(
      fieldOf(key, Kind::numbers, unit, any(), doc),
      [=](const Entry& p, T& t) { std::invoke(get, t) = readNumbers(p, unit, any()); },
      [=](const T& t) -> std::optional<JsonNode> {
        const std::vector<double>& values = std::invoke(get, t);
        return values.empty() ? std::nullopt : std::optional(nodeOfList(values));
      });
}

template <class T>
void nodes(Table<T>& table, const std::string& which) {
  const std::string doc = which + ", ascending";
  numbers(
      table, "e11", [](auto& t) -> auto& { return t.grid.e11; }, "", "nodes in E11 (Green-Lagrange, weft)" + doc);
  table.required();
  numbers(
      table, "e22", [](auto& t) -> auto& { return t.grid.e22; }, "", "nodes in E22 (warp)" + doc);
  table.required();
  numbers(
      table, "g12", [](auto& t) -> auto& { return t.grid.g12; }, "",
      "nodes in 2 E12" + doc + "; from 0 on where the law is even in shear");
  table.required();
}

Object membraneTable() {
  Table<MembraneInput> table("Membrane of a law table");
  nodes(table, "; with the strain 0 in their range, at least three");
  numbers(
      table, "energy", [](auto& t) -> auto& { return t.energy; }, "J/m^2",
      "energy of flat cloth per area at rest, at all nodes: e11 slowest, g12 fastest");
  table.required();
  return table.build();
}

Object bendingTable() {
  Table<BendingInput> table("Bending of a law table");
  nodes(table, "; one node (constant), or the ends of the membrane's");
  numbers(
      table, "moment", [](auto& t) -> auto& { return t.moment; }, "N",
      "b1, b2, b3 at each node: moments without curvature");
  table.defaultsTo("none");
  numbers(
      table, "rigidity", [](auto& t) -> auto& { return t.rigidity; }, "N m",
      "D11, D22, D33, D12, D13, D23 at each node, 3 of the twist 2 k12; positive definite");
  table.required();
  return table.build();
}

Object provenanceTable() {
  using P = LawProvenance;
  const auto part = between(0, 1e3);
  return Table<P>("Provenance of a law table")
      .text("cell", &P::cell, "identity of the cell of yarns that the table stands for")
      .text("cell_name", &P::cell_name, "its name")
      .text("made_by", &P::made_by, "program and version")
      .text("options", &P::options, "of the homogenisation")
      .text("note", &P::note, "source")
      .number("error_energy", &P::error_energy, "", part, "estimated error over the largest energy")
      .defaultsTo("not estimated")
      .number("error_tension", &P::error_tension, "", part, "the same, of n11 and n22")
      .defaultsTo("not estimated")
      .number("error_shear", &P::error_shear, "", part, "the same, of n12")
      .defaultsTo("not estimated")
      .number("error_moment", &P::error_moment, "", part, "the same, of moments")
      .defaultsTo("not estimated")
      .integer("compared_at", &P::compared_at, 0, 1'000'000'000, "points between nodes that the estimates come from")
      .build();
}

/// Units are said so that nobody reads other ones into the numbers.
constexpr std::array<std::pair<const char*, const char*>, 3> kUnits{
    {{"energy", "J/m^2"}, {"moment", "N"}, {"rigidity", "N m"}}};

Field unitsField() {
  Table<std::monostate> table("Units of a law table");
  for (const auto& [key, unit] : kUnits) {
    Field field = fieldOf(key, Kind::choice, "", any(), "unit of these numbers");
    field.choices = {unit};
    field.required = true;
    table.custom(
        field, [unit = std::string(unit)](const Entry& p, std::monostate&) { readChoice(p, {unit}); },
        [unit = std::string(unit)](const std::monostate&) { return std::optional(nodeOf(unit)); });
  }
  Field units = fieldOf("units", Kind::object, "", any(), "units of the numbers; strains have none");
  units.object = std::make_shared<const Object>(table.build());
  units.required = true;
  return units;
}

Object makeLawFileTable() {
  using L = LawFileInput;
  const Field units = unitsField();
  Table<L> table("Law table",
                 "the law of a cloth as a table of its energy over strain: key law.table of a fabric (see "
                 "core/material/table/law_table.hpp)");
  table.integer("version", &L::version, kVersion, kVersion, "of this format")
      .required()
      .custom(
          units,
          [o = units.object](const Entry& p, L&) {
            std::monostate none;
            readObject(*o, p, &none);
          },
          [o = units.object](const L&) {
            const std::monostate none;
            return std::optional(writeObject(*o, &none));
          })
      .flag("even_in_shear", &L::even_in_shear,
            "a mirror that turns weft over leaves the cloth as it is: nodes of g12 stand for both signs, b3, D13 and "
            "D23 change theirs")
      .object("membrane", &L::membrane, membraneTable(), "energy of flat cloth")
      .required()
      .object("bending", &L::bending, bendingTable(), "what is added by curvature k: k . b + k . D . k / 2")
      .required()
      .object("provenance", &L::provenance, provenanceTable(), "what the table was made of");
  return table.build();
}

const Object& inputTable() {
  static const Object table = makeLawFileTable();
  return table;
}

template <std::size_t kParts>
std::vector<std::array<double, kParts>> grouped(const Entry& at, const char* key, const std::vector<double>& values) {
  if (values.size() % kParts != 0)
    at.failAt(key, fmt::format("has {} numbers; allowed: {} for each node", values.size(), kParts));
  std::vector<std::array<double, kParts>> out(values.size() / kParts);
  for (std::size_t k = 0; k < values.size(); ++k) out[k / kParts][k % kParts] = values[k];
  return out;
}

template <std::size_t kParts>
std::vector<double> listed(const std::vector<std::array<double, kParts>>& values) {
  std::vector<double> out;
  for (const auto& at : values) out.insert(out.end(), at.begin(), at.end());
  return out;
}

}  // namespace

LawFile readLawFile(const Entry& root) {
  LawFileInput in;
  readObject(inputTable(), root, &in);
  const Entry bending = root.member(*root.node.find("bending"));
  LawFile law;
  law.provenance = in.provenance;
  law.table.even_in_shear = in.even_in_shear;
  law.table.membrane.nodes = {in.membrane.grid.e11, in.membrane.grid.e22, in.membrane.grid.g12};
  law.table.energy = in.membrane.energy;
  law.table.bending.nodes = {in.bending.grid.e11, in.bending.grid.e22, in.bending.grid.g12};
  law.table.moment = grouped<3>(bending, "moment", in.bending.moment);
  law.table.rigidity = grouped<6>(bending, "rigidity", in.bending.rigidity);
  try {
    LawTable{law.table};
  } catch (const InputError& e) {
    const std::string& key = e.where().key;
    const std::size_t dot = key.find('.');
    root.member(*root.node.find(key.substr(0, dot))).failAt(key.substr(dot + 1), e.reason());
  }
  return law;
}

JsonNode nodeOf(const LawFile& law) {
  const LawTableData& t = law.table;
  LawFileInput in;
  in.even_in_shear = t.even_in_shear;
  in.membrane = {{t.membrane.nodes[0], t.membrane.nodes[1], t.membrane.nodes[2]}, t.energy};
  in.bending = {{t.bending.nodes[0], t.bending.nodes[1], t.bending.nodes[2]}, listed(t.moment), listed(t.rigidity)};
  in.provenance = law.provenance;
  return writeObject(inputTable(), &in);
}

const Object& lawFileTable() { return inputTable(); }

}  // namespace schema

LawFile readLawTable(const std::filesystem::path& file) {
  const JsonNode root = readJson(file);
  const std::string name = file.string();
  return schema::readLawFile({root, "", name});
}

void writeLawTable(const std::filesystem::path& file, const LawFile& law) {
  writeOwnFile(file, schema::toText(schema::nodeOf(law)) + "\n");
}

}  // namespace gambeson
