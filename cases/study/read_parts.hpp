#pragma once
/// Detail of study.hpp: parts of reading a study's file.

#include "cases/input/schema.hpp"
#include "cases/study/input.hpp"

namespace gambeson::study {

/// Of an object path: value. Throws InputError where it is none, or empty.
std::vector<Setting> settingsOf(const schema::Entry& entry);

/// Whether a value of the case is the factor of a region: "garment.regions[0].thickness".
bool isRegionFactor(const std::string& path);

/// From the study's file to what it optimises, the map that it starts from as the only variant (and the same on the
/// finer mesh). Throws InputError.
void readOptimise(const schema::Entry& root, const StudyInput& in, Study& study);

}  // namespace gambeson::study
