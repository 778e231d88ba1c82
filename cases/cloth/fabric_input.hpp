#pragma once
/// A fabric as a case file writes it: with the shorthand for isotropic cloth and with either density.

#include <memory>
#include <optional>
#include <string>

#include "cases/cloth/fabric.hpp"
#include "cases/cloth/loop_input.hpp"
#include "cases/input/schema.hpp"

namespace gambeson::schema {

enum class RestCurvature { zero, shape };

struct BendingInput {
  std::string law = "zheng";  ///< one of the rows in fabric_input.cpp
  std::optional<double> rigidity_Nm, rigidity_weft_Nm, rigidity_warp_Nm;
  std::optional<double> kappa0_per_m;
  std::optional<double> regular_curvature_per_m;
  static constexpr double default_regular_curvature_per_m = 1;
  std::optional<double> yield_N;
  std::optional<LoopInput> loop;
  double twist_Nm = 0;
  RestCurvature rest = RestCurvature::zero;
};

/// Friction in shear, as KES-FB1 reads it or by its numbers.
struct ShearLoopInput {
  std::optional<double> hysteresis_N_per_m, hysteresis_5_N_per_m, rise_N_per_m;
  double growth_N_per_m = 0;
  double friction_angle_rad = 0.0174532925199432958;
};

/// A law that is a table, a cell of yarns, or curves.
struct LawInput {
  std::filesystem::path table, cell;
  std::shared_ptr<const LawFile> values, curves;
  std::shared_ptr<const CellFile> yarns;
  RestCurvature rest = RestCurvature::zero;
};

struct FabricInput {
  std::filesystem::path card;
  std::string name;
  double thickness_m = 0;
  bool thickness_assumed = false;
  std::optional<double> density_kg_per_m3, surface_density_kg_per_m2;
  std::optional<double> young_Pa, young_weft_Pa, young_warp_Pa, shear_Pa;
  /// In their place, times the thickness: of sheets that have none. Only read; moduli are written.
  std::optional<double> stiffness_N_per_m, stiffness_weft_N_per_m, stiffness_warp_N_per_m, shear_stiffness_N_per_m;
  double poisson = 0;
  double jam_area = 0.7;
  std::optional<double> limit_strain, limit_strain_weft, limit_strain_warp;
  std::optional<ShearLoopInput> shear_loop;
  BendingInput bending;
  std::optional<LawInput> law;
};

/// The fabric that the input says, and where it names a card the card, with what else the entry gives in its place.
/// `entry` is the fabric's in the file, for the rules between fields; of a finished run it says all itself.
FabricCase resolveFabric(const Entry& entry, const FabricInput& in);
/// What case files call the law; empty: a solid.
std::string bendingName(const BendingLaw& law);
/// How a fabric of a case file bends, for the report.
std::string bendingInWords(const BendingLaw& law);
/// What a law is that is a table, a cell or curves, for the report.
std::string lawInWords(const EnergySource& source);
/// The input, written out in full, that resolves to the fabric.
FabricInput restoreFabric(const FabricCase& fabric);

}  // namespace gambeson::schema
