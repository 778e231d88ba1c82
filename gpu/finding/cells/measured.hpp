#pragma once
/// The triangles of a mesh over a step: their boxes, which cells these cover, and how much work that is.

#include "gpu/device/bytes.hpp"
#include "gpu/finding/cells/frame.hpp"
#include "gpu/finding/cells/shares.hpp"
#include "gpu/finding/float_dop.hpp"
#include "gpu/finding/lbvh.hpp"

namespace gambeson::gpu {

struct DopOwners {
  const Owner* owner;
  const FloatDop* vertex_dop;
  FloatDop* dop;
  GAMBESON_HD void operator()(int i) const { dop[i] = primitiveDop<3>(owner[i].corner, vertex_dop); }
};

template <class Device>
class MeasuredOwners {
 public:
  template <class T>
  using Buffer = typename Device::template Buffer<T>;
  using Queue = typename Device::Queue;

  /// The mesh is another's and outlives this.
  MeasuredOwners(const Mesh& host, FlatMesh<Device>& mesh, float margin_m, Bounds bounds)
      : MeasuredOwners(ownersOf(host), mesh, margin_m, bounds) {}

  Stages<Device> stages() {
    Stages<Device> all = {
        {"boxes", [this](Queue& queue) {
           queue.forEach(mesh_.vertices, BoxVertices{mesh_.point.data(), margin_m_, vertex_box_.data()});
           queue.forEach(1, ClearExtent{extent_.data(), frame_.data()});
           queue.forGroups(groups(), MeasureOwners{owner_.data(), count(), vertex_box_.data(), partsPerM(), box_.data(),
                                                   extent_.data()});
         }}};
    if (dop_.size() > 0)
      all.push_back({"polytopes", [this](Queue& queue) {
                       queue.forEach(mesh_.vertices, DopVertices{mesh_.point.data(), margin_m_, vertex_dop_.data()});
                       queue.forEach(count(), DopOwners{owner_.data(), vertex_dop_.data(), dop_.data()});
                     }});
    return all;
  }

  /// Cells of so many bits along an axis at most, and not smaller than so many radii; coarser where triangles would
  /// cover more than kCellsOfEach each. Then how many of them each covers.
  void frame(Queue& queue, int bits, double mean_radii, double largest_radii) {
    queue.forEach(1,
                  ChooseFinest{extent_.data(), count(), bits, mean_radii, largest_radii, partsPerM(), frame_.data()});
    queue.forGroups(groups(), PlaceOwners{box_.data(), count(), bits, frame_.data(), range_.data()});
    queue.forEach(1, ChooseCoarser{bits, kCellsOfEach * static_cast<Count>(count()), frame_.data()});
    queue.forEach(count() + 1, CountCells{range_.data(), frame_.data(), count(), cells_.data()});
    sum_.run(queue, cells_, cell_sum_);
  }

  int count() const { return static_cast<int>(owner_.size()); }
  int clothVertices() const { return mesh_.cloth_vertices; }
  float margin() const { return margin_m_; }
  const Owner* owner() const { return owner_.data(); }
  const MovingPoint* point() const { return mesh_.point.data(); }
  const FloatBox* vertexBox() const { return vertex_box_.data(); }
  const FloatBox* box() const { return box_.data(); }
  const FloatDop* vertexDop() const { return dop_.size() > 0 ? vertex_dop_.data() : nullptr; }
  const FloatDop* dop() const { return dop_.size() > 0 ? dop_.data() : nullptr; }
  const CellRange* range() const { return range_.data(); }
  const CellFrame* frame() const { return frame_.data(); }
  /// A piece of work for each cell of each triangle.
  Shares shares() const { return {cell_sum_.data(), count()}; }
  std::size_t bytes() const {
    return bytesOf(owner_, vertex_box_, box_, vertex_dop_, dop_, range_, cells_, cell_sum_) + sum_.bytes();
  }

 private:
  static constexpr Count kCellsOfEach = 64;

  MeasuredOwners(const std::vector<Owner>& owners, FlatMesh<Device>& mesh, float margin_m, Bounds bounds)
      : mesh_(mesh),
        margin_m_(margin_m),
        owner_(owners.size()),
        vertex_box_(static_cast<std::size_t>(mesh.vertices)),
        box_(owners.size()),
        vertex_dop_(bounds == Bounds::polytopes ? vertex_box_.size() : 0),
        dop_(bounds == Bounds::polytopes ? owners.size() : 0),
        extent_(1),
        frame_(1),
        range_(owners.size()),
        cells_(owners.size() + 1),
        cell_sum_(owners.size() + 1),
        sum_(count() + 1) {
    Queue queue;
    queue.upload(std::span<const Owner>(owners), owner_);
  }
  int groups() const { return (count() + MeasureOwners::kOfGroup - 1) / MeasureOwners::kOfGroup; }
  /// A 256 x 65,536th of the cube around what the search was made with.
  float partsPerM() const { return 0x1p16f * mesh_.cube.cells_per_m; }

  FlatMesh<Device>& mesh_;
  float margin_m_;
  Buffer<Owner> owner_;
  Buffer<FloatBox> vertex_box_, box_;
  Buffer<FloatDop> vertex_dop_, dop_;
  Buffer<Extent> extent_;
  Buffer<CellFrame> frame_;
  Buffer<CellRange> range_;
  Buffer<Count> cells_, cell_sum_;
  typename Device::template ExclusiveSumOf<Count> sum_;
};

}  // namespace gambeson::gpu
