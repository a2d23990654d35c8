// Checks of a motion that matter to a cell designer: bend and twist of the dresspack, its tension and contact force, and whether
// it is too short or too long; with place, time and program line.
//
// (R9) At every step and link j, s = j l from the base clamp: bend radius 1/|kappa|; kappa and twist are the
// link's rotation over its compliance length (S5); tension (S9). Net twist is the sum of the rotations of a dresspack's links
// about the tangent, so full turns count; the remaining net twist of a repeat is the value at its end minus that at its
// begin. Slack is the free length of a span minus the straight distance of its clamps; of several spans the
// one with the least slack relative to its length counts. Each dresspack has a separate table.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pipeline/base/warnings.h"
#include "pipeline/job/dresspack.h"
#include "sim/contact/contact.h"
#include "sim/rod/rod.h"
#include "sim/run/clamp_path.h"

namespace dresslife::sim {

/// Limits for warnings, used if the dresspack has no maker's limits. Bend radius:
/// pipeline/cable/bend_limit.h. Twist: +-180 degrees in a metre, for which cables for torsion are usually sold.
/// Slack: below the first limit the hose has no length to bend, above the second it has more loose length than any part of the
/// motion needs; both are shares of the free length and ESTIMATES.
inline constexpr double most_twist = EIGEN_PI;  // [rad/m]
inline constexpr double least_slack_share = 0.02, most_slack_share = 1.0 / 3;

/// Lengths with the slack that the checks require: at least least_slack_share of the length L at the
/// largest distance w, at most most_slack_share: w / (1 - least) <= L <= w / (1 - most).
struct WorkingLength {
  double least = 0, most = 0;  ///< [m]
};
WorkingLength working_length(double longest_way);

/// An extreme value with its time and place.
struct Extreme {
  double value = 0;
  double time = 0;  ///< [s]
  int place = -1;   ///< link, segment or span; -1: the whole dresspack
  bool seen = false;
  void see(double candidate, bool larger, double when, int where);
};

/// One line of the table. Quantities without a limit have an infinite limit.
struct Check {
  std::optional<pipeline::WarningKind> kind;  ///< kind of the warning if the limit is exceeded; absent: no warning
  std::string name, unit;                     ///< SI
  double value = 0, limit = 0;
  bool warning = false;
  double time = 0;       ///< [s]
  double position = -1;  ///< from the base clamp along the dresspack [m]; -1: the whole dresspack
  int dresspack = 0;
  double centre = 0;  ///< for net twist: the mean of its extremes [rad]
  /// for the bend radius at a clamp: curvature there by the straight line through the next two links [1/m]; absent: elsewhere
  std::optional<double> line{};
  double segment = 0;  ///< for the bend radius: length of a segment [m]
};

/// Limits of a dresspack in motion.
struct MotionLimits {
  double least_bend_radius = 0;  ///< [m]
  double most_twist = 0;         ///< [rad/m]
  double most_tension = 0;       ///< [N]; infinite: no limit is given
};
MotionLimits limits_of(const pipeline::Dresspack& dresspack);

class MotionChecks {
 public:
  MotionChecks(const Rod& rod, std::vector<MotionLimits> limits);

  /// Evaluates the state at one time; the first call of a repeat is at its begin.
  /// ways: (span) straight distances through guide rings [m]; empty: from clamp to clamp.
  void see(const RodState& state, const std::vector<Contact>& contacts, double time,
           const std::vector<double>& ways = {});

  double net_twist() const;  ///< net twist of the last state, sum of all dresspacks [rad]
  const std::vector<Extreme>& curvature() const { return curvature_; }  ///< (link) largest [1/m]
  const std::vector<Extreme>& twist() const { return twist_; }          ///< (link) largest absolute value [rad/m]
  const std::vector<Extreme>& tension() const { return tension_; }      ///< (link) largest pull [N]

  /// Returns the checks of all dresspacks, one dresspack after the other.
  std::vector<Check> table() const;

 private:
  /// Values of one whole dresspack.
  struct Whole {
    Extreme most_net_twist, depth, force;
    double net_twist = 0, net_twist_at_begin = 0, lowest = 0, highest = 0;
  };
  void see_links(const RodState& state, double time);
  std::optional<double> line_at(const RodState& state, int link) const;
  void see_spans(const RodState& state, double time, const std::vector<double>& ways);
  void see_contact(int segment, const Contact& contact, double time);
  void add_lines(int dresspack, std::vector<Check>& checks) const;
  void add_slack(int dresspack, std::vector<Check>& checks) const;

  const Rod& rod_;
  const std::vector<MotionLimits> limits_;  // (dresspack)
  std::vector<Whole> whole_;                // (dresspack)
  std::vector<Extreme> curvature_, twist_, tension_;
  std::vector<Extreme> least_slack_, most_slack_;  // (span)
  std::vector<Extreme> travel_;                    // (span)
  std::vector<std::optional<double>> line_;        // (link) Check::line of its largest curvature
  bool begun_ = false;
  double end_ = 0;
};

}  // namespace dresslife::sim
