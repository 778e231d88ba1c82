#pragma once
/// A cell of yarns as other things than its own case take it: the file of a case of the kind cell, for what it says of
/// its yarns.

#include <memory>
#include <string>

#include "cases/input/schema.hpp"
#include "cases/yarns/cell_design.hpp"
#include "core/yarn/cell_energy.hpp"

namespace gambeson {

struct CellFile {
  std::string name;
  CellDesign design;
};

namespace schema {
/// Reads and checks such a file, or what a case keeps of it. Loads, bars and output have no part in it and are not
/// looked at. Throws InputError with file, line and key.
CellFile readCellFile(const Entry& entry);
JsonNode nodeOf(const CellFile& cell);

/// A cloth whose law is this cell, solved at every point. `entry` is the cell's, for keys that building it finds wrong.
/// Throws InputError where yarns are no rods, or the cell cannot be built or bent, or is not stable at rest.
std::shared_ptr<const CellEnergy> energyOf(const Entry& entry, const CellFile& cell);
}  // namespace schema

}  // namespace gambeson
