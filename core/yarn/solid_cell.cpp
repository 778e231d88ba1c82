#include "core/yarn/solid_cell.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace gambeson {
namespace {

/// Programs 0 to 3: the steps of face 1 along axes 1 and 2, of face 2 likewise; then two of each held yarn.
constexpr int kStepPrograms = 4;

/// Grooves that are shallower hold a node by one facet at a time, or where it would rest beyond the edge, as far as
/// here [half widths], by two.
constexpr double kGroove_rad = 0.5, kKeep = 0.3;

constexpr Vec3 kAxis[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

const SolidCellDesign& checked(const SolidCellDesign& d) {
  for (const int direction : {along_weft, along_warp}) {
    try {
      checkLaw(d.law[direction]);
    } catch (const InputError& e) {
      throw InputError({"", 0, (direction == along_weft ? "weft.law." : "warp.law.") + e.where().key}, e.reason());
    }
  }
  if (!(d.friction >= 0 && std::isfinite(d.friction)))
    throw InputError({"", 0, "friction"}, fmt::format("{:.6g}, must be >= 0", d.friction));
  if (!(d.penalty > 0 && std::isfinite(d.penalty)))
    throw InputError({"", 0, "penalty"}, fmt::format("{:.6g}, must be > 0", d.penalty));
  return d;
}

}  // namespace

SolidCell::SolidCell(const SolidCellDesign& design)
    : design_(checked(design)),
      share_(design.quarter ? 0.5 : 1),
      solids_(solidYarns(design.yarns, design.law, design.meshing, design.quarter)),
      body_(solids_.mesh),
      contact_(makeContact()) {
  addSupports();
}

SolidContact SolidCell::makeContact() const {
  SolidContactLaw law;
  double stiffness = INFINITY, thin = INFINITY;
  for (const int d : {along_weft, along_warp}) {
    stiffness = std::min(stiffness, moduliOf(design_.law[d]).transverse_young_Pa / yarns().yarn[d].half_thickness_m);
    thin = std::min(thin, yarns().yarn[d].half_thickness_m);
  }
  law.normal_Pa_per_m = law.tangential_Pa_per_m = design_.penalty * stiffness;
  law.friction = design_.friction;
  law.bound = design_.bound;
  law.touch.reach_m = 0.5 * thin;
  law.touch.keep = kKeep;
  law.touch.groove_rad = kGroove_rad;
  std::vector<Facet> skins[2];
  for (const YarnBody& b : solids_.bodies) {
    const std::vector<Facet> skin = solids_.skin(b);
    skins[b.direction].insert(skins[b.direction].end(), skin.begin(), skin.end());
  }
  std::vector<ContactSide> sides;
  if (design_.contact) {
    const FacetSurface against(skins[1 - design_.pressed], static_cast<int>(solids_.mesh.nodes.size()));
    sides.push_back(contactSide(skins[design_.pressed], against, solids_.mesh.nodes));
  }
  return {std::move(sides), law, solids_.mesh.nodes};
}

void SolidCell::joinEnds(const YarnBody& b) {
  const int n = design_.meshing.across;
  const bool held = design_.faces == FaceSupport::held;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      const int near = solids_.node(b, 0, i, j);
      const int far = solids_.node(b, b.sections - 1, i, design_.quarter ? n - j : j);
      const std::string name = fmt::format("ends of yarn {}", b.yarn + 1);
      for (int c = 0; c < 2; ++c)
        supports_.constraints.push_back({{{near, -kAxis[c]}, {far, kAxis[c]}}, 1, 2 * b.direction + c, name});
      if (held) {
        for (const int node : {near, far}) supports_.constraints.push_back(prescribed(node, kAxis[2]));
      } else {
        const double sign = design_.quarter ? 1 : -1;
        supports_.constraints.push_back({{{near, sign * kAxis[2]}, {far, kAxis[2]}}, 0, -1, name});
      }
    }
}

