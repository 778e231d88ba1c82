#pragma once
/// Patches through given surfaces, and nets made exactly G1.

#include <functional>

#include "core/cloth/draft/garment.hpp"

namespace gambeson {

/// The polynomial patch that meets `surface` at its Greville points, u and v from 0 to 1. Well conditioned for degrees
/// up to 9.
NurbsPatch interpolate(const KnotVector& u, const KnotVector& v, const std::function<Vec3(double, double)>& surface);
/// The same for what stands at the Greville points, u fastest.
NurbsPatch interpolate(const KnotVector& u, const KnotVector& v, const std::vector<Vec3>& data);

/// The control points of an edge, in the order of `edge`; row 0 is the edge, row 1 the row beside it, and so on.
std::vector<int> edgeRow(const NurbsPatch& patch, const PatchEdge& edge, int row = 0);

/// Makes a seam exactly G1 with ratio 1: each control point of the edge becomes the average of its two neighbours
/// (Zheng 2013, eq. 2.31 with c' = 1), save the first `skip_first` and the last `skip_last` along edge a.
void averageSeam(Garment& garment, const Seam& seam, int skip_first, int skip_last);

}  // namespace gambeson
