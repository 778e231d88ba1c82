#pragma once
/// Detail of study.hpp: from a population to axes and variants.

#include "cases/study/maker.hpp"

namespace gambeson::study {

/// Axes of the wearers and of their sizes.
void addPopulation(const schema::Entry& root, const StudyInput& in, Study& study);

/// A variant for each wearer, or for each size that a wearer tries.
void addWearers(const schema::Entry& root, Maker& maker, Study& study);

}  // namespace gambeson::study
