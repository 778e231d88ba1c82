#pragma once
/// `gambeson study` and `gambeson batch`.

#include <filesystem>
#include <iosfwd>
#include <string>

#include "cases/study/study.hpp"
#include "core/device_kind.hpp"

namespace gambeson::study {

struct Options {
  std::filesystem::path out;
  int jobs = 0;     ///< at a time; 0: as many as there are threads
  int threads = 0;  ///< of all jobs together; 0: as many as the machine has
  bool resume = false;
  DeviceKind device = DeviceKind::cpu;    ///< of all runs
  bool slurm = false;                     ///< write a script for an array of jobs instead of running
  std::string binary = "/proc/self/exe";  ///< the command that runs a case
};

/// What a folder of a variant holds, for runs on this device. Throws InputError where the same case was run there on
/// another kind of device.
enum class Stand { fresh, interrupted, done };
Stand standOf(const std::filesystem::path& folder, const std::string& identity, DeviceKind device = DeviceKind::cpu);

/// One variant after the runs.
struct Outcome {
  bool good = false;
  std::string why;  ///< where it is not good
};

/// Exit status: 0 all variants are done, 1 some failed or a signal stopped it.
int runStudy(const Study& study, const Options& options, std::ostream& out);

/// The script of an array of jobs (DIR/study.slurm).
std::string slurmScript(const Study& study, const Options& options, const std::vector<Stand>& stands);

}  // namespace gambeson::study
