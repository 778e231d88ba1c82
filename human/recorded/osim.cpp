#include "human/recorded/osim.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <sstream>

#include "core/error.hpp"
#include "human/body/urdf_check.hpp"
#include "human/files/read_text.hpp"

namespace gambeson {
namespace {

constexpr std::uintmax_t largest_file = std::uintmax_t{32} << 20;

struct Reader {
  std::string file;

  [[noreturn]] void fail(const TiXmlElement& e, const std::string& reason) const {
    throw InputError({file, e.Row(), e.Value()}, reason);
  }
  const TiXmlElement& child(const TiXmlElement& e, const char* name) const {
    const TiXmlElement* c = e.FirstChildElement(name);
    if (!c) fail(e, fmt::format("has no <{}>", name));
    return *c;
  }
  static std::string text(const TiXmlElement& e) {
    const char* t = e.GetText();
    std::string s = t ? t : "";
    s.erase(0, std::min(s.find_first_not_of(" \t\r\n"), s.size()));
    s.erase(s.find_last_not_of(" \t\r\n") + 1);
    return s;
  }
  std::vector<double> numbers(const TiXmlElement& e) const {
    std::istringstream in(text(e));
    std::vector<double> out;
    for (std::string word; in >> word;) {
      double value = 0;
      if (!parseNumber(word, value)) fail(e, fmt::format("'{}' is not a finite number", word.substr(0, 40)));
      out.push_back(value);
    }
    return out;
  }
  double one(const TiXmlElement& e) const {
    const auto v = numbers(e);
    if (v.size() != 1) fail(e, fmt::format("has {} numbers, not 1", v.size()));
    return v[0];
  }
  Vec3 triple(const TiXmlElement& e) const {
    const auto v = numbers(e);
    if (v.size() != 3) fail(e, fmt::format("has {} numbers, not 3", v.size()));
    return {v[0], v[1], v[2]};
  }
  std::string name(const TiXmlElement& e) const {
    const char* n = e.Attribute("name");
    if (!n || !*n) fail(e, "has no name");
    return n;
  }

  OsimFunction function(const TiXmlElement& f) const {
    const std::string kind = f.Value();
    if (kind == "function") {  // version 2 wraps it
      const TiXmlElement* inner = f.FirstChildElement();
      return inner ? function(*inner) : OsimFunction{{0}, {0}, 0};
    }
    if (kind == "Constant") return {{0}, {one(child(f, "value"))}, 0};
    if (kind == "LinearFunction") {
      const auto c = numbers(child(f, "coefficients"));
      if (c.size() != 2) fail(f, "needs two coefficients");
      return {{0}, {c[1]}, c[0]};
    }
    if (kind == "MultiplierFunction") {
      OsimFunction inner = function(child(f, "function"));
      const TiXmlElement* scale = f.FirstChildElement("scale");
      const double s = scale ? one(*scale) : 1;
      for (double& y : inner.y) y *= s;
      inner.slope *= s;
      return inner;
    }
    if (kind == "SimmSpline" || kind == "NaturalCubicSpline" || kind == "PiecewiseLinearFunction" ||
        kind == "natCubicSpline" || kind == "GCVSpline") {
      OsimFunction out{numbers(child(f, "x")), numbers(child(f, "y")), 0};
      if (out.x.empty() || out.x.size() != out.y.size() || !std::is_sorted(out.x.begin(), out.x.end()))
        fail(f, "needs as many x, ascending, as y");
      return out;
    }
    fail(f, "this kind of function is not read");
  }

  /// translation1 to translation3 of a joint.
  void translations(const TiXmlElement& joint, OsimBody& body) const {
    body.translation.fill({{0}, {0}, 0});
    const TiXmlElement* transform = joint.FirstChildElement("SpatialTransform");
    if (!transform) return;
    for (const TiXmlElement* a = transform->FirstChildElement("TransformAxis"); a;
         a = a->NextSiblingElement("TransformAxis")) {
      const std::string which = name(*a);
      if (!which.starts_with("translation") || which.size() != 12) continue;
      const Vec3 axis = triple(child(*a, "axis"));
      int k = -1;
      for (int i = 0; i < 3; ++i)
        if (axis[i] == 1) k = i;
      if (k < 0) fail(*a, "translates along an axis that is none of x, y, z: not read");
      const TiXmlElement* f = nullptr;
      for (const TiXmlElement* c = a->FirstChildElement(); c; c = c->NextSiblingElement())
        if (std::string(c->Value()) != "coordinates" && std::string(c->Value()) != "axis") f = c;
      if (f) body.translation[k] = function(*f);
    }
  }

  /// Version 2 and 3: <Body><Joint><CustomJoint> <parent_body> <location_in_parent> ...
  void nestedJoint(const TiXmlElement& b, OsimBody& body) const {
    const TiXmlElement* outer = b.FirstChildElement("Joint");
    const TiXmlElement* joint = outer ? outer->FirstChildElement() : nullptr;
    if (!joint) return;
    body.parent = text(child(*joint, "parent_body"));
    body.joint_in_parent = triple(child(*joint, "location_in_parent"));
    if (const TiXmlElement* l = joint->FirstChildElement("location"); l && norm(triple(*l)) > 0)
      body.joint_in_parent = body.joint_in_parent - triple(*l);  // both frames parallel at angles of 0
    for (const char* turn : {"orientation_in_parent", "orientation"})
      if (const TiXmlElement* o = joint->FirstChildElement(turn)) body.turned = body.turned || norm(triple(*o)) > 0;
    translations(*joint, body);
  }

