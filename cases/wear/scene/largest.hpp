#pragma once
/// What a wearer's drafts can be where they cannot be what a case asks for.

#include <functional>
#include <string>

#include "cases/wear/case/case.hpp"
#include "core/error.hpp"

namespace gambeson {

/// Throws e again, whose key is of a drafted garment's own ("inseam_m"). Where that is a number of the garment's table,
/// the reason gets the largest value below it that `draft` makes something of, or where none does the smallest above
/// it, and for whom: "...; allowed: at most 30 cm on female_p5". Found by search: 24 values between the number and the
/// end of its range, then halves, to a thousandth of that way. `draft` throws InputError for what it cannot make. Where
/// it makes nothing of any value, e as it is.
[[noreturn]] void sayLargest(const InputError& e, const GarmentCase& worn, const std::string& wearer,
                             const std::function<void(const GarmentCase&)>& draft);

/// Of a length of a garment's table (its key in a case), the largest value below that of `worn` of which `holds` is
/// true, to a twentieth, rounded down as people write it ("36 mm"); empty where it holds of none down to a third, or
/// nothing can be drafted there.
std::string largestOf(const GarmentCase& worn, const std::string& key,
                      const std::function<bool(const GarmentCase&)>& holds);

}  // namespace gambeson
