/// The command line many times over, without the time that a program takes to start: each call is a process split off
/// this one, in which OpenCASCADE is loaded and has read files already. Readers split off processes of their own from
/// there, with their limits, as in the program.
///
///   warm_command [CAD_FILE ...]
///
/// A call is a line of standard input, its words apart by tabs: the folder to work in, the file for standard error,
/// seconds of the processor, seconds by the clock, and the arguments. The answer is a line: status (minus the signal
/// that ended it), seconds of the processor with those of its readers, most memory of one process [kB], and 1, or 0
/// where it was ended for its time.

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

#include "cases/cad/cad_file.hpp"
#include "cases/command/cli.hpp"
#include "core/io/beside.hpp"

namespace {

/// Once loaded here it is loaded in every process that is split off.
void warm(const std::vector<std::string>& files) {
  const auto entry = reinterpret_cast<const gambeson::CadModule* (*)()>(
      gambeson::functionBeside("gambeson_cad.so", "gambesonCadModule", "OpenCASCADE"));
  for (const std::string& file : files)
    if (gambeson::CadFormat format; gambeson::isCadFile(file, format)) entry()->read(file, format, 0);
}

[[noreturn]] void serve(const std::vector<std::string>& words) {
  const int nowhere = open("/dev/null", O_RDWR);
  const int err = open(words[1].c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  if (err < 0 || chdir(words[0].c_str()) != 0) _exit(126);
  dup2(nowhere, 0), dup2(nowhere, 1), dup2(err, 2);
  const auto seconds = static_cast<rlim_t>(std::stol(words[2]));
  const rlimit cpu{seconds, seconds + 5};
  setrlimit(RLIMIT_CPU, &cpu);
  std::vector<const char*> arguments{"gambeson"};
  for (std::size_t k = 4; k < words.size(); ++k) arguments.push_back(words[k].c_str());
  const int status = gambeson::runCommand(static_cast<int>(arguments.size()), arguments.data(), std::cout, std::cerr);
  std::cout.flush();
  std::cerr.flush();
  _exit(status);
}

std::string call(const std::vector<std::string>& words) {
  const auto start = std::chrono::steady_clock::now();
  const double most = std::stod(words[3]);
  const pid_t child = fork();
  if (child < 0) return "126 0 0 1";
  if (child == 0) serve(words);
  int status = 0;
  bool in_time = true;
  rusage used{};
  for (useconds_t pause = 200; wait4(child, &status, in_time ? WNOHANG : 0, &used) == 0;) {
    if (std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() > most) {
      kill(child, SIGKILL);
      in_time = false;
      continue;
    }
    usleep(pause);
    pause = std::min<useconds_t>(2 * pause, 5000);
  }
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  std::ostringstream out;
  out << (WIFSIGNALED(status) ? -WTERMSIG(status) : WEXITSTATUS(status)) << ' '
      << seconds(used.ru_utime) + seconds(used.ru_stime) << ' ' << used.ru_maxrss << ' ' << (in_time ? 1 : 0);
  return out.str();
}

}  // namespace

int main(int argc, char** argv) {
  warm({argv + 1, argv + argc});
  for (std::string line; std::getline(std::cin, line);) {
    std::vector<std::string> words;
    std::istringstream in(line);
    for (std::string word; std::getline(in, word, '\t');) words.push_back(word);
    std::cout << (words.size() < 5 ? "126 0 0 1" : call(words)) << std::endl;
  }
  return 0;
}
