#pragma once
/// Where the strain of cloth on patches is limited (Zheng 2013, sections 5.4 and 5.5).

#include <span>
#include <vector>

#include "core/cloth/draft/garment.hpp"
#include "core/cloth/draft/seams.hpp"
#include "core/cloth/strain_rows.hpp"

namespace gambeson {

/// Each patch has the strains of its own vertices, so that both sides of a seam are held: across a C0 seam they differ.
/// Strains that are the same function of the free points (along a seam; all of a G1 seam whose threads run on) are one
/// row, and points that share both rows are one. On trimmed patches vertices
/// outside are left out, and crossings of loops with knot lines are added unless they lie within 5 % of a cell of
/// another point, whose strain says the same.
StrainRows buildStrainRows(const Garment& garment, const FreeMap& map, Mobility mobility,
                           LimitPoints points = LimitPoints::vertices);

/// The field of limitStress, which is known at the vertices of all patches, at a point of a patch: bilinear in each
/// cell. Points of threads: the multiplier over the area, linear between the points. Vertices: a multiplier over its
/// area alternates from point to point, since the sums over points do not integrate exactly. So each cell takes its
/// share of the multipliers of its corners over its area (that is its one Gauss point; points that share a row have it
/// by their areas), which keeps the integral, and the field is extended from the cells to the vertices: mean of four
/// inside, fitted plane at borders. A linear field is kept exactly.
Vec2 limitStressAt(const StrainRows& rows, std::span<const Vec2> field, int patch, Vec2 uv);

}  // namespace gambeson
