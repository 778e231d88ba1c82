#include "analysis/opensim.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <stdexcept>

#include "analysis/report/html.hpp"
#include "core/io/own_file.hpp"

namespace gambeson {

std::string openSimBody(const std::string& link) {
  static const std::map<std::string, std::string> bodies{{"thigh", "femur"},  {"shank", "tibia"},
                                                         {"foot", "calcn"},   {"upper_arm", "humerus"},
                                                         {"forearm", "ulna"}, {"hand", "hand"}};
  if (link == "head") return "torso";
  for (const auto& [side, letter] : {std::pair{"_left", "_l"}, std::pair{"_right", "_r"}})
    if (link.ends_with(side))
      if (const auto at = bodies.find(link.substr(0, link.size() - std::string(side).size())); at != bodies.end())
        return at->second + letter;
  return link;
}

std::vector<ExternalLoad> externalLoads(const Human& human, const Motion& motion, double motion_start_s,
                                        std::span<const ContactWindow> windows) {
  struct Body {
    std::string name;
    std::vector<std::size_t> links;
  };
  std::vector<Body> bodies;
  for (std::size_t l = 0; l < human.skeleton.links.size(); ++l) {
    if (std::none_of(windows.begin(), windows.end(),
                     [&](const ContactWindow& w) { return w.links.at(l).force_Ns != Vec3{}; }))
      continue;
    const std::string name = openSimBody(human.skeleton.links[l].name);
    const auto at = std::find_if(bodies.begin(), bodies.end(), [&](const Body& b) { return b.name == name; });
    if (at == bodies.end())
      bodies.push_back({name, {l}});
    else
      at->links.push_back(l);
  }
  std::vector<ExternalLoad> loads;
  for (const Body& b : bodies) loads.push_back({b.name, {}, {}, {}});
  for (const ContactWindow& w : windows) {
    const Posture posture = motion.at(w.middle() - motion_start_s);
    const std::vector<Pose> X_WL = linkPoses(human.skeleton, posture.q, posture.root);
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      const Vec3 point = X_WL[bodies[b].links[0]].origin;
      Vec3 force, moment;
      for (const std::size_t l : bodies[b].links) {
        force += w.links[l].force_Ns;
        moment += w.links[l].moment_Nms + cross(X_WL[l].origin - point, w.links[l].force_Ns);
      }
      loads[b].force_N.push_back(openSimGround(force / w.duration()));
      loads[b].point_m.push_back(openSimGround(point));
      loads[b].moment_Nm.push_back(openSimGround(moment / w.duration()));
    }
  }
  return loads;
}

void writeExternalLoads(const std::filesystem::path& prefix, const std::string& name, std::span<const double> time_s,
                        std::span<const ExternalLoad> loads) {
  const std::filesystem::path mot = prefix.string() + ".mot", xml = prefix.string() + ".xml";
  std::string table = fmt::format(
      "{}\nversion=1\nnRows={}\nnColumns={}\ninDegrees=no\n\n"
      "Units are S.I. units (second, meters, Newtons, ...)\nAngles are in radians.\n\nendheader\ntime",
      mot.filename().string(), time_s.size(), 1 + 9 * loads.size());
  for (const ExternalLoad& l : loads) {
    if (l.force_N.size() != time_s.size() || l.point_m.size() != time_s.size() || l.moment_Nm.size() != time_s.size())
      throw std::logic_error("a load needs one value for each time");
    for (const char* part : {"_force_v", "_force_p", "_torque_"})
      for (const char* axis : {"x", "y", "z"}) table += "\t" + l.body + part + axis;
  }
  table += "\n";
  for (std::size_t k = 0; k < time_s.size(); ++k) {
    table += fmt::format("{}", time_s[k]);
    for (const ExternalLoad& l : loads)
      for (const Vec3& v : {l.force_N[k], l.point_m[k], l.moment_Nm[k]})
        table += fmt::format("\t{}\t{}\t{}", v.x, v.y, v.z);
    table += "\n";
  }
  std::string objects;
  for (const ExternalLoad& l : loads) {
    const std::string body = html::escape(l.body);
    objects += fmt::format(
        "      <ExternalForce name=\"cloth_on_{0}\">\n"
        "        <applied_to_body>{0}</applied_to_body>\n"
        "        <force_expressed_in_body>ground</force_expressed_in_body>\n"
        "        <point_expressed_in_body>ground</point_expressed_in_body>\n"
        "        <force_identifier>{0}_force_v</force_identifier>\n"
        "        <point_identifier>{0}_force_p</point_identifier>\n"
        "        <torque_identifier>{0}_torque_</torque_identifier>\n"
        "      </ExternalForce>\n",
        body);
  }
  writeOwnFile(mot, table);
  writeOwnFile(xml, fmt::format("<?xml version=\"1.0\" encoding=\"UTF-8\" ?>\n"
                                       "<OpenSimDocument Version=\"40000\">\n"
                                       "  <ExternalLoads name=\"{}\">\n"
                                       "    <objects>\n{}    </objects>\n"
                                       "    <groups />\n"
                                       "    <datafile>{}</datafile>\n"
                                       "  </ExternalLoads>\n"
                                       "</OpenSimDocument>\n",
                                       html::escape(name), objects, html::escape(mot.filename().string())));
}

}  // namespace gambeson
