#pragma once
/// What is blunt on bodies that deform, and surely stays so for a while.

#include <array>
#include <span>
#include <vector>

#include "core/contact/box.hpp"
#include "core/contact/contact_mesh.hpp"
#include "core/contact/moving_box.hpp"
#include "core/contact/pairs.hpp"

namespace gambeson {

/// Sharp edges and corners (sharp.hpp) of a body that deforms are those of the moment. Nearly all of a skin is blunt
/// and stays so: which edges and corners do as long as no edge around them, as a vector, changes by more than it may.
///
/// Edges. Let u1, u2 be the unit vectors in two faces across their common edge e, h1, h2 the heights of the faces over
/// it and f1, f2 their other edges at e's first end. An edge is sharp where |u1 + u2| > 2 s. With P the projection
/// across e, h u = P f. Where no edge of the two faces changes by more than d, P changes by no more than d/|e| (the
/// sine of the angle by which e turns), P f by no more than d (1 + |f|/|e|), and a vector's direction by no more than
/// twice its change over its length. So |u1 + u2| changes by no more than 2 d sum_i (1 + |f_i|/|e|)/h_i.
///
/// Corners. With unit vectors a_k along the edges at a corner, it is sharp only where some unit vector has a_k . n > s
/// for all k, so that every mean of them (weights >= 0, sum 1) is longer than s. Where edges change by no more than d,
/// a mean changes by no more than 2 d / min |e_k|.
class Bluntness {
 public:
  Bluntness() = default;
  /// `deforms` marks the vertices of bodies that deform.
  Bluntness(const ContactMesh& mesh, std::span<const char> deforms);

  bool empty() const { return edges_.empty(); }
  /// Asks for a motion, about which `features` are then right for as long as `holds` does. What lies outside of `where`
  /// at motion.x is not looked at: it counts as sharp.
  void ask(const ContactMesh& mesh, const ListedMotion& motion, const Box& where);
  /// What counts as blunt is so at x.
  bool holds(std::span<const Vec3> x) const { return holds(x, {}, 0); }
  const BluntFeatures& features() const { return features_; }

 private:
  struct Watch {
    int a = 0, b = 0;
    float x = 0, y = 0, z = 0;  ///< from a to b when asked
    float most2 = 0;            ///< squared change that is allowed for
  };
  bool holds(std::span<const Vec3> x, std::span<const Vec3> velocity, double time_s) const;
  double edgeRoom(const ContactMesh& mesh, std::span<const Vec3> x, int edge) const;
  double cornerRoom(const ContactMesh& mesh, std::span<const Vec3> x, int vertex) const;

  std::vector<int> edges_, vertices_;  ///< of bodies that deform
  BluntFeatures features_;
  std::vector<Watch> watched_;
  std::vector<double> way_m_;                        ///< of each edge, by which its vector is expected to change
  std::vector<double> edge_room_m_, corner_room_m_;  ///< of all edges and vertices; infinite where not blunt
};

}  // namespace gambeson
