#pragma once
/// How much room the arrays of a step have.

#include "core/motion/model.hpp"

namespace gambeson {

/// Entries of the arrays that a step fills, stated before the first one. The counts of the model are exact. How many
/// contacts there are each step finds anew: those numbers are bounds for cloth that lies ten sheets deep, several
/// times what the library's cases reach (stack_of_ten has 4.3 rows and 60 listed pairs for each sample). On the host an
/// array that outgrows its room grows; a device repeats the step with twice as much.
struct StepCapacity {
  // Exact.
  int points = 0, held = 0, springs = 0;  ///< of the model: free points, Model::held_points, Model::springs
  int samples = 0;                        ///< of the cloth
  int vertices = 0;                       ///< of the mesh of collisions: samples, then vertices of obstacles
  // Bounds.
  int near = 0;                             ///< samples near obstacles
  int cloth_points = 0, edges = 0;          ///< samples on cloth, edges on edges and on sharp edges of obstacles
  int restoring = 0;                        ///< rows that free intersections
  int hits = 0;                             ///< of samples with ellipsoids, and as many pairs of primitives
  int listed_points = 0, listed_edges = 0;  ///< candidates: points with triangles, edges with edges
  int rows() const { return near + cloth_points + edges + restoring + 2 * hits; }
};

StepCapacity capacityOf(const Model& model);

/// Makes that much room; what is there stays.
void reserve(const StepCapacity& capacity, StepWork& work);

/// Whether the last step kept within it.
bool fits(const StepCapacity& capacity, const StepWork& work);

}  // namespace gambeson
