#include "cases/runs/disk_space.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace gambeson {

namespace {

constexpr double much_bytes = 10e9;

std::string sizeText(double bytes) {
  return bytes < 1e9    ? fmt::format("{:.0f} MB", bytes / 1e6)
         : bytes < 1e12 ? fmt::format("{:.3g} GB", bytes / 1e9)
                        : fmt::format("{:.3g} TB", bytes / 1e12);
}

}  // namespace

std::string sizeNote(double bytes, double free_bytes) {
  if (!(bytes > much_bytes) && !(bytes > 0.5 * free_bytes)) return "";
  return fmt::format(
      "the recording is going to take about {}{}; longer output.frame, output.window and "
      "output.checkpoint (of a structure: output.interval, output.shapes) make it smaller",
      sizeText(bytes), std::isfinite(free_bytes) ? fmt::format(", and {} are free there", sizeText(free_bytes)) : "");
}

double freeBytes(const std::filesystem::path& folder) {
  std::error_code error;
  const std::filesystem::space_info space = std::filesystem::space(folder, error);
  return error ? std::numeric_limits<double>::quiet_NaN() : static_cast<double>(space.available);
}

}  // namespace gambeson
