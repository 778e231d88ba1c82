#pragma once
/// Patterns of our own without placements, with regions: a skirt, a shirt, trousers and a jumpsuit, drawn for a size.

#include <cmath>
#include <string>

#include "tryon/pattern/flat/panel.hpp"
#include "tryon/pattern/flat/panel_check.hpp"
#include "tryon/pattern/flat/panel_geometry.hpp"

namespace gambeson::region_patterns {

/// Lengths in m. A woman of 1.6 m or a man of 1.76 m takes `scale` 1.
struct Size {
  double scale = 1;
  double quarter_chest = 0.28, quarter_waist = 0.215, quarter_hem = 0.3;
};

inline PanelEdge edge(double x, double y) { return {"", {x, y}, StraightEdge{}}; }
inline PanelEdge curve(double x, double y, Vec2 control) { return {"", {x, y}, BezierEdge{{control}}}; }

inline Panel panel(const std::string& name, const std::string& region, PanelLoop outline) {
  Panel p;
  p.name = name, p.region = region, p.outline = std::move(outline);
  return p;
}

/// Edges: 0 hem, 1 right side, 2 waist, 3 left side, as seen from outside.
inline FlatPattern skirt(const Size& s) {
  const double w = s.scale * s.quarter_waist, h = s.scale * s.quarter_hem, l = s.scale * 0.5;
  FlatPattern p;
  p.name = "skirt";
  for (const char* face : {"front", "back"})
    p.panels.push_back(panel(face, std::string("skirt_") + face, {edge(-h, 0), edge(h, 0), edge(w, l), edge(-w, l)}));
  p.seams = {{"left side", {{0, 1, 0, 1}}, {{1, 3, 1, 0}}}, {"right side", {{1, 1, 0, 1}}, {{0, 3, 1, 0}}}};
  checkPattern(p);
  return p;
}

/// Edges of front and back: 0 hem, 1 right side, 2 right armhole, 3 right shoulder, 4 neck, 5 left shoulder, 6 left
/// armhole, 7 left side. Of sleeves: 0 hem, 1 right side, 2 right half of the cap, 3 left half, 4 left side.
inline void addShirt(FlatPattern& p, const Size& s, double length) {
  const double k = s.scale, w = k * s.quarter_chest, l = k * length, n = k * 0.08, tip = k * 0.2, depth = k * 0.25;
  const auto body = [&](const std::string& name, double neck) {
    return panel(name, name,
                 {edge(-w, 0), edge(w, 0), curve(w, l - depth, {tip - 0.01 * k, l - 0.8 * depth}),
                  edge(tip, l - 0.045 * k), curve(n, l, {0, l - 2 * neck}), edge(-n, l),
                  curve(-tip, l - 0.045 * k, {-tip + 0.01 * k, l - 0.8 * depth}), edge(-w, l - depth)});
  };
  p.panels.push_back(body("front", 0.07 * k));
  p.panels.push_back(body("back", 0.02 * k));
  const double cap = lengthOf(p.panels[0], 2), b = 0.75 * cap, h = std::sqrt(cap * cap - b * b), sleeve = 0.52 * k;
  for (const char* side : {"left", "right"})
    p.panels.push_back(
        panel(std::string(side) + " sleeve", std::string(side) + "_sleeve",
              {edge(-0.12 * k, 0), edge(0.12 * k, 0), edge(b, sleeve - h), edge(0, sleeve), edge(-b, sleeve - h)}));
  p.seams.insert(p.seams.end(), {{"left side", {{0, 1, 0, 1}}, {{1, 7, 1, 0}}},
                                 {"right side", {{1, 1, 0, 1}}, {{0, 7, 1, 0}}},
                                 {"left shoulder", {{0, 3, 0, 1}}, {{1, 5, 1, 0}}},
                                 {"right shoulder", {{0, 5, 0, 1}}, {{1, 3, 1, 0}}},
                                 {"left armhole, front", {{2, 3, 0, 1}}, {{0, 2, 1, 0}}},
                                 {"left armhole, back", {{2, 2, 0, 1}}, {{1, 6, 1, 0}}},
                                 {"left sleeve", {{2, 1, 0, 1}}, {{2, 4, 1, 0}}},
                                 {"right armhole, front", {{3, 2, 0, 1}}, {{0, 6, 1, 0}}},
                                 {"right armhole, back", {{3, 3, 0, 1}}, {{1, 2, 1, 0}}},
                                 {"right sleeve", {{3, 1, 0, 1}}, {{3, 4, 1, 0}}}});
}

inline FlatPattern shirt(const Size& s) {
  FlatPattern p;
  p.name = "shirt";
  addShirt(p, s, 0.66);
  checkPattern(p);
  return p;
}

/// Legs whose outer side is on the right (as the left leg seen from the front): 0 hem, 1 outer side, 2 waist, 3 centre,
/// 4 inner side; mirrored ones: 0 hem, 1 inner side, 2 centre, 3 waist, 4 outer side.
inline Panel leg(const std::string& name, const std::string& region, bool mirrored, double fork, const Size& s) {
  const double k = s.scale, w = k * s.quarter_chest, in = 0.76 * k, up = in + 0.27 * k, hem = 0.2 * k;
  const Vec2 bend{0.005 * k, in + 0.02 * k};
  if (!mirrored)
    return panel(name, region,
                 {edge(0.03 * k, 0), edge(0.03 * k + hem, 0), edge(w, up), curve(0, up, bend), edge(-fork, in)});
  return panel(
      name, region,
      {edge(-0.03 * k - hem, 0), edge(-0.03 * k, 0), curve(fork, in, {-bend.x, bend.y}), edge(0, up), edge(-w, up)});
}
inline void addTrousers(FlatPattern& p, const Size& s) {
  const int first = static_cast<int>(p.panels.size()), lf = first, rf = first + 1, lb = first + 2, rb = first + 3;
  const double k = s.scale;
  p.panels.push_back(leg("left leg front", "left_leg_front", false, 0.05 * k, s));
  p.panels.push_back(leg("right leg front", "right_leg_front", true, 0.05 * k, s));
  p.panels.push_back(leg("left leg back", "left_leg_back", true, 0.1 * k, s));
  p.panels.push_back(leg("right leg back", "right_leg_back", false, 0.1 * k, s));
  p.seams.insert(p.seams.end(), {{"left outer side", {{lf, 1, 0, 1}}, {{lb, 4, 1, 0}}},
                                 {"left inner side", {{lf, 4, 0, 1}}, {{lb, 1, 1, 0}}},
                                 {"right outer side", {{rf, 4, 0, 1}}, {{rb, 1, 1, 0}}},
                                 {"right inner side", {{rf, 1, 0, 1}}, {{rb, 4, 1, 0}}},
                                 {"centre front", {{lf, 3, 0, 1}}, {{rf, 2, 1, 0}}},
                                 {"centre back", {{rb, 3, 0, 1}}, {{lb, 2, 1, 0}}}});
}
inline FlatPattern trousers(const Size& s) {
  FlatPattern p;
  p.name = "trousers";
  addTrousers(p, s);
  checkPattern(p);
  return p;
}

/// A shirt that ends at the waist, where trousers are sewn to it.
inline FlatPattern jumpsuit(const Size& s) {
  FlatPattern p;
  p.name = "jumpsuit";
  addShirt(p, s, 0.46);
  addTrousers(p, s);
  p.seams.push_back({"waist front", {{0, 0, 0, 1}}, {{5, 3, 1, 0}, {4, 2, 1, 0}}});
  p.seams.push_back({"waist back", {{1, 0, 0, 1}}, {{6, 3, 1, 0}, {7, 2, 1, 0}}});
  checkPattern(p);
  return p;
}

}  // namespace gambeson::region_patterns
