#pragma once
/// What a run that was a process of its own said.

#include <filesystem>
#include <string>

namespace gambeson {

/// What a run that failed said last: its message from "gambeson failed:" on, else its last line; 600 characters at
/// most.
std::string lastMessage(const std::filesystem::path& log);

}  // namespace gambeson
