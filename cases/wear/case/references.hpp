#pragma once
/// What a case names elsewhere: files that must read well, joints and links that the human must have.

#include "cases/input/schema.hpp"
#include "cases/wear/case/case.hpp"

namespace gambeson::schema {

/// Reads the human, its motion and the meshes, and throws InputError where one does not read (its own file and line) or
/// where the case names a joint or a link that is not there, or a time beyond the motion (the case's line).
void checkReferences(const Entry& root, const Case& c);

}  // namespace gambeson::schema

namespace gambeson {

/// How long a case follows its motion: its own duration, or that of the motion [s].
double plannedDuration(const Case& c);

}  // namespace gambeson
