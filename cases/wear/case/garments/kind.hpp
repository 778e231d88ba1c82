#pragma once
/// What kinds of garment differ in: a row for each, a file for each row. Who adds a kind adds its struct to GarmentCase
/// (cases/wear/case/case.hpp), a file beside this one, and its row to the list in kind.cpp.

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "cases/wear/case/case.hpp"
#include "core/cloth/draft/mesh_draft.hpp"
#include "human/motion/motion.hpp"
#include "tryon/pattern/armour.hpp"
#include "tryon/pattern/flat/panel_fit.hpp"
#include "tryon/pattern/form.hpp"

namespace gambeson {

namespace schema {
template <class T>
class Table;

/// What `cell` of a draft means to whoever chooses it.
inline constexpr const char* kCellDoc =
    "wanted size of a cell, the piece that cloth is computed in: 40 to 50 mm try a case out (a walk in minutes, peaks "
    "within some 40 %), 20 to 30 mm are for numbers to rely on (most of an hour); half the size takes some ten times "
    "as "
    "long";
}  // namespace schema

/// What a user should know of how a garment fits its wearer, before it is put on.
struct GarmentFit {
  std::vector<std::string> notes;
  std::vector<PanelGirth> girths;  ///< of flat panels around the body; of others the cloth itself is measured
};

/// What a garment is made from.
struct GarmentMaking {
  const GarmentCase& worn;
  const FabricCase& fabric;
  double layer_m = 0;              ///< that it keeps from others where it is thickest
  const BodyForm* form = nullptr;  ///< null without a human
  std::span<const Worn> under;     ///< the garments before it
  const Human* human = nullptr;    ///< null without a human, or where it has no surface
  Posture posture;                 ///< in which it is put on
  GarmentFit* fit = nullptr;       ///< takes how it fits the body; null: nobody asks
};

/// What a garment asks of the arms of whoever is dressed: nothing, that they hang as it was drafted for, or that they
/// are further from the sides.
enum class ArmsWanted { any, hanging, aside };

/// All functions are of garments whose shape is of this kind.
struct GarmentKind {
  using Names = std::vector<std::string>;
  using Take = std::function<void(std::filesystem::path&)>;

  const char* word = "";  ///< its key in a case file
  bool drafted = false;   ///< on the human, without whom it cannot be
  bool sewn = false;      ///< flat panels that stand around the wearer, whose seams close when it is put on
  /// Adds its key, with the table of what stands below it.
  void (*addTo)(schema::Table<GarmentCase>& table) = nullptr;
  /// Edges and patches that it has by name before it is made; of what is read only its file knows them.
  Names (*edges)(const GarmentCase& g) = [](const GarmentCase&) { return Names{}; };
  Names (*patches)(const GarmentCase& g) = [](const GarmentCase&) { return Names{"patch_0"}; };
  /// Cells that it is known to get before it is made; 0 for what is drafted on the body or read.
  long (*cells)(const GarmentCase& g) = [](const GarmentCase&) { return 0L; };
  /// Why its patches can have no fields; empty where they can.
  std::string (*fieldless)(const GarmentCase& g) = [](const GarmentCase&) { return std::string(); };
  /// Makes the garment where its kind puts it (`position` and `weft_angle` follow), without fabrics and fields.
  Garment (*make)(const GarmentMaking& making) = nullptr;
  ArmsWanted (*arms)(const GarmentCase& g) = [](const GarmentCase&) { return ArmsWanted::any; };
  /// Whether it is put on in the posture of the wearer's skin, as a scan was scanned, and not as he is dressed.
  bool (*as_scanned)(const GarmentCase& g) = [](const GarmentCase&) { return false; };
  /// Reads the patches and edges of what stands in a file, for all that a case may name of them. Throws InputError
  /// where the file is not well. Null: it is not read.
  Garment (*look)(const GarmentCase& g) = nullptr;
  /// Calls `take` with the path of each file that it is read from; `take` may put another in its place.
  void (*files)(GarmentCase& g, const Take& take) = [](GarmentCase&, const Take&) {};
  /// Of what is triangles from the start, and has no patches: they, in place. Null: patches are drafted.
  MeshDraft (*triangles)(const GarmentCase& g, const Fabric& fabric) = nullptr;

  bool isRead() const { return look != nullptr; }
  bool isMesh() const { return triangles != nullptr; }
};

/// In the order of the alternatives of GarmentCase::shape, which is that of the documentation.
std::span<const GarmentKind* const> garmentKinds();
const GarmentKind& kindOf(const GarmentCase& g);

}  // namespace gambeson
