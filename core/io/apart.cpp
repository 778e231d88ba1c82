#include "core/io/apart.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <fstream>
#include <new>

namespace gambeson {
namespace {

/// How the child's answer starts: what follows it.
enum class Answer : char { done, input_error, memory, other_error };

/// Address space that this process has now; sanitizers reserve terabytes of it.
std::size_t addressSpace() {
  std::ifstream file("/proc/self/statm");
  std::size_t pages = 0;
  file >> pages;
  return pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

void limit(int what, rlim_t value) {
  rlimit both{};
  getrlimit(static_cast<__rlimit_resource>(what), &both);
  both.rlim_cur = both.rlim_max = std::min(value, both.rlim_max);
  setrlimit(static_cast<__rlimit_resource>(what), &both);
}

void writeAll(int to, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t n = write(to, bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) _exit(1);  // nobody listens any more
    bytes.remove_prefix(static_cast<std::size_t>(n));
  }
}

void answer(int to, Answer sort, const BytesOut& out) {
  const std::uint64_t size = out.bytes().size();
  writeAll(to, {reinterpret_cast<const char*>(&sort), sizeof sort});
  writeAll(to, {reinterpret_cast<const char*>(&size), sizeof size});
  writeAll(to, out.bytes());
}

[[noreturn]] void serve(int to, pid_t parent, const ApartLimits& limits, const std::function<void(BytesOut&)>& read) {
  // Whoever interrupts the program means the parent, whose end is this process's too.
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(1);
  for (const int s : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) std::signal(s, SIG_IGN);
  for (const int s : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL, SIGXCPU, SIGPIPE}) std::signal(s, SIG_DFL);
  const int nowhere = open("/dev/null", O_RDWR);
  for (int fd = 0; fd < 3; ++fd) dup2(nowhere, fd);
  dup2(to, 3);
  close_range(4, ~0U, 0);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, static_cast<rlim_t>(std::ceil(limits.cpu_s)));
#ifndef __SANITIZE_ADDRESS__
  limit(RLIMIT_AS, addressSpace() + limits.memory_bytes);
#endif
  try {
    try {
      BytesOut out;
      read(out);
      answer(3, Answer::done, out);
    } catch (const InputError& e) {
      BytesOut out;
      out.put(e.where().file);
      out.put(e.where().line);
      out.put(e.where().key);
      out.put(e.reason());
      answer(3, Answer::input_error, out);
    } catch (const std::bad_alloc&) {
      answer(3, Answer::memory, {});
    } catch (const std::exception& e) {
      BytesOut out;
      out.put(std::string(e.what()));
      answer(3, Answer::other_error, out);
    }
  } catch (...) {  // no memory is left even to say so
    _exit(1);
  }
  _exit(0);
}

/// Everything that comes until the other end closes; false where that takes longer than until `end`.
bool readAll(int from, std::chrono::steady_clock::time_point end, std::string& all) {
  std::vector<char> part(1 << 16);
  for (;;) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - std::chrono::steady_clock::now());
    if (left.count() <= 0) return false;
    pollfd p{from, POLLIN, 0};
    const int ready = poll(&p, 1, static_cast<int>(std::min<long long>(left.count(), 1000)));
    if (ready <= 0) continue;
    const ssize_t n = ::read(from, part.data(), part.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return true;
    all.append(part.data(), static_cast<std::size_t>(n));
  }
}

}  // namespace

ApartLimits limitsFor(const std::filesystem::path& file) {
  std::error_code error;
  const auto size = std::filesystem::file_size(file, error);
  ApartLimits limits;
  if (!error) limits.cpu_s += static_cast<double>(size) / (4 << 20);
  return limits;
}

BytesIn readApart(const std::filesystem::path& file, const ApartLimits& limits,
                  const std::function<void(BytesOut&)>& read) {
  const auto fail = [&](const std::string& reason) -> void { throw InputError({file.string(), 0, ""}, reason); };
  const std::string too_long = fmt::format("cannot be read: that takes longer than {:.0f} s", limits.cpu_s);
  const std::string too_much =
      fmt::format("cannot be read: that takes more than {} MB of memory", limits.memory_bytes >> 20);
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) throw RunError("no pipe can be opened to read " + file.string());
  const pid_t parent = getpid(), child = fork();
  if (child < 0) {
    close(ends[0]), close(ends[1]);
    throw RunError("no process can be started to read " + file.string());
  }
  if (child == 0) serve(ends[1], parent, limits, read);
  close(ends[1]);
  std::string all;
  bool in_time = false;
  try {
    const auto most = std::chrono::duration<double>(10 * limits.cpu_s);
    in_time = readAll(
        ends[0], std::chrono::steady_clock::now() + std::chrono::duration_cast<std::chrono::milliseconds>(most), all);
  } catch (const std::bad_alloc&) {
    all.clear();
  }
  close(ends[0]);
  if (!in_time) kill(child, SIGKILL);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  constexpr std::size_t head = sizeof(Answer) + sizeof(std::uint64_t);
  std::uint64_t size = 0;
  if (all.size() >= head) std::memcpy(&size, all.data() + sizeof(Answer), sizeof size);
  if (all.size() < head || size != all.size() - head) {
    if (!in_time || (WIFSIGNALED(status) && (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL)))
      fail(too_long);
    if (WIFSIGNALED(status))
      fail(fmt::format("cannot be read: it is damaged or nested too deeply, and ends its reader ({})",
                       strsignal(WTERMSIG(status))));
    fail(too_much);
  }
  const auto sort = static_cast<Answer>(all[0]);
  all.erase(0, head);
  BytesIn in(std::move(all));
  std::string reason;
  switch (sort) {
    case Answer::done:
      break;
    case Answer::input_error: {
      InputError::Where where;
      in.get(where.file), in.get(where.line), in.get(where.key), in.get(reason);
      throw InputError(where, reason);
    }
    case Answer::memory:
      fail(too_much);
      break;
    case Answer::other_error:
      in.get(reason);
      fail(reason.find("bad_alloc") != std::string::npos ? too_much : "cannot be read: " + reason);
  }
  return in;
}

}  // namespace gambeson
