#pragma once
/// What kinds of obstacle differ in: a row for each, a file for each row. Who adds a kind adds its struct to
/// ObstacleCase (cases/contact/contact.hpp), a file beside this one, and its row to the list in kind.cpp.

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "cases/contact/contact.hpp"
#include "core/contact/obstacle.hpp"
#include "human/body/ground.hpp"
#include "human/body/mesh_sequence.hpp"

namespace gambeson {

namespace schema {
template <class T>
class Table;
}

struct MadeObstacle {
  Shape shape;                                     ///< in its own frame [m]; of what deforms as it is first
  Vec3 origin_m{};                                 ///< of that frame at time 0
  std::unique_ptr<const MeshSequence> sequence{};  ///< of what deforms; else null
  std::vector<std::string> notes{};                ///< what a user should know of it
};

/// All functions are of obstacles whose shape is of this kind.
struct ObstacleKind {
  using Take = std::function<void(std::filesystem::path&)>;

  const char* word = "";  ///< its key in a case file
  /// Adds its key, with the table of what stands below it.
  void (*addTo)(schema::Table<ObstacleCase>& table) = nullptr;
  /// `stepped_over`: what the human of the case steps over; null where nothing is. Throws InputError where a file does
  /// not read, or holds no surface.
  MadeObstacle (*make)(const ObstacleCase& o, const Hurdle* stepped_over) = nullptr;
  /// Reads its files once, with the errors that reading has.
  void (*check)(const ObstacleCase& o) = [](const ObstacleCase&) {};
  /// Calls `take` with the path of each file that it is read from; `take` may put another in its place.
  void (*files)(ObstacleCase& o, const Take& take) = [](ObstacleCase&, const Take&) {};
};

/// In the order of the documentation.
std::span<const ObstacleKind* const> obstacleKinds();
const ObstacleKind& kindOf(const ObstacleCase& o);

/// What is wrong with the mesh of an obstacle, read from `file`, in words; empty where nothing is. Throws InputError
/// where it is no surface.
std::string defectsOf(const TriangleMesh& mesh, const std::string& name, const std::filesystem::path& file);

}  // namespace gambeson
