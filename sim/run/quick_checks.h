// What is wrong with a job, found in seconds: slack over the whole program, as a run finds it; bend radius and twist of the
// dresspack at rest without contact, pose after pose of the program; its bend radius in one short run among the robot's links;
// clamps on one link; axes that wind the dresspack up before the program begins. The short run decides whether a bend passes
// its limit; the shapes at rest say why.
//
// A hose that is clamped on a robot may have several shapes at rest. Each that is found is followed through the
// program. The checks take the one that is nearest to where a run begins.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/base/warnings.h"
#include "sim/run/checks.h"

namespace dresslife::pipeline {
struct Setup;
}

namespace dresslife::sim {

/// One run of a motion: as a run begins it, with two repeats at most.
struct ShortRun {
  std::vector<Check> checks;
  std::string refusal;               ///< why it does not run; empty: it does
  std::optional<double> taut_at;     ///< time at which a dresspack is drawn taut [s]; absent: it is not
  std::optional<double> stopped_at;  ///< time at which the run was stopped [s], because it takes long; absent: it was not
  double work = 0;                   ///< as World::work
  int dresspack = 0;                 ///< that is refused
  std::optional<RodState> begin;     ///< absent: it did not begin
};

/// Segments of each dresspack: at rest, where so few bend within a few percent of more; and at most in the short run, where
/// fewer may lead a hose another way around the robot.
inline constexpr int rest_segments = 32, short_run_segments = 64;

/// useless_below: a run whose smallest bend radius of the dresspack `of` falls below it ends there [m]; 0: none does.
ShortRun short_run(pipeline::Setup setup, int segments, double useless_below = 0, int of = 0);

struct QuickFindings {
  std::vector<Check> checks;              ///< with limits; at rest but for "smallest bend radius", which is the short run's
  std::vector<pipeline::Warning> others;  ///< which no other routing between these links cures
  std::vector<std::string> notes;         ///< several shapes at rest
  ShortRun run;
};

/// Errors: InputError for a motion that the robot cannot run.
QuickFindings quick_findings(const pipeline::Setup& setup);

/// The same of a changed routing, in the order of their cost: slack, a run with rest_segments, the short run, shapes at rest.
/// Ends before the next of them if `rejects` is true of what is found, and a run as short_run() does.
QuickFindings findings_unless(const pipeline::Setup& setup, const std::function<bool(const QuickFindings&)>& rejects,
                              double useless_below, int dresspack);

/// The same as warnings, with their cures; and notes.
struct QuickWarnings {
  std::vector<pipeline::Warning> warnings;
  std::vector<std::string> notes;
};
QuickWarnings quick_warnings(const pipeline::Setup& setup);

}  // namespace dresslife::sim
