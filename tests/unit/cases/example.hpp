#pragma once
/// A case that uses most of the fields, to be broken in one place at a time.

#include <unistd.h>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

namespace gambeson {

/// A folder of its own for one test, removed at its end.
class Folder {
 public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "gambeson_cases_XXXXXX").string();
    path_ = mkdtemp(name.data());
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::filesystem::path write(const std::string& name, const std::string& text) const {
    const std::filesystem::path file = path_ / name;
    std::ofstream(file, std::ios::binary) << text;
    return file;
  }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// The first line below is line 1 of the file.
// clang-format off
inline const std::string example = R"json({
  "name": "example",
  "garment": {
    "sheet": {"width": "0.4 m", "height": 0.4, "cells_u": 8, "cells_v": 8,
              "axis_u": [1, 0, 0], "axis_v": [0, 2, 0]},
    "weft_angle": "45 deg"
  },
  "fabric": {
    "thickness": "1 mm",
    "density": "436 kg/m^3",
    "young": "1.2 MPa",
    "poisson": 0.3,
    "bending": {"law": "zheng", "rigidity": "7e-6 N m", "kappa0": "30 1/m"}
  },
  "human": {
    "manikin": "male_p50",
    "motion": {"walk": {"strides": 1}}
  },
  "obstacles": [
    {"name": "ball", "sphere": {"radius": "10 cm", "rings": 8, "segments": 9}},
    {"name": "floor", "plane": {"point": [0, 0, "-1 cm"]}, "velocity": [0, 0, "1 mm/s"]}
  ],
  "supports": [
    {"fixed": {"edge": "u0", "rows": 2}},
    {"springs": {"edge": "0.v1", "stiffness": 100, "link": "pelvis"}}
  ],
  "contact": {"friction": 0.2},
  "air": {"drag": "4 kg/(m^2 s)", "velocity": "pelvis_mean"},
  "dressing": {"projecting": {"clearance": "5 mm"}, "settle": "0.2 s"},
  "output": {"frame": "20 ms", "checkpoint": "40 ms",
             "pictures": [{"time": "peak"},
                          {"time": "0.5 s", "field": "pressure", "view": "back", "width": 640}]},
  "analysis": {"joints": ["hip_flexion_left"], "counting": "all_distal", "task": "natural_walk"}
})json";
// clang-format on

/// `text` with the one place that reads `from` replaced.
inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  if (at == std::string::npos || text.find(from, at + 1) != std::string::npos)
    std::fprintf(stderr, "the test's text is not there once: %s\n", from.c_str()), std::abort();
  return text.replace(at, from.size(), to);
}

}  // namespace gambeson
