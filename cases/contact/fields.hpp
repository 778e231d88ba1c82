#pragma once
/// The tables of what cloth touches.

#include <functional>
#include <span>

#include "cases/contact/contact.hpp"
#include "cases/input/table.hpp"

namespace gambeson::schema {

Object obstacleTable();  ///< ObstacleCase
Object contactTable();   ///< ContactCase
Object driveTable();     ///< Drive

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

/// A drive, where there is one, under the key "drive".
template <class T, class Get>
void driveField(Table<T>& table, Get get, const std::string& doc) {
  Field f = fieldOf("drive", Kind::object, "", any(), doc);
  f.object = std::make_shared<const Object>(driveTable());
  f.default_note = "none";
  table.custom(
      f, [=, o = f.object](const Entry& p, T& t) { readObject(*o, p, &std::invoke(get, t)); },
      [=, o = f.object](const T& t) {
        const Drive& d = std::invoke(get, t);
        return d.empty() ? std::nullopt : std::optional(writeObject(*o, &d));
      });
}

/// Each obstacle of the list "obstacles" has a name of its own.
void checkObstacleNames(const Entry& root, std::span<const ObstacleCase> obstacles);

}  // namespace gambeson::schema
