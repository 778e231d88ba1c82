#include "core/yarn/rod_cell.hpp"

#include <algorithm>
#include <cmath>

#include "core/yarn/line_contact.hpp"

namespace gambeson {
namespace {

using Block = std::array<double, 9>;

Mat3 minus(const Mat3& m) { return {-m.a, -m.b, -m.c}; }

/// Aᵀ B C of a block by rows.
Block between(const Mat3& A, const Block& B, const Mat3& C) {
  const Mat3 rows{{B[0], B[1], B[2]}, {B[3], B[4], B[5]}, {B[6], B[7], B[8]}};  // Bᵀ by columns
  const Mat3 CtBt = transpose(C) * rows;                                        // (B C)ᵀ
  const Mat3 product = transpose(A) * transpose(CtBt);
  return {product.a.x, product.b.x, product.c.x, product.a.y, product.b.y,
          product.c.y, product.a.z, product.b.z, product.c.z};
}

}  // namespace

RodCell::Placed RodCell::place(const CellFaces& faces, std::span<const Pose> sections, const Image& image) {
  const Pose& own = sections[image.section];
  if (image.power == 0) return {own, {}, {}};
  const Pose& g = faces.step[image.direction];
  if (image.power == 1) return {g * own, g.rotation, {}};
  const Mat3 back = transpose(g.rotation);
  return {inverse(g) * own, back, minus(back)};
}

Vec3 RodCell::originOf(const CellFaces& faces, std::span<const Pose> sections, const Image& image) {
  const Vec3& own = sections[image.section].origin;
  if (image.power == 0) return own;
  const Pose& g = faces.step[image.direction];
  return image.power == 1 ? g * own : inverse(g) * own;
}

int RodCell::sectionsOf(int direction) const { return design_.pieces_per_spacing * yarns().crossings(direction); }

int RodCell::firstSection(int direction, int k) const {
  return k * sectionsOf(direction) + (direction == along_warp ? yarns().weave.wefts * sectionsOf(along_weft) : 0);
}

/// Section i of a yarn that goes on for ever: i from -n to 2 n - 1.
RodCell::Image RodCell::imageOf(int direction, int k, int i) const {
  const int n = sectionsOf(direction), power = i < 0 ? -1 : i >= n ? 1 : 0;
  return {firstSection(direction, k) + i - power * n, direction, power};
}

double RodCell::yarnLength_m(int direction, int k) const {
  double sum = 0;
  for (int i = 0; i < sectionsOf(direction); ++i) sum += pieces_[firstSection(direction, k) + i].piece.length_m;
  return sum;
}

double RodCell::reach_m() const { return std::hypot(yarns().period_m(along_weft), yarns().period_m(along_warp)); }

BlockMatrix RodCell::sparsity(std::span<const int> pairs) const {
  std::vector<std::vector<int>> rows(static_cast<std::size_t>(blocks()));
  for (int r = 0; r < blocks(); ++r) rows[r].push_back(r);
  const auto join = [&](const std::vector<int>& together) {
    for (int r : together)
      for (int c : together)
        if (r < c) rows[r].push_back(c);
  };
  const int faces = 2 * sections();
  for (const Piece& p : pieces_) {
    std::vector<int> together{2 * p.a.section, 2 * p.a.section + 1, 2 * p.b.section, 2 * p.b.section + 1};
    if (p.b.power != 0) together.push_back(faces + p.direction);
    join(together);
  }
  const bool turns = design_.friction.coefficient > 0 || design_.touch == RodTouch::section;
  for (const int k : pairs) {
    const Pair& p = pairs_[k];
    std::vector<int> together{2 * p.first.section, 2 * p.second.section};
    if (turns) together.insert(together.end(), {2 * p.first.section + 1, 2 * p.second.section + 1});
    for (const Image* image : {&p.first, &p.second})
      if (image->power != 0) together.push_back(faces + image->direction);
    join(together);
  }
  BlockMatrix K;
  for (std::vector<int>& row : rows) {
    std::sort(row.begin(), row.end());
    row.erase(std::unique(row.begin(), row.end()), row.end());
    K.columns.insert(K.columns.end(), row.begin(), row.end());
    K.offsets.push_back(static_cast<long>(K.columns.size()));
  }
  K.values.assign(9 * K.columns.size(), 0.0);
  return K;
}

namespace {

/// One of the blocks that a vector of an element moves with, and how: v = by u.
struct Part {
  int vector;  ///< of the element
  int block;
  Mat3 by;
};

/// Adds the second derivative in the vectors of an element, each given by a part or two.
template <class Entry>
void addBlocks(const std::vector<Part>& parts, const Entry& entry, BlockMatrix& K) {
  for (const Part& p : parts)
    for (const Part& q : parts)
      if (p.block <= q.block) K.add(p.block, q.block, between(p.by, entry(p.vector, q.vector), q.by));
}

/// Of the tangent of an element of four vectors.
Block blockOf(const std::array<double, 144>& tangent, int p, int q) {
  Block block;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) block[3 * i + j] = tangent[12 * (3 * p + i) + 3 * q + j];
  return block;
}

Mat3 scaled(double s) { return {{s, 0, 0}, {0, s, 0}, {0, 0, s}}; }

}  // namespace

