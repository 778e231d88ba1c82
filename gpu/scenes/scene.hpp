#pragma once
/// Scenes to measure and compare devices with, made by code: the same numbers on every machine, as they take no
/// function of the mathematics library and one generator of random numbers.

#include <string>
#include <vector>

#include "gpu/finding/impact_search.hpp"

namespace gambeson::gpu {

struct Scene {
  std::string name;
  Mesh mesh;
  std::vector<Vec3> x0, x1;  ///< at the start and the end of the step
  SearchOptions options;
};

/// Spheres of 320 triangles, radius 0.12 m, with centres in a cube of side 2 m, each moved by up to 0.12 m along each
/// axis: they pass through each other. Separation 0.
Scene flyingBalls(int count);

/// The same, and every fifth ball flies on, by up to 1.5 m: most ways are short and some go through all of the rest.
Scene longWays(int count);

/// Square pyramids of rings that grow from 4 mm to 0.4 m, with so many vertices around each: triangles of one shape and
/// of sizes from 1 to 100. They are tilted against each other and fall through each other.
Scene gradedPyramids(int count, int around);

/// Wavy square sheets of n x n vertices on each other: cells of 6 mm, sheets 2.5 mm apart; in the step vertices move by
/// some 20 um. Pairs are sought within 2.6 mm, impacts at a separation of 1 um.
Scene wavySheets(int sheets, int n);

/// The upper of two such sheets falls through the lower by 6 mm, and every vertex moves by up to 4 mm along each axis
/// besides: pairs turn, and take many turns of the query.
Scene fallingSheets(int n);

/// Edges of the faces, each once, in order of the larger vertex, then the smaller.
std::vector<std::array<int, 2>> edgesOf(const std::vector<std::array<int, 3>>& faces);

}  // namespace gambeson::gpu
