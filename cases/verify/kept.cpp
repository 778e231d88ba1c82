/// Detail of verify.hpp: runs that need not be repeated: whose case they are of, and whether they came to their end.

#include <fstream>
#include <nlohmann/json.hpp>

#include "cases/input/fingerprint.hpp"
#include "cases/input/overrides.hpp"
#include "cases/input/schema.hpp"
#include "cases/kinds/any_case.hpp"
#include "cases/runs/run_identity.hpp"
#include "cases/verify/verify.hpp"
#include "core/error.hpp"
#include "core/io/recording.hpp"

namespace gambeson::verify {

std::optional<std::string> caseHash(const Reference& reference, const Run& run) {
  try {
    const bool own = !run.file.empty() || run.inline_case.type != JsonNode::Type::null;
    const std::filesystem::path& file = own ? run.file : reference.case_file;
    JsonNode node = file.empty() ? (own ? run.inline_case : reference.inline_case) : readCaseNode(file, {});
    for (const auto& [path, value] : run.changes) overrideValue(node, path, value);
    const AnyCase any = readAnyCase(node, file.empty() ? reference.file : file);
    if (const auto* c = std::get_if<Case>(&any)) return caseIdentity(*c);
  } catch (const InputError&) {
    return {};
  }
  return {};
}

std::optional<double> completeRun(const std::filesystem::path& folder, const std::string& hash) {
  std::ifstream stream(folder / "summary.json");
  if (!stream) return {};
  const auto j = nlohmann::json::parse(stream, nullptr, false);
  try {
    if (j.at("case_hash").get<std::string>() != hash || j.contains("steps_on")) return {};  // references are of the CPU
    if (!(j.at("recorded_to_s").get<double>() >= j.at("planned_to_s").get<double>() - 1e-9)) return {};
    return j.at("timings").at("wall_s").get<double>();
  } catch (const nlohmann::json::exception&) {
    return {};
  }
}

bool interruptedRun(const std::filesystem::path& folder, const std::optional<std::string>& hash) {
  if (!hash || !holdsRecording(folder)) return false;
  try {
    return caseIdentity(readCase(folder / "case.json")) == *hash && !RunIdentity(readLayout(folder).identity).on_device;
  } catch (const InputError&) {
    return false;
  }
}

}  // namespace gambeson::verify
