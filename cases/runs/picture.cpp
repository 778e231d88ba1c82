#include "cases/runs/picture.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "cases/input/table.hpp"

namespace gambeson {

PictureSize sizeOf(const PictureCase& picture, PictureSize usual) {
  const auto other = [](int named, int side, int of) {
    return std::max(1, static_cast<int>(std::lround(static_cast<double>(named) * side / of)));
  };
  if (picture.width) return {*picture.width, picture.height.value_or(other(*picture.width, usual.height, usual.width))};
  if (picture.height) return {other(*picture.height, usual.width, usual.height), *picture.height};
  return usual;
}

}  // namespace gambeson

namespace gambeson::schema {

Object pictureTable() {
  using P = PictureCase;
  Field time = fieldOf("time", Kind::number, "s", between(0, 3600),
                       "when: a time of the motion; peak: at the largest joint torque (contact force where there is no "
                       "joint); end: the last frame");
  time.choices = {"peak", "end"};
  std::vector<std::pair<std::string, View>> views;
  for (const std::string& name : viewNames()) views.emplace_back(name, *viewByName(name));
  return Table<P>("Picture")
      .custom(
          time,
          [time](const Entry& p, P& picture) {
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
                                                                {"set", PictureField::set},
                                                                {"friction", PictureField::friction},
                                                                {"plain", PictureField::plain}},
              "what the colours show: first principal stress resultant, contact pressure (over the cloth's "
              "area as stretched), first principal strain, thickness at rest; on "
              "the bare body the largest pressure of the motion; of cloth whose bending has the law hysteresis, the "
              "curvature that is set in it, or how much of its friction fatigue has left; or nothing")
      .choice("view", &P::view, views, "where the picture is taken from")
      .choice("around", &P::around,
              std::vector<std::pair<std::string, PictureAround>>{{"wearer", PictureAround::wearer},
                                                                 {"garment", PictureAround::garment}},
              "what the picture is framed around: the wearer from head to foot, or closer, the garments alone; where "
              "nobody wears them both are the same")
      .unwritten()
      .integer("width", &P::width, 64, 8192,
               "pixels; of a run default 960 where a human wears the cloth, else 1280; side by side in a study 720")
      .integer("height", &P::height, 64, 8192,
               "pixels; of a run default 1280 where a human wears the cloth, else 960; side by side in a study 960; "
               "where one of both is given the other keeps this shape")
      .build();
}

}  // namespace gambeson::schema
