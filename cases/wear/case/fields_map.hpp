#pragma once
/// The key `map` of recorded motions and characters.

#include "cases/input/table.hpp"

namespace gambeson::schema {

/// A map by its name, or the path of one against the case's folder.
inline Field mapField(const std::string& doc, const std::string& note) {
  Field f;
  f.key = "map";
  f.kind = Kind::text;
  f.doc = doc;
  f.default_note = note;
  return f;
}
inline std::string readMap(const Entry& p) {
  const std::string word = readText(p);
  return word.find_first_of("./") == std::string::npos ? word : readPath(p).string();
}

}  // namespace gambeson::schema
