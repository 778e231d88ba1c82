#include "core/cloth/patches/strain_points.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "core/cloth/draft/cells.hpp"
#include "core/cloth/patches/thread_points.hpp"
#include "core/error.hpp"

namespace gambeson {
namespace {

/// A candidate and the point that it became.
struct Place {
  Vec2 uv;
  int point = -1;
  double area_m2 = 0;  ///< of a point of a cell's rule
};

double restArea(const NurbsPatch& patch, const CellPoint& at) {
  const auto d = surfaceDerivatives(patch, at.u, at.v);
  return norm(cross(d[1], d[2])) * at.weight;
}

/// Points of the cells' rules, cell by cell.
std::vector<Place> gaussPlaces(const Garment& garment, int patch_index, std::span<const SheetCell> cells, int across) {
  if (isTrimmed(garment, patch_index))
    throw InputError({"", 0, "strain_limit.points"}, "points of cells are for patches that are not trimmed");
  std::vector<Place> places;
  for (const SheetCell& cell : cells)
    if (cell.patch == patch_index)
      for (const CellPoint& at : cellRule(cell, across, across))
        places.push_back({{at.u, at.v}, -1, restArea(garment.patches[patch_index], at)});
  return places;
}

int intervalOf(const std::vector<double>& ends, double t) {
  const auto at = std::upper_bound(ends.begin(), ends.end(), t) - ends.begin() - 1;
  return static_cast<int>(std::clamp<long>(at, 0, static_cast<long>(ends.size()) - 2));
}

/// Places of constraints on a patch: kept vertices, then crossings that are not near another place.
std::vector<Place> placesOf(const Garment& garment, int patch_index, const StrainRows::Grid& grid) {
  const NurbsPatch& patch = garment.patches[patch_index];
  const bool trimmed = isTrimmed(garment, patch_index);
  std::vector<Place> places;
  for (double v : grid.vs)
    for (double u : grid.us)
      if (!trimmed || isKept(patch, garment.trims[patch_index], {u, v})) places.push_back({{u, v}});
  if (trimmed)
    for (const Vec2& at : trimIntersections(patch, garment.trims[patch_index])) {
      const int i = intervalOf(grid.us, at.x), j = intervalOf(grid.vs, at.y);
      const double du = grid.us[i + 1] - grid.us[i], dv = grid.vs[j + 1] - grid.vs[j];
      const bool near = std::any_of(places.begin(), places.end(), [&](const Place& p) {
        return std::hypot((p.uv.x - at.x) / du, (p.uv.y - at.y) / dv) < 0.05;
      });
      if (!near) places.push_back({at});
    }
  return places;
}

struct CellParts {
  bool kept = false;
  double area = 0;
  std::map<int, double> points;  ///< area that each point takes of the cell
};

/// Hat functions in a whole cell; in a cut one inverse squared distances to its places.
CellParts partsOf(const NurbsPatch& patch, const SheetCell& cell, const std::vector<Place>& places) {
  CellParts parts;
  parts.kept = true;
  const double du = cell.u1 - cell.u0, dv = cell.v1 - cell.v0;
  std::vector<std::pair<Vec2, int>> inside;  // in units of the cell
  for (const Place& p : places) {
    const Vec2 at{(p.uv.x - cell.u0) / du, (p.uv.y - cell.v0) / dv};
    const auto in = [](double t) { return t > -1e-9 && t < 1 + 1e-9; };
    if (in(at.x) && in(at.y)) inside.push_back({at, p.point});
  }
  if (cell.cut && inside.empty()) {  // its crossings were merged with places of neighbours
    double least = std::numeric_limits<double>::infinity();
    for (const Place& p : places) {
      const Vec2 at{(p.uv.x - cell.u0) / du - 0.5, (p.uv.y - cell.v0) / dv - 0.5};
      if (std::hypot(at.x, at.y) < least) least = std::hypot(at.x, at.y), inside = {{at, p.point}};
    }
  }
  for (const CellPoint& point : cellRule(cell, patch.u.degree + 1, patch.v.degree + 1)) {
    const double dA = restArea(patch, point);
    const Vec2 at{(point.u - cell.u0) / du, (point.v - cell.v0) / dv};
    parts.area += dA;
    std::vector<double> weight;
    double total = 0;
    for (const auto& [place, unused] : inside) {
      const double x = std::abs(at.x - place.x), y = std::abs(at.y - place.y);
      weight.push_back(cell.cut ? 1 / (x * x + y * y + 1e-6) : std::max(0.0, 1 - x) * std::max(0.0, 1 - y));
      total += weight.back();
    }
    for (std::size_t k = 0; k < inside.size(); ++k) parts.points[inside[k].second] += weight[k] / total * dA;
  }
  return parts;
}

/// Each place of a cell's rule stands for its part of the cell.
CellParts partsOfRule(std::span<const Place> places) {
  CellParts parts;
  parts.kept = true;
  for (const Place& place : places) {
    parts.area += place.area_m2;
    parts.points[place.point] += place.area_m2;
  }
  return parts;
}

/// The value at a vertex from those of cells near it, as weights: the mean of four cells that meet there, else the
/// value of the plane through the cells of the two rings around it that exist, else their mean.
std::vector<std::pair<int, double>> vertexRow(const StrainRows::Grid& g, const std::vector<CellParts>& cells, int i,
                                              int j) {
  const int nu = static_cast<int>(g.us.size()) - 1, nv = static_cast<int>(g.vs.size()) - 1;
  struct Near {
    int cell;
    double x, y, area;
  };
  const double scale_u = g.us[std::min(i + 1, nu)] - g.us[std::max(i - 1, 0)],
               scale_v = g.vs[std::min(j + 1, nv)] - g.vs[std::max(j - 1, 0)];
  const auto gather = [&](int ring) {
    std::vector<Near> list;
    for (int b = std::max(0, j - ring); b < std::min(nv, j + ring); ++b)
      for (int a = std::max(0, i - ring); a < std::min(nu, i + ring); ++a)
        if (cells[a + nu * b].kept)
          list.push_back({a + nu * b, (0.5 * (g.us[a] + g.us[a + 1]) - g.us[i]) / scale_u,
                          (0.5 * (g.vs[b] + g.vs[b + 1]) - g.vs[j]) / scale_v, cells[a + nu * b].area});
    return list;
  };
  std::vector<Near> list = gather(1);
  if (list.empty()) return {};
  std::vector<std::pair<int, double>> row;
  const std::vector<Near> wide = gather(2);
  if (list.size() == 4 || wide.size() < 3) {
    double total = 0;
    for (const Near& c : list) total += c.area;
    // Inside, the bilinear interpolation between the centres; on a uniform grid the mean.
    if (list.size() == 4) {
      const double x0 = list[0].x, x1 = list[1].x, y0 = list[0].y, y1 = list[2].y;
      const double fx = -x0 / (x1 - x0), fy = -y0 / (y1 - y0);
      return {{list[0].cell, (1 - fx) * (1 - fy)},
              {list[1].cell, fx * (1 - fy)},
              {list[2].cell, (1 - fx) * fy},
              {list[3].cell, fx * fy}};
    }
    for (const Near& c : list) row.push_back({c.cell, c.area / total});
    return row;
  }
  // Least squares of a + b x + c y over `wide`; the value at (0, 0) is a. A direction with one cell only is left out.
  double n = 0, mx = 0, my = 0;
  for (const Near& c : wide) n += 1, mx += c.x, my += c.y;
  mx /= n, my /= n;
  double xx = 0, yy = 0, xy = 0;
  for (const Near& c : wide)
    xx += (c.x - mx) * (c.x - mx), yy += (c.y - my) * (c.y - my), xy += (c.x - mx) * (c.y - my);
  const double det = xx * yy - xy * xy;
  for (const Near& c : wide) {
    double gx = 0, gy = 0;  // gradient's weights
    if (det > 1e-6) {
      gx = (yy * (c.x - mx) - xy * (c.y - my)) / det;
      gy = (xx * (c.y - my) - xy * (c.x - mx)) / det;
    } else if (xx > 1e-6 && yy < 1e-6) {
      gx = (c.x - mx) / xx;
    } else if (yy > 1e-6 && xx < 1e-6) {
      gy = (c.y - my) / yy;
    }
    row.push_back({c.cell, 1 / n - gx * mx - gy * my});
  }
  return row;
}

/// Constraints at places that weft and warp share, and the way from multipliers to cells to vertices.
void addSharedPoints(const Garment& garment, const FreeMap& map, LimitPoints kind, StrainRows& s) {
  const std::vector<SheetCell> sheet_cells = sheetCells(garment);
  const int across = kind == LimitPoints::gauss ? 2 : kind == LimitPoints::centres ? 1 : 0;
  const std::vector<int> offsets = controlOffsets(garment);
  const int patch_count = static_cast<int>(garment.patches.size());
  std::vector<std::vector<Place>> places(patch_count);
  RowTable table;
  std::map<std::array<int, 2>, int> point_of;
  for (int p = 0; p < patch_count; ++p) {
    places[p] = across > 0 ? gaussPlaces(garment, p, sheet_cells, across) : placesOf(garment, p, s.grids[p]);
    for (Place& place : places[p]) {
      const PointRows rows = rowsAt(garment, map, offsets[p], p, place.uv);
      const std::array<int, 2> row{table.find(rows, 1, s.B), table.find(rows, 2, s.B)};
      const auto [at, is_new] = point_of.try_emplace(row, static_cast<int>(s.points.size()));
      place.point = at->second;
      if (is_new) s.points.push_back({p, place.uv, 0, row});
    }
  }

  std::vector<std::vector<CellParts>> cells(patch_count);
  std::vector<int> first_cell{0};
  for (int p = 0; p < patch_count; ++p) {
    cells[p].resize((s.grids[p].us.size() - 1) * (s.grids[p].vs.size() - 1));
    first_cell.push_back(first_cell.back() + static_cast<int>(cells[p].size()));
  }
  std::vector<std::size_t> of_rules(patch_count, 0);  // places of cells that were visited
  for (const SheetCell& cell : sheet_cells) {
    const StrainRows::Grid& g = s.grids[cell.patch];
    const int at = intervalOf(g.us, 0.5 * (cell.u0 + cell.u1)) +
                   (static_cast<int>(g.us.size()) - 1) * intervalOf(g.vs, 0.5 * (cell.v0 + cell.v1));
    if (across > 0) {
      const std::span<const Place> all = places[cell.patch];
      std::size_t& first = of_rules[cell.patch];
      cells[cell.patch][at] = partsOfRule(all.subspan(first, static_cast<std::size_t>(across * across)));
      first += static_cast<std::size_t>(across * across);
    } else {
      cells[cell.patch][at] = partsOf(garment.patches[cell.patch], cell, places[cell.patch]);
    }
    for (const auto& [point, area] : cells[cell.patch][at].points) s.points[point].area_m2 += area;
  }
  s.area_m2.assign(s.rows(), 0.0);
  for (const StrainPoint& point : s.points)
    for (int row : point.row) s.area_m2[row] += point.area_m2;
  SparseRows cell_of_point, vertex_of_cell;  // resultants of cells from multipliers of points, field from cells
  cell_of_point.column_count = static_cast<int>(s.points.size());
  vertex_of_cell.column_count = first_cell.back();
  for (int p = 0; p < patch_count; ++p) {
    const StrainRows::Grid& g = s.grids[p];
    for (const CellParts& cell : cells[p]) {
      for (const auto& [point, area] : cell.points)
        if (area > 0) cell_of_point.add(point, area / (s.points[point].area_m2 * cell.area));
      cell_of_point.endRow();
    }
    for (int j = 0; j < static_cast<int>(g.vs.size()); ++j)
      for (int i = 0; i < static_cast<int>(g.us.size()); ++i) {
        for (const auto& [cell, weight] : vertexRow(g, cells[p], i, j))
          vertex_of_cell.add(first_cell[p] + cell, weight);
        vertex_of_cell.endRow();
      }
  }
  const SparseRows vertex_of_point = multiply(vertex_of_cell, cell_of_point);
  for (int direction : {0, 1}) {
    SparseRows share;  // of a row's multiplier
    share.column_count = s.rows();
    for (const StrainPoint& point : s.points) {
      const int row = point.row[direction];
      if (s.area_m2[row] > 0) share.add(row, point.area_m2 / s.area_m2[row]);
      share.endRow();
    }
    s.field_of_row[direction] = multiply(vertex_of_point, share);
  }
}

/// Index and weight of the linear interpolation at t: at[k] (1 - w) + at[k + 1] w.
std::pair<int, double> between(const std::vector<double>& at, double t) {
  const int k = intervalOf(at, t);
  return {k, (t - at[k]) / (at[k + 1] - at[k])};
}

/// Constraints at places of each thread's own; a multiplier over its area is the resultant there.
void addThreadPoints(const Garment& garment, const FreeMap& map, StrainRows& s) {
  const std::vector<int> offsets = controlOffsets(garment);
  const int patch_count = static_cast<int>(garment.patches.size());
  RowTable table;
  std::map<std::array<int, 2>, int> point_of;
  std::vector<std::array<ThreadGrid, 2>> grids;
  std::vector<std::array<std::vector<int>, 2>> row_of(patch_count);
  for (int p = 0; p < patch_count; ++p) {
    grids.push_back(threadGrids(garment, map, p));
    for (int direction : {0, 1}) {
      const ThreadGrid& g = grids[p][direction];
      for (std::size_t j = 0; j < g.v.at.size(); ++j)
        for (std::size_t i = 0; i < g.u.at.size(); ++i) {
          const Vec2 uv{g.u.at[i], g.v.at[j]};
          const PointRows rows = rowsAt(garment, map, offsets[p], p, uv);
          std::array<int, 2> row{-1, -1};
          row[direction] = table.find(rows, direction + 1, s.B);
          const auto [at, is_new] = point_of.try_emplace(row, static_cast<int>(s.points.size()));
          if (is_new) s.points.push_back({p, uv, 0, row});
          s.points[at->second].area_m2 += g.u.weight[i] * g.v.weight[j] * norm(cross(rows.threads.A1, rows.threads.A2));
          row_of[p][direction].push_back(row[direction]);
        }
    }
  }
  s.area_m2.assign(s.rows(), 0.0);
  for (const StrainPoint& point : s.points)
    for (int row : point.row)
      if (row >= 0) s.area_m2[row] += point.area_m2;
  for (int direction : {0, 1}) {
    SparseRows& field = s.field_of_row[direction];
    field.column_count = s.rows();
    for (int p = 0; p < patch_count; ++p) {
      const ThreadGrid& g = grids[p][direction];
      const int across = static_cast<int>(g.u.at.size());
      for (double v : s.grids[p].vs)
        for (double u : s.grids[p].us) {
          const auto [i, x] = between(g.u.at, u);
          const auto [j, y] = between(g.v.at, v);
          for (const auto& [a, wa] : {std::pair(i, 1 - x), std::pair(i + 1, x)})
            for (const auto& [b, wb] : {std::pair(j, 1 - y), std::pair(j + 1, y)})
              if (wa * wb != 0) {
                const int row = row_of[p][direction][static_cast<std::size_t>(a + across * b)];
                field.add(row, wa * wb / s.area_m2[row]);
              }
          field.endRow();
        }
    }
  }
}

}  // namespace

StrainRows buildStrainRows(const Garment& garment, const FreeMap& map, Mobility mobility, LimitPoints points) {
  StrainRows s;
  s.mobility = std::move(mobility);
  s.B.column_count = map.T.column_count;
  int vertices = 0;
  for (const NurbsPatch& patch : garment.patches) {
    s.grids.push_back({breakpoints(patch.u), breakpoints(patch.v), vertices});
    vertices += static_cast<int>(s.grids.back().us.size() * s.grids.back().vs.size());
  }
  if (points == LimitPoints::threads)
    addThreadPoints(garment, map, s);
  else
    addSharedPoints(garment, map, points, s);
  completeRows(s);
  return s;
}

Vec2 limitStressAt(const StrainRows& rows, std::span<const Vec2> field, int patch, Vec2 uv) {
  const StrainRows::Grid& g = rows.grids[patch];
  const int i = intervalOf(g.us, uv.x), j = intervalOf(g.vs, uv.y), nu = static_cast<int>(g.us.size());
  const double x = (uv.x - g.us[i]) / (g.us[i + 1] - g.us[i]), y = (uv.y - g.vs[j]) / (g.vs[j + 1] - g.vs[j]);
  const Vec2 &a = field[g.first_vertex + i + nu * j], &b = field[g.first_vertex + i + 1 + nu * j],
             &c = field[g.first_vertex + i + nu * (j + 1)], &d = field[g.first_vertex + i + 1 + nu * (j + 1)];
  const double wa = (1 - x) * (1 - y), wb = x * (1 - y), wc = (1 - x) * y, wd = x * y;
  return {wa * a.x + wb * b.x + wc * c.x + wd * d.x, wa * a.y + wb * b.y + wc * c.y + wd * d.y};
}

}  // namespace gambeson
