#pragma once
/// Tables as CSV (RFC 4180 with \n), numbers in the shortest form that reads back to the same double.

#include <filesystem>
#include <string>
#include <vector>

namespace gambeson {

/// The shortest decimal that reads back to the same bits (std::to_chars): 0.1, 1e-09, nan, inf.
std::string shortest(double value);

/// A header of `columns`, then `rows`; each row has one value per column.
std::string formatCsv(const std::vector<std::string>& columns, const std::vector<std::vector<double>>& rows);

/// formatCsv into `path`, atomically; throws RunError with the reason.
void writeCsv(const std::filesystem::path& path, const std::vector<std::string>& columns,
              const std::vector<std::vector<double>>& rows);

/// A table whose first column is a text: `labels` names it, and each label leads its row.
std::string formatCsv(const std::string& label_column, const std::vector<std::string>& labels,
                      const std::vector<std::string>& columns, const std::vector<std::vector<double>>& rows);

}  // namespace gambeson
