#include "cases/contact/contact.hpp"

namespace gambeson {

ContactParameters contactOf(const ContactCase& c, double g) {
  return {c.layer_m.value_or(0), c.friction,           c.relaxation_s, c.tolerance * (g > 0 ? g : 9.81),
          c.max_iterations,      c.compliance_m_per_Pa};
}

}  // namespace gambeson
