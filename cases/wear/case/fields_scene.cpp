/// Detail of fields.hpp: the tables of obstacles and supports.

#include "cases/input/table.hpp"
#include "cases/wear/case/case.hpp"
#include "cases/wear/case/fields.hpp"
#include "cases/wear/case/obstacles/kind.hpp"
#include "cases/wear/case/supports/kind.hpp"

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

Object supportTable() {
  Table<SupportCase> table("Support");
  for (const SupportKind* kind : supportKinds()) {
    kind->addTo(table);
    table.in("support");
  }
  return table.oneOf("support", true).build();
}

}  // namespace gambeson::schema
