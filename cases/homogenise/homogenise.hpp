#pragma once
/// `gambeson homogenise`: from a case of the kind cell to the file of a law that fabrics take.

#include <array>
#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

namespace gambeson {

struct HomogeniseArguments {
  std::filesystem::path file;          ///< the case
  std::vector<std::string> overrides;  ///< "path=value"
  std::filesystem::path law;           ///< LAW.json
  /// Ends of the range of E11, E22 and E12, Green-Lagrange.
  std::array<double, 2> e11{-0.02, 0.10}, e22{-0.02, 0.10}, e12{-0.25, 0.25};
  double tension_error = 2e-3, shear_error = 8e-3;  ///< wanted, of the largest in the range
  int most_nodes = 4000;
  bool rigidity_at_rest = false;  ///< bending rigidity of the cell at rest for all strains
  bool shrink = false;            ///< the range, where a load has no stable equilibrium
  int threads = 0;
};

/// Fills the table of the cell, writes it with where it comes from, and says how good it is. Throws InputError where
/// the case is none of rods, or an option is out of range; RunError where a load finds no equilibrium, or (the table is
/// written all the same) where the errors wanted were not reached.
int homogeniseCell(const HomogeniseArguments& a, std::ostream& out);

}  // namespace gambeson
