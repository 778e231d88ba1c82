#include "cases/wear/recording/zone_ledger.hpp"

#include <algorithm>
#include <set>

namespace gambeson {

std::string groupName(const ContactGroup& g) {
  return g.garment + (g.press == Press::belt ? " in the belt's press" : g.press == Press::held ? " on springs" : "");
}

std::string spokenZone(std::string zone) {
  for (const std::string side : {"left", "right"})
    if (zone.ends_with("_" + side)) zone = side + " " + zone.substr(0, zone.size() - side.size() - 1);
  std::replace(zone.begin(), zone.end(), '_', ' ');
  return zone;
}

std::vector<std::string> toldApart(std::vector<std::string> names) {
  std::set<std::string> known;
  for (std::string& name : names) {
    const std::string given = name;
    for (int k = 2; !known.insert(name).second; ++k) name = given + " " + std::to_string(k);
  }
  return names;
}

std::vector<std::string> zoneNames(const Scenario& s) {
  std::vector<std::string> names;
  if (s.human) names = BodyZones(*s.human).names();
  for (std::size_t b = s.human ? s.human->skeleton.links.size() : 0; b < s.bodies.size(); ++b)
    names.push_back(s.bodies[b]);
  return names;
}

ZoneLedger::ZoneLedger(const Scenario& s) : scenario_(s), count_(static_cast<int>(zoneNames(s).size())) {
  if (s.human) zones_.emplace(*s.human);
  if (s.hasSkin()) skin_ = zones_->ofSkin(*s.human->skin);
  sums_.assign(static_cast<std::size_t>(kParts * count_) * s.contact_groups.size(), 0);
}

std::vector<std::string> ZoneLedger::names(const Scenario& s) {
  std::vector<std::string> names;
  for (const ContactGroup& g : s.contact_groups)
    for (const std::string& zone : zoneNames(s)) names.push_back(groupName(g) + " on " + zone);
  return toldApart(names);
}

std::vector<std::string> ZoneLedger::columns(const Scenario& s) {
  std::vector<std::string> columns;
  for (const std::string& name : names(s))
    for (const char* part : {"_Ns", "_n_Ns", "_t_Ns", "_Jx_Ns", "_Jy_Ns", "_Jz_Ns"}) columns.push_back(name + part);
  return columns;
}

void ZoneLedger::give(int group, int zone, double share, const ContactImpulse& c) {
  const double normal = dot(c.impulse, c.normal);
  double* at = &sums_[static_cast<std::size_t>(kParts * (count_ * group + zone))];
  at[0] += share * norm(c.impulse);
  at[1] += share * normal;
  at[2] += share * norm(c.impulse - normal * c.normal);
  at[3] -= share * c.impulse.x;
  at[4] -= share * c.impulse.y;
  at[5] -= share * c.impulse.z;
}

void ZoneLedger::add(const ContactImpulse& c, std::span<const Pose> X_WB) {
  const int group = scenario_.contact_group[static_cast<std::size_t>(c.sample)];
  const int body = scenario_.body_of_obstacle[static_cast<std::size_t>(c.obstacle)];
  if (body < 0) {
    for (std::size_t k = 0; k < 3 && c.touched.vertex[k] >= 0; ++k)
      give(group, skin_[static_cast<std::size_t>(c.touched.vertex[k])], c.touched.weight[k], c);
    return;
  }
  const int links = scenario_.human ? static_cast<int>(scenario_.human->skeleton.links.size()) : 0;
  const int zone = body < links ? zones_->of(body, inverse(X_WB[static_cast<std::size_t>(body)]) * c.point)
                                : (zones_ ? static_cast<int>(zones_->names().size()) : 0) + body - links;
  give(group, zone, 1, c);
}

void ZoneLedger::clear() { std::fill(sums_.begin(), sums_.end(), 0.0); }

}  // namespace gambeson
