#pragma once
/// Surfaces of CAD programs: what leaves a STEP, IGES or .brep file, and what goes into one.

#include <string>
#include <vector>

#include "core/io/apart.hpp"
#include "core/nurbs/trim.hpp"

namespace gambeson {

/// A face: a surface, and its border as loops in the surface's parameters, counter-clockwise around what is kept. The
/// normal x,u x x,v points to the side that the file calls the outside.
struct CadFace {
  std::string name;
  NurbsPatch patch;             ///< control points [m]
  std::vector<TrimLoop> loops;  ///< all of the border, also where it is that of the patch
  bool plane = false;           ///< the file says a plane, not a spline that happens to be flat
  bool inside_out = false;      ///< of a file: the outside is against x,u x x,v, until tidyFaces turns it
  double area_m2 = 0;           ///< as OpenCASCADE integrates it
  double tolerance_m = 0;       ///< how far the file lets edges lie from each other and from the surface
};

/// A curve of a face's border.
struct CadSide {
  int face = 0, loop = 0, curve = 0;
};

/// An edge that two faces share, or one has twice.
struct CadSeam {
  CadSide a, b;
  bool reversed = false;  ///< b runs against a
  double length_m = 0;    ///< as OpenCASCADE integrates it
};

struct CadShape {
  std::vector<CadFace> faces;
  std::vector<CadSeam> seams;
  std::string unit;                  ///< as the file says it; empty: it says none
  std::vector<std::string> notes;    ///< what was read in a way that should be known
  std::vector<std::string> dropped;  ///< what the file has and no face says
};

/// From one process to another.
void put(BytesOut& out, const CadShape& shape);
void get(BytesIn& in, CadShape& shape);

}  // namespace gambeson
