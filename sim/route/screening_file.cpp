#include "sim/route/screening_file.h"

#include <algorithm>
#include <optional>

#include "pipeline/base/lists.h"
#include "pipeline/base/readable.h"
#include "pipeline/base/threads.h"
#include "pipeline/job/job.h"
#include "pipeline/resolve/catalogue.h"
#include "pipeline/resolve/job_text.h"
#include "sim/route/proposal.h"
#include "sim/route/short_run.h"
#include "sim/run/clamp_path.h"
#include "sim/run/other_stiffness.h"

namespace dresslife::sim {
namespace {

using pipeline::InputError;
using pipeline::mapped;
using pipeline::Node;

/// Results for one candidate.
struct Verdict {
  std::string changes, refusal;
  Screening screening;
  std::vector<double> bends{};             // bends of its short run (short_run.h)
  std::optional<pipeline::Setup> setup{};  // present if it is a valid job
};

class Writer {
 public:
  explicit Writer(pipeline::FileWriter& file) : file_(file) {
    std::vector<std::string> names;
    for (int k = 0; k < screened_limits; ++k) names.emplace_back(word(static_cast<ScreenedLimit>(k)));
    file_.set_axis("limit", names.size());
    file_.append("/limit/name", names);
  }

  void write(const std::vector<Verdict>& verdicts) {
    std::vector<double> beyond, times;
    for (const Verdict& of : verdicts) {
      beyond.insert(beyond.end(), of.screening.beyond.begin(), of.screening.beyond.end());
      times.insert(times.end(), of.screening.time.begin(), of.screening.time.end());
    }
    file_.append("/candidate/changes", mapped(verdicts, &Verdict::changes));
    file_.append("/candidate/refusal", mapped(verdicts, &Verdict::refusal));
    file_.append("/candidate/rejected", mapped(verdicts, [](const Verdict& of) {
                   return int{!of.refusal.empty() || of.screening.rejected()};
                 }));
    file_.append("/candidate/beyond", beyond);
    file_.append("/candidate/time", times);
    write_bends(verdicts);
  }

 private:
  /// Writes one row of numbers for each candidate that ran and 0 for the others; writes nothing if none ran.
  void write_bends(const std::vector<Verdict>& verdicts) {
    std::size_t most = 0;
    for (const Verdict& of : verdicts) most = std::max(most, of.bends.size());
    if (most == 0) return;
    file_.set_axis("bend", most);
    for (const Verdict& of : verdicts) {
      std::vector<double> row = of.bends;
      row.resize(most);
      file_.append("/candidate/bend", row);
    }
  }

  pipeline::FileWriter& file_;
};

constexpr auto bracket = static_cast<std::size_t>(ScreenedLimit::bracket);

/// Keeps the screener as long as robot, motion, cell and mounting poses are the same.
class Bench {
 public:
  /// Allows the brackets of this job that exceed (V7), as long as they keep their places.
  void accept_brackets_of(const pipeline::Setup& setup, const Node& document) {
    try {
      built_ = screener_of(setup, document).brackets(setup);
    } catch (const InputError&) {  // the motion of the job cannot be computed; the candidates contain the reason
    }
  }

  Screening screen(const pipeline::Setup& setup, const Node& document) {
    return screener_of(setup, document).screen(setup, built_);
  }

 private:
  const Screener& screener_of(const pipeline::Setup& setup, const Node& document) {
    std::string key;
    for (const char* part : {"robot", "motion", "cell"})
      if (const Node* node = document.find(part)) key += pipeline::to_yaml(*node) + '\n';
    for (const pipeline::MountedDresspack& mounted : setup.dresspacks)
      for (const double angle : mounted.routing.mounting_pose) key += fmt::format("{} ", angle);
    if (!screener_ || key != key_) {
      screener_.emplace(setup, true);
      key_ = key;
    }
    return *screener_;
  }

