#include "analysis/opensim_model.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "analysis/opensim.hpp"
#include "analysis/report/html.hpp"
#include "human/skeleton/limb_angles.hpp"

namespace gambeson {
namespace {

/// Axes of OpenSim's ground in ours: x forward, y up, z to the right.
constexpr Vec3 kForward{1, 0, 0}, kUp{0, 0, 1}, kRight{0, -1, 0};
/// In the order of the root's coordinates.
constexpr std::array<Vec3, 3> kTurns{kRight, kForward, kUp}, kMoves{kForward, kUp, kRight};
constexpr std::array kRootCoordinates{"tilt", "list", "rotation", "tx", "ty", "tz"};

std::string bodyName(const Link& link) { return link.name == "head" ? link.name : openSimBody(link.name); }

std::string triple(const Vec3& v) { return fmt::format("{} {} {}", v.x, v.y, v.z); }

/// Angles of X, Y, Z about the turned axes: R = R(x, a) R(y, b) R(z, c).
std::string bodyAngles(const Mat3& R) {
  const auto [a, b, c] = threeAngles(R, {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}});
  return fmt::format("{} {} {}", a, b, c);
}

/// A rotation that takes unit vector `from` to `to`.
Mat3 turnTo(const Vec3& from, const Vec3& to) {
  if (dot(from, to) > -0.5) return shortestTurn(from, to);
  const Vec3 across = std::abs(from.x) > 0.5 ? Vec3{0, 1, 0} : Vec3{1, 0, 0};  // half a turn first
  return shortestTurn(-from, to) * rotationAbout(across, std::numbers::pi);
}

std::string frame(const std::string& name, const std::string& parent, const Vec3& origin, const Mat3& R) {
  return fmt::format(
      "            <PhysicalOffsetFrame name=\"{}\">\n"
      "              <socket_parent>{}</socket_parent>\n"
      "              <translation>{}</translation>\n"
      "              <orientation>{}</orientation>\n"
      "            </PhysicalOffsetFrame>\n",
      name, parent, triple(origin), bodyAngles(R));
}

std::string coordinate(const std::string& name, const char* motion, double low, double high) {
  std::string range;
  if (std::isfinite(low) && std::isfinite(high)) range = fmt::format("              <range>{} {}</range>\n", low, high);
  return fmt::format(
      "            <Coordinate name=\"{}\">\n"
      "              <!-- {} -->\n"
      "{}              <clamped>false</clamped>\n"
      "            </Coordinate>\n",
      html::escape(name), motion, range);
}

std::string axis(const std::string& name, const std::string& coordinate, const Vec3& direction) {
  return fmt::format(
      "            <TransformAxis name=\"{}\">\n"
      "              <coordinates>{}</coordinates>\n"
      "              <axis>{}</axis>\n"
      "              <LinearFunction name=\"function\"><coefficients>1 0</coefficients></LinearFunction>\n"
      "            </TransformAxis>\n",
      name, html::escape(coordinate), triple(direction));
}

std::string joint(const char* kind, const std::string& name, const std::string& frames, const std::string& coordinates,
                  const std::string& more = "") {
  return fmt::format(
      "        <{0} name=\"{1}\">\n"
      "          <socket_parent_frame>{1}_parent</socket_parent_frame>\n"
      "          <socket_child_frame>{1}_child</socket_child_frame>\n"
      "{2}"
      "          <frames>\n{3}          </frames>\n"
      "{4}"
      "        </{0}>\n",
      kind, name, coordinates.empty() ? "" : "          <coordinates>\n" + coordinates + "          </coordinates>\n",
      frames, more);
}

std::string rootJoint(const Skeleton& s) {
  const std::string body = html::escape(bodyName(s.links[0])), name = "ground_" + body;
  const Mat3 ours{openSimGround({1, 0, 0}), openSimGround({0, 1, 0}), openSimGround({0, 0, 1})};
  std::string coordinates, transform = "          <SpatialTransform>\n";
  for (std::size_t k = 0; k < 6; ++k) {
    const std::string c = bodyName(s.links[0]) + "_" + kRootCoordinates[k];
    coordinates += coordinate(c, k < 3 ? "rad" : "m", -INFINITY, INFINITY);
    transform += k < 3 ? axis(fmt::format("rotation{}", k + 1), c, kTurns[k])
                       : axis(fmt::format("translation{}", k - 2), c, kMoves[k - 3]);
  }
  return joint("CustomJoint", name,
               frame(name + "_parent", "/ground", {}, ours) + frame(name + "_child", "/bodyset/" + body, {}, {}),
               coordinates, transform + "          </SpatialTransform>\n");
}

std::string jointOf(const Skeleton& s, const Joint& j) {
  const std::string name = html::escape(j.name);
  const bool pin = j.type == JointType::revolute, slider = j.type == JointType::prismatic;
  const Mat3 A = pin ? turnTo({0, 0, 1}, j.axis) : slider ? turnTo({1, 0, 0}, j.axis) : Mat3{};
  const auto body = [&](int link) {
    return "/bodyset/" + html::escape(bodyName(s.links[static_cast<std::size_t>(link)]));
  };
  return joint(pin      ? "PinJoint"
               : slider ? "SliderJoint"
                        : "WeldJoint",
               name,
               frame(name + "_parent", body(j.parent), j.X_PJ.origin, j.X_PJ.rotation * A) +
                   frame(name + "_child", body(j.child), {}, A),
               pin || slider ? coordinate(j.name, pin ? "rad" : "m", j.lower, j.upper) : "");
}

double nearest(double angle, double before) {
  return angle + 2 * std::numbers::pi * std::round((before - angle) / (2 * std::numbers::pi));
}

}  // namespace

