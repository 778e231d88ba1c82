/// IGES files read back by a reader of this test's own, written from the specification (IGES 5.3: fixed records,
/// entities 126, 128, 102, 142, 144, 406), against the surfaces and loops that went in.

#include "core/io/iges.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "core/error.hpp"

namespace gambeson {
namespace {

struct Entity {
  int type = 0, form = 0;
  std::string status;
  std::vector<std::string> parameters;

  double real(std::size_t k) const {
    std::string s = parameters.at(k);
    std::replace(s.begin(), s.end(), 'D', 'E');
    return std::stod(s);
  }
  int integer(std::size_t k) const { return std::stoi(parameters.at(k)); }
};

std::map<int, Entity> readIges(const std::string& text) {
  std::istringstream in(text);
  std::map<char, std::vector<std::string>> sections;
  std::string order;
  for (std::string line; std::getline(in, line);) {
    EXPECT_EQ(line.size(), 80u) << line;
    const char section = line.at(72);
    if (order.empty() || order.back() != section) order += section;
    sections[section].push_back(line.substr(0, 72));
    EXPECT_EQ(std::stoi(line.substr(73)), static_cast<int>(sections[section].size())) << line;
  }
  EXPECT_EQ(order, "SGDPT");
  const std::string& end = sections['T'].at(0);
  for (int k = 0; k < 4; ++k)
    EXPECT_EQ(std::stoi(end.substr(static_cast<std::size_t>(8 * k + 1), 7)),
              static_cast<int>(sections[end[static_cast<std::size_t>(8 * k)]].size()));
  std::map<int, Entity> entities;
  const auto& d = sections['D'];
  for (std::size_t i = 0; i < d.size(); i += 2) {
    const auto field = [&](std::size_t line, int k) {
      return std::stoi(d[line].substr(static_cast<std::size_t>(8 * k), 8));
    };
    Entity e;
    e.type = field(i, 0);
    e.status = d[i].substr(64);
    e.form = field(i + 1, 4);
    const int pointer = static_cast<int>(i) + 1;
    std::string data;
    for (int l = field(i, 1); l < field(i, 1) + field(i + 1, 3); ++l) {
      const std::string& record = sections['P'].at(static_cast<std::size_t>(l) - 1);
      EXPECT_EQ(std::stoi(record.substr(64)), pointer);
      std::string part = record.substr(0, 64);
      while (!part.empty() && part.back() == ' ') part.pop_back();
      data += part;
    }
    EXPECT_EQ(data.back(), ';');
    data.pop_back();
    std::istringstream tokens(data);
    for (std::string t; std::getline(tokens, t, ',');) e.parameters.push_back(t);
    EXPECT_EQ(std::stoi(e.parameters.at(0)), e.type);
    e.parameters.erase(e.parameters.begin());
    entities[pointer] = e;
  }
  return entities;
}

NurbsPatch patchOf(const Entity& e) {
  EXPECT_EQ(e.type, 128);
  NurbsPatch p;
  const int nu = e.integer(0) + 1, nv = e.integer(1) + 1;
  p.u.degree = e.integer(2);
  p.v.degree = e.integer(3);
  std::size_t k = 9;
  for (int i = 0; i < nu + p.u.degree + 1; ++i) p.u.knots.push_back(e.real(k++));
  for (int i = 0; i < nv + p.v.degree + 1; ++i) p.v.knots.push_back(e.real(k++));
  for (int i = 0; i < nu * nv; ++i) p.weights.push_back(e.real(k++));
  for (int i = 0; i < nu * nv; ++i, k += 3) p.points.push_back({e.real(k), e.real(k + 1), e.real(k + 2)});
  EXPECT_EQ(e.real(k), p.u.front());
  EXPECT_EQ(e.real(k + 3), p.v.back());
  return p;
}

/// A point of a curve 126, by de Boor in homogeneous coordinates.
Vec3 at126(const Entity& e, double part) {
  EXPECT_EQ(e.type, 126);
  const int n = e.integer(0) + 1, degree = e.integer(1);
  KnotVector knots{degree, {}};
  std::size_t k = 6;
  for (int i = 0; i < n + degree + 1; ++i) knots.knots.push_back(e.real(k++));
  std::vector<double> w;
  for (int i = 0; i < n; ++i) w.push_back(e.real(k++));
  const double t = knots.front() + part * (knots.back() - knots.front());
  const int span = findSpan(knots, t);
  std::vector<double> N(static_cast<std::size_t>(degree) + 1);
  basisDerivatives(knots, span, t, 0, N);
  Vec3 sum;
  double weight = 0;
  for (int i = 0; i <= degree; ++i) {
    const auto c = static_cast<std::size_t>(span - degree + i);
    const std::size_t x = k + 3 * c;
    sum += N[static_cast<std::size_t>(i)] * w[c] * Vec3{e.real(x), e.real(x + 1), e.real(x + 2)};
    weight += N[static_cast<std::size_t>(i)] * w[c];
  }
  return sum / weight;
}

NurbsPatch wavy(bool rational) {
  NurbsPatch p{uniformKnots(2, 4), uniformKnots(3, 3), {}, {}};
  for (int j = 0; j < p.v.count(); ++j)
    for (int i = 0; i < p.u.count(); ++i) {
      p.points.push_back({0.05 * i, 0.04 * j + 1e-7 * i, 0.01 * std::sin(i + 2.0 * j) / 3});
      p.weights.push_back(rational ? 1 + 0.1 * ((i + j) % 3) : 1);
    }
  return p;
}

TEST(Iges, SurfacesComeBackInMillimetres) {
  for (const bool rational : {false, true}) {
    const NurbsPatch patch = wavy(rational);
    const auto entities = readIges(igesText("a wavy sheet", {{"front", patch, {}}, {"back", patch, {}}}));
    int surfaces = 0;
    for (const auto& [pointer, e] : entities) {
      if (e.type != 128) continue;
      ++surfaces;
      EXPECT_EQ(e.status, "00000000");
      EXPECT_EQ(e.integer(6), rational ? 0 : 1);  // PROP3: 1 is polynomial
      const NurbsPatch back = patchOf(e);
      EXPECT_EQ(back.u, patch.u);
      EXPECT_EQ(back.v, patch.v);
      EXPECT_EQ(back.weights, patch.weights);
      for (double u = 0; u <= 1; u += 0.125)
        for (double v = 0; v <= 1; v += 0.125)
          EXPECT_LT(norm(surfaceDerivatives(back, u, v)[0] - 1e3 * surfaceDerivatives(patch, u, v)[0]), 1e-11);
      // Its name is a property.
      const Entity& name = entities.at(e.integer(e.parameters.size() - 1));
      EXPECT_EQ(name.type, 406);
      EXPECT_EQ(name.form, 15);
      EXPECT_EQ(name.parameters.at(1), surfaces == 1 ? "5Hfront" : "4Hback");
    }
    EXPECT_EQ(surfaces, 2);
  }
}

TEST(Iges, LoopsBoundTheirSurfaces) {
  const NurbsPatch patch = wavy(true);
  constexpr double tolerance = 1e-5;
  const TrimLoop outline{circle({0.5, 0.5}, 0.4, 0.3, false)}, hole{circle({0.45, 0.55}, 0.1, 0.1, true)};
  const std::vector<Vec2> corners{{0.6, 0.35}, {0.6, 0.45}, {0.7, 0.45}};  // clockwise
  const Trim trim{{outline, hole, polygon(corners)}};
  const auto entities = readIges(igesText("a trimmed sheet", {{"front", patch, trim}}, tolerance));
  const Entity* trimmed = nullptr;
  for (const auto& [pointer, e] : entities) {
    if (e.type == 144) {
      EXPECT_EQ(trimmed, nullptr);
      trimmed = &e;
    }
    EXPECT_EQ(e.status.substr(2, 2) == "00", e.type == 144);  // all others belong to something
  }
  ASSERT_TRUE(trimmed);
  EXPECT_EQ(trimmed->integer(1), 1);
  EXPECT_EQ(trimmed->integer(2), 2);
  const NurbsPatch back = patchOf(entities.at(trimmed->integer(0)));
  const std::vector<const TrimLoop*> loops{&trim.loops[0], &trim.loops[1], &trim.loops[2]};
  for (std::size_t l = 0; l < 3; ++l) {
    const Entity& on = entities.at(trimmed->integer(3 + l));
    ASSERT_EQ(on.type, 142);
    EXPECT_EQ(on.integer(1), trimmed->integer(0));
    EXPECT_EQ(on.integer(4), 1);  // the curve in the parameters is the right one
    std::vector<const Entity*> flat{&entities.at(on.integer(2))};
    if (flat[0]->type == 102) {
      const Entity& chain = *flat[0];
      flat.clear();
      for (int k = 0; k < chain.integer(0); ++k)
        flat.push_back(&entities.at(chain.integer(static_cast<std::size_t>(k) + 1)));
    }
    ASSERT_EQ(flat.size(), loops[l]->size());
    std::vector<Vec3> in_space;
    for (std::size_t c = 0; c < flat.size(); ++c) {
      EXPECT_EQ(flat[c]->status, "00010500");
      for (int i = 0; i <= 40; ++i) {
        const Vec3 uv = at126(*flat[c], i / 40.0);
        const Vec2 expected = curvePoint((*loops[l])[c], i / 40.0).point;
        EXPECT_NEAR(uv.x, expected.x, 1e-14);
        EXPECT_NEAR(uv.y, expected.y, 1e-14);
        EXPECT_EQ(uv.z, 0);
        in_space.push_back(surfaceDerivatives(back, uv.x, uv.y)[0]);
      }
    }
    // The polyline in space: closed, on the loop within the tolerance, and the loop on it.
    const Entity& space = entities.at(on.integer(3));
    const int points = space.integer(0) + 1;
    std::vector<Vec3> line;
    for (int i = 0; i < points; ++i) line.push_back(at126(space, double(i) / (points - 1)));
    EXPECT_EQ(line.front(), line.back());
    for (const Vec3& x : in_space) {
      double nearest = 1e300;
      for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const Vec3 d = line[i + 1] - line[i];
        const double s = std::clamp(dot(x - line[i], d) / dot(d, d), 0.0, 1.0);
        nearest = std::min(nearest, norm(x - line[i] - s * d));
      }
      EXPECT_LT(nearest, 1.5 * 1e3 * tolerance);
    }
  }
}

TEST(Iges, HolesWithoutAnOutlineStandInTheBorderAndOutlinesStandApart) {
  const NurbsPatch patch = wavy(false);
  const auto count = [](const std::map<int, Entity>& entities, int type) {
    return std::count_if(entities.begin(), entities.end(), [&](const auto& e) { return e.second.type == type; });
  };
  const auto hole = readIges(igesText("h", {{"h", patch, {{{circle({0.5, 0.5}, 0.2, 0.2, true)}}}}}));
  for (const auto& [pointer, e] : hole)
    if (e.type == 144) {
      EXPECT_EQ(e.integer(1), 0);  // the outline is the surface's own border
      EXPECT_EQ(e.integer(2), 1);
      EXPECT_EQ(e.integer(3), 0);
    }
  EXPECT_EQ(count(hole, 144), 1);
  // A notch is no hole: wires of a face do not touch.
  const std::vector<Vec2> corners{{0.4, 1}, {0.6, 1}, {0.5, 0.8}};
  for (const auto& [pointer, e] : readIges(igesText("n", {{"n", patch, {{polygon(corners)}}}})))
    if (e.type == 144) {
      EXPECT_EQ(e.integer(1), 1);
      EXPECT_EQ(e.integer(2), 0);
    }
  // A piece, and another with a hole.
  const Trim two{{{circle({0.25, 0.5}, 0.2, 0.4, false)},
                  {circle({0.75, 0.5}, 0.2, 0.4, false)},
                  {circle({0.75, 0.5}, 0.1, 0.1, true)}}};
  const auto apart = readIges(igesText("2", {{"2", patch, two}}));
  EXPECT_EQ(count(apart, 144), 2);
  EXPECT_EQ(count(apart, 128), 1);
  int holes = 0;
  for (const auto& [pointer, e] : apart)
    if (e.type == 144) holes += e.integer(2);
  EXPECT_EQ(holes, 1);
  EXPECT_THROW(igesText("out", {{"out", patch, {{{circle({0.5, 0.5}, 0.8, 0.2, true)}}}}}), InputError);
}

}  // namespace
}  // namespace gambeson
