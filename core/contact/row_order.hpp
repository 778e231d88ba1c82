#pragma once
/// The order in which a sweep takes the rows of an island. Internal to the solve.
///
/// Rows of one colour share no free point, so that lanes may take them side by side. In a large island the rows come in
/// chunks, each of neighbours, with colours of its own: chunks of one phase share no free point either, so that
/// threads, or groups of lanes with barriers of their own, take them side by side and meet only between the phases
/// (four as a rule, in sheets and in stacks of them), where colours of the whole island would let them meet up to a
/// hundred times. The order depends on nothing but the rows and their order.

#include <span>

#include "core/contact/response.hpp"

namespace gambeson {

constexpr int kColours = 256;       ///< that are told apart, as phases are
constexpr int kWholeIsland = 1024;  ///< rows of an island, or of a part of one, up to which it is one chunk

/// Sorts the rows of each island of work.order by phase, chunk and colour: work.colour of the rows, work.chunks, and
/// the chunks of the islands. Of the rows only the sample that they begin with and their points, work.reach, are looked
/// at.
///
/// A large island is halved as the places of these samples are (halving.hpp), until each part is a chunk. A chunk has
/// the first phase that no chunk before it in this order has which shares a point with it.
void orderRows(std::span<const ContactRow> rows, std::span<const int> place, int free_count, ContactWork& work);

}  // namespace gambeson
