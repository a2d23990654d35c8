// Checks of a job that take seconds: slack over the whole program, as in a run; bend radius and twist of the
// dresspack at rest without contact, in one pose of the program after the other; its bend radius and tension in one short run among
// the robot's links; clamps on one link; axes that wind up the dresspack before the program begins. The short run decides whether a
// bend exceeds its limit; the shapes at rest give the reason.
//
// A hose that is clamped on a robot may have several shapes at rest. Each shape that is found is followed through the
// program. The checks use the shape that is nearest to the start of a run. Rounds of a loop of the program are followed until two of
// them are equal.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/base/warning_words.h"
#include "pipeline/base/words.h"
#include "sim/contact/rubbing.h"
#include "sim/run/checks.h"
#include "sim/run/longest_way.h"

namespace dresslife::pipeline {
struct Setup;
}

namespace dresslife::sim {

/// One run of a motion: with the start of a full run, and at most two repeats.
struct ShortRun {
  std::vector<Check> checks;
  bool periodic = false;  ///< the motion does not return, or its last repeat began and ended in the same state
  double distance = 0;    ///< as in RunSummary [m]
  std::vector<RubbedPatch> rubbed;     ///< as in RunSummary
  std::vector<std::string> obstacles;  ///< names, indexed by RubbedPatch::obstacle
  double seconds = 0;                  ///< as in RunSummary [s]
  std::string refusal;                 ///< reason why it does not run; empty: it runs
  bool taut = false;                   ///< RoutingRefusal::taut
  std::optional<double> taut_at;       ///< time at which a dresspack is pulled taut [s]; absent: it is not
  std::optional<double>
      stopped_at;                 ///< time at which the run was stopped because of its duration [s]; absent: it was not
  double work = 0;                ///< in the unit of World::work
  double time_step = 0;           ///< [s]
  int dresspack = 0;              ///< index of the refused dresspack
  std::optional<RodState> begin;  ///< state at the begin; absent: the run did not begin
  RodState end;                   ///< last state of the last repeat
};

/// Segments of each dresspack: at rest, where so few give the bend within a few percent; and at most in the short run, where
/// fewer segments may lead a hose around another side of the robot.
inline constexpr int rest_segments = 32, short_run_segments = 64;

/// Runs a short run. useless_below: the run ends if the bend radius of the dresspack `of` falls below this value [m]; 0: no
/// limit.
ShortRun short_run(pipeline::Setup setup, int segments, double useless_below = 0, int of = 0);

/// How much of the program the short run of the checks followed.
enum class Followed { whole, begin, none };
constexpr std::string_view word(Followed value) { return pipeline::word_at({"whole", "begin", "none"}, value); }

struct QuickFindings {
  /// checks with limits: at rest, except "smallest bend radius" and "largest tension", which come from the short run
  std::vector<Check> checks;
  std::vector<pipeline::Warning> others;  ///< warnings that no other routing between these links cures
  std::vector<std::string> notes;         ///< notes about several shapes at rest
  ShortRun run;
  Followed followed = Followed::whole;
};

/// Returns the findings. Errors: InputError for a motion that the robot cannot run.
QuickFindings quick_findings(const pipeline::Setup& setup);

/// Returns the findings for a changed routing, in the order of their cost: slack, a coarse run, the short run, the shape at rest that
/// is nearest to it. Ends before the next of them if `rejects` returns true for the findings so far; ends a run as in short_run().
QuickFindings findings_unless(const pipeline::Setup& setup, const std::function<bool(const QuickFindings&)>& rejects,
                              double useless_below, int dresspack);

/// The findings as warnings with their cures, and notes.
struct QuickWarnings {
  std::vector<pipeline::Warning> warnings;
  std::vector<std::string> notes;
  ShortRun run;  ///< without checks if it was left out
  Followed followed = Followed::whole;
};
/// longest: longest_ways() with setup.simulation.time_step; empty: they are computed. other_places: see cures.h.
QuickWarnings quick_warnings(const pipeline::Setup& setup, std::vector<LongestWay> longest = {},
                             const std::function<pipeline::Remedy()>& other_places = {});

}  // namespace dresslife::sim
