#pragma once
/// What stands at the top of a page, read back from it: for pages that show many runs beside each other.

#include <filesystem>
#include <string>
#include <vector>

namespace gambeson {

struct PageTop {
  std::string sentence;             ///< the headline, as text
  std::vector<std::string> doubts;  ///< what stands above it, as text: what fails, what is missing
  std::string figure;               ///< the picture beside it, as HTML; empty where there is none
};

/// Of a page that formatReport, or pageOf with a section "headline", made. Throws RunError where it is none.
PageTop pageTopOf(const std::string& page);

/// The same of a file, of which no more is read than that. Throws RunError where it cannot be read.
PageTop readPageTop(const std::filesystem::path& html);

}  // namespace gambeson
