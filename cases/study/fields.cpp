/// Detail of input.hpp: the fields of a study's file.

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "cases/input/table.hpp"
#include "cases/runs/picture.hpp"
#include "cases/study/fields.hpp"
#include "cases/study/input.hpp"
#include "human/files/data.hpp"

namespace gambeson::study {
namespace {

using schema::Entry;
using schema::Table;

std::vector<std::pair<std::string, std::optional<Role>>> roleChoices() {
  std::vector<std::pair<std::string, std::optional<Role>>> all;
  for (const auto& [name, role] : roleNames()) all.emplace_back(name, role);
  return all;
}

schema::Object axisTable() {
  using A = AxisInput;
  Table<A> table("Axis");
  table.text("name", &A::name, "what tables call it")
      .defaultsTo("the last part of the path")
      .text("path", &A::path, "the value of the case that varies, such as factors.thickness or garments[0].shorts.cell")
      .defaultsTo("required, or sets");
  rawField(table, "values", &A::values, "list of the values, at least one; anything that the case may have there",
           "required with path");
  rawField(
      table, "sets", &A::sets,
      "in place of path and values, where several values of the case go together: list of objects path: value, one "
      "for each level");
  table.texts("labels", &A::labels, "name of each level, for folders and tables; no two alike")
      .defaultsTo("the values; required with sets, and where values are objects or lists")
      .text("unit", &A::unit, "shown beside values that are numbers")
      .choice(
          "role", &A::role, roleChoices(),
          "what the levels are: thicknesses, materials, fits or other designs, of which the verdict takes one; "
          "wearers, sizes, motions or frictions, which all occur, so that the worst counts; models, kinds of cloth of "
          "one garment, which are laid side by side; meshes, coarse and fine, whose difference is the verdict's error")
      .defaultsTo(
          "by the name where it is one of these, else by the paths (factors.thickness, fabric.thickness: thickness; "
          "fabric: material; cell, cells_...: mesh; human.motion: motion; human.manikin and the like: wearer; "
          "contact.friction: friction; garment.model, sheet.model: model; measures of a drafted garment, such as "
          "garment.shorts.ease: fit)");
  return table.build();
}

schema::Object extraTable() {
  using E = ExtraInput;
  Table<E> table("Further variant");
  table.text("label", &E::label, "its name").required();
  rawField(table, "at", &E::at, "object axis: label; the levels that it starts from",
           "the baseline; of an axis that the baseline does not name, the first level");
  rawField(table, "set", &E::set, "object path: value; what is changed there", "required");
  table.flag("finer", &E::finer,
             "what is changed is the mesh alone, to a finer one: the difference to the variant with the same levels is "
             "the error bar of the verdict");
  return table.build();
}

schema::Object elasticityTable() {
  using E = ElasticityInput;
  Table<E> table("Elasticities");
  table.number("step", &E::step, "", schema::between(0.001, 0.5), "each factor is run at 1 - step and 1 + step");
  rawField(table, "where", &E::where, "object axis: list of labels; only at these levels", "at all levels");
  return table.build();
}

schema::Object limitsTable() {
  return Table<Limits>("Limits")
      .number("green", &Limits::green, "", schema::aboveTo(0, 10), "green below this part of the natural moment")
      .defaultsTo("5 %")
      .number("red", &Limits::red, "", schema::aboveTo(0, 10), "red above this part; amber between")
      .defaultsTo("15 %")
      .check([](const Entry& p, Limits& l) {
        if (!(l.green < l.red))
          p.failAt("red", fmt::format("{} is out of range; allowed: > green = {}", l.red, l.green));
        l.source = "limits of the study";
      })
      .build();
}

schema::Object makeStudyTable() {
  using S = StudyInput;
  Table<S> table("Study", "variants of a case, run and compared by `gambeson study`");
  table.text("name", &S::name, "title of the page")
      .required()
      .text("description", &S::description, "what the study is about")
      .path("case", &S::file, "the case that varies, relative to the study's folder")
      .required();
  rawField(table, "set", &S::set, "object path: value; set in every variant, before the axes");
  table.list("axes", &S::axes, axisTable(), "what varies; every combination of the axes' levels is a variant")
      .list("variants", &S::variants, extraTable(), "single variants beside those of the axes")
      .object("elasticities", &S::elasticities, elasticityTable(),
              "adds the ten variants that tell how much of the torque is due to bending, membrane, weight, inertia and "
              "drag, at each combination of the axes that are not factors (those stay at the baseline)")
      .defaultsTo("none");
  rawField(
      table, "baseline", &S::baseline,
      "object axis: label; variants are compared along these axes with the variant that has these levels; what is not "
      "chosen (motion, wearer, size, friction) is compared with itself, so that such an axis counts only where no "
      "design is named",
      "factors: the level 1; without one, the first level of the first axis that is a design, else of the first of "
      "wearers, sizes or frictions, else of motions");
  table.object("population", &S::population, populationTable(),
               "wearers that are drawn: each is a variant, of the case with its manikin replaced; in place of axes, "
               "variants, elasticities and baseline")
      .defaultsTo("none");
  table.object("limits", &S::limits, limitsTable(), "traffic light of added torques")
      .defaultsTo("green 5 %, red 15 %: human/data/effort_limits.json")
      .list("pictures", &S::pictures, schema::pictureTable(),
            "of all variants of the axes side by side, at the same time (peak: that of the baseline) and with the same "
            "colours")
      .defaultsTo("one of the stress at the baseline's peak");
  return table.build();
}

}  // namespace

const std::vector<std::pair<std::string, Role>>& roleNames() {
  static const std::vector<std::pair<std::string, Role>> names{
      {"thickness", Role::thickness}, {"mesh", Role::mesh}, {"motion", Role::motion},
      {"wearer", Role::wearer},       {"size", Role::size}, {"material", Role::material},
      {"friction", Role::friction},   {"fit", Role::fit},   {"model", Role::model},
      {"other", Role::other}};
  return names;
}

Limits publishedLimits() {
  const auto facts = nlohmann::json::parse(data::effort_limits);
  return {facts.at("green_below").get<double>(), facts.at("red_above").get<double>(),
          "a suggestion for design, as no published standard was found"};
}

const schema::Object& studyTable() {
  static const schema::Object table = makeStudyTable();
  return table;
}

}  // namespace gambeson::study