  /// Version 4: <JointSet><objects><CustomJoint> with sockets that name PhysicalOffsetFrames.
  void jointSet(const TiXmlElement& set, OsimModel& model) const {
    const TiXmlElement& objects = child(set, "objects");
    for (const TiXmlElement* j = objects.FirstChildElement(); j; j = j->NextSiblingElement()) {
      const TiXmlElement* frames = j->FirstChildElement("frames");
      bool turned = false;
      const auto frame = [&](const char* socket, std::string& body, Vec3& at) {
        std::string named = text(child(*j, socket));
        for (const TiXmlElement* f = frames ? frames->FirstChildElement() : nullptr; f; f = f->NextSiblingElement())
          if (name(*f) == named) {
            named = text(child(*f, "socket_parent"));
            if (const TiXmlElement* t = f->FirstChildElement("translation")) at = triple(*t);
            if (const TiXmlElement* o = f->FirstChildElement("orientation")) turned = turned || norm(triple(*o)) > 0;
            break;
          }
        body = named.substr(named.rfind('/') + 1);
      };
      std::string parent, own;
      Vec3 in_parent, in_own;
      frame("socket_parent_frame", parent, in_parent);
      frame("socket_child_frame", own, in_own);
      const auto found = model.bodies.find(own);
      if (found == model.bodies.end()) fail(*j, fmt::format("joins a body '{}' that is not there", own));
      found->second.parent = parent;
      found->second.turned = turned;
      found->second.joint_in_parent = in_parent - in_own;
      translations(*j, found->second);
    }
  }
};

}  // namespace

double OsimFunction::at(double value) const {
  if (x.size() == 1) return y[0] + slope * value;
  const std::size_t i = std::clamp<std::size_t>(
      static_cast<std::size_t>(std::upper_bound(x.begin(), x.end(), value) - x.begin()), 1, x.size() - 1);
  const double width = x[i] - x[i - 1];  // 0: a step
  const double u = width > 0 ? std::clamp((value - x[i - 1]) / width, 0.0, 1.0) : 1;
  return (1 - u) * y[i - 1] + u * y[i];
}

Vec3 OsimBody::originAt(double value) const {
  assert(!turned);
  return joint_in_parent + Vec3{translation[0].at(value), translation[1].at(value), translation[2].at(value)};
}

const OsimBody& OsimModel::body(const std::string& name) const {
  const auto found = bodies.find(name);
  if (found == bodies.end()) throw InputError({file, 0, ""}, "the model has no body '" + name + "'");
  if (found->second.turned)
    throw InputError({file, 0, name},
                     "the frames of its joint are turned against the bodies, which is not read: use OpenSim's inverse "
                     "kinematics and its .mot file");
  return found->second;
}

OsimModel readOsim(const std::filesystem::path& path) {
  const Reader r{path.string()};
  const std::string source = readText(path, largest_file);
  TiXmlDocument document;
  parseXml(document, source, r.file);
  const TiXmlElement* root = document.RootElement();
  if (!root || std::string(root->Value()) != "OpenSimDocument")
    throw InputError({r.file, root ? root->Row() : 0, ""}, "is no OpenSim model: its root must be <OpenSimDocument>");
  const TiXmlElement& m = r.child(*root, "Model");
  OsimModel model;
  model.file = r.file;
  const TiXmlElement& bodies = r.child(r.child(m, "BodySet"), "objects");
  for (const TiXmlElement* b = bodies.FirstChildElement("Body"); b; b = b->NextSiblingElement("Body")) {
    OsimBody body;
    body.translation.fill({{0}, {0}, 0});
    r.nestedJoint(*b, body);
    if (!model.bodies.emplace(r.name(*b), std::move(body)).second)
      r.fail(*b, fmt::format("'{}' stands twice", r.name(*b)));
  }
  if (const TiXmlElement* joints = m.FirstChildElement("JointSet"); joints && joints->FirstChildElement("objects"))
    r.jointSet(*joints, model);
  if (const TiXmlElement* set = m.FirstChildElement("MarkerSet"); set && set->FirstChildElement("objects")) {
    const TiXmlElement& markers = r.child(*set, "objects");
    for (const TiXmlElement* k = markers.FirstChildElement("Marker"); k; k = k->NextSiblingElement("Marker")) {
      const TiXmlElement* of = k->FirstChildElement("body");
      if (!of) of = k->FirstChildElement("socket_parent_frame");
      if (!of) r.fail(*k, "names no body");
      const std::string named = r.text(*of), body = named.substr(named.rfind('/') + 1);
      const auto found = model.bodies.find(body);
      if (found == model.bodies.end()) r.fail(*k, fmt::format("sits on a body '{}' that is not there", body));
      if (!found->second.markers.emplace(r.name(*k), r.triple(r.child(*k, "location"))).second)
        r.fail(*k, fmt::format("'{}' stands twice", r.name(*k)));
    }
  }
  return model;
}

}  // namespace gambeson
