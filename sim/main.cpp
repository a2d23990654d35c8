// dresslife-sim: a job in, motion.h5 out.
#include <fmt/format.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "pipeline/base/joined.h"
#include "pipeline/base/whole_file.h"
#include "pipeline/files/checks.h"
#include "pipeline/job/job.h"
#include "pipeline/resolve/job_text.h"
#include "pipeline/stage/stage.h"
#include "sim/route/bracket.h"
#include "sim/route/exercise.h"
#include "sim/route/preview.h"
#include "sim/route/proposal.h"
#include "sim/route/screening_file.h"
#include "sim/run/clamp_path.h"
#include "sim/run/cures.h"
#include "sim/run/memory.h"
#include "sim/run/motion_file.h"
#include "sim/run/other_side.h"
#include "sim/run/other_stiffness.h"
#include "sim/run/prescribed.h"
#include "sim/run/simulate.h"

using namespace dresslife;

namespace {

/// What the options of this stage ask for.
struct Request {
  bool duration = false, preview = false, by_short_runs = false, exercise = false;
  std::string screen;  ///< a list of changes; empty: not asked
  std::optional<int> propose;
  sim::ProposalSettings proposals;
  std::optional<double> bracket_mm;
};

/// Refuses options that do nothing beside the others.
void refuse_unused(const Request& request) {
  std::vector<const char*> given;
  for (const auto& [option, is_given] : {std::pair{"--duration", request.duration},
                                         {"--preview", request.preview},
                                         {"--screen", !request.screen.empty()},
                                         {"--propose", request.propose.has_value()}})
    if (is_given) given.push_back(option);
  if (given.size() > 1)
    throw pipeline::InputError({given[1]}, fmt::format("does nothing with {}", given[0]), "give one of the two");
  const auto need = [](const char* option, bool is_given, bool used, const char* with) {
    if (is_given && !used)
      throw pipeline::InputError({option}, fmt::format("does nothing without {}", with), "give both");
  };
  const bool has_cell = !given.empty() && !request.duration;
  need("--bracket", request.bracket_mm.has_value(), has_cell, "--preview, --screen or --propose");
  need("--exercise", request.exercise, has_cell, "--preview, --screen or --propose");
}

/// What is asked for without a run. Returns false when it is the run that is asked for.
bool written_without_run(const Request& request, const pipeline::StageCall& call, pipeline::Job& job,
                         pipeline::Progress& progress) {
  if (!request.preview && request.screen.empty() && !request.propose) return false;
  if (job.motion.is_prescribed())
    throw pipeline::InputError(job.motion.where, "a prescribed deformation has no cell to preview (nothing moves)",
                               "run it, and look at its page");
  if (request.exercise) job.motion = sim::exercise(job.robot);
  job.motion.longest_wait = sim::settled_after;
  if (request.bracket_mm)
    for (pipeline::MountedDresspack& mounted : job.dresspacks)
      mounted.routing.longest_bracket = *request.bracket_mm / 1e3;
  pipeline::FileWriter file(call.output, request.preview ? pipeline::preview_format() : pipeline::screening_format());
  if (request.preview) {
    sim::write_preview(job, file);
  } else if (!request.screen.empty()) {
    sim::write_screening(job, request.screen, request.by_short_runs, file);
  } else {
    sim::ProposalSettings settings = request.proposals;
    settings.count = *request.propose;
    settings.progress = [&](double share, const std::string& words) { progress.show(share, words); };
    sim::write_proposals(job, settings, file);
  }
  pipeline::stamp(file, call, job, "");
  file.commit();
  return true;
}

/// Returns the space of a tool whose shape is not known; absent: none.
std::optional<sim::ToolSpace> tool_space(const pipeline::Job& job, const sim::ClampPath& path) {
  const auto* const robot = dynamic_cast<const sim::RobotPath*>(&path);
  return robot ? sim::unknown_tool_space(job, robot->tools()) : std::nullopt;
}

void write_duration(const pipeline::StageCall& call, const pipeline::Job& job) {
  if (job.motion.is_prescribed())
    throw pipeline::InputError(job.motion.where, "a prescribed deformation has no path whose duration is computed",
                               "run it");
  const auto path = sim::path_of(job);
  sim::check_size(job, path->duration(), job.simulation.segments);
  const double rate = job.simulation.sample_rate, seconds = sim::intervals(path->duration(), rate) / rate;
  std::string text = fmt::format("repeat_seconds: {}\n", seconds);
  if (const auto space = tool_space(job, *path); space && !space->line.key.empty())
    text += fmt::format("tool_space:\n  {}: {}\n", space->line.key, space->line.value);
  pipeline::write_text_if_changed(call.output, pipeline::with_mark(text, pipeline::Mark::yaml));
}

void prescribe(const pipeline::StageCall& call, const pipeline::Job& job, pipeline::Progress& progress) {
  pipeline::FileWriter file(call.output, pipeline::motion_format());
  pipeline::note_warnings(file, call, progress,
                          sim::write_prescribed(job, file, [&](double share) { progress.show(share); }));
  pipeline::stamp(file, call, job, "");
  file.commit();
}

void simulate(const pipeline::StageCall& call, const pipeline::Job& job, pipeline::Progress& progress) {
  const sim::Simulation simulation(job);
  pipeline::require_memory(call, sim::memory_of(simulation, job.uncertainty), progress);
  std::optional<pipeline::FileWriter> file;
  std::optional<sim::MotionFile> motion;
  const auto begin = [&](int) {  // a repeat that does not count leaves nothing
    motion.reset();
    file.reset();
    file.emplace(call.output, pipeline::motion_format());
    motion.emplace(*file, simulation.description());
  };
  begin(1);
  sim::Ends ends{simulation.start(), {}};
  const auto add = [&](const sim::Sample& sample) {
    motion->add(sample);
    ends.end = sample.state;
  };
  const sim::RunSummary summary = simulation.run({add, begin, [&](double share) { progress.show(share); }});
  motion->finish(summary, [&](double time) { return simulation.path().step(time); });
  const std::vector<pipeline::Warning> refused = pipeline::joined(
      sim::other_side_warnings(job, summary.time_step, ends), sim::write_other_stiffnesses(job, summary, *file));
  const std::optional<sim::ToolSpace> space = tool_space(job, simulation.path());
  if (space) file->attribute("tool_note", sim::tool_space_note(space));
  if (const std::vector<std::string> assumed = simulation.assumed(); !assumed.empty())
    file->attribute("assumed", pipeline::joined(assumed, "\n"));
  for (const std::string& note : {sim::repeats_note(summary), simulation.program_note()})
    if (!note.empty()) progress.note(note);
  pipeline::note_warnings(
      *file, call, progress,
      pipeline::joined(pipeline::joined(sim::warnings_of(simulation, summary), sim::clamp_warnings(job, space)),
                       refused));
  pipeline::stamp(*file, call, job, "");
  file->commit();
}

}  // namespace

