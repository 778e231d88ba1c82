#pragma once
/// The folder of a run: made, checked, cleared.

#include <filesystem>

namespace gambeson {

/// Makes the results folder. Refuses one that cannot be written, and one that is not a results folder (holds no
/// recording) but has files under the names that a run would overwrite: with --out . that would be the user's own
/// case.json. Throws InputError.
void prepareResultsFolder(const std::filesystem::path& out);

/// Whether nothing stands in the folder but what a run leaves that was killed before its recording began.
bool holdsOnlyABegunRun(const std::filesystem::path& folder);

/// What an earlier run left beside its recording must not be taken for results of this one.
void removeEarlierResults(const std::filesystem::path& out);

/// `threads` for the parallel loops; 0: OMP_NUM_THREADS, or without it as many as this process may run on at once.
void useThreads(int threads);

}  // namespace gambeson
