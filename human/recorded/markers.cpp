#include "human/recorded/markers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>

#include "core/error.hpp"
#include "human/files/read_text.hpp"
#include "human/files/text_lines.hpp"

namespace gambeson {
namespace {

struct Header {
  double metres = 0;
  double frames = -1, markers = -1;
};

Header readHeader(TextLines& lines) {
  if (!lines.nextFull() || !lines.text().starts_with("PathFileType"))
    lines.fail("is no .trc file: the first line must start with PathFileType");
  if (!lines.nextFull()) lines.fail("ends within its header");
  const std::vector<std::string_view> names = lines.words();
  if (!lines.nextFull()) lines.fail("ends within its header");
  const std::vector<std::string_view> values = lines.words();
  if (values.size() != names.size())
    lines.fail(fmt::format("has {} values for the {} names above", values.size(), names.size()));
  Header h;
  const std::map<std::string, double, std::less<>> units{{"mm", 1e-3}, {"cm", 1e-2},  {"dm", 0.1},
                                                         {"m", 1},     {"meters", 1}, {"millimeters", 1e-3}};
  for (std::size_t k = 0; k < names.size(); ++k) {
    if (names[k] == "Units") {
      const auto unit = units.find(values[k]);
      if (unit == units.end())
        lines.fail(fmt::format("'{}' is not allowed: mm, cm, dm or m", values[k].substr(0, 40)), "Units");
      h.metres = unit->second;
    }
    if (names[k] == "NumFrames") h.frames = lines.number(values[k], k + 1, names[k]);
    if (names[k] == "NumMarkers") h.markers = lines.number(values[k], k + 1, names[k]);
  }
  if (!(h.metres > 0)) lines.fail("the header does not name the Units");
  return h;
}

}  // namespace

int MarkerTable::marker(const std::string& name) const {
  const auto at = std::find(names.begin(), names.end(), name);
  return at == names.end() ? -1 : static_cast<int>(at - names.begin());
}

MarkerTable readTrc(const std::filesystem::path& file) {
  TextLines lines(file);
  MarkerTable table;
  table.file = file.string();
  const Header header = readHeader(lines);
  if (!lines.nextFull()) lines.fail("ends before the names of the markers");
  const auto labels = lines.tabbed();
  if (labels.size() < 3 || labels[0] != "Frame#" || labels[1] != "Time")
    lines.fail("the labels must start with Frame# and Time");
  std::set<std::string_view> seen;
  for (std::size_t k = 2; k < labels.size(); ++k) {  // each name stands over the first of three columns
    if (labels[k].empty()) continue;
    if ((k - 2) % 3 != 0) lines.fail("does not stand over the first of three columns", std::string(labels[k]));
    if (!seen.insert(labels[k]).second) lines.fail("stands twice", std::string(labels[k]));
    if (table.names.size() != (k - 2) / 3) lines.fail("a marker before it has no name", std::string(labels[k]));
    table.names.emplace_back(labels[k]);
  }
  if (table.names.empty()) lines.fail("names no marker");
  if (!lines.nextFull() || lines.words().front() != "X1") lines.fail("the line of X1, Y1, Z1, ... is missing");

  const std::size_t full = 2 + 3 * table.names.size();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  while (lines.nextFull()) {
    auto cells = lines.tabbed();
    while (cells.size() > full && cells.back().empty()) cells.pop_back();  // tabs at the end of the line
    if (cells.size() > full) lines.fail(fmt::format("has {} values; the labels name {}", cells.size(), full));
    if (cells.size() < 3) lines.fail(fmt::format("has {} values; the labels name {}", cells.size(), full));
    const double t = lines.number(cells[1], 2, "Time");
    checkNextTime(lines, table.times, t);
    table.times.push_back(t);
    cells.resize(full);  // markers unseen at the end of a line may have no tabs
    auto& row = table.positions.emplace_back();
    for (std::size_t m = 0; m < table.names.size(); ++m) {
      const std::size_t k = 2 + 3 * m;
      const int empty = cells[k].empty() + cells[k + 1].empty() + cells[k + 2].empty();
      if (empty == 3) {
        row.push_back({nan, nan, nan});
        continue;
      }
      if (empty > 0)
        lines.fail("has only some of its three coordinates", fmt::format("column {} '{}'", k + 1, table.names[m]));
      Vec3 p;
      for (int i = 0; i < 3; ++i) p[i] = lines.number(cells[k + i], k + i + 1, table.names[m]);
      row.push_back(header.metres * p);
    }
  }
  if (table.times.size() < 2) lines.fail("needs at least two frames");
  const auto frames = static_cast<double>(table.times.size()), markers = static_cast<double>(table.names.size());
  if (header.frames >= 0 && header.frames != frames)
    table.notes.push_back(fmt::format("the header names {} frames, the file holds {}", header.frames, frames));
  if (header.markers >= 0 && header.markers != markers)
    table.notes.push_back(fmt::format("the header names {} markers, the file holds {}", header.markers, markers));
  return table;
}

}  // namespace gambeson