std::string openSimModel(const Skeleton& s, const std::string& name) {
  std::string bodies, joints = rootJoint(s), couplers;
  for (const Link& l : s.links)
    bodies += fmt::format(
        "        <Body name=\"{}\">\n"
        "          <mass>{}</mass>\n"
        "          <mass_center>{}</mass_center>\n"
        "          <inertia>0 0 0 0 0 0</inertia>\n"
        "        </Body>\n",
        html::escape(bodyName(l)), l.mass_kg, triple(l.center_of_mass));
  for (const Joint& j : s.joints) {
    joints += jointOf(s, j);
    if (!j.mimic_of) continue;
    couplers += fmt::format(
        "        <CoordinateCouplerConstraint name=\"{0}_follows\">\n"
        "          <coupled_coordinates_function>\n"
        "            <LinearFunction><coefficients>{1} {2}</coefficients></LinearFunction>\n"
        "          </coupled_coordinates_function>\n"
        "          <independent_coordinate_names>{3}</independent_coordinate_names>\n"
        "          <dependent_coordinate_name>{0}</dependent_coordinate_name>\n"
        "        </CoordinateCouplerConstraint>\n",
        html::escape(j.name), j.mimic_multiplier, j.mimic_offset,
        html::escape(s.joints[static_cast<std::size_t>(*j.mimic_of)].name));
  }
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\" ?>\n"
      "<OpenSimDocument Version=\"40000\">\n"
      "  <Model name=\"{}\">\n"
      "    <credits>Gambeson. Masses and centres of mass as its body has them, which has no inertia about "
      "these.</credits>\n"
      "    <gravity>0 -9.80665 0</gravity>\n"
      "    <length_units>meters</length_units>\n"
      "    <force_units>N</force_units>\n"
      "    <BodySet name=\"bodyset\">\n      <objects>\n{}      </objects>\n    </BodySet>\n"
      "    <JointSet name=\"jointset\">\n      <objects>\n{}      </objects>\n    </JointSet>\n"
      "    <ConstraintSet name=\"constraintset\">\n      <objects>\n{}      </objects>\n    </ConstraintSet>\n"
      "  </Model>\n"
      "</OpenSimDocument>\n",
      html::escape(name), bodies, joints, couplers);
}

std::vector<std::string> openSimCoordinates(const Skeleton& s) {
  std::vector<std::string> names;
  for (const char* c : kRootCoordinates) names.push_back(bodyName(s.links[0]) + "_" + c);
  for (const Joint& j : s.joints)
    if (j.type != JointType::fixed) names.push_back(j.name);
  return names;
}

std::vector<double> openSimValues(const Skeleton& s, const Posture& posture, std::span<const double> before) {
  // Of the two triples of angles the one whose middle one is within a quarter turn; the outer ones run on.
  const std::array<double, 3> turns = threeAngles(posture.root.rotation, kTurns);
  std::vector<double> values(turns.begin(), turns.end());
  if (!before.empty())
    for (const std::size_t k : {0u, 2u}) values[k] = nearest(values[k], before[k]);
  for (const Vec3& direction : kMoves) values.push_back(dot(direction, posture.root.origin));
  for (std::size_t j = 0; j < s.joints.size(); ++j) {
    const Joint& joint = s.joints[j];
    if (joint.type == JointType::fixed) continue;
    values.push_back(joint.mimic_of ? joint.mimic_multiplier * posture.q[static_cast<std::size_t>(*joint.mimic_of)] +
                                          joint.mimic_offset
                                    : posture.q[j]);
  }
  return values;
}

std::string openSimMotion(const std::string& name, const Skeleton& s, std::span<const double> time_s,
                          std::span<const Posture> postures) {
  if (time_s.size() != postures.size()) throw std::logic_error("a motion needs one posture for each time");
  const std::vector<std::string> names = openSimCoordinates(s);
  std::string text = fmt::format(
      "{}\nversion=1\nnRows={}\nnColumns={}\ninDegrees=no\n\n"
      "Units are S.I. units (second, meters, Newtons, ...)\nAngles are in radians.\n\nendheader\ntime",
      name, time_s.size(), 1 + names.size());
  for (const std::string& n : names) text += "\t" + n;
  text += "\n";
  std::vector<double> before;
  for (std::size_t k = 0; k < time_s.size(); ++k) {
    before = openSimValues(s, postures[k], before);
    text += fmt::format("{}", time_s[k]);
    for (const double v : before) text += fmt::format("\t{}", v);
    text += "\n";
  }
  return text;
}

}  // namespace gambeson
