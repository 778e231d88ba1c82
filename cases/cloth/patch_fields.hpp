#pragma once
/// The key `fields` of sheets and garments: thickness, fibre angle and material that vary over their patches.

#include <optional>
#include <string>
#include <vector>

#include "core/cloth/draft/garment.hpp"

namespace gambeson {

/// Fields over one patch, by its number or its name; over every patch that no other entry names where it has neither.
struct FieldsCase {
  std::optional<int> patch;
  std::string name;
  PatchFields fields;
};

/// Puts the fields on their patches. Throws InputError whose key is "fields[i].patch" where there is no such patch, or
/// two entries are of the same one.
void applyFields(const std::vector<FieldsCase>& fields, Garment& garment);

/// Whether the values of one entry fit: throws InputError whose key is relative to it ("thickness.values").
void checkFields(const FieldsCase& fields, const Fabric& fabric, const std::vector<Fabric>& others);

/// No point of a cloth of this fabric with these fields is thicker [m].
double largestThickness(const Fabric& fabric, const std::vector<Fabric>& others, const std::vector<FieldsCase>& fields);

}  // namespace gambeson
