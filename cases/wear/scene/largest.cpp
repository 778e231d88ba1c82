#include "cases/wear/scene/largest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "cases/input/table.hpp"
#include "cases/input/wrong_entry.hpp"
#include "cases/wear/case/garments/kind.hpp"

namespace gambeson {
namespace {

constexpr int coarse = 24;
constexpr double least_share = 1e-3;  ///< of the way that is searched

/// A number of a garment's table, and the garment with another in its place.
class Dial {
 public:
  Dial(const GarmentCase& worn, const std::string& key) : worn_(worn) {
    schema::Table<GarmentCase> table("Garment");
    kindOf(worn).addTo(table);
    shape_ = table.build();
    const std::string word = kindOf(worn).word, under = keyUnder(word, key);
    const schema::Field& shape = shape_.fields.front();
    if (under.size() > word.size()) field_ = shape.object->find(under.substr(word.size() + 1));
    const std::optional<JsonNode> written = shape.write(&worn);
    if (!field_ || field_->kind != schema::Kind::number || !written || !written->find(field_->key)) field_ = nullptr;
    if (field_) node_ = *written;
  }
  explicit operator bool() const { return field_ != nullptr; }
  const schema::Field& field() const { return *field_; }
  double value() const { return node_.find(field_->key)->number; }
  GarmentCase at(double x) const {
    JsonNode node = node_;
    for (JsonNode& child : node.children)
      if (child.key == field_->key) child.number = x;
    GarmentCase out = worn_;
    const std::string none;
    shape_.fields.front().read({node, "", none}, &out);
    return out;
  }

 private:
  const GarmentCase& worn_;
  schema::Object shape_;
  const schema::Field* field_ = nullptr;
  JsonNode node_;
};

/// The number as people write it, rounded by `round`, and what that is in SI.
struct Said {
  double value;
  std::string text;
};
Said said(double x, const std::string& unit, double (*round)(double)) {
  if (unit == "m") return {1e-3 * round(1e3 * x), fmt::format("{:g} cm", 0.1 * round(1e3 * x))};
  if (unit == "rad") {
    const double deg = 0.1 * round(10 * x * 180 / std::numbers::pi);
    return {deg * std::numbers::pi / 180, fmt::format("{:g} deg", deg)};
  }
  const double to = std::pow(10.0, std::floor(std::log10(std::max(std::abs(x), 1e-9))) - 2);
  return {to * round(x / to), fmt::format("{:g}{}{}", to * round(x / to), unit.empty() ? "" : " ", unit)};
}

}  // namespace

std::string largestOf(const GarmentCase& worn, const std::string& key,
                      const std::function<bool(const GarmentCase&)>& holds) {
  constexpr double kStep = 0.05, kLeast = 1.0 / 3;
  const Dial dial(worn, key);
  if (!dial) return "";
  for (double share = 1 - kStep; share > kLeast; share -= kStep) {
    const double x = 1e-3 * std::floor(1e3 * share * dial.value());
    try {
      if (holds(dial.at(x))) return fmt::format("{:g} mm", 1e3 * x);
    } catch (const InputError&) {
      return "";
    }
  }
  return "";
}

void sayLargest(const InputError& e, const GarmentCase& worn, const std::string& wearer,
                const std::function<void(const GarmentCase&)>& draft) {
  const Dial dial(worn, e.where().key);
  if (!dial) throw e;
  const auto can = [&](double x) {
    try {
      draft(dial.at(x));
      return true;
    } catch (const InputError&) {
      return false;
    }
  };
  /// The value nearest to the one asked for, on the way to `end`, and in words.
  const auto search = [&](double end, const char* word, double (*round)(double)) -> std::optional<std::string> {
    double bad = dial.value();
    for (int k = 1; k <= coarse; ++k) {
      double good = dial.value() + (end - dial.value()) * k / coarse;
      if (!can(good)) {
        bad = good;
        continue;
      }
      while (std::abs(good - bad) > least_share * std::abs(end - dial.value()))
        (can(0.5 * (good + bad)) ? good : bad) = 0.5 * (good + bad);
      for (const auto& to : {+[](double x) { return std::round(x); }, round})
        if (const Said rounded = said(good, dial.field().unit, to); can(rounded.value))
          return fmt::format("{} {} on {}", word, rounded.text, wearer);
      return fmt::format("{} {:g} {} on {}", word, good, dial.field().unit, wearer);
    }
    return std::nullopt;
  };
  const schema::Range& range = dial.field().range;
  std::optional<std::string> words;
  if (std::isfinite(range.low)) words = search(range.low, "at most", [](double x) { return std::floor(x); });
  if (!words && std::isfinite(range.high))
    words = search(range.high, "at least", [](double x) { return std::ceil(x); });
  if (!words) throw e;
  const std::string reason = e.reason().substr(0, e.reason().find("; allowed:"));
  throw InputError({"", 0, e.where().key}, fmt::format("{}; allowed: {}", reason, *words));
}

}  // namespace gambeson
