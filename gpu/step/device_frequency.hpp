#pragma once
/// The largest frequency of a model on a device (core/motion/frequency.cpp): forces at displaced points, by Lanczos.

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "core/motion/step.hpp"
#include "gpu/forces/shell_forces.hpp"
#include "gpu/step/frequency_kernels.hpp"
#include "gpu/step/side_sums.hpp"

namespace gambeson::gpu {

/// All arrays are its own; of `forces` it reads what does not change, and its scratch. The host waits twice: for the
/// tridiagonal matrix, and for the mode.
///
/// Beside core's order of the same: new directions lose what they have of all others at once, twice, and the mode is
/// made a unit vector before its stiffness is shared out. The digits are core's but for rounding.
template <class Device>
class DeviceFrequency {
  template <class T>
  using Buffer = typename Device::template Buffer<T>;
  using Queue = typename Device::Queue;

 public:
  DeviceFrequency(Queue& queue, const Model& model, ShellForces<Device>& forces)
      : n_(model.freeCount()),
        all_(forces.points()),
        forces_(forces),
        laws_(forces.steepest(dynamic_cast<const NurbsShell&>(*model.cloth), kTerms)),
        root_(size(n_)),
        mode_(size(n_)),
        vector_(size(n_)),
        free_(size(n_)),
        moved_(size(n_)),
        position_(size(all_)),
        before_(size(all_)),
        after_(size(all_)),
        force_before_(size(all_)),
        force_after_(size(all_)),
        lengths_(1, n_) {
    std::vector<double> root;
    for (const double inverse : model.inverse_mass) root.push_back(std::sqrt(inverse));
    queue.upload(std::span<const double>(root), root_);
    std::vector<Point4> start;
    for (const double w : forces.weights()) start.push_back({0, 0, 0, w});
    queue.upload(std::span<const Point4>(start), position_);
  }

  /// largestFrequency with the free points at `position`, on the device; null: at `p`.
  Frequency at(Queue& queue, const Point4* position, std::span<const Vec3> p, std::vector<Vec3>& mode, int iterations) {
    makeRoom(iterations);
    if (!position) {
      std::vector<Point4> all;
      for (const Vec3& x : p) all.push_back({x.x, x.y, x.z, 0.0});
      queue.upload(std::span<const Point4>(all), free_);
      position = free_.data();
    }
    queue.forEach(all_, PlaceAll{forces_.map(), forces_.allFree(), position, position_.data()});
    const bool warm = mode.size() == size(n_);
    if (warm) queue.uploadLater(std::span<const Vec3>(mode), mode_);
    queue.forEach(n_, StartVector{root_.data(), warm ? mode_.data() : nullptr, noiseOfLanczos(n_), vector_.data()});
    takeUnit(queue, basis_.data(), found(kStart));
    for (int k = 0; k < iterations; ++k) {
      times(queue, &laws_[kAll], true);
      if (k + 1 == iterations) {
        product(queue, basis_.data(), k, found(kNumbers + 2 * k));
        break;
      }
      for (const int pass : {0, 1}) {
        const NumberSum* const overlaps =
            overlaps_.run(queue, k + 1, n_, OverlapOf{basis_.data(), 0, n_, vector_.data()});
        queue.forEach(n_, TakeAway{basis_.data(), k + 1, n_, overlaps, vector_.data(),
                                   pass == 0 ? found(kNumbers + 2 * k) : nullptr});
      }
      takeUnit(queue, basis_.data() + size(k + 1) * size(n_), found(kNumbers + 2 * k + 1));
    }
    const std::vector<double> numbers = queue.download(found_, size(kNumbers + 2 * iterations));
    if (!(numbers[kStart] > 0)) return {};  // nothing moves

    // Where all directions are found, what follows is noise.
    std::vector<double> diagonal, off;
    for (int k = 0; k < iterations; ++k) {
      diagonal.push_back(numbers[size(kNumbers + 2 * k)]);
      if (k + 1 == iterations) break;
      const double length = numbers[size(kNumbers + 2 * k + 1)];
      if (!goesOn(length, diagonal.front())) break;
      off.push_back(length);
    }
    const LargestOf largest = largestOf(diagonal, off);
    queue.uploadLater(std::span<const double>(largest.vector), weight_);
    queue.forEach(n_,
                  Together{basis_.data(), static_cast<int>(largest.vector.size()), n_, weight_.data(), vector_.data()});
    takeUnit(queue, mode_.data(), found(kStart));
    share(queue, &laws_[kMembrane], false, kMembraneShare);
    share(queue, &laws_[kBending], false, kBendingShare);
    if (forces_.hasSeams()) share(queue, nullptr, false, kSeamShare);
    if (forces_.motion().springs() > 0) share(queue, nullptr, true, kSpringShare);
    const std::vector<double> shares = queue.download(found_, kNumbers);
    mode = queue.download(mode_, size(n_));
    Frequency f;
    f.largest_rad_per_s = std::sqrt(std::max(largest.value, 0.0));
    f.membrane_share = shares[kMembraneShare] / largest.value;
    f.bending_share = shares[kBendingShare] / largest.value;
    if (forces_.hasSeams()) f.seam_share = shares[kSeamShare] / largest.value;
    if (forces_.motion().springs() > 0) f.spring_share = shares[kSpringShare] / largest.value;
    return f;
  }

