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

/// What a folder's name may have.
std::string safe(const std::string& text);
std::vector<Setting> settingsOf(const schema::Entry& entry);

/// Builds and checks variants one by one.
class Maker {
 public:
  Maker(const schema::Entry& entry, const StudyInput& in, Study& study);

  void add(std::vector<int> levels, const std::vector<Setting>& more, const std::string& extra_label,
           const schema::Entry& at);

  static void identify(Variant& v);

 private:
  /// The name and description of the case tell its own motion, which a variant may replace: a variant has the study's.
  void introduce(Variant& v) const;

  const schema::Entry& entry_;
  const StudyInput& in_;
  Study& study_;
  JsonNode base_;
  std::vector<Setting> common_;
  std::set<std::string> folders_;
};

}  // namespace gambeson::study
