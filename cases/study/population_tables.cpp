/// Detail of population_answer.hpp: population.csv, and what study.json has of it.

#include "cases/study/population_answer.hpp"
#include "cases/study/table_rows.hpp"

namespace gambeson::study {
namespace {


const char* sexOf(const Wearer& w) { return w.measures.sex == Sex::female ? "female" : "male"; }

const char* nameOf(Dressed d) {
  const char* names[]{"yes", "no run", "cloth passes through cloth", "stretched too far"};
  return names[static_cast<int>(d)];
}

std::string lightText(Light l) { return l == Light::unknown ? "" : gambeson::nameOf(l); }

std::string sizeName(const Study& s, int size) {
  return size < 0 ? "" : s.population->input.sizes[static_cast<std::size_t>(size)].label;
}

std::vector<std::string> bodyCells(const Wearer& w) {
  const ManikinMeasures& m = w.measures;
  return {w.label,         sexOf(w),         cell(m.stature_m),
          cell(m.mass_kg), cell(m.chest_m),  cell(m.waist_m),
          cell(m.hip_m),   cell(m.inseam_m), w.extrapolated ? "yes" : "no"};
}

StudyJson fittingJson(const Study& s, const Fitting& f) {
  StudyJson j{{"variant", s.variants[f.variant].folder}};
  if (f.size >= 0) j["size"] = sizeName(s, f.size);
  j["put_on"] = f.on();
  if (!f.why.empty()) j["why_not"] = f.why;
  for (std::size_t k = 0; k < kBurdened.size(); ++k) {
    const JointBurden& b = f.burdens[k];
    if (!b.looked) continue;
    j[kBurdened[k]] = {{"of_natural", number(b.part)}, {"light", gambeson::nameOf(b.light)}, {"joint", b.label}};
  }
  if (!f.presses.empty())
    j["presses"] = {{"zone", f.presses}, {"light", gambeson::nameOf(f.comfort)}, {"part_of_limit", f.part_of_limit}};
  return j;
}

StudyJson shareJson(const PopulationShare& p) {
  const ShareInterval i = p.interval();
  return {
      {"what", p.what},  {"yes", p.yes},         {"of_these_doubtful", p.doubtful},
      {"no", p.no},      {"unknown", p.unknown}, {"share", p.of() > 0 ? StudyJson(double(p.yes) / p.of()) : StudyJson(nullptr)},
      {"low_95", i.low}, {"high_95", i.high}};
}

}  // namespace

std::string populationCsv(const Study& s, const PopulationAnswer& a) {
  std::vector<std::string> row{"wearer",   "sex",           "stature_m", "mass_kg", "chest_m", "waist_m", "hip_m",
                               "inseam_m", "beyond_survey", "variant",   "size",    "taken",   "put_on",  "why"};
  for (const char* joint : kBurdened)
    for (const char* what : {"of_natural", "light", "joint"}) row.push_back(fmt::format("{}_{}", joint, what));
  row.insert(row.end(), {"presses", "comfort", "pressure_part_of_limit"});
  const std::size_t columns = row.size();
  std::string out = csvRow(row);
  for (std::size_t w = 0; w < a.wearers.size(); ++w) {
    const Wearer& wearer = s.population->wearers[w];
    if (a.wearers[w].fittings.empty()) {
      row = bodyCells(wearer);
      row.insert(row.end(), {"", "", "", "no size", wearer.no_size});
      row.resize(columns);
      out += csvRow(row);
    }
    for (const Fitting& f : a.wearers[w].fittings) {
      row = bodyCells(wearer);
      row.insert(row.end(), {s.variants[f.variant].folder, sizeName(s, f.size),
                             &f == a.wearers[w].taken() ? "yes" : "no", nameOf(f.dressed), f.why});
      for (const JointBurden& b : f.burdens)
        row.insert(row.end(), {cell(b.part), b.looked ? lightText(b.light) : "", b.label});
      row.insert(row.end(), {f.presses, f.presses.empty() ? "" : lightText(f.comfort),
                             f.presses.empty() ? "" : cell(f.part_of_limit)});
      out += csvRow(row);
    }
  }
  return out;
}

StudyJson populationJson(const Study& s, const PopulationAnswer& a) {
  const Population& p = *s.population;
  StudyJson j{{"source", "ansur2"},
         {"seed", p.input.seed},
         {"men", p.men},
         {"women", p.women},
         {"contradicting_draws", p.contradicting},
         {"sentence", a.sentence},
         {"stretch_is_judged", a.judged_stretch},
         {"shares", StudyJson::array()},
         {"wearers", StudyJson::array()}};
  for (const PopulationShare& share : a.shares) j["shares"].push_back(shareJson(share));
  for (std::size_t k = 0; k < p.input.sizes.size(); ++k) {
    StudyJson of{{"size", p.input.sizes[k].label}, {"wearers", StudyJson::array()}};
    for (std::size_t w = 0; w < a.wearers.size(); ++w)
      if (const Fitting* f = a.wearers[w].taken(); f && f->on() && f->size == static_cast<int>(k))
        of["wearers"].push_back(p.wearers[w].label);
    j["sizes"].push_back(std::move(of));
  }
  for (std::size_t w = 0; w < a.wearers.size(); ++w) {
    const Wearer& wearer = p.wearers[w];
    const ManikinMeasures& m = wearer.measures;
    StudyJson one{{"wearer", wearer.label}, {"sex", sexOf(wearer)},    {"stature_m", m.stature_m},
             {"mass_kg", m.mass_kg},   {"chest_m", *m.chest_m},   {"waist_m", *m.waist_m},
             {"hip_m", *m.hip_m},      {"inseam_m", *m.inseam_m}, {"beyond_survey", wearer.extrapolated}};
    if (!wearer.no_size.empty()) one["no_size"] = wearer.no_size;
    for (const Fitting& f : a.wearers[w].fittings) one["fittings"].push_back(fittingJson(s, f));
    if (const Fitting* f = a.wearers[w].taken()) one["taken"] = s.variants[f->variant].folder;
    j["wearers"].push_back(std::move(one));
  }
  for (const std::size_t w : a.worst) j["worst"].push_back(p.wearers[w].label);
  return j;
}

}  // namespace gambeson::study
