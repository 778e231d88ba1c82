#include "cases/input/units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <utility>

#include "cases/input/unit_symbols.hpp"
#include "core/error.hpp"

namespace gambeson {
namespace {

constexpr std::size_t kLongestQuantity = 200;  ///< bytes

/// What people type in place of ASCII.
constexpr std::pair<std::string_view, std::string_view> spellings[] = {
    {"\u00a0", " "},  {"\u2007", " "},  {"\u2009", " "}, {"\u200a", " "}, {"\u202f", " "},  // spaces
    {"\t", " "},      {"\u2212", "-"},  {"\u207b", "-"},                                    // minus
    {"\u00b7", "*"},  {"\u22c5", "*"},  {"\u2219", "*"}, {"\u00d7", "*"},                   // times
    {"\u00b9", "1"},  {"\u00b2", "2"},  {"\u00b3", "3"}, {"\u2074", "4"},                   // powers
    {"\u00b5", "u"},  {"\u03bc", "u"},                                                      // micro, Greek mu
    {"\u2033", "\""}, {"\u201d", "\""}, {"\u2032", "'"}, {"\u2019", "'"}, {"\u00ba", "\u00b0"}};

std::string spelt(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const auto* const found = std::find_if(std::begin(spellings), std::end(spellings),
                                           [&](const auto& s) { return text.starts_with(s.first); });
    const bool known = found != std::end(spellings);
    out += known ? found->second : text.substr(0, 1);
    text.remove_prefix(known ? found->first.size() : 1);
  }
  return out;
}

bool isDigit(char c) { return c >= '0' && c <= '9'; }
bool isLetter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }

std::size_t digitsAt(std::string_view text, std::size_t at) {
  std::size_t end = std::min(at, text.size());
  while (end < text.size() && isDigit(text[end])) ++end;
  return end - std::min(at, text.size());
}

Unit operator*(const Unit& a, const Unit& b) {
  const Dimension &p = a.dimension, &q = b.dimension;
  return {a.factor * b.factor, {p.m + q.m, p.s + q.s, p.kg + q.kg, p.rad + q.rad}};
}

Unit power(const Unit& u, int n) {
  const Dimension& d = u.dimension;
  return {std::pow(u.factor, n), {n * d.m, n * d.s, n * d.kg, n * d.rad}};
}

/// expression = [ factor ] { [ "*" | "." | "-" | "/" [ number ] ] factor };
/// factor = ( name | "1" | "(" expression ")" ) [ [ "^" ] integer ]
class UnitParser {
 public:
  /// `shown` is the text as it was typed.
  UnitParser(std::string_view text, std::string_view shown) : text_(text), shown_(shown) {}

  Unit parse() {
    skipSpace();
    if (at_ == text_.size()) return {};
    const Unit unit = expression();
    if (at_ < text_.size()) fail("unexpected \")\"");
    return unit;
  }

 private:
  [[noreturn]] void fail(const std::string& why) const {
    throw InputError({}, fmt::format("\"{}\" is not a unit: {}", shown_, why));
  }
  char peek(std::size_t ahead = 0) const { return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0'; }
  void skipSpace() {
    while (peek() == ' ') ++at_;
  }
  bool take(char c) {
    if (peek() != c) return false;
    ++at_;
    return true;
  }

  Unit expression() {
    if (++depth_ > 8) fail("too many parentheses");
    skipSpace();
    Unit unit = peek() == '/' ? Unit{} : factor();
    bool divided = false;
    for (skipSpace(); at_ < text_.size() && peek() != ')'; skipSpace()) {
      if (take('/')) {
        unit = unit * power(denominator(), -1);
        divided = true;
      } else {
        if (!take('*') && !take('.') && peek() == '-' && isLetter(peek(1))) ++at_;
        if (divided) fail("write parentheses around a product after \"/\", as in kg/(m^2 s)");
        unit = unit * factor();
      }
    }
    --depth_;
    return unit;
  }

  /// "5cm" of N/5cm, the width of a strip; or a factor.
  Unit denominator() {
    skipSpace();
    if (!isDigit(peek())) return factor();
    double width = 0;
    const auto [stop, error] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), width);
    if (error != std::errc{} || !(width > 0)) fail("a number after \"/\" is positive");
    at_ = static_cast<std::size_t>(stop - text_.data());
    return Unit{width, {}} * factor();
  }

  Unit factor() {
    skipSpace();
    Unit unit;
    if (take('(')) {
      unit = expression();
      if (!take(')')) fail("\")\" is missing");
    } else if (peek() == '1' && !isDigit(peek(1))) {
      ++at_;
    } else {
      const std::string_view name = nameAt();
      if (name.empty()) fail("a unit is missing");
      try {
        unit = namedUnit(name);
      } catch (const InputError& e) {
        fail(e.reason());
      }
      at_ += name.size();
    }
    const bool marked = take('^');
    if (!marked && !isDigit(peek()) && !(peek() == '-' && isDigit(peek(1)))) return unit;
    int exponent = 0;
    const char* begin = text_.data() + at_;
    const auto [stop, error] = std::from_chars(begin, text_.data() + text_.size(), exponent);
    if (error != std::errc{} || exponent < -9 || exponent > 9) fail("a power is a whole number from -9 to 9");
    at_ += static_cast<std::size_t>(stop - begin);
    return power(unit, exponent);
  }

  std::string_view nameAt() const {
    if (peek() == '"' || peek() == '\'') return text_.substr(at_, 1);
    const std::size_t end = text_.find_first_of(" */^().-\"'0123456789", at_);
    return text_.substr(at_, std::min(end, text_.size()) - at_);
  }

  std::string_view text_, shown_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

