#include "core/cloth/patches/bilinear.hpp"

#include "core/error.hpp"

namespace gambeson {
namespace {

int across(const NurbsPatch& patch) { return patch.u.count() - 1; }
/// The ends of a cell of one knot vector.
Vec2 endsOf(const KnotVector& k, int cell) {
  return {k.knots[static_cast<std::size_t>(cell) + 1], k.knots[static_cast<std::size_t>(cell) + 2]};
}

std::vector<int> cellsOf(const KnotVector& k, double at) {
  const double near = 1e-9 * (k.back() - k.front());
  std::vector<int> cells;
  for (int c = 0; c + 1 < k.count(); ++c)
    if (const Vec2 ends = endsOf(k, c); at >= ends.x - near && at <= ends.y + near) cells.push_back(c);
  return cells;
}

}  // namespace

void checkBilinear(const Garment& g, const std::string& cloth) {
  checkGarment(g);
  for (const NurbsPatch& patch : g.patches)
    for (const KnotVector* k : {&patch.u, &patch.v})
      if (k->degree != 1 || static_cast<int>(breakpoints(*k).size()) != k->count())
        throw InputError({"", 0, "degree"}, "patches of " + cloth + " are of degree 1, with each inner knot once");
}

std::vector<int> cellsAt(const NurbsPatch& patch, Vec2 uv) {
  std::vector<int> cells;
  for (const int j : cellsOf(patch.v, uv.y))
    for (const int i : cellsOf(patch.u, uv.x)) cells.push_back(i + across(patch) * j);
  return cells;
}

std::array<int, 4> cornersOf(const NurbsPatch& patch, int cell) {
  const int i = cell % across(patch), j = cell / across(patch);
  return {patch.index(i, j), patch.index(i + 1, j), patch.index(i, j + 1), patch.index(i + 1, j + 1)};
}

Vec2 withinCell(const NurbsPatch& patch, int cell, Vec2 uv) {
  const Vec2 u = endsOf(patch.u, cell % across(patch)), v = endsOf(patch.v, cell / across(patch));
  return {(uv.x - u.x) / (u.y - u.x), (uv.y - v.x) / (v.y - v.x)};
}

Vec2 placeIn(const NurbsPatch& patch, int cell, Vec2 within) {
  const Vec2 u = endsOf(patch.u, cell % across(patch)), v = endsOf(patch.v, cell / across(patch));
  return {u.x + within.x * (u.y - u.x), v.x + within.y * (v.y - v.x)};
}

Vec2 middleOf(const NurbsPatch& patch, int cell) {
  const Vec2 u = endsOf(patch.u, cell % across(patch)), v = endsOf(patch.v, cell / across(patch));
  return {0.5 * (u.x + u.y), 0.5 * (v.x + v.y)};
}

int cellCount(const NurbsPatch& patch) { return across(patch) * (patch.v.count() - 1); }

std::vector<std::pair<int, Vec2>> cellMiddles(const Garment& garment) {
  std::vector<std::pair<int, Vec2>> places;
  for (std::size_t p = 0; p < garment.patches.size(); ++p)
    for (int c = 0; c < cellCount(garment.patches[p]); ++c)
      places.emplace_back(static_cast<int>(p), middleOf(garment.patches[p], c));
  return places;
}

}  // namespace gambeson
