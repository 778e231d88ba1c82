#pragma once
/// Builds one object of the field table for a plain struct T. Defaults are not written again: they are those of T
/// itself. Members are named by anything that std::invoke takes: &T::member, a lambda, std::identity for T itself.

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <type_traits>
#include <utility>
#include <variant>

#include "cases/input/schema.hpp"
#include "core/math/vec.hpp"

namespace gambeson::schema {

/// Values as nodes, for writing.
JsonNode nodeOf(double x);
JsonNode nodeOf(bool b);
inline JsonNode nodeOf(const char*) = delete;  // would be taken for a bool
JsonNode nodeOf(const std::string& s);
JsonNode nodeOf(const Vec2& v);
JsonNode nodeOf(const Vec3& v);
JsonNode nodeOfList(const std::vector<double>& values);
JsonNode emptyList();

/// Reads each item of a list; of all that are wrong the mistakes are said. `of`: "objects", for the message where it is
/// no list.
void readItems(const Entry& list, const std::string& of, const std::function<void(const Entry&)>& read);
Vec2 readPair(const Entry& entry, const std::string& unit, const Range& range);
std::vector<double> readNumbers(const Entry& entry, const std::string& unit, const Range& range);
Vec3 readVector(const Entry& entry, const std::string& unit, const Range& range);
/// A vector that is not zero, made unit.
Vec3 readDirection(const Entry& entry);
/// A path to a file that exists (or did, of a recorded case), made absolute: against the case's folder, or the current
/// one from the command line.
std::filesystem::path readPath(const Entry& entry);
/// The same of a folder.
std::filesystem::path readFolder(const Entry& entry);

/// A field whose reading and writing a table adds (Table::custom).
inline Field fieldOf(const std::string& key, Kind kind, const std::string& unit, const Range& range,
                     const std::string& doc) {
  Field f;
  f.key = key;
  f.kind = kind;
  f.unit = unit;
  f.range = range;
  f.doc = doc;
  return f;
}

template <class M>
inline constexpr bool is_optional = false;
template <class M>
inline constexpr bool is_optional<std::optional<M>> = true;

template <class T>
class Table {
 public:
  explicit Table(std::string title, std::string about = "") {
    object_.title = std::move(title);
    object_.about = std::move(about);
  }

