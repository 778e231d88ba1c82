#pragma once
/// Detail of study.hpp: from what is set to variants, which are built and checked one by one.

#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include "cases/study/input.hpp"

namespace gambeson::study {

inline constexpr std::size_t most_variants = 2000;
[[noreturn]] void tooMany(const schema::Entry& at);

/// Builds and checks variants one by one.
class Maker {
 public:
  Maker(const schema::Entry& entry, const StudyInput& in, Study& study);

  void add(std::vector<int> levels, const std::vector<Setting>& more, const std::string& extra_label,
           const schema::Entry& at);

  /// The file of the case of the variant that was added last, with its values in.
  const JsonNode& root() const { return root_; }

 private:
  const schema::Entry& entry_;
  const StudyInput& in_;
  Study& study_;
  JsonNode base_, root_;
  std::vector<Setting> common_;
  std::set<std::string> folders_;
};

}  // namespace gambeson::study