/// The text with a number at its start that std::from_chars takes: groups of three joined, a point for a comma.
std::string withPoint(std::string_view text, std::string_view shown) {
  std::size_t at = text.starts_with('-') ? 1 : 0;
  const std::size_t first = at, leading = digitsAt(text, at);
  std::string out(text.substr(0, at += leading));
  bool grouped = false;
  while (leading >= 1 && leading <= 3 && text.substr(at).starts_with(' ') && digitsAt(text, at + 1) == 3) {
    out += text.substr(at + 1, 3);
    at += 4;
    grouped = true;
  }
  const std::size_t decimals = digitsAt(text, at + 1);
  if (leading > 0 && decimals > 0 && text[at] == ',') {
    const char next = at + 1 + decimals < text.size() ? text[at + 1 + decimals] : '\0';
    if (next == ',' || (next == '.' && digitsAt(text, at + 2 + decimals) > 0))
      throw InputError({}, fmt::format("\"{}\" has commas between its digits; write for example 1234.5", shown));
    if (decimals == 3 && leading <= 3 && !grouped && text[first] != '0')
      throw InputError({}, fmt::format("\"{}\" can be {}.{} or {}{}; write it with a point or without a comma", shown,
                                       out, text.substr(at + 1, 3), out, text.substr(at + 1, 3)));
    out.append(".").append(text.substr(at + 1, decimals));
    at += 1 + decimals;
  }
  return out.append(text.substr(at));
}

std::string_view withoutEnd(std::string_view text) { return text.substr(0, text.find_last_not_of(' ') + 1); }

std::string_view trimmed(std::string_view text) {
  return withoutEnd(text.substr(std::min(text.find_first_not_of(' '), text.size())));
}

}  // namespace

Unit parseUnit(std::string_view text) { return UnitParser(spelt(text), text).parse(); }

std::string measureOf(std::string_view si_unit) {
  const Measure* m = measureWith(parseUnit(si_unit).dimension);
  return m ? fmt::format("{}, such as {}, {} or {}", m->name, m->units[0], m->units[1], m->units[2])
           : fmt::format("one like {}", si_unit);
}

namespace {

struct Read {
  Quantity quantity;
  Dimension dimension;
};

/// `example`: a unit for the message where there is no number.
Read read(std::string_view text, std::string_view example) {
  if (text.size() > kLongestQuantity)
    throw InputError({}, fmt::format("\"{}...\" is not a quantity, a number with its unit", text.substr(0, 40)));
  const std::string plain = spelt(text);
  std::string_view start = trimmed(plain);
  if (start.starts_with('+')) start.remove_prefix(1);
  const std::string number = withPoint(start, text);
  std::string_view rest = number;
  double value = 0;
  const auto [stop, error] = std::from_chars(rest.data(), rest.data() + rest.size(), value);
  if (error == std::errc::result_out_of_range)
    throw InputError({}, fmt::format("\"{}\" is beyond the range of numbers", text));
  if (error != std::errc{})
    throw InputError({}, fmt::format("\"{}\" does not start with a number{}", text,
                                     example.empty() ? "" : fmt::format("; write for example \"1.5 {}\"", example)));
  if (!std::isfinite(value)) throw InputError({}, fmt::format("\"{}\" is not a finite number", text));
  rest = trimmed(rest.substr(static_cast<std::size_t>(stop - rest.data())));
  const Unit unit = UnitParser(rest, rest).parse();
  std::string_view typed = text;  // of which the unit is what is left when it is spelt as short as the unit
  while (!typed.empty() && withoutEnd(spelt(typed)).size() > rest.size()) typed.remove_prefix(1);
  return {{value * unit.factor, value, std::string(withoutEnd(typed)), unit.factor}, unit.dimension};
}

}  // namespace

Quantity readQuantity(std::string_view text, std::string_view si_unit) {
  Read found = read(text, si_unit);
  if (found.dimension != parseUnit(si_unit).dimension) {
    if (found.quantity.unit.empty())
      throw InputError({}, fmt::format("\"{}\" has no unit; expected {}, or a number without quotes in {}", text,
                                       measureOf(si_unit), si_unit));
    const Measure* typed = measureWith(found.dimension);
    throw InputError({}, fmt::format("\"{}\" has the wrong unit{}; expected {}", text,
                                     typed ? fmt::format(" ({})", typed->name) : "", measureOf(si_unit)));
  }
  if (!std::isfinite(found.quantity.si))
    throw InputError({}, fmt::format("\"{}\" is beyond the range of numbers", text));
  return std::move(found.quantity);
}

std::optional<Quantity> anyQuantity(std::string_view text) {
  try {
    return read(text, "").quantity;
  } catch (const InputError&) {
    return std::nullopt;
  }
}

double parseQuantity(std::string_view text, std::string_view si_unit) { return readQuantity(text, si_unit).si; }

}  // namespace gambeson
