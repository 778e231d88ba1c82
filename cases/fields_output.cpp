#include <fmt/format.h>

#include <cmath>

#include "cases/case.hpp"
#include "cases/fields.hpp"
#include "cases/table.hpp"

namespace gambeson::schema {
namespace {

bool isMultiple(double a, double of) { return a >= of * (1 - 1e-9) && std::abs(a / of - std::round(a / of)) < 1e-6; }

}  // namespace

Object pictureTable() {
  using P = PictureCase;
  Field time;
  time.key = "time";
  time.kind = Kind::number;
  time.unit = "s";
  time.range = between(0, 3600);
  time.choices = {"peak", "end"};
  time.doc =
      "when: a time of the motion; peak: at the largest joint torque (contact force where there is no joint); end: the "
      "last frame";
  std::vector<std::pair<std::string, View>> views;
  for (const std::string& name : viewNames()) views.emplace_back(name, *viewByName(name));
  return Table<P>("Picture")
      .custom(
          time,
          [time](const Place& p, P& picture) {
            const bool word = p.node.type == JsonNode::Type::text && !p.node.text.empty() &&
                              std::isalpha(static_cast<unsigned char>(p.node.text[0]));
            picture.when =
                word ? (readChoice(p, time.choices) == 0 ? PictureTime::peak : PictureTime::end) : PictureTime::at;
            picture.time_s = word ? 0 : readNumber(p, time.unit, time.range);
          },
          [](const P& picture) {
            return std::optional(picture.when == PictureTime::at     ? nodeOf(picture.time_s)
                                 : picture.when == PictureTime::peak ? nodeOf(std::string("peak"))
                                                                     : nodeOf(std::string("end")));
          })
      .choice("field", &P::field,
              std::vector<std::pair<std::string, PictureField>>{{"stress", PictureField::stress},
                                                                {"pressure", PictureField::pressure},
                                                                {"strain", PictureField::strain},
                                                                {"thickness", PictureField::thickness},
                                                                {"body_pressure", PictureField::body_pressure},
                                                                {"plain", PictureField::plain}},
              "what the colours show: first principal stress resultant, contact pressure (over the cloth's "
              "area as stretched), first principal strain, thickness at rest; on "
              "the bare body the largest pressure of the motion; or nothing")
      .choice("view", &P::view, views, "where the picture is taken from")
      .integer("width", &P::width, 64, 8192, "pixels")
      .integer("height", &P::height, 64, 8192, "pixels")
      .build();
}

Object outputTable() {
  using O = OutputCase;
  return Table<O>("Output")
      .number("window", &O::window_s, "s", between(1e-5, 0.01), "forces are impulses over this time, unfiltered")
      .number("frame", &O::frame_s, "s", between(1e-5, 10), "time between recorded frames; a multiple of window")
      .number("checkpoint", &O::checkpoint_s, "s", between(1e-5, 100),
              "time between points from which an interrupted run resumes; a multiple of frame")
      .list("pictures", &O::pictures, pictureTable(), "pictures to take")
      .check([](const Place& p, const O& o) {
        if (!isMultiple(o.frame_s, o.window_s))
          p.failAt("frame",
                   fmt::format("{} s is not a multiple of window = {} s; allowed: a multiple", o.frame_s, o.window_s));
        if (!isMultiple(o.checkpoint_s, o.frame_s))
          p.failAt("checkpoint", fmt::format("{} s is not a multiple of frame = {} s; allowed: a multiple",
                                             o.checkpoint_s, o.frame_s));
      })
      .build();
}

}  // namespace gambeson::schema
