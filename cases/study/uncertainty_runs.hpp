#pragma once
/// The runs that tell how sure a study's numbers are.

#include <string>
#include <vector>

#include "cases/study/input.hpp"

namespace gambeson::study {

/// One run beside a reference, of which it tells a part of the error bar.
struct UncertaintyRun {
  BarPart part = BarPart::none;
  std::string label;           ///< "fabric 03"
  std::vector<Setting> set;    ///< beside those of the reference
  std::vector<double> scores;  ///< of a sample of the fabric
};

/// What is asked for, as it comes out of what the study gives and of the cards of the fabrics of `c`. `entry`: the key
/// "uncertainty"; throws InputError there where nothing is asked for.
Uncertainty uncertaintyOf(const schema::Entry& entry, const UncertaintyInput& in, const Case& c,
                          bool meshes_of_its_own);

/// The runs beside the reference `c`, whose file has `root` (with the values of its variant put in).
///   fabric: of Latin-hypercube scores z a factor exp(s z) on each number that spreads (multipleOf); a thickness t is
///           factors.thickness t and factors.bending 1/t^3, since the rigidity of bending was measured by itself;
///   step:   half of every step, over `step_duration`;
///   mesh:   cells that are `finer` times smaller, numbers of cells as many times larger.
std::vector<UncertaintyRun> uncertaintyRuns(const schema::Entry& entry, const UncertaintyInput& in,
                                            const Uncertainty& asked, const Case& c, const JsonNode& root);

}  // namespace gambeson::study
