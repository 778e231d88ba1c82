#include "cases/contact/fields.hpp"

#include <fmt/format.h>

#include <set>

#include "cases/contact/obstacles/kind.hpp"
#include "cases/input/table.hpp"

namespace gambeson::schema {

namespace {

const Range coefficient = between(0, 5);

Object frictionTable() {
  using F = FrictionLaw;
  return Table<F>("Friction")
      .number("kinetic", &F::kinetic, "", coefficient, "mu_c, of what slips fast")
      .required()
      .number("static", &F::still, "", coefficient, "mu_s, that holds what sticks (Wong 2014, chapter 7)")
      .defaultsTo("kinetic")
      .number("stribeck_speed", &F::stribeck_m_per_s, "m/s", between(0, 100),
              "v_S of mu = kinetic + (static - kinetic) exp(-(v/v_S)^power), how friction falls from one to the other "
              "(Stribeck); 0: at once")
      .number("stribeck_power", &F::stribeck_power, "", aboveTo(0, 10),
              "its power; below 1 friction falls at once a little")
      .number("viscosity", &F::viscosity, "", between(0, 1e6),
              "traction that slipping at 1 m/s costs beside, whatever the pressure [Pa]")
      .number("viscous_power", &F::viscous_power, "", aboveTo(0, 10), "the power of the speed with which it goes")
      .number("pressure", &F::pressure_Pa, "Pa", between(0, 1e7),
              "p_1 of the factor (p/p_1)^(pressure_power - 1) on both coefficients; 0: none")
      .number("pressure_power", &F::pressure_power, "", aboveTo(0, 2),
              "n of that factor; fibres that flatten have 0.7 to 1. Pressures below p_1/100 count as that")
      .number("along_warp", &F::along_warp, "", {.low = 0, .high = 100, .low_open = true},
              "factor on both coefficients where the cloth slips along its warp; along the weft 1, between them an "
              "ellipse")
      .check([](const Entry& p, F& f) {
        if (!p.node.find("static")) f.still = f.kinetic;
        if (!(f.still >= f.kinetic))
          p.failAt("static", fmt::format("{} is out of range; allowed: at least kinetic, {}", f.still, f.kinetic));
        if (f.pressure_power != 1 && !(f.pressure_Pa > 0))
          p.failAt("pressure", "is required with pressure_power; allowed: > 0");
      })
      .build();
}

/// Rows [time in s, values ...] with that many values, times ascending.
std::vector<std::vector<double>> readRows(const Entry& p, std::size_t values, double largest) {
  if (p.node.type != JsonNode::Type::list || p.node.children.empty())
    p.fail("expected a list of rows [time, ...], not " + describe(p.node));
  std::vector<std::vector<double>> rows;
  for (std::size_t i = 0; i < p.node.children.size(); ++i) {
    const Entry row = p.item(i);
    rows.push_back(readNumbers(row, "", between(-largest, largest)));
    if (rows.back().size() != values + 1)
      row.fail(fmt::format("has {} numbers; expected a time and {} more", rows.back().size(), values));
    if (i > 0 && !(rows[i][0] > rows[i - 1][0]))
      row.fail(fmt::format("{} s does not come after {} s; allowed: ascending", rows[i][0], rows[i - 1][0]));
  }
  return rows;
}

template <class Rows>
JsonNode nodeOfRows(const Rows& rows) {
  JsonNode node = emptyList();
  for (const auto& row : rows) node.children.push_back(nodeOfList(row));
  return node;
}

}  // namespace

Object driveTable() {
  using D = Drive;
  Table<D> table("Drive");
  Field velocity =
      fieldOf("velocity", Kind::lists, "", between(-1e4, 1e4),
              "rows [time in s, x, y, z in m/s], linear between them: at rest before the first, the last after it");
  velocity.default_note = "none";
  table.custom(
      velocity,
      [](const Entry& p, D& d) {
        for (const std::vector<double>& row : readRows(p, 3, 1e4)) {
          d.velocity_m_per_s.time_s.push_back(row[0]);
          d.velocity_m_per_s.value.push_back({row[1], row[2], row[3]});
        }
      },
      [](const D& d) -> std::optional<JsonNode> {
        if (d.velocity_m_per_s.empty()) return std::nullopt;
        std::vector<std::vector<double>> rows;
        for (std::size_t k = 0; k < d.velocity_m_per_s.time_s.size(); ++k) {
          const Vec3& v = d.velocity_m_per_s.value[k];
          rows.push_back({d.velocity_m_per_s.time_s[k], v.x, v.y, v.z});
        }
        return nodeOfRows(rows);
      });
  Field spin =
      fieldOf("spin", Kind::lists, "", between(-1e4, 1e4), "rows [time in s, rad/s] about axis, in the same way");
  spin.default_note = "none";
  table.custom(
      spin,
      [](const Entry& p, D& d) {
        for (const std::vector<double>& row : readRows(p, 1, 1e4)) {
          d.spin_rad_per_s.time_s.push_back(row[0]);
          d.spin_rad_per_s.value.push_back(row[1]);
        }
      },
      [](const D& d) -> std::optional<JsonNode> {
        if (d.spin_rad_per_s.empty()) return std::nullopt;
        std::vector<std::vector<double>> rows;
        for (std::size_t k = 0; k < d.spin_rad_per_s.time_s.size(); ++k)
          rows.push_back({d.spin_rad_per_s.time_s[k], d.spin_rad_per_s.value[k]});
        return nodeOfRows(rows);
      });
  return table.direction("axis", &D::axis, "of the spin")
      .vector("center", &D::center_m, "m", between(-1e3, 1e3), "a point of that axis at the start; it moves along")
      .check([](const Entry& p, const D& d) {
        if (d.empty()) p.fail("gives neither velocity nor spin; allowed: one of them or both");
      })
      .build();
}

FrictionLaw readFriction(const Entry& p) {
  if (p.node.type != JsonNode::Type::object) return readNumber(p, "", coefficient);
  static const Object table = frictionTable();
  FrictionLaw law;
  readObject(table, p, &law);
  return law;
}

JsonNode writeFriction(const FrictionLaw& law) {
  static const Object table = frictionTable();
  return law.isCoulomb() ? nodeOf(law.kinetic) : writeObject(table, &law);
}

Field frictionField(const char* key, const std::string& doc) {
  Field f = fieldOf(key, Kind::number_or_object, "", coefficient, doc);
  f.object = std::make_shared<const Object>(frictionTable());
  return f;
}

Object obstacleTable() {
  using O = ObstacleCase;
  Table<O> table("Obstacle");
  table.text("name", &O::name, "what the tables call it").required();
  for (const ObstacleKind* kind : obstacleKinds()) {
    kind->addTo(table);
    table.in("shape");
  }
  table.oneOf("shape", true).vector("velocity", &O::velocity_m_per_s, "m/s", between(-100, 100), "constant velocity");
  driveField(table, &O::drive, "how it is moved over time, beside its constant velocity");
  ownFriction(table, "friction", &O::friction, "between cloth and this obstacle");
  return table.build();
}

namespace {

const std::vector<std::pair<std::string, ContactMethod>>& contactMethods() {
  static const std::vector<std::pair<std::string, ContactMethod>> words{
      {"together", ContactMethod::together},
      {"penalty", ContactMethod::penalty},
      {"forward_increment", ContactMethod::forward_increment},
      {"projection", ContactMethod::projection}};
  return words;
}

const char* contactMethodDoc() {
  return "how contacts with bodies are found. together: all contacts of a step as one problem. The others are the "
         "boxes "
         "of Man 2006, section 3.3, with Coulomb's friction and a rigid layer: penalty (box 3), a spring in the layer, "
         "in which cloth sinks and bounces; forward_increment (box 4), multipliers that keep the end of the step out "
         "of "
         "the bodies, then friction under these; projection (box 5), cloth whose samples are its points (not nurbs) on "
         "ellipsoids, exact spheres and planes, each point for itself along the gradient of the body's function. They "
         "know no cloth on cloth: its contacts, and what would pass through a surface within a step, stay with "
         "together, "
         "in turns with these. They go with time.scheme verlet and without strain_limit";
}

}  // namespace

Object contactTable() {
  using C = ContactCase;
  Table<C> table("Contact");
  table
      .number("layer", &C::layer_m, "m", aboveTo(0, 0.05),
              "distance that contact keeps between cloth and body, and between cloth and cloth; cloth that starts "
              "nearer is "
              "pushed out to it, at up to layer / relaxation")
      .defaultsTo("the fabric's thickness; between two fabrics half the sum of theirs")
      .custom(
          frictionField(
              "friction",
              "between cloth and body, and between cloth and cloth: Coulomb's coefficient, or an object with what "
              "sticking and slipping add to it"),
          [](const Entry& p, C& c) { c.friction = readFriction(p); },
          [](const C& c) { return std::optional(writeFriction(c.friction)); })
      .required();
  ownFriction(table, "friction_cloth", &C::friction_cloth, "between cloth and cloth alone");
  return table.flag("self", &C::self, "cloth touches cloth: garments each other, folds themselves")
      .number("relaxation", &C::relaxation_s, "s", aboveTo(0, 1),
              "time in which a sample inside the layer returns to its surface")
      .number("compliance", &C::compliance_m_per_Pa, "m/Pa", between(0, 1e-6),
              "how much thinner the layer becomes under a pressure that lasts; where samples cannot all follow a round "
              "body to the nanometre, it spreads the pressure over them (cloth pressed flat has about 1e-7 m/Pa)")
      .number("tolerance", &C::tolerance, "", aboveTo(0, 0.1),
              "residual velocity to which the contacts of a step are solved together, as a part of what gravity adds "
              "in the step; in folds that are jammed 1e-6 of the largest impulse counts, up to ten times this")
      .integer("max_iterations", &C::max_iterations, 1, 100000, "iterations before a step counts as failed")
      .flag(
          "newton", &C::newton,
          "contacts that sweeps over them have not solved for long go on by Newton's method: for cloth that is pulled "
          "tight over a body (a cord, a stiff sleeve), whose friction sweeps settle slowly or not at all")
      .unwritten()
      .choice("method", &C::method, contactMethods(), contactMethodDoc())
      .unwritten()
      .number("penalty", &C::penalty_Pa_per_m, "Pa/m", aboveTo(0, 1e12),
              "stiffness eps of the method penalty, pressure per depth in the layer: cloth of surface density rho that "
              "lands at v sinks by v sqrt(rho / eps). It shortens the stable step to 2 sqrt(rho / eps). What sinks "
              "through the layer is stopped at the surface")
      .unwritten()
      .defaultsTo("none; required with method penalty")
      .check([](const Entry& p, const C& c) {
        const bool given = p.node.find("penalty") != nullptr;
        if (c.method == ContactMethod::penalty && !given)
          p.failAt("penalty", "is required with method penalty; allowed: > 0 Pa/m");
        if (c.method != ContactMethod::penalty && given)
          p.failAt("penalty", "is for method penalty; allowed: none, or \"method\": \"penalty\"");
      })
      .build();
}

void checkObstacleNames(const Entry& root, std::span<const ObstacleCase> obstacles) {
  std::set<std::string> names;
  for (std::size_t i = 0; i < obstacles.size(); ++i)
    if (!names.insert(obstacles[i].name).second)
      root.member(*root.node.find("obstacles"))
          .item(i)
          .failAt("name", fmt::format("\"{}\" names two obstacles; allowed: a name of its own", obstacles[i].name));
}

}  // namespace gambeson::schema
