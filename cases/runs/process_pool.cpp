#include "cases/runs/process_pool.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/signalfd.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <string_view>

#include "cases/runs/run_log.hpp"
#include "core/error.hpp"

namespace gambeson {
namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

struct Running {
  std::size_t job = 0;
  pid_t pid = -1;
  Clock::time_point start;
  bool late = false;
};

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> p;
  for (std::string& t : texts) p.push_back(t.data());
  p.push_back(nullptr);
  return p;
}

/// This process's environment, with `own` in place of what has their names.
std::vector<std::string> environmentWith(const std::vector<std::string>& own) {
  std::vector<std::string> all = own;
  for (char** e = environ; *e; ++e) {
    const std::string_view entry = *e;
    const auto replaced = [&](const std::string& o) { return entry.starts_with(o.substr(0, o.find('=') + 1)); };
    if (std::none_of(own.begin(), own.end(), replaced)) all.emplace_back(entry);
  }
  return all;
}

/// fork and exec, and not posix_spawn: only a process of our own can ask to die with its parent before it becomes the
/// run. Between the two there are only calls that a process with other threads may make.
pid_t start(const Process& job, const ProcessPool& pool, const Signals& signals) {
  std::vector<std::string> command = job.command, environment = environmentWith(pool.environment);
  const std::vector<char*> arguments = pointers(command), variables = pointers(environment);
  const pid_t parent = getpid(), pid = fork();
  if (pid < 0) throw RunError(fmt::format("no process can be started: {}", std::strerror(errno)));
  if (pid > 0) return pid;
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(1);  // it died before the line above
  const int in = open("/dev/null", O_RDONLY),
            out = open(job.log.c_str(), O_WRONLY | O_CREAT | O_NOFOLLOW | (job.goes_on ? O_APPEND : O_TRUNC), 0644);
  if (in < 0 || out < 0) _exit(127);
  dup2(in, STDIN_FILENO);
  dup2(out, STDOUT_FILENO);
  dup2(out, STDERR_FILENO);
  signals.release();
  execve(arguments[0], arguments.data(), variables.data());
  _exit(127);
}

Ended endOf(const Process& job, const Running& run, int status) {
  const double seconds = secondsSince(run.start);
  if (run.late) return {false, fmt::format("stopped after {:.0f} s, its limit", job.limit_s), seconds};
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
  for (const int s : {SIGINT, SIGTERM, SIGHUP, SIGCHLD}) sigaddset(&state_->held, s);
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
  while (read(state_->descriptor, &info, sizeof info) == sizeof info)
    if (info.ssi_signo != SIGCHLD) return static_cast<int>(info.ssi_signo);
  return 0;
}

void Signals::release() const { pthread_sigmask(SIG_SETMASK, &state_->before, nullptr); }

bool runProcesses(std::vector<Process> jobs, const ProcessPool& pool, const Signals& signals, int lock) {
  if (lock >= 0) fcntl(lock, F_SETFD, 0);  // processes keep it open
  std::vector<Running> running;
  std::size_t next = 0;
  for (;;) {
    if (pool.more)
      for (Process& job : pool.more()) jobs.push_back(std::move(job));
    if (next == jobs.size() && running.empty()) return true;
    while (next < jobs.size() && running.size() < static_cast<std::size_t>(std::max(1, pool.parallel))) {
      running.push_back({next, start(jobs[next], pool, signals), Clock::now(), false});
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
        if (!running[i].late && secondsSince(running[i].start) > jobs[running[i].job].limit_s) {
          running[i].late = true;
          kill(running[i].pid, SIGKILL);
        }
        ++i;
        continue;
      }
      const Running r = running[i];
      running.erase(running.begin() + static_cast<std::ptrdiff_t>(i));
      const Ended e =
          got < 0 ? Ended{false, fmt::format("the run was lost: {}", std::strerror(errno)), secondsSince(r.start)}
                  : endOf(jobs[r.job], r, status);
      if (pool.ended) pool.ended(r.job, e);
    }
    std::vector<std::size_t> now;
    for (const Running& r : running) now.push_back(r.job);
    if (pool.watch) pool.watch(now);
  }
}

}  // namespace gambeson