  template <class Get>
  Table& number(const std::string& key, Get get, const std::string& unit, const Range& range, const std::string& doc) {
    Field& f = add(key, Kind::number, doc);
    f.unit = unit;
    f.range = range;
    f.read = [=](const Entry& p, void* t) { member(get, t) = readNumber(p, unit, range); };
    f.write = [=](const void* t) { return writeMember(member(get, t)); };
    return *this;
  }
  template <class Get>
  Table& integer(const std::string& key, Get get, int low, int high, const std::string& doc) {
    Field& f = add(key, Kind::integer, doc);
    f.range = between(low, high);
    f.read = [get, range = f.range](const Entry& p, void* t) { member(get, t) = readInteger(p, range); };
    f.write = [=](const void* t) { return writeMember(member(get, t)); };
    return *this;
  }
  template <class Get>
  Table& flag(const std::string& key, Get get, const std::string& doc) {
    Field& f = add(key, Kind::boolean, doc);
    f.read = [=](const Entry& p, void* t) { member(get, t) = readBoolean(p); };
    f.write = [=](const void* t) { return std::optional(nodeOf(member(get, t))); };
    return *this;
  }
  /// Text; an empty one counts as absent.
  template <class Get>
  Table& text(const std::string& key, Get get, const std::string& doc) {
    Field& f = add(key, Kind::text, doc);
    f.read = [=](const Entry& p, void* t) { member(get, t) = readText(p); };
    f.write = [=](const void* t) { return writeMember(member(get, t)); };
    return *this;
  }
  template <class Get>
  Table& path(const std::string& key, Get get, const std::string& doc) {
    Field& f = add(key, Kind::path, doc);
    f.read = [=](const Entry& p, void* t) { member(get, t) = readPath(p); };
    f.write = [=](const void* t) { return writeMember(member(get, t).string()); };
    return *this;
  }
  template <class Get>
  Table& vector(const std::string& key, Get get, const std::string& unit, const Range& range, const std::string& doc) {
    Field& f = add(key, Kind::vector, doc);
    f.unit = unit;
    f.range = range;
    f.read = [=](const Entry& p, void* t) { member(get, t) = readVector(p, unit, range); };
    f.write = [=](const void* t) { return writeMember(member(get, t)); };
    return *this;
  }
  template <class Get>
  Table& direction(const std::string& key, Get get, const std::string& doc) {
    Field& f = add(key, Kind::vector, doc + " (any length but zero)");
    f.read = [=](const Entry& p, void* t) { member(get, t) = readDirection(p); };
    f.write = [=](const void* t) { return writeMember(member(get, t)); };
    return *this;
  }
  template <class Get, class E>
  Table& choice(const std::string& key, Get get, const std::vector<std::pair<std::string, E>>& words,
                const std::string& doc) {
    Field& f = add(key, Kind::choice, doc);
    for (const auto& w : words) f.choices.push_back(w.first);
    f.read = [get, words, choices = f.choices](const Entry& p, void* t) {
      member(get, t) = words[readChoice(p, choices)].second;
    };
    f.write = [=](const void* t) -> std::optional<JsonNode> {
      for (const auto& w : words)
        if (w.second == member(get, t)) return nodeOf(w.first);
      return std::nullopt;
    };
    return *this;
  }
  /// An object read into a member of type U or optional<U>.
  template <class Get>
  Table& object(const std::string& key, Get get, Object table, const std::string& doc) {
    Field& f = add(key, Kind::object, doc);
    f.object = std::make_shared<const Object>(std::move(table));
    f.read = [get, o = f.object](const Entry& p, void* t) {
      auto& m = member(get, t);
      if constexpr (is_optional<std::remove_cvref_t<decltype(m)>>)
        readObject(*o, p, &m.emplace());
      else
        readObject(*o, p, &m);
    };
    f.write = [get, o = f.object](const void* t) -> std::optional<JsonNode> {
      const auto& m = member(get, t);
      if constexpr (is_optional<std::remove_cvref_t<decltype(m)>>)
        return m ? std::optional(writeObject(*o, &*m)) : std::nullopt;
      else
        return writeObject(*o, &m);
    };
    return *this;
  }
  /// An object that is written as an `In` and kept as something else, or an optional of it: member = resolve(in),
  /// in = restore(member).
  template <class In, class Get, class Resolve, class Restore>
  Table& converted(const std::string& key, Get get, Object table, Resolve resolve, Restore restore,
                   const std::string& doc) {
    Field& f = add(key, Kind::object, doc);
    f.object = std::make_shared<const Object>(std::move(table));
    f.read = [=, o = f.object](const Entry& p, void* t) {
      In in;
      readObject(*o, p, &in);
      member(get, t) = resolve(p, in);
    };
    f.write = [=, o = f.object](const void* t) -> std::optional<JsonNode> {
      const auto& m = member(get, t);
      if constexpr (is_optional<std::remove_cvref_t<decltype(m)>>) {
        if (!m) return std::nullopt;
        const In in = restore(*m);
        return writeObject(*o, &in);
      } else {
        const In in = restore(m);
        return writeObject(*o, &in);
      }
    };
    return *this;
  }
  /// An object that stands for the alternative A of a member that is a variant.
  template <class A, class Get>
  Table& alternative(const std::string& key, Get get, Object table, const std::string& doc) {
    Field& f = add(key, Kind::object, doc);
    f.object = std::make_shared<const Object>(std::move(table));
    f.read = [get, o = f.object](const Entry& p, void* t) {
      A a;
      readObject(*o, p, &a);
      member(get, t) = std::move(a);
    };
    f.write = [get, o = f.object](const void* t) -> std::optional<JsonNode> {
      const A* a = std::get_if<A>(&member(get, t));
      return a ? std::optional(writeObject(*o, a)) : std::nullopt;
    };
    return *this;
  }
  /// A list of objects read into a vector or an optional of one.
  template <class Get>
  Table& list(const std::string& key, Get get, Object table, const std::string& doc) {
    Field& f = add(key, Kind::list, doc);
    f.object = std::make_shared<const Object>(std::move(table));
    f.read = [get, o = f.object](const Entry& p, void* t) {
      auto& list = listOf(member(get, t));
      list.clear();
      readItems(p, "objects", [&](const Entry& item) { readObject(*o, item, &list.emplace_back()); });
    };
    f.write = [get, o = f.object](const void* t) -> std::optional<JsonNode> {
      const auto& m = member(get, t);
      JsonNode n = emptyList();
      const auto write = [&](const auto& list) {
        for (const auto& one : list) n.children.push_back(writeObject(*o, &one));
        return std::optional(n);
      };
      if constexpr (is_optional<std::remove_cvref_t<decltype(m)>>)
        return m ? write(*m) : std::nullopt;
      else
        return write(m);
    };
    return *this;
  }
  template <class Get>
  Table& texts(const std::string& key, Get get, const std::string& doc) {
    Field& f = add(key, Kind::text_list, doc);
    f.read = [=](const Entry& p, void* t) {
      auto& m = member(get, t);
      m.clear();
      readItems(p, "texts", [&](const Entry& item) { m.push_back(readText(item)); });
    };
    f.write = [=](const void* t) -> std::optional<JsonNode> {
      JsonNode n = emptyList();
      for (const std::string& m : member(get, t)) n.children.push_back(nodeOf(m));
      return n;
    };
    return *this;
  }
  /// A field with its own reading and writing: read(entry, T&), write(const T&) -> optional<JsonNode>.
  template <class Read, class Write>
  Table& custom(Field field, Read read, Write write) {
    Field& f = add(field.key, field.kind, field.doc);
    f = std::move(field);
    f.read = [=](const Entry& p, void* t) { read(p, *static_cast<T*>(t)); };
    f.write = [=](const void* t) { return write(*static_cast<const T*>(t)); };
    return *this;
  }