 private:
  enum Terms { kAll, kMembrane, kBending };
  static constexpr ForceTerms kTerms[] = {{true, true, true}, {true, false, false}, {false, true, false}};
  /// What is found: the length of what it started from, products with the mode, then entries of the matrix: on its
  /// diagonal, beside it, and so on.
  enum Found { kStart, kMembraneShare, kBendingShare, kSeamShare, kSpringShare, kNumbers };

  static std::size_t size(int n) { return static_cast<std::size_t>(n); }
  double* found(int k) { return found_.data() + k; }

  void makeRoom(int iterations) {
    if (iterations <= room_) return;
    room_ = iterations;
    basis_ = Buffer<Vec3>(size(iterations) * size(n_));
    weight_ = Buffer<double>(size(iterations));
    found_ = Buffer<double>(size(kNumbers + 2 * iterations));
    overlaps_ = SideSums<Device, NumberSum>(iterations, n_);
  }

  /// Of vector_.
  void takeUnit(Queue& queue, Vec3* unit, double* length) {
    sum_ = lengths_.run(queue, 1, n_, LengthOf{vector_.data(), root_.data()});
    queue.forEach(n_, TakeUnit{vector_.data(), root_.data(), sum_, unit, moved_.data(), length});
  }
  void bothWays(Queue& queue) {
    queue.forEach(all_, MoveBothWays{forces_.map(), forces_.allFree(), position_.data(), moved_.data(), sum_,
                                     before_.data(), after_.data()});
  }
  /// vector_ = M^-1/2 K times what points are moved by: of the cloth by `laws`, or (null) of its seams alone, where not
  /// of the springs alone.
  void times(Queue& queue, const typename ShellForces<Device>::Laws* laws, bool springs) {
    const bool cloth = laws || !springs;
    if (cloth) {
      bothWays(queue);
      for (const auto& [at, force] : {std::pair{&before_, &force_before_}, std::pair{&after_, &force_after_}}) {
        if (laws)
          forces_.give(queue, *laws, at->data(), force->data());
        else
          forces_.giveSeams(queue, at->data(), force->data());
      }
    }
    PointMotion<Device>& motion = forces_.motion();
    const Point4* const pulls = springs && motion.springs() > 0 ? motion.pulls(queue, moved_.data()) : nullptr;
    queue.forEach(n_, StiffnessTimes{forces_.transposed(), forces_.allFree(), cloth ? force_before_.data() : nullptr,
                                     force_after_.data(), sum_, motion.pulled(), pulls, root_.data(), vector_.data()});
  }
  /// vector_ times a vector of many, from `many` on.
  void product(Queue& queue, const Vec3* many, int k, double* to) {
    queue.forEach(1, TakeNumber{overlaps_.run(queue, 1, n_, OverlapOf{many, k, n_, vector_.data()}), to});
  }
  void share(Queue& queue, const typename ShellForces<Device>::Laws* laws, bool springs, Found to) {
    times(queue, laws, springs);
    product(queue, mode_.data(), 0, found(to));
  }

  int n_, all_, room_ = 0;
  ShellForces<Device>& forces_;
  std::vector<typename ShellForces<Device>::Laws> laws_;
  Buffer<double> root_, weight_, found_;
  Buffer<Vec3> basis_, mode_, vector_;
  Buffer<Point4> free_, moved_;                                            ///< of free points
  Buffer<Point4> position_, before_, after_, force_before_, force_after_;  ///< of all points
  SideSums<Device, LengthSum> lengths_;
  SideSums<Device, NumberSum> overlaps_;
  const LengthSum* sum_ = nullptr;  ///< of what points are moved by
};

}  // namespace gambeson::gpu
