#pragma once
/// The tables of what cloth touches.

#include <span>

#include "cases/contact/contact.hpp"
#include "cases/input/schema.hpp"

namespace gambeson::schema {

Object obstacleTable();  ///< ObstacleCase
Object contactTable();   ///< ContactCase

/// Each obstacle of the list "obstacles" has a name of its own.
void checkObstacleNames(const Entry& root, std::span<const ObstacleCase> obstacles);

}  // namespace gambeson::schema
