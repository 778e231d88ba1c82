/// Detail of table_rows.hpp: error bars.

#include "cases/cloth/fabric_spread.hpp"
#include "cases/study/table_rows.hpp"

namespace gambeson::study {

/// Of each number its bar and the parts; of a fabric the variance that each of its numbers brings, of all of it.
std::string uncertaintyTable(const Study& s, const Comparison& c) {
  std::vector<std::string> row{"variant",    "number", "of",   "unit",   "value",
                               "half_width", "mesh",   "step", "fabric", "samples"};
  for (const auto& [name, which] : kSpreads) row.push_back(fmt::format("{}_share_of_variance", name));
  row.insert(row.end(), {"residual_share_of_variance", "residual", "explained"});
  std::string out = csvRow(row);
  for (const Budget& b : c.budgets)
    for (const BarredNumber& n : b.numbers) {
      row = {s.variants[b.reference].folder, n.what.name(),    n.what.of,        n.what.unit(),     cell(n.value),
             cell(n.bar.combined()),         cell(n.bar.mesh), cell(n.bar.step), cell(n.bar.fabric)};
      row.push_back(n.fabric ? std::to_string(n.fabric->runs) : std::string());
      for (const auto& [name, which] : kSpreads) {
        row.emplace_back();
        for (std::size_t k = 0; n.fabric && k < s.uncertainty->spreads.size(); ++k)
          if (s.uncertainty->spreads[k].name == name) row.back() = cell(n.fabric->variance[k] / n.fabric->total());
      }
      if (n.fabric)
        row.insert(row.end(), {cell(n.fabric->residual * n.fabric->residual / n.fabric->total()),
                               cell(n.fabric->residual), cell(n.fabric->explained)});
      else
        row.resize(row.size() + 3);
      out += csvRow(row);
    }
  return out;
}

namespace {

StudyJson numberJson(const Study& s, const BarredNumber& n) {
  StudyJson j{{"number", n.what.name()},
              {"of", n.what.of},
              {"unit", n.what.unit()},
              {"value", number(n.value)},
              {"half_width", number(n.bar.combined())},
              {"mesh", number(n.bar.mesh)},
              {"step", number(n.bar.step)},
              {"fabric", number(n.bar.fabric)},
              {"largest", nameOf(n.bar.largest())}};
  if (n.fabric) {
    j["fabric_samples"] = n.fabric->runs;
    j["fabric_deviation"] = number(n.fabric->deviation());
    for (std::size_t k = 0; k < s.uncertainty->spreads.size(); ++k)
      j["fabric_by"].push_back({{"spread", s.uncertainty->spreads[k].name},
                                {"slope", number(n.fabric->slope[k])},
                                {"variance", number(n.fabric->variance[k])}});
    j["fabric_residual"] = number(n.fabric->residual);
    j["fabric_explained"] = number(n.fabric->explained);
  }
  j["advice"] = adviceOf(s, n);
  return j;
}

}  // namespace

StudyJson uncertaintyJson(const Study& s, const Comparison& c) {
  StudyJson j;
  for (const StudiedSpread& p : s.uncertainty->spreads)
    j["spreads"].push_back({{"of", p.name}, {"deviation", p.deviation}, {"source", p.source}});
  if (!s.uncertainty->source.empty()) j["source"] = s.uncertainty->source;
  j["spread_not_known"] = s.uncertainty->unknown;
  j["coverage"] = kCoverage;
  for (const Budget& b : c.budgets) {
    StudyJson numbers = StudyJson::array();
    for (const BarredNumber& n : b.numbers) numbers.push_back(numberJson(s, n));
    j["bars"].push_back({{"variant", s.variants[b.reference].folder},
                         {"samples", b.samples},
                         {"samples_failed", b.failed},
                         {"mesh_is_of_other_runs", b.mesh_taken_over},
                         {"no_step", b.no_step},
                         {"no_fabric", b.no_fabric},
                         {"numbers", std::move(numbers)}});
  }
  return j;
}

}  // namespace gambeson::study