  /// These speak of the field added last.
  Table& required() {
    object_.fields.back().required = true;
    return *this;
  }
  Table& defaultsTo(const std::string& note) {
    object_.fields.back().default_note = note;
    return *this;
  }
  /// A choice, a flag or a number that is not written where it is the default, so that cases that do without it stay as
  /// they are.
  Table& unwritten() {
    Field& f = object_.fields.back();
    const T defaults{};
    const std::optional<JsonNode> usual = f.write(&defaults);
    f.default_note = f.kind == Kind::choice    ? usual->text
                     : f.kind == Kind::boolean ? std::string(usual->boolean ? "true" : "false")
                                               : fmt::format("{:g}", usual->number);
    f.write = [write = f.write, usual](const void* t) -> std::optional<JsonNode> {
      const std::optional<JsonNode> node = write(t);
      const bool other = node && (node->text != usual->text || node->number != usual->number ||
                                  node->boolean != usual->boolean);
      return other ? node : std::nullopt;
    };
    return *this;
  }
  Table& in(const std::string& alternatives) {
    object_.fields.back().alternatives = alternatives;
    return *this;
  }

  /// Says that exactly one (required) or at most one of the fields in `alternatives` is given.
  Table& oneOf(const std::string& alternatives, bool required_) {
    object_.alternatives.push_back({alternatives, required_});
    return *this;
  }
  template <class Check>
  Table& check(Check check) {
    object_.check = [=](const Entry& p, void* t) { check(p, *static_cast<T*>(t)); };
    return *this;
  }

  Object build() {
    const T defaults{};
    for (Field& f : object_.fields)
      if (!f.required && f.alternatives.empty() && f.default_note.empty() && f.kind != Kind::object)
        f.default_value = f.write(&defaults);
    return std::move(object_);
  }

 private:
  template <class Get>
  static auto& member(Get get, void* t) {
    return std::invoke(get, *static_cast<T*>(t));
  }
  template <class Get>
  static const auto& member(Get get, const void* t) {
    return std::invoke(get, *static_cast<const T*>(t));
  }
  template <class M>
  static auto& listOf(M& m) {
    if constexpr (is_optional<M>)
      return m ? *m : m.emplace();
    else
      return m;
  }
  static std::optional<JsonNode> writeMember(double x) { return nodeOf(x); }
  static std::optional<JsonNode> writeMember(int x) { return nodeOf(static_cast<double>(x)); }
  static std::optional<JsonNode> writeMember(const Vec3& v) { return nodeOf(v); }
  static std::optional<JsonNode> writeMember(const std::optional<int>& x) {
    return x ? std::optional(nodeOf(static_cast<double>(*x))) : std::nullopt;
  }
  static std::optional<JsonNode> writeMember(const std::optional<Vec3>& v) {
    return v ? std::optional(nodeOf(*v)) : std::nullopt;
  }
  static std::optional<JsonNode> writeMember(const std::string& s) {
    return s.empty() ? std::nullopt : std::optional(nodeOf(s));
  }
  static std::optional<JsonNode> writeMember(const std::optional<double>& x) {
    return x ? std::optional(nodeOf(*x)) : std::nullopt;
  }

  Field& add(const std::string& key, Kind kind, const std::string& doc) {
    Field f;
    f.key = key;
    f.kind = kind;
    f.doc = doc;
    object_.fields.push_back(std::move(f));
    return object_.fields.back();
  }

  Object object_;
};

}  // namespace gambeson::schema
