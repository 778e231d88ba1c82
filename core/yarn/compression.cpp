#include "core/yarn/compression.hpp"

#include <fmt/format.h>

#include "core/error.hpp"

namespace gambeson {

void checkCompression(const LateralCompression& law) {
  if (!(law.half_force_N > 0 && std::isfinite(law.half_force_N)))
    throw InputError({"", 0, "compression.half_force"}, fmt::format("{:.6g} N, must be > 0", law.half_force_N));
  if (!(law.exponent >= 2 && law.exponent <= 6))
    throw InputError({"", 0, "compression.exponent"}, fmt::format("{:.6g}, must be 2 to 6", law.exponent));
}

}  // namespace gambeson
