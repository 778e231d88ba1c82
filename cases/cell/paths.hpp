#pragma once
/// The way of a cell through a load.

#include <string>
#include <vector>

#include "cases/cell/case.hpp"
#include "core/yarn/cell_faces.hpp"

namespace gambeson {

/// What a cell is brought to: a load, in which the strain of the direction that is free is where it carries nothing.
struct CellTarget {
  CellLoad load;
  std::optional<YarnDirection> free;
};

/// Of a part t of the way, from 0 (before the load proper: the extension alone, or rest) to 1.
CellTarget targetOf(const PathLoads& load, double t);

/// The parts of the way at which there is a row: 0, 1/steps ... 1, and with cycles back to 0, and there again.
std::vector<double> partsOf(const PathCase& path);

/// What the load is plotted over.
struct PathAbscissa {
  std::string column, title;  ///< of curves.csv; with its unit, for people
};
PathAbscissa abscissaOf(const PathLoads& load);

/// "Stretched along both directions to 20 %".
std::string inWords(const PathLoads& load);

}  // namespace gambeson
