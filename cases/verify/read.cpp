/// Detail of verify.hpp: reference files: the field table of tests/verify/<id>.json and the rules between its fields.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "cases/input/table.hpp"
#include "cases/verify/verify.hpp"
#include "core/error.hpp"

namespace gambeson::verify {
namespace {

using schema::Entry;
using schema::Field;
using schema::Kind;

template <class T>
using Fields = schema::Table<T>;

Field field(const std::string& key, Kind kind, const std::string& doc, bool required = false) {
  Field f;
  f.key = key;
  f.kind = kind;
  f.doc = doc;
  f.required = required;
  return f;
}

/// Nothing is written back: references are only read.
constexpr auto unwritten = [](const auto&) -> std::optional<JsonNode> { return std::nullopt; };

void expect(const Entry& p, JsonNode::Type type, const char* what) {
  if (p.node.type != type) p.fail(fmt::format("expected {}, not {}", what, describe(p.node)));
}

std::vector<std::string> readTexts(const Entry& p) {
  expect(p, JsonNode::Type::list, "a list [ ] of texts");
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < p.node.children.size(); ++i) texts.push_back(schema::readText(p.item(i)));
  return texts;
}

std::vector<double> readNumbers(const Entry& p) {
  expect(p, JsonNode::Type::list, "a list [ ] of numbers");
  std::vector<double> numbers;
  for (std::size_t i = 0; i < p.node.children.size(); ++i)
    numbers.push_back(schema::readNumber(p.item(i), "", schema::any()));
  return numbers;
}

/// A plain number that may be absent.
template <class T, class Get>
void optionalNumber(Fields<T>& fields, const std::string& key, Get get, const std::string& doc,
                    const schema::Range& range = schema::any()) {
  fields.custom(
      field(key, Kind::number, doc),
      [=](const Entry& p, T& t) { std::invoke(get, t) = schema::readNumber(p, "", range); }, unwritten);
}

template <class T, class Get>
void boolean(Fields<T>& fields, const std::string& key, Get get, const std::string& doc) {
  fields.custom(
      field(key, Kind::choice, doc), [=](const Entry& p, T& t) { std::invoke(get, t) = readBoolean(p); }, unwritten);
}

/// A table is a file of the run's own folder, called by its bare name.
template <class T, class Get>
void tableName(Fields<T>& t, Get get, const std::string& doc) {
  t.custom(
      field("table", Kind::text, doc),
      [get](const Entry& p, T& target) {
        const std::string& name = schema::readText(p);
        if (name.find_first_of("/\\") != std::string::npos || name.starts_with('.'))
          p.fail(describe(p.node) + " is no file of a run's folder; allowed: a name such as path.csv, without folders");
        std::invoke(get, target) = name;
      },
      unwritten);
}

schema::Object quantityTable() {
  using Q = Quantity;
  Fields<Q> t("Quantity");
  t.custom(
      field("run", Kind::text, "the run that it is taken from"),
      [](const Entry& p, Q& q) { q.runs = {schema::readText(p)}; }, unwritten);
  t.custom(
      field("runs", Kind::text_list, "several runs, for instance seeds"),
      [](const Entry& p, Q& q) {
        if (!q.runs.empty()) p.fail("run and runs exclude each other");
        q.runs = readTexts(p);
      },
      unwritten);
  t.choice("reduce", &Q::of,
           std::vector<std::pair<std::string, Q::Of>>{
               {"median", Q::Of::median}, {"mean", Q::Of::mean}, {"least", Q::Of::least}, {"largest", Q::Of::largest}},
           "how the numbers of several runs become one");
  t.text("summary", &Q::summary, "path of a number in summary.json");
  t.text("column", &Q::column, "column of a table");
  tableName(t, &Q::table, "file of the table");
  t.text("along", &Q::along, "column in which `at` is looked up; the first where absent");
  optionalNumber(t, "at", &Q::at, "row to take, between rows linearly; the last where absent");
  t.number("scale", &Q::scale, "", schema::any(), "the number is multiplied by it");
  t.number("offset", &Q::offset, "", schema::any(), "and this is added");
  t.check([](const Entry& p, const Q& q) {
    if (q.summary.empty() == q.column.empty()) p.fail("needs one of summary and column");
    if (!q.summary.empty() && q.at) p.failAt("at", "is for a column of a table");
  });
  return t.build();
}

schema::Object pairTable() {
  return Fields<Pair>("Columns to compare")
      .text("column", &Pair::column, "column of the run's table")
      .required()
      .text("reference", &Pair::reference, "column of the reference's table")
      .number("scale", &Pair::scale, "", schema::any(), "the run's column is multiplied by it")
      .number("offset", &Pair::offset, "", schema::any(), "and this is added")
      .build();
}

schema::Object reportedTable(const std::string& title, const std::string& column) {
  using R = Check::Reported;
  return Fields<R>(title)
      .text("column", &R::column, column)
      .required()
      .number("from", &R::from, "", schema::any(), "first value")
      .required()
      .number("to", &R::to, "", schema::any(), "last value")
      .required()
      .build();
}

schema::Object courseTable() {
  using H = RunCourse;
  Fields<H> t("Course");
  tableName(t, &H::table, "file of the table; its first column is the time");
  return t.text("run", &H::run, "the run that it is taken from")
      .required()
      .texts("columns", &H::columns, "columns of the table")
      .required()
      .choice("join", &H::of,
              std::vector<std::pair<std::string, H::Of>>{
                  {"sum", H::Of::sum},
                  {"mean", H::Of::mean},
                  {"largest", H::Of::largest},
                  {"magnitude", H::Of::magnitude}},
              "how several columns become one course")
      .number("scale", &H::scale, "", schema::any(), "the course is multiplied by it")
      .number("from", &H::from_s, "s", schema::any(), "first time, instead of the check's")
      .number("to", &H::to_s, "s", schema::any(), "last time, instead of the check's")
      .build();
}

const std::vector<std::pair<std::string, Check::Course>>& courses() {
  using C = Check::Course;
  static const std::vector<std::pair<std::string, C>> names{{"correlation", C::correlation},
                                                            {"difference", C::difference},
                                                            {"rank", C::rank},
                                                            {"peak", C::peak},
                                                            {"peak_ratio", C::peak_ratio},
                                                            {"peak_time", C::peak_time},
                                                            {"mean", C::mean},
                                                            {"mean_ratio", C::mean_ratio},
                                                            {"growth", C::growth},
                                                            {"last_ratio", C::last_ratio},
                                                            {"other_at_peak", C::other_at_peak},
                                                            {"greater_share", C::greater_share},
                                                            {"linearity", C::linearity},
                                                            {"half_time", C::half_time}};
  return names;
}

bool ofOne(Check::Course c) {
  using C = Check::Course;
  return c == C::rank || c == C::peak || c == C::mean || c == C::growth || c == C::linearity;
}

struct KindRule {
  std::string name;
  Check::Kind kind;
  std::vector<std::string> needs, allows;
};

const std::vector<KindRule>& kinds() {
  static const std::vector<KindRule> rules{
      {"value",
       Check::Kind::value,
       {"of"},
       {"minus", "over", "period", "reference", "relative", "absolute", "at_least", "at_most", "also"}},
      {"history",
       Check::Kind::course,
       {"course", "first", "from", "to"},
       {"second", "shift", "reference", "relative", "absolute", "at_least", "at_most"}},
      {"curve", Check::Kind::curve, {"run", "x", "y", "bound"}, {"also", "table", "reported"}},
      {"table", Check::Kind::table, {"run", "x", "y", "bound"}, {"also", "table", "reported", "interpolated"}},
      {"rate",
       Check::Kind::rate,
       {"of", "runs", "sizes"},
       {"exact", "power", "reference", "relative", "absolute", "at_least", "at_most"}},
      {"waves",
       Check::Kind::waves,
       {"x", "y"},
       {"run", "runs", "reference_runs", "also", "table", "where", "with", "prominence", "closed", "reference",
        "relative", "absolute", "at_least", "at_most"}},
      {"wrinkles",
       Check::Kind::wrinkles,
       {"run", "x", "y", "height", "measure"},
       {"also", "table", "prominence", "margin", "reference", "relative", "absolute", "at_least", "at_most"}}};
  return rules;
}

void checkGoal(const Entry& p, const Check& c) {
  const bool measured = !c.reference_runs.empty();
  if (measured && c.relative) p.failAt("relative", "reference_runs go with absolute");
  const int goals = static_cast<int>(c.reference.has_value()) + static_cast<int>(measured) + (c.at_least || c.at_most);
  if (goals != 1 && !(goals == 0 && !c.gated))
    p.fail("needs either reference (with relative or absolute), or at_least, or at_most, or gated false");
  if (c.at_least && c.at_most) p.failAt("at_most", "at_least and at_most exclude each other");
  const int tolerances = c.relative.has_value() + c.absolute.has_value();
  if ((c.reference || measured) && tolerances != 1)
    p.fail("a reference needs a tolerance: one of relative and absolute");
  if (!c.reference && !measured && tolerances != 0) p.fail("relative and absolute belong to a reference");
  if (c.relative && *c.reference == 0) p.failAt("relative", "a reference of 0 needs an absolute tolerance");
}

schema::Object checkTable() {
  using C = Check;
  Fields<C> t("Check");
  Field kind = field("kind", Kind::choice, "what is compared", true);
  for (const KindRule& r : kinds()) kind.choices.push_back(r.name);
  t.custom(
      kind, [c = kind.choices](const Entry& p, C& x) { x.kind = kinds()[schema::readChoice(p, c)].kind; }, unwritten);
  t.text("quantity", &C::quantity, "what is measured, in words").required();
  t.text("unit", &C::unit, "unit of the number");
  t.text("note", &C::note, "said on the page beside the result");
  t.text("why", &C::why, "of what is reported only: why; required unless the reference says it for all");
  t.text("item", &C::item, "claim of a list that the check belongs to");
  t.choice("priority", &C::priority,
           std::vector<std::pair<std::string, C::Priority>>{
               {"must", C::Priority::must}, {"should", C::Priority::should}, {"nice", C::Priority::nice}},
           "of the claim: what must hold is gated, the rest is reported");
  boolean(t, "gated", &C::gated, "false: reported, a deviation is no failure");
  t.object("of", &C::of, quantityTable(), "the number");
  t.object("minus", &C::minus, quantityTable(), "subtracted from it");
  t.object("over", &C::over, quantityTable(), "divides it");
  const schema::Range tolerance = schema::above(0);
  optionalNumber(t, "period", &C::period, "the difference is taken to the nearest whole number of these", tolerance);
  t.choice("course", &C::course, courses(), "what is taken of the courses");
  t.object("first", &C::first, courseTable(), "a course in time");
  t.object("second", &C::second, courseTable(), "another");
  t.number("shift", &C::shift_s, "s", schema::any(), "`second` is taken this much later");
  t.number("from", &C::from_s, "s", schema::any(), "first time");
  t.number("to", &C::to_s, "s", schema::any(), "last time");
  optionalNumber(t, "reference", &C::reference, "the published number");
  optionalNumber(t, "relative", &C::relative, "tolerance as a part of the reference", tolerance);
  optionalNumber(t, "absolute", &C::absolute, "tolerance in the unit of the number", tolerance);
  optionalNumber(t, "at_least", &C::at_least, "least number that passes");
  optionalNumber(t, "at_most", &C::at_most, "largest number that passes");
  t.text("run", &C::run, "the run that is gated");
  t.custom(
      field("also", Kind::text_list, "other runs that are reported: coarser meshes"),
      [](const Entry& p, C& c) { c.also = readTexts(p); }, unwritten);
  tableName(t, &C::file, "table of the run");
  t.object("x", &C::x, pairTable(), "abscissa; of a table check: where the rows are compared");
  t.object("y", &C::y, pairTable(), "ordinate; of a table check: what is compared");
  t.number("bound", &C::bound, "", tolerance, "largest deviation, as a part of the reference column's largest value");
  boolean(t, "interpolated", &C::interpolated, "the run's rows are interpolated; else each row must be hit");
  t.object("reported", &C::reported, reportedTable("Rows that are not gated", "column of the reference's table"),
           "rows that are shown and not gated");
  t.custom(
      field("runs", Kind::text_list, "runs from coarse to fine"), [](const Entry& p, C& c) { c.runs = readTexts(p); },
      unwritten);
  t.custom(
      field("reference_runs", Kind::text_list, "runs whose median is the reference"),
      [](const Entry& p, C& c) { c.reference_runs = readTexts(p); }, unwritten);
  t.custom(
      field("sizes", Kind::list, "their mesh sizes or steps"), [](const Entry& p, C& c) { c.sizes = readNumbers(p); },
      unwritten);
  optionalNumber(t, "exact", &C::exact, "the limit; absent: from the last three runs");
  t.number("power", &C::power, "", tolerance, "of the error: 0.5 where the number is an energy and its norm is meant");
  t.number("prominence", &C::prominence, "", schema::between(0, 1),
           "least prominence of a crest, as a part of the range");
  boolean(t, "closed", &C::closed, "count the crests of a closed profile");
  t.object("where", &C::where, reportedTable("Rows to take", "column of the run's table"), "only rows in this range");
  t.object("with", &C::with, pairTable(), "second component: the profile is sqrt(y^2 + with^2)");
  t.object("height", &C::height, pairTable(), "what the wrinkles are of");
  t.choice("measure", &C::measure,
           std::vector<std::pair<std::string, C::Measure>>{{"wavelength", C::Measure::wavelength},
                                                           {"angle", C::Measure::angle}},
           "of wrinkles");
  t.number("margin", &C::margin, "", schema::between(0, 0.45), "part of the sheet's extents left out at both ends");
  t.check([](const Entry& p, const C& c) {
    const auto rule = std::find_if(kinds().begin(), kinds().end(), [&](const KindRule& r) { return r.kind == c.kind; });
    for (const std::string& key : rule->needs)
      if (!p.node.find(key)) p.fail(fmt::format("a check of kind {} needs {}", rule->name, key));
    for (const JsonNode& n : p.node.children) {
      const auto in = [&](const std::vector<std::string>& v) {
        return std::find(v.begin(), v.end(), n.key) != v.end();
      };
      if (!in({"kind", "quantity", "unit", "note", "why", "gated", "item", "priority"}) && !in(rule->needs) &&
          !in(rule->allows))
        p.failAt(n.key, fmt::format("is not for a check of kind {}", rule->name));
    }
    if (c.kind != C::Kind::curve && c.kind != C::Kind::table) checkGoal(p, c);
    if (c.kind == C::Kind::course) {
      if (ofOne(c.course) && c.second) p.failAt("second", "this course is of one run alone");
      if (!ofOne(c.course) && !c.second) p.fail("this course needs second");
      if (!(c.to_s > c.from_s)) p.failAt("to", "must be later than from");
    }
    if (c.priority != C::Priority::none && c.item.empty()) p.failAt("priority", "goes with item");
    if (c.kind == C::Kind::waves && c.run.empty() == c.runs.empty()) p.fail("needs one of run and runs");
    if (c.kind == C::Kind::waves && c.runs.empty() && !c.reference_runs.empty())
      p.failAt("reference_runs", "goes with runs");
    if (c.kind == C::Kind::rate) {
      if (c.runs.size() < (c.exact ? 2u : 3u)) p.failAt("runs", c.exact ? "at least two" : "at least three");
      if (c.sizes.size() != c.runs.size()) p.failAt("sizes", "one for each of runs");
      for (std::size_t i = 0; i < c.sizes.size(); ++i)
        if (!(c.sizes[i] > 0) || (i > 0 && !(c.sizes[i] < c.sizes[i - 1]))) p.failAt("sizes", "must fall, and be > 0");
      const std::size_t n = c.sizes.size();
      if (!c.exact && std::abs(c.sizes[n - 3] * c.sizes[n - 1] / (c.sizes[n - 2] * c.sizes[n - 2]) - 1) > 1e-9)
        p.failAt("sizes", "without an exact value the last three must be in geometric progression");
    }
  });
  return t.build();
}

void readCase(const Entry& p, std::filesystem::path& file, JsonNode& inline_case) {
  if (p.node.type == JsonNode::Type::object)
    inline_case = p.node;
  else
    file = schema::readPath(p);
}

schema::Object runTable() {
  Fields<Run> t("Run");
  t.text("name", &Run::name, "name, unique in the reference").required();
  t.custom(
      field("case", Kind::path, "case file, or the case itself; absent: the reference's case"),
      [](const Entry& p, Run& r) { readCase(p, r.file, r.inline_case); }, unwritten);
  t.custom(
      field("set", Kind::object, "values set in the case: {path: value}"),
      [](const Entry& p, Run& r) {
        expect(p, JsonNode::Type::object, "an object {path: value}");
        for (JsonNode n : p.node.children) {
          const std::string key = std::exchange(n.key, {});
          r.changes.emplace_back(key, schema::toText(n));
        }
      },
      unwritten);
  t.number("time_limit", &Run::limit_s, "s", schema::above(0), "a run that takes longer has failed");
  return t.build();
}

schema::Object numbersTable() {
  using T = ReferenceTable;
  return Fields<T>("Published table")
      .texts("columns", &T::columns, "names of the columns")
      .required()
      .custom(
          field("rows", Kind::list, "the rows", true),
          [](const Entry& p, T& t) {
            expect(p, JsonNode::Type::list, "a list [ ] of rows");
            for (std::size_t i = 0; i < p.node.children.size(); ++i) t.rows.push_back(readNumbers(p.item(i)));
          },
          unwritten)
      .check([](const Entry& p, const T& t) {
        const JsonNode& rows = *p.node.find("rows");
        if (t.rows.empty()) p.failAt("rows", "must not be empty");
        for (std::size_t i = 0; i < t.rows.size(); ++i)
          if (t.rows[i].size() != t.columns.size())
            Entry{rows.children[i], fmt::format("{}.rows[{}]", p.path, i), p.file}.fail(
                fmt::format("{} numbers for {} columns", t.rows[i].size(), t.columns.size()));
      })
      .build();
}

/// Names of runs and columns that checks refer to must be there.
void checkNames(const Entry& p, const Reference& r) {
  std::set<std::string> runs;
  for (std::size_t i = 0; i < r.runs.size(); ++i) {
    const Run& run = r.runs[i];
    const Entry entry = p.member(*p.node.find("runs")).item(i);
    if (!runs.insert(run.name).second) entry.failAt("name", fmt::format("\"{}\" is the name of two runs", run.name));
    if (run.name.find_first_of("/\\") != std::string::npos || run.name.starts_with('.'))
      entry.failAt("name", "is the name of a folder too: no slashes, no dot at its start");
    if (run.name.ends_with(".log") || run.name.ends_with(".json"))
      entry.failAt("name", "is the name of a folder beside files of that ending: another one");
    if (run.file.empty() && run.inline_case.type == JsonNode::Type::null && r.case_file.empty() &&
        r.inline_case.type == JsonNode::Type::null)
      entry.fail("has no case, and the reference has none either");
  }
  for (std::size_t i = 0; i < r.checks.size(); ++i) {
    const Check& c = r.checks[i];
    const Entry entry = p.member(*p.node.find("checks")).item(i);
    const auto known = [&](const std::string& key, const std::string& run) {
      if (!runs.contains(run)) entry.failAt(key, fmt::format("there is no run \"{}\"", run));
    };
    const auto column = [&](const std::string& key, const std::string& name) {
      const auto& all = r.table.columns;
      if (std::find(all.begin(), all.end(), name) == all.end())
        entry.failAt(key, fmt::format("there is no column \"{}\" in the reference's table; there are: {}", name,
                                      schema::joined(all)));
    };
    if (c.gates() && !c.why.empty()) entry.failAt("why", "is for what is reported only, and this check is gated");
    if (!c.gates() && c.why.empty() && r.why.empty())
      entry.fail("is reported only and says nowhere why: give why here, or in the reference for all such checks");
    for (const std::string& run : c.also) known("also", run);
    for (const std::string& run : c.runs) known("runs", run);
    for (const std::string& run : c.reference_runs) known("reference_runs", run);
    if (!c.run.empty()) known("run", c.run);
    const auto quantity = [&](const std::string& key, const Quantity& q) {
      if (q.runs.empty()) entry.failAt(key, "needs run (or runs)");
      for (const std::string& run : q.runs) known(key, run);
    };
    if (c.kind == Check::Kind::value) quantity("of", c.of);
    if (c.kind == Check::Kind::rate && !c.of.runs.empty()) entry.failAt("of", "takes its runs from the check");
    if (c.first) known("first", c.first->run);
    if (c.second) known("second", c.second->run);
    if (c.minus) quantity("minus", *c.minus);
    if (c.over) quantity("over", *c.over);
    if (c.kind == Check::Kind::curve || c.kind == Check::Kind::table) {
      if (r.table.columns.empty()) entry.fail("needs the reference's table");
      column("x", c.x.reference);
      column("y", c.y.reference);
      if (c.reported) column("reported", c.reported->column);
    }
  }
}

schema::Object referenceTable() {
  using R = Reference;
  Fields<R> t("Reference");
  t.text("id", &R::id, "name of the file without .json").required();
  t.text("title", &R::title, "what it is, in a line").required();
  t.text("group", &R::heading, "heading that it stands under");
  t.text("source", &R::source, "where the published numbers are from").required();
  t.text("doc", &R::doc, "problem, mesh, what is compared and why the tolerance is what it is").required();
  t.text("why", &R::why, "why checks are reported only that do not say it themselves");
  boolean(t, "quick", &R::quick, "belongs to the quick half");
  boolean(t, "on_demand", &R::on_demand, "runs only where a filter names it");
  t.custom(
      field("case", Kind::path, "case of the runs: a file, or the case itself"),
      [](const Entry& p, R& r) { readCase(p, r.case_file, r.inline_case); }, unwritten);
  t.object("table", &R::table, numbersTable(), "the published table");
  t.list("runs", &R::runs, runTable(), "runs").required();
  t.list("checks", &R::checks, checkTable(), "what is compared").required();
  t.check([](const Entry& p, const R& r) {
    if (r.id != std::filesystem::path(p.file).stem().string())
      p.failAt("id", fmt::format("\"{}\" is not the name of the file", r.id));
    if (r.runs.empty()) p.failAt("runs", "must not be empty");
    if (r.checks.empty()) p.failAt("checks", "must not be empty");
    checkNames(p, r);
  });
  return t.build();
}

}  // namespace

Reference readReference(const std::filesystem::path& file) {
  const JsonNode root = readJson(file);
  const std::string name = file.string();
  Reference reference;
  schema::readObject(referenceTable(), {root, "", name}, &reference);
  reference.file = file;
  return reference;
}

}  // namespace gambeson::verify
