#pragma once
/// What tables of a study's fields share.

#include <optional>
#include <string>

#include "cases/input/table.hpp"

namespace gambeson::study {

/// A field that is kept as it is written.
template <class T>
void rawField(schema::Table<T>& table, const std::string& key, JsonNode T::*member, const std::string& doc,
              const std::string& note = "none") {
  schema::Field f;
  f.key = key;
  f.kind = schema::Kind::any;
  f.doc = doc;
  f.default_note = note;
  table.custom(
      f, [member](const schema::Entry& p, T& t) { t.*member = p.node; },
      [member](const T& t) {
        return (t.*member).type == JsonNode::Type::null ? std::nullopt : std::optional(t.*member);
      });
}

}  // namespace gambeson::study
