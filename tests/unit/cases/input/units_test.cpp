/// Units against their definitions (SI brochure, 9th edition; inch and pound-force by the international agreement of
/// 1959).

#include "cases/input/units.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "core/error.hpp"

namespace gambeson {
namespace {

struct Good {
  const char* text;
  const char* unit;
  double si;
};

TEST(Units, QuantitiesAreSi) {
  const double deg = std::numbers::pi / 180;
  const Good cases[] = {
      {"0.762 mm", "m", 0.762e-3},
      {"0.762mm", "m", 0.762e-3},
      {" 20 cm ", "m", 0.2},
      {"1e-3 km", "m", 1},
      {"2 in", "m", 0.0508},
      {"1 ft", "m", 0.3048},
      {"1.44 MPa", "Pa", 1.44e6},
      {"30 kPa", "Pa", 3e4},
      {"57 deg", "rad", 57 * deg},
      {"57\u00b0", "rad", 57 * deg},
      {"1 rad/s", "rad/s", 1},
      {"60 deg/s", "rad/s", 60 * deg},
      {"0.5 s", "s", 0.5},
      {"10 ms", "s", 0.01},
      {"2 min", "s", 120},
      {"1440 kg/m^3", "kg/m^3", 1440},
      {"0.436 g/cm^3", "kg/m^3", 436},
      {"0.144 kg/m^2", "kg/m^2", 0.144},
      {"144 gsm", "kg/m^2", 0.144},
      {"144 g/m\u00b2", "kg/m^2", 0.144},
      {"4 kg/(m^2 s)", "kg/(m^2 s)", 4},
      {"4 kg/m^2/s", "kg/(m^2 s)", 4},
      {"4 kg m^-2 s^-1", "kg/(m^2 s)", 4},
      {"4 Pa s/m", "kg/(m^2 s)", 4},
      {"0.00371 N m", "N m", 0.00371},
      {"3.71 mN\u00b7m", "N m", 0.00371},
      {"3.71 mN*m", "N m", 0.00371},
      {"0.1 gf cm^2/cm", "N m", 0.1 * 9.80665e-3 * 1e-2},
      {"200 N/m^2", "N/m^2", 200},
      {"200 (N/m)/m", "N/m^2", 200},
      {"30 1/m", "1/m", 30},
      {"0.3 1/cm", "1/m", 30},
      {"-9.81 m/s^2", "m/s^2", -9.81},
      {"+3 \u00b5m", "m", 3e-6},
      {"3 um", "m", 3e-6},
      {"6 %", "", 0.06},
      {"0.06", "", 0.06},
      {"0.01 N m/(m rad)", "N/rad", 0.01},
  };
  for (const Good& c : cases) {
    SCOPED_TRACE(c.text);
    EXPECT_NEAR(parseQuantity(c.text, c.unit), c.si, 4e-16 * std::abs(c.si));
  }
}

struct Bad {
  const char* text;
  const char* unit;
  const char* reason;
};

TEST(Units, MistakesAreNamed) {
  const Bad cases[] = {
      {"57 deg", "m", "wrong unit"},
      {"57", "rad", "has no unit"},
      {"1 m", "", "wrong unit"},
      {"1 rad", "", "wrong unit"},
      {"1 kg/m^2", "kg/m^3", "wrong unit"},
      {"mm", "m", "does not start with a number"},
      {"", "m", "does not start with a number"},
      {"nan m", "m", "not a finite number"},
      {"inf m", "m", "not a finite number"},
      {"-infinity m", "m", "not a finite number"},
      {"1e999 m", "m", "beyond the range"},
      {"1e308 Gm", "m", "beyond the range"},
      {"1 furlong", "m", "\"furlong\" is unknown"},
      {"1 kin", "m", "\"kin\" is unknown"},  // inches take no prefix
      {"4 kg/m s", "kg/(m s)", "write parentheses"},
      {"1 m^", "m", "a power is a whole number"},
      {"1 m^0.5", "m", ""},
      {"1 m^99", "m", "a power is a whole number"},
      {"1 (m", "m", "\")\" is missing"},
      {"1 m)", "m", "unexpected \")\""},
      {"1 m/", "m", "a unit is missing"},
      {"1 ((((((((((m))))))))))", "m", "too many parentheses"},
      {"0x10 m", "m", "is unknown"},
      {"1,5 mm", "m", "is unknown"},
      {"++1 m", "m", "does not start with a number"},
  };
  for (const Bad& c : cases) {
    SCOPED_TRACE(c.text);
    try {
      parseQuantity(c.text, c.unit);
      FAIL() << "accepted";
    } catch (const InputError& e) {
      EXPECT_NE(e.reason().find(c.reason), std::string::npos) << e.reason();
    }
  }
}

}  // namespace
}  // namespace gambeson
