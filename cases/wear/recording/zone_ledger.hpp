#pragma once
/// What each part of the body gets from each garment in a window: sums of magnitudes over steps and contacts, which
/// opposite pressures do not cancel, and the sum of the vectors, in which they do.

#include <optional>

#include "cases/wear/scene/scenario.hpp"
#include "core/contact/response.hpp"
#include "human/body/body_zones.hpp"

namespace gambeson {

/// Names of which each is there once: one that an earlier one has already gets its number, "waist 2".
std::vector<std::string> toldApart(std::vector<std::string> names);

/// The zones of the human's body, then the case's obstacles.
std::vector<std::string> zoneNames(const Scenario& scenario);

class ZoneLedger {
 public:
  explicit ZoneLedger(const Scenario& scenario);

  /// What stands before the parts of a column's name: for each group and, in it, each zone.
  static std::vector<std::string> names(const Scenario& scenario);
  /// Sum of |J|, of its normal part, of its tangential magnitude; then of J itself, on the body, in world axes.
  static constexpr int kParts = 6;
  /// Columns of the table "body_zones" after start_s and end_s: for each group of the scenario and each zone
  /// "<garment>[ in the belt's press| on springs] on <zone>" _Ns, _n_Ns, _t_Ns, _Jx_Ns, _Jy_Ns, _Jz_Ns.
  static std::vector<std::string> columns(const Scenario& scenario);

  /// `X_WB`: the frames of the scenario's bodies when the contact acted.
  void add(const ContactImpulse& contact, std::span<const Pose> X_WB);
  const std::vector<double>& row() const { return sums_; }
  void clear();

 private:
  void give(int group, int zone, double share, const ContactImpulse& contact);

  const Scenario& scenario_;
  std::optional<BodyZones> zones_;
  std::vector<int> skin_;  ///< zone of each vertex
  int count_ = 0;          ///< of zones
  std::vector<double> sums_;
};

/// "thigh_right" is the right thigh.
std::string spokenZone(std::string zone);

/// How the page and the columns call a group.
std::string groupName(const ContactGroup& group);

}  // namespace gambeson
