#include "cases/command/documents.hpp"

#include "cases/cloth/card.hpp"
#include "cases/cloth/law_table.hpp"
#include "cases/fabric/fit_card.hpp"
#include "cases/input/schema.hpp"
#include "cases/kinds/any_case.hpp"
#include "cases/pattern/pattern_file.hpp"
#include "cases/study/study.hpp"

namespace gambeson {

std::string caseSchema() { return schema::jsonSchema(kindsOfCase()); }
std::string caseFields() {
  return schema::markdown(kindsOfCase()) + schema::chapter("Studies", study::studyTable()) +
         schema::chapter("Fabric cards", schema::cardTable()) +
         schema::chapter("Measurements of fabrics", schema::measurementsTable()) +
         schema::chapter("Law tables", schema::lawFileTable()) + schema::chapter("Patterns", schema::patternTable());
}

}  // namespace gambeson
