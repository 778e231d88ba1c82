#pragma once
/// Recorded frames as scenes to draw, one after the other: pictures and films are made of them.

#include "analysis/render/shot.hpp"
#include "cases/wear/results/results.hpp"
#include "cases/wear/results/shown.hpp"
#include "cases/wear/scene/placed_bodies.hpp"

namespace gambeson {

/// Cloth whose samples lie deeper in a body than this is drawn in a colour of its own: the bound of the check
/// "Penetration".
inline constexpr double kPenetration_m = 0.2e-3;

struct DrawnFrame {
  Scene scene;
  Shot shot;  ///< its note: where cloth is inside of a body
};

class FrameScenes {
 public:
  /// Both outlive it.
  FrameScenes(const Scenario& scenario, const RecordingReader& recording);

  /// The frame from a viewpoint, in colours from `low` (in the unit of the bar) to the scale's end, framed around the
  /// middle of what the picture shows.
  ///
  /// Cloth that touches a body is drawn before it: its vertices stand the distance that contact keeps nearer to the
  /// viewer, across the cloth. Facets between them would else sink into a round body. Vertices inside of a body come
  /// before it by as much as they are deep; where that is more than kPenetration_m they are marked.
  DrawnFrame at(int frame, const PictureCase& picture, const Viewpoint& from, const PictureScale& scale,
                double low = 0);

  /// What is said of cloth that is marked as being inside of a body in this frame; nothing where none is.
  std::optional<ColorNote> noteOf(int frame);

 private:
  std::vector<double> depths(const std::vector<Vec3>& x) const;
  ColorNote note() const;
  void addBodies(Scene& scene, double time_s) const;

  const Scenario& s_;
  const RecordingReader& recording_;
  PlacedBodies placed_;
  std::vector<WornMesh> worn_;
  double touching_m_ = 0;  ///< the largest distance that contact keeps
};

/// The box around garments whose samples are at `x`, or around them and all that is the wearer's own body where
/// `placed` has it.
std::array<Vec3, 2> shownBox(const Scenario& s, const PlacedBodies& placed, std::span<const Vec3> x,
                             PictureAround around);
/// What is left free on every side of it [m], for the arrows on garments whose samples are at `x`.
double pictureMargin(std::span<const Vec3> x);
/// Positions of a frame's samples.
std::vector<Vec3> positionsOf(const Frame& frame);
/// Against gravity; z without.
Vec3 upOf(const Scenario& scenario);

}  // namespace gambeson
