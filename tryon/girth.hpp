#pragma once
/// How far worn cloth goes around, against how far it does at rest: where a garment is short, and by how much.

#include <span>
#include <string>
#include <vector>

#include "core/cloth/surface.hpp"

namespace gambeson {

/// A piece of cloth cut at a height, across sewn seams too: all of it that hangs together there.
struct Girth {
  double height_m = 0;
  double rest_m = 0;    ///< length of the cut on the cloth at rest
  double worn_m = 0;    ///< and as it is worn
  Vec3 middle_m;        ///< of the cut, worn
  bool closed = false;  ///< it goes all the way around

  double short_m() const { return worn_m - rest_m; }
};

/// The cuts of cloth at a height along `up` (unit). `rest`, `worn`: positions of the samples.
std::vector<Girth> girthsAt(const Surface& surface, std::span<const Vec3> rest, std::span<const Vec3> worn, Vec3 up,
                            double height_m);

/// Of all heights, `step_m` apart, closed cuts that are stretched by more than `part` of their length, the most
/// stretched within each 10 cm, from the shortest on, at most `most` of them. Cuts of less than 10 cm, or short by less
/// than 1 mm, are none.
std::vector<Girth> shortGirths(const Surface& surface, std::span<const Vec3> rest, std::span<const Vec3> worn, Vec3 up,
                               double part, std::size_t most = 3, double step_m = 0.01);

/// "at a height of 0.96 m it is 94.1 cm around and worn 98.3 cm: 4.2 cm short"; empty for none.
std::string shortText(std::span<const Girth> girths);

}  // namespace gambeson
