#pragma once
/// What several drapes of one fabric say together, and how far they can be told from a card's coefficient.

#include <string>
#include <vector>

#include "cases/fabric/drape.hpp"

namespace gambeson::laboratory {

constexpr int kDrapeStarts = 3;        ///< whose mean is the result, as testers take that of several drapes
constexpr double kDrapeWithin = 0.08;  ///< as far off a card's coefficient may be, a part of 1

/// The same starts on the cells that were asked for, and on two thirds of them.
struct DrapeSeries {
  std::vector<Draped> starts;   ///< by their coefficients
  std::vector<Draped> coarser;  ///< in the order in which they began
  int cells = 0, coarser_cells = 0;

  double coefficient() const;  ///< mean of the starts
  double nodes() const;
  /// Half of what the starts differ by: folds that are found by chance.
  double spread() const;
  /// The mean less that of the coarser cells: what is left of it with ever finer ones is of that size, not its bound.
  double mesh() const;
  bool atRest() const;        ///< all of them, on both
  double unbalanced() const;  ///< the largest
  long crossings() const;     ///< the most, of `starts`
};

DrapeSeries drapeSeries(const Fabric& fabric, const Specimen& specimen, double specimen_m, double support_m);

/// One sentence: whether the mean lies within kDrapeWithin of a card's coefficient. That it does, or does not, is said
/// only where spread and mesh together leave no doubt of it, and all starts are at rest.
std::string drapeVerdict(const DrapeSeries& series, double card);

}  // namespace gambeson::laboratory
