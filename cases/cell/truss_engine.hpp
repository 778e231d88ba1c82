#pragma once
/// Yarns as Kawabata's truss: core/yarn/kawabata.hpp.

#include "cases/cell/engine.hpp"
#include "core/yarn/kawabata.hpp"

namespace gambeson {

class TrussEngine : public CellEngine {
 public:
  /// Throws InputError as checkKawabata and checkWovenYarns.
  TrussEngine(const KawabataCloth& cloth, const WovenYarns& yarns);

  std::unique_ptr<CellSpecimen> specimen() const override;
  const YarnSurface& surface() const override { return surface_; }
  std::vector<std::string> assumptions() const override;

 private:
  KawabataCloth cloth_;
  WovenYarns yarns_;
  YarnSurface surface_;
};

/// What yarns and crossings of a state store, by area of the cloth at rest [J/m²]: of each crossing
///   EA L (lambda_y - 1)²/2 of both yarns that are not slack, L the length of the yarn in one spacing at rest, and the
///   integral of F from the distance of the middles to that at which they touch.
/// Its derivatives in lambda_1 and lambda_2 are the forces f of the state (Man 2006, eq. 4.9).
double energyOf(const KawabataCloth& cloth, const KawabataState& state);

}  // namespace gambeson
