#pragma once
/// Detail of arguments.hpp: options of several commands.

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace gambeson {

void addOverrides(CLI::App& command, std::vector<std::string>& overrides);
void addDevice(CLI::App& command, std::string& device);

}  // namespace gambeson
