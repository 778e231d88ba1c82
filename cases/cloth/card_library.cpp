#include "cases/cloth/card_library.hpp"

#include <fmt/format.h>

#include <vector>

#include "cases/input/schema.hpp"
#include "core/error.hpp"

namespace gambeson {

bool isLibraryName(std::string_view card) {
  return !card.empty() && card.find_first_of("./\\") == std::string_view::npos;
}

std::string_view libraryCard(std::string_view name) {
  std::vector<std::string> names;
  for (const auto& [known, text] : libraryCards()) {
    if (known == name) return text;
    names.emplace_back(known);
  }
  const std::string close = schema::closest(name, names);
  throw InputError({"", 0, ""},
                   fmt::format("\"{}\" is no card of the library{}; allowed: the path of a card's file, or one of {}",
                               name, close.empty() ? "" : ", did you mean \"" + close + "\"?", schema::joined(names)));
}

}  // namespace gambeson
