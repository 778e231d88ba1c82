#pragma once
/// The keys that all supports have that hold points.

#include "cases/contact/fields.hpp"
#include "cases/wear/case/case.hpp"

namespace gambeson::schema {

template <class S>
void heldFields(Table<S>& table) {
  driveField(table, &S::drive, "how it is moved over time, from where it stands");
  table
      .number("release", &S::release_s, "s", aboveTo(0, 1e6),
              "when it lets go, at the end of the window (output.window) in which that is")
      .defaultsTo("never");
}

}  // namespace gambeson::schema
