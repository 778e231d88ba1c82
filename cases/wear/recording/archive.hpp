#pragma once
/// Structs as named values, there and back. A struct tells its fields once, in a function that both directions share:
///
///     template <class A, Of<Ellipsoid> T> void fields(A& a, T& e) { a("semi_axes", e.semi_axes); }
///
/// A value is called after the fields that lead to it, "human.skeleton.joints.axis", and all values of one name follow
/// each other: what a list of structs holds stands field by field. A list is its length (a whole number), then its
/// items; what may be absent is 1 and itself, or 0; what is one of several is which, then itself.

#include <array>
#include <concepts>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "core/error.hpp"
#include "core/io/recording.hpp"

namespace gambeson {

/// T is U, or const U.
template <class T, class U>
concept Of = std::same_as<std::remove_const_t<T>, U>;

namespace archive {

template <class T>
inline constexpr bool is_vector = false;
template <class T>
inline constexpr bool is_vector<std::vector<T>> = true;
template <class T>
inline constexpr bool is_array = false;
template <class T, std::size_t N>
inline constexpr bool is_array<std::array<T, N>> = true;
template <class T>
inline constexpr bool is_variant = false;
template <class... T>
inline constexpr bool is_variant<std::variant<T...>> = true;
/// What may be absent: optional<T>, shared_ptr<T>.
template <class T>
inline constexpr bool is_maybe = false;
template <class T>
inline constexpr bool is_maybe<std::optional<T>> = true;
template <class T>
inline constexpr bool is_maybe<std::shared_ptr<T>> = true;

}  // namespace archive

/// Takes values down.
class ArchiveWriter {
 public:
  template <class T>
  ArchiveWriter& operator()(const char* name, const T& value) {
    const std::string outer = name_;
    if (!name_.empty()) name_ += '.';
    name_ += name;
    to_ = nullptr;
    items(value);
    name_ = outer;
    to_ = nullptr;
    return *this;
  }
  bool has(const char*) const { return true; }
  /// Values that stand under the same name.
  template <class... T>
  void items(const T&... values) {
    (put(values), ...);
  }
  const std::map<std::string, Values>& values() const { return values_; }

 private:
  template <class T>
  void put(const T& value) {
    using namespace archive;
    if constexpr (std::is_floating_point_v<T>) {
      here().reals.push_back(value);
    } else if constexpr (std::is_integral_v<T> || std::is_enum_v<T>) {
      here().integers.push_back(static_cast<std::int64_t>(value));
    } else if constexpr (std::same_as<T, std::string>) {
      here().texts.push_back(value);
    } else if constexpr (is_vector<T>) {
      put(value.size());
      for (const auto& item : value) put(item);
    } else if constexpr (is_array<T>) {
      for (const auto& item : value) put(item);
    } else if constexpr (is_variant<T>) {
      put(value.index());
      std::visit([&](const auto& one) { put(one); }, value);
    } else if constexpr (is_maybe<T>) {
      put(static_cast<bool>(value));
      if (value) put(*value);
    } else {
      fields(*this, value);
    }
  }
  Values& here() {
    if (!to_) to_ = &values_[name_];
    return *to_;
  }

  std::map<std::string, Values> values_;
  std::string name_;
  Values* to_ = nullptr;  ///< of `name_`; null: not looked up yet
};

/// Gives values back in the order in which they were taken down.
class ArchiveReader {
 public:
  /// `file`: that the values are from, for messages.
  ArchiveReader(const std::map<std::string, Values>& values, std::string file)
      : values_(values), file_(std::move(file)) {}

  template <class T>
  ArchiveReader& operator()(const char* name, T& value) {
    const std::string outer = name_;
    if (!name_.empty()) name_ += '.';
    name_ += name;
    from_ = nullptr;
    items(value);
    name_ = outer;
    from_ = nullptr;
    return *this;
  }
  /// Whether there are values of that name, which recordings from before may lack.
  bool has(const std::string& name) const { return values_.contains(name_.empty() ? name : name_ + '.' + name); }
  template <class... T>
  void items(T&... values) {
    (get(values), ...);
  }

 private:
  /// How far the values of one name are read.
  struct Read {
    const Values* values = nullptr;
    std::size_t reals = 0, integers = 0, texts = 0;
  };

  template <class T>
  void get(T& value) {
    using namespace archive;
    if constexpr (std::is_floating_point_v<T>) {
      value = next(&Values::reals, &Read::reals);
    } else if constexpr (std::is_integral_v<T> || std::is_enum_v<T>) {
      value = static_cast<T>(next(&Values::integers, &Read::integers));
    } else if constexpr (std::same_as<T, std::string>) {
      value = next(&Values::texts, &Read::texts);
    } else if constexpr (is_vector<T>) {
      value.clear();
      for (std::size_t left = number(); left > 0; --left) get(value.emplace_back());
    } else if constexpr (is_array<T>) {
      for (auto& item : value) get(item);
    } else if constexpr (is_variant<T>) {
      alternative(value, number(), std::make_index_sequence<std::variant_size_v<T>>());
    } else if constexpr (is_maybe<T>) {
      value = {};
      if (number() == 0) return;
      std::remove_cvref_t<decltype(*value)> there;
      get(there);
      if constexpr (requires { value.emplace(); })
        value.emplace(std::move(there));
      else
        value = std::make_shared<decltype(there)>(std::move(there));
    } else {
      fields(*this, value);
    }
  }
  template <class T, std::size_t... I>
  void alternative(T& value, std::size_t index, std::index_sequence<I...>) {
    if (index >= sizeof...(I)) fail();
    ((index == I ? get(value.template emplace<I>()) : void()), ...);
  }
  std::size_t number() {
    const std::int64_t n = next(&Values::integers, &Read::integers);
    if (n < 0) fail();
    return static_cast<std::size_t>(n);
  }
  template <class T>
  const T& next(std::vector<T> Values::*kind, std::size_t Read::*count) {
    if (!from_) {
      from_ = &read_[name_];
      if (const auto at = values_.find(name_); at != values_.end()) from_->values = &at->second;
    }
    if (!from_->values || from_->*count >= (from_->values->*kind).size()) fail();
    return (from_->values->*kind)[(from_->*count)++];
  }
  [[noreturn]] void fail() const {
    throw InputError({file_, 0, ""}, "damaged file of a recording: the scene's \"" + name_ + "\" is not as written");
  }

  const std::map<std::string, Values>& values_;
  std::string file_, name_;
  std::map<std::string, Read> read_;
  Read* from_ = nullptr;  ///< of `name_`; null: not looked up yet
};

}  // namespace gambeson
