#include "cases/runs/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

namespace gambeson {

std::string durationText(double seconds) {
  const long s = std::lround(std::max(0.0, seconds));
  if (s < 60) return fmt::format("{} s", s);
  if (s < 3600) return fmt::format("{} min {:02} s", s / 60, s % 60);
  return fmt::format("{} h {:02} min", s / 3600, s % 3600 / 60);
}

std::string progressLine(const std::string& what, double done, double total, double already_done, double elapsed_s,
                         const std::string& unit) {
  const double part = total > 0 ? std::clamp(done / total, 0.0, 1.0) : 0.0;
  std::string line = fmt::format("{}  {:.0f} %  {:.2f} of {:.2f}{}", what, 100 * part, done, total, unit);
  if (elapsed_s >= 2 && done > already_done)
    line += fmt::format("  {} left", durationText(elapsed_s * (total - done) / (done - already_done)));
  return line;
}

Progress::Progress(double total, double already_done, std::FILE* stream, std::string unit)
    : total_(total),
      already_done_(already_done),
      stream_(stream),
      unit_(std::move(unit)),
      terminal_(isatty(fileno(stream)) != 0) {}

Progress::~Progress() {
  if (drawn_) std::fputs("\n", stream_);
}

void Progress::update(double done, const std::string& what) {
  if (!terminal_) return;
  const Clock::time_point now = Clock::now();
  if (now - last_ < std::chrono::milliseconds(200) && done < total_) return;
  last_ = now;
  const double elapsed_s = std::chrono::duration<double>(now - start_).count();
  const std::string line = progressLine(what, done, total_, already_done_, elapsed_s, unit_);
  std::fprintf(stream_, "\r\033[K%s", line.c_str());
  std::fflush(stream_);
  drawn_ = true;
}

}  // namespace gambeson
