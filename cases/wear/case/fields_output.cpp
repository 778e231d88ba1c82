/// Detail of fields.hpp: the table of what is written and pictured.

#include <fmt/format.h>

#include <cmath>

#include "cases/input/table.hpp"
#include "cases/input/typed.hpp"
#include "cases/runs/picture.hpp"
#include "cases/wear/case/case.hpp"
#include "cases/wear/case/fields.hpp"

namespace gambeson::schema {
namespace {

bool isMultiple(double a, double of) { return a >= of * (1 - 1e-9) && std::abs(a / of - std::round(a / of)) < 1e-6; }

}  // namespace

Object outputTable() {
  using O = OutputCase;
  return Table<O>("Output")
      .number("window", &O::window_s, "s", between(1e-5, 0.01), "forces are impulses over this time, unfiltered")
      .number("frame", &O::frame_s, "s", between(1e-5, 10), "time between recorded frames; a multiple of window")
      .number("checkpoint", &O::checkpoint_s, "s", between(1e-5, 100),
              "time between points from which an interrupted run resumes; a multiple of frame")
      .list("pictures", &O::pictures, pictureTable(), "pictures to take; [] for none")
      .defaultsTo("one of what is worn, and of a motion a film of it (film.mp4)")
      .flag("viewer", &O::viewer,
            "the page has a view to look around in: the motion in three dimensions (some 5 to 30 MB)")
      .unwritten()
      .check([](const Entry& p, const O& o) {
        const auto typed = [&](const char* key, double s) { return inUnitOf(p, key, s, "s"); };
        if (!isMultiple(o.frame_s, o.window_s))
          p.failAt("frame", fmt::format("{} is not a multiple of window = {}; allowed: a multiple",
                                        typed("frame", o.frame_s), typed("frame", o.window_s)));
        if (!isMultiple(o.checkpoint_s, o.frame_s))
          p.failAt("checkpoint", fmt::format("{} is not a multiple of frame = {}; allowed: a multiple",
                                             typed("checkpoint", o.checkpoint_s), typed("checkpoint", o.frame_s)));
      })
      .build();
}

}  // namespace gambeson::schema