/// What elements add to an answer and its second derivatives.
struct RodCell::Sum {
  const RodCell& cell;
  const CellFaces& faces;
  std::span<const Pose> sections;
  CellAnswer& out;
  BlockMatrix* K;
  bool downhill;
  double balanced = 0;
  std::vector<Part> parts{};

  int faceBlock() const { return 2 * cell.sections(); }
  double perLength() const { return 1 / cell.turnLength_m(); }

  /// The force on a vector that a place is: to its section and its face.
  void addForce(const Image& image, const Placed& at, const Vec3& force) {
    out.gradient[2 * image.section] += transposeTimes(at.by_x, force);
    balanced += norm2(force);
    if (image.power == 0) return;
    out.gradient[faceBlock() + image.direction] += transposeTimes(at.by_t, force);
    const Pose& g = faces.step[image.direction];
    const Vec3& own = sections[image.section].origin;
    out.face_moment_Nm[image.direction] +=
        image.power == 1 ? cross(g.rotation * own, force) : -cross(own - g.origin, g.rotation * force);
  }
  /// The moment, about its axes, on the turn of a section.
  void addMoment(const Image& image, const Placed& at, const Vec3& moment) {
    const Vec3 force = moment / cell.turnLength_m();
    out.gradient[2 * image.section + 1] += force;
    balanced += norm2(force);
    if (image.power == 0) return;
    const Vec3 in_space = at.pose.rotation * moment;
    out.face_moment_Nm[image.direction] +=
        image.power == 1 ? in_space : -(faces.step[image.direction].rotation * in_space);
  }
  void addParts(const Image& image, const Placed& at, int vector) {
    parts.push_back({vector, 2 * image.section, at.by_x});
    if (image.power != 0) parts.push_back({vector, faceBlock() + image.direction, at.by_t});
  }
  /// Of an element of two sections: its derivatives in (x1, turn1, x2, turn2).
  void addPair(const Pair& pair, const Placed& first, const Placed& second, const std::array<Vec3, 4>& gradient,
               const std::array<double, 144>& tangent) {
    addForce(pair.first, first, gradient[0]);
    addMoment(pair.first, first, gradient[1]);
    addForce(pair.second, second, gradient[2]);
    addMoment(pair.second, second, gradient[3]);
    if (!K) return;
    parts.clear();
    addParts(pair.first, first, 0);
    addParts(pair.second, second, 2);
    parts.push_back({1, 2 * pair.first.section + 1, scaled(perLength())});
    parts.push_back({3, 2 * pair.second.section + 1, scaled(perLength())});
    addBlocks(
        parts, [&](int p, int q) { return blockOf(tangent, p, q); }, *K);
  }
};

void RodCell::addPieces(Sum& sum) const {
  const double per_length = sum.perLength();
  const RodTangent tangent = !sum.K ? RodTangent::none : sum.downhill ? RodTangent::downhill : RodTangent::exact;
  CellAnswer& out = sum.out;
  for (const Piece& piece : pieces_) {
    const Placed a = place(sum.faces, sum.sections, piece.a), b = place(sum.faces, sum.sections, piece.b);
    const RodAnswer answer = evaluateRod(design_.section[piece.direction], piece.piece, a.pose, b.pose, tangent);
    out.energy_J += answer.energy_J;
    const auto vector = [&](int k) {
      return Vec3{answer.gradient[3 * k], answer.gradient[3 * k + 1], answer.gradient[3 * k + 2]};
    };
    sum.addForce(piece.a, a, vector(0));
    sum.addForce(piece.b, b, vector(2));
    out.gradient[2 * piece.a.section + 1] += per_length * vector(1);
    out.gradient[2 * piece.b.section + 1] += per_length * vector(3);
    sum.balanced += norm2(per_length * vector(1)) + norm2(per_length * vector(3));
    if (piece.b.power == 1) out.face_moment_Nm[piece.direction] += b.pose.rotation * vector(3);
    if (!sum.K) continue;
    sum.parts.clear();
    sum.addParts(piece.a, a, 0);
    sum.addParts(piece.b, b, 2);
    sum.parts.push_back({1, 2 * piece.a.section + 1, scaled(per_length)});
    sum.parts.push_back({3, 2 * piece.b.section + 1, scaled(per_length)});
    addBlocks(
        sum.parts, [&](int p, int q) { return blockOf(answer.tangent, p, q); }, *sum.K);
  }
}

