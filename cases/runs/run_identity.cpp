#include "cases/runs/run_identity.hpp"

#include <fmt/format.h>

#include "core/error.hpp"

namespace gambeson {

constexpr std::string_view kDevice = " device";

RunIdentity::RunIdentity(const std::string& text) {
  std::string rest = text;
  on_device = rest.ends_with(kDevice);
  if (on_device) rest.resize(rest.size() - kDevice.size());
  const std::size_t blank = rest.find(' ');
  case_hash = rest.substr(0, blank);
  if (blank != std::string::npos) kernels = rest.substr(blank + 1);
}

std::string RunIdentity::text() const { return case_hash + " " + kernels + std::string(on_device ? kDevice : ""); }

void requireSameDevice(const RunIdentity& recorded, DeviceKind device, const std::string& folder) {
  const bool wanted = device != DeviceKind::cpu;
  if (recorded.on_device == wanted) return;
  throw InputError(
      {"command line", 0, "--device"},
      fmt::format("{} was computed with --device {}, and --device {} does not go on from it: their numbers differ in "
                  "the last digits; allowed: --device {}, or without --resume from the beginning",
                  folder, recorded.on_device ? "reference or cuda" : "cpu", wordOf(device),
                  recorded.on_device ? "reference or cuda" : "cpu"));
}

}  // namespace gambeson
