/// Detail of fields.hpp: the tables of solvers.

#include <fmt/format.h>

#include "cases/cloth/motion_fields.hpp"
#include "cases/input/table.hpp"
#include "cases/structure/fields.hpp"

namespace gambeson::schema {
namespace {

template <class M>
auto statics(M StaticOptions::*member) {
  return [member](auto& c) -> auto& { return c.statics.*member; };
}
template <class M>
auto dynamics(M DynamicOptions::*member) {
  return [member](auto& c) -> auto& { return c.dynamics.*member; };
}
template <class M>
auto modal(M ModalOptions::*member) {
  return [member](auto& c) -> auto& { return c.modal.*member; };
}
template <class M>
auto damping(M DampingCase::*member) {
  return [member](auto& c) -> auto& { return c.damping.*member; };
}

void addNewton(Table<StructureCase>& table) {
  table
      .integer("steps", statics(&StaticOptions::steps), 1, 100000,
               "equal load steps from factor 0 to 1; with arc_length the first step is 1/steps of the load")
      .integer("halvings", statics(&StaticOptions::halvings), 0, 30, "how often a step that fails is halved")
      .integer("iterations", statics(&StaticOptions::iterations), 1, 1000, "Newton iterations of a step")
      .number("tolerance", statics(&StaticOptions::tolerance), "", between(1e-14, 1e-2),
              "residual force as a part of the forces that balance (loads, reactions)");
}

/// The schemes of unknowns and those that step points, in one list of words; `explicit` is velocity Verlet.
struct SchemeWord {
  std::string word;
  TimeScheme scheme;
  MotionScheme motion;
};
std::vector<SchemeWord> schemeWords() {
  std::vector<SchemeWord> words{{"generalised_alpha", TimeScheme::generalised_alpha, {}},
                                {"newmark", TimeScheme::newmark, {}}};
  for (const auto& [word, scheme] : motionSchemes())
    words.push_back({scheme == MotionScheme::verlet ? "explicit" : word, TimeScheme::points, scheme});
  return words;
}

Field schemeField() {
  Field f;
  f.key = "scheme";
  f.kind = Kind::choice;
  for (const SchemeWord& w : schemeWords()) f.choices.push_back(w.word);
  f.doc =
      "generalised_alpha: implicit, second order, damps only the highest frequencies; newmark: implicit (Man 2006, box "
      "2); explicit: central differences (velocity Verlet; Newmark's with beta 0 and gamma 1/2), small steps; euler, rk2, rk4, implicit_euler, semi_implicit: as "
      "time.scheme of worn cloth";
  return f;
}
void readScheme(const Entry& p, StructureCase& c) {
  const std::vector<SchemeWord> words = schemeWords();
  const SchemeWord& w = words[static_cast<std::size_t>(readChoice(p, schemeField().choices))];
  c.dynamics.scheme = w.scheme;
  c.dynamics.motion.scheme = w.motion;
}
std::optional<JsonNode> writeScheme(const StructureCase& c) {
  for (const SchemeWord& w : schemeWords())
    if (w.scheme == c.dynamics.scheme && (w.scheme != TimeScheme::points || w.motion == c.dynamics.motion.scheme))
      return nodeOf(w.word);
  return std::nullopt;
}

}  // namespace

Object staticSolverTable() {
  Table<StructureCase> table("Static solver");
  table.flag("linear", statics(&StaticOptions::linear), "small displacements: one solve about the rest shape");
  addNewton(table);
  return table
      .flag("arc_length", statics(&StaticOptions::arc_length),
            "follows the path through limit points, where the load must fall (snap-through)")
      .number("largest_arc", statics(&StaticOptions::largest_arc_m), "m", between(0, 1e9),
              "arc length: no control point moves farther in a step; 0: as far as the path is nearly straight, and at "
              "most four times the first step")
      .integer("max_points", statics(&StaticOptions::max_points), 1, 1000000, "points of the path, arc length only")
      .number("stop_factor", statics(&StaticOptions::stop_factor), "", between(-1e6, 1e6),
              "arc length ends where the factor first reaches this")
      .check([](const Entry& p, const StructureCase& c) {
        if (c.statics.linear && c.statics.arc_length) p.failAt("arc_length", "contradicts linear; give one of them");
        const StaticOptions standard;
        if (!c.statics.arc_length && c.statics.largest_arc_m != standard.largest_arc_m)
          p.failAt("largest_arc", "goes with \"arc_length\": true");
        if (!c.statics.arc_length && c.statics.max_points != standard.max_points)
          p.failAt("max_points", "goes with \"arc_length\": true");
        if (!c.statics.arc_length && c.statics.stop_factor != standard.stop_factor)
          p.failAt("stop_factor", "goes with \"arc_length\": true");
      })
      .build();
}

Object dynamicSolverTable() {
  using D = DynamicOptions;
  return Table<StructureCase>("Dynamic solver")
      .custom(schemeField(), readScheme, writeScheme)
      .number("end", dynamics(&D::end_s), "s", aboveTo(0, 1e9), "time at which it ends")
      .required()
      .number("step", dynamics(&D::step_s), "s", between(0, 1e9),
              "time step; 0 takes safety times the stable step of schemes that have one")
      .defaultsTo("required for generalised_alpha, newmark and implicit_euler, and for euler and rk2 without damping; "
                  "else 0")
      .number("safety", dynamics(&D::safety), "", aboveTo(0, 1), "part of the stable step that is taken")
      .number("spectral_radius", dynamics(&D::spectral_radius), "", between(0, 1),
              "generalised_alpha: what is left of an infinite frequency after a step; 1 damps nothing")
      .integer("substeps", [](auto& c) -> auto& { return c.dynamics.motion.substeps; }, 1, 1000,
               "semi_implicit: explicit steps of bending in each step")
      .unwritten()
      .number("solve_tolerance", [](auto& c) -> auto& { return c.dynamics.motion.solve_tolerance; }, "",
              between(1e-14, 1e-2), "implicit_euler, semi_implicit: what conjugate gradients may leave of the impulses")
      .unwritten()
      .number("beta", dynamics(&D::beta), "", between(0, 1), "newmark")
      .number("gamma", dynamics(&D::gamma), "", between(0.5, 1), "newmark; above 1/2 it damps")
      .integer("iterations", dynamics(&D::iterations), 1, 1000, "Newton iterations of a step")
      .number("tolerance", dynamics(&D::tolerance), "", between(1e-14, 1e-2),
              "residual as a part of the forces that balance")
      .choice("mass", dynamics(&D::lumped_mass),
              std::vector<std::pair<std::string, bool>>{{"consistent", false}, {"lumped", true}},
              "schemes but generalised_alpha and newmark always lump")
      .number("rayleigh_mass", damping(&DampingCase::mass_per_s), "1/s", between(0, 1e12), "a in the damping a M + b K")
      .number("rayleigh_stiffness", damping(&DampingCase::stiffness_s), "s", between(0, 1e12),
              "b in the damping a M + b K")
      .number("drag", damping(&DampingCase::drag_kg_per_m2s), "kg/(m^2 s)", between(0, 1e9),
              "force per area and velocity, eta of Zheng 2013")
      .check([](const Entry& p, const StructureCase& c) {
        const MotionScheme motion = c.dynamics.motion.scheme;
        const bool points = c.dynamics.stepsPoints();
        if (!points && !(c.dynamics.step_s > 0))
          p.failAt("step", "is required for implicit schemes; allowed: > 0 s");
        if (points && motion == MotionScheme::implicit_euler && !(c.dynamics.step_s > 0))
          p.failAt("step", "is required for implicit_euler, which no step bounds; allowed: > 0 s");
        if (points && (motion == MotionScheme::euler || motion == MotionScheme::midpoint) &&
            !(c.dynamics.step_s > 0 || c.damping.mass_per_s > 0 || c.damping.drag_kg_per_m2s > 0))
          p.failAt("step",
                   "is required for euler and rk2 without damping, which let motion grow in steps of any length; "
                   "allowed: > 0 s");
        if (!(c.dynamics.step_s <= c.dynamics.end_s))
          p.failAt("step", fmt::format("{} s is out of range; allowed: at most end = {} s", c.dynamics.step_s,
                                       c.dynamics.end_s));
        const DynamicOptions standard;
        const auto only = [&](const char* key, double D::*member, TimeScheme scheme, const char* name) {
          if (c.dynamics.scheme != scheme && c.dynamics.*member != standard.*member)
            p.failAt(key, fmt::format("has no meaning for this scheme; it goes with {}", name));
        };
        if (c.dynamics.safety != standard.safety && !(points && motion != MotionScheme::implicit_euler))
          p.failAt("safety", "has no meaning for this scheme; it goes with explicit and the schemes beside it");
        if (c.dynamics.motion.substeps != standard.motion.substeps &&
            !(points && motion == MotionScheme::semi_implicit))
          p.failAt("substeps", "has no meaning for this scheme; it goes with semi_implicit");
        if (c.dynamics.motion.solve_tolerance != standard.motion.solve_tolerance && !(points && isImplicit(motion)))
          p.failAt("solve_tolerance",
                   "has no meaning for this scheme; it goes with implicit_euler and semi_implicit");
        only("spectral_radius", &D::spectral_radius, TimeScheme::generalised_alpha, "generalised_alpha");
        only("beta", &D::beta, TimeScheme::newmark, "newmark");
        only("gamma", &D::gamma, TimeScheme::newmark, "newmark");
        if (c.dynamics.scheme == TimeScheme::newmark) {
          // Below, the scheme is only conditionally stable (Hughes 2000, table 9.1.1).
          const double least = 0.25 * (c.dynamics.gamma + 0.5) * (c.dynamics.gamma + 0.5);
          if (!(c.dynamics.beta >= least * (1 - 1e-12)))
            p.failAt("beta",
                     fmt::format("{} is out of range; allowed: >= (gamma + 1/2)^2 / 4 = {}, where every step is stable",
                                 c.dynamics.beta, least));
        }
      })
      .build();
}

Object modalSolverTable() {
  using M = ModalOptions;
  Table<StructureCase> table("Modal solver");
  table.integer("count", modal(&M::count), 1, 1000, "how many of the lowest frequencies")
      .choice("at", modal(&M::at_equilibrium),
              std::vector<std::pair<std::string, bool>>{{"rest", false}, {"equilibrium", true}},
              "rest: about the rest shape without loads; equilibrium: about the one that the loads give at factor 1")
      .choice("mass", modal(&M::lumped_mass),
              std::vector<std::pair<std::string, bool>>{{"consistent", false}, {"lumped", true}}, "mass matrix");
  addNewton(table);
  return table
      .check([](const Entry& p, const StructureCase& c) {
        if (c.modal.at_equilibrium) return;
        const StaticOptions standard;
        const auto goes = [&](const char* key, auto StaticOptions::*member) {
          if (c.statics.*member != standard.*member) p.failAt(key, "goes with \"at\": \"equilibrium\"");
        };
        goes("steps", &StaticOptions::steps);
        goes("halvings", &StaticOptions::halvings);
        goes("iterations", &StaticOptions::iterations);
        goes("tolerance", &StaticOptions::tolerance);
      })
      .build();
}

}  // namespace gambeson::schema
