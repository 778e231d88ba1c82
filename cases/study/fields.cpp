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

schema::Object uncertaintyTable() {
  using U = UncertaintyInput;
  Table<U> table("Uncertainty");
  table
      .integer("runs", &U::runs, 12, 1000,
               "samples of the fabric, a Latin hypercube over its spreads; none are run where no spread is known")
      .integer("seed", &U::seed, 0, 2147483647, "of the draws: the same seed gives the same samples")
      .object("spread", &U::spread, schema::spreadTable(), "of the fabric, in place of what its card says")
      .defaultsTo("spread_of of the card; of several fabrics the largest. What neither says is named on the page")
      .text("source", &U::source, "where the spreads that the study gives are from")
      .flag("step", &U::step, "one run with half of every step (time.step_safety, max_step and step)")
      .number("step_duration", &U::step_duration_s, "s", schema::aboveTo(0, 3600),
              "how much of the motion that run plays: what it differs by until then counts for all")
      .defaultsTo("half of the motion")
      .number("finer", &U::finer, "", schema::between(1, 4),
              "one run on cells so many times smaller: 1.5 costs some four runs; 1: none")
      .defaultsTo("1.5; 1 where the study has finer meshes of its own (an axis of meshes, a variant with finer)");
  rawField(table, "where", &U::where, "object axis: list of labels; only at these levels",
           "designs at the baseline, meshes at their first level, all others at all levels");
  return table.build();
}

schema::Object optimiseTable() {
  using O = OptimiseInput;
  Table<O> table("Optimise");
  table
      .choice(
          "minimise", &O::aim, std::vector<std::pair<std::string, Aim>>{{"torque", Aim::torque}, {"mass", Aim::mass}},
          "torque: the largest added torque, at a given mass; mass: that of all garments, with no larger torque than "
          "the limit")
      .required()
      .texts("regions", &O::regions, "names of the regions (garment.regions) whose thickness is free, at most 8")
      .defaultsTo("all that keep does not name")
      .texts("keep", &O::keep, "names of regions that are protected: they stay as the case has them")
      .texts("joints", &O::joints, "names of the joints whose torque counts, the largest of them")
      .defaultsTo("all that the case analyses and that turn")
      .number(
          "mass", &O::mass_kg, "kg", schema::aboveTo(0, 1000),
          "of all garments, kept by the free region that is heaviest, whose factor follows from the others; the search "
          "starts from the case with one factor on all free regions")
      .defaultsTo("that of the case, from which the search then starts")
      .number("limit", &O::limit_Nm, "N m", schema::aboveTo(0, 1e4), "largest added torque that is allowed")
      .defaultsTo("required where the mass is minimised");
  schema::Field between =
      schema::fieldOf("between", schema::Kind::numbers, "", schema::between(0.05, 20), "least and largest factor");
  between.default_note = "[0.5, 1.5]";
  table.custom(
      between,
      [range = between.range](const Entry& p, O& o) {
        const std::vector<double> both = schema::readNumbers(p, "", range);
        if (both.size() != 2) p.fail(fmt::format("has {} numbers; allowed: 2, least and largest", both.size()));
        if (!(both[0] < both[1]))
          p.fail(fmt::format("[{}, {}] is empty; allowed: least below largest", both[0], both[1]));
        o.between = {both[0], both[1]};
      },
      [](const O& o) {
        return std::optional(schema::nodeOfList({o.between[0], o.between[1]}));
      });
  table.number("step", &O::step, "", schema::between(0.02, 10), "of the factors, in the first runs")
      .defaultsTo("a quarter of the range of between")
      .integer("runs", &O::runs, 2, 500,
               "of the search, at most; it ends before where a step is shorter than a hundredth of a factor");
  rawField(
      table, "repeats", &O::repeats,
      "list of objects path: value that change numerics alone (steps, or garment.noise of a tenth of a millimetre), at "
      "most 10; first map and best one run again with each, and how far the gain moves is its error bar",
      "one with time.step_safety and time.max_step (or time.step) at four fifths");
  rawField(
      table, "finer", &O::finer,
      "object path: value that makes the mesh finer; both maps run again on it, of equal mass there too, and how far "
      "the gain moves adds to the error bar",
      "none: the gain is not confirmed on a finer mesh");
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
      .defaultsTo("none")
      .object(
          "optimise", &S::optimise, optimiseTable(),
          "in place of axes and variants: searches the thickness map over named regions (garment.regions) that costs "
          "least, by COBYLA, a search without derivatives and without random numbers, each try a run of its own; a "
          "search that was stopped goes on with --resume to the same map")
      .defaultsTo("none");
  table
      .object("uncertainty", &S::uncertainty, uncertaintyTable(),
              "adds the runs that tell the error bar of every number: of the mesh, of the step, and of the spread of "
              "the fabric; variants elsewhere have the same bars in per cent")
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
      .defaultsTo("one of the stress at the baseline's peak; with optimise also two of the thickness");
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
