#pragma once
/// A repeat of a woven cloth whose yarns are rods: its energy, and how that changes with each of its sections and with
/// the motions that take the cell to its neighbours.

#include <array>
#include <span>
#include <vector>

#include "core/math/block_matrix.hpp"
#include "core/math/sparse.hpp"
#include "core/yarn/cell_faces.hpp"
#include "core/yarn/cell_friction.hpp"
#include "core/yarn/compression.hpp"
#include "core/yarn/rod.hpp"
#include "core/yarn/section_contact.hpp"
#include "core/yarn/woven_yarns.hpp"

namespace gambeson {

/// How much of a plain weave moves by itself. In a quarter (Man 2006, fig. 19c) one crossing does, and its neighbours
/// are its images under a glide: on by a spacing and mirrored in the middle of the cloth,
///   u(X + L) = (u1, u2, -u3)(X),  turns about the section's axes (-a1, -a2, a3).
/// Plain weaves keep this symmetry under any strain of the plane, unless they buckle; no bend has it.
enum class CellExtent { full, quarter };

/// Whether sections in the faces of the cell may move through the cloth. Faces lie half way between crossings; a
/// quarter has them between any two, a full cell at its ends. Held faces (Man 2006, section 4.3.5.3) keep the height of
/// all points of their sections, which can only move in the cloth and turn about its normal; they stiffen the cell and
/// are of flat cloth alone.
enum class FaceSupport { glide, held };

/// Where rods press on each other. axis: along their middles, by the thickness of sections (line_contact.hpp); yarns
/// side by side do not touch. section: over the ellipses of the sections, also side by side (section_contact.hpp).
enum class RodTouch { axis, section };

struct RodCellDesign {
  WovenYarns yarns;
  std::array<RodSection, 2> section;  ///< by YarnDirection
  bool contact = true;                ///< false: yarns pass through each other
  LateralCompression compression;     ///< where they do not
  RodTouch touch = RodTouch::axis;
  FaceSupport faces = FaceSupport::glide;
  /// Of each yarn between neighbours of the other direction; even, 4 to 256. Contact is a sum over pairs of sections:
  /// with fewer than 16 yarns catch on each other's sections, and a lightly pressed crossing may be unstable; with 16
  /// its shear stiffness may still be negative, by some 5e-4 of that along the yarns.
  int pieces_per_spacing = 24;
  CellExtent extent = CellExtent::full;
  RodFriction friction;  ///< where contact is, of yarns that cross
};

/// What a cell answers. Blocks of three unknowns: of section i the place x [m] (block 2 i) and the turn about its own
/// axes times the cell's `turn_length` [m] (block 2 i + 1), after all sections the translations of the faces 1 and 2.
struct CellAnswer {
  double energy_J = 0;
  std::vector<Vec3> gradient;          ///< by block [N]
  std::array<Vec3, 2> face_moment_Nm;  ///< dW = face_moment . w of a spin w of face 1 or 2 about the origin
  double balanced_N = 0;               ///< the size of the forces that balance in the gradient
  std::vector<int> touching;           ///< pairs of points in contact or held by friction, ascending
};

/// The cell is constant; callers own its sections and faces. Yarns are without force where they lie at rest. Yarns that
/// cross press on each other (RodTouch) and hold each other by friction (rod_friction.hpp), both by sums over pairs of
/// sections.
class RodCell {
 public:
  /// Throws InputError where the yarns cannot lie so (checkWovenYarns), a section stretches, shears or bends without
  /// stiffness (keys "weft.section.stretch" and so on; torsion may have none), the law of compression is out of range
  /// (checkCompression), friction is (checkRodFriction), "pieces_per_spacing" is, or "extent" is a quarter of no plain
  /// weave.
  explicit RodCell(const RodCellDesign& design);

