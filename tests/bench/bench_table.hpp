#pragma once
/// Numbers that the benchmarks leave for the table at the end of the run.

#include <string>

namespace gambeson::bench {

/// Keeps the largest value noted under a name.
void note(const std::string& name, double value);

}  // namespace gambeson::bench
