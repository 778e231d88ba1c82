#pragma once
/// What cloth is made of, as a case has it.

#include <filesystem>
#include <memory>
#include <optional>

#include "core/material/fabric.hpp"

namespace gambeson {

struct LawFile;

/// The table that a fabric's law is (cases/cloth/law_table.hpp).
struct FabricTable {
  std::filesystem::path file;  ///< empty: the case itself holds it
  std::shared_ptr<const LawFile> content;
  bool operator==(const FabricTable&) const = default;
};

/// A fabric, and how far it may be stretched: what no force depends on, but the verdict.
struct FabricCase : Fabric {
  std::optional<double> limit_strain_weft, limit_strain_warp;  ///< Green-Lagrange strains; absent: those of the law
  std::filesystem::path card;  ///< that it is of (cases/cloth/card.hpp); empty: none
  std::optional<FabricTable> table;  ///< that `energy` is of
  bool operator==(const FabricCase&) const = default;
};

/// Strain below which the source of the fabric's law takes it to be a straight line (Zheng 2013, eq. 2.13).
constexpr double kStrainOfLaw = 0.02;

}  // namespace gambeson