int main(int argc, char** argv) {
  Request request;
  const pipeline::OptionRules of_search{.needs = "--propose"};
  const pipeline::StageInfo info{
      .program = "dresslife-sim",
      .purpose = "Simulates how a robot's dresspack moves while the robot runs its program.",
      .input = "JOB.yaml",
      .output = "motion.h5",
      .example = "dresslife-sim config/jobs/irb6640_spot_welding.yaml -o motion.h5",
      .input_is_job = true,
      .options =
          {{"--duration", "",
            "write only the duration of one repeat of the motion [s], and a shape for the space of a tool if it is not known (YAML)",
            &request.duration},
           {"--preview", "", "write only the geometry over the program and suitable lengths (preview.h5)",
            &request.preview},
           {"--screen", "LIST.yaml",
            "write only the geometric checks of the job with each of these changes (screening.h5)", &request.screen},
           {"--by-short-runs",
            "",
            "with --screen: run each with few segments, and write the results",
            &request.by_short_runs,
            {.needs = "--screen"}},
           pipeline::number_option(
               "--propose", "COUNT",
               "write only routings with clamps on the job's links that pass the geometric checks (screening.h5)",
               &request.propose, 1, 24),
           {"--ring", "LINK", "with --propose: also a guide ring on this link", &request.proposals.ring_link,
            of_search},
           pipeline::number_option("--tried", "COUNT", "with --propose: routings to check by geometry",
                                   &request.proposals.tried, 1, 1'000'000, of_search),
           pipeline::number_option("--short-runs", "COUNT", "with --propose: short runs that improve the routings",
                                   &request.proposals.short_runs, 0, 100'000, of_search),
           pipeline::number_option(
               "--further", "COUNT",
               "with --propose: more short runs, for less bend and twist, after enough routings keep all limits",
               &request.proposals.further, 0, 100'000, of_search),
           pipeline::number_option("--seed", "NUMBER", "with --propose: start of the random numbers",
                                   &request.proposals.seed, 0, 1'000'000'000, of_search),
           pipeline::number_option("--bracket", "MM", "instead of the job's routing.longest_bracket_mm",
                                   &request.bracket_mm, 0, 10'000),
           {"--exercise", "", "with these: a motion of the wrist instead of the job's motion", &request.exercise}},
      .part = pipeline::JobPart::sim,
      .results = pipeline::results_of_checks};
  return pipeline::run_stage(
      info, argc, argv, [&request](const pipeline::StageCall& call, pipeline::Progress& progress) {
        refuse_unused(request);
        pipeline::Job job = pipeline::read_job(call.input, call.sets);
        if (request.duration) return write_duration(call, job);
        if (written_without_run(request, call, job, progress)) return;
        if (job.motion.is_prescribed()) return prescribe(call, job, progress);
        try {
          simulate(call, job, progress);
        } catch (const sim::RoutingRefusal& refusal) {
          throw pipeline::InputError(refusal.where, refusal.problem, sim::refusal_remedy(job, refusal));
        }
      });
}
