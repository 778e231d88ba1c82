#pragma once
/// Results in the formats of other programs: CAD (STEP, IGES), players of animations (glTF, OBJ) and OpenSim.

#include <filesystem>
#include <string>
#include <vector>

#include "cases/wear/case/case.hpp"

namespace gambeson {

struct ExportOptions {
  std::filesystem::path results;     ///< folder of a run
  std::filesystem::path step, iges;  ///< empty: none
  std::filesystem::path opensim;     ///< prefix of the .osim, .xml and two .mot; empty: none
  std::filesystem::path glb;         ///< animation; empty: none
  std::filesystem::path obj;         ///< of each frame a file of this name with its number; empty: none
  int frames = 0;                    ///< of animations, at most; 0: all
  double largest_glb = 100e6;        ///< bytes: what browsers and mail still take; above it there are fewer frames
  PictureField field = PictureField::stress;  ///< that an animation is coloured by
  PictureTime when = PictureTime::end;        ///< of the STEP and the IGES file, and of the colours
  double time_s = 0;                          ///< where `when` is `at`
};

/// What `export` writes, by the ending of a file's name in lower case.
struct ExportFormat {
  std::vector<std::string> endings;
  std::string what;
  std::filesystem::path ExportOptions::*file;
};
const std::vector<ExportFormat>& exportFormats();

/// Returns the exit status; throws InputError where the results cannot give what is asked.
int exportResults(const ExportOptions& options);

}  // namespace gambeson
