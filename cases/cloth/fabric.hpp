#pragma once
/// What cloth is made of, as a case has it.

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <variant>

#include "core/material/fabric.hpp"

namespace gambeson {

struct CellFile;
struct LawFile;

/// What a fabric's law is of that is an energy at a point: a table (cases/cloth/law_table.hpp), or a cell of yarns that
/// is solved at every point (cases/yarns/cell_file.hpp).
struct EnergySource {
  std::filesystem::path file;  ///< empty: the case itself holds it
  std::variant<std::shared_ptr<const LawFile>, std::shared_ptr<const CellFile>> content;
  bool operator==(const EnergySource&) const = default;

  bool isCell() const { return content.index() == 1; }
  const LawFile& table() const { return *std::get<0>(content); }
  const CellFile& cell() const { return *std::get<1>(content); }
};

/// A fabric, and how far it may be stretched: what no force depends on, but the verdict.
struct FabricCase : Fabric {
  std::optional<double> limit_strain_weft, limit_strain_warp;  ///< Green-Lagrange strains; absent: those of the law
  std::filesystem::path card;                                  ///< that it is of (cases/cloth/card.hpp); empty: none
  std::optional<EnergySource> energy_source;                   ///< that `energy` is of
  std::array<bool, 2> limit_of_law{};  ///< of weft and warp: the limit is the law's range, which nobody stated
  bool thickness_assumed = false;      ///< nobody measured it: it is the weight over a usual density
  bool operator==(const FabricCase&) const = default;
};

/// Strain below which the source of the fabric's law takes it to be a straight line (Zheng 2013, eq. 2.13).
constexpr double kStrainOfLaw = 0.02;

/// By what share of its length it may be stretched: its own limit, the smaller of weft and warp, else that of its law.
inline double standsOf(const FabricCase& f) {
  const double E = std::min(f.limit_strain_weft.value_or(kStrainOfLaw), f.limit_strain_warp.value_or(kStrainOfLaw));
  return std::sqrt(1 + 2 * E) - 1;  // of Green-Lagrange: (1 + e)^2 = 1 + 2 E
}

}  // namespace gambeson
