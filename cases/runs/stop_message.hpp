#pragma once
/// What a run says when it is stopped.

#include <string>

namespace gambeson {

/// While this lives, SIGINT, SIGTERM and SIGHUP end the process at once, with `text` on the standard error and exit
/// status 1: for work that may be ended anywhere because what it leaves on the disk is whole at any time. One at a
/// time.
class StopMessage {
 public:
  explicit StopMessage(const std::string& text);
  ~StopMessage();
  StopMessage(const StopMessage&) = delete;
  StopMessage& operator=(const StopMessage&) = delete;
};

}  // namespace gambeson
