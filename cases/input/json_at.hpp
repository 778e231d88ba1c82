#pragma once
/// JSON that a run left, read with the place of each value, so that what is damaged is named.

#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace gambeson {

/// A value and where it stands ("joints[0].peak_Nm"). It refers to the parsed document, which has to outlive it.
class JsonAt {
 public:
  /// What is not as it should be: "joints[0].peak_Nm: must be a number, is null".
  class Error : public std::runtime_error {
   public:
    using std::runtime_error::runtime_error;
  };

  explicit JsonAt(const nlohmann::json& value, std::string path = "") : value_(&value), path_(std::move(path)) {}

  bool contains(const std::string& key) const { return value_->is_object() && value_->contains(key); }
  bool is_number() const { return value_->is_number(); }
  JsonAt at(const std::string& key) const {
    const std::string path = path_.empty() ? key : path_ + "." + key;
    if (!contains(key)) throw Error(path + ": is missing");
    return JsonAt(value_->at(key), path);
  }
  /// Null counts as empty: what has had no item is written so.
  std::vector<JsonAt> list() const {
    std::vector<JsonAt> all;
    if (value_->is_null()) return all;
    if (!value_->is_array()) wrong("a list");
    for (std::size_t i = 0; i < value_->size(); ++i)
      all.push_back(JsonAt((*value_)[i], path_ + "[" + std::to_string(i) + "]"));
    return all;
  }
  std::vector<std::pair<std::string, JsonAt>> items() const {
    std::vector<std::pair<std::string, JsonAt>> all;
    if (value_->is_null()) return all;
    if (!value_->is_object()) wrong("an object");
    for (const auto& [key, value] : value_->items()) all.emplace_back(key, at(key));
    return all;
  }
  double number() const {
    if (!value_->is_number()) wrong("a number");
    return value_->get<double>();
  }
  int integer() const {
    constexpr int most = std::numeric_limits<int>::max();
    if (!value_->is_number_integer()) wrong("a whole number");
    if (const double x = value_->get<double>(); !(x >= -most && x <= most))
      throw Error(path_ + ": must be at most " + std::to_string(most) + ", is " + value_->dump());
    return value_->get<int>();
  }
  bool flag() const {
    if (!value_->is_boolean()) wrong("true or false");
    return value_->get<bool>();
  }
  std::string text() const {
    if (!value_->is_string()) wrong("a text");
    return value_->get<std::string>();
  }

 private:
  [[noreturn]] void wrong(const char* wanted) const {
    throw Error(path_ + ": must be " + wanted + ", is " + value_->type_name());
  }
  const nlohmann::json* value_;
  std::string path_;
};

}  // namespace gambeson
