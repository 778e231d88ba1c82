/// Detail of fields.hpp: the table of the human and its motion.

#include <fmt/format.h>

#include <cmath>

#include "cases/input/mistakes.hpp"
#include "cases/input/table.hpp"
#include "cases/input/typed.hpp"
#include "cases/wear/case/case.hpp"
#include "cases/wear/case/fields.hpp"
#include "cases/wear/case/fields_map.hpp"
#include "cases/wear/case/motions/kind.hpp"
#include "human/manikin/manikin.hpp"
#include "human/manikin/odd_measures.hpp"

namespace gambeson::schema {
namespace {

std::vector<std::pair<std::string, std::string>> manikinWords() {
  std::vector<std::pair<std::string, std::string>> words;
  for (const std::string& name : manikinNames()) words.emplace_back(name, name);
  return words;
}

Object characterTable() {
  using C = CharacterOptions;
  return Table<C>("Character")
      .path("file", &C::file, "a skinned character (.gltf, .glb, .fbx), or MakeHuman's base mesh (.obj)")
      .required()
      .path("skeleton", &C::skeleton, "skeleton (.mhskel) that goes with MakeHuman's mesh")
      .path("weights", &C::weights, "weights (.mhw) that go with MakeHuman's mesh")
      .list("targets", &C::targets,
            Table<MorphTarget>("Morph target")
                .path("file", &MorphTarget::file, "one of MakeHuman's (.target)")
                .required()
                .number("share", &MorphTarget::amount, "", between(-10, 10), "how much of it is added")
                .build(),
            "morphs of MakeHuman's mesh")
      .custom(
          mapField("what its bones are in our human: unreal, mixamo, makehuman_default, or a joint map of one's own "
                   "(\"reads\": \"bones\"; human/data/MAPS.md)",
                   "that which goes with the names of its bones"),
          [](const Entry& p, C& c) { c.map = readMap(p); },
          [](const C& c) { return c.map.empty() ? std::nullopt : std::optional(nodeOf(c.map)); })
      .choice("like", &C::like, manikinWords(), "the manikin whose limits of joints and shares of mass it takes")
      .number("height", &C::height_m, "m", between(0.5, 3), "it is scaled to, in the pose of the file")
      .defaultsTo("as the file has it")
      .number("bridge_folds", &C::bridge_folds_m, "m", between(0, 0.05),
              "where the skin comes nearer to itself than this in the course of the motion, or passes through itself, "
              "its surface goes across the mouth of the fold meanwhile, so that cloth is not pinched in it: 10 mm is "
              "room for a sleeve under an arm; 0 leaves the skin as it is")
      .number("mass", &C::mass_kg, "kg", aboveTo(0, 500), "of the whole body")
      .defaultsTo("its volume at 1000 kg/m^3")
      .build();
}

/// Says every measure that goes with no body, all in the units that they were typed in.
void checkMeasures(const Entry& p, const ManikinMeasures& m) {
  const auto typed = [&](const std::string& key, double si) {
    return inUnitOf(p, key, si, key == "mass" ? "kg" : "m");
  };
  Mistakes mistakes;
  for (const OddMeasure& o : oddMeasures(m))
    mistakes.without([&] {
      const bool mass = o.key == "mass";
      const double per = mass ? 10 : 1000;  // tenths of a kilogram, millimetres, within the range
      p.failAt(o.key,
               fmt::format("{} goes with no body of {}{}; allowed: {} to {}", typed(o.key, o.value),
                           typed("stature", m.stature_m), mass ? "" : " and " + typed("mass", m.mass_kg),
                           typed(o.key, std::ceil(per * o.least) / per), typed(o.key, std::floor(per * o.most) / per)));
    });
  mistakes.say();
}

Object measuresTable() {
  using M = ManikinMeasures;
  return Table<M>("Manikin by measures")
      .choice("sex", &M::sex, std::vector<std::pair<std::string, Sex>>{{"male", Sex::male}, {"female", Sex::female}},
              "whose regressions of measures on stature and mass hold (ANSUR II)")
      .required()
      .number("stature", &M::stature_m, "m", between(1.3, 2.2), "height")
      .required()
      .number("mass", &M::mass_kg, "kg", between(25, 250), "of the whole body")
      .required()
      .number("chest", &M::chest_m, "m", between(0.4, 2.5), "girth of the chest by the tape, below the arms")
      .defaultsTo("the breadth and depth of people of that stature and mass")
      .number("waist", &M::waist_m, "m", between(0.4, 2.5), "girth at the height of the navel")
      .defaultsTo("likewise")
      .number("hip", &M::hip_m, "m", between(0.4, 2.5), "girth at the height of the hip joints")
      .defaultsTo("likewise")
      .number("inseam", &M::inseam_m, "m", between(0.3, 1.5), "height of the crotch")
      .defaultsTo("that of people of that stature and mass")
      .check([](const Entry& p, const M& m) { checkMeasures(p, m); })
      .build();
}

/// A manikin by name, or by measures.
void addManikin(Table<HumanCase>& table) {
  Field field = fieldOf("manikin", Kind::word_or_object, "", {},
                        "one of our own humans, by sex and percentile of stature, or by a person's measures");
  field.choices = manikinNames();
  field.object = std::make_shared<const Object>(measuresTable());
  table.custom(
      field,
      [o = field.object, names = field.choices](const Entry& p, HumanCase& h) {
        if (p.node.type == JsonNode::Type::object)
          readObject(*o, p, &h.measures.emplace());
        else
          h.manikin = names[readChoice(p, names)];
      },
      [o = field.object](const HumanCase& h) -> std::optional<JsonNode> {
        if (h.measures) return writeObject(*o, &*h.measures);
        return h.manikin.empty() ? std::nullopt : std::optional(nodeOf(h.manikin));
      });
  table.in("who");
}

Object scanTable() {
  using S = ScanOptions;
  std::vector<std::pair<std::string, std::string>> axes;
  for (const char* word : {"x", "-x", "y", "-y", "z", "-z"}) axes.emplace_back(word, word);
  return Table<S>("Body scan")
      .path("file", &S::file, "the surface of a body that stands in an A- or T-pose (.obj, .ply, .stl, .gltf, .glb)")
      .required()
      .number("height", &S::height_m, "m", between(0.5, 3), "it is scaled to")
      .defaultsTo("as the file has it, in the unit in which it is 1.2 to 2.3 m tall")
      .choice("up", &S::up, axes, "axis of the file that is up")
      .defaultsTo("found: feet at one end, a head at the other")
      .choice("facing", &S::facing, axes, "axis of the file that the body looks along")
      .defaultsTo("found: where the toes point")
      .number(
          "close_holes", &S::close_holes, "", between(0, 1),
          "holes are closed whose rim is at most this share of the body's height long, or twice that where it is flat")
      .choice("like", &S::like, manikinWords(), "the manikin whose limits of joints and shares of mass it takes")
      .number("bridge_folds", &S::bridge_folds_m, "m", between(0, 0.05), "as of a character")
      .number("mass", &S::mass_kg, "kg", aboveTo(0, 500), "of the whole body")
      .defaultsTo("its volume at 1000 kg/m^3")
      .build();
}

/// Segments between markers, unwritten where there are none.
void addSegments(Table<HumanCase>& table) {
  using S = MarkedSegment;
  Field field = fieldOf("segments", Kind::list, "", {},
                        "ellipsoids between markers (Man 2006, 5.1), which nothing joins; with the motion \"markers\"");
  field.object = std::make_shared<const Object>(
      Table<S>("Segment between markers")
          .text("name", &S::name,
                "of the segment, a link of the human; its joints are NAME_x, _y, _z, NAME_pitch, _roll and _yaw")
          .required()
          .texts("upper_joint", &S::J1, "markers whose mean is the joint at its upper end: J1 of the thesis")
          .required()
          .texts("lower_joint", &S::J2, "markers whose mean is the joint at its lower end: J2")
          .required()
          .texts("marker", &S::M, "markers whose mean lies beside the line of the joints, always on the same side: M")
          .required()
          .vector("semi_axes", &S::semi_axes_m, "m", above(0),
                  "of its ellipsoid: along the bone, towards the marker, across both")
          .required()
          .build());
  table.custom(
      field,
      [o = field.object](const Entry& p, HumanCase& h) {
        if (p.node.type != JsonNode::Type::list || p.node.children.empty())
          p.fail("expected a list [ ] of one segment or more, not " + describe(p.node));
        h.segments.clear();
        for (std::size_t i = 0; i < p.node.children.size(); ++i) readObject(*o, p.item(i), &h.segments.emplace_back());
      },
      [o = field.object](const HumanCase& h) -> std::optional<JsonNode> {
        if (h.segments.empty()) return std::nullopt;
        JsonNode list = emptyList();
        for (const MarkedSegment& segment : h.segments) list.children.push_back(writeObject(*o, &segment));
        return list;
      });
  table.in("who");
}

Object motionTable() {
  Table<MotionKind::Options> table("Motion");
  for (const MotionKind* kind : motionKinds()) {
    kind->addTo(table);
    table.in("motion");
  }
  return table.oneOf("motion", true).build();
}

}  // namespace

Object humanTable() {
  using H = HumanCase;
  Table<H> table("Human");
  addManikin(table);
  table.path("urdf", &H::urdf, "skeleton of a human of your own")
      .in("who")
      .object("character", &H::character, characterTable(), "a skinned character from a file, in any pose")
      .in("who")
      .object("scan", &H::scan, scanTable(), "a body scan from a file, without a skeleton")
      .in("who");
  addSegments(table);
  return table.oneOf("who", true)
      .path("body", &H::body, "body file that goes with urdf: ellipsoids per link")
      .defaultsTo("the geometry in the URDF")
      .object("skin", &H::skin,
              Table<SkinOptions>("Skin")
                  .number("cell", &SkinOptions::cell_m, "m", between(0.006, 0.05), "edges where garments lie")
                  .number("crease_gap", &SkinOptions::crease_gap_m, "m", between(0, 0.02),
                          "what stays between the two sides of a fold, at hips, knees, elbows and shoulders")
                  .build(),
              "a closed skin around the manikin that bends with its joints, in place of its ellipsoids")
      .object(
          "feet", &H::feet,
          Table<FeetLeftOut>("Feet left out")
              .number("back", &FeetLeftOut::back_s, "s", between(-60, 600), "when they begin to come back")
              .number("grow", &FeetLeftOut::grow_s, "s", between(0.01, 10), "from then on they grow to their size")
              .build(),
          "feet that cloth does not touch at first, so that trousers can be pulled up over the legs; pictures leave "
          "them out until they come back")
      .defaultsTo("they are there at all times")
      .object("motion", &H::motion, motionTable(), "what the human does")
      .required()
      .check([](const Entry& p, const H& h) {
        if (h.skin && h.manikin.empty() && !h.measures)
          p.failAt("skin", "is made around a manikin, not around a body of your own, a character or a scan");
        if (h.feet && (h.skin || h.character || h.scan))
          p.failAt("feet", "can be left out of a body whose surface is shapes on its links, not of a skin");
        const bool follows_markers = std::holds_alternative<MarkersOptions>(h.motion);
        if (!h.segments.empty() && !follows_markers)
          p.failAt("segments", "are moved by markers alone; allowed with them: the motion \"markers\"");
        if (follows_markers && h.segments.empty())
          p.failAt("motion", "\"markers\" moves \"segments\" between markers; other bodies take markers by \"file\"");
        if (h.urdf.empty() && !h.body.empty()) p.failAt("body", "goes with \"urdf\"; a manikin has its own body");
      })
      .build();
}

}  // namespace gambeson::schema
