#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <memory>
#include <optional>
#include <tuple>
#include <utility>

#include "pipeline/advise/improve/draft.h"
#include "pipeline/advise/improve/screened.h"
#include "pipeline/advise/improve/set_text.h"
#include "pipeline/base/csv_rows.h"
#include "pipeline/base/errors.h"
#include "pipeline/base/installation.h"
#include "pipeline/base/joined.h"
#include "pipeline/base/lists.h"
#include "pipeline/base/plain_file.h"
#include "pipeline/base/whole_file.h"
#include "pipeline/cable/stiffness.h"
#include "pipeline/commands/checking.h"
#include "pipeline/commands/command.h"
#include "pipeline/commands/options.h"
#include "pipeline/resolve/catalogue.h"
#include "pipeline/resolve/job_text.h"
#include "pipeline/resolve/sources.h"
#include "pipeline/resolve/urdf_request.h"
#include "pipeline/settings/units.h"
#include "pipeline/study/stage_program.h"

namespace dresslife::pipeline {
namespace {

namespace fs = std::filesystem;

struct NewOptions {
  std::string job, robot, program, dresspack;
  bool dresspack_is_example = false;  ///< the user named no dresspack
};

constexpr const char* default_dresspack = "spot_welding";
constexpr int segments =
    64;  ///< of a new job, and of the checks of its routings, which otherwise differ from `dresslife check`

/// Returns the YAML files of a folder of the shipped catalogue, sorted.
std::vector<fs::path> shipped(const char* shelf) {
  std::vector<fs::path> files = entries_of(shipped_catalogue() / shelf);
  std::erase_if(files, [](const fs::path& file) { return file.extension() != ".yaml"; });
  return files;
}

/// A routing and its origin.
struct Choice {
  Node routing;
  std::string source;
  std::vector<std::string> faults = {};     ///< faults that dresslife check reports
  std::vector<std::string> estimates = {};  ///< estimated keys of the dresspack
  std::vector<std::string> notes = {};      ///< notes of dresslife check
  std::vector<std::string> doubts = {};     ///< faults of program and dresspack that do not depend on the routing
  bool refused = false;
  bool ran = false;                     ///< JobCheck::ran
  std::vector<KeyValue> remedies = {};  ///< of the faults: values of the routing, and slacks of the dresspack's cables
  std::vector<KeyValue> slacks = {};    ///< slacks that the job sets in its dresspack
  bool remedies_tried = false;          ///< the remedies were tried, and leave as many faults

  std::size_t spoiling = 0;  ///< faults that spoil a plan, as those with other values do not

