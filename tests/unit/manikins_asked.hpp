#pragma once
/// Manikins that suites are run on.

#include <cstdlib>
#include <string>
#include <vector>

namespace gambeson {

/// The man of the middle, the smallest woman and the largest man; all six where GAMBESON_LONG is set
/// (ctest -C verify -R verify.manikins).
template <class Name = std::string>
std::vector<Name> manikinsAsked() {
  if (!std::getenv("GAMBESON_LONG")) return {"male_p50", "female_p5", "male_p95"};
  return {"male_p5", "male_p50", "male_p95", "female_p5", "female_p50", "female_p95"};
}

}  // namespace gambeson
