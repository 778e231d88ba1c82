#pragma once
/// The keys by which a support speaks of an edge.

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "cases/input/table.hpp"
#include "cases/wear/case/case.hpp"

namespace gambeson::schema {

/// "waist", "front.hem", "front.3", or "2.u0" for side u0 of patch 2.
inline const std::vector<std::string> side_names{"u0", "u1", "v0", "v1"};

template <class S>
void edgeField(Table<S>& table) {
  table
      .text(
          "garment", [](auto& s) -> auto& { return s.edge.garment; }, "whose edge it is, by the garment's name")
      .defaultsTo("the only garment; required where there are several");
  Field f;
  f.key = "edge";
  f.kind = Kind::text;
  f.required = true;
  f.doc =
      "which edge of the garment: waist, hem_left, hem_right of shorts and trousers; hem, neck_front, neck_back, "
      "belly_hem, cuff_left, cuff_right of a shirt; start, end of a tube; u0, u1, v0, v1 of a sheet; of a pattern "
      "panel and edge, by its name or number, such as front.hem, front.3; or patch and side, such as 2.u0";
  table.custom(
      f,
      [](const Entry& p, S& s) {
        const std::string& text = readText(p);
        const std::size_t dot_at = text.find('.');
        const std::string patch = text.substr(0, dot_at),
                          side = dot_at == std::string::npos ? "" : text.substr(dot_at + 1);
        const auto found = std::find(side_names.begin(), side_names.end(), side);
        if (patch.empty() || patch.size() > 4 || patch.find_first_not_of("0123456789") != std::string::npos ||
            found == side_names.end()) {
          s.edge.name = text;
          return;
        }
        s.edge.name.clear();
        s.edge.patch = std::stoi(patch);
        s.edge.side = static_cast<Side>(found - side_names.begin());
      },
      [](const S& s) {
        return std::optional(nodeOf(
            s.edge.name.empty() ? fmt::format("{}.{}", s.edge.patch, side_names[static_cast<std::size_t>(s.edge.side)])
                                : s.edge.name));
      });
}

}  // namespace gambeson::schema
