// Estimate of the curvature error by the time step, from the run itself, and the choice of a step that
// keeps this error small.
//
// (R10) In the liveliest seconds of the motion (largest mean square acceleration of its
//       clamps) the run is repeated from its own state with half the step. For second order the step h has
//       the error:
//           e = 4/3 rms(kappa_h - kappa_{h/2}) / rms(kappa_{h/2})      (Richardson)
//       over all links and the second half of each window; the first half lets differences grow. e is valid for
//       the lively seconds, so it is a bound for the whole motion. It does not include the error by the segments' length.
// (R11) h' = h sqrt(e'/e) reaches the error e'.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "sim/contact/world.h"
#include "sim/run/clamp_path.h"

namespace dresslife::sim {

/// A part of the motion in which the error is measured, in steps: simulated again from `begin`, compared from
/// `compare` on.
struct StepWindow {
  int begin = 0, compare = 0, end = 0;
};

/// Returns windows of 3 s, liveliest first, without overlap, together at most a thirtieth of the motion but at
/// least one window. h: step [s], steps: of the whole motion.
std::vector<StepWindow> lively_windows(const ClampPath& path, double h, int steps);

/// Returns the state for a simulation with half the step: velocities belong to half a step before the
/// positions, so they advance by a quarter step. before: the state one step earlier.
RodState with_half_step(const RodState& state, const RodState& before);

class StepError {
 public:
  using MakeWorld = std::function<std::unique_ptr<World>(const RodState&, const Pose&, double)>;

  /// make_world: returns a world with this state, pose and step. Precondition: all arguments outlive this object.
  StepError(const Rod& rod, const ClampPath& path, MakeWorld make_world, double h, int steps);

  /// Records the state after step k = 1, 2, ... of a repeat.
  void see(int k, const RodState& state);
  /// Returns the estimate (R10) of the recorded repeat; not finite if the simulation with half the step breaks down.
  double estimate() const;

 private:
  struct Record {
    RodState begin;
    std::vector<double> curvature;  ///< (step, link) from `compare` on
  };
  void add(const StepWindow& window, const Record& record, double& difference, double& size) const;

  const Rod& rod_;
  const ClampPath& path_;
  const MakeWorld make_world_;
  const double h_;
  const std::vector<StepWindow> windows_;
  std::vector<Record> records_;
  RodState before_;
};

/// Returns the largest step of at most (R11) that divides 1/rate, between 0.2 and 10 ms. error: error of the
/// step h.
double chosen_step(double h, double error, double wanted_error, double rate);

/// Returns the largest step of at most 5 ms that divides 1/rate.
double first_step(double rate);

}  // namespace dresslife::sim
