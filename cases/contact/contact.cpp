#include "cases/contact/contact.hpp"

#include <fmt/format.h>

#include "analysis/ticks.hpp"

namespace gambeson {

std::string inWords(const FrictionLaw& law) {
  if (law.isCoulomb())
    return fmt::format("Coulomb friction {}, the same for sticking and sliding", formatNumber(law.kinetic));
  std::string text = fmt::format("friction {} where it sticks and {} where it slips", formatNumber(law.still),
                                 formatNumber(law.kinetic));
  if (law.stribeck_m_per_s > 0 && law.still > law.kinetic)
    text += fmt::format(" much faster than {} m/s (power {})", formatNumber(law.stribeck_m_per_s),
                        formatNumber(law.stribeck_power));
  if (law.viscosity > 0)
    text +=
        fmt::format(", beside {} Pa at 1 m/s (power {})", formatNumber(law.viscosity), formatNumber(law.viscous_power));
  if (law.goesWithPressure())
    text += fmt::format(", times (p / {} Pa)^{}", formatNumber(law.pressure_Pa), formatNumber(law.pressure_power - 1));
  if (law.goesWithDirection()) text += fmt::format(", times {} along the warp", formatNumber(law.along_warp));
  return text;
}

ContactParameters contactOf(const ContactCase& c, double g, std::span<const ObstacleCase> obstacles,
                            std::size_t bodies) {
  ContactParameters p{c.layer_m.value_or(0), c.friction,           c.relaxation_s, c.tolerance * (g > 0 ? g : 9.81),
                      c.max_iterations,      c.compliance_m_per_Pa};
  p.on_cloth = c.friction_cloth;
  p.of_obstacle.resize(bodies);
  for (const ObstacleCase& o : obstacles) p.of_obstacle.push_back(o.friction);
  return p;
}

}  // namespace gambeson
