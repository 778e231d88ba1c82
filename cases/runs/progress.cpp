#include "cases/runs/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>

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

Progress::Progress(double total, double already_done, std::FILE* stream, std::string unit, std::filesystem::path file)
    : total_(total),
      already_done_(already_done),
      stream_(stream),
      unit_(std::move(unit)),
      file_(std::move(file)),
      terminal_(isatty(fileno(stream)) != 0) {}

Progress::~Progress() {
  if (drawn_) std::fputs("\n", stream_);
}

bool Progress::isDue(Clock::time_point& last, std::chrono::milliseconds every, Clock::time_point now,
                     double done) const {
  if (now - last < every && done < total_) return false;
  last = now;
  return true;
}

void Progress::update(double done, const std::string& what) {
  const Clock::time_point now = Clock::now();
  const bool draws = terminal_ && isDue(last_, std::chrono::milliseconds(200), now, done);
  const bool writes = !file_.empty() && isDue(written_, std::chrono::seconds(2), now, done);
  if (!draws && !writes) return;
  const double elapsed_s = std::chrono::duration<double>(now - start_).count();
  const std::string line = progressLine(what, done, total_, already_done_, elapsed_s, unit_);
  if (writes) std::ofstream(file_, std::ios::trunc) << line << "\n";
  if (!draws) return;
  std::fprintf(stream_, "\r\033[K%s", line.c_str());
  std::fflush(stream_);
  drawn_ = true;
}

}  // namespace gambeson
