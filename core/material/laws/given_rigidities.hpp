#pragma once
/// What bending laws of cloth have in common: rigidities of their own, which no membrane and no thickness determines.

#include <algorithm>
#include <array>
#include <functional>
#include <string>

#include "core/material/section.hpp"

namespace gambeson {

/// Refuses a parameter: its name, and why. Does not return.
using Refusal = std::function<void(const std::string& key, const std::string& reason)>;

/// (1 - w) a + w b.
inline double mix(double a, double b, double w) { return (1 - w) * a + w * b; }

/// Rigidities along weft, along warp and of twist [N m]: m_11, m_22 of k11, k22, and m_12 = twist * 2 k12 (G h^3/12 for
/// a homogeneous plate; the thesis has none). The first two are the law's least slopes. Valid for >= 0. A law derives
/// from it.
struct GivenRigidities {
  static constexpr bool is_solid = false;
  double weft_Nm = 0, warp_Nm = 0, twist_Nm = 0;

  bool operator==(const GivenRigidities&) const = default;
  /// With the membrane's stiffness: no coupling.
  Section section(const Voigt& A, double /*thickness_m*/) const { return {A, {}, {weft_Nm, warp_Nm, twist_Nm}}; }
  void check(const Refusal& refuse) const {
    if (!(weft_Nm >= 0)) refuse("bending_weft_Nm", "must be >= 0");
    if (!(warp_Nm >= 0)) refuse("bending_warp_Nm", "must be >= 0");
    if (!(twist_Nm >= 0)) refuse("twist_Nm", "must be >= 0");
  }
  /// All rigidities times a factor.
  void stiffen(double factor) {
    weft_Nm *= factor;
    warp_Nm *= factor;
    twist_Nm *= factor;
  }
  /// Of cloth thicker by a factor: the cube, as of a homogeneous or bonded sheet.
  void thicken(double factor) { stiffen(factor * factor * factor); }
  double least_Nm() const { return std::min(weft_Nm, warp_Nm); }
  double most_Nm() const { return std::max({weft_Nm, warp_Nm, twist_Nm}); }
  static GivenRigidities mixed(const GivenRigidities& a, const GivenRigidities& b, double w) {
    return {mix(a.weft_Nm, b.weft_Nm, w), mix(a.warp_Nm, b.warp_Nm, w), mix(a.twist_Nm, b.twist_Nm, w)};
  }
};

}  // namespace gambeson
