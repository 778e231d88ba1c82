#pragma once
/// The command line of `gambeson`.

#include <iosfwd>

namespace gambeson {

/// Runs a subcommand. Exit status: 0 done, 1 the run failed, 2 bad input (in files or on the command line).
int runCommand(int argc, const char* const* argv, std::ostream& out, std::ostream& err);

}  // namespace gambeson
