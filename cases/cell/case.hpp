#pragma once
/// A cell of a woven cloth, its yarns, and the loads that it is taken through: the kind of case that says what a cloth
/// will carry before it is woven (Man 2006, chapter 4). What each field means in a case file, its default and range:
/// cases/FIELDS.md, written by the tables in cases/cell/fields*.cpp and cases/yarns.

#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "analysis/render/render.hpp"
#include "cases/input/json.hpp"
#include "cases/yarns/cell_design.hpp"
#include "core/yarn/periodic_bar.hpp"

namespace gambeson {

// --- Loads -------------------------------------------------------------------------------------------------------

/// Stretched along both directions: Phi11 = 1 + extension, Phi22 = 1 + ratio extension.
struct BiaxialPath {
  double extension = 0, ratio = 1;
};
/// Stretched along one direction; the other keeps its length, or is free to change it.
struct UniaxialPath {
  double extension = 0;
  YarnDirection along = along_weft;
  bool free_sides = false;
};
/// Phi11 = Phi22 = 1 - shortening.
struct CompressionPath {
  double shortening = 0;
};
/// As printed (Man 2006, section 4.3.5): Phi12 = Phi21 = shear, after Phi11 = Phi22 = 1 + extension.
struct ShearPath {
  double shear = 0, extension = 0;
};
/// Yarns turn towards each other by an angle and keep their spacing along themselves, after an extension.
struct TrellisPath {
  double angle_rad = 0, extension = 0;
};
/// To a cylinder whose arcs run along `direction`, from the weft towards the warp; of cloth that nothing pulls (yarns
/// that are pulled would slip through the cloth to where arcs are shorter).
struct BendingPath {
  double curvature_per_m = 0, direction_rad = 0;
};
using PathLoads = std::variant<BiaxialPath, UniaxialPath, CompressionPath, ShearPath, TrellisPath, BendingPath>;

struct PathCase {
  std::string name;
  PathLoads load;
  int steps = 20;  ///< from its begin to its end
  int cycles = 0;  ///< there and back; 0: there
};

// --- What is asked -----------------------------------------------------------------------------------------------

struct BarCase {
  std::string name;
  PeriodicBar bar;
};

enum class CellShapesKept { last, all, none };
/// stress: along the yarns; pressure: of yarns on each other, of solids; direction: weft and warp in colours of their
/// own.
enum class CellField { stress, pressure, direction };

struct CellPicture {
  std::string path;  ///< its end; empty: the cell at rest
  CellField field = CellField::stress;
  View view = View::above;
  std::optional<int> repeats;  ///< of the cell, either way
  int width = 1100, height = 850;
};

struct CellOutput {
  CellShapesKept shapes = CellShapesKept::last;
  std::vector<CellPicture> pictures;  ///< none: one of the cell at rest, and one of the end of each path
};

struct CellCase : CellDesign {
  std::string name, description;
  std::vector<PathCase> paths;
  std::vector<BarCase> bars;
  CellOutput output;

  std::filesystem::path file;          ///< where it was read
  std::vector<std::string> overrides;  ///< "path=value" of the command line
};

/// Reads and checks a case file of this kind; as readCase of cases/wear/case/case.hpp. The cell is built once, so that
/// a run does not stumble over it.
CellCase readCellCase(const std::filesystem::path& file, const std::vector<std::string>& overrides = {});
/// The same from a file already read, with values put in their places.
CellCase readCellCase(const JsonNode& root, const std::filesystem::path& file);
/// The case of a finished run, as writeCase left it: nothing is built.
CellCase readRecordedCellCase(const std::filesystem::path& file);
/// The case written out in full as JSON; readCellCase gives the same case back.
std::string writeCase(const CellCase& c);
/// As caseIdentity of cases/wear/case/case.hpp.
std::string caseIdentity(const CellCase& c);
/// The case file: such a case names no others.
std::vector<std::filesystem::path> inputsOf(const CellCase& c);

}  // namespace gambeson
