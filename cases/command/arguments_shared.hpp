#pragma once
/// Detail of arguments.hpp: options of several commands.

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace gambeson {

void addOverrides(CLI::App& command, std::vector<std::string>& overrides);
/// `words`: what they are of, with what 0 means.
void addThreads(CLI::App& command, int& threads, const std::string& words);
void addDevice(CLI::App& command, std::string& device);

}  // namespace gambeson