  /// The fewer, the better.
  std::tuple<bool, std::size_t, std::size_t> badness() const { return {refused, spoiling, faults.size()}; }
};

/// Returns the routing of a shipped job with this robot and one dresspack; of several jobs the one with this dresspack.
std::optional<Choice> shipped_routing(const std::string& robot, const std::string& dresspack) {
  std::optional<Choice> found;
  for (const fs::path& file : shipped("jobs")) {
    const Node job = read_document(file);
    const Node *of = job.find("robot"), *pack = job.find("dresspack"), *routing = job.find("routing");
    if (!of || of->text != robot || !pack || !routing || routing->find("rings")) continue;
    const bool same = pack->text == dresspack;
    if (found && !same) continue;
    found = Choice{*routing, fmt::format("as in config/jobs/{}{}", file.filename().string(),
                                         same ? "" : fmt::format(", which has the dresspack {}", pack->text))};
    if (same) break;
  }
  return found;
}

/// Returns the comment at the begin of a shipped file, up to its first full stop or colon.
std::string first_comment(const fs::path& file) {
  const std::string text = read_text(file);
  const std::size_t begin = text.find_first_not_of("# ");
  return text.substr(begin, text.find_first_of(".:\n", begin) - begin);
}

std::string listed(const char* shelf) {
  std::string text;
  for (const fs::path& file : shipped(shelf)) {
    const Node entry = read_document(file);
    const Node* const name = entry.find("name");
    const std::string stem = file.stem().string();
    text += fmt::format("  {:<24}{}\n", stem, name && name->text != stem ? name->text : first_comment(file));
  }
  return text;
}

std::string choices() {
  std::string routed;
  for (const fs::path& file : shipped("robots"))
    if (shipped_routing(file.stem().string(), default_dresspack)) routed += " " + file.stem().string();
  return fmt::format(
      "--robot NAME, or a URDF file:\n{}Clamps are shipped for:{}. For other robots they are proposed.\n\n"
      "--program FILE (RAPID, KRL, Fanuc, INFORM, URScript, CSV or ROS), or a shipped motion of a robot with six axes:\n{}\n"
      "--dresspack NAME, or a YAML file; without it {}:\n{}\n"
      "Example: dresslife new --robot abb_irb6640_185_280 --program hard job.yaml\n",
      listed("robots"), routed, listed("programs"), default_dresspack, listed("dresspacks"));
}

/// Checks that a name is a file or an entry of the catalogue. Errors: InputError.
void check_named(const char* option, const char* shelf, const std::string& name) {
  const Where where{option};
  catalogue_entry(shelf, name, where, where);
}

/// Returns the path of a file relative to the job's folder; a name of the catalogue unchanged.
std::string seen_from_job(const std::string& name, const fs::path& job) {
  if (kind_of(name) != FileKind::file) return name;
  const fs::path folder = job.has_parent_path() ? job.parent_path() : fs::path(".");
  const std::string seen = as_seen_from(folder, name).string();
  const bool is_path =
      seen.find('/') != std::string::npos || seen.ends_with(".yaml") || !fs::path(seen).extension().empty();
  return is_path ? seen : "./" + seen;
}

/// Returns the text without the path of a temporary file.
std::string without_place(const std::string& words, const fs::path& file) {
  std::string text = words;
  for (std::size_t at = 0; (at = text.find(file.string(), at)) != std::string::npos;) {
    std::size_t end = text.find_first_not_of(":0123456789", at + file.string().size());
    if (text.compare(std::min(end, text.size()), 8, " error: ") == 0) end += 8;
    text.replace(at, end - at, end == std::string::npos || text[end - 1] != ' ' ? "the job" : "");
  }
  return text;
}

/// Returns whether a value belongs to the installation of the dresspack. A job must not change other values to keep a limit.
bool is_of_installation(const KeyValue& of) {
  return of.key.starts_with("routing.") ||
         (of.key.starts_with("dresspack.components.") && of.key.ends_with(".slack_percent"));
}

/// Sets the results of dresslife check for the draft with this routing, with places in the user's files. motion: YAML; empty: the
/// draft's own motion.
void judge(const Draft& draft, const std::string& motion, Choice& choice) {
  choice.spoiling = 0;
  choice.faults.clear(), choice.doubts.clear(), choice.estimates.clear(), choice.remedies.clear();
  const PassingFile file("job.yaml");
  Node job = routed(draft, to_yaml(choice.routing), motion, 1, file.path().parent_path());
  for (const KeyValue& slack : choice.slacks) job[slack.key] = scalar(slack.value);
  write_text_if_changed(file.path(), with_mark(to_yaml(job), Mark::yaml));
  try {
    read_job(file.path(), {});
  } catch (const InputError& problem) {
    choice.refused = true;
    choice.faults.push_back(without_place(problem.what(), file.path()));
    return;
  }
  // a full disk or a killed stage is no fault of the routing, so it is not caught
  const JobCheck check = check_of(file.path(), {});
  choice.refused = !check.refusal.empty();
  choice.ran = check.ran;
  choice.estimates = check.estimates;
  choice.notes.clear();
  std::ranges::copy_if(check.notes, std::back_inserter(choice.notes),
                       [](const std::string& note) { return note.starts_with("note: "); });
  if (choice.refused) choice.faults.push_back(without_place(check.refusal, file.path()));
  for (const Warning& warning : check.warnings) {
    const bool of_routing = warning.kind != WarningKind::program && warning.kind != WarningKind::motion &&
                            warning.kind != WarningKind::material && warning.kind != WarningKind::overlap;
    (of_routing ? choice.faults : choice.doubts).push_back(without_place(warning.line(), file.path()));
    choice.spoiling += of_routing && spoils_plan(warning.kind);
    if (of_routing) std::ranges::copy_if(warning.remedy, std::back_inserter(choice.remedies), is_of_installation);
  }
}

/// Returns the best of a choice and the choices to which its remedies lead. A remedy of one limit may exceed another one, whose
/// remedy follows, so that only the end counts: on an IRB 6640 a longer hose bent less, and was then warned of its two sides and of
/// the bends of a softer hose, and with the remedies of these two it kept all limits.
Choice cured(const Draft& draft, const std::string& motion, const Choice& start) {
  constexpr int rounds = 3;
  Choice best = start, choice = start;
  bool is_best = true;  // whether `choice` is `best`
  for (int round = 0; round < rounds && !best.faults.empty() && !choice.remedies.empty(); ++round) {
    Choice next = choice;
    next.remedies_tried = false;
    Node job;
    job["routing"] = next.routing;
    for (const KeyValue& of : choice.remedies)
      if (of.key.starts_with("routing.")) {
        set_value(job, of.key, parse_yaml(of.value, "remedy"), {"dresslife new"});
      } else {
        std::erase_if(next.slacks, [&](const KeyValue& before) { return before.key == of.key; });
        next.slacks.push_back(of);
      }
    next.routing = *job.find("routing");
    judge(draft, motion, next);
    best.remedies_tried |= is_best;
    is_best = next.badness() < best.badness();
    if (is_best) best = next;
    choice = std::move(next);
  }
  return best;
}

/// Returns the draft with its preliminary routing. Its files stay references, so that errors name lines of the user's files.
std::string draft_text(const Draft& draft, const fs::path& folder) {
  const std::string whole = job_text(draft.job);
  if (draft.exercise) return whole;
  return to_yaml(routed(draft, to_yaml(*parse_yaml(whole, "draft").find("routing")), "", 1, folder));
}

/// Returns the best routing that geometry and short runs find within some seconds.
Choice proposed(const Draft& draft) {
  const PassingFile job("draft.yaml"), screening("screening.h5"), errors("errors.txt");
  write_text_if_changed(job.path(), with_mark(draft_text(draft, job.path().parent_path()), Mark::yaml));
  std::vector<std::string> arguments{
      job.path().string(),       "--propose", "1", "--tried", "300", "--short-runs", "80", "--further", "16", "-o",
      screening.path().string(), "--quiet"};
  if (draft.exercise) arguments.emplace_back("--exercise");
  const int status = run_stage_program("dresslife-sim", arguments, errors.path());
  if (kind_of(errors.path()) == FileKind::file) write_stderr(without_place(read_text(errors.path()), job.path()));
  if (status != 0)
    throw InputError(
        {"dresslife new"}, "no routing can be proposed (see above), nothing was written",
        std::string("correct the errors above; dresslife route has the options --bracket, --from and --to") +
            (draft.exercise
                 ? ""
                 : "; for keys motion.KEY write {program: FILE, KEY: VALUE, ...} into a file MOTION.yaml, and give "
                   "--program MOTION.yaml"));
  const ScreenedList found = read_screening(screening.path());
  const ScreenedCandidate& best = found.candidates.front();
  Choice choice{parse_yaml(best.changes, "proposal"), "proposed from the robot's shape; put your brackets here"};
  judge(draft, found.motion, choice);
  return cured(draft, found.motion, choice);
}

/// Returns proposals for the accelerations of a URDF file [deg/s2], which contains none; empty: they are given. A proposal is the
/// largest speed of the axis times the ratio of acceleration to speed of shipped robots, rounded to 10.
std::vector<double> missing_accelerations(const std::string& robot) {
  std::vector<double> proposals;
  if (!robot.ends_with(".urdf")) return proposals;
  // Medians over config/robots: acceleration over speed of axes 1 to 6 [1/s]. They scatter by 5 %.
  constexpr std::array<double, 6> per_speed{4.3, 3.2, 6.7, 14.3, 15.1, 15.2};
  constexpr double of_no_speed = 500;  // [deg/s2]: for a slide, or a URDF without speeds
  UrdfRequest request;
  request.urdf = robot;
  const Node made = robot_from_urdf(request);
  for (const Node& joint : made.find("joints")->items) {
    if (joint.find("follows") || joint.find("acceleration_deg_per_s2")) continue;
    const Node* const speed = joint.find("speed_deg_per_s");
    const double fastest = speed ? number_in(speed->text).value_or(0) : 0;
    const double factor = per_speed[std::min(proposals.size(), per_speed.size() - 1)];
    proposals.push_back(fastest > 0 ? std::max(10.0, 10 * std::round(fastest * factor / 10)) : of_no_speed);
  }
  return proposals;
}

/// Returns a job of a URDF with proposed accelerations, which have little influence on a routing.
std::string job_of_urdf(const NewOptions& options, const std::vector<double>& accelerations) {
  const auto in_full = [](const std::string& name) {
    return scalar(kind_of(name) == FileKind::file ? fs::absolute(name).string() : name);
  };
  Node job;
  job["robot"]["urdf"] = in_full(options.robot);
  job["robot"]["accelerations_deg_per_s2"] =
      list_of(mapped(accelerations, [](double acceleration) { return scalar(shortest_text(acceleration)); }));
  job["dresspack"] = in_full(options.dresspack);
  if (!options.program.empty()) job["motion"] = in_full(options.program);
  return with_mark(to_yaml(job), Mark::yaml);
}

/// Makes the bend reliefs of another dresspack as stiff as this one, if they would be rigid for it.
void suit_reliefs(Node& routing, double stiffness) {
  for (const char* end : {"base_clamp", "tool_clamp"}) {
    const Node* const clamp = routing.find(end);
    const Node* const relief = clamp ? clamp->find("bend_relief") : nullptr;
    const Node* const given = relief ? relief->find("bending_stiffness_Nm2") : nullptr;
    if (given && stiffness > 0 && number_in(given->text).value_or(0) > rigid_relief * stiffness)
      routing[end]["bend_relief"]["bending_stiffness_Nm2"] = scalar(fmt::format("{:.3g}", stiffness));
  }
}

Choice routing_for(const Draft& draft, const NewOptions& options) {
  std::optional<Choice> known = shipped_routing(options.robot, options.dresspack);
  if (known) suit_reliefs(known->routing, draft.job.dresspacks.front().dresspack.bending_stiffness);
  if (known && !draft.exercise) {
    judge(draft, "", *known);
    known = cured(draft, "", *known);
  }
  if (known && !known->refused && known->faults.empty()) return *known;
  Choice made = proposed(draft);
  return known && known->badness() <= made.badness() ? *known : made;
}

std::string commented(const std::string& key, const std::string& value, const std::string& words) {
  return fmt::format("{:<33} # {}\n", key + ": " + value, words);
}

/// Returns words about remedies above that were tried in vain; empty: none was.
std::string tried_words(const Choice& choice) {
  if (!choice.remedies_tried) return "";
  const auto keys = mapped(choice.remedies, [](const KeyValue& of) { return of.key; });
  return fmt::format(", also not with the remedies for {} (as many warnings or more remain)",
                     joined(std::vector<std::string_view>(keys.begin(), keys.end()), " and "));
}

std::string text_of(const NewOptions& options, const Draft& draft, const Choice& choice,
                    const std::vector<double>& accelerations) {
  const std::string job = shown(options.job);
  const auto entry = [&](const std::string& name) { return set_text(scalar(seen_from_job(name, options.job))); };
  std::string text = fmt::format(
      "# A job, written by dresslife new. Next: dresslife check {0}, dresslife preview {0}, dresslife run {0}\n", job);
  if (!accelerations.empty())
    text += fmt::format(
        "# A URDF has no accelerations. These are an ESTIMATE: its speeds times the accelerations over the speeds of config/robots "
        "(which\n"
        "# have {0}). Replace them by those of your robot's data sheet or controller.\n"
        "robot: {{urdf: {1}, accelerations_deg_per_s2: [{2:g}]}}\n",
        shipped_accelerations, entry(options.robot), fmt::join(accelerations, ", "));
  else
    text += commented("robot", entry(options.robot), "a name of config/robots, or {urdf: FILE}");
  if (draft.exercise)
    text +=
        "# FILL IN your program, a file or a name of config/programs, and take the # away:\n# motion: program.mod\n";
  else
    text += commented("motion", entry(options.program), "your robot program, or a name of config/programs");
  text += commented("dresspack", entry(options.dresspack),
                    options.dresspack_is_example ? "an EXAMPLE, 60 mm wide; name yours, or your own YAML file"
                                                 : "a name of config/dresspacks, or your own YAML file");
  text +=
      choice.refused
          ? fmt::format(
                "# FILL IN clamps, or let dresslife route {} search. No routing that was tried runs. The last one:\n# {}\n",
                job, shown(choice.faults.front()))
          : fmt::format("# Clamps: {}.\n", choice.source);
  if (!choice.refused && !choice.faults.empty()) {
    text += fmt::format(
        "# No routing that was tried keeps all limits{1}. dresslife route {0} searches longer. dresslife check {0}:\n",
        job, tried_words(choice));
    for (const std::string& fault : choice.faults) text += fmt::format("# {}\n", shown(fault));
  }
  const char* const off = choice.refused ? "# " : "";
  text += fmt::format(
      "# position_m and direction are in the frame of the link; free_length_m is the length between the clamps.\n{}{}routing:\n",
      choice.routing.find("side")
          ? "# side: the side of the arm on which the hose is mounted, seen from the base clamp.\n"
          : "",
      off);
  for (const Entry& key : choice.routing.entries)
    text += fmt::format("{}  {}: {}\n", off, key.key, set_text(key.value));
  for (const KeyValue& slack : choice.slacks)
    text += commented(off + slack.key, slack.value, "without it, dresslife check warns");
  if (draft.tool_space)
    text += "# ESTIMATE: the space of the tool, whose shape is not known. Replace it by the shape of yours.\n" +
            fmt::format("{}: {}\n", draft.tool_space->key, set_text(draft.tool_space->value));
  return text + commented("simulation", fmt::format("{{segments: {}}}", segments),
                          "everything else has a default: config/keys.md");
}

int make(NewOptions options) {
  if (options.robot.empty()) {
    print(shown(choices()));
    if (options.job.empty() && options.program.empty() && options.dresspack.empty()) return 0;
    throw InputError({"dresslife new"}, "lacks --robot (nothing was written)", "choose one from the list above");
  }
  if (options.job.empty())
    throw InputError({"dresslife new"}, "lacks the job to write", "name a file, for example job.yaml");
  if (options.dresspack.empty()) options.dresspack = default_dresspack, options.dresspack_is_example = true;
  const std::vector<double> accelerations = missing_accelerations(options.robot);
  check_named("--robot", "robots", options.robot);
  check_named("--dresspack", "dresspacks", options.dresspack);
  if (!options.program.empty()) check_named("--program", "programs", options.program);
  for (const std::string& name : {options.robot, options.program, options.dresspack})
    if (kind_of(name) == FileKind::file) note_input(name);
  check_replaceable(options.job, "name another job");
  const PassingFile of_urdf("request.yaml");
  if (!accelerations.empty()) write_text_if_changed(of_urdf.path(), job_of_urdf(options, accelerations));
  RouteRequest request;
  request.sets = {fmt::format("simulation.segments={}", segments)};
  if (accelerations.empty())
    request.of = options.robot, request.dresspack = options.dresspack, request.motion = options.program;
  else
    request.of = of_urdf.path().string();
  Draft draft = draft_of(request);
  if (const Dresspack& dresspack = draft.job.dresspacks.front().dresspack; !missing_wall(dresspack).empty())
    throw InputError(
        dresspack.where,
        fmt::format(
            "the wall of the hose is not known: bending_stiffness_Nm2 from the construction, {:.3g}, lacks it (nothing was "
            "written)",
            dresspack.bending_stiffness),
        fmt::format(
            "give {} (ESTIMATE) for a corrugated hose, hose_material and inner_diameter_mm for a smooth one, or "
            "bending_stiffness_Nm2 as measured",
            missing_wall(dresspack)));
  fill_tool_space(draft);
  const Choice choice = routing_for(draft, options);
  if (const fs::path folder = fs::path(options.job).parent_path(); !folder.empty()) fs::create_directories(folder);
  write_text_if_changed(options.job, with_mark(text_of(options, draft, choice, accelerations), Mark::yaml));
  print(shown(fmt::format("Job: {}\n", options.job)));
  for (const std::string& doubt : choice.doubts) print(shown(paragraph(doubt)));
  JobCheck of_cables;
  of_cables.ran = choice.ran && !draft.exercise;
  if (of_cables.ran) add_cable_warnings(of_cables, options.job, {});
  print_check(of_cables);
  for (const std::string& note : choice.notes) print(shown(paragraph(note)));
  for (const std::string& estimate : choice.estimates) print(shown(paragraph(estimate)));
  if (draft.tool_space) print(shown(paragraph(tool_space_words(draft))));
  if (options.dresspack_is_example)
    print(fmt::format("Its dresspack {} is an example for a large robot: name yours.\n", default_dresspack));
  if (!accelerations.empty()) print("ESTIMATE: the accelerations of its axes. Replace them by those of your robot.\n");
  if (draft.exercise) print("Fill in its motion.\n");
  if (choice.refused)
    print(
        shown(fmt::format("Fill in its clamps, or let dresslife route {} search: no routing that was tried runs. {}\n",
                          options.job, choice.faults.front())));
  else if (!choice.faults.empty()) {
    for (const std::string& fault : choice.faults) print(shown(paragraph(fault)));
    print(shown(paragraph(fmt::format(
        "No routing of those that were tried keeps all limits{1}. Use {2} above, or dresslife route {0}, which searches longer.",
        options.job, tried_words(choice), choice.remedies_tried ? "another remedy" : "a remedy"))));
  }
  return 0;
}

}  // namespace

Command new_command() {
  const auto options = std::make_shared<NewOptions>();
  return {"new",
          "write a short job with comments for a robot, a program and a dresspack; without options list what can be "
          "chosen",
          {{"job", "", "JOB.yaml to write", &options->job},
           {"--robot", "NAME|URDF", "of config/robots, or a file", &options->robot},
           {"--program", "FILE|NAME", "a robot program, or a motion of config/programs; without it a line to fill in",
            &options->program},
           {"--dresspack", "NAME", "of config/dresspacks, or a file; without it spot_welding", &options->dresspack}},
          [options] { return make(*options); }};
}

}  // namespace dresslife::pipeline
