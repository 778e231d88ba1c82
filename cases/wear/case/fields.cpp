#include "cases/wear/case/fields.hpp"

#include <fmt/format.h>

#include "cases/cloth/fabric_input.hpp"
#include "cases/cloth/fields.hpp"
#include "cases/cloth/motion_fields.hpp"
#include "cases/contact/fields.hpp"
#include "cases/input/table.hpp"
#include "cases/wear/case/case.hpp"

namespace gambeson::schema {
namespace {

Object airTable() {
  using A = AirCase;
  Field velocity;
  velocity.key = "velocity";
  velocity.kind = Kind::vector;
  velocity.unit = "m/s";
  velocity.range = between(-100, 100);
  velocity.choices = {"pelvis_mean"};
  velocity.doc =
      "of the air; pelvis_mean: the air moves with the pelvis's mean velocity, as if the human walked on the spot";
  return Table<A>("Air")
      .number("drag", &A::drag_kg_per_m2s, "kg/(m^2 s)", between(0, 1e3),
              "force per area and relative velocity, eta of Zheng 2013")
      .custom(
          velocity,
          [velocity](const Entry& p, A& air) {
            air.with_pelvis = p.node.type == JsonNode::Type::text;
            if (air.with_pelvis)
              readChoice(p, velocity.choices);
            else
              air.velocity_m_per_s = readVector(p, velocity.unit, velocity.range);
          },
          [](const A& air) {
            return std::optional(air.with_pelvis ? nodeOf(std::string("pelvis_mean")) : nodeOf(air.velocity_m_per_s));
          })
      .build();
}

Object factorsTable() {
  using F = FactorsCase;
  const Range range = between(0.01, 100);
  return Table<F>("Factors")
      .number("thickness", &F::thickness, "", range,
              "of all cloth: mass and membrane stiffness change in proportion, the rigidities of bending, twist and "
              "seams with the cube; the contact layer follows the thickness; the drag coefficient stays")
      .number("bending", &F::bending, "", range, "of the rigidities of bending and twist, and of seam_stiffness")
      .number("membrane", &F::membrane, "", range, "of Young's and the shear moduli; bending stays")
      .number("weight", &F::weight, "", range, "of the acceleration of free fall")
      .number("inertia", &F::inertia, "", range, "of the density; free fall is divided by it, so that the weight stays")
      .number("drag", &F::drag, "", range, "of the drag coefficient")
      .number("friction", &F::friction, "", range, "of every coefficient of friction, and of viscosity")
      .unwritten()
      .build();
}

Object dressingTable() {
  using P = Projecting;
  using D = DressingCase;
  return Table<D>("Dressing")
      .object("projecting", &D::projecting,
              Table<P>("Projecting")
                  .number("clearance", &P::clearance_m, "m", aboveTo(0, 0.2),
                          "free distance between garment and shrunk body at the start")
                  .number("grow", &P::grow_s, "s", between(0.01, 60), "time in which the body grows back")
                  .build(),
              "virtual projecting: the body shrinks until the garment is free, then grows back into it")
      .defaultsTo("none: the garment starts free of the body")
      .flag("layer_by_layer", &D::layer_by_layer,
            "each garment is put on the bare body by itself (by stitching where it says so, else by projecting), then "
            "all are worn together and freed of each other, the first innermost")
      .path("from", &D::from, "dressed state that gambeson dress, or a run in its folder as dressed.json, left")
      .defaultsTo("none: the garments are put on")
      .choice("history", &D::history,
              std::vector<std::pair<std::string, DressedHistory>>{{"kept", DressedHistory::kept},
                                                                  {"wiped", DressedHistory::wiped}},
              "what fabrics that remember their folds (bending.law) know of being put on when all are worn: kept, or "
              "wiped, as if they were new there")
      .unwritten()
      .number("settle", &D::settle_s, "s", between(0, 60),
              "time at rest on the body before the motion starts; 0 without a human")
      .build();
}

Object timeTable() {
  using T = TimeCase;
  return Table<T>("Time")
      .number("duration", &T::duration_s, "s", aboveTo(0, 3600), "how long the motion is followed, after dressing")
      .defaultsTo("the motion's own; required without a human")
      .number("step_safety", &T::step_safety, "", aboveTo(0, 1),
              "time step as a part of the largest stable one; at most 0.7 to 0.8 where the highest modes swing far")
      .number("max_step", &T::max_step_s, "s", between(1e-8, 0.01), "largest time step")
      .choice("scheme", [](auto& t) -> auto& { return t.motion.scheme; }, motionSchemes(), motionSchemesDoc())
      .unwritten()
      .number("step", &T::step_s, "s", between(0, 0.01),
              "every time step, stable or not, in place of step_safety and max_step; 0: none is given")
      .unwritten()
      .integer("substeps", [](auto& t) -> auto& { return t.motion.substeps; }, 1, 1000,
               "semi_implicit: explicit steps of bending in each step, the thesis's alpha; a step is so many times as "
               "long as bending alone allows, at most max_step")
      .unwritten()
      .number("solve_tolerance", [](auto& t) -> auto& { return t.motion.solve_tolerance; }, "", between(1e-14, 1e-2),
              "implicit_euler, semi_implicit: what conjugate gradients may leave of the impulses, in the "
              "preconditioner's norm; the impulse that they miss is a row of the momentum balance")
      .unwritten()
      .flag("audit", &T::audit,
            "verlet keeps account of what it makes or takes of energy itself, one more evaluation of the energy a "
            "step; the other schemes always do")
      .unwritten()
      .check([](const Entry& p, const T& t) {
        const T standard;
        const auto only = [&](const char* key, bool given, bool allowed, const char* with) {
          if (given && !allowed) p.failAt(key, fmt::format("has no meaning for this scheme; it goes with {}", with));
        };
        const MotionScheme s = t.motion.scheme;
        only("substeps", t.motion.substeps != standard.motion.substeps, s == MotionScheme::semi_implicit,
             "semi_implicit");
        only("solve_tolerance", t.motion.solve_tolerance != standard.motion.solve_tolerance, isImplicit(s),
             "implicit_euler and semi_implicit");
        only("audit", t.audit, s == MotionScheme::verlet, "verlet; the other schemes always keep account");
      })
      .build();
}

Object analysisTable() {
  using A = AnalysisCase;
  return Table<A>("Analysis")
      .texts("joints", &A::joints, "joints whose torque is reported, such as hip_flexion_left")
      .defaultsTo("every joint that moves")
      .choice("counting", &A::counting,
              std::vector<std::pair<std::string, Counting>>{{"distal_segment", Counting::distal_segment},
                                                            {"all_distal", Counting::all_distal}},
              "contact forces that count for a joint: on the segment just beyond it (Man 2006, chapter 5), or on all "
              "beyond it")
      .choice("task", &A::task,
              std::vector<std::pair<std::string, Task>>{{"none", Task::none},
                                                        {"natural_walk", Task::natural_walk},
                                                        {"natural_stairs", Task::natural_stairs},
                                                        {"aiming", Task::aiming}},
              "natural moments that torques are compared with")
      .defaultsTo("by the motion: natural_walk for walk, natural_stairs for stairs, aiming for aim, else none")
      .build();
}

Object makeCaseTable() {
  using C = Case;
  // A single garment need not be a list.
  Field garment, garments;
  garment.key = "garment";
  garment.kind = Kind::object;
  garment.object = std::make_shared<const Object>(garmentTable());
  garment.alternatives = garments.alternatives = "garments";
  garment.doc = "what is worn: its shape and how finely it is computed";
  garments.key = "garments";
  garments.kind = Kind::list;
  garments.object = garment.object;
  garments.doc = "several garments worn over each other, innermost first, each with its own number";
  Field fabric;
  fabric.key = "fabric";
  fabric.kind = Kind::object;
  fabric.object = std::make_shared<const Object>(fabricTable());
  fabric.doc = "what garments without a fabric of their own are made of";
  fabric.default_note = "required, or a fabric in each garment";
  Field kind;
  kind.key = "kind";
  kind.kind = Kind::choice;
  kind.choices = {"wear"};
  kind.default_note = "wear";
  kind.doc = "what the case is; the other kinds have fields of their own";
  return Table<C>("Case", "a garment on a moving human, or cloth among obstacles, followed in time")
      .custom(
          kind, [choices = kind.choices](const Entry& p, C&) { readChoice(p, choices); },
          [](const C&) { return std::optional<JsonNode>(); })
      .text("name", &C::name, "title of the pictures and the report")
      .required()
      .text("description", &C::description, "what the case is about")
      .vector("gravity", &C::gravity_m_per_s2, "m/s^2", between(-1e3, 1e3), "acceleration of free fall")
      .custom(
          garment,
          [o = garment.object](const Entry& p, C& c) {
            c.garments.clear();
            readObject(*o, p, &c.garments.emplace_back());
          },
          [o = garment.object](const C& c) {
            return c.garments.size() == 1 ? std::optional(writeObject(*o, &c.garments[0])) : std::nullopt;
          })
      .custom(
          garments,
          [o = garment.object](const Entry& p, C& c) {
            c.garments.clear();
            readItems(p, "objects", [&](const Entry& item) { readObject(*o, item, &c.garments.emplace_back()); });
            if (c.garments.empty()) p.fail("the list is empty; allowed: at least one garment");
          },
          [o = garment.object](const C& c) -> std::optional<JsonNode> {
            if (c.garments.size() < 2) return std::nullopt;
            JsonNode n = emptyList();
            for (const GarmentCase& g : c.garments) n.children.push_back(writeObject(*o, &g));
            return n;
          })
      .oneOf("garments", true)
      .custom(
          fabric,
          [o = fabric.object](const Entry& p, C& c) {
            FabricInput in;
            readObject(*o, p, &in);
            c.fabric = resolveFabric(p, in);
          },
          [o = fabric.object](const C& c) -> std::optional<JsonNode> {
            if (std::all_of(c.garments.begin(), c.garments.end(), [](const GarmentCase& g) { return g.fabric; }))
              return std::nullopt;
            const FabricInput in = restoreFabric(c.fabric);
            return writeObject(*o, &in);
          })
      .object("human", &C::human, humanTable(), "who wears it, and the motion")
      .defaultsTo("nobody")
      .list("obstacles", &C::obstacles, obstacleTable(), "other things that the cloth touches")
      .list("supports", &C::supports, supportTable(), "what holds the garment")
      .object("contact", &C::contact, contactTable(), "how cloth touches")
      .defaultsTo("required with a human, obstacles or several garments")
      .object("strain_limit", &C::strain_limit, strainLimitTable(),
              "keeps weft and warp from stretching by projection (Zheng 2013, chapter 5), "
              "so that the fabric may be given soft threads, and with them long time steps")
      .defaultsTo("none: the fabric's own stiffness")
      .object("air", &C::air, airTable(), "drag of the air")
      .object("factors", &C::factors, factorsTable(),
              "multiples of what the case says of its cloth, for variants: thinner, without weight, ...")
      .object("dressing", &C::dressing, dressingTable(), "how the garment gets on the body")
      .object("time", &C::time, timeTable(), "how long, and in which steps")
      .object("output", &C::output, outputTable(), "what is recorded and pictured")
      .object("analysis", &C::analysis, analysisTable(), "which torques, and compared with what")
      .object("comfort", &C::comfort, comfortTable(),
              "what a wearer accepts; suggestions for a first look, to be replaced by the limits of one's own field")
      .build();
}

}  // namespace

const Object& caseTable() {
  static const Object table = makeCaseTable();
  return table;
}

}  // namespace gambeson::schema
