#pragma once
/// What keeps the step below the stable one where the highest modes swing far.
///
/// Velocity Verlet is stable for omega dt < 2 on a linear system. A mode of omega dt = 2 sin(pi m/n) comes back every
/// n steps (m turns); where its stiffness changes with its amplitude it meets the same stiffness at the same phase
/// again and gains energy by that, without bound for n = 3, at omega dt = sqrt(3), 0.866 of the limit (Mandziuk and
/// Schlick, Chem. Phys. Lett. 237, 1995; Schlick, Barth and Mandziuk, Annu. Rev. Biophys. 26, 1997). A sheet has modes
/// at any frequency below its largest one, so that at 0.9 of the limit some are in this resonance. How long a step may
/// be thus depends on how far they swing, and no estimate of the largest frequency, however good, tells that.

#include <span>
#include <vector>

namespace gambeson {

struct Model;
struct State;
struct StepWork;

/// Amplitude of the highest modes as a strain: the largest difference of displacement over an edge of the control net,
/// by the length of the edge. In one step the acceleration of a mode of frequency omega changes by omega dt times its
/// amplitude omega^2 x, so that |change of a|/(omega^3 dt) is x for the highest modes and vanishes with the third power
/// of the frequency for slower ones; contacts that last have no part in it, since `a` holds no contact forces.
double swing(const Model& model, const State& before, const State& after, double dt_s, double omega_rad_per_s,
             StepWork& work);

/// The same of the largest squared change of acceleration, most |change of a|^2 / length^2 over the edges of the net
/// [1/s^4].
double swingOfJerk(double most_per_s4, double dt_s, double omega_rad_per_s);

/// The part of 2/omega that keeps clear of the third-order resonance at this swing: 1 while the highest modes hardly
/// swing, else 0.8, 0.75 or 0.7. Never near 0.866, where the highest mode itself would be in resonance; and in few
/// levels, with hysteresis, because steps that follow the motion feed it too: velocity Verlet keeps energy with equal
/// steps only. `before`: the share up to now, 0 where there is none.
double shareAtSwing(double swing, double before);

constexpr double kFirstShare = 0.8;  ///< also of the first step, when no swing is known
constexpr double kSwingHeld = 0.99;  ///< part of a peak of the swing that counts in the next step

}  // namespace gambeson
