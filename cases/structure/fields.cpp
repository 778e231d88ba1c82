#include "cases/structure/fields.hpp"

#include <fmt/format.h>

#include "cases/cloth/fields.hpp"
#include "cases/contact/fields.hpp"
#include "cases/input/table.hpp"

namespace gambeson::schema {
namespace {

/// Rows [at, value], at ascending.
NamedProgram readProgram(const Entry& p) {
  NamedProgram program;
  program.name = p.node.key;
  if (p.node.type != JsonNode::Type::list || p.node.children.empty())
    p.fail("expected a list of pairs [at, value], not " + describe(p.node));
  for (std::size_t i = 0; i < p.node.children.size(); ++i) {
    const Vec2 pair = readPair(p.item(i), "", between(-1e12, 1e12));
    if (i > 0 && !(pair.x > program.at.back()))
      p.item(i).fail(fmt::format("{} does not come after {}; allowed: ascending", pair.x, program.at.back()));
    program.at.push_back(pair.x);
    program.value.push_back(pair.y);
  }
  return program;
}

Field programsField() {
  Field f;
  f.key = "programs";
  f.kind = Kind::map;
  f.range = any();
  f.default_note = "none";
  f.doc =
      "factors that loads and motions follow, by name: pairs [at, value] over the load factor (static) or the time in "
      "seconds (dynamic), linear between them, constant beyond";
  return f;
}

void readPrograms(const Entry& p, StructureCase& c) {
  if (p.node.type != JsonNode::Type::object)
    p.fail("expected an object { } of programs, such as {\"ramp\": [[0, 0], [1, 1]]}, not " + describe(p.node));
  for (const JsonNode& child : p.node.children) {
    if (child.key.empty()) p.member(child).fail("a program needs a name");
    c.programs.push_back(readProgram(p.member(child)));
  }
}

std::optional<JsonNode> writePrograms(const StructureCase& c) {
  JsonNode n;
  n.type = JsonNode::Type::object;
  for (const NamedProgram& program : c.programs) {
    JsonNode rows = emptyList();
    for (std::size_t i = 0; i < program.at.size(); ++i)
      rows.children.push_back(nodeOfList({program.at[i], program.value[i]}));
    rows.key = program.name;
    n.children.push_back(std::move(rows));
  }
  return n;
}

Object initialTable() {
  using I = InitialCase;
  return Table<I>("Initial state")
      .object("noise", &I::noise, noiseTable(), "displacement along the normal that the motion starts from")
      .defaultsTo("none")
      .vector("velocity", &I::velocity_m_per_s, "m/s", between(-1e9, 1e9), "of all that is not held")
      .build();
}

/// A solver's own table, read into the whole case.
Object solverTable(StructureKind kind) {
  return kind == StructureKind::statics    ? staticSolverTable()
         : kind == StructureKind::dynamics ? dynamicSolverTable()
                                           : modalSolverTable();
}

const char* aboutOf(StructureKind kind) {
  switch (kind) {
    case StructureKind::statics:
      return "equilibrium of a sheet with supports and loads, followed while the loads grow";
    case StructureKind::dynamics:
      return "motion of a sheet with supports and loads in time, by implicit or explicit integration";
    default:
      return "natural frequencies and modes of a sheet with supports";
  }
}

Object makeTable(StructureKind kind, const std::string& word) {
  using C = StructureCase;
  const auto self = [](auto& c) -> auto& { return c; };
  Field kind_field;
  kind_field.key = "kind";
  kind_field.kind = Kind::choice;
  kind_field.choices = {word};
  kind_field.required = true;
  kind_field.doc = "what the case is";
  Table<C> table("Case of kind " + word, aboutOf(kind));
  table
      .custom(
          kind_field,
          [kind, word](const Entry& p, C& c) {
            readChoice(p, {word});
            c.kind = kind;
          },
          [word](const C&) { return std::optional(nodeOf(word)); })
      .text("name", &C::name, "title of the pictures and the report")
      .required()
      .text("description", &C::description, "what the case is about")
      .object("sheet", &C::sheet, structureSheetTable(), "the shape at rest and how finely it is computed")
      .required()
      .object("material", &C::material, materialTable(), "what it is made of")
      .required()
      .list("other_materials", &C::other_materials, materialTable(), "what a material field chooses from")
      .list("supports", &C::supports, structureSupportTable(), "what is held, and what is moved")
      .list("loads", &C::loads, structureLoadTable(), "what pulls and pushes")
      .custom(programsField(), readPrograms, writePrograms)
      .object("solver", self, solverTable(kind), "how it is solved");
  if (kind == StructureKind::dynamics)
    table.required()
        .object("strain_limit", &C::strain_limit, strainLimitTable(),
                "keeps weft and warp from stretching by projection (Zheng 2013, chapter 5), "
                "so that the material may be given soft threads, and with them long time steps; explicit "
                "scheme only")
        .defaultsTo("none: the material's own stiffness")
        .list("obstacles", &C::obstacles, obstacleTable(), "what the sheet touches; explicit scheme only")
        .object("contact", &C::contact, contactTable(),
                "how the sheet touches obstacles and itself; explicit scheme only")
        .defaultsTo("required with obstacles; without it the sheet passes through itself")
        .object("initial", &C::initial, initialTable(), "how the motion starts; at rest where absent");
  return table.object("output", &C::output, structureOutputTable(kind), "what is written and pictured").build();
}

}  // namespace

const std::vector<std::pair<std::string, StructureKind>>& structureKinds() {
  static const std::vector<std::pair<std::string, StructureKind>> kinds{
      {"static", StructureKind::statics}, {"dynamic", StructureKind::dynamics}, {"modal", StructureKind::modal}};
  return kinds;
}

const Object& structureTable(StructureKind kind) {
  static const std::vector<Object> tables = [] {
    std::vector<Object> all;
    for (const auto& [word, k] : structureKinds()) all.push_back(makeTable(k, word));
    return all;
  }();
  return tables[static_cast<std::size_t>(kind)];
}

}  // namespace gambeson::schema
