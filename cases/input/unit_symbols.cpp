#include "cases/input/unit_symbols.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <numbers>
#include <optional>
#include <vector>

#include "core/error.hpp"

namespace gambeson {
namespace {

struct Symbol {
  std::string_view name;
  double factor;
  Dimension dimension;
  bool prefixed = false;
};

constexpr Dimension none{}, length{1, 0, 0, 0}, time_{0, 1, 0, 0}, mass{0, 0, 1, 0}, angle{0, 0, 0, 1},
    force{1, -2, 1, 0}, pressure{-1, -2, 1, 0}, work{2, -2, 1, 0}, areal_mass{-2, 0, 1, 0}, linear_mass{-1, 0, 1, 0};
constexpr double inch = 0.0254, pound = 0.45359237, ounce = pound / 16, gravity = 9.80665,
                 degree = std::numbers::pi / 180;

/// SI brochure, 9th edition; inch, yard and pound by the international agreement of 1959; tex by ISO 1144.
constexpr Symbol symbols[] = {
    {"m", 1, length, true},
    {"g", 1e-3, mass, true},
    {"s", 1, time_, true},
    {"N", 1, force, true},
    {"Nm", 1, work, true},  // nm is the nanometre
    {"Pa", 1, pressure, true},
    {"J", 1, work, true},
    {"Hz", 1, {0, -1, 0, 0}, true},
    {"rad", 1, angle, true},
    {"deg", degree, angle},
    {"degree", degree, angle},
    {"degrees", degree, angle},
    {"\u00b0", degree, angle},
    {"sec", 1, time_},
    {"min", 60, time_},
    {"%", 0.01, none},
    {"in", inch, length},
    {"inch", inch, length},
    {"inches", inch, length},
    {"\"", inch, length},
    {"mil", inch / 1000, length},
    {"mils", inch / 1000, length},
    {"thou", inch / 1000, length},
    {"ft", 0.3048, length},
    {"feet", 0.3048, length},
    {"'", 0.3048, length},
    {"yd", 36 * inch, length},
    {"yard", 36 * inch, length},
    {"yards", 36 * inch, length},
    {"oz", ounce, mass},
    {"lb", pound, mass},
    {"lbs", pound, mass},
    {"gf", 9.80665e-3, force, true},  // gram-force, the unit of Kawabata's instruments
    {"lbf", pound* gravity, force},
    {"ozf", ounce* gravity, force},
    {"dyn", 1e-5, force},
    {"psi", pound* gravity / (inch * inch), pressure},
    {"ksi", 1000 * pound* gravity / (inch * inch), pressure},
    {"bar", 1e5, pressure, true},
    {"mmHg", 133.322387415, pressure},
    {"gsm", 1e-3, areal_mass},  // grams per square metre, the unit of the trade
    {"osy", ounce / (36 * inch * 36 * inch), areal_mass},
    {"tex", 1e-6, linear_mass, true},
    {"den", 1e-6 / 9, linear_mass},
};

struct Prefix {
  std::string_view name;
  double factor;
};
constexpr Prefix prefixes[] = {{"n", 1e-9}, {"u", 1e-6}, {"m", 1e-3}, {"c", 1e-2}, {"d", 1e-1},
                               {"da", 10},  {"h", 100},  {"k", 1e3},  {"M", 1e6},  {"G", 1e9}};

bool sameLetters(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

struct Reading {
  std::string name;
  Unit unit;
};

/// All units whose name has these letters, in any case.
std::vector<Reading> readingsOf(std::string_view name) {
  std::vector<Reading> all;
  for (const Symbol& s : symbols) {
    if (sameLetters(s.name, name)) all.push_back({std::string(s.name), {s.factor, s.dimension}});
    if (!s.prefixed || s.name.size() >= name.size()) continue;
    const std::size_t size = name.size() - s.name.size();
    if (!sameLetters(s.name, name.substr(size))) continue;
    for (const Prefix& p : prefixes)
      if (sameLetters(p.name, name.substr(0, size)))
        all.push_back({std::string(p.name).append(s.name), {p.factor * s.factor, s.dimension}});
  }
  return all;
}

constexpr struct {
  Dimension dimension;
  Measure measure;
} measures[] = {
    {none, {"a plain number", {"0.2", "20 %", "20%"}}},
    {length, {"a length", {"mm", "cm", "in"}}},
    {{2, 0, 0, 0}, {"an area", {"mm^2", "cm^2", "in^2"}}},
    {{-1, 0, 0, 0}, {"a curvature, 1 over a length", {"1/m", "1/cm", "1/in"}}},
    {time_, {"a time", {"s", "ms", "min"}}},
    {{0, -1, 0, 0}, {"a rate", {"1/s", "Hz", "1/min"}}},
    {{1, -1, 0, 0}, {"a velocity", {"m/s", "cm/s", "ft/s"}}},
    {{1, -2, 0, 0}, {"an acceleration", {"m/s^2", "cm/s^2", "ft/s^2"}}},
    {angle, {"an angle", {"deg", "\u00b0", "rad"}}},
    {{0, -1, 0, 1}, {"an angular velocity", {"rad/s", "deg/s", "\u00b0/s"}}},
    {{-1, 0, 0, 1}, {"an angle per length", {"rad/m", "deg/cm", "deg/in"}}},
    {mass, {"a mass", {"g", "kg", "lb"}}},
    {linear_mass, {"a mass per length", {"tex", "den", "g/m"}}},
    {areal_mass, {"a mass per area", {"g/m^2", "gsm", "oz/yd^2"}}},
    {{-3, 0, 1, 0}, {"a mass per volume", {"kg/m^3", "g/cm^3", "lb/ft^3"}}},
    {{2, 0, 1, 0}, {"a moment of inertia", {"kg m^2", "g cm^2", "lb in^2"}}},
    {force, {"a force", {"N", "gf", "lbf"}}},
    {{0, -2, 1, 0}, {"a force per length", {"N/m", "gf/cm", "lbf/in"}}},
    {{0, -2, 1, -1}, {"a force per length and angle", {"N/(m rad)", "gf/(cm deg)", "gf/cm/degree"}}},
    {{1, -2, 1, -1}, {"a force per angle", {"N/rad", "gf/deg", "N/deg"}}},
    {pressure, {"a force per area", {"Pa", "kPa", "psi"}}},
    {{-2, -2, 1, 0}, {"a force per volume", {"N/m^3", "Pa/mm", "psi/in"}}},
    {work, {"a moment", {"N m", "uNm", "gf cm"}}},
    {{2, -2, 1, -1}, {"a moment per angle", {"N m/rad", "N m/deg", "gf cm/deg"}}},
    {{3, -2, 1, 0}, {"a moment times a length", {"N m^2", "mN mm^2", "gf cm^2"}}},
    {{-2, -1, 1, 0}, {"a drag, pressure over velocity", {"kg/(m^2 s)", "Pa s/m", "g/(cm^2 s)"}}},
    {{0, -1, 1, 0}, {"a damping, force over velocity", {"kg/s", "N s/m", "mN s/mm"}}},
    {{-1, -1, 1, 0}, {"a viscosity", {"Pa s", "kPa s", "mPa s"}}},
    {{2, 2, -1, 0}, {"a length per pressure", {"m/Pa", "mm/kPa", "in/psi"}}},
    {{2, -2, 0, 0}, {"a force per mass and length", {"cN/tex", "N/tex", "gf/den"}}},
};

}  // namespace

Unit namedUnit(std::string_view name) {
  const std::vector<Reading> readings = readingsOf(name);
  for (const Reading& r : readings)
    if (r.name == name) return r.unit;
  if (readings.empty())
    throw InputError({}, fmt::format("\"{}\" is unknown; known are m g s N Pa J Hz rad tex gf bar (with prefixes n u m "
                                     "c d k M G), deg % in \" mil ft yd oz lb lbf psi ksi mmHg gsm den min",
                                     name));
  std::string all;
  for (const Reading& r : readings) all += (all.empty() ? "" : " or ") + r.name;
  for (const Reading& r : readings)
    if (r.unit.factor != readings[0].unit.factor || r.unit.dimension != readings[0].unit.dimension)
      throw InputError({}, fmt::format("\"{}\" can be {}; write one of these", name, all));
  return readings[0].unit;
}

const Measure* measureWith(const Dimension& dimension) {
  for (const auto& m : measures)
    if (m.dimension == dimension) return &m.measure;
  return nullptr;
}

}  // namespace gambeson
