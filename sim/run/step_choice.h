// The error that the time step leaves in the curvature, estimated from the run itself, and the step that
// keeps it small.
//
// (R10) In the liveliest seconds of the motion, those with the largest mean square acceleration of its
//       clamps, the run is done again from its own state with half the step. At second order the step h has
//       the error:
//           e = 4/3 rms(kappa_h - kappa_{h/2}) / rms(kappa_{h/2})      (Richardson)
//       over all links and the second half of each window; the first half lets differences grow. e holds for
//       the lively seconds, hence bounds that of the motion. It does not count the segments' length.
// (R11) h' = h sqrt(e'/e) reaches the error e'.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "sim/contact/world.h"
#include "sim/run/clamp_path.h"

namespace dresslife::sim {

/// A part of the motion in which the error is measured, in steps: run again from `begin`, compared from
/// `compare` on.
struct StepWindow {
  int begin = 0, compare = 0, end = 0;
};

/// Windows of 3 s, liveliest first, apart from each other, together at most a thirtieth of the motion but at
/// least one. h: step [s], steps: of the whole motion.
std::vector<StepWindow> lively_windows(const ClampPath& path, double h, int steps);

/// As if the state had been reached with steps of half the length: velocities live half a step before
/// positions, so they move on by a quarter step. before: the state one step earlier.
RodState with_half_step(const RodState& state, const RodState& before);

class StepError {
 public:
  using MakeWorld = std::function<std::unique_ptr<World>(const RodState&, const Pose&, double)>;

  /// make_world: a world with this state, pose and step. All must outlive this.
  StepError(const Rod& rod, const ClampPath& path, MakeWorld make_world, double h, int steps);

  /// Looks at the state after step k = 1, 2, ... of a repeat.
  void see(int k, const RodState& state);
  /// Estimate (R10) of the repeat that was seen; a number that is not finite when the half step breaks down.
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

/// The largest step not above (R11) of which a whole number fits 1/rate, between 0.2 and 10 ms. error: of
/// step h.
double chosen_step(double h, double error, double wanted_error, double rate);

/// The step nearest to 5 ms, but not above, of which a whole number fits 1/rate.
double first_step(double rate);

}  // namespace dresslife::sim
