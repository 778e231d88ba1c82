/// Lists of examples: the field table of tests/verify/examples/<id>.json, and what it names.

#include "cases/verify/examples.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "cases/input/table.hpp"
#include "core/error.hpp"

namespace gambeson::verify {
namespace {

using schema::Entry;
using schema::Field;
using schema::Kind;

template <class T>
using Fields = schema::Table<T>;

schema::Object recordedTable() {
  using R = Statement::Recorded;
  return Fields<R>("Number of an earlier run")
      .number("value", &R::value, "", schema::any(), "what the check measured")
      .required()
      .text("date", &R::date, "when: 2026-11-22")
      .required()
      .build();
}

schema::Object statementTable() {
  using S = Statement;
  return Fields<S>("Statement")
      .text("where", &S::where, "table, figure or text that it stands in")
      .required()
      .text("published", &S::published, "what the work has there")
      .required()
      .text("reference", &S::reference, "id of the reference whose check stands beside it")
      .text("quantity", &S::quantity, "the check's quantity")
      .text("without", &S::without, "why no check stands beside it")
      .object("recorded", &S::recorded, recordedTable(), "number of a reference that runs only by name")
      .check([](const Entry& p, const S& s) {
        if (s.reference.empty() == s.without.empty()) p.fail("needs one of reference and without");
        if (s.reference.empty() != s.quantity.empty()) p.fail("reference and quantity go together");
        if (s.recorded && s.reference.empty()) p.failAt("recorded", "goes with reference");
      })
      .build();
}

schema::Object exampleTable() {
  using E = Example;
  Field cases;
  cases.key = "cases";
  cases.kind = Kind::text_list;
  cases.doc = "case files that run it";
  return Fields<E>("Example")
      .text("section", &E::section, "number of the section")
      .required()
      .text("title", &E::title, "what it is")
      .required()
      .texts("figures", &E::figures, "numbers of its figures")
      .texts("tables", &E::tables, "numbers of its tables")
      .custom(
          cases,
          [](const Entry& p, E& e) {
            if (p.node.type != JsonNode::Type::list) p.fail("expected a list [ ] of case files");
            for (std::size_t i = 0; i < p.node.children.size(); ++i) e.cases.push_back(schema::readPath(p.item(i)));
          },
          [](const auto&) -> std::optional<JsonNode> { return std::nullopt; })
      .text("doc", &E::doc, "what ours differs in, and why")
      .list("statements", &E::statements, statementTable(), "what it states")
      .required()
      .check([](const Entry& p, const E& e) {
        if (e.statements.empty()) p.failAt("statements", "must not be empty");
      })
      .build();
}

schema::Object workTable() {
  using W = Work;
  return Fields<W>("Work")
      .text("id", &W::id, "name of the file without .json")
      .required()
      .text("title", &W::title, "heading of the page")
      .required()
      .text("source", &W::source, "the work")
      .required()
      .text("doc", &W::doc, "what the page holds")
      .list("examples", &W::examples, exampleTable(), "its examples")
      .required()
      .check([](const Entry& p, const W& w) {
        if (w.id != std::filesystem::path(p.file).stem().string())
          p.failAt("id", fmt::format("\"{}\" is not the name of the file", w.id));
        std::set<std::string> sections;
        for (std::size_t i = 0; i < w.examples.size(); ++i)
          if (!sections.insert(w.examples[i].section).second)
            p.member(*p.node.find("examples"))
                .item(i)
                .failAt("section", fmt::format("\"{}\" stands there twice", w.examples[i].section));
      })
      .build();
}

/// Every reference and check that a statement names is there, once.
void checkNames(const Entry& root, const Work& work) {
  const std::filesystem::path dir = work.file.parent_path().parent_path();
  std::map<std::string, Reference> references;
  const Entry examples = root.member(*root.node.find("examples"));
  for (std::size_t i = 0; i < work.examples.size(); ++i) {
    const Entry example = examples.item(i), list = example.member(*example.node.find("statements"));
    for (std::size_t k = 0; k < work.examples[i].statements.size(); ++k) {
      const Statement& s = work.examples[i].statements[k];
      if (s.reference.empty()) continue;
      const Entry entry = list.item(k);
      const std::filesystem::path file = dir / (s.reference + ".json");
      if (!references.contains(s.reference)) {
        if (!std::filesystem::exists(file))
          entry.failAt("reference", fmt::format("there is no reference {}", file.string()));
        references.emplace(s.reference, readReference(file));
      }
      const Reference& r = references.at(s.reference);
      const auto n =
          std::count_if(r.checks.begin(), r.checks.end(), [&](const Check& c) { return c.quantity == s.quantity; });
      if (n != 1)
        entry.failAt("quantity",
                     fmt::format("{} has {} checks of \"{}\"", s.reference, n == 0 ? "no" : "several", s.quantity));
      if (s.recorded && !r.on_demand)
        entry.failAt("recorded", fmt::format("is for references that run only by name; {} always runs", s.reference));
    }
  }
}

}  // namespace

Work readWork(const std::filesystem::path& file) {
  const JsonNode node = readJson(file);
  const std::string name = file.string();
  const Entry root{node, "", name};
  Work work;
  schema::readObject(workTable(), root, &work);
  work.file = file;
  checkNames(root, work);
  return work;
}

std::vector<Work> readWorks(const std::filesystem::path& dir) {
  std::error_code none;
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(dir / "examples", none))
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<Work> works;
  for (const auto& file : files) works.push_back(readWork(file));
  return works;
}

std::vector<std::string> referencesOf(const Work& work) {
  std::vector<std::string> ids;
  for (const Example& e : work.examples)
    for (const Statement& s : e.statements)
      if (!s.reference.empty() && std::find(ids.begin(), ids.end(), s.reference) == ids.end())
        ids.push_back(s.reference);
  return ids;
}

}  // namespace gambeson::verify
