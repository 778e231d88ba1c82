#include "tryon/pattern/turn.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace gambeson {

double largestTurn(const NurbsPatch& patch) {
  constexpr int looks = 5;
  const std::vector<double> u = breakpoints(patch.u), v = breakpoints(patch.v);
  double least = 1;  // cosine
  std::vector<Vec3> normals;
  for (std::size_t j = 0; j + 1 < v.size(); ++j)
    for (std::size_t i = 0; i + 1 < u.size(); ++i) {
      normals.clear();
      for (int b = 0; b < looks; ++b)
        for (int a = 0; a < looks; ++a) {
          const auto d = surfaceDerivatives(patch, u[i] + (u[i + 1] - u[i]) * (a + 0.5) / looks,
                                            v[j] + (v[j + 1] - v[j]) * (b + 0.5) / looks);
          normals.push_back(normalized(cross(d[1], d[2])));
        }
      for (std::size_t a = 0; a < normals.size(); ++a)
        for (std::size_t b = 0; b < a; ++b) least = std::min(least, dot(normals[a], normals[b]));
    }
  return std::acos(std::clamp(least, -1.0, 1.0));
}

}  // namespace gambeson
