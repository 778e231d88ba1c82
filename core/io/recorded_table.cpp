#include "core/io/recorded_table.hpp"

#include "core/error.hpp"

namespace gambeson {

RecordedTable::RecordedTable(std::string name, const std::vector<std::string>& columns,
                             const std::vector<std::vector<double>>& rows)
    : name_(std::move(name)), rows_(rows.size()) {
  for (std::size_t c = 0; c < columns.size(); ++c) {
    std::vector<double>& to = columns_[columns[c]];
    if (!to.empty()) throw RunError("the recording's table " + name_ + " has two columns \"" + columns[c] + "\"");
    for (const std::vector<double>& row : rows) to.push_back(row[c]);
  }
}

const std::vector<double>& RecordedTable::column(const std::string& name) const {
  const auto at = columns_.find(name);
  if (at == columns_.end()) throw RunError("the recording's table " + name_ + " has no column \"" + name + "\"");
  return at->second;
}

}  // namespace gambeson