void RodCell::addPairs(Sum& sum, const CellFriction* friction) const {
  std::size_t grip = 0;
  for (std::size_t k = 0; k < pairs_.size(); ++k) {
    const Pair& pair = pairs_[k];
    if (isFar(sum.faces, sum.sections, pair) &&
        !(friction && grip < friction->grips.size() && friction->grips[grip].pair == static_cast<int>(k)))
      continue;
    const Placed first = place(sum.faces, sum.sections, pair.first),
                 second = place(sum.faces, sum.sections, pair.second);
    const bool gripped = friction && grip < friction->grips.size() && friction->grips[grip].pair == static_cast<int>(k);
    const double limit = gripped ? design_.friction.coefficient * friction->normal_N[grip] : 0;
    const bool touching = touches(pair, first.pose, second.pose, 0);
    if (touching || limit > 0) sum.out.touching.push_back(static_cast<int>(k));
    if (limit > 0) {
      const PairGrip& held = friction->grips[grip];
      const auto& [v1, v2] = held.aside_m;
      const RodFrictionAnswer answer = fromAside(
          evaluateRodFriction(held.grip, movedAside(first.pose, v1), movedAside(second.pose, v2),
                              design_.friction.stick_stiffness_N_per_m3 * pair.lengths_m2, limit, sum.K != nullptr),
          first.pose, second.pose, held.aside_m, sum.K != nullptr);
      sum.out.energy_J += answer.energy_J;
      sum.addPair(pair, first, second, answer.gradient, answer.tangent);
    }
    grip += gripped;
    if (!touching) continue;
    if (design_.touch == RodTouch::section) {
      SectionPair answer = evaluateSections(pair, first.pose, second.pose, sum.K != nullptr);
      sum.out.energy_J += pair.lengths_m2 * answer.energy;
      for (Vec3& g : answer.gradient) g *= pair.lengths_m2;
      for (double& t : answer.tangent) t *= pair.lengths_m2;
      sum.addPair(pair, first, second, answer.gradient, answer.tangent);
      continue;
    }
    const Vec3 apart = first.pose.origin - second.pose.origin;
    const double distance = norm(apart);
    const LineContact contact = lineContact(design_.compression, touch_m_, distance);
    sum.out.energy_J += pair.lengths_m2 * contact.energy;
    const Vec3 u = apart / distance, force = pair.lengths_m2 * contact.first * u;
    sum.addForce(pair.first, first, force);
    sum.addForce(pair.second, second, -force);
    if (!sum.K) continue;
    sum.parts.clear();
    sum.addParts(pair.first, first, 0);
    sum.addParts(pair.second, second, 1);
    const double across = pair.lengths_m2 * contact.first / distance, along = pair.lengths_m2 * contact.second;
    addBlocks(
        sum.parts,
        [&](int p, int q) {
          Block block;
          for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
              block[3 * i + j] = (p == q ? 1 : -1) * ((i == j ? across : 0) + (along - across) * u[i] * u[j]);
          return block;
        },
        *sum.K);
  }
}

void RodCell::evaluate(const CellFaces& faces, std::span<const Pose> sections, CellAnswer& out, BlockMatrix* K,
                       bool downhill, const CellFriction* friction) const {
  out.energy_J = 0;
  out.gradient.assign(static_cast<std::size_t>(blocks()), Vec3{});
  out.face_moment_Nm = {};
  out.touching.clear();
  if (K) std::fill(K->values.begin(), K->values.end(), 0.0);
  Sum sum{*this, faces, sections, out, K, downhill};
  addPieces(sum);
  addPairs(sum, friction);
  out.balanced_N = std::sqrt(sum.balanced);
}

RodAnswer RodCell::pieceAt(const CellFaces& faces, std::span<const Pose> sections, int direction, int k, int i) const {
  const Piece& p = pieces_[firstSection(direction, k) + i];
  return evaluateRod(design_.section[direction], p.piece, place(faces, sections, p.a).pose,
                     place(faces, sections, p.b).pose, RodTangent::none);
}

}  // namespace gambeson
