#pragma once
/// What a pattern's numbers and a garment must satisfy; each throws InputError with the key.

#include <string>

#include "core/cloth/draft/garment.hpp"

namespace gambeson {

[[noreturn]] void reject(const std::string& key, const std::string& reason);

void requirePositive(const char* key, double value);
void requireDegree(int degree, int least);
void requireCells(const char* key, int cells, int least);
/// The number of cells along a length that is nearest to the wanted size, at least `least`; the key is "cell_m".
int cellsFor(double length_m, double cell_m, int least);

/// Patches valid; one weft per patch, not zero; seams name patches that exist, no edge twice, edges of the same degree,
/// knots (up to their range, 1e-9) and weights that coincide within 1e-9 m; G1 seams are G1 with a constant ratio
/// within 1e-9 m save at their ends; stiffness not negative. Seams on a part of an edge: that edge a lies there within
/// 1e-9 m. Lists by patch have one entry for each.
void validate(const Garment& garment);

/// Largest distance of a control point of a G1 seam from where the two rows beside it and the ratio put it, the ends
/// left out [m].
double g1Residual(const Garment& garment, const Seam& seam);

}  // namespace gambeson
