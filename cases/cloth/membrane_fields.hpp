#pragma once
/// Keys of the membrane of cloth of triangles, which garments and sheets share.

#include <string>
#include <utility>
#include <vector>

#include "cases/cloth/kind.hpp"
#include "cases/input/table.hpp"
#include "core/material/fabric.hpp"

namespace gambeson::schema {

/// A number of MembraneModel and its key.
struct MembraneKey {
  const char* key;
  double MembraneModel::*number;
  bool springs, threads;  ///< of which elements it is
  const char* unit;
  const char* otherwise;  ///< what holds without it
  const char* doc;
};
const std::vector<MembraneKey>& membraneKeys();

std::vector<std::pair<std::string, MembraneElements>> membraneElements();

/// Adds the keys to the table of a T whose member `cloth` is a ClothModel.
template <class T>
void addMembraneFields(Table<T>& table) {
  table
      .choice(
          "membrane_elements", [](auto& t) -> auto& { return t.cloth.membrane.elements; }, membraneElements(),
          "of triangles: continuum, the fabric's own membrane; springs, one along each edge (Wong 2014, eq. 3.1), of "
          "Poisson's ratio 1/3 and with a shear that follows from them; baraff_witkin, threads along weft and warp and "
          "the cosine between them (eq. 3.3 to 3.7), of Poisson's ratio 0")
      .unwritten();
  for (const MembraneKey& k : membraneKeys())
    table
        .number(
            k.key, [number = k.number](auto& t) -> auto& { return t.cloth.membrane.*number; }, k.unit, aboveTo(0, 1e7),
            k.doc)
        .unwritten()
        .defaultsTo(k.otherwise);
}

/// Fails at keys that this cloth has no use for. `moves`: whether damping acts.
void checkMembrane(const Entry& entry, const ClothModel& model, const Fabric& fabric, bool moves);

}  // namespace gambeson::schema
