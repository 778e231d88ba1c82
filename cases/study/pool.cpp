#include "cases/study/pool.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/file.h>
#include <sys/prctl.h>
#include <sys/signalfd.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>

#include "cases/run_log.hpp"
#include "core/error.hpp"

namespace gambeson::study {
namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

struct Running {
  std::size_t job = 0;
  pid_t pid = -1;
  Clock::time_point start;
};

/// fork and exec, and not posix_spawn: only a process of our own can ask to die with its parent before it becomes the
/// run. Between the two there are only calls that a process with other threads may make.
pid_t start(const Job& job, const Signals& signals) {
  std::vector<char*> arguments;
  std::vector<std::string> command = job.command;
  for (std::string& a : command) arguments.push_back(a.data());
  arguments.push_back(nullptr);
  const pid_t parent = getpid(), pid = fork();
  if (pid < 0) throw RunError(fmt::format("no process can be started: {}", std::strerror(errno)));
  if (pid > 0) return pid;
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(1);  // it died before the line above
  const int in = open("/dev/null", O_RDONLY), out = open(job.log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  if (in < 0 || out < 0) _exit(127);
  dup2(in, STDIN_FILENO);
  dup2(out, STDOUT_FILENO);
  dup2(out, STDERR_FILENO);
  signals.release();
  execv(arguments[0], arguments.data());
  _exit(127);
}

Ended endOf(const Job& job, int status, double seconds) {
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return {true, "", seconds};
  if (WIFSIGNALED(status))
    return {false, fmt::format("ended by signal {} ({})", WTERMSIG(status), strsignal(WTERMSIG(status))), seconds};
  const std::string said = lastMessage(job.log);
  if (WEXITSTATUS(status) == 127 && said.empty())
    return {false, fmt::format("{} cannot be started", job.command[0]), seconds};
  return {false, said.empty() ? fmt::format("exit status {}, without a message", WEXITSTATUS(status)) : said, seconds};
}

void stopAll(std::vector<Running>& running) {
  for (const Running& r : running) kill(r.pid, SIGTERM);
  const Clock::time_point begin = Clock::now();
  while (!running.empty()) {
    std::erase_if(running, [](const Running& r) { return waitpid(r.pid, nullptr, WNOHANG) != 0; });
    if (running.empty()) break;
    if (secondsSince(begin) > 3)
      for (const Running& r : running) kill(r.pid, SIGKILL);
    poll(nullptr, 0, 20);
  }
}

}  // namespace

struct Signals::State {
  sigset_t held, before;
  int descriptor = -1;
};

Signals::Signals() : state_(new State) {
  sigemptyset(&state_->held);
  for (const int s : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&state_->held, s);
  pthread_sigmask(SIG_BLOCK, &state_->held, &state_->before);
  state_->descriptor = signalfd(-1, &state_->held, SFD_CLOEXEC | SFD_NONBLOCK);
}

Signals::~Signals() {
  if (state_->descriptor >= 0) close(state_->descriptor);
  pthread_sigmask(SIG_SETMASK, &state_->before, nullptr);
  delete state_;
}

int Signals::wait(int ms) const {
  pollfd p{state_->descriptor, POLLIN, 0};
  if (poll(&p, 1, ms) <= 0) return 0;
  signalfd_siginfo info{};
  return read(state_->descriptor, &info, sizeof info) == sizeof info ? static_cast<int>(info.ssi_signo) : 0;
}

void Signals::release() const { pthread_sigmask(SIG_SETMASK, &state_->before, nullptr); }

bool runJobs(const std::vector<Job>& jobs, const Pool& pool, const Signals& signals, int lock) {
  if (lock >= 0) fcntl(lock, F_SETFD, 0);  // jobs keep it open
  std::vector<Running> running;
  std::size_t next = 0;
  while (next < jobs.size() || !running.empty()) {
    while (next < jobs.size() && running.size() < static_cast<std::size_t>(std::max(1, pool.parallel))) {
      running.push_back({next, start(jobs[next], signals), Clock::now()});
      ++next;
    }
    if (signals.wait(running.empty() ? 0 : 50) != 0) {
      stopAll(running);
      return false;
    }
    for (std::size_t i = 0; i < running.size();) {
      int status = 0;
      const pid_t got = waitpid(running[i].pid, &status, WNOHANG);
      if (got == 0) {
        ++i;
        continue;
      }
      const Running r = running[i];
      running.erase(running.begin() + static_cast<std::ptrdiff_t>(i));
      Ended e = got < 0 ? Ended{false, fmt::format("the run was lost: {}", std::strerror(errno)), 0}
                        : endOf(jobs[r.job], status, 0);
      e.seconds = secondsSince(r.start);
      if (pool.ended) pool.ended(r.job, e);
    }
    std::vector<std::size_t> now;
    for (const Running& r : running) now.push_back(r.job);
    if (pool.watch) pool.watch(now);
  }
  return true;
}

FolderLock::FolderLock(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / ".lock";
  descriptor_ = open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (descriptor_ < 0)
    throw InputError({"command line", 0, "--out"},
                     fmt::format("{} cannot be written: {}", folder.string(), std::strerror(errno)));
  for (int tries = 0; flock(descriptor_, LOCK_EX | LOCK_NB) != 0; ++tries) {
    if (tries == 50) {
      close(descriptor_);
      throw InputError({"command line", 0, "--out"},
                       fmt::format("{} is being written by another study; allowed: one at a time", folder.string()));
    }
    poll(nullptr, 0, 100);
  }
}

FolderLock::~FolderLock() { close(descriptor_); }

}  // namespace gambeson::study
