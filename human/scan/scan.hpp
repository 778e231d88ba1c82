#pragma once
/// A body scan, a surface without a skeleton, becomes a human with the links and joints of our manikins: as a character
/// does, so that every motion drives it and every garment can be drafted on it.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "human/body/body.hpp"

namespace gambeson {

struct ScanOptions {
  std::filesystem::path file;      ///< .obj, .ply, .stl, .gltf, .glb
  std::optional<double> height_m;  ///< it is scaled to; otherwise its unit is guessed
  std::string up, facing;          ///< axes of the file (x, -x, y, ...); empty: they are found
  double close_holes = 0.25;       ///< rims up to this share of the body's height are closed
  std::string like = "male_p50";   ///< the manikin whose limits of joints and shares of mass it takes
  std::optional<double> mass_kg;   ///< otherwise that of its volume at 1,000 kg/m³
  double bridge_folds_m = 0;       ///< as CharacterOptions
};

/// A girth of the scan as it lies in the file, and of the skin made of it in the standing posture [m].
struct ScanGirth {
  std::string name;
  double scan_m = 0, standing_m = 0;
};

struct ScanReport {
  char pose = 0;        ///< T or A
  double arms_deg = 0;  ///< of the upper arms from hanging down
  double height_m = 0, volume_m3 = 0;
  std::vector<ScanGirth> girths;
  std::vector<std::string> notes;
};

/// The scan is cleaned (repair.hpp), stood up and scaled (upright.hpp); joints follow from landmarks (landmarks.hpp,
/// joints.hpp) and weights from distances along the skin (weights.hpp); the lower limit of the shoulders' abduction is
/// where the arms meet the trunk. Throws InputError with file and key, the
/// landmark that was not found among them.
Human loadScan(const ScanOptions& options, ScanReport* report = nullptr);
/// The same of a mesh, whose file is only named.
Human scanOf(const TriangleMesh& raw, const ScanOptions& options, ScanReport* report = nullptr);

}  // namespace gambeson
