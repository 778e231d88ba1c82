/// Skeletons from URDF through urdfdom.

#include "human/body/urdf.hpp"

#include <console_bridge/console.h>
#include <fmt/format.h>
#include <urdf_parser/urdf_parser.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "core/error.hpp"
#include "core/io/apart.hpp"
#include "human/body/ground.hpp"
#include "human/body/tessellate.hpp"
#include "human/body/urdf_check.hpp"
#include "human/files/mesh.hpp"
#include "human/files/read_text.hpp"

namespace gambeson {
namespace {

constexpr std::uintmax_t largest_file = std::uintmax_t{16} << 20;

/// Collects what urdfdom would print, while it lives.
class UrdfdomMessages : public console_bridge::OutputHandler {
 public:
  UrdfdomMessages() { console_bridge::useOutputHandler(this); }
  ~UrdfdomMessages() override { console_bridge::restorePreviousOutputHandler(); }
  void log(const std::string& text, console_bridge::LogLevel level, const char*, int) override {
    if (level >= console_bridge::CONSOLE_BRIDGE_LOG_ERROR) errors.append(errors.empty() ? "" : "; ").append(text);
  }
  std::string errors;
};

Vec3 vec(const urdf::Vector3& v) { return {v.x, v.y, v.z}; }

/// Columns of the rotation of a unit quaternion.
Mat3 matrix(const urdf::Rotation& q) {
  const double x = q.x, y = q.y, z = q.z, w = q.w;
  return {{1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)},
          {2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)},
          {2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)}};
}
Pose pose(const urdf::Pose& p) { return {matrix(p.rotation), vec(p.position)}; }

/// "package://NAME/PATH" is looked for as NAME/PATH, then PATH, in the folders above the URDF; other names are relative
/// to it.
std::filesystem::path resolve(std::string name, const std::filesystem::path& folder) {
  if (name.starts_with("file://")) return name.substr(7);
  if (!name.starts_with("package://")) return folder / name;
  name = name.substr(10);
  const std::string inside = name.substr(std::min(name.find('/') + 1, name.size()));
  for (std::filesystem::path up = std::filesystem::absolute(folder);; up = up.parent_path()) {
    if (std::filesystem::exists(up / name)) return up / name;
    if (std::filesystem::exists(up / inside)) return up / inside;
    if (up == up.root_path()) return folder / name;
  }
}

TriangleMesh scaledMesh(const urdf::Mesh& m, const std::filesystem::path& folder) {
  if (!(m.scale.x * m.scale.y * m.scale.z != 0)) throw InputError({m.filename, 0, "scale"}, "must not be 0");
  TriangleMesh mesh = loadMesh(resolve(m.filename, folder));
  for (Vec3& v : mesh.vertices) v = {m.scale.x * v.x, m.scale.y * v.y, m.scale.z * v.z};
  if (m.scale.x * m.scale.y * m.scale.z < 0)
    for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

void addShapes(Human& human, int link, const urdf::Link& l, const std::filesystem::path& folder) {
  const std::size_t before = human.shapes.size();
  for (const auto& visual : l.visual_array) {
    BodyShape s{link, l.name, Ellipsoid{}, pose(visual->origin)};
    if (human.shapes.size() > before) s.name += fmt::format("_{}", human.shapes.size() - before);
    const urdf::Geometry& g = *visual->geometry;
    if (g.type == urdf::Geometry::SPHERE) {
      const double r = static_cast<const urdf::Sphere&>(g).radius;
      s.shape = Ellipsoid{{r, r, r}};
    } else if (g.type == urdf::Geometry::BOX) {
      const Vec3 size = vec(static_cast<const urdf::Box&>(g).dim);
      if (size == Vec3{}) continue;  // no body (see urdf_check.cpp)
      s.shape = boxMesh(size);
    } else if (g.type == urdf::Geometry::CYLINDER) {
      const auto& c = static_cast<const urdf::Cylinder&>(g);
      s.shape = cylinderMesh(c.radius, c.length);
    } else {
      s.shape = scaledMesh(static_cast<const urdf::Mesh&>(g), folder);
    }
    human.shapes.push_back(std::move(s));
  }
}

Link linkOf(const urdf::Link& l, int parent_joint) {
  Link link{l.name, parent_joint, 0, {}};
  if (l.inertial) {
    link.mass_kg = l.inertial->mass;
    link.center_of_mass = vec(l.inertial->origin.position);
  }
  return link;
}

Joint jointOf(const urdf::Joint& j) {
  Joint out;
  out.name = j.name;
  out.X_PJ = pose(j.parent_to_joint_origin_transform);
  if (j.type == urdf::Joint::FIXED) return out;
  out.type = j.type == urdf::Joint::PRISMATIC ? JointType::prismatic : JointType::revolute;
  const Vec3 axis = vec(j.axis);
  out.axis = std::abs(norm(axis) - 1) < 1e-15 ? axis : normalized(axis);
  const double inf = std::numeric_limits<double>::infinity();
  const bool endless = j.type == urdf::Joint::CONTINUOUS;
  out.lower = endless ? -inf : j.limits->lower;
  out.upper = endless ? inf : j.limits->upper;
  return out;
}

/// Mimic joints that follow mimic joints follow the first that moves by itself: q_k = m_k (m_j q_i + o_j) + o_k.
void resolveMimics(Skeleton& s, const urdf::ModelInterface& model) {
  for (Joint& j : s.joints) {
    const urdf::Joint* at = model.joints_.at(j.name).get();
    double multiplier = 1, offset = 0;
    while (at->mimic) {
      offset += multiplier * at->mimic->offset;
      multiplier *= at->mimic->multiplier;
      at = model.joints_.at(at->mimic->joint_name).get();
    }
    if (at->name == j.name) continue;
    j.mimic_of = s.joint(at->name);
    j.mimic_multiplier = multiplier;
    j.mimic_offset = offset;
  }
}

/// Highest minus lowest point of the surface in the zero posture.
double heightOf(const Human& human) {
  const auto X_WL = linkPoses(human.skeleton, std::vector<double>(human.skeleton.joints.size()), {});
  Mat3 upside_down;  // turned by half a turn about x, the lowest point is the highest
  upside_down.b = {0, -1, 0}, upside_down.c = {0, 0, -1};
  std::vector<Pose> turned;
  for (const Pose& X : X_WL) turned.push_back(Pose{upside_down, {}} * X);
  return -lowestHeight(human, turned) - lowestHeight(human, X_WL);
}

}  // namespace

