#pragma once
/// Detail of study.hpp: a variant is the case with values put in their places, under a name of the study's.

#include "cases/study/study.hpp"

namespace gambeson::study {

/// What a folder's name may have: other signs become _.
std::string folderName(const std::string& text);

/// Gives the variant, whose label is known, its case: that of `root` with `set` put into it. Throws InputError, with
/// the variant's label.
void defineVariant(const Study& study, JsonNode& root, const std::filesystem::path& case_file,
                   const std::vector<Setting>& set, Variant& variant);

/// Hashes of its case.
void identify(Variant& variant);

}  // namespace gambeson::study
