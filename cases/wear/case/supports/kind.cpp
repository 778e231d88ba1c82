#include "cases/wear/case/supports/kind.hpp"

#include <array>
#include <type_traits>
#include <variant>

namespace gambeson {

extern const SupportKind fixed_support, springs_support, pinned_support, patch_support, cord_support;

std::span<const SupportKind* const> supportKinds() {
  static constexpr std::array kinds{&fixed_support, &springs_support, &pinned_support, &patch_support, &cord_support};
  static_assert(kinds.size() == std::variant_size_v<SupportCase>);
  return kinds;
}

const SupportKind& kindOf(const SupportCase& s) { return *supportKinds()[s.index()]; }

const EdgeCase& edgeOf(const SupportCase& s) {
  return std::visit([](const auto& kind) -> const EdgeCase& { return kind.edge; }, s);
}

const HeldSupport* heldOf(const SupportCase& s) {
  return std::visit(
      [](const auto& kind) -> const HeldSupport* {
        if constexpr (std::is_base_of_v<HeldSupport, std::remove_cvref_t<decltype(kind)>>) return &kind;
        return nullptr;
      },
      s);
}

}  // namespace gambeson
