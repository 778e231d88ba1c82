#pragma once
/// A cell that uses most of the fields, to be broken in one place at a time.

#include <string>

#include "unit/cases/example.hpp"

namespace gambeson {

/// The first line below is line 1 of the file.
// clang-format off
inline const std::string cell_example = R"json({
  "kind": "cell",
  "name": "example",
  "weave": {"pattern": "plain"},
  "weft": {
    "spacing": "1 mm", "amplitude": "0.16 mm", "half_width": "0.24 mm", "half_thickness": "0.16 mm",
    "moduli": {"young": "84.63 GPa", "axial_shear": "0.244 GPa"}
  },
  "warp": {
    "spacing": "1 mm", "amplitude": "0.16 mm", "half_width": "0.25 mm", "half_thickness": "0.16 mm",
    "section": {"stretch": 1e4, "shear_across": 25, "shear_through": 25, "torsion": 1e-6, "bending_through": 6e-5, "bending_in_plane": 1e-4}
  },
  "compression": {"half_force": "800 N", "exponent": 3},
  "height": "0.64 mm",
  "loads": [
    {"name": "both", "biaxial": {"extension": 0.04}, "steps": 4},
    {"name": "one", "uniaxial": {"extension": 0.04, "along": "warp", "sides": "free"}, "steps": 2},
    {"name": "bent", "bending": {"curvature": "5 1/m", "direction": "45 deg"}, "steps": 2},
    {"name": "turned", "trellis": {"angle": "10 deg", "extension": 0.01}, "steps": 2, "cycles": 1}
  ],
  "bars": [{"name": "two", "lengths": [0.5, 0.5], "young": [1e9, 3e9]}],
  "solver": {"pieces_per_spacing": 8},
  "output": {"pictures": [{"path": "both", "width": 160, "height": 120}]}
})json";
// clang-format on

}  // namespace gambeson
