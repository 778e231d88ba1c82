#pragma once
/// What kinds of support differ in: a row for each, a file for each row. Who adds a kind adds its struct to SupportCase
/// (cases/wear/case/case.hpp), a file beside this one, and its row to the list in kind.cpp.

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "cases/wear/case/case.hpp"
#include "core/cloth/cloth.hpp"
#include "core/motion/model.hpp"
#include "human/body/body.hpp"

namespace gambeson {

namespace schema {
template <class T>
class Table;
}

/// What holds the garment, by name, as the supports table lists it.
struct SupportGroup {
  std::string name;                 ///< "waist springs to pelvis", "fixed start"
  std::vector<int> springs;         ///< indices in Model::springs; empty for held control points
  std::vector<int> control_points;  ///< held
  /// Of the held points, the index in Model::held_points and the part of its force: a point that several supports hold
  /// is shared equally.
  std::vector<std::pair<int, double>> held;
  std::vector<int> samples;  ///< of the supported edge
  int anchor = -1;           ///< frame of the springs
  /// Of a cord, the indices in Model::stitches and their stiffness once it is drawn [N/m]; it carries nothing.
  std::vector<std::pair<int, double>> cord;
};

/// What a support has to hold.
struct SupportedCloth {
  const Cloth& cloth;
  const Surface& surface;
  const Human* human = nullptr;           ///< null where the case has none
  std::string name;                       ///< of the edge; of what is on none, of the garment, with a blank
  int first_patch = 0;                    ///< of the garment
  NamedEdge edge{};                       ///< its patches are those of the cloth
  std::vector<std::vector<int>> lines{};  ///< samples along each part of the edge
};

/// All functions are of supports of this kind.
struct SupportKind {
  const char* word = "";  ///< its key in a case file
  /// Adds its key, with the table of what stands below it.
  void (*addTo)(schema::Table<SupportCase>& table) = nullptr;
  bool on_edge = true;  ///< else at a point
  /// The link of the human that it ties to; null where it needs no human.
  const std::string* (*link)(const SupportCase& s) = [](const SupportCase&) -> const std::string* { return nullptr; };
  /// Names the group, and adds what it holds to it, and springs to `options`. Throws InputError.
  void (*hold)(const SupportCase& s, const SupportedCloth& on, ModelOptions& options, SupportGroup& group) = nullptr;
};

/// In the order of the documentation.
std::span<const SupportKind* const> supportKinds();
const SupportKind& kindOf(const SupportCase& s);
/// The edge that it is on; of what is on none garment and patch alone.
const EdgeCase& edgeOf(const SupportCase& s);
/// Of what holds points; null for springs.
const HeldSupport* heldOf(const SupportCase& s);

}  // namespace gambeson
