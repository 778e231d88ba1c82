#pragma once
/// Models and structures of NURBS cloth, for tests.

#include <memory>
#include <utility>
#include <vector>

#include "core/cloth/shell/nurbs_shell.hpp"
#include "core/cloth/patches/patch_loads.hpp"
#include "core/cloth/patches/patch_supports.hpp"
#include "core/cloth/patches/strain_points.hpp"
#include "core/motion/model.hpp"
#include "core/statics/structure.hpp"

namespace gambeson {

inline std::unique_ptr<Model> buildModel(const Garment& garment, const ModelOptions& options, const Environment& e,
                                         const ContactParameters& contact, std::vector<Obstacle> obstacles,
                                         const ShellOptions& shell = {}) {
  return buildModel(std::make_unique<NurbsShell>(garment, shell), options, e, contact, std::move(obstacles));
}

inline std::unique_ptr<Structure> buildStructure(const Garment& garment, const StructureOptions& options,
                                                 const ShellOptions& shell = {}) {
  return buildStructure(std::make_unique<NurbsShell>(garment, shell), options);
}

inline Loads loadsOf(const Garment& garment, std::vector<DeadLoad> dead, const std::vector<PressureLoad>& pressure,
                     const std::vector<EdgeMoment>& moments) {
  const NurbsShell shell(garment);
  return {shell.mounting(), shell.points(), std::move(dead), pressure, moments};
}

/// What a model's or a structure's cloth is, where it is NURBS.
inline const NurbsShell& shellOf(const Cloth& cloth) { return dynamic_cast<const NurbsShell&>(cloth); }
template <class ModelOrStructure>
const NurbsShell& shellOf(const ModelOrStructure& m) {
  return shellOf(*m.cloth);
}

}  // namespace gambeson
