#pragma once
/// The tables of what cloth touches.

#include <span>

#include "cases/contact/contact.hpp"
#include "cases/input/table.hpp"

namespace gambeson::schema {

Object obstacleTable();  ///< ObstacleCase
Object contactTable();   ///< ContactCase

/// A number (model C) or an object.
Field frictionField(const char* key, const std::string& doc);
FrictionLaw readFriction(const Entry& entry);
JsonNode writeFriction(const FrictionLaw& law);

/// A friction of its own, where there is one.
template <class T>
void ownFriction(Table<T>& table, const char* key, std::optional<FrictionLaw> T::*member, const std::string& doc) {
  Field f = frictionField(key, doc);
  f.default_note = "friction of contact";
  table.custom(
      f, [=](const Entry& p, T& t) { t.*member = readFriction(p); },
      [=](const T& t) { return t.*member ? std::optional(writeFriction(*(t.*member))) : std::nullopt; });
}

/// Each obstacle of the list "obstacles" has a name of its own.
void checkObstacleNames(const Entry& root, std::span<const ObstacleCase> obstacles);

}  // namespace gambeson::schema
