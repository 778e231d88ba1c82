#pragma once
/// A law table as files have it: n = A E with A11 = A22 = 100, A33 = 50 N/m, D = diag(1, 1, 0.5) 1e-5 N m.

#include <string>

namespace gambeson {

/// The first line below is line 1 of the file.
// clang-format off
inline const std::string small_law = R"json({
  "version": 1,
  "units": {"energy": "J/m^2", "moment": "N", "rigidity": "N m"},
  "even_in_shear": true,
  "membrane": {
    "e11": [-0.1, 0, 0.1], "e22": [-0.1, 0, 0.2], "g12": [0, 0.2],
    "energy": [1, 2, 0.5, 1.5, 2.5, 3.5, 0.5, 1.5, 0, 1, 2, 3, 1, 2, 0.5, 1.5, 2.5, 3.5]
  },
  "bending": {
    "e11": [0], "e22": [0], "g12": [0],
    "rigidity": [1e-5, 1e-5, 5e-6, 0, 0, 0]
  },
  "provenance": {"cell_name": "weave 7", "error_tension": 0.001, "compared_at": 40}
})json";
// clang-format on

}  // namespace gambeson
