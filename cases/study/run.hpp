#pragma once
/// `gambeson study` and `gambeson batch`.

#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "cases/study/study.hpp"
#include "core/device_kind.hpp"

namespace gambeson::study {

/// What each job asks Slurm for; what is not given is the cluster's to decide.
struct Queue {
  std::optional<std::string> time, memory, partition, job_name;
};
/// Throws InputError ("command line", option) where one of them is not as sbatch reads it, or is given without `slurm`.
void checkQueue(const Queue& queue, bool slurm);

struct Options {
  std::filesystem::path out;
  int jobs = 0;     ///< at a time; 0: as many as there are threads
  int threads = 0;  ///< of all jobs together; 0: as many as the machine has
  bool resume = false;
  DeviceKind device = DeviceKind::cpu;    ///< of all runs
  bool slurm = false;                     ///< write scripts for Slurm instead of running
  bool compare = false;                   ///< compare what is done, instead of running
  Queue queue;                            ///< of Slurm
  std::string csv;                        ///< form of further tables, which the job that compares leaves
  std::string binary = "/proc/self/exe";  ///< the command that runs a case
};

/// What a folder of a variant holds, for runs on this device. Throws InputError where the same case was run there on
/// another kind of device. `elsewhere`: the runs are of other machines, whose vector instructions may differ.
enum class Stand { fresh, interrupted, done };
Stand standOf(const std::filesystem::path& folder, const std::string& identity, DeviceKind device = DeviceKind::cpu,
              bool elsewhere = false);

/// Whether a run of the variant that was interrupted can go on; structures start from the beginning.
bool goesOn(const Variant& variant);

/// One variant after the runs.
struct Outcome {
  bool good = false;
  std::string why;  ///< where it is not good
};

/// Exit status: 0 all variants are done, 1 some failed or a signal stopped it.
int runStudy(const Study& study, const Options& options, std::ostream& out);

/// The script of an array of jobs (DIR/study.slurm), one for each variant that is not done.
std::string slurmScript(const Study& study, const Options& options, const std::vector<Stand>& stands);
/// The script of the job that compares (DIR/compare.slurm).
std::string compareScript(const Study& study, const Options& options);
/// What hands both to Slurm (DIR/submit.sh).
std::string submitScript(const Options& options);

}  // namespace gambeson::study
