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

std::string inWords(const ContactCase& c) {
  const std::string rest =
      " The layer is rigid; contacts of cloth with cloth, and what would pass through a surface within a step, are "
      "solved together, in turns with these.";
  switch (c.method) {
    case ContactMethod::together:
      return "";
    case ContactMethod::penalty:
      return fmt::format(
                 "Contacts with bodies are springs in the layer, {} Pa/m (Man 2006, box 3): cloth sinks into it and is "
                 "thrown "
                 "back; what sinks through it is stopped at the surface.",
                 formatNumber(c.penalty_Pa_per_m)) +
             rest;
    case ContactMethod::forward_increment:
      return "Contacts with bodies are multipliers that keep the end of each step out of them, without those that "
             "would "
             "pull (Man 2006, box 4), and friction under these." +
             rest;
    case ContactMethod::projection:
      return "Contacts with bodies put each vertex that would enter one onto its surface, along the gradient of the "
             "body's function (Man 2006, box 5); an ellipsoid's surface is that with semi-axes longer by the layer, so "
             "that between the ends of its axes the distance kept is somewhat less." +
             rest;
  }
  return "";
}

ContactParameters contactOf(const ContactCase& c, double g, std::span<const ObstacleCase> obstacles,
                            std::size_t bodies) {
  ContactParameters p{c.layer_m.value_or(0), c.friction,           c.relaxation_s, c.tolerance * (g > 0 ? g : 9.81),
                      c.max_iterations,      c.compliance_m_per_Pa};
  p.on_cloth = c.friction_cloth;
  p.method = c.method;
  p.penalty_Pa_per_m = c.penalty_Pa_per_m;
  p.newton = c.newton;
  p.of_obstacle.resize(bodies);
  for (const ObstacleCase& o : obstacles) p.of_obstacle.push_back(o.friction);
  return p;
}

}  // namespace gambeson
