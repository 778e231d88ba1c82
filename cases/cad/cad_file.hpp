#pragma once
/// STEP, IGES and .brep files, read and written by OpenCASCADE in a process of its own (core/io/apart.hpp).

#include <filesystem>
#include <string>

#include "cases/cad/module.hpp"

namespace gambeson {

/// Endings of a format: .step, .stp; .igs, .iges; .brep. False for others.
bool isCadFile(const std::filesystem::path& file, CadFormat& format);

/// Reads the faces, tidied (tidyFaces). `metres`: of the unit of a file that says none; 0: not said. Throws InputError
/// with the file and, where one is to blame, the face: no faces, damaged files, units that nobody says, borders that
/// are no good, what crashes or outruns its reader.
CadShape readCad(const std::filesystem::path& file, double metres = 0);

/// Writes faces, sewn where their edges lie within `tolerance_m` of each other; STEP or IGES as the ending says.
/// Control points keep every bit. Replaces the file atomically. Throws InputError where the ending is neither, RunError
/// where OpenCASCADE's checker refuses the result or the file cannot be written.
void writeCad(const std::filesystem::path& file, const std::string& title, const CadShape& shape,
              double tolerance_m = 1e-5);

}  // namespace gambeson
