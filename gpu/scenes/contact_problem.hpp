#pragma once
/// Contact solves by themselves, to compare and to time: made up, or recorded.

#include <string>
#include <vector>

#include "core/contact/response.hpp"

namespace gambeson::gpu {

/// Rows with what `iterate` (core/contact/contact_iteration.hpp) needs to know of the cloth. Of each row: area, slope
/// and friction as the solve has them, and the traction it starts with.
struct ContactProblem {
  std::string name;
  std::vector<ContactRow> rows;
  SparseRows WT;
  std::vector<double> inverse_mass;
  std::vector<int> place;      ///< of the samples (halving.hpp); none: no island is cut
  std::vector<Vec3> velocity;  ///< of the free points
  std::vector<double> area, slope, friction;
  std::vector<Vec3> traction;
  double goal_m_per_s = 0;
};

/// All rows of the problem, by islands and colours, at the start of the iteration.
void startProblem(const ContactProblem& problem, ContactWork& work);

/// A stack of square sheets of quadratic cells, four samples a cell, the lowest on a body and each other on the one
/// below. Normals, drift and velocities are random; about `share` of the rows are there.
struct StackSize {
  int layers = 1, cells = 1;
  double share = 1;
};
ContactProblem contactStack(const StackSize& size, std::uint64_t seed = 5);

/// Several problems as one, islands beside each other.
ContactProblem besides(const std::vector<ContactProblem>& problems);

/// The iterations that steps along the gradient take to the goal (accelerated, restarted, each row bounded by the sum
/// over the rows that carry something: what core did before it took sweeps), at most `most`: of each island.
std::vector<int> gradientIterations(const ContactProblem& problem, const ContactWork& work, int most);

}  // namespace gambeson::gpu
