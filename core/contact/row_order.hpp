#pragma once
/// The order in which a sweep takes the rows of an island. Internal to the solve.
///
/// Rows of one colour share no free point, so that lanes may take them side by side. In a large island the rows come in
/// patches, each of neighbours, with colours of its own: patches of one phase share no free point either, so that
/// threads, or groups of lanes with barriers of their own, take them side by side and meet only between the phases
/// (three or four in sheets), where colours of the whole island would let them meet up to a hundred times. The order
/// depends on nothing but the rows and their order.

#include "core/contact/response.hpp"

namespace gambeson {

constexpr int kColours = 256;       ///< that are told apart
constexpr int kWholeIsland = 1024;  ///< rows of an island up to which it is one patch

/// Sorts the rows of each island of work.order by phase, patch and colour: work.colour of the rows, work.chunks of the
/// patches, and the chunks of the islands. Only the rows' points, work.reach, are looked at.
void orderRows(int free_count, ContactWork& work);

}  // namespace gambeson
