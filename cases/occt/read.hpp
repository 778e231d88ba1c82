#pragma once
/// Files of CAD programs as shapes of OpenCASCADE, in a process that may die of them.

#include <string>

#include "cases/cad/module.hpp"

namespace gambeson {

CadShape readShape(const std::string& file, CadFormat format, double metres);

}  // namespace gambeson
