#pragma once
/// Rules between the keys of a garment or a sheet that say what kind of cloth it is.

#include "cases/cloth/fabric.hpp"
#include "cases/cloth/kind.hpp"
#include "cases/input/schema.hpp"

namespace gambeson::schema {

/// Throws InputError where `entry` has keys of bending that its kind of cloth has no use for.
void checkBending(const Entry& entry, const ClothModel& model);

/// Throws InputError where `entry` has springs or a shell that its kind of cloth has no use for, or cloth is to be made
/// of a fabric that has more than its kind can be.
void checkNodes(const Entry& entry, const ClothModel& model, const Fabric& fabric);

/// Throws InputError where the law of a fabric is a cell of yarns, which static cases alone solve. `entry`: the
/// fabric's.
void refuseCell(const Entry& entry, const FabricCase& fabric);

}  // namespace gambeson::schema
