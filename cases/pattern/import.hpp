#pragma once
/// `gambeson import`: from the pattern of another program to a pattern's file and a drawing at 1:1; from its surfaces
/// or its mesh to a garment's file.

#include <filesystem>
#include <iosfwd>

#include "cases/pattern/imported.hpp"

namespace gambeson {

struct ImportArguments {
  /// Of GarmentCode (.json), DXF-AAMA/ASTM (.dxf), CAD (.step, .stp, .igs, .iges, .brep), a mesh (.obj,
  /// .ply), or what this command wrote.
  std::filesystem::path file;
  std::filesystem::path output, svg;  ///< what to write; empty: not
  ImportChoices choices;
};

/// Reads by content and ending; CAD files whose faces are planes. Throws InputError where the format is none that is
/// read.
ImportedPattern importPattern(const std::filesystem::path& file, const ImportChoices& choices);

/// Imports, says what was found (panels or patches with areas, seams with lengths, notes, what was dropped), writes.
/// Returns 0.
/// Throws InputError as importPattern, and where outputs are in the way.
int importToFiles(const ImportArguments& a, std::ostream& out);

}  // namespace gambeson
