#include "core/io/csv.hpp"

#include <charconv>
#include <stdexcept>

#include "core/io/atomic_file.hpp"

namespace gambeson {
namespace {

/// RFC 4180: quoted where the text holds a comma, a quote or a line break; quotes doubled.
std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string s = "\"";
  for (const char c : text) {
    if (c == '"') s += '"';
    s += c;
  }
  return s + '"';
}

void appendNumber(std::string& s, double value) {
  char buffer[32];
  s.append(buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr);
}

void appendRow(std::string& s, const std::vector<double>& row, std::size_t columns, bool after_label) {
  if (row.size() != columns)
    throw std::logic_error("a CSV row has " + std::to_string(row.size()) + " values for " + std::to_string(columns) +
                           " columns");
  for (std::size_t i = 0; i < row.size(); ++i) {
    if (i > 0 || after_label) s += ',';
    appendNumber(s, row[i]);
  }
  s += '\n';
}

}  // namespace

std::string shortest(double value) {
  std::string s;
  appendNumber(s, value);
  return s;
}

std::string formatCsv(const std::vector<std::string>& columns, const std::vector<std::vector<double>>& rows) {
  std::string s;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (i > 0) s += ',';
    s += quoted(columns[i]);
  }
  s += '\n';
  for (const auto& row : rows) appendRow(s, row, columns.size(), false);
  return s;
}

std::string formatCsv(const std::string& label_column, const std::vector<std::string>& labels,
                      const std::vector<std::string>& columns, const std::vector<std::vector<double>>& rows) {
  if (labels.size() != rows.size()) throw std::logic_error("a CSV table needs one label per row");
  std::string s = quoted(label_column);
  for (const auto& column : columns) {
    s += ',';
    s += quoted(column);
  }
  s += '\n';
  for (std::size_t r = 0; r < rows.size(); ++r) {
    s += quoted(labels[r]);
    appendRow(s, rows[r], columns.size(), true);
  }
  return s;
}

void writeCsv(const std::filesystem::path& path, const std::vector<std::string>& columns,
              const std::vector<std::vector<double>>& rows) {
  writeFileAtomically(path, formatCsv(columns, rows));
}

}  // namespace gambeson
