#include "cases/cloth/regions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "cases/input/schema.hpp"
#include "core/error.hpp"

namespace gambeson {
namespace {

constexpr int kHundredths = 100;

int hundredths(double fraction) { return static_cast<int>(std::lround(kHundredths * fraction)); }

/// A part of a region on one patch.
struct Placed {
  std::size_t region = 0, part = 0;
  const RegionRectangle* rectangle = nullptr;
};

[[noreturn]] void reject(const Placed& at, const char* key, const std::string& reason) {
  throw InputError({"", 0, fmt::format("regions[{}].parts[{}].{}", at.region, at.part, key)}, reason);
}

/// Of each patch the parts that lie on it.
std::vector<std::vector<Placed>> partsByPatch(const std::vector<RegionCase>& regions, const Garment& g) {
  static const RegionRectangle whole;
  std::vector<std::vector<Placed>> on(g.patches.size());
  for (std::size_t i = 0; i < regions.size(); ++i)
    for (std::size_t k = 0; k < std::max<std::size_t>(regions[i].parts.size(), 1); ++k) {
      const Placed placed{i, k, regions[i].parts.empty() ? &whole : &regions[i].parts[k]};
      const std::string& patch = placed.rectangle->patch;
      const auto named = std::find(g.patch_names.begin(), g.patch_names.end(), patch);
      if (!patch.empty() && named == g.patch_names.end())
        reject(
            placed, "patch",
            fmt::format("there is no patch \"{}\"; allowed: {}", patch,
                        g.patch_names.empty() ? "none, as its patches have no names" : schema::joined(g.patch_names)));
      for (std::size_t p = 0; p < on.size(); ++p)
        if (patch.empty() || p == static_cast<std::size_t>(named - g.patch_names.begin())) on[p].push_back(placed);
    }
  return on;
}

/// How many equal parts of a patch's range have all borders between them.
int equalParts(const std::vector<Placed>& placed, std::array<double, 2> RegionRectangle::*range) {
  int step = kHundredths;
  for (const Placed& one : placed)
    for (const double border : one.rectangle->*range) step = std::gcd(step, hundredths(border));
  return kHundredths / step;
}

/// Of `parts` equal ones those from first to last.
std::array<int, 2> within(const std::array<double, 2>& range, int parts) {
  return {hundredths(range[0]) * parts / kHundredths, hundredths(range[1]) * parts / kHundredths};
}

}  // namespace

void applyRegions(const std::vector<RegionCase>& regions, Garment& g) {
  if (regions.empty()) return;
  const std::vector<std::vector<Placed>> on = partsByPatch(regions, g);
  g.fields.resize(g.patches.size());
  for (std::size_t p = 0; p < on.size(); ++p) {
    if (on[p].empty()) continue;
    const std::string patch = g.patch_names.empty() ? fmt::format("{}", p) : g.patch_names[p];
    if (g.fields[p].thickness)
      reject(on[p][0], "patch", fmt::format("patch {} has a field of its thickness already (fields)", patch));
    PatchField field{0, equalParts(on[p], &RegionRectangle::u), equalParts(on[p], &RegionRectangle::v), {}};
    field.values.assign(static_cast<std::size_t>(field.count_u) * static_cast<std::size_t>(field.count_v), 1);
    std::vector<const Placed*> owner(field.values.size(), nullptr);
    for (const Placed& one : on[p]) {
      const auto [u_from, u_to] = within(one.rectangle->u, field.count_u);
      const auto [v_from, v_to] = within(one.rectangle->v, field.count_v);
      for (int v = v_from; v < v_to; ++v)
        for (int u = u_from; u < u_to; ++u) {
          const auto at = static_cast<std::size_t>(u + field.count_u * v);
          if (owner[at])
            reject(one, "patch",
                   fmt::format("shares cloth of patch {} with region \"{}\"; allowed: parts that lie apart", patch,
                               regions[owner[at]->region].name));
          owner[at] = &one;
          field.values[at] = regions[one.region].thickness;
        }
    }
    // 1 everywhere is no field: the bits of a garment without regions.
    if (std::any_of(field.values.begin(), field.values.end(), [](double f) { return f != 1; }))
      g.fields[p].thickness = std::move(field);
  }
}

double largestFactor(const std::vector<RegionCase>& regions) {
  double largest = 1;
  for (const RegionCase& r : regions) largest = std::max(largest, r.thickness);
  return largest;
}

}  // namespace gambeson
