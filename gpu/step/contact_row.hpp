#pragma once
/// A row of a device as core has it.

#include "core/contact/response.hpp"
#include "gpu/step/step_rows.hpp"

namespace gambeson::gpu {

inline ContactRow contactRow(const ContactFacts& f, const ContactStencil& s, const BodyTouch& touch,
                             const RowTerms& t) {
  ContactRow row;
  row.contact.sample = f.sample;
  row.contact.obstacle = f.obstacle;
  row.contact.feature = f.feature;
  row.contact.kind = static_cast<ContactKind>(f.kind);
  row.contact.normal = f.normal;
  row.contact.gap_m = f.gap_m;
  row.contact.local = touch.local;
  for (int k = 0; k < 3; ++k)
    if (touch.vertex[k] >= 0) row.contact.touched.add(touch.vertex[k], touch.weight[k]);
  row.contact.clearance_m = f.clearance_m;
  for (int k = 0; k < s.count; ++k) row.stencil.add(s.sample[k], s.weight[k]);
  row.body_velocity = f.body_velocity;
  row.target_m_per_s = t.target_m_per_s;
  row.impact = t.impact != 0;
  row.compliance = t.compliance;
  row.mean_Pa = t.mean_Pa;
  row.partner = f.partner;
  row.pair = {t.pair[0], t.pair[1], t.pair[2]};
  return row;
}

}  // namespace gambeson::gpu
