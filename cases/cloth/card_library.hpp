#pragma once
/// The fabric cards that ship, compiled in: cases/library/cards.

#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace gambeson {

/// Names ("denim_a") and texts, by name.
std::span<const std::pair<std::string_view, std::string_view>> libraryCards();
/// Whether what names a card is a name of the library rather than a file: it has neither a folder nor an ending.
bool isLibraryName(std::string_view card);
/// The text of a card. Throws InputError (reason only, with the closest name) where there is none.
std::string_view libraryCard(std::string_view name);

}  // namespace gambeson
