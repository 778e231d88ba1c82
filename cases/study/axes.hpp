#pragma once
/// Axes of a study and their levels, as its file has them.

#include <map>
#include <string>
#include <vector>

#include "cases/study/input.hpp"

namespace gambeson::study {

/// A number, a text or a flag as labels have it; empty of anything else.
std::string textOf(const JsonNode& value);
/// Whether a value of the case is the factor of a region: "garment.regions[0].thickness".
bool isRegionFactor(const std::string& path);

// What is wrong is thrown as InputError, at the entry or below it.
/// Object path: value.
std::vector<Setting> settingsOf(const schema::Entry& entry);
Axis axisOf(const schema::Entry& entry, const AxisInput& in);
std::size_t axisNamed(const schema::Entry& entry, const Study& study, const std::string& name);
int levelNamed(const schema::Entry& entry, const Axis& axis, const JsonNode& value);
/// Object axis: label.
std::map<std::size_t, int> levelsAt(const schema::Entry& entry, const Study& study);
bool isFactor(const Axis& axis);
/// Which axes are compared, and which of their levels is the baseline's.
void findBaseline(const schema::Entry& root, const StudyInput& in, Study& study);

}  // namespace gambeson::study
