#pragma once
/// The iteration of a contact solve on a device: what `iterate` (core/contact/contact_iteration.hpp) does where nothing
/// holds the points together, to the same bits.

#include <memory>

#include "core/contact/response.hpp"

namespace gambeson::gpu {

class ContactSweeps {
 public:
  virtual ~ContactSweeps() = default;
  /// Takes the rows, and where the iteration stands: after `startIteration` or an `iterate`.
  virtual void set(const ContactWork& work) = 0;
  /// Iterates as `iterate` does, from where `set` left it; may be repeated, and does the same again.
  virtual void run(double goal_m_per_s, int last, int most) = 0;
  /// Gives tractions, velocities and the islands' state back.
  virtual void get(ContactWork& work) const = 0;
  /// Median of so many runs, in milliseconds.
  virtual double medianMilliseconds(double goal_m_per_s, int last, int most, int runs) = 0;
  /// Gives a run to the device's queue and does not wait for it; `wait` does.
  virtual void begin(double goal_m_per_s, int last, int most) = 0;
  virtual void wait() = 0;
};

/// quads: of a group, 1 to 64. The same bits for each.
std::unique_ptr<ContactSweeps> sweepsOnReference(int quads = 8);

struct CudaSweepOptions {
  int quads = 64;      ///< of a block: 16, 32 or 64
  int most_team = 0;   ///< blocks to a large island, 0: as many as can be used
  int shared_kB = -1;  ///< for velocities, at most; -1: what a block can have
};
/// Throws RunError where the program was built without CUDA or no device is there.
std::unique_ptr<ContactSweeps> sweepsOnCuda(const CudaSweepOptions& options = {});

}  // namespace gambeson::gpu
