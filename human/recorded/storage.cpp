#include "human/recorded/storage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>

#include "core/error.hpp"
#include "human/files/read_text.hpp"
#include "human/files/text_lines.hpp"

namespace gambeson {
namespace {

std::string lower(std::string_view text) {
  std::string s(text);
  std::transform(s.begin(), s.end(), s.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return s;
}

/// What the header says.
struct Header {
  std::optional<bool> in_degrees;
  bool simm = false;  ///< of SIMM's kind, whose angles are in degrees where nothing is said
  std::optional<double> rows, columns;
};

void readHeaderLine(const TextLines& lines, Header& h) {
  const std::string text = lower(lines.text());
  const std::size_t equals = text.find('=');
  std::string key = text.substr(0, equals), value = equals == std::string::npos ? "" : text.substr(equals + 1);
  const auto trim = [](std::string& s) {
    s.erase(0, std::min(s.find_first_not_of(" \t"), s.size()));
    s.erase(s.find_last_not_of(" \t") + 1);
  };
  trim(key), trim(value);
  if (key == "indegrees") {
    if (value != "yes" && value != "no") lines.fail("'" + value + "' is not allowed: yes or no", "inDegrees");
    h.in_degrees = value == "yes";
  }
  if (equals == std::string::npos && !h.in_degrees && key.starts_with("angles are in "))
    h.in_degrees = key.find("degrees") != std::string::npos;
  const auto words = lines.words();
  double n = 0;
  if (equals == std::string::npos && words.size() == 2) key = lower(words[0]), value = words[1];
  h.simm = h.simm || key == "datarows" || key == "datacolumns";
  if ((key == "nrows" || key == "datarows") && parseNumber(value, n)) h.rows = n;
  if ((key == "ncolumns" || key == "datacolumns") && parseNumber(value, n)) h.columns = n;
}

/// OpenSim 4 calls a coordinate by its path in the model: "/jointset/hip_r/hip_flexion_r/value" is hip_flexion_r.
std::string_view coordinateOf(std::string_view label) {
  constexpr std::string_view value = "/value";
  if (!label.starts_with('/') || !label.ends_with(value)) return label;
  label.remove_suffix(value.size());
  return label.substr(label.rfind('/') + 1);
}

}  // namespace

int StorageTable::column(const std::string& name) const {
  const auto at = std::find(names.begin(), names.end(), name);
  return at == names.end() ? -1 : static_cast<int>(at - names.begin());
}

StorageTable readStorage(const std::filesystem::path& file) {
  TextLines lines(file);
  StorageTable table;
  table.file = file.string();
  Header header;
  bool ended = false;
  while (!ended && lines.next()) {
    const auto words = lines.words();
    if (words.size() == 1 && lower(words[0]) == "endheader")
      ended = true;
    else
      readHeaderLine(lines, header);
  }
  if (!ended) throw InputError({table.file, 0, ""}, "is no OpenSim table: it has no line 'endheader'");
  if (!header.in_degrees && header.simm) {
    header.in_degrees = true;
    table.notes.emplace_back("the header does not say in what its angles are: degrees, as in SIMM's motions");
  }
  if (!header.in_degrees)
    lines.fail("the header does not say in what its angles are: add inDegrees=yes or inDegrees=no", "inDegrees");
  table.in_degrees = *header.in_degrees;
  if (!lines.nextFull()) lines.fail("ends before the line of labels");
  const auto labels = lines.words();
  if (lower(labels[0]) != "time") lines.fail(fmt::format("the first label is '{}', not time", labels[0].substr(0, 40)));
  if (labels.size() < 2) lines.fail("names nothing but time");
  std::set<std::string_view> seen;
  for (std::size_t k = 1; k < labels.size(); ++k) {
    const std::string_view name = coordinateOf(labels[k]);
    if (name.empty() || !seen.insert(name).second) lines.fail("stands twice", std::string(labels[k]));
    table.names.emplace_back(name);
  }
  table.columns.resize(table.names.size());
  while (lines.nextFull()) {
    const auto cells = lines.words();
    if (cells.size() != labels.size())
      lines.fail(fmt::format("has {} values; there are {} labels", cells.size(), labels.size()));
    const double t = lines.number(cells[0], 1, "time");
    checkNextTime(lines, table.times, t);
    table.times.push_back(t);
    table.lines.push_back(lines.line());
    for (std::size_t k = 1; k < cells.size(); ++k)
      table.columns[k - 1].push_back(lines.number(cells[k], k + 1, table.names[k - 1]));
  }
  if (table.times.size() < 2) lines.fail("needs at least two rows of values");
  const auto rows = static_cast<double>(table.times.size()), columns = static_cast<double>(labels.size());
  if (header.rows && *header.rows != rows)
    table.notes.push_back(fmt::format("the header names {} rows, the file holds {}", *header.rows, rows));
  if (header.columns && *header.columns != columns)
    table.notes.push_back(fmt::format("the header names {} columns, the file holds {}", *header.columns, columns));
  return table;
}

}  // namespace gambeson
