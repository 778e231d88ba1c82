#pragma once
/// What a degenerated shell is made with (degenerated_shell.hpp).

#include "core/cloth/degenerated/shell_rule.hpp"

namespace gambeson {

/// Rotary inertia of a director over the mass that it has a part in.
enum class RotaryInertia {
  exact,  ///< t²/12 (Man 2006, eq. 2.82)
  cell    ///< the larger of t²/12 and a twelfth of the cell's area: shear through the thickness swings no faster than
          ///< the membrane does, and explicit steps are as long as without directors. Adds inertia to turns of a cell.
};

struct DegeneratedOptions {
  ShellRule rule = ShellRule::mitc4;
  double shear_factor = 5.0 / 6;  ///< of transverse shear, > 0
  RotaryInertia rotary = RotaryInertia::exact;
  bool operator==(const DegeneratedOptions&) const = default;
};

}  // namespace gambeson
