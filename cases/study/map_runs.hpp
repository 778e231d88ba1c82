#pragma once
/// Detail of optimise.hpp: maps as runs.

#include <iosfwd>
#include <string>
#include <vector>

#include "cases/runs/process_pool.hpp"
#include "cases/study/run.hpp"

namespace gambeson::study {

inline constexpr const char* kFiner = "finer";
std::string repeatName(std::size_t repeat);

/// The run of a map (the factors of the free regions), with more set; its folder is named by the numbers of the map and
/// by `suffix`. Throws InputError.
Variant mapVariant(const Study& study, const std::vector<double>& map, const std::vector<Setting>& more,
                   const std::string& suffix);

/// Searches the map, each try a run in its folder: what is done there is taken as it is, so that a search that was
/// stopped asks the same questions, gets the same answers and comes to the same map. The study then has what was found,
/// and the variants that its page compares; their outcomes. Throws RunError where a signal stopped it, or the map that
/// it starts from cannot be run.
std::vector<Outcome> runOptimisation(Study& study, const Options& options, const Signals& signals, int lock,
                                     std::ostream& out);

}  // namespace gambeson::study
