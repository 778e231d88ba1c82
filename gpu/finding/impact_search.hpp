#pragma once
/// All impacts of a mesh with itself over a step, on any device.

#include <array>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/contact/certified_impact.hpp"
#include "gpu/finding/flat_mesh.hpp"
#include "gpu/finding/pair.hpp"

namespace gambeson::gpu {

/// How pairs whose boxes meet are found. All find the same, but for `vssPieces`, which finds fewer and the same hits.
enum class Broad {
  lbvh,       ///< trees of boxes (lbvh.hpp)
  vss,        ///< cells of one size, by what triangles are on the mean (Wong 2014, chapter 5)
  vssPieces,  ///< the same; triangles that are large for them cover only the cells of their pieces, as he has it
  otg,        ///< an octree of cells, cut where triangles are many (chapter 6)
  grid,       ///< cells of one size, by the largest triangle (section 3.3.1)
};

/// What is compared.
enum class Bounds {
  boxes,
  polytopes,  ///< of 18 faces too: fewer pairs, the same hits
};

struct SearchOptions {
  double separation_m = 0;
  double tolerance_m = kImpactTolerance_m;
  double margin_m = 0;        ///< by which each box is grown; at least half of the separation
  int queries_per_group = 0;  ///< while boxes are sought in the tree, at most 16; 0: what is quick. Finds the same
  Broad broad = Broad::lbvh;
  Bounds bounds = Bounds::boxes;
  unsigned long long cells_room = 0;  ///< of lists of cells at first; 0: what is mostly enough
};

/// Of one kind of pair: lengths of lists, or their room.
struct ListSizes {
  unsigned long long pairs = 0;  ///< whose boxes meet
  unsigned long long open = 0;   ///< left by boxes and coplanarity
  unsigned long long hard = 0;   ///< left by the first look
  unsigned long long hits = 0;
  bool operator==(const ListSizes&) const = default;
};
using BothSizes = std::array<ListSizes, kPairKinds>;

enum class Trees { rebuilt, refitted };
enum class Part { all, broad };  ///< of a pass

/// What a broad phase did in a pass.
struct BroadFacts {
  unsigned long long tests = 0;                      ///< of boxes with nodes of a tree, or of two triangles in a cell
  unsigned long long boxes_of_triangles = 0;         ///< of these tests, those that are not left to another cell
  unsigned long long pairs_of_triangles = 0;         ///< whose boxes meet
  unsigned long long boxes_of_features = 0;          ///< compared then
  unsigned long long registrations = 0;              ///< of triangles in cells
  std::vector<unsigned long long> registrations_of;  ///< by level of the octree, the coarsest first
  std::size_t bytes = 0;                             ///< of its own arrays, without the pairs that it gives
};

class ImpactSearch {
 public:
  virtual ~ImpactSearch() = default;

  virtual void setMotion(std::span<const Vec3> x0, std::span<const Vec3> x1) = 0;
  /// One pass. Where a list runs over, it is repeated with twice the room, or what the pass is known to need.
  virtual void find(Trees trees) = 0;

  /// Of the last pass.
  virtual BothSizes sizes() = 0;
  virtual std::vector<Pair> pairs(PairKind kind) = 0;  ///< in any order
  virtual std::vector<Hit> hits(PairKind kind) = 0;    ///< sorted
  virtual int repeats() const = 0;                     ///< of passes, for want of room, since the start
  virtual BroadFacts broadFacts() = 0;                 ///< by kernels that count

  /// Median of so many passes, without the host between them and nothing waited for.
  virtual double medianMilliseconds(Trees trees, int passes, Part part = Part::all) = 0;
  struct StageTime {
    std::string name;
    double median_ms;
  };
  /// Each stage alone.
  virtual std::vector<StageTime> stageTimes(int passes) = 0;
};

/// A query by itself: no impact, or when.
struct ImpactAnswer {
  bool meets;
  ImpactTime hit;
};
struct ImpactQuestion {
  FourPoints x0, x1;  ///< a point and a triangle, or two edges
  PairKind kind;
  double separation_m, tolerance_m;
};

/// `positions`: where the trees start from; any will do, those of the first step are best.
std::unique_ptr<ImpactSearch> searchOnReference(const Mesh& mesh, std::span<const Vec3> positions,
                                                const SearchOptions& options, const BothSizes& room);
std::vector<ImpactAnswer> answersOnReference(std::span<const ImpactQuestion> questions);

/// Whether this build has CUDA; without, what follows throws RunError.
bool cudaBuilt();
/// Name of the device. Throws RunError where there is none.
std::string cudaDevice();
/// groups_per_block: 1 or 4; no matter to what is found.
std::unique_ptr<ImpactSearch> searchOnCuda(const Mesh& mesh, std::span<const Vec3> positions,
                                           const SearchOptions& options, const BothSizes& room,
                                           int groups_per_block = 4);
std::vector<ImpactAnswer> answersOnCuda(std::span<const ImpactQuestion> questions);

}  // namespace gambeson::gpu
