#include "cases/wear/run/together.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <memory>
#include <mutex>
#include <thread>

#include "cases/input/message.hpp"
#include "cases/runs/run_log.hpp"
#include "cases/runs/stop_message.hpp"
#include "cases/runs/together_list.hpp"
#include "cases/wear/case/case.hpp"
#include "cases/wear/run/company.hpp"
#include "cases/wear/run/run.hpp"
#include "cases/wear/run/run_steps.hpp"
#include "core/error.hpp"
#include "core/io/recording.hpp"
#include "gpu/device/gpu.hpp"

namespace gambeson {
namespace {

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

File opened(const std::filesystem::path& file, const char* how) {
  File stream(std::fopen(file.c_str(), how), std::fclose);
  if (!stream) throw RunError(file.string() + " cannot be written");
  return stream;
}

class Runs {
 public:
  explicit Runs(const TogetherOptions& o)
      : options_(o),
        runs_(readTogetherList(o.list)),
        ended_(opened(o.ended, "a")),
        company_(o.device == DeviceKind::cuda ? gpu::gpuMemory().free_bytes : 0) {}

  void all() {
    const int jobs =
        std::clamp(recordsSideBySide() ? options_.jobs : 1, 1, std::max(1, static_cast<int>(runs_.size())));
    threads_ = std::max(1, options_.threads / jobs);
    std::vector<std::thread> workers;
    for (int k = 0; k < jobs; ++k)
      workers.emplace_back([this] {
        for (std::size_t run = next_++; run < runs_.size(); run = next_++) make(run);
      });
    for (std::thread& worker : workers) worker.join();
  }

 private:
  void tell(const TogetherEvent& event) {
    const std::lock_guard hold(telling_);
    std::fputs(eventLine(event).c_str(), ended_.get());
    std::fflush(ended_.get());
  }

  void make(std::size_t run) {
    const TogetherRun& r = runs_[run];
    const auto start = std::chrono::steady_clock::now();
    tell({run, false, false, "", 0});
    bool good = false, lost = false;
    std::string why;
    try {
      const File log = opened(r.log, "w");
      const NotesTo notes(log.get());
      const auto failed = [&](const std::string& text) {
        fmt::print(log.get(), "{}\n", messageText(text));
        std::fflush(log.get());
        why = lastMessage(r.log);
      };
      try {
        RunOptions o;
        o.out = r.out;
        o.threads = threads_;
        o.resume = r.resume;
        o.device = options_.device;
        o.company = &company_;
        good = runCase(readCase(r.case_file), o) == 0;
      } catch (const InputError& e) {
        failed(e.what());
      } catch (const DeviceLost& e) {
        failed(fmt::format("gambeson failed: {}", e.what()));
        lost = true;
      } catch (const std::exception& e) {
        failed(fmt::format("gambeson failed: {}", e.what()));
      }
    } catch (const RunError& e) {
      why = e.what();
    }
    tell({run, true, good, why, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count()});
    // Nothing of CUDA works any more in this process. What others have recorded up to their checkpoints is on the disk.
    if (lost) _exit(1);
  }

  const TogetherOptions& options_;
  std::vector<TogetherRun> runs_;
  File ended_;
  Company company_;
  std::mutex telling_;
  std::atomic<std::size_t> next_ = 0;
  int threads_ = 1;
};

}  // namespace

int runTogether(const TogetherOptions& o) {
  requireDevice(o.device);
  const StopMessage stopped("stopped by a signal. What is recorded up to the last checkpoints stays");
  Runs(o).all();
  return 0;
}

}  // namespace gambeson
