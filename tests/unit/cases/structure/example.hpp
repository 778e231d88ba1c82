#pragma once
/// A static case that uses most of the fields, to be broken in one place at a time.

#include <string>

#include "unit/cases/example.hpp"

namespace gambeson {

/// The first line below is line 1 of the file.
// clang-format off
inline const std::string structure_example = R"json({
  "kind": "static",
  "name": "example",
  "sheet": {
    "plate": {"width": 2, "height": 1, "corner": [0, 0, 0], "axis_u": [1, 0, 0], "axis_v": [0, 1, 0]},
    "degree": 2, "cells_u": 8, "cells_v": 4, "refine_u": [0.3], "refine_v": [],
    "trim": [
      {"circle": {"center": [0.5, 0.5], "radius": 0.2}},
      {"polygon": {"points": [[1.2, 0.3], [1.6, 0.3], [1.6, 0.7], [1.2, 0.7]]}}
    ],
    "fields": [{"patch": 0, "thickness": {"degree": 1, "values": [[1, 1.5], [1, 1.5]]}}]
  },
  "material": {
    "laminate": {"plies": [
      {"thickness": 0.001, "young1": 3300, "young2": 1100, "shear": 660, "poisson12": 0.25},
      {"thickness": 0.001, "young1": 3300, "young2": 1100, "shear": 660, "poisson12": 0.25, "angle": "90 deg"}
    ], "density": 1000}
  },
  "supports": [
    {"edge": "u0", "hold": "xyz", "clamp": true},
    {"edge": "u1", "hold": "z", "move": [0, 0, 0.1], "program": "up"}
  ],
  "loads": [
    {"gravity": [0, 0, -9.81]},
    {"edge": "u1", "force": [1, 0, 0], "program": "up"},
    {"point": [1, 0.5], "force": [0, 1, 0]}
  ],
  "programs": {"up": [[0, 0], [0.5, 1], [1, 1]]},
  "solver": {"steps": 4, "tolerance": 1e-9},
  "output": {
    "points": [{"name": "tip", "point": [1, 0.5]}, {"name": "corner", "corner": "u1v1"}],
    "edges": [{"name": "root", "edge": "u0"}]
  }
})json";
// clang-format on

}  // namespace gambeson
