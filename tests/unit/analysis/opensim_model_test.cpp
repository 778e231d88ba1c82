/// The .osim read back: joints as OpenSim defines them, at the coordinates of the .mot, put the bodies where we have
/// them.

#include "analysis/opensim_model.hpp"

#include <gtest/gtest.h>
#include <tinyxml.h>

#include <limits>
#include <map>
#include <random>
#include <sstream>

#include "analysis/opensim.hpp"
#include "human/manikin/manikin.hpp"
#include "human/motion/walk.hpp"
#include "human/recorded/storage.hpp"
#include "unit/human/files/files.hpp"

namespace gambeson {
namespace {

std::vector<double> numbersOf(const TiXmlElement* e) {
  std::istringstream in(e->GetText());
  std::vector<double> v;
  for (double x; in >> x;) v.push_back(x);
  return v;
}
Vec3 tripleOf(const TiXmlElement* e) {
  const std::vector<double> v = numbersOf(e);
  return {v.at(0), v.at(1), v.at(2)};
}

/// Forward kinematics of a model of version 4 in OpenSim's ground, from its joints alone: orientations of frames are
/// turns about x, y, z one after the other, a pin turns about z, a slider goes along x, and a spatial transform turns
/// about its axes one after the other and then moves in the parent's frame.
class OsimKinematics {
 public:
  explicit OsimKinematics(const std::string& text) {
    document_.Parse(text.c_str());
    if (document_.Error()) throw std::runtime_error(document_.ErrorDesc());
    model_ = document_.RootElement()->FirstChildElement("Model");
  }

  std::map<std::string, Pose> at(const std::map<std::string, double>& q) const {
    std::map<std::string, Pose> X_GB{{"/ground", {}}};
    const TiXmlElement* joints = model_->FirstChildElement("JointSet")->FirstChildElement("objects");
    for (const TiXmlElement* j = joints->FirstChildElement(); j; j = j->NextSiblingElement()) {
      std::map<std::string, std::pair<std::string, Pose>> frames;
      const TiXmlElement* list = j->FirstChildElement("frames");
      for (const TiXmlElement* f = list->FirstChildElement(); f; f = f->NextSiblingElement()) {
        const Vec3 o = tripleOf(f->FirstChildElement("orientation"));
        frames[f->Attribute("name")] = {
            f->FirstChildElement("socket_parent")->GetText(),
            {rotationAbout({1, 0, 0}, o.x) * rotationAbout({0, 1, 0}, o.y) * rotationAbout({0, 0, 1}, o.z),
             tripleOf(f->FirstChildElement("translation"))}};
      }
      const auto& [parent, X_PF] = frames.at(j->FirstChildElement("socket_parent_frame")->GetText());
      const auto& [child, X_CM] = frames.at(j->FirstChildElement("socket_child_frame")->GetText());
      X_GB[child] = X_GB.at(parent) * X_PF * moved(*j, q) * inverse(X_CM);
    }
    return X_GB;
  }

  int constraints() const {
    int count = 0;
    const TiXmlElement* set = model_->FirstChildElement("ConstraintSet")->FirstChildElement("objects");
    for (const TiXmlElement* c = set->FirstChildElement(); c; c = c->NextSiblingElement()) ++count;
    return count;
  }

  const TiXmlElement* body(const std::string& name) const {
    const TiXmlElement* set = model_->FirstChildElement("BodySet")->FirstChildElement("objects");
    for (const TiXmlElement* b = set->FirstChildElement(); b; b = b->NextSiblingElement())
      if (b->Attribute("name") == name) return b;
    throw std::runtime_error("no body " + name);
  }

 private:
  static Pose moved(const TiXmlElement& j, const std::map<std::string, double>& q) {
    const std::string kind = j.Value();
    if (kind == "WeldJoint") return {};
    if (kind == "CustomJoint") {
      Pose X;
      const TiXmlElement* transform = j.FirstChildElement("SpatialTransform");
      for (const TiXmlElement* a = transform->FirstChildElement(); a; a = a->NextSiblingElement()) {
        const double value = q.at(a->FirstChildElement("coordinates")->GetText());
        const Vec3 axis = tripleOf(a->FirstChildElement("axis"));
        if (std::string(a->Attribute("name")).starts_with("rotation"))
          X.rotation = X.rotation * rotationAbout(axis, value);
        else
          X.origin += value * axis;
      }
      return X;
    }
    const double value = q.at(j.FirstChildElement("coordinates")->FirstChildElement("Coordinate")->Attribute("name"));
    if (kind == "PinJoint") return {rotationAbout({0, 0, 1}, value), {}};
    if (kind == "SliderJoint") return {{}, {value, 0, 0}};
    throw std::runtime_error("kind of joint: " + kind);
  }

