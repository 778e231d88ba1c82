#pragma once
/// What stands between us and OpenCASCADE: a library of its own (`gambeson_cad.so`, from cases/occt), which only a
/// process that reads or writes CAD files loads. Its libraries would make every start of the program slower.

#include <string>

#include "cases/cad/cad_shape.hpp"

namespace gambeson {

enum class CadFormat : int { step, iges, brep };

struct CadModule {
  /// Reads a file whose unit is `metres`, where that is not 0 and the file says none. Throws InputError.
  CadShape (*read)(const std::string& file, CadFormat format, double metres);
  /// The text of a file of these faces, sewn where their edges lie within `tolerance_m` of each other. Throws
  /// RunError.
  std::string (*write)(const std::string& title, const CadShape& shape, CadFormat format, double tolerance_m);
};

}  // namespace gambeson

extern "C" const gambeson::CadModule* gambesonCadModule();
