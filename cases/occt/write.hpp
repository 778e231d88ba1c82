#pragma once
/// Faces as shapes of OpenCASCADE, and these as files.

#include <string>

#include "cases/cad/module.hpp"

namespace gambeson {

std::string shapeText(const std::string& title, const CadShape& shape, CadFormat format, double tolerance_m);

}  // namespace gambeson
