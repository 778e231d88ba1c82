#pragma once
/// Detail of study.hpp: what a study optimises, as its file has it.

#include "cases/input/schema.hpp"
#include "cases/study/input.hpp"

namespace gambeson::study {

/// From the study's file to what it optimises, the map that it starts from as the only variant (and the same on the
/// finer mesh). Throws InputError.
void readOptimise(const schema::Entry& root, const StudyInput& in, Study& study);

}  // namespace gambeson::study
