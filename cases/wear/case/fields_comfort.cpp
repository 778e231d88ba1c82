/// Detail of fields.hpp: the table of what a wearer accepts.

#include "cases/input/table.hpp"
#include "cases/wear/case/case.hpp"
#include "cases/wear/case/fields.hpp"

namespace gambeson::schema {
namespace {

/// The keys of a comfort limit, with the defaults of one part of the body.
Object limitTable(const ComfortLimit& defaults) {
  using L = ComfortLimit;
  const Range range = aboveTo(0, 1e6);
  Object table = Table<L>("Comfort limit")
                     .number("amber", &L::amber_Pa, "Pa", range,
                             "comfortable up to here, in the mean over time at the place that bears most")
                     .number("red", &L::red_Pa, "Pa", range, "from here on it is not worn for long; at least amber")
                     .number("peak", &L::peak_Pa, "Pa", range, "and not at any time above this; at least red")
                     .check([](const Entry& p, const L& l) {
                       if (!(l.red_Pa >= l.amber_Pa)) p.failAt("red", "lies below amber; allowed: at least amber");
                       if (!(l.peak_Pa >= l.red_Pa)) p.failAt("peak", "lies below red; allowed: at least red");
                     })
                     .build();
  for (Field& f : table.fields) f.default_value = f.write(&defaults);
  return table;
}

}  // namespace

Object comfortTable() {
  using C = ComfortCase;
  const C defaults;
  const Object limit = limitTable(defaults.other);
  return Table<C>("Comfort")
      .object("shoulder", &C::shoulder, limitTable(defaults.shoulder),
              "limits of pressure on the shoulders. The defaults (7, 14, 20 kPa) take 14 kPa as where a strap "
              "irritates the skin (Holewijn 1990) and 20 kPa as a limit of straps (Stevenson and Bryant 2004)")
      .object("chest", &C::chest, limit,
              "on the chest. The defaults for chest, hips, thighs, arms and other parts (2, 4.27, 9.81 kPa) are what "
              "is comfortable and what hurts in garments (20 and 100 gf/cm^2, Denton 1972), and what closes "
              "capillaries (32 mmHg, Landis 1930)")
      .object("waist", &C::waist, limitTable(defaults.waist),
              "on the waist. The defaults (2, 4.67, 9.81 kPa) take 35 mmHg as where waistbands are called "
              "uncomfortable (Sen'i Gakkaishi 47(6):282, 1991)")
      .object("hips", &C::hips, limit, "on the hips")
      .object("thigh", &C::thigh, limit, "on the thighs")
      .object("arm", &C::arm, limit, "on upper arms and forearms")
      .object("other", &C::other, limit, "on all other parts")
      .number("wear", &C::wear_s, "s", aboveTo(0, 1e6), "time over which the dose is taken, as if the motion went on")
      .number("sensor", &C::sensor_m, "m", aboveTo(0, 0.3),
              "width over which pressure is averaged, as a sensor between body and garment does")
      .number("effort_amber", &C::effort_amber, "", aboveTo(0, 10),
              "added torque that is easily borne, as a part of the task's natural moment")
      .number("effort_red", &C::effort_red, "", aboveTo(0, 10), "and that from which it hinders; at least effort_amber")
      .check([](const Entry& p, const C& c) {
        if (!(c.effort_red >= c.effort_amber))
          p.failAt("effort_red", "lies below effort_amber; allowed: at least effort_amber");
      })
      .build();
}

}  // namespace gambeson::schema
