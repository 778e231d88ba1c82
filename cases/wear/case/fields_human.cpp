/// Detail of fields.hpp: the table of the human and its motion.

#include "cases/input/table.hpp"
#include "cases/wear/case/case.hpp"
#include "cases/wear/case/fields.hpp"
#include "human/manikin/manikin.hpp"

namespace gambeson::schema {
namespace {

/// A map by its name, or the path of one against the case's folder.
Field mapField(const std::string& doc, const std::string& note) {
  Field f;
  f.key = "map";
  f.kind = Kind::text;
  f.doc = doc;
  f.default_note = note;
  return f;
}
std::string readMap(const Place& p) {
  const std::string word = readText(p);
  return word.find_first_of("./") == std::string::npos ? word : readPath(p).string();
}

Object motionFileTable() {
  using M = MotionFileOptions;
  return Table<M>("Recorded motion")
      .path("path", &M::path, "OpenSim coordinates (.mot, .sto), a hierarchy of bones (.bvh) or markers (.trc)")
      .required()
      .path("model", &M::model, "the subject's scaled OpenSim model (.osim): where markers sit and joints are")
      .defaultsTo("none; markers that are not at joints need it")
      .custom(
          mapField("what its joints, bones or markers are in our human: gait2392, rajagopal, snu_woody, makehuman, "
                   "makehuman_default, unreal, mixamo, gait2392_markers, joint_centres, or a file of one's own "
                   "(human/data/MAPS.md)",
                   "that which goes with the names in the file"),
          [](const Place& p, M& m) { m.map = readMap(p); },
          [](const M& m) { return m.map.empty() ? std::nullopt : std::optional(nodeOf(m.map)); })
      .number("from", &M::from_s, "s", between(-1e6, 1e6), "begin of the window in the file's own time")
      .defaultsTo("its first instant")
      .number("to", &M::to_s, "s", between(-1e6, 1e6), "end of the window")
      .defaultsTo("its last instant")
      .number("stand", &M::stand_s, "s", between(0, 60), "time at rest before the lead-in")
      .number("lead_in", &M::lead_in_s, "s", between(0, 10),
              "from standing into the window; 0: starts in the window's first posture")
      .integer("repeat", &M::repeat, 1, 1000, "a clip of one whole stride is walked so many times")
      .number("slower", &M::slower, "", between(0.1, 10), "the file's time times this")
      .number("scale", &M::scale, "", aboveTo(0, 100), "of the recorded path")
      .defaultsTo("our leg over the subject's; where that is not known, what lets the feet slip least")
      .number("floor", &M::floor_m, "m", between(-100, 100),
              "height of the ground in the file, if its heights are to stand")
      .defaultsTo("the feet are put on the ground")
      .text("forward", &M::forward, "axis of the file's world that one faces, such as x or -y; with up")
      .defaultsTo("that of the map")
      .text("up", &M::up, "axis of the file's world that points up; with forward")
      .defaultsTo("that of the map")
      .choice("heading", &M::heading,
              std::vector<std::pair<std::string, Heading>>{{"keep", Heading::keep}, {"straight", Heading::straight}},
              "turns are kept (the first second faces x), or taken out")
      .choice("travel", &M::travel,
              std::vector<std::pair<std::string, Travel>>{{"file", Travel::file}, {"feet", Travel::feet}},
              "the pelvis goes as in the file, or where the feet take it (treadmills)")
      .number("hips_apart", &M::hips_apart_rad, "rad", between(-0.6, 0.6),
              "abduction of the hips held on top of the recorded one, where our thighs are thicker than the subject's")
      .number("arms_apart", &M::arms_apart_rad, "rad", between(-1.6, 1.6), "likewise of the shoulders")
      .build();
}

Object characterTable() {
  using C = CharacterOptions;
  std::vector<std::pair<std::string, std::string>> manikins;
  for (const std::string& name : manikinNames()) manikins.emplace_back(name, name);
  return Table<C>("Character")
      .path("file", &C::file, "a skinned character (.gltf, .glb, .fbx), or MakeHuman's base mesh (.obj)")
      .required()
      .path("skeleton", &C::skeleton, "skeleton (.mhskel) that goes with MakeHuman's mesh")
      .path("weights", &C::weights, "weights (.mhw) that go with MakeHuman's mesh")
      .list("targets", &C::targets,
            Table<MorphTarget>("Morph target")
                .path("file", &MorphTarget::file, "one of MakeHuman's (.target)")
                .required()
                .number("share", &MorphTarget::share, "", between(-10, 10), "how much of it is added")
                .build(),
            "morphs of MakeHuman's mesh")
      .custom(
          mapField("what its bones are in our human: unreal, mixamo, makehuman_default, or a joint map of one's own "
                   "(\"reads\": \"bones\"; human/data/MAPS.md)",
                   "that which goes with the names of its bones"),
          [](const Place& p, C& c) { c.map = readMap(p); },
          [](const C& c) { return c.map.empty() ? std::nullopt : std::optional(nodeOf(c.map)); })
      .choice("like", &C::like, manikins, "the manikin whose limits of joints and shares of mass it takes")
      .number("height", &C::height_m, "m", between(0.5, 3), "it is scaled to, in the pose of the file")
      .defaultsTo("as the file has it")
      .flag("switch_off_folds", &C::folds_off,
            "where the skin folds into itself at some time of the motion, cloth does not touch it at all; the area is "
            "told either way")
      .number("mass", &C::mass_kg, "kg", aboveTo(0, 500), "of the whole body")
      .defaultsTo("its volume at 1000 kg/m^3")
      .build();
}

Object motionTable() {
  using Motions = decltype(HumanCase::motion);
  const auto self = [](auto& m) -> auto& { return m; };
  using W = WalkOptions;
  using S = StairOptions;
  using A = AimOptions;
  return Table<Motions>("Motion")
      .alternative<StandMotion>("stand", self,
                                Table<StandMotion>("Standing")
                                    .number("duration", &StandMotion::duration_s, "s", aboveTo(0, 600), "how long")
                                    .build(),
                                "stands still")
      .in("motion")
      .alternative<WalkOptions>(
          "walk", self,
          Table<W>("Walking")
              .number("stand", &W::stand_s, "s", between(0, 60), "time at rest before the first step")
              .number("lead_in", &W::lead_in_s, "s", between(0.1, 10), "smooth start from standing into the stride")
              .integer("strides", &W::strides, 1, 100, "full strides (two steps each) after the lead-in")
              .integer("paces", &W::paces, 0, 200,
                       "single steps after the lead-in, in place of strides; 0: strides count")
              .number("stride_time", &W::stride_time_s, "s", between(0.5, 3), "time of one stride")
              .build(),
          "walks at natural speed")
      .in("motion")
      .alternative<StairOptions>(
          "stairs", self,
          Table<S>("Climbing stairs")
              .number("stand", &S::stand_s, "s", between(0, 60), "time at rest before the first step")
              .number("lead_in", &S::lead_in_s, "s", between(0.2, 2.1),
                      "the first step, from standing; 0.4 to 0.7 of stride_time")
              .integer("strides", &S::strides, 1, 100, "full strides (two steps each) after the lead-in")
              .integer("lead_in_strides", &S::lead_in_strides, 0, 99,
                       "how many of the strides come before what is measured; fewer than strides")
              .number("stride_time", &S::stride_time_s, "s", between(0.5, 3), "time of one stride")
              .check([](const Place& p, const S& o) {
                if (!(o.lead_in_s >= 0.4 * o.stride_time_s && o.lead_in_s <= 0.7 * o.stride_time_s))
                  p.failAt("lead_in", "must be 0.4 to 0.7 of stride_time");
                if (o.lead_in_strides >= o.strides) p.failAt("lead_in_strides", "must be fewer than strides");
              })
              .build(),
          "climbs stairs; rise and tread are those that the legs and the steps imply")
      .in("motion")
      .alternative<AimOptions>(
          "aim", self,
          Table<A>("Taking aim")
              .number("stand", &A::stand_s, "s", between(0, 60), "time at low ready before it")
              .number("duration", &A::duration_s, "s", between(0.2, 60), "from low ready to aiming at the ground")
              .number("hold", &A::hold_s, "s", between(0, 60), "time aiming after it")
              .number("rifle", &A::rifle_mass_kg, "kg", between(0, 50),
                      "mass of the rifle; it enters the natural moments, not contact")
              .build(),
          "takes aim at the ground, leaning left, from low ready")
      .in("motion")
      .alternative<TrajectoryMotion>(
          "trajectory", self,
          Table<TrajectoryMotion>("Trajectory")
              .path("file", &TrajectoryMotion::file,
                    "CSV with a column time_s and one per joint, such as hip_flexion_left_deg")
              .required()
              .build(),
          "moves its joints as a file says")
      .in("motion")
      .alternative<MotionFileOptions>("file", self, motionFileTable(), "moves as a person was recorded")
      .in("motion")
      .oneOf("motion", true)
      .build();
}

}  // namespace

Object humanTable() {
  using H = HumanCase;
  std::vector<std::pair<std::string, std::string>> manikins;
  for (const std::string& name : manikinNames()) manikins.emplace_back(name, name);
  return Table<H>("Human")
      .choice("manikin", &H::manikin, manikins, "one of our own humans, by sex and percentile of stature")
      .in("who")
      .path("urdf", &H::urdf, "skeleton of a human of your own")
      .in("who")
      .object("character", &H::character, characterTable(), "a skinned character from a file, in any pose")
      .in("who")
      .oneOf("who", true)
      .path("body", &H::body, "body file that goes with urdf: ellipsoids per link")
      .defaultsTo("the geometry in the URDF")
      .object("skin", &H::skin,
              Table<SkinOptions>("Skin")
                  .number("cell", &SkinOptions::cell_m, "m", between(0.006, 0.05), "edges where garments lie")
                  .number("crease_gap", &SkinOptions::crease_gap_m, "m", between(0, 0.02),
                          "what stays between the two sides of a fold, at hips, knees, elbows and shoulders")
                  .build(),
              "a closed skin around the manikin that bends with its joints, in place of its ellipsoids")
      .object("motion", &H::motion, motionTable(), "what the human does")
      .required()
      .check([](const Place& p, const H& h) {
        if (h.skin && h.manikin.empty())
          p.failAt("skin", "is made around a manikin, not around a body of your own or a character");
        if (h.urdf.empty() && !h.body.empty()) p.failAt("body", "goes with \"urdf\"; a manikin has its own body");
      })
      .build();
}

}  // namespace gambeson::schema
