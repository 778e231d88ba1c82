#include "cases/wear/scene/contact_regions.hpp"

#include <algorithm>
#include <limits>

namespace gambeson {
namespace {

/// Fills contact_groups and contact_group from the regions; `press` has an entry for each region.
void groupContact(Scenario& s, const std::vector<std::string>& garment_names, const std::vector<Press>& press) {
  for (std::size_t i = 0; i < s.contact_region.size(); ++i) {
    const int patch = s.model->surface.patch[i];
    const ContactGroup group{
        garment_names[static_cast<std::size_t>(s.model->cloth->patches()[static_cast<std::size_t>(patch)].garment)],
        press[static_cast<std::size_t>(s.contact_region[i])]};
    const auto at = std::find(s.contact_groups.begin(), s.contact_groups.end(), group);
    s.contact_group.push_back(static_cast<int>(at - s.contact_groups.begin()));
    if (at == s.contact_groups.end()) s.contact_groups.push_back(group);
  }
}

}  // namespace

void nameContactRegions(Scenario& s, const std::vector<Garment>& garments, const std::vector<int>& first,
                        const std::vector<Vec3>& q) {
  const Surface& surface = s.model->surface;
  std::vector<Vec3> x(static_cast<std::size_t>(surface.size()));
  surface.W.multiply<Vec3>(q, x);
  s.contact_regions = s.patch_names;
  s.contact_region = surface.patch;
  std::vector<Press> press(s.patch_names.size(), Press::free);
  std::vector<std::string> garment_names;
  for (std::size_t k = 0; k < garments.size(); ++k) {
    const std::string& called = s.definition.garments[k].name;
    garment_names.push_back(!called.empty() ? called : !garments[k].name.empty() ? garments[k].name : "garment");
  }
  for (std::size_t k = 0; k < garments.size(); ++k) {
    if (garments[k].name != "belt") continue;
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (std::size_t i = 0; i < x.size(); ++i)
      if (surface.patch[i] >= first[k] && surface.patch[i] < first[k + 1])
        low = std::min(low, x[i].z), high = std::max(high, x[i].z);
    const int region = static_cast<int>(s.contact_regions.size());
    std::fill(press.begin() + first[k], press.begin() + first[k + 1], Press::belt);
    press.push_back(Press::belt);
    s.contact_regions.push_back("under " + s.patch_names[static_cast<std::size_t>(first[k])]);
    for (std::size_t i = 0; i < x.size(); ++i)
      if (s.model->cloth->patches()[static_cast<std::size_t>(surface.patch[i])].garment < static_cast<int>(k) &&
          x[i].z >= low && x[i].z <= high)
        s.contact_region[i] = region;
  }
  for (const SupportGroup& group : s.supports) {
    if (group.springs.empty()) continue;
    for (const int i : group.samples)
      s.contact_region[static_cast<std::size_t>(i)] = static_cast<int>(s.contact_regions.size());
    s.contact_regions.push_back(group.name);
    press.push_back(Press::held);
  }
  groupContact(s, garment_names, press);
}

}  // namespace gambeson
