#include "human/motion/task_moments.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "human/files/data.hpp"

namespace gambeson {
namespace {

using Json = nlohmann::json;

std::string rowOf(const std::string& joint) {
  const std::map<std::string, std::string> rows{{"hip_flexion", "Hip Ext/Flexion"},
                                                {"hip_adduction", "Hip Ab/Adduction"},
                                                {"knee_flexion", "Knee Ext/Flexion"},
                                                {"ankle_flexion", "Ankle Dorsi/Plantarflexion"}};
  std::string name = joint;
  for (const std::string side : {"_right", "_left"})
    if (name.ends_with(side)) name.resize(name.size() - side.size());
  const auto row = rows.find(name);
  if (row == rows.end())
    throw InputError({"", 0, "joint"}, "no natural moment is known for '" + joint +
                                           "'; known are hip_flexion, hip_adduction, knee_flexion, ankle_flexion");
  return row->second;
}

void checkMass(double mass_kg) {
  if (!(mass_kg > 0 && std::isfinite(mass_kg))) throw InputError({"", 0, "mass_kg"}, "must be > 0");
}

const Json& entry(const Json& table, const std::string& key, const char* what) {
  if (table.contains(key)) return table.at(key);
  std::string known;
  for (const auto& [k, v] : table.items()) known.append(known.empty() ? "" : ", ").append(k);
  throw InputError({"", 0, what}, "no natural moment is known for '" + key + "'; known are " + known);
}

}  // namespace

double naturalPeakMoment_Nm(const std::string& task, const std::string& joint, double mass_kg) {
  checkMass(mass_kg);
  const Json facts = Json::parse(data::task_moments);
  const Json& row = entry(entry(facts.at("peaks_Nm"), task, "task"), rowOf(joint), "joint");
  const double peak = std::max(std::abs(row.at("max_Nm").get<double>()), std::abs(row.at("min_Nm").get<double>()));
  return peak * mass_kg / facts.at("reference_mass_kg").get<double>();
}

std::vector<double> naturalMoment_Nm(const std::string& joint, double mass_kg) {
  checkMass(mass_kg);
  const Json facts = Json::parse(data::task_moments);
  auto curve = entry(facts.at("curves_Nm_per_kg").at("Natural"), rowOf(joint), "joint").get<std::vector<double>>();
  for (double& m : curve) m *= mass_kg;
  return curve;
}

}  // namespace gambeson
