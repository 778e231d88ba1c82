#include "cases/runs/stop_message.hpp"

#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstring>

#include "cases/input/message.hpp"

namespace gambeson {
namespace {

constexpr std::array<int, 3> signals{SIGINT, SIGTERM, SIGHUP};

// A handler can ask nobody: what it says and what was there before it stand here.
std::array<char, 1024> said{};
volatile sig_atomic_t length = 0;
std::array<struct sigaction, signals.size()> before{};

void stop(int) {
  std::size_t at = 0;
  const auto all = static_cast<std::size_t>(length);
  while (at < all) {
    const ssize_t n = write(STDERR_FILENO, said.data() + at, all - at);
    if (n <= 0) break;
    at += static_cast<std::size_t>(n);
  }
  _exit(1);
}

}  // namespace

StopMessage::StopMessage(const std::string& text) {
  std::string line = isatty(STDERR_FILENO) != 0 ? "\n" : "";  // the line of progress stays above
  line.append(messageText(std::string("gambeson failed: ").append(text))).append(1, '\n');
  const std::size_t size = std::min(line.size(), said.size());
  std::memcpy(said.data(), line.data(), size);
  length = static_cast<sig_atomic_t>(size);
  struct sigaction action {};
  action.sa_handler = stop;
  sigfillset(&action.sa_mask);
  for (std::size_t k = 0; k < signals.size(); ++k) {
    sigaction(signals[k], nullptr, &before[k]);
    if (before[k].sa_handler != SIG_IGN) sigaction(signals[k], &action, nullptr);  // nohup stays what it is
  }
}

StopMessage::~StopMessage() {
  for (std::size_t k = 0; k < signals.size(); ++k) sigaction(signals[k], &before[k], nullptr);
}

}  // namespace gambeson
