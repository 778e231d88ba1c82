#pragma once
/// A text file line by line, its cells, and errors that say where.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace gambeson {

/// Lines are numbered from 1; carriage returns and blanks at their ends are taken off.
class TextLines {
 public:
  explicit TextLines(const std::filesystem::path& file);
  /// The next line; false at the end of the text.
  bool next();
  /// The next line that is not blank.
  bool nextFull();
  const std::string& file() const { return file_; }
  int line() const { return line_; }
  std::string_view text() const { return text_; }
  /// Cells between blanks and tabs.
  std::vector<std::string_view> words() const;
  /// Cells between tabs; they may be empty.
  std::vector<std::string_view> tabbed() const;
  [[noreturn]] void fail(const std::string& reason, const std::string& key = "") const;
  /// A finite number or a message that names the cell (counted from 1) and what it stands for.
  double number(std::string_view cell, std::size_t column, std::string_view name) const;

 private:
  std::string file_, all_;
  std::string_view rest_, text_;
  int line_ = 0;
};

/// The most frames of a recorded motion that are read, and the longest that one is played [s].
constexpr std::size_t most_rows = 300000;
constexpr double longest_s = 3600;
/// Frames nearer to each other than this are none [s]: their rates are no numbers.
constexpr double nearest_s = 1e-9;

/// Why `t` cannot be the time after `before`; empty where it can.
std::string notAfter(double t, double before);

/// Time stamps must ascend and stay within 1e6 s; there are at most `most_rows`.
void checkNextTime(const TextLines& lines, const std::vector<double>& before, double t);

}  // namespace gambeson
