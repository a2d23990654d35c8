#include "pipeline/commands/command.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <memory>
#include <optional>

#include "pipeline/advise/route/draft.h"
#include "pipeline/advise/route/routing_search.h"
#include "pipeline/base/errors.h"
#include "pipeline/base/installation.h"
#include "pipeline/base/whole_file.h"
#include "pipeline/commands/making.h"
#include "pipeline/commands/options.h"
#include "pipeline/commands/pictures.h"
#include "pipeline/commands/results.h"
#include "pipeline/files/digest.h"
#include "pipeline/report/page_shell.h"
#include "pipeline/report/preview_page.h"
#include "pipeline/resolve/job_text.h"
#include "pipeline/study/folder_lock.h"
#include "pipeline/study/stage_program.h"

namespace dresslife::pipeline {
namespace {

namespace fs = std::filesystem;

struct Options : RunOptions {
  RouteRequest request;
  RoutingRequest search;
  std::string job, scale = "auto";
};

/// What was found in one size of the dresspack.
struct Sized {
  double factor = 1;
  RoutingFound found;
  const RoutingTrial& best() const { return found.trials[*found.best]; }
};

constexpr std::string_view mark = "# Proposed by dresslife route";

/// A job that it wrote itself may be replaced.
void check_job_file(const fs::path& file) {
  check_replaceable(file);
  std::error_code failure;
  if (fs::exists(file, failure) && beginning_of(file, mark.size()) != mark)
    throw InputError({file.string()}, "is there already and was not proposed by dresslife route",
                     "name another file after --job");
}

RunRouting runner(const Draft& draft, double factor, const Options& options, const StudyPlaces& places) {
  return [&, factor](const std::string& routing, const std::string& motion, std::size_t trial) {
    Study study{fmt::format("{} at {:.0f} %", draft.name, 100 * factor), {}};
    study.jobs.push_back({fmt::format("{:.0f}_percent_{}", 100 * factor, trial + 1),
                          std::make_shared<const Job>(job_from(routed(draft, routing, motion, factor))), ""});
    const RankingRow row = made_rows(study, places, options).front();
    return outcome_of(row, places.job(row.job));
  };
}

/// What stood against the best routing in this size.
std::string obstacle(const RoutingFound& found) {
  return found.best ? found.trials[*found.best].outcome.words() : found.obstacle;
}

std::vector<double> factors_of(const Options& options) {
  if (options.scale == "auto") return {1, 0.8, 0.65, 0.5, 0.4, 0.3};
  double factor = 0;
  if (!CLI::detail::lexical_cast(options.scale, factor) || !(factor >= 0.05 && factor <= 2))
    throw InputError({"--scale"},
                     fmt::format("'{}' is neither auto nor a number from 0.05 to 2", options.scale),
                     "write one");
  return {factor};
}

void write_page(const fs::path& job, const fs::path& page) {
  const PassingFile told("preview.h5");
  if (tell_preview(job, {}, {}, told.path()) == 0)
    write_text_if_changed(page, preview_page(told.path(), job.stem().string(), xxh3(shell_digest())));
}

std::string words_of(const Sized& chosen, const Draft& draft) {
  const Outcome& best = chosen.best().outcome;
  const Dresspack& dresspack = draft.job.dresspacks.front().dresspack;
  std::string text = chosen.best().routing;
  if (chosen.factor != 1)
    text += fmt::format(
        "This is not for {} as it is but for one of the same make at {:.0f} % of its size, {:.0f} mm wide\n",
        dresspack.name, 100 * chosen.factor, 1e3 * dresspack.diameter * chosen.factor);
  if (draft.exercise)
    text += "No program was given: the wrist was only moved about. Look again with yours.\n";
  const std::string life =
      std::isinf(best.hours) ? "no wire is damaged" : fmt::format("p10 life {:.3g} h", best.hours);
  return text + (best.feasible()
                     ? fmt::format("It keeps all limits in a run; {}.\n", life)
                     : fmt::format("It runs, but no routing was found that keeps all limits: {}; {}.\n",
                                   best.words(), life));
}

/// The biggest size in which a routing keeps all limits, else the best that runs.
std::optional<Sized> found_in_sizes(const Draft& draft, const Options& options, const StudyPlaces& places) {
  std::optional<Sized> chosen, nearest;
  for (const double factor : factors_of(options)) {
    const RunRouting run = runner(draft, factor, options, places);
    Sized sized{factor, find_routing(draft, factor, options.search, places.folder, run)};
    const bool feasible = sized.found.feasible();
    if (!feasible)
      tell(fmt::format("note: at {:.0f} % of the dresspack's size: {}\n", 100 * factor, obstacle(sized.found)));
    if (sized.found.best && (!chosen || better(sized.best(), chosen->best())))
      chosen = std::move(sized);
    else if (!nearest || sized.found.violation < nearest->found.violation)
      nearest = std::move(sized);
    if (feasible) break;
  }
  if (!chosen && !nearest->found.nearest.empty()) {
    const RunRouting run = runner(draft, nearest->factor, options, places);
    RoutingFound& found = nearest->found;
    found.add({found.nearest, run(found.nearest, found.motion, found.trials.size())});
    if (found.best) chosen = std::move(nearest);
  }
  return chosen;
}

int route(const Options& options) {
  const Draft draft = draft_of(options.request);
  const fs::path job = options.job.empty() ? fs::path(draft.name + "_routed.yaml") : fs::path(options.job);
  const fs::path page = job.parent_path() / (job.stem().string() + "_preview.html");
  check_job_file(job);
  check_replaceable(page);
  const StudyPlaces places{fs::path(options.out) / (draft.name + "_route"), program_folder()};
  const FolderLock lock(places.folder);
  const std::optional<Sized> chosen = found_in_sizes(draft, options, places);
  if (!chosen)
    throw InputError({options.request.of},
                     "no routing was found that runs (the notes above say what stands against it)",
                     "try other links (--from, --to), another --seed, a ring, or a gentler program");
  const Node document = routed(draft, chosen->best().routing, chosen->found.motion, chosen->factor);
  write_text_if_changed(job, fmt::format("{} {}\n{}", mark, options.request.of, to_yaml(document)));
  write_page(job, page);
  print(shown(words_of(*chosen, draft)));
  print(shown(fmt::format("Job: {}\nPreview: {}\n", job.string(), page.string())));
  return 0;
}

}  // namespace

Command add_route(CLI::App& program) {
  const auto options = std::make_shared<Options>();
  CLI::App* words = program.add_subcommand("route",
                                           "propose a routing from nothing: clamps on two links and a "
                                           "length, tried in a run, as a job with its preview");
  words->add_option("of", options->request.of, "JOB.yaml whose routing does not count, or a ROBOT")
      ->required()
      ->type_name("");
  words
      ->add_option("--dresspack", options->request.dresspack, "instead of the job's; of a robot spot_welding")
      ->type_name("NAME");
  words
      ->add_option("--motion", options->request.motion,
                   "instead of the job's; of a robot one that moves its wrist about")
      ->type_name("NAME");
  words
      ->add_option("--from", options->request.base_link,
                   "link of the base clamp; else the job's, or that which axis 3 moves")
      ->type_name("LINK");
  words->add_option("--to", options->request.tool_link, "link of the tool clamp; else the job's, or the last")
      ->type_name("LINK");
  words->add_option("--ring", options->search.ring_link, "also a guide ring on this link")->type_name("LINK");
  words->add_option("--scale", options->scale, "of the dresspack's size; auto: as it is, or as big as goes")
      ->type_name("auto|FACTOR")
      ->capture_default_str();
  words->add_option("--tried", options->search.tried, "routings that geometry looks at, of each size")
      ->check(CLI::Range(1, 1'000'000))
      ->type_name("COUNT")
      ->capture_default_str();
  words
      ->add_option("--rehearsals", options->search.rehearsals,
                   "short runs by which the search goes on from the best of them, of each size")
      ->check(CLI::Range(1, 100'000))
      ->type_name("COUNT")
      ->capture_default_str();
  words->add_option("--seed", options->search.seed, "of the search's chances")
      ->check(CLI::Range(0, 1'000'000'000))
      ->capture_default_str();
  words->add_option("--job", options->job, "job to write; else NAME_routed.yaml here")
      ->type_name("FILE.yaml");
  words->add_option("-o,--output", options->out, "folder of the runs that try it")
      ->type_name("DIR")
      ->capture_default_str();
  add_run_options(*words, *options);
  add_sets(*words, "override a key of the job", options->request.sets);
  return {words, [options] { return route(*options); }};
}

}  // namespace dresslife::pipeline
