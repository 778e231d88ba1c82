#include "cases/pattern/imported.hpp"

#include "cases/input/units.hpp"
#include "core/error.hpp"

namespace gambeson {

double metresOf(const std::string& unit) {
  const std::string said = "\"" + unit + "\" is no unit of length; allowed: mm, cm, in, m, ..";
  try {
    const Unit u = parseUnit(unit == "inch" ? "in" : unit);
    if (!(u.dimension == Dimension{.m = 1} && u.factor > 0)) throw InputError({}, "");
    return u.factor;
  } catch (const InputError&) {
    throw InputError({"command line", 0, "--unit"}, said);
  }
}

}  // namespace gambeson
