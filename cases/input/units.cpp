#include "cases/input/units.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/error.hpp"

namespace gambeson {
namespace {

struct Symbol {
  std::string_view name;
  double factor;
  Dimension dimension;
  bool prefixed;
};

constexpr Dimension none{}, length{1, 0, 0, 0}, time_{0, 1, 0, 0}, mass{0, 0, 1, 0}, angle{0, 0, 0, 1},
    force{1, -2, 1, 0};

constexpr std::array<Symbol, 17> symbols{{
    {"m", 1, length, true},
    {"g", 1e-3, mass, true},
    {"s", 1, time_, true},
    {"N", 1, force, true},
    {"Pa", 1, {-1, -2, 1, 0}, true},
    {"J", 1, {2, -2, 1, 0}, true},
    {"Hz", 1, {0, -1, 0, 0}, true},
    {"rad", 1, angle, true},
    {"deg", std::numbers::pi / 180, angle, false},
    {"\u00b0", std::numbers::pi / 180, angle, false},
    {"in", 0.0254, length, false},
    {"ft", 0.3048, length, false},
    {"min", 60, time_, false},
    {"%", 0.01, none, false},
    {"gf", 9.80665e-3, force, false},     // gram-force, the unit of Kawabata's instruments
    {"gsm", 1e-3, {-2, 0, 1, 0}, false},  // grams per square metre, the unit of the trade
    {"1", 1, none, false},
}};

struct Prefix {
  std::string_view name;
  double factor;
};
constexpr std::array<Prefix, 10> prefixes{{{"n", 1e-9},
                                           {"u", 1e-6},
                                           {"\u00b5", 1e-6},  // micro sign
                                           {"\u03bc", 1e-6},  // Greek mu
                                           {"m", 1e-3},
                                           {"c", 1e-2},
                                           {"d", 1e-1},
                                           {"k", 1e3},
                                           {"M", 1e6},
                                           {"G", 1e9}}};

std::optional<Unit> lookUp(std::string_view name) {
  for (const Symbol& s : symbols)
    if (s.name == name) return Unit{s.factor, s.dimension};
  for (const Prefix& p : prefixes)
    if (name.starts_with(p.name))
      for (const Symbol& s : symbols)
        if (s.prefixed && s.name == name.substr(p.name.size())) return Unit{p.factor * s.factor, s.dimension};
  return std::nullopt;
}

Unit operator*(const Unit& a, const Unit& b) {
  const Dimension &p = a.dimension, &q = b.dimension;
  return {a.factor * b.factor, {p.m + q.m, p.s + q.s, p.kg + q.kg, p.rad + q.rad}};
}

Unit power(const Unit& u, int n) {
  const Dimension& d = u.dimension;
  return {std::pow(u.factor, n), {n * d.m, n * d.s, n * d.kg, n * d.rad}};
}

/// expression = factor { [ "*" | "·" | "/" ] factor };  factor = ( symbol | "(" expression ")" ) [ "^" integer | "²" |
/// "³" ]
class UnitParser {
 public:
  explicit UnitParser(std::string_view text) : text_(text) {}

  Unit parse() {
    skipSpace();
    if (at_ == text_.size()) return {};
    const Unit unit = expression();
    if (at_ < text_.size()) fail("unexpected \")\"");
    return unit;
  }

 private:
  [[noreturn]] void fail(const std::string& why) const {
    throw InputError({}, fmt::format("\"{}\" is not a unit: {}", text_, why));
  }
  void skipSpace() {
    while (at_ < text_.size() && text_[at_] == ' ') ++at_;
  }
  bool take(std::string_view s) {
    if (!text_.substr(at_).starts_with(s)) return false;
    at_ += s.size();
    return true;
  }

  Unit expression() {
    if (++depth_ > 8) fail("too many parentheses");
    Unit unit = factor();
    bool divided = false;
    for (skipSpace(); at_ < text_.size() && text_[at_] != ')'; skipSpace()) {
      if (take("/")) {
        unit = unit * power(factor(), -1);
        divided = true;
      } else {
        if (!take("*")) take("\u00b7");
        if (divided) fail("write parentheses around a product after \"/\", as in kg/(m^2 s)");
        unit = unit * factor();
      }
    }
    --depth_;
    return unit;
  }

  Unit factor() {
    skipSpace();
    Unit unit;
    if (take("(")) {
      unit = expression();
      if (!take(")")) fail("\")\" is missing");
    } else {
      const std::size_t end = std::min(text_.find_first_of(" */^()", at_), text_.size());
      std::string_view name = text_.substr(at_, end - at_);
      for (const std::string_view stop : {"\u00b7", "\u00b2", "\u00b3"}) name = name.substr(0, name.find(stop));
      if (name.empty()) fail("a unit is missing");
      const std::optional<Unit> found = lookUp(name);
      if (!found)
        fail(fmt::format(
            "\"{}\" is unknown; known are m g s N Pa J Hz rad (with prefixes n u m c d k M G), deg in ft min % gf gsm",
            name));
      unit = *found;
      at_ += name.size();
    }
    if (take("\u00b2")) return power(unit, 2);
    if (take("\u00b3")) return power(unit, 3);
    if (!take("^")) return unit;
    int exponent = 0;
    const char* begin = text_.data() + at_;
    const auto [stop, error] = std::from_chars(begin, text_.data() + text_.size(), exponent);
    if (error != std::errc{} || exponent < -9 || exponent > 9) fail("a power is a whole number from -9 to 9");
    at_ += static_cast<std::size_t>(stop - begin);
    return power(unit, exponent);
  }

  std::string_view text_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

}  // namespace

Unit parseUnit(std::string_view text) { return UnitParser(text).parse(); }

double parseQuantity(std::string_view text, std::string_view si_unit) {
  std::size_t start = text.find_first_not_of(' ');
  if (start == std::string_view::npos) start = text.size();
  std::string_view rest = text.substr(start);
  if (rest.starts_with('+')) rest.remove_prefix(1);
  double value = 0;
  const auto [stop, error] = std::from_chars(rest.data(), rest.data() + rest.size(), value);
  if (error == std::errc::result_out_of_range)
    throw InputError({}, fmt::format("\"{}\" is beyond the range of numbers", text));
  if (error != std::errc{}) {
    throw InputError(
        {}, si_unit.empty()
                ? fmt::format("\"{}\" does not start with a number", text)
                : fmt::format("\"{}\" does not start with a number; write for example \"1.5 {}\"", text, si_unit));
  }
  if (!std::isfinite(value)) throw InputError({}, fmt::format("\"{}\" is not a finite number", text));
  rest.remove_prefix(static_cast<std::size_t>(stop - rest.data()));
  const Unit unit = parseUnit(rest), wanted = parseUnit(si_unit);
  if (unit.dimension != wanted.dimension) {
    if (rest.find_first_not_of(' ') == std::string_view::npos)
      throw InputError(
          {}, fmt::format("\"{}\" has no unit; expected one like {}, or a number without quotes (SI)", text, si_unit));
    throw InputError({}, fmt::format("\"{}\" has the wrong unit; expected one like {}", text,
                                     si_unit.empty() ? "% (or none)" : si_unit));
  }
  const double si = value * unit.factor;
  if (!std::isfinite(si)) throw InputError({}, fmt::format("\"{}\" is beyond the range of numbers", text));
  return si;
}

}  // namespace gambeson
