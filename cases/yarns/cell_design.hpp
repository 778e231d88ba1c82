#pragma once
/// What a cell of a woven cloth is made of, as its case says it: its yarns, and how they are computed. Cases of the
/// kind cell and fabrics whose law is such a cell have it. What each field means: cases/FIELDS.md, kind cell.

#include <optional>
#include <variant>
#include <vector>

#include "core/solid/contact_path.hpp"
#include "core/yarn/compression.hpp"
#include "core/yarn/rod.hpp"
#include "core/yarn/solid_yarns.hpp"
#include "core/yarn/woven_yarns.hpp"

namespace gambeson {

/// What the yarns are computed as.
enum class YarnModel { rod, solid, truss };

enum class WeavePattern { plain, twill, satin, matrix };
struct WeaveCase {
  WeavePattern pattern = WeavePattern::plain;
  std::optional<int> over, under;        ///< of a twill
  std::optional<int> ends, step;         ///< of a satin
  std::vector<std::vector<int>> matrix;  ///< rows of 0 and 1, as weaveOf takes them
};

/// Of a yarn whose fibres run along it.
struct YarnModuli {
  double young_Pa = 0;  ///< along the yarn
  double shear_Pa = 0;  ///< axial: of fibres along each other
  // Of solids:
  std::optional<double> transverse_young_Pa{};
  std::optional<double> poisson_axial{}, poisson_transverse{};  ///< the latter absent: as the former
};
/// Of a yarn that is the same in all directions.
struct IsotropicYarn {
  double young_Pa = 0, poisson = 0;
};

struct YarnCase {
  WovenYarn shape;
  std::variant<YarnModuli, IsotropicYarn, RodSection> stiffness;
};

/// Coulomb's law between yarns that touch.
struct YarnFriction {
  double coefficient = 0;  ///< mu
  /// Of rods: tangential force by slip, by the lengths of both.
  std::optional<double> stick_stiffness_N_per_m3{};
};

struct CellSolver {
  int pieces_per_spacing = 16;
  double tolerance = 1e-9;
  int iterations = 200, halvings = 8;
};

/// How solid yarns are cut into hexahedra, and how what touches is found.
struct SolidsCase {
  YarnMeshing mesh;
  SolidContactMethod method = SolidContactMethod::augmented;
  FrictionBound bound = FrictionBound::symmetrised;
  double penalty = 50;
  int iterations = 30, passes = 40;
  double change = 1e-3, deepest = 1e-2;
};

struct CellDesign {
  WeaveCase weave;
  YarnCase weft;
  std::optional<YarnCase> warp;  ///< read: always
  YarnModel yarns = YarnModel::rod;
  bool contact = true;
  std::optional<LateralCompression> compression;
  bool by_section = false;               ///< rods press over the ellipses of their sections, side by side too
  std::optional<YarnFriction> friction;  ///< none: yarns slide freely
  bool quarter = false;                  ///< of a plain weave, a quarter of the repeat moves by itself
  bool holds_faces = false;              ///< sections in the faces of the cell stay in the middle of the cloth
  std::optional<double> height_m;        ///< of the cell, by which stress is counted; read: always
  CellSolver solver;
  std::optional<SolidsCase> solids;  ///< of yarns that are solids; read: always there

  const YarnCase& yarn(int direction) const { return direction == along_weft ? weft : *warp; }
};

}  // namespace gambeson