Human loadUrdf(const std::filesystem::path& urdf) {
  const std::string file = urdf.string(), text = readText(urdf, largest_file);
  TiXmlDocument document;
  parseXml(document, text, file);
  const UrdfOrder order = checkUrdf(document, file);

  // Whatever urdfdom makes of it happens to another process first.
  readApart(urdf, limitsFor(urdf), [&](BytesOut&) {
    UrdfdomMessages dropped;
    try {
      urdf::parseURDF(text);
    } catch (const std::exception&) {  // said below
    }
  });
  UrdfdomMessages messages;
  urdf::ModelInterfaceSharedPtr model;
  try {
    model = urdf::parseURDF(text);
  } catch (const std::exception& e) {
    throw InputError({file, 0, ""}, std::string("urdfdom refuses it: ") + e.what());
  }
  if (!model) throw InputError({file, 0, ""}, "urdfdom refuses it: " + messages.errors);

  Human human;
  Skeleton& s = human.skeleton;
  s.name = model->getName();
  std::string root = order.root;
  std::vector<std::string> names = order.joints;
  // A floating joint at the root says that the root's child moves freely, as our root link does: the world link goes.
  if (!names.empty() && model->joints_.at(names.front())->type == urdf::Joint::FLOATING) {
    if (!model->getLink(root)->visual_array.empty() || model->getLink(root)->inertial)
      throw InputError({file, lineOf(document, "link", root), root},
                       "a root above a floating joint can have neither mass nor shape");
    root = model->joints_.at(names.front())->child_link_name;
    names.erase(names.begin());
  }
  s.links.push_back(linkOf(*model->getLink(root), -1));
  addShapes(human, 0, *model->getLink(root), urdf.parent_path());
  std::map<std::string, int> index{{root, 0}};
  for (const std::string& name : names) {
    const urdf::Joint& j = *model->joints_.at(name);
    Joint joint = jointOf(j);
    joint.parent = index.at(j.parent_link_name);
    joint.child = index[j.child_link_name] = static_cast<int>(s.links.size());
    s.links.push_back(linkOf(*model->getLink(j.child_link_name), static_cast<int>(s.joints.size())));
    s.joints.push_back(std::move(joint));
    addShapes(human, s.joints.back().child, *model->getLink(j.child_link_name), urdf.parent_path());
  }
  resolveMimics(s, *model);
  for (const Link& l : s.links) human.mass_kg += l.mass_kg;
  if (!human.shapes.empty()) human.stature_m = heightOf(human);
  return human;
}

std::vector<std::filesystem::path> filesBesideUrdf(const std::filesystem::path& urdf) {
  TiXmlDocument document;
  parseXml(document, readText(urdf, largest_file), urdf.string());
  checkUrdf(document, urdf.string());
  std::vector<std::filesystem::path> out;
  TiXmlHandle root(document.RootElement());
  for (auto* link = root.FirstChild("link").Element(); link; link = link->NextSiblingElement("link"))
    for (auto* v = link->FirstChildElement("visual"); v; v = v->NextSiblingElement("visual")) {
      auto* mesh = TiXmlHandle(v).FirstChild("geometry").FirstChild("mesh").Element();
      if (!mesh) continue;
      out.push_back(resolve(mesh->Attribute("filename"), urdf.parent_path()));
      for (std::filesystem::path& file : filesBeside(out.back())) out.push_back(std::move(file));
    }
  return out;
}

}  // namespace gambeson
