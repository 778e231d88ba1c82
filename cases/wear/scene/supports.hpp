#pragma once
/// What holds the garments of a case: points and edges held, edges on springs.

#include <span>
#include <vector>

#include "cases/wear/case/case.hpp"
#include "cases/wear/case/supports/kind.hpp"
#include "core/cloth/cloth.hpp"
#include "core/motion/model.hpp"
#include "human/body/body.hpp"

namespace gambeson {

/// Adds held control points and springs to `options`, and a group for each support of the case. `first`: the first
/// patch of each garment in `cloth`; `known`: its named edges; `human` may be null. Adds to `drives` what moves what
/// they hold. Throws InputError for an edge, a patch or a link that is not there.
void addSupports(const Case& c, const Cloth& cloth, const std::vector<int>& first,
                 const std::vector<std::vector<NamedEdge>>& known, const Surface& surface, const Human* human,
                 ModelOptions& options, std::vector<SupportGroup>& groups, std::vector<Drive>& drives);
/// Finds what the groups hold in the model that was built with those options.
void findHeldPoints(const Model& model, std::vector<SupportGroup>& groups);

/// Supports that let go after from_s, up to to_s.
std::vector<std::size_t> lettingGo(const Case& c, double from_s, double to_s);
/// Lets go of what they hold.
void letGo(std::span<const std::size_t> supports, Model& model, std::vector<SupportGroup>& groups);

/// Draws the cords as tight as they are at a time. Whether any changed; then a state needs evaluateForces (step.hpp).
bool drawCords(const Case& c, double time_s, const std::vector<SupportGroup>& groups, Model& model);

}  // namespace gambeson
