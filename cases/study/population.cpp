#include "cases/study/population.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cases/input/table.hpp"
#include "human/manikin/population.hpp"
#include "human/manikin/regressions.hpp"

namespace gambeson::study {
namespace {

double girthOf(const ManikinMeasures& m, BodyGirth g) {
  return g == BodyGirth::chest ? *m.chest_m : g == BodyGirth::waist ? *m.waist_m : *m.hip_m;
}

bool beyondSurvey(const ManikinMeasures& m) {
  const nlohmann::json of = regressionsFor(m.sex, 0, 0).of;
  const auto beyond = [&](const char* key, double value) {
    return value < of.at(key).at(0).get<double>() || value > of.at(key).at(1).get<double>();
  };
  return beyond("stature_m", m.stature_m) || beyond("mass_kg", m.mass_kg);
}

/// The nearest sizes by the first grade's girth, of those that are nowhere narrower on the wearer than they may be; of
/// two that are as near the wider one.
void findSizes(const PopulationInput& in, Wearer& w) {
  const auto slack = [&](const GarmentSize& size) {
    double least = std::numeric_limits<double>::infinity();
    for (const Grade& g : in.grades) least = std::min(least, easeOf(g, size, w.measures) - g.least);
    return least;
  };
  const auto first = static_cast<std::size_t>(in.grades[0].girth);
  const auto off = [&](int k) {
    return *in.sizes[static_cast<std::size_t>(k)].girth_m[first] - girthOf(w.measures, in.grades[0].girth);
  };
  std::vector<int> order;
  for (std::size_t k = 0; k < in.sizes.size(); ++k)
    if (slack(in.sizes[k]) >= 0) order.push_back(static_cast<int>(k));
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    const double x = std::abs(off(a)), y = std::abs(off(b));
    return x != y ? x < y : off(a) > off(b);
  });
  order.resize(std::min(order.size(), static_cast<std::size_t>(in.tries)));
  w.sizes = std::move(order);
  if (!w.sizes.empty()) return;
  const auto widest = std::max_element(in.sizes.begin(), in.sizes.end(),
                                       [&](const auto& a, const auto& b) { return slack(a) < slack(b); });
  for (const Grade& g : in.grades) {
    const double ease = easeOf(g, *widest, w.measures);
    if (ease >= g.least) continue;
    w.no_size = fmt::format("the widest for this body, {}, is {:.1f} cm too narrow for the {}", widest->label,
                            100 * (g.least - ease) * girthOf(w.measures, g.girth),
                            kGirthNames[static_cast<std::size_t>(g.girth)]);
    return;
  }
}

void addWearers(const PopulationInput& in, Sex sex, int count, Population& p) {
  const DrawnPeople drawn = drawPeople(sex, count, static_cast<std::uint64_t>(in.seed));
  p.contradicting += drawn.contradicting;
  const char* word = sex == Sex::female ? "woman" : "man";
  for (std::size_t k = 0; k < drawn.people.size(); ++k) {
    Wearer w;
    w.measures = drawn.people[k];
    w.label = fmt::format("{} {}", word, k + 1);
    w.name = fmt::format("{} ({:.2f} m, {:.0f} kg)", w.label, w.measures.stature_m, w.measures.mass_kg);
    w.folder = fmt::format("{}_{:02d}", word, k + 1);
    w.extrapolated = beyondSurvey(w.measures);
    if (!in.sizes.empty()) findSizes(in, w);
    p.wearers.push_back(std::move(w));
  }
}

}  // namespace

double easeOf(const Grade& g, const GarmentSize& size, const ManikinMeasures& wearer) {
  return (1 + g.ease) * *size.girth_m[static_cast<std::size_t>(g.girth)] / girthOf(wearer, g.girth) - 1;
}

Population drawPopulation(const PopulationInput& in) {
  Population p;
  p.input = in;
  p.women = static_cast<int>(std::lround(in.count * in.women));
  p.men = in.count - p.women;
  addWearers(in, Sex::male, p.men, p);
  addWearers(in, Sex::female, p.women, p);
  return p;
}

JsonNode manikinNode(const ManikinMeasures& m) {
  JsonNode node;
  node.type = JsonNode::Type::object;
  const auto add = [&](const char* key, JsonNode value) {
    value.key = key;
    node.children.push_back(std::move(value));
  };
  add("sex", schema::nodeOf(std::string(m.sex == Sex::female ? "female" : "male")));
  add("stature", schema::nodeOf(m.stature_m));
  add("mass", schema::nodeOf(m.mass_kg));
  add("chest", schema::nodeOf(*m.chest_m));
  add("waist", schema::nodeOf(*m.waist_m));
  add("hip", schema::nodeOf(*m.hip_m));
  add("inseam", schema::nodeOf(*m.inseam_m));
  return node;
}

}  // namespace gambeson::study
