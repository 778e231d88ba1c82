#pragma once
/// The key curves of a fabric's law: tensile tests along weft and warp, with linear shear and bending.

#include <string>
#include <vector>

#include "cases/input/schema.hpp"
#include "core/material/table/curve_energy.hpp"

namespace gambeson::schema {

/// A list of pairs [engineering strain, force per width], ascending strictly from above 0: "[[\"1 %\", \"20 N/m\"],
/// ...]". Throws InputError at the pair that is wrong. Numbers without a unit are refused where `with_units` says so.
std::vector<TensilePoint> readTensilePoints(const Entry& entry, bool with_units = false);
JsonNode nodeOf(const std::vector<TensilePoint>& points);

/// CurveLaw. Its check throws InputError where CurveEnergy would.
Object curvesTable();

/// "from 0 to 6 % along the weft ..." for reports.
std::string inWords(const CurveLaw& law);

}  // namespace gambeson::schema
