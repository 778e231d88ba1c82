#pragma once
/// What holds the garments of a case: points and edges held, edges on springs.

#include <vector>

#include "cases/wear/case/case.hpp"
#include "cases/wear/case/supports/kind.hpp"
#include "core/cloth/cloth.hpp"
#include "core/motion/model.hpp"
#include "human/body/body.hpp"

namespace gambeson {

/// Adds held control points and springs to `options`, and a group for each support of the case. `first`: the first
/// patch of each garment in `cloth`; `known`: its named edges; `human` may be null. Throws InputError for an edge, a
/// patch or a link that is not there.
void addSupports(const Case& c, const Cloth& cloth, const std::vector<int>& first,
                 const std::vector<std::vector<NamedEdge>>& known, const Surface& surface, const Human* human,
                 ModelOptions& options, std::vector<SupportGroup>& groups);
/// Finds what the groups hold in the model that was built with those options.
void findHeldPoints(const Model& model, std::vector<SupportGroup>& groups);

}  // namespace gambeson
