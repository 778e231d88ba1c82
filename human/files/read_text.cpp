#include "human/files/read_text.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <fstream>

#include "core/error.hpp"

namespace gambeson {

std::string readText(const std::filesystem::path& file, std::uintmax_t max_bytes) {
  const auto fail = [&](const std::string& reason) { throw InputError({file.string(), 0, ""}, reason); };
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (status.type() == std::filesystem::file_type::not_found) fail("there is no such file");
  if (error) fail("cannot be read: " + error.message());
  if (std::filesystem::is_directory(status)) fail("is a folder, not a file");
  if (!std::filesystem::is_regular_file(status)) fail("is not a regular file");
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  if (error) fail("cannot be read: " + error.message());
  if (size == 0) fail("is empty");
  if (size > max_bytes) fail(fmt::format("has {} bytes; at most {} are read", size, max_bytes));
  std::ifstream in(file, std::ios::binary);
  std::string text(size, '\0');
  if (!in || !in.read(text.data(), static_cast<std::streamsize>(size))) fail("cannot be read");
  return text;
}

bool parseNumber(std::string_view text, double& value) {
  constexpr std::string_view blank = " \t\r\n";
  const std::size_t begin = text.find_first_not_of(blank), end = text.find_last_not_of(blank);
  if (begin == std::string_view::npos) return false;
  text = text.substr(begin, end - begin + 1);
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && stop == text.data() + text.size() && std::isfinite(value);
}

}  // namespace gambeson
