#pragma once
/// A dressed state: where the garments are on a body that stands, as a file that many runs start from (JSON).
///
///   {"format": "gambeson dressed 1", "body": "<fingerprint>",
///    "posture": {"joints": [...], "origin_m": [x, y, z], "rotation": [nine numbers, row by row]},
///    "garments": [{"name": "shorts", "points_m": [[x, y, z], ...],         control points, patch by patch, u fastest
///                  "law": "stop", "history": [...]}]}                      what its laws remember, where they do

#include <filesystem>
#include <string>
#include <vector>

#include "cases/wear/case/case.hpp"

namespace gambeson {

struct DressedGarment {
  std::string name;
  std::vector<Vec3> points_m;        ///< of all patches, in turn
  std::string law = {};              ///< whose history it is (lawsThatRemember)
  std::vector<double> history = {};  ///< patch by patch, by place (Cloth::historyPlaces); empty: it remembers nothing
};

struct Dressed {
  std::string body;  ///< fingerprint of the human without its motion
  Posture posture;
  std::vector<DressedGarment> garments;  ///< as in the case, innermost first
};

/// What tells one body from another: who it is and what its surface is made of, not what it does.
std::string bodyFingerprint(const HumanCase& human);

/// Throws RunError where the file cannot be written.
void writeDressed(const Dressed& dressed, const std::filesystem::path& file);
/// Throws InputError with file and key.
Dressed readDressed(const std::filesystem::path& file);

}  // namespace gambeson
