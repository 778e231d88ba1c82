#include "analysis/contact_table.hpp"

#include <set>
#include <stdexcept>

namespace gambeson {

std::vector<int> segmentLinks(const Human& human) {
  std::set<int> links;
  for (const BodyShape& s : human.shapes) links.insert(s.link);
  return {links.begin(), links.end()};
}

std::vector<ContactShare> contactShares(const Human& human, std::span<const ContactWindow> windows) {
  std::vector<ContactShare> shares;
  double total_Ns = 0, total_s = 0;
  for (const ContactWindow& w : windows) {
    if (w.links.size() != human.skeleton.links.size()) throw std::logic_error("a window needs one impulse per link");
    if (!(w.duration() > 0)) throw std::logic_error("a window must last");
    total_s += w.duration();
  }
  for (const int link : segmentLinks(human)) {
    ContactShare s;
    s.link = link;
    s.segment = human.skeleton.links[static_cast<std::size_t>(link)].name;
    for (const ContactWindow& w : windows) {
      const double impulse = norm(w.links[static_cast<std::size_t>(link)].force_Ns);
      s.impulse_Ns += impulse;
      if (impulse / w.duration() > s.peak_N) {
        s.peak_N = impulse / w.duration();
        s.peak_time_s = w.middle();
      }
    }
    s.mean_N = total_s > 0 ? s.impulse_Ns / total_s : 0;
    total_Ns += s.impulse_Ns;
    shares.push_back(s);
  }
  for (ContactShare& s : shares) s.share = total_Ns > 0 ? s.impulse_Ns / total_Ns : 0;
  return shares;
}

}  // namespace gambeson
