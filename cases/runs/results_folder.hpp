#pragma once
/// The folder of a run: checked, made, taken, cleared. What the rule is about files of others: core/io/own_file.hpp.

#include <filesystem>
#include <string>
#include <vector>

#include "cases/runs/folder_lock.hpp"

namespace gambeson {

/// What a run goes on from that is stopped while it dresses.
inline constexpr const char* kDressingFile = "dressing.h5";

/// Where a run that goes on says how far it is; gone when it is done.
inline constexpr const char* kProgressFile = "progress.txt";

/// A film of the motion, where the case names no pictures.
inline constexpr const char* kFilmFile = "film.mp4";

using Paths = std::vector<std::filesystem::path>;

/// Throws InputError ("command line", --out) where a run that writes into `out` would replace something: a file that is
/// not this program's own, one of its `inputs`, or something behind a symbolic link; and where the folder cannot be
/// written. `resume`: what is recorded stays. Changes nothing.
void checkResultsFolder(const std::filesystem::path& out, const Paths& inputs, bool resume);

/// Throws InputError ("command line", `option`) where `file` is one of the inputs, or is not free (requireFree).
void requireFreeOf(const std::filesystem::path& file, const Paths& inputs, const std::string& option);

/// Throws InputError ("command line", --out) where a folder that is written into is something else, or a symbolic link.
void requireFolder(const std::filesystem::path& folder);

/// Makes a folder and those above it. Throws InputError ("command line", --out).
void makeFolder(const std::filesystem::path& folder);

/// A single file that a command writes. Throws InputError ("command line", `option`) where its folder is missing or
/// cannot be written, and as requireFreeOf.
void checkOutput(const std::filesystem::path& file, const std::string& option, const Paths& inputs);

/// Files of a run's folder that its later readers (render, export, report) need.
Paths recordedFiles(const std::filesystem::path& results);

/// The folder of a run, checked, made, and its own while this lives.
class ResultsFolder {
 public:
  /// `resume`: to go on from a checkpoint, where there is one. Throws as checkResultsFolder and FolderLock.
  ResultsFolder(const std::filesystem::path& out, const Paths& inputs, bool resume);
  /// Whether there is a checkpoint to go on from.
  bool resumes() const { return resumes_; }

 private:
  FolderLock lock_;
  bool resumes_ = false;
};

/// Whether nothing stands in the folder but what a run leaves that was killed before its recording began.
bool holdsOnlyABegunRun(const std::filesystem::path& folder);

/// What an earlier run left beside its recording must not be taken for results of this one: its files, its pictures,
/// the dressed state. Others' files stay.
void removeEarlierResults(const std::filesystem::path& out);

/// `threads` for the parallel loops; 0: OMP_NUM_THREADS, or without it as many as this process may run on at once.
void useThreads(int threads);

}  // namespace gambeson
