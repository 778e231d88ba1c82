#pragma once
/// The files that a case is made of.

#include <filesystem>
#include <vector>

#include "cases/any_case.hpp"

namespace gambeson {

/// The case file and every file that it names, as far as there are such.
std::vector<std::filesystem::path> inputsOf(const AnyCase& c);

}  // namespace gambeson
