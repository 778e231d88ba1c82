/// Detail of fields.hpp: the table of supports.

#include "cases/input/table.hpp"
#include "cases/wear/case/case.hpp"
#include "cases/wear/case/fields.hpp"
#include "cases/wear/case/supports/kind.hpp"

namespace gambeson::schema {

Object supportTable() {
  Table<SupportCase> table("Support");
  for (const SupportKind* kind : supportKinds()) {
    kind->addTo(table);
    table.in("support");
  }
  return table.oneOf("support", true).build();
}

}  // namespace gambeson::schema
