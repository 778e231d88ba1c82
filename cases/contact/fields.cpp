#include "cases/contact/fields.hpp"

#include <fmt/format.h>

#include <set>

#include "cases/contact/obstacles/kind.hpp"
#include "cases/input/table.hpp"

namespace gambeson::schema {

Object obstacleTable() {
  using O = ObstacleCase;
  Table<O> table("Obstacle");
  table.text("name", &O::name, "what the tables call it").required();
  for (const ObstacleKind* kind : obstacleKinds()) {
    kind->addTo(table);
    table.in("shape");
  }
  return table.oneOf("shape", true)
      .vector("velocity", &O::velocity_m_per_s, "m/s", between(-100, 100), "constant velocity")
      .build();
}

Object contactTable() {
  using C = ContactCase;
  return Table<C>("Contact")
      .number("layer", &C::layer_m, "m", aboveTo(0, 0.05),
              "distance that contact keeps between cloth and body, and between cloth and cloth; cloth that starts "
              "nearer is "
              "pushed out to it, at up to layer / relaxation")
      .defaultsTo("the fabric's thickness; between two fabrics half the sum of theirs")
      .number("friction", &C::friction, "", between(0, 5),
              "Coulomb's coefficient between cloth and body, and between cloth and cloth")
      .required()
      .flag("self", &C::self, "cloth touches cloth: garments each other, folds themselves")
      .number("relaxation", &C::relaxation_s, "s", aboveTo(0, 1),
              "time in which a sample inside the layer returns to its surface")
      .number("compliance", &C::compliance_m_per_Pa, "m/Pa", between(0, 1e-6),
              "how much thinner the layer becomes under a pressure that lasts; where samples cannot all follow a round "
              "body to the nanometre, it spreads the pressure over them (cloth pressed flat has about 1e-7 m/Pa)")
      .number("tolerance", &C::tolerance, "", aboveTo(0, 0.1),
              "residual velocity to which the contacts of a step are solved together, as a part of what gravity adds "
              "in the step; in folds that are jammed 1e-6 of the largest impulse counts, up to ten times this")
      .integer("max_iterations", &C::max_iterations, 1, 100000, "iterations before a step counts as failed")
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
