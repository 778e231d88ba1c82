#pragma once
/// A table of a recording as its readers see it: by the names of its columns.

#include <map>
#include <string>
#include <vector>

namespace gambeson {

/// Rows of a table in the order of time. Nothing tells where a column stands.
class RecordedTable {
 public:
  RecordedTable(std::string name, const std::vector<std::string>& columns,
                const std::vector<std::vector<double>>& rows);

  std::size_t rows() const { return rows_; }
  bool empty() const { return rows_ == 0; }
  bool has(const std::string& name) const { return columns_.contains(name); }
  /// One value per row. Throws RunError where the table has no such column.
  const std::vector<double>& column(const std::string& name) const;
  /// The rows for which keep(row) is true.
  template <class Keep>
  RecordedTable where(Keep keep) const {
    RecordedTable kept(name_);
    for (const auto& [name, values] : columns_) {
      std::vector<double>& to = kept.columns_[name];
      for (std::size_t row = 0; row < rows_; ++row)
        if (keep(row)) to.push_back(values[row]);
      kept.rows_ = to.size();
    }
    return kept;
  }

 private:
  explicit RecordedTable(std::string name) : name_(std::move(name)) {}

  std::string name_;
  std::map<std::string, std::vector<double>> columns_;
  std::size_t rows_ = 0;
};

}  // namespace gambeson
