#pragma once
/// How a draft is cut into triangles, and how triangles lie at rest.

namespace gambeson {

/// single: every cell of the draft in two triangles with the same diagonal. equilateral: rows of triangles with sides
/// of a cell's width, every other row shifted by half a side; patches that are trimmed have none.
enum class MeshKind { single, equilateral };

/// How a garment of triangles lies at rest. fabric: as the mesh stands, hinges straight or with its angles as the
/// fabric counts bending (hasRestCurvature); shape: as the mesh stands, hinges keep its angles; in both uv turns the
/// threads alone. flat: as uv says, hinges straight.
enum class MeshRest { fabric, shape, flat };

}  // namespace gambeson
