// What a cell designer asks of a motion: how tightly the dresspack bends and twists, how hard it pulls and
// touches, and whether it is too short or too long; where, when, and during which line of the program.
//
// (R9) Every step, at link j, s = j l from the base clamp: bend radius 1/|kappa|, kappa and twist = the
// link's turn over its compliance length (S5); tension (S9). Net twist is the sum of a dresspack's links'
// turns about the tangent, so whole turns count; what is left of it after a repeat is its end minus its
// begin. Slack is the free length of a span minus the straight distance of its clamps; of several spans the
// one with least of it for its length counts. Each dresspack has a table of its own.
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

/// Limits that are warned of, where the dresspack does not name its maker's. Bend radius:
/// pipeline/cable/bend_limit.h. Twist: +-180 degrees in a metre, for which cables for torsion are usually sold.
/// Slack: below the first it has no length left to bend, above the second more hangs loose than the motion ever
/// needs; both of the free length, both ESTIMATES.
inline constexpr double most_twist = EIGEN_PI;  // [rad/m]
inline constexpr double least_slack_share = 0.02, most_slack_share = 1.0 / 3;

/// Lengths with slack as the checks ask for : at least least_slack_share of the length L where the
/// way w is longest, at most most_slack_share there: w / (1 - least) <= L <= w / (1 - most).
struct WorkingLength {
  double least = 0, most = 0;  ///< [m]
};
WorkingLength working_length(double longest_way);

/// An extreme value and the moment and place at which it stood.
struct Extreme {
  double value = 0;
  double time = 0;  ///< [s]
  int place = -1;   ///< link, segment or span; -1: of the whole dresspack
  bool seen = false;
  void see(double candidate, bool larger, double when, int where);
};

/// One line of the table. Quantities without a limit have an infinite one.
struct Check {
  std::optional<pipeline::WarningKind> kind;  ///< of warning when its limit is broken; absent: it has none
  std::string name, unit;                     ///< SI
  double value = 0, limit = 0;
  bool warning = false;
  double time = 0;       ///< [s]
  double position = -1;  ///< from the base clamp along the dresspack [m]; -1: of the whole
  int dresspack = 0;
  double centre = 0;  ///< of net twist: the middle between its extremes [rad]
};

/// What this dresspack allows in motion.
struct MotionLimits {
  double least_bend_radius = 0;  ///< [m]
  double most_twist = 0;         ///< [rad/m]
  double most_tension = 0;       ///< [N]; infinite: none is given
};
MotionLimits limits_of(const pipeline::Dresspack& dresspack);

class MotionChecks {
 public:
  MotionChecks(const Rod& rod, std::vector<MotionLimits> limits);

  /// Looks at the state at one time; the first call of a repeat is at its begin.
  /// ways: (span) straight ways through guide rings [m]; empty: from clamp to clamp.
  void see(const RodState& state, const std::vector<Contact>& contacts, double time,
           const std::vector<double>& ways = {});

  double net_twist() const;  ///< of the last state, all dresspacks [rad]
  const std::vector<Extreme>& curvature() const { return curvature_; }  ///< (link) largest [1/m]
  const std::vector<Extreme>& twist() const { return twist_; }          ///< (link) largest by size [rad/m]
  const std::vector<Extreme>& tension() const { return tension_; }      ///< (link) largest pull [N]

  /// Dresspack after dresspack.
  std::vector<Check> table() const;

 private:
  /// Of one dresspack.
  struct Whole {
    Extreme most_net_twist, depth, force;
    double net_twist = 0, net_twist_at_begin = 0, lowest = 0, highest = 0;
  };
  void see_links(const RodState& state, double time);
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
  bool begun_ = false;
  double end_ = 0;
};

}  // namespace dresslife::sim