/// Half a turn about the place takes (section l, node i, j) to (its mirror image, n - i, j): their mean stays there.
void SolidCell::holdYarn(const YarnBody& b, int halves) {
  const int n = design_.meshing.across, middle = design_.meshing.along * (halves + 1);  // in half pieces
  const int place = middle % (2 * (b.sections - 1));
  const int one = solids_.node(b, place / 2, n / 2, n / 2), other = solids_.node(b, (place + 1) / 2, n - n / 2, n / 2);
  const double spacing = yarns().yarn[1 - b.direction].spacing_m;
  const int program = kStepPrograms + 2 * static_cast<int>(held_.size());
  held_.push_back(yarns().middle(b.direction, b.yarn, spacing * place / (2 * design_.meshing.along)));
  for (int c = 0; c < 2; ++c)
    supports_.constraints.push_back(
        {{{one, kAxis[c]}, {other, kAxis[c]}}, 2, program + c, fmt::format("middle of yarn {}", b.yarn + 1)});
}

void SolidCell::addSupports() {
  for (const YarnBody& b : solids_.bodies) joinEnds(b);
  for (const YarnBody& b : solids_.bodies)
    if (const std::optional<int> halves = yarns().halfTurn(b.direction, b.yarn)) holdYarn(b, *halves);
  const YarnBody& first = solids_.bodies.front();
  if (held_.empty()) holdYarn(first, 0);  // where the cloth as a whole stands
  if (!design_.quarter && design_.faces == FaceSupport::glide)
    supports_.constraints.push_back(prescribed(solids_.node(first, 0, 0, 0), kAxis[2]));
  supports_.programs = programs({}, {});
}

double SolidCell::height_m() const {
  double most = 0;
  for (const WovenYarn& y : yarns().yarn) most = std::max(most, 2 * (y.amplitude_m + y.half_thickness_m));
  return most;
}

double SolidCell::volumeFraction() const { return body_.volume() / (area_m2() * height_m()); }

std::vector<Program> SolidCell::programs(const CellLoad& from, const CellLoad& to) const {
  std::array<std::array<Vec3, 2>, 2> moved;  // steps less those at rest, by load and face
  for (const CellLoad* load : {&from, &to}) {
    if (load->curvature_per_m != 0)
      throw InputError({"", 0, "load.curvature"},
                       fmt::format("{:.6g}, must be 0: cells of solids stay flat", load->curvature_per_m));
    const CellFaces faces = facesOf(yarns(), *load), rest = facesOf(yarns(), {});
    for (int g = 0; g < 2; ++g) moved[load == &to][g] = faces.step[g].origin - rest.step[g].origin;
  }
  const std::vector<double> before = programRates(moved[0]), after = programRates(moved[1]);
  std::vector<Program> programs;
  for (std::size_t k = 0; k < before.size(); ++k) programs.push_back({{0, 1}, {before[k], after[k]}});
  return programs;
}

std::vector<double> SolidCell::programRates(const std::array<Vec3, 2>& step_m) const {
  std::vector<double> rates;
  for (int g = 0; g < 2; ++g)
    for (int c = 0; c < 2; ++c) rates.push_back(share_ * step_m[g][c]);
  for (const Vec3& place : held_)
    for (int c = 0; c < 2; ++c)
      rates.push_back(place.x / yarns().period_m(along_weft) * step_m[0][c] +
                      place.y / yarns().period_m(along_warp) * step_m[1][c]);
  return rates;
}

CellLoad SolidCell::between(const CellLoad& from, const CellLoad& to, double t) const {
  if (t == 0) return from;
  if (t == 1) return to;
  const CellFaces a = facesOf(yarns(), from), b = facesOf(yarns(), to);
  Vec3 step[2];
  for (int g = 0; g < 2; ++g)
    step[g] = (a.step[g].origin + t * (b.step[g].origin - a.step[g].origin)) / yarns().period_m(g);
  return loadOf({step[0].x, step[1].x, step[0].y, step[1].y});
}

std::array<Vec3, 2> SolidCell::faceForces(std::span<const Vec3> force) const {
  std::array<Vec3, 2> sum{};
  const int in_section = (design_.meshing.across + 1) * (design_.meshing.across + 1);
  for (const YarnBody& b : solids_.bodies)
    for (int k = 0; k < in_section; ++k)
      sum[b.direction] += share_ * force[b.first_node + (b.sections - 1) * in_section + k];
  return sum;
}

}  // namespace gambeson
