#pragma once
/// Rules between the keys of a garment or a sheet that say what kind of cloth it is.

#include "cases/cloth/kind.hpp"
#include "cases/input/schema.hpp"

namespace gambeson::schema {

/// Throws InputError where `entry` has keys of bending that its kind of cloth has no use for.
void checkBending(const Entry& entry, const ClothModel& model);

}  // namespace gambeson::schema
