/// Detail of pattern.hpp: edges by name.

#include "core/error.hpp"
#include "tryon/pattern/pattern.hpp"

namespace gambeson {
namespace {
[[noreturn]] void unknown(const std::string& name, const std::string& allowed) {
  throw InputError({"", 0, "edge"}, "\"" + name + "\" is not an edge of this garment; allowed: " + allowed);
}
}  // namespace

std::vector<PatchEdge> sheetEdge(const std::string& name) {
  if (name == "u0") return {{0, Side::u0}};
  if (name == "u1") return {{0, Side::u1}};
  if (name == "v0") return {{0, Side::v0}};
  if (name == "v1") return {{0, Side::v1}};
  unknown(name, "u0, u1, v0, v1");
}

std::vector<PatchEdge> tubeEdge(const TubePattern& pattern, const std::string& name) {
  if (name != "start" && name != "end") unknown(name, "start, end");
  std::vector<PatchEdge> out;
  for (int n = 0; n < pattern.patches; ++n) out.push_back({n, name == "start" ? Side::v0 : Side::v1});
  return out;
}

std::vector<PatchEdge> shortsEdge(const std::string& name) {
  if (name == "waist") return {{trunk_left, Side::v1}, {trunk_right, Side::v1}};
  if (name == "hem_left") return {{outer_left, Side::v0}, {inner_left, Side::v0}};
  if (name == "hem_right") return {{outer_right, Side::v0}, {inner_right, Side::v0}};
  unknown(name, "waist, hem_left, hem_right");
}

}  // namespace gambeson
