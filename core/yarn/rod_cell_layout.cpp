/// RodCell: its sections at rest, pieces, pairs and freedoms.

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "core/error.hpp"
#include "core/yarn/rod_cell.hpp"

namespace gambeson {
namespace {

void checkSection(const RodSection& s, const std::string& key) {
  for (const auto& [name, value] : {std::pair{"stretch", s.stretch_N},
                                    {"shear_across", s.shear_across_N},
                                    {"shear_through", s.shear_through_N},
                                    {"bending_through", s.bending_through_Nm2},
                                    {"bending_in_plane", s.bending_in_plane_Nm2}})
    if (!(value > 0 && std::isfinite(value)))
      throw InputError({"", 0, key + "." + name}, fmt::format("{:.6g}, must be > 0", value));
  if (!(s.torsion_Nm2 >= 0 && std::isfinite(s.torsion_Nm2)))
    throw InputError({"", 0, key + ".torsion"}, fmt::format("{:.6g}, must be >= 0", s.torsion_Nm2));
}

}  // namespace

RodCell::RodCell(const RodCellDesign& design) : design_(design) {
  checkWovenYarns(design_.yarns);
  checkSection(design_.section[along_weft], "weft.section");
  checkSection(design_.section[along_warp], "warp.section");
  if (design_.contact) checkCompression(design_.compression);
  checkRodFriction(design_.friction);
  const int n = design_.pieces_per_spacing;
  if (n < 4 || n > 256 || n % 2 != 0)
    throw InputError({"", 0, "pieces_per_spacing"}, fmt::format("{}, must be even, 4 to 256", n));
  touch_m_ = yarns().yarn[along_weft].half_thickness_m + yarns().yarn[along_warp].half_thickness_m;
  addYarns();
  const WovenYarn &weft = yarns().yarn[along_weft], &warp = yarns().yarn[along_warp];
  crossing_ = {
      design_.compression, {weft.half_width_m, warp.half_width_m}, {weft.half_thickness_m, warp.half_thickness_m}};
  for (const int d : {along_weft, along_warp})
    beside_[d] = {design_.compression, yarns().yarn[d].half_width_m, yarns().yarn[d].half_thickness_m, touch_m_,
                  pressureShare(crossing_)};
  crossing_reach_m_ = design_.touch == RodTouch::section ? crossing_.reach_m() : touch_m_;
  if (design_.contact) addPairs();
  if (design_.contact && design_.touch == RodTouch::section) addNeighbours();
  if (design_.extent == CellExtent::quarter &&
      (yarns().weave.warps != 2 || yarns().weave.wefts != 2 || !hasEqualFaces(yarns().weave)))
    throw InputError({"", 0, "extent"}, "quarter, must be full unless the weave is plain");
  addFreedoms();
}

/// Column by column of the sections that move by themselves; the images of a quarter refer to theirs. A held section
/// turns about the cloth's normal, which keeps its direction in the axes of the section.
void RodCell::addFreedoms() {
  constexpr std::array<double, 6> kGlide{1, 1, -1, -1, -1, 1};
  const bool quarter = design_.extent == CellExtent::quarter, held = design_.faces == FaceSupport::held;
  const int n = design_.pieces_per_spacing;
  std::vector<std::array<int, 6>> columns(rest_.size());
  std::vector<std::array<double, 6>> by(rest_.size());
  for (const int d : {along_weft, along_warp})
    for (int k = 0; k < yarns().count(d); ++k)
      for (int i = 0; i < sectionsOf(d); ++i) {
        const bool own = !quarter || (k == 0 && i < n), mirrored = quarter && (k + i / n) % 2 == 1;
        const int here = firstSection(d, k) + i, origin = quarter ? firstSection(d, 0) + i % n : here;
        const bool fixed = held && i % (quarter ? n : sectionsOf(d)) == 0;
        if (own && fixed) {
          const int first = freedoms_.column_count;
          const Vec3 normal = transposeTimes(rest_[here].rotation, Vec3{0, 0, 1});
          columns[here] = {first, first + 1, -1, first + 2, first + 2, first + 2};
          by[here] = {1, 1, 0, normal.x, normal.y, normal.z};
          freedoms_.column_count += 3;
        } else if (own) {
          for (int c = 0; c < 6; ++c) columns[here][c] = freedoms_.column_count++, by[here][c] = 1;
        }
        for (int c = 0; c < 6; ++c) {
          if (columns[origin][c] >= 0)
            freedoms_.add(columns[origin][c], mirrored ? kGlide[c] * by[origin][c] : by[origin][c]);
          freedoms_.endRow();
        }
      }
  for (int c = 0; c < 6; ++c) freedoms_.endRow();
}

void RodCell::addYarns() {
  for (const int d : {along_weft, along_warp}) {
    const int n = sectionsOf(d);
    const double step = yarns().period_m(d) / n;
    const Vec3 ahead = d == along_weft ? Vec3{1, 0, 0} : Vec3{0, 1, 0}, up{0, 0, 1}, across = cross(up, ahead);
    for (int k = 0; k < yarns().count(d); ++k)
      for (int i = 0; i < n; ++i) {
        const Vec3 tangent = normalized(ahead + yarns().slope(d, k, i * step) * up);
        rest_.push_back({{tangent, across, cross(tangent, across)}, yarns().middle(d, k, i * step)});
      }
  }
  const CellFaces faces = facesOf(yarns(), {});
  double total = 0;
  for (const int d : {along_weft, along_warp}) {
    const int n = sectionsOf(d);
    const double step = yarns().period_m(d) / n;
    for (int k = 0; k < yarns().count(d); ++k)
      for (int i = 0; i < n; ++i) {
        const Image a = imageOf(d, k, i), b = imageOf(d, k, i + 1);
        const double length = yarns().arcLength_m(d, k, i * step, (i + 1) * step);
        pieces_.push_back({restPiece(place(faces, rest_, a).pose, place(faces, rest_, b).pose, length), d, a, b});
        total += length;
      }
  }
  turn_length_m_ = total / static_cast<double>(pieces_.size());
}

/// The length for which section i of a yarn stands.
double RodCell::shareOf(int direction, int k, int i) const {
  const int m = sectionsOf(direction), first = firstSection(direction, k), here = ((i % m) + m) % m;
  return 0.5 * (pieces_[first + here].piece.length_m + pieces_[first + (here + m - 1) % m].piece.length_m);
}

/// Around each crossing the sections of both yarns up to their next crossings.
void RodCell::addPairs() {
  const int n = design_.pieces_per_spacing;
  for (int j = 0; j < yarns().weave.wefts; ++j)
    for (int i = 0; i < yarns().weave.warps; ++i) {
      const int on_weft = i * n + n / 2, on_warp = j * n + n / 2;
      for (int a = on_weft - n; a <= on_weft + n; ++a)
        for (int b = on_warp - n; b <= on_warp + n; ++b)
          pairs_.push_back({imageOf(along_weft, j, a), imageOf(along_warp, i, b),
                            shareOf(along_weft, j, a) * shareOf(along_warp, i, b),
                            yarns().onTop(along_weft, j, i) ? 1. : -1.});
    }
}

/// Each section and those of the next yarn that shear can bring beside it. Of a pair that lies in a cell farther along,
/// the first goes back along and the second across: images of one step.
void RodCell::addNeighbours() {
  const int n = design_.pieces_per_spacing;
  for (const int d : {along_weft, along_warp})
    for (int k = 0; k < yarns().count(d); ++k) {
      const int m = sectionsOf(d), next = (k + 1) % yarns().count(d), across = k + 1 == yarns().count(d) ? 1 : 0;
      for (int a = 0; a < m; ++a)
        for (int b = a - 2 * n; b <= a + 2 * n; ++b) {
          const int cells = (b >= 0 ? b : b - m + 1) / m;
          if (std::abs(cells) > 1) continue;
          pairs_.push_back({{firstSection(d, k) + a, d, -cells},
                            {firstSection(d, next) + b - cells * m, 1 - d, across},
                            shareOf(d, k, a) * shareOf(d, next, b)});
        }
    }
}

}  // namespace gambeson
