/// Detail of population.hpp: the fields of a study's population.

#include <fmt/format.h>

#include <set>

#include "cases/input/table.hpp"
#include "cases/study/fields.hpp"
#include "cases/study/population.hpp"

namespace gambeson::study {
namespace {

using schema::Entry;
using schema::Table;

schema::Object gradeTable() {
  using G = Grade;
  return Table<G>("Grade of a garment")
      .choice("girth", &G::girth,
              std::vector<std::pair<std::string, BodyGirth>>{
                  {"chest", BodyGirth::chest}, {"waist", BodyGirth::waist}, {"hip", BodyGirth::hip}},
              "of the body: what the sizes go by here")
      .required()
      .text("path", &G::path, "the ease of the case that follows, such as garment.shorts.ease")
      .required()
      .number("ease", &G::ease, "", schema::between(-0.3, 0.5),
              "how much wider the garment of a size is there than the body that the size is made for")
      .required()
      .number("least", &G::least, "", schema::between(-0.3, 0.5),
              "a size that would have less ease than this on a wearer is not tried")
      .build();
}

schema::Object sizeTable() {
  using S = GarmentSize;
  Table<S> table("Size of a garment");
  table.text("label", &S::label, "its name, such as M").required();
  for (std::size_t k = 0; k < kGirthNames.size(); ++k)
    table
        .number(
            kGirthNames[k], [k](auto& s) -> auto& { return s.girth_m[k]; }, "m", schema::between(0.4, 2.5),
            fmt::format("girth of the {} of the body that it is made for", kGirthNames[k]))
        .defaultsTo("none; required where a grade goes by it");
  rawField(table, "set", &S::set, "object path: value; what of the case is this size's own");
  return table.build();
}

void checkSizes(const Entry& p, const PopulationInput& in) {
  if (in.sizes.empty() != in.grades.empty())
    p.failAt(in.sizes.empty() ? "grades" : "sizes",
             in.sizes.empty() ? "goes with sizes; allowed: both or none" : "goes with grades; allowed: both or none");
  std::set<std::string> labels, paths;
  for (std::size_t k = 0; k < in.grades.size(); ++k)
    if (!paths.insert(in.grades[k].path).second)
      p.member(*p.node.find("grades"))
          .item(k)
          .failAt("path", fmt::format("{} is graded twice; allowed: once", in.grades[k].path));
  for (std::size_t k = 0; k < in.sizes.size(); ++k) {
    const Entry at = p.member(*p.node.find("sizes")).item(k);
    const GarmentSize& size = in.sizes[k];
    if (!labels.insert(size.label).second)
      at.failAt("label", fmt::format("\"{}\" names two sizes; allowed: a name of its own", size.label));
    for (const Grade& g : in.grades)
      if (const auto girth = static_cast<std::size_t>(g.girth); !size.girth_m[girth])
        at.failAt(kGirthNames[girth], fmt::format("is required: {} goes by it", g.path));
  }
}

}  // namespace

schema::Object populationTable() {
  using P = PopulationInput;
  return Table<P>("Population")
      .choice("source", &P::source, std::vector<std::pair<std::string, Survey>>{{"ansur2", Survey::ansur2}},
              "whose people are drawn: ansur2, the US Army's men and women of 2012")
      .required()
      .integer("count", &P::count, 1, 1000, "how many wearers")
      .number("women", &P::women, "", schema::between(0, 1), "part of them that are women, rounded to whole people")
      .integer("seed", &P::seed, 0, 1000000000, "another one draws other people; a larger count keeps those drawn")
      .list(
          "grades", &P::grades, gradeTable(),
          "what of the garment its size fixes, the girth first by which the nearest size is found; all other measures "
          "follow each wearer, as the draft has them")
      .list("sizes", &P::sizes, sizeTable(), "the sizes that the garment comes in; without them it is made to measure")
      .integer("tries", &P::tries, 1, 5, "how many sizes each wearer tries, the nearest first")
      .check([](const Entry& p, const P& in) { checkSizes(p, in); })
      .build();
}

}  // namespace gambeson::study
