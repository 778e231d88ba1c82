#include "human/files/text_lines.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/error.hpp"
#include "human/files/read_text.hpp"

namespace gambeson {
namespace {

constexpr std::uintmax_t largest_file = std::uintmax_t{128} << 20;
constexpr std::string_view blank = " \t\r";

}  // namespace

TextLines::TextLines(const std::filesystem::path& file) : file_(file.string()), all_(readText(file, largest_file)) {
  if (all_.find('\0') != std::string::npos) throw InputError({file_, 0, ""}, "is not text (it holds a zero byte)");
  rest_ = all_;
}

bool TextLines::next() {
  if (rest_.empty()) return false;
  const std::size_t end = rest_.find('\n');
  text_ = rest_.substr(0, end);
  rest_ = end == std::string_view::npos ? std::string_view{} : rest_.substr(end + 1);
  while (!text_.empty() && text_.back() == '\r') text_.remove_suffix(1);
  ++line_;
  return true;
}

bool TextLines::nextFull() {
  while (next())
    if (text_.find_first_not_of(blank) != std::string_view::npos) return true;
  return false;
}

std::vector<std::string_view> TextLines::words() const {
  std::vector<std::string_view> out;
  for (std::size_t b = text_.find_first_not_of(blank); b != std::string_view::npos;) {
    const std::size_t e = text_.find_first_of(blank, b);
    out.push_back(text_.substr(b, e == std::string_view::npos ? e : e - b));
    b = e == std::string_view::npos ? e : text_.find_first_not_of(blank, e);
  }
  return out;
}

std::vector<std::string_view> TextLines::tabbed() const {
  std::vector<std::string_view> out;
  for (std::string_view s = text_;;) {
    const std::size_t tab = s.find('\t');
    std::string_view cell = s.substr(0, tab);
    const std::size_t b = cell.find_first_not_of(' '), e = cell.find_last_not_of(' ');
    out.push_back(b == std::string_view::npos ? std::string_view{} : cell.substr(b, e - b + 1));
    if (tab == std::string_view::npos) return out;
    s.remove_prefix(tab + 1);
  }
}

void TextLines::fail(const std::string& reason, const std::string& key) const {
  throw InputError({file_, line_, key}, reason);
}

double TextLines::number(std::string_view cell, std::size_t column, std::string_view name) const {
  double value = 0;
  if (!parseNumber(cell, value))
    fail(fmt::format("'{}' is not a finite number", cell.substr(0, 40)), fmt::format("column {} '{}'", column, name));
  return value;
}

std::string notAfter(double t, double before) {
  if (!(t > before)) return fmt::format("{} does not come after {}", t, before);
  return t - before >= nearest_s ? "" : fmt::format("{} comes less than {} s after {}", t, nearest_s, before);
}

void checkNextTime(const TextLines& lines, const std::vector<double>& before, double t) {
  if (before.size() >= most_rows) lines.fail(fmt::format("is one row too many: at most {} are read", most_rows));
  if (!before.empty())
    if (const std::string why = notAfter(t, before.back()); !why.empty()) lines.fail(why, "time");
  if (!(std::abs(t) <= 1e6)) lines.fail(fmt::format("{} is beyond 1e6 s", t), "time");
}

}  // namespace gambeson