  TiXmlDocument document_;
  const TiXmlElement* model_ = nullptr;
};

std::map<std::string, double> rowOf(const StorageTable& t, std::size_t k) {
  std::map<std::string, double> row;
  for (std::size_t c = 0; c < t.names.size(); ++c) row[t.names[c]] = t.columns[c][k];
  return row;
}

StorageTable readBack(const Skeleton& s, const std::vector<double>& times, const std::vector<Posture>& postures) {
  const test::Folder folder;
  return readStorage(folder.write("walk.mot", openSimMotion("walk.mot", s, times, postures)));
}

/// Largest distance of a point 0.1 m off a link's origin from where we have it, over all links.
double largestError(const Skeleton& s, const std::map<std::string, Pose>& X_GB, const Posture& p,
                    const std::map<std::string, std::string>& names) {
  const std::vector<Pose> X_WL = linkPoses(s, p.q, p.root);
  double most = 0;
  for (std::size_t l = 0; l < X_WL.size(); ++l)
    for (const Vec3& at : {Vec3{}, Vec3{0.1, 0, 0}, Vec3{0, 0.1, 0}})
      most = std::max(most, norm(X_GB.at("/bodyset/" + names.at(s.links[l].name)) * at - openSimGround(X_WL[l] * at)));
  return most;
}

TEST(OpenSimModel, AWalkingManikinIsWhereWeHaveIt) {
  const Human human = makeManikin("male_p50");
  const auto motion = makeWalk(human, {});
  std::vector<double> times;
  std::vector<Posture> postures;
  for (int k = 0; k < 40; ++k) {
    times.push_back(0.037 * k);
    postures.push_back(motion->at(times.back()));
  }
  const Skeleton& s = human.skeleton;
  const StorageTable table = readBack(s, times, postures);
  EXPECT_TRUE(table.notes.empty());
  EXPECT_EQ(table.names, openSimCoordinates(s));
  EXPECT_EQ(table.times, times);
  const OsimKinematics model(openSimModel(s, "a <man> & more"));
  std::map<std::string, std::string> names;
  for (const Link& l : s.links) names[l.name] = l.name == "head" ? "head" : openSimBody(l.name);
  for (std::size_t k = 0; k < times.size(); ++k)
    EXPECT_LT(largestError(s, model.at(rowOf(table, k)), postures[k], names), 1e-6) << times[k];
  const Link& thigh = s.links[static_cast<std::size_t>(s.link("thigh_left"))];
  const TiXmlElement* femur = model.body("femur_l");
  EXPECT_EQ(std::stod(femur->FirstChildElement("mass")->GetText()), thigh.mass_kg);
  EXPECT_EQ(tripleOf(femur->FirstChildElement("mass_center")), thigh.center_of_mass);
  EXPECT_EQ(model.constraints(), 0);
}

/// Joints of all kinds with axes of all directions, also those for which frames must be turned about, and a root that
/// turns around twice: its angle runs on.
TEST(OpenSimModel, JointsOfAllKindsAndDirections) {
  std::mt19937 rng(3);
  std::normal_distribution<double> normal;
  const auto random = [&] { return Vec3{normal(rng), normal(rng), normal(rng)}; };
  Skeleton s{"chain", {{"base", -1, 1, {}}}, {}};
  const std::vector<Vec3> axes{{0, 0, 1},
                               {0, 0, -1},
                               {1, 0, 0},
                               {-1, 0, 0},
                               {0, 1, 0},
                               {0, -1, 0},
                               normalized(random()),
                               normalized(random()),
                               normalized(Vec3{0.01, 0, -1})};
  const auto add = [&](JointType type, const Vec3& axis) {
    const int at = static_cast<int>(s.joints.size());
    Joint j;
    j.name = "j" + std::to_string(at);
    j.type = type;
    j.parent = at / 2, j.child = at + 1;
    j.X_PJ = {rotationAbout(normalized(random()), normal(rng)), 0.3 * random()};
    j.axis = axis;
    j.upper = at == 0 ? std::numeric_limits<double>::infinity() : 2;
    s.joints.push_back(j);
    s.links.push_back({"l" + std::to_string(at), at, 0.5, random()});
  };
  for (const Vec3& axis : axes) add(JointType::revolute, axis), add(JointType::prismatic, axis);
  add(JointType::fixed, {1, 0, 0});
  add(JointType::revolute, {0, 1, 0});
  s.joints.back().mimic_of = 0, s.joints.back().mimic_multiplier = -1.5, s.joints.back().mimic_offset = 0.2;
  std::vector<double> times;
  std::vector<Posture> postures;
  for (int k = 0; k < 24; ++k) {
    times.push_back(0.1 * k);
    Posture p{{}, {rotationAbout({0, 0, 1}, 0.55 * k) * rotationAbout({1, 0, 0}, 0.3), random()}};
    for (std::size_t j = 0; j < s.joints.size(); ++j) p.q.push_back(normal(rng));
    postures.push_back(p);
  }
  const StorageTable table = readBack(s, times, postures);
  const OsimKinematics model(openSimModel(s, "chain"));
  EXPECT_EQ(model.constraints(), 1);
  std::map<std::string, std::string> names;
  for (const Link& l : s.links) names[l.name] = l.name;
  for (std::size_t k = 0; k < times.size(); ++k)
    EXPECT_LT(largestError(s, model.at(rowOf(table, k)), postures[k], names), 1e-6) << times[k];
  const auto column = static_cast<std::size_t>(table.column("base_rotation"));
  for (std::size_t k = 1; k < times.size(); ++k)
    EXPECT_LT(std::abs(table.columns[column][k] - table.columns[column][k - 1]), 2);
}

}  // namespace
}  // namespace gambeson
