#pragma once
/// What a check of a run that fails says about the run's numbers, in plain words.

#include <string>

namespace gambeson {

struct CheckWords {
  std::string wrong;   ///< completes "it is found that ...", with the measured value and what is allowed
  std::string means;   ///< for the torques, as a sentence
  bool order = false;  ///< variants may come out in the wrong order; else the sizes of the torques are less sure
};

/// By the name that auditOf gives. One that is not known here is taken to spoil everything.
CheckWords checkWords(const std::string& check, double value, double limit, const std::string& unit);

/// What a run says on the standard error of a check that fails; the report says more.
std::string notMet(const std::string& check, double value, double limit, const std::string& unit);

}  // namespace gambeson