  const RodCellDesign& design() const { return design_; }
  const WovenYarns& yarns() const { return design_.yarns; }
  double area_m2() const { return yarns().area_m2(); }
  int sections() const { return static_cast<int>(rest_.size()); }
  int blocks() const { return 2 * sections() + 2; }
  std::span<const Pose> rest() const { return rest_; }
  /// Sections of yarn k of a direction, in order along it: the first of them, and how many.
  int firstSection(int direction, int k) const;
  int sectionsOf(int direction) const;
  /// Length of yarn k in one repeat, at rest [m].
  double yarnLength_m(int direction, int k) const;
  double turnLength_m() const { return turn_length_m_; }
  /// The greatest extent of the cell [m], to which positions are rounded.
  double reach_m() const;

  /// From all blocks to the unknowns of the sections: the rows of held components are empty.
  const SparseRows& freedoms() const { return freedoms_; }

  /// Where K is given it has the sparsity of `sparsity` with at least the pairs that touch; `downhill`: RodTangent's.
  /// Where `friction` is given the energy holds its potential since the last accepted load, and its forces take part.
  void evaluate(const CellFaces& faces, std::span<const Pose> sections, CellAnswer& out, BlockMatrix* K = nullptr,
                bool downhill = false, const CellFriction* friction = nullptr) const;
  int pairs() const { return static_cast<int>(pairs_.size()); }
  /// The sections of a pair, or their images, the force that presses between them where they cross, and where on the
  /// second axes of both sections they meet.
  struct PairPlace {
    Pose first, second;
    double lengths_m2, normal_N;
    std::array<double, 2> aside_m;
  };
  PairPlace pairAt(const CellFaces& faces, std::span<const Pose> sections, int pair) const;
  /// Pairs that touch, or will when their points are nearer by this part of their distance.
  std::vector<int> nearPairs(const CellFaces& faces, std::span<const Pose> sections, double part) const;
  BlockMatrix sparsity(std::span<const int> pairs) const;

  /// Tension, shears [N] and torque, moments [N m] half way between the sections i and i + 1 of a yarn.
  RodAnswer pieceAt(const CellFaces& faces, std::span<const Pose> sections, int direction, int k, int i) const;

 private:
  /// A section, or its image in the next cell (power 1) or the one before (-1) along the yarn's own direction.
  struct Image {
    int section, direction, power;
  };
  struct Piece {
    RodPiece piece;
    int direction;
    Image a, b;
  };
  struct Pair {
    Image first, second;  ///< of weft and warp, or of neighbours
    double lengths_m2;    ///< of both yarns for which the pair stands
    double above = 0;     ///< 1 where the weft lies above, -1 where below; 0: side by side
  };
  /// An image in space, and how it moves: dx' = by_x dx + by_t dt.
  struct Placed {
    Pose pose;
    Mat3 by_x;
    Mat3 by_t;  ///< where power is not 0
  };

  static Placed place(const CellFaces& faces, std::span<const Pose> sections, const Image& image);
  static Vec3 originOf(const CellFaces& faces, std::span<const Pose> sections, const Image& image);
  Image imageOf(int direction, int k, int i) const;
  double shareOf(int direction, int k, int i) const;
  void addYarns();
  void addPairs();
  void addNeighbours();
  void addFreedoms();

  struct Sum;
  void addPieces(Sum& sum) const;
  void addPairs(Sum& sum, const CellFriction* friction) const;
  bool isFar(const CellFaces& faces, std::span<const Pose> sections, const Pair& pair, double part = 0) const;
  bool touches(const Pair& pair, const Pose& first, const Pose& second, double part) const;
  SectionPair evaluateSections(const Pair& pair, const Pose& first, const Pose& second, bool tangent) const;

  RodCellDesign design_;
  std::vector<Pose> rest_;
  std::vector<Piece> pieces_;
  std::vector<Pair> pairs_;
  SparseRows freedoms_;
  CrossingContact crossing_;
  std::array<BesideContact, 2> beside_;  ///< by direction
  double turn_length_m_ = 0, touch_m_ = 0, crossing_reach_m_ = 0;
};

}  // namespace gambeson
