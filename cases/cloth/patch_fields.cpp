#include "cases/cloth/patch_fields.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cases/input/schema.hpp"
#include "core/error.hpp"

namespace gambeson {
namespace {

/// The patch that an entry is of; -1: all that no other is of.
int patchOf(const FieldsCase& f, const Garment& g, const std::string& key) {
  const int count = static_cast<int>(g.patches.size());
  const auto reject = [&](const std::string& reason) { throw InputError({"", 0, key}, reason); };
  if (!f.name.empty()) {
    for (int p = 0; p < static_cast<int>(g.patch_names.size()); ++p)
      if (g.patch_names[static_cast<std::size_t>(p)] == f.name) return p;
    reject(fmt::format("there is no patch \"{}\"; allowed: {}0 to {}", f.name,
                       g.patch_names.empty() ? "" : schema::joined(g.patch_names) + ", or ", count - 1));
  }
  if (!f.patch) return -1;
  if (*f.patch >= count) reject(fmt::format("there is no patch {}; allowed: 0 to {}", *f.patch, count - 1));
  return *f.patch;
}

}  // namespace

void applyFields(const std::vector<FieldsCase>& fields, Garment& g) {
  if (fields.empty()) return;
  std::vector<int> of;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const std::string key = fmt::format("fields[{}].patch", i);
    const int patch = patchOf(fields[i], g, key);
    if (std::find(of.begin(), of.end(), patch) != of.end())
      throw InputError({"", 0, key}, patch < 0 ? std::string("is required: another entry is of all patches already")
                                               : fmt::format("patch {} has fields already", patch));
    of.push_back(patch);
  }
  g.fields.resize(g.patches.size());
  for (std::size_t p = 0; p < g.patches.size(); ++p)
    for (const int wanted : {-1, static_cast<int>(p)})
      for (std::size_t i = 0; i < fields.size(); ++i)
        if (of[i] == wanted) g.fields[p] = fields[i].fields;
}

void checkFields(const FieldsCase& fields, const Fabric& fabric, const std::vector<Fabric>& others) {
  Garment one;
  one.patches.resize(1);
  one.fabric = fabric;
  one.other_fabrics = others;
  one.fields = {fields.fields};
  try {
    validateFields(one);
  } catch (const InputError& e) {
    throw InputError({"", 0, e.where().key.substr(std::string("fields[0].").size())}, e.reason());
  }
}

double largestThickness(const Fabric& fabric, const std::vector<Fabric>& others,
                        const std::vector<FieldsCase>& fields) {
  double thickness = fabric.thickness(), factor = 1;
  // Where an entry is of all patches, the plain fabric lies nowhere.
  if (std::any_of(fields.begin(), fields.end(), [](const FieldsCase& f) { return !f.patch && f.name.empty(); }))
    factor = 0;
  for (const FieldsCase& f : fields) {
    if (f.fields.material)
      for (const Fabric& other : others) thickness = std::max(thickness, other.thickness());
    // A B-spline lies within the range of its coefficients.
    double most = 1;
    if (f.fields.thickness)
      most = *std::max_element(f.fields.thickness->values.begin(), f.fields.thickness->values.end());
    factor = std::max(factor, most);
  }
  return factor * thickness;
}

}  // namespace gambeson
