/// Units against their definitions (SI brochure, 9th edition; inch and pound-force by the international agreement of
/// 1959).

#include "cases/input/units.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <string_view>

#include "cases/input/unit_symbols.hpp"
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

/// What laboratories and shops write, each by its definition.
TEST(Units, LaboratoriesAndShopsAreUnderstood) {
  const double deg = std::numbers::pi / 180, g = 9.80665, lb = 0.45359237, in = 0.0254;
  const Good cases[] = {
      {"0.03 inch", "m", 0.03 * in},
      {"0.03\"", "m", 0.03 * in},
      {"0.03 \u2033", "m", 0.03 * in},
      {"6'", "m", 6 * 0.3048},
      {"30 mil", "m", 30e-3 * in},
      {"3 yd", "m", 3 * 0.9144},
      {"8.5 oz/yd^2", "kg/m^2", 8.5 * lb / 16 / (0.9144 * 0.9144)},
      {"8.5 oz/yd2", "kg/m^2", 8.5 * lb / 16 / (0.9144 * 0.9144)},
      {"8.5 OZ/YD\u00b2", "kg/m^2", 8.5 * lb / 16 / (0.9144 * 0.9144)},
      {"320 g/m2", "kg/m^2", 0.32},
      {"320 GSM", "kg/m^2", 0.32},
      {"1 kgf", "N", g},
      {"0.172 gf.cm2/cm", "N m", 0.172e-3 * g * 1e-2},
      {"0.172 gf\u00b7cm\u00b2/cm", "N m", 0.172e-3 * g * 1e-2},
      {"0,172 gf cm^2/cm", "N m", 0.172e-3 * g * 1e-2},
      {"0.172gf-cm2/cm", "N m", 0.172e-3 * g * 1e-2},
      {"17 uNm", "N m", 17e-6},
      {"17 \u00b5N\u00b7m", "N m", 17e-6},
      {"17 \u03bcN m", "N m", 17e-6},
      {"200 psi", "Pa", 200 * lb * g / (in * in)},
      {"2 ksi", "Pa", 2000 * lb * g / (in * in)},
      {"2 KSI", "Pa", 2000 * lb * g / (in * in)},
      {"5 lbf", "N", 5 * lb * g},
      {"5 lbf/in", "N/m", 5 * lb * g / in},
      {"900 N/5cm", "N/m", 900 / 0.05},
      {"900 N/50mm", "N/m", 900 / 0.05},
      {"900 N/50 mm", "N/m", 900 / 0.05},
      {"90 daN/5cm", "N/m", 900 / 0.05},
      {"500 gf/cm", "N/m", 0.5 * g * 100},
      {"1.5 gf/(cm deg)", "N/(m rad)", 1.5e-3 * g * 100 / deg},
      {"1.5 gf/(cm\u00b7deg)", "N/(m rad)", 1.5e-3 * g * 100 / deg},
      {"1.5 gf/cm/degree", "N/(m rad)", 1.5e-3 * g * 100 / deg},
      {"30 tex", "kg/m", 30e-6},
      {"167 dtex", "kg/m", 16.7e-6},
      {"150 den", "kg/m", 150e-6 / 9},
      {"203 cN/tex", "m^2/s^2", 2.03e6},
      {"25 cN/cm", "N/m", 25},
      {"100 mmHg", "Pa", 13332.2387415},
      {"1 mbar", "Pa", 100},
      {"10 kpa", "Pa", 1e4},
      {"45 degrees", "rad", 45 * deg},
      {"0,45 mm", "m", 0.45e-3},
      {"0,450 mm", "m", 0.45e-3},
      {"12,5%", "", 0.125},
      {"0,5e-3 m", "m", 0.5e-3},
      {"1\u202f000\u2009mm", "m", 1},
      {"1 234,567 mm", "m", 1.234567},
      {"0.45\u00a0mm", "m", 0.45e-3},
      {"\u22121 mm", "m", -1e-3},
      {"0.5/cm", "1/m", 50},
      {"4 kg m\u207b\u00b2 s\u207b\u00b9", "kg/(m^2 s)", 4},
      {"4 kg m-2 s-1", "kg/(m^2 s)", 4},
      {"2 CM", "m", 0.02},
      {"2 Kg", "kg", 2},
  };
  for (const Good& c : cases) {
    SCOPED_TRACE(c.text);
    EXPECT_NEAR(parseQuantity(c.text, c.unit), c.si, 1e-14 * std::abs(c.si));
  }
}

/// The examples of a message are of the dimension that it names.
TEST(Units, ExamplesMeasureWhatTheyAreExamplesOf) {
  for (const char* unit :
       {"m",     "m^2",  "1/m",     "s",      "1/s",        "m/s",  "m/s^2", "rad",       "rad/s",  "rad/m",
        "kg",    "kg/m", "kg/m^2",  "kg/m^3", "kg m^2",     "N",    "N/m",   "N/(m rad)", "N/rad",  "Pa",
        "N/m^3", "N m",  "N m/rad", "N m^2",  "kg/(m^2 s)", "kg/s", "Pa s",  "m/Pa",      "m^2/s^2"}) {
    const Measure* measure = measureWith(parseUnit(unit).dimension);
    ASSERT_NE(measure, nullptr) << unit;
    for (const std::string_view example : measure->units)
      EXPECT_EQ(parseUnit(example).dimension, parseUnit(unit).dimension) << unit << ": " << example;
  }
}

TEST(Units, TheUnitIsKeptAsItWasTyped) {
  EXPECT_EQ(readQuantity("0,45\u2009mm ", "m").unit, "mm");
  EXPECT_EQ(readQuantity("17 \u00b5N\u00b7m", "N m").unit, "\u00b5N\u00b7m");
  EXPECT_EQ(readQuantity("57\u00b0", "rad").unit, "\u00b0");
  EXPECT_EQ(readQuantity("0.2", "").unit, "");
  EXPECT_EQ(readQuantity("2 in", "m").factor, 0.0254);
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
      {"1 MM", "m", "can be mm or Mm; write one of these"},
      {"1 mpa", "Pa", "can be mPa or MPa"},
      {"1 NM", "N m", "nm"},
      {"1 N/0cm", "N/m", "is positive"},
      {"1 N/5cm2", "N/m", "expected a force per length, such as N/m, gf/cm or lbf/in"},
      {"1 000 000.5.2 m", "m", "a unit is missing"},
      {"2 3 mm", "m", "a unit is missing"},
      {"1 2", "", "a unit is missing"},
      {"1,234 mm", "m", "can be 1.234 or 1234"},
      {"1,234,5 mm", "m", "commas between its digits"},
      {"1,234.5 mm", "m", "commas between its digits"},
      {"1, mm", "m", "is unknown"},
      {"0.5 gf/cm deg", "N/(m rad)", "write parentheses"},
      {"5 N/cm", "N m", "(a force per length); expected a moment, such as N m, uNm or gf cm"},
      {"320 g/m2", "kg/m^3", "(a mass per area); expected a mass per volume, such as kg/m^3, g/cm^3 or lb/ft^3"},
      {"1 kg", "m", "(a mass); expected a length, such as mm, cm or in"},
      {"1 m", "kg^3", "expected one like kg^3"},
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
