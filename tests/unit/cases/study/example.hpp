#pragma once
/// A study for tests, and what its runs would leave.

#include <cmath>
#include <string>
#include <vector>

#include "cases/study/compare.hpp"
#include "unit/cases/example.hpp"

namespace gambeson::study::tested {

inline const std::string cloth = R"({"name": "cloth",
  "garment": {"sheet": {"width": "0.1 m", "height": "0.1 m", "cells_u": 2, "cells_v": 2}},
  "fabric": {"thickness": "1 mm", "density": "500 kg/m^3", "young": "1 MPa", "poisson": 0.3,
             "bending": {"law": "linear", "rigidity": "1e-4 N m"}},
  "obstacles": [{"name": "floor", "plane": {"point": [0, 0, -1]}}],
  "contact": {"friction": 0.3}, "time": {"duration": 0.1}})";

/// The first line below is line 1 of the file.
inline const std::string good = R"({
  "name": "thin and thick",
  "case": "cloth.json",
  "axes": [
    {"path": "factors.thickness", "values": [0.5, 0.75, 1]},
    {"name": "mesh", "sets": [{"garment.sheet.cells_u": 2, "garment.sheet.cells_v": 2},
                              {"garment.sheet.cells_u": 3, "garment.sheet.cells_v": 3}], "labels": ["coarse", "fine"]},
    {"name": "slip", "path": "contact.friction", "values": [0.1, 0.4], "labels": ["smooth", "rough"]}
  ],
  "variants": [{"label": "slow", "at": {"slip": "rough"}, "set": {"time.max_step": "0.1 ms"}}],
  "elasticities": {"step": 0.2, "where": {"mesh": ["coarse"]}}
})";

inline Study read(const std::string& text) {
  static const Folder folder;
  folder.write("cloth.json", cloth);
  return readStudy(folder.write("a.study.json", text));
}

inline const Variant& variant(const Study& s, const std::string& folder) {
  for (const Variant& v : s.variants)
    if (v.folder == folder) return v;
  ADD_FAILURE() << "no variant " << folder;
  return s.variants[0];
}

/// Runs whose torque is 4 Nm (0.65 t + 0.31 t^3 + 0.04), each part of it with its factor; the fine mesh has 5 % more;
/// rough cloth twice as much. Standing is 0.5 Nm of it.
inline std::vector<RunNumbers> numbersOf(const Study& s) {
  std::vector<RunNumbers> runs;
  for (const Variant& v : s.variants) {
    const Case& c = std::get<Case>(v.definition);
    const FactorsCase& f = c.factors;
    const double t = f.thickness;
    double tau = 4 * (0.22 * t * f.membrane + 0.28 * t * f.weight + 0.15 * t * f.inertia +
                      0.31 * t * t * t * f.bending + 0.04 * f.drag);
    const bool fine = std::get<SheetGarment>(c.garments[0].shape).cells_u == 3;
    if (fine) tau *= 1.05;
    if (c.contact.friction == 0.4) tau *= 2;
    RunNumbers r;
    r.good = true;
    r.control_points = fine ? 25 : 16;
    r.recorded_to_s = r.planned_to_s = 1;
    r.garments = {{"", 0.5 * t, 1, 1e-3 * t, r.control_points}};
    JointNumbers j;
    j.name = "hip_flexion_left";
    j.label = "left hip (flexion)";
    j.natural_Nm = 100;
    j.standing_Nm = 0.5;
    for (int w = 0; w < 100; ++w) {
      r.time_s.push_back(0.005 + 0.01 * w);
      j.torque_Nm.push_back(tau * std::sin(2 * M_PI * r.time_s.back()));
      if (std::abs(j.torque_Nm.back()) > std::abs(j.peak_Nm))
        j.peak_Nm = j.torque_Nm.back(), j.peak_time_s = r.time_s.back();
    }
    j.rms_Nm = rms(j.torque_Nm);
    JointNumbers elbow;
    elbow.name = elbow.label = "elbow";
    elbow.torque_Nm.assign(100, 0);
    r.joints = {j, elbow};
    runs.push_back(r);
  }
  return runs;
}

}  // namespace gambeson::study::tested
