#include "cases/run.hpp"

#include "core/error.hpp"

namespace gambeson {

int runCase(const Case&, const RunOptions&) { throw RunError("the run driver is not linked"); }
int renderResults(const RenderOptions&) { throw RunError("the run driver is not linked"); }
int reportResults(const ReportOptions&) { throw RunError("the run driver is not linked"); }

}  // namespace gambeson
