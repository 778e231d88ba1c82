#pragma once
/// Detail of run.hpp: the runs of variants, for studies whose variants are known before and for those that find them.

#include <filesystem>
#include <iosfwd>
#include <vector>

#include "cases/runs/process_pool.hpp"
#include "cases/study/run.hpp"

namespace gambeson::study {

std::filesystem::path caseFile(const std::filesystem::path& out, const Variant& variant);
std::filesystem::path logFile(const std::filesystem::path& out, const Variant& variant);
/// Leaves its case where its run reads it.
void writeVariant(const std::filesystem::path& out, const Variant& variant);

/// How each variant stands before it is run: fresh unless options resume or compare.
std::vector<Stand> standsOf(const Study& study, const Options& options);

/// All that the study and its runs would write, before anything is made or computed: files of others and inputs are
/// refused (InputError).
void checkFolder(const Study& study, const Options& options, const std::vector<Stand>& stands);

/// Runs the variants that are not done; their outcomes. The options' threads are known. Throws RunError where a signal
/// stopped it. What processes inherit: descriptor `lock`.
std::vector<Outcome> runVariants(const Study& study, const Options& options, const std::vector<Stand>& stands,
                                 const Signals& signals, int lock, std::ostream& out);

}  // namespace gambeson::study
