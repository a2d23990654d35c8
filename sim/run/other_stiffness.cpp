#include "sim/run/other_stiffness.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <utility>

#include "pipeline/base/errors.h"
#include "pipeline/base/warning_words.h"
#include "pipeline/files/check_names.h"
#include "pipeline/job/beyond_limit.h"
#include "pipeline/job/uncertainty.h"
#include "sim/run/cures.h"
#include "sim/run/motion_file.h"
#include "sim/run/routing.h"

namespace dresslife::sim {
namespace {

using pipeline::Uncertain;
using pipeline::Warning;

/// A recorded motion, kept until its simulation has reached the end.
struct RecordedMotion {
  std::vector<double> position, orientation, clamp_position, clamp_orientation;

  void add(const Sample& sample) {
    for (const Vector3& place : sample.state.position) put(position, place);
    for (const Quaternion& turn : sample.state.orientation) put(orientation, turn);
    for (const Frame& clamp : sample.clamps)
      put(clamp_position, clamp.position), put(clamp_orientation, clamp.orientation);
  }
  void write(pipeline::FileWriter& file, const std::string& group) const {
    file.append(group + "/segment/position", position);
    file.append(group + "/segment/orientation", orientation);
    file.append(group + "/clamp/position", clamp_position);
    file.append(group + "/clamp/orientation", clamp_orientation);
  }
};

pipeline::Setup setup_with(const pipeline::Job& job, double factor, double time_step) {
  pipeline::Setup setup = job;
  pipeline::SimulationSettings& settings = setup.simulation;
  settings.stiffness_factor *= factor;
  settings.choose_time_step = false;
  settings.time_step = time_step;
  // After the lead-in with its larger step, a second repeat begins with another swing than it ends with. The third begins with
  // that of the second.
  settings.most_repeats = std::min(settings.most_repeats, 3);
  return setup;
}

const pipeline::UncertainParameter& stiffness() {
  return pipeline::uncertain_parameters()[index_of(Uncertain::hose_stiffness)];
}
double factor_of(double z) { return stiffness().value(z); }

/// Returns WHAT of a message "WHERE: error: WHAT; REMEDY": place and remedy are those of the changed job, which the user does not see.
std::string problem_in(const std::string& message) {
  const std::string mark = ": error: ";
  const std::size_t at = message.find(mark), begin = at == std::string::npos ? 0 : at + mark.size();
  return message.substr(begin, message.find("; ", begin) - begin);
}

/// A stiffness whose simulation is refused.
struct Refused {
  std::string side;          ///< "softer"
  double z = 0;              ///< the whole change
  double recorded = 0;       ///< z of half the change; 0: it is refused, too
  double taut = 0;           ///< z of the smallest change with which the dresspack is pulled tight; 0: none
  std::string problem = {};  ///< at z; empty: it is not refused
};

/// Returns the lives of a refused stiffness in words.
std::string lives_of(const Refused& at) {
  // 5 % of hoses lie beyond z, and 20 % beyond half of it: see pipeline::other_stiffness()
  const char* const kind = at.side == "softer" ? "soft" : "stiff";
  if (at.taut != 0)
    return fmt::format(
        "{} of hoses are too {} for this program. With {:.2g} times the stiffness or {} a life counts as one repeat. Between "
        "{:.2g} and {:.2g} times it falls from the simulated life to one repeat",
        at.taut == at.z ? "5 to 20 %" : "More than 20 %", kind, factor_of(at.taut), at.taut < 0 ? "less" : "more",
        factor_of(at.recorded), factor_of(at.taut));
  if (at.recorded == 0) return "Its lives there are those of a straight line through the other stiffness";
  return fmt::format(
      "5 to 20 % of hoses are too {} for this program, but their lives are those of a straight line through 1 and {:.2g} "
      "times the stiffness",
      kind, factor_of(at.recorded));
}

Warning warning_of(const Refused& at) {
  return pipeline::warning_of(
      pipeline::WarningKind::slack, "",
      fmt::format("with {:.2g} times the hose's bending stiffness the simulation is refused ({}). {}", factor_of(at.z),
                  at.problem, lives_of(at)),
      "the routing leaves this hose no room for another stiffness",
      "more free length; or measure the hose, and give bending_stiffness_Nm2 and a smaller uncertainty.hose_stiffness");
}

/// The run at another stiffness.
struct OtherRun {
  double z;
  pipeline::Setup setup;
  std::vector<Check> checks;
};

/// Returns the quantity over its limit, or the limit over a least value; 0: no limit, or the geometry of the clamps alone decides.
double load_of(const Check& check) {
  if (!check.kind || !std::isfinite(check.limit)) return 0;
  if (check.kind == pipeline::WarningKind::bend_radius) return check.limit / check.value;
  if (check.kind == pipeline::WarningKind::slack && check.name != pipeline::check_name::travel) return 0;
  return std::abs(check.value) / check.limit;
}

Warning beyond_warning(const pipeline::Job& job, const OtherRun& at, const Check& broken, double share) {
  const Rod rod = rod_of(at.setup);
  const std::unique_ptr<ClampPath> path = path_of(at.setup);
  const CheckedMotion motion{at.setup,           [&](double time) { return path->moment(time); }, &rod, path.get(), {},
                             1 / factor_of(at.z)};
  Cure cure = cure_of(motion, at.checks, broken);
  cure.cause += "; all radii here are with this stiffness";
  cure.remedy.words += pipeline::measurement_words(stiffness(), job.uncertainty);
  Warning warning = pipeline::warning_of(
      pipeline::WarningKind::other_values, "",
      fmt::format("with {} {}; about {} of such dresspacks exceed this limit (interpolated between the simulated "
                  "stiffnesses); with the job's own stiffness none does",
                  pipeline::value_words(stiffness(), at.z, job.simulation.stiffness_factor),
                  check_words(motion, broken), pipeline::percent_words(share)),
      cure.cause, cure.remedy);
  warning.amount = share;
  return warning;
}

/// Returns a warning for each limit that a run exceeds and the job's own run keeps. own: checks of the job's own run.
std::vector<Warning> beyond_warnings(const pipeline::Job& job, const std::vector<Check>& own,
                                     const std::vector<OtherRun>& others) {
  std::vector<Warning> warnings;
  const double deviation = stiffness().z_of(job.uncertainty.spread[index_of(Uncertain::hose_stiffness)]);
  for (std::size_t k = 0; k < own.size(); ++k) {
    if (own[k].warning) continue;
    std::vector<pipeline::LoadNode> nodes{{0, load_of(own[k])}};
    const OtherRun* worst = nullptr;
    for (const OtherRun& other : others) {
      const double load = load_of(other.checks[k]);
      nodes.push_back({other.z, load});
      if (load > 1 && (!worst || load > load_of(worst->checks[k]))) worst = &other;
    }
    if (!worst) continue;
    const double share = pipeline::share_beyond(nodes, 0, deviation);
    if (share >= pipeline::least_share_beyond) warnings.push_back(beyond_warning(job, *worst, worst->checks[k], share));
  }
  return warnings;
}

/// Returns a warning if the motion is periodic with the job's own stiffness, and not with another one. distances: (z of such a stiffness)
/// RunSummary::distance [m].
std::vector<Warning> periodic_warnings(const pipeline::Job& job, bool own_is_periodic,
                                       const std::map<double, double>& distances) {
  if (!own_is_periodic) return {};
  std::string words;
  double farthest = 0;
  for (const auto& [z, distance] : distances) {
    words += fmt::format("{}{:.1f} mm with {}", words.empty() ? "" : ", and ", 1e3 * distance,
                         pipeline::value_words(stiffness(), z, job.simulation.stiffness_factor));
    farthest = std::max(farthest, distance);
  }
  if (words.empty()) return {};
  return {pipeline::warning_of(
      pipeline::WarningKind::other_values, "",
      fmt::format(
          "the motion begins its last repeat {} from where it ends it (limit simulation.periodic_tolerance_mm {:.3g}), and the "
          "lives of such dresspacks count this change in each repeat; with the job's own stiffness it keeps the limit",
          words, 1e3 * job.simulation.periodic_tolerance),
      "friction and contact leave the dresspack several resting places",
      fmt::format("simulation.periodic_tolerance_mm: {:g} if repeats may differ so{}", std::ceil(2e4 * farthest) / 10,
                  pipeline::measurement_words(stiffness(), job.uncertainty)))};
}

/// Returns the checks of the job with another stiffness. name: "softer" or "stiffer". Errors: InputError for a job that does not run
/// with it.
using Runner = std::function<std::vector<Check>(const pipeline::Setup& setup, const char* name, double z)>;

/// Returns a warning for each limit that the job keeps with its own stiffness and exceeds with another one, and for each side that does
/// not run. note: gets each such side.
std::vector<Warning> warnings_of_others(const pipeline::Job& job, const std::vector<Check>& own, double time_step,
                                        const Runner& run, const std::function<void(const Refused&)>& note = {}) {
  const double reach = pipeline::other_stiffness(job.uncertainty);
  std::vector<Warning> warnings;
  std::vector<OtherRun> others;
  if (reach == 0) return warnings;
  for (const auto& [name, side] : {std::pair("softer", -reach), std::pair("stiffer", reach)}) {
    Refused refused{name, side};
    for (const double z : {side, side / 2}) {  // a smaller change if the routing does not allow the larger one
      try {
        pipeline::Setup setup = setup_with(job, factor_of(z), time_step);
        std::vector<Check> checks = run(setup, name, z);
        refused.recorded = z;
        others.push_back({z, std::move(setup), std::move(checks)});
        break;
      } catch (const pipeline::InputError& refusal) {
        if (refused.problem.empty()) refused.problem = problem_in(refusal.what());
        // Other refusals, as a simulation that breaks down or finds no rest, say nothing about the life.
        const auto* const of_routing = dynamic_cast<const RoutingRefusal*>(&refusal);
        if (of_routing && of_routing->taut) refused.taut = z;
      }
    }
    if (refused.problem.empty()) continue;
    warnings.push_back(warning_of(refused));
    if (note) note(refused);
  }
  return pipeline::joined(std::move(warnings), beyond_warnings(job, own, others));
}

}  // namespace

std::vector<Warning> write_other_stiffnesses(const pipeline::Job& job, const RunSummary& own,
                                             pipeline::FileWriter& file) {
  std::map<double, double> distances;
  std::vector<Warning> warnings = warnings_of_others(
      job, own.checks, own.time_step,
      [&](const pipeline::Setup& setup, const char* name, double z) {
        RecordedMotion places;
        RunSummary summary = Simulation(setup).run({.take = [&](const Sample& sample) { places.add(sample); },
                                                    .begin = [&](int) { places = {}; },
                                                    .wanted = Wanted::places_and_checks});
        places.write(file, std::string("/") + name);
        file.attribute(std::string(name) + "_z", z);
        if (!summary.periodic) distances[z] = summary.distance;
        return std::move(summary.checks);
      },
      [&](const Refused& side) {
        if (side.taut != 0) file.attribute(side.side + "_taut_z", side.taut);
      });
  return pipeline::joined(std::move(warnings), periodic_warnings(job, own.periodic, distances));
}

double softer_hose(const pipeline::Uncertainty& uncertainty) {
  return factor_of(-pipeline::other_stiffness(uncertainty));
}

std::vector<Warning> other_stiffness_warnings(const pipeline::Job& job, const ShortRun& own) {
  std::map<double, double> distances;
  std::vector<Warning> warnings =
      warnings_of_others(job, own.checks, own.time_step, [&](const pipeline::Setup& setup, const char*, double z) {
        ShortRun run = short_run(setup, short_run_segments);
        if (!run.refusal.empty()) {
          RoutingRefusal refusal({}, run.refusal, "", run.dresspack);
          refusal.taut = run.taut;
          throw refusal;
        }
        // A short run has two repeats. So it can judge only jobs that have no more.
        if (!run.periodic && !run.stopped_at && setup.simulation.most_repeats <= 2) distances[z] = run.distance;
        return std::move(run.checks);
      });
  return pipeline::joined(std::move(warnings), periodic_warnings(job, own.periodic, distances));
}

}  // namespace dresslife::sim
