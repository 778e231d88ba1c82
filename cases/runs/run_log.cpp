#include "cases/runs/run_log.hpp"

#include <fstream>

#include "cases/input/message.hpp"

namespace gambeson {

std::string lastMessage(const std::filesystem::path& log) {
  std::ifstream stream(log, std::ios::binary);
  std::string line, last;
  bool message = false;
  while (std::getline(stream, line)) {
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    const bool begins = line.starts_with("gambeson failed: ");
    if (begins) line.erase(0, line.find(": ") + 2);
    message = message || begins;
    last = message && !begins ? last + "; " + line : line;
  }
  return messageText(last);
}

}  // namespace gambeson
