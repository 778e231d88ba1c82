#pragma once
/// Results in the formats of other programs: CAD (STEP, IGES) and OpenSim.

#include <filesystem>

#include "cases/wear/case/case.hpp"

namespace gambeson {

struct ExportOptions {
  std::filesystem::path results;        ///< folder of a run
  std::filesystem::path step, iges;     ///< empty: none
  std::filesystem::path opensim;        ///< prefix of the .xml and the .mot; empty: none
  PictureTime when = PictureTime::end;  ///< of the STEP and the IGES file
  double time_s = 0;                    ///< where `when` is `at`
};

/// Returns the exit status; throws InputError where the results cannot give what is asked.
int exportResults(const ExportOptions& options);

}  // namespace gambeson
