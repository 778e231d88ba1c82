#pragma once
/// How yarns cross: the repeat of a weave, and whether it holds together.

#include <vector>

namespace gambeson {

/// One repeat of a weave. Warp yarns run along axis 2 and are counted along axis 1, weft yarns the other way.
struct Weave {
  int warps = 0, wefts = 0;
  std::vector<char> warp_over;  ///< 1 where the warp yarn lies over the weft yarn; weft by weft, `warps` of each

  /// Of any yarns of the cloth, not only of the first repeat.
  bool warpOver(int warp, int weft) const;
};

/// 2 x 2 (Man 2006, fig. 18a).
Weave plainWeave();
/// Whether yarns change sides at every crossing, in both directions.
bool isPlain(const Weave& weave);
/// Each warp yarn goes over `over` weft yarns and under `under`, each weft yarn shifted by one (fig. 18b is 2/2).
/// Throws InputError, key "weave.over" or "weave.under", where one is below 1.
Weave twillWeave(int over, int under);
/// Warp-faced: each warp yarn goes under one weft yarn of `ends`, each weft yarn shifted by `step` (fig. 18c).
/// Throws InputError, key "weave.ends" where there are fewer than 5, key "weave.step" where the step is not between 2
/// and ends - 2 or has a factor in common with the ends.
Weave satinWeave(int ends, int step);
/// Rows of 0 and 1, one for each weft yarn: 1 where the warp yarn lies over it. Throws InputError, key "weave.matrix",
/// where rows are empty, differ in length or have other numbers, and as checkWeave.
Weave weaveOf(const std::vector<std::vector<int>>& rows);

/// Whether the weave is its own image in a mirror across its warp yarns: sheared to the left and to the right it does the
/// same. (A twill's lines go to the other side.)
bool isMirrorSymmetric(const Weave& weave);
/// Whether both of its faces look the same, one behind the other: bent up and down it does the same. (A satin's do not.)
bool hasEqualFaces(const Weave& weave);

/// Throws InputError, key "weave.matrix", where the cloth falls apart: where some yarns lie over all others that they
/// cross and can be lifted off. It holds together exactly where from each yarn there is a way to every other that goes
/// from a yarn to one that lies over it (Enns 1984, Geometriae Dedicata 15, 259).
void checkWeave(const Weave& weave);

}  // namespace gambeson