  std::vector<BracketBeyond> built_;
  std::optional<Screener> screener_;
  std::string key_;
};

Verdict verdict_of(Bench& bench, Node document, const Node& changes) {
  Verdict verdict;
  verdict.changes = pipeline::to_yaml(changes);
  verdict.screening.beyond.fill(0);
  verdict.screening.time.fill(0);
  try {
    for (const pipeline::Entry& change : changes.entries)
      pipeline::set_value(document, change.key, change.value, change.where);
    pipeline::resolve_job(document);
    pipeline::Setup setup = pipeline::setup_from(document);
    setup.motion.longest_wait = settled_after;
    if (setup.motion.is_prescribed())
      throw InputError(setup.motion.where, "a prescribed deformation has no routing to screen", "leave it as it is");
    verdict.screening = bench.screen(setup, document);
    verdict.setup = setup;
  } catch (const InputError& problem) {
    verdict.refusal = problem.what();
  }
  return verdict;
}

/// Makes short runs of the candidates in parallel. A candidate that does not run gets its geometric violation.
void make_short_runs(std::vector<Verdict>& verdicts) {
  std::vector<Verdict*> left;
  for (Verdict& verdict : verdicts)
    if (verdict.setup) left.push_back(&verdict);
  std::vector<RoutingRun> done(left.size());
  const std::size_t threads = std::min(pipeline::thread_count(), left.size());
  pipeline::in_parallel(threads, [&](std::size_t part) {
    for (std::size_t k = part; k < left.size(); k += threads)
      done[k] = short_run_of(*left[k]->setup, routing_run_segments, routing_run_repeats);
  });
  for (std::size_t k = 0; k < left.size(); ++k) {
    left[k]->refusal = done[k].refusal;
    if (!done[k].refusal.empty()) continue;
    done[k].seen.beyond[bracket] = left[k]->screening.beyond[bracket];
    done[k].seen.time[bracket] = left[k]->screening.time[bracket];
    left[k]->screening = done[k].seen, left[k]->bends = std::move(done[k].bends);
  }
}

std::string vector_text(const pipeline::Vector3d& v, int decimals) {
  std::string text;
  for (int k = 0; k < 3; ++k) text += (k ? ", " : "") + pipeline::short_decimal(v[k], decimals);
  return "[" + text + "]";
}

std::string place_text(const std::string& link, const pipeline::Vector3d& position,
                       const pipeline::Vector3d& direction) {
  return fmt::format("link: {}, position_m: {}, direction: {}", link, vector_text(position, 3),
                     vector_text(direction, 2));
}

std::string routing_text(const pipeline::Routing& routing) {
  const auto clamp = [](const pipeline::Clamp& of) { return place_text(of.link, of.position, of.direction); };
  std::string text = fmt::format("base_clamp: {{{}}}\n", clamp(*routing.base_clamp));
  if (!routing.rings.empty()) text += "rings:\n";
  for (const pipeline::GuideRing& ring : routing.rings)
    text += fmt::format("  - {{{}, radius_mm: {:.4g}, width_mm: {:.4g}, friction_coefficient: {:.4g}}}\n",
                        place_text(ring.link, ring.position, ring.direction), 1e3 * ring.radius, 1e3 * ring.width,
                        ring.friction);
  return text + fmt::format("tool_clamp: {{{}}}\nfree_length_m: {:.3f}\nside: {}\n", clamp(*routing.tool_clamp),
                            routing.free_length, pipeline::word(routing.side));
}

}  // namespace

void write_screening(const pipeline::Job& job, const std::filesystem::path& candidates, bool in_runs,
                     pipeline::FileWriter& file) {
  const Node list = pipeline::read_yaml(candidates);
  if (!list.is_list())
    throw InputError(list.where, "holds no list of changes", "write a list of maps {KEY.PATH: VALUE}");
  const Node document = pipeline::parse_yaml(pipeline::job_text(job), candidates.string());
  std::vector<Verdict> verdicts;
  Bench bench;
  if (!job.motion.is_prescribed()) bench.accept_brackets_of(job, document);
  for (const Node& changes : list.items) {
    if (!changes.is_map())
      throw InputError(changes.where, "is no map of key paths to values", "write {KEY.PATH: VALUE, ...}");
    verdicts.push_back(verdict_of(bench, document, changes));
  }
  if (in_runs) make_short_runs(verdicts);
  Writer(file).write(verdicts);
  file.attribute("motion", "");
}

void write_proposals(const pipeline::Job& job, ProposalSettings settings, pipeline::FileWriter& file) {
  std::vector<Verdict> verdicts;
  settings.softer = softer_hose(job.uncertainty);
  pipeline::Job sided = job;  // a hose that rests on both sides is mounted on the side that the proposal states
  pipeline::Routing& routing = sided.dresspacks.front().routing;
  if (routing.side == pipeline::Side::either) routing.side = pipeline::Side::left;
  for (const Proposal& proposal : propose(sided, settings)) {
    const bool has_short_run = settings.short_runs > 0 && proposal.short_run.refusal.empty();
    verdicts.push_back({routing_text(proposal.routing), proposal.short_run.refusal,
                        has_short_run ? proposal.short_run.seen : proposal.screening});
  }
  Writer(file).write(verdicts);
  file.attribute("motion", pipeline::motion_text(job.motion));
}

}  // namespace dresslife::sim
