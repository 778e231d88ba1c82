#pragma once
/// From OpenCASCADE's topology to ours.

#include <TopoDS_Shape.hxx>
#include <functional>
#include <string>

#include "cases/cad/cad_shape.hpp"

namespace gambeson {

/// Adds the faces of a shape in millimetres, sewn where their borders lie within 0.01 mm of each other, and the edges
/// that they share. `nameOf` names a face of the shape, or says nothing. Throws InputError (key "face 3") where a face
/// has no border in its surface's parameters, or is none of finite size.
void addFaces(const TopoDS_Shape& shape, const std::function<std::string(const TopoDS_Shape&)>& nameOf, CadShape& out);

}  // namespace gambeson
