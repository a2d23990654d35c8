#include "pipeline/study/relative_life.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string_view>
#include <unordered_map>

#include "pipeline/base/digest.h"
#include "pipeline/base/joined.h"
#include "pipeline/base/lists.h"
#include "pipeline/files/files.h"
#include "pipeline/job/job.h"
#include "pipeline/resolve/cable_alone.h"
#include "pipeline/resolve/job_text.h"
#include "pipeline/study/rate.h"

namespace dresslife::pipeline {
namespace {

/// Returns strain.slip of the cable alone: one word per level, outermost first.
std::string slip_alone(const Job& job, const Node& alone, bool is_part, bool was_alone) {
  std::vector<Slip> slip = job.strain.slip;
  const auto levels = static_cast<std::size_t>(levels_of(alone.find("components")->items.front()));
  if (slip.size() == 1) slip.resize(levels, slip.front());
  if (!is_part && !was_alone) slip.insert(slip.begin(), Slip::free);  // the cable's jacket is now a separate level
  slip.resize(levels, slip.back());
  return fmt::format("[{}]", joined(mapped(slip, [](Slip one) { return word(one); }), ", "));
}

class CableStudyMaker {
 public:
  void add(const StudyJob& job) {
    const std::size_t first = made_.cables.size(), rigs = made_.rigs.jobs.size();
    const auto [same, is_new] = known_cables_.try_emplace(settings_of(job.job));
    if (!is_new) {
      made_.cables.insert(made_.cables.end(), same->second.begin(), same->second.end());
      for (std::size_t k = first; k < made_.cables.size(); ++k) made_.cables[k].job = job.name;
      return;
    }
    add_new(job);
    same->second.assign(made_.cables.begin() + static_cast<std::ptrdiff_t>(first), made_.cables.end());
    const auto refused = [](const StudyJob& rig) { return !rig.failure.empty(); };
    // The reason of a rig that cannot run names its job, so each job gets its own.
    if (std::any_of(made_.rigs.jobs.begin() + static_cast<std::ptrdiff_t>(rigs), made_.rigs.jobs.end(), refused))
      known_cables_.erase(same);
  }
  RatedStudy take() { return std::move(made_); }

 private:
  /// Returns a digest of everything in a job from which its rigs follow. Most jobs of a study have those of a few.
  static std::string settings_of(const SharedJob& shared) {
    if (const std::size_t rest = shared.numbers()[index_of(Piece::rest)]) return std::to_string(rest);
    Job job = *shared;
    for (MountedDresspack& mounted : job.dresspacks) mounted.routing = {};
    return xxh3(to_yaml(echo_fields(Describe([&](Fields& f) {
      f.list("dresspacks", job.dresspacks, Need::required, "");
      f.group("strain", job.strain, Need::optional, "");
      f.group("fatigue", job.fatigue, Need::optional, "");
    }))));
  }

  void add_new(const StudyJob& job) {
    const Node written = parse_yaml(job_text(*job.job), job.name);
    const Node* list = written.find("dresspacks");
    for (std::size_t k = 0; k < job.job->dresspacks.size(); ++k) {
      const Node& mounted = list ? list->items[k] : written;
      const Node& dresspack = *mounted.find("dresspack");
      const std::string among_others = list ? mounted.find("name")->text : "";
      for (const std::string& cable : cables_of(dresspack)) add_cable(job, written, dresspack, cable, among_others);
    }
  }

  void add_cable(const StudyJob& job, const Node& written, const Node& dresspack, const std::string& name,
                 const std::string& among_others) {
    const Node alone = cable_alone(dresspack, name, {job.name});
    const Node* ratings = alone.find("components")->items.front().find("ratings");
    for (const Node& one : ratings ? ratings->items : std::vector<Node>{}) {
      Rating rating;
      read_fields(one, rating);
      made_.cables.push_back({job.name, among_others, is_hose(dresspack) ? name : "", name,
                              rig_job(*job.job, written, alone, *one.find("rig"), is_hose(dresspack),
                                      dresspack.find("cable_alone") != nullptr),
                              rig_words(rating.rig), rating.cycles});
    }
  }

  std::string rig_job(const Job& job, const Node& written, const Node& alone, const Node& rig, bool is_part,
                      bool was_alone) {
    Node made;
    made.kind = Node::Kind::map;
    made.where = rig.where;
    made["motion"]["rig"] = rig;
    made["dresspack"] = alone;
    made["strain"] = *written.find("strain");
    std::erase_if(made["strain"].entries, [](const Entry& entry) { return entry.key == "probes"; });
    made["strain"]["slip"] = parse_yaml(slip_alone(job, alone, is_part, was_alone), rig.where.file);
    constexpr double gate_of_rigs = 1e-6;
    if (job.strain.gate > gate_of_rigs)
      std::erase_if(made["strain"].entries, [](const Entry& entry) { return entry.key == "gate"; });
    made["fatigue"] = *written.find("fatigue");
    StudyJob study_job;
    try {
      study_job.job = std::make_shared<const Job>(job_from(made));
      study_job.name = "rig_" + xxh3(job_text(*study_job.job)).substr(0, 16);
    } catch (const InputError& problem) {
      study_job.failure = problem.what();
      study_job.name = "rig_" + xxh3(study_job.failure).substr(0, 16);
    }
    if (known_.insert(study_job.name).second) made_.rigs.jobs.push_back(study_job);
    return study_job.name;
  }

  RatedStudy made_{{"rigs", {}}, {}};
  std::set<std::string> known_;
  std::unordered_map<std::string, std::vector<RatedCable>> known_cables_;  ///< by settings_of() their jobs
};

/// Returns whether the path of a conductor lies in this cable: "signal cable 3/conductor 2" in "signal cable".
bool lies_in(std::string_view path, const RatedCable& rated) {
  for (const std::string& part : {rated.dresspack, rated.cable}) {
    if (part.empty()) continue;
    if (!path.starts_with(part)) return false;
    path.remove_prefix(part.size());
    if (part == rated.cable && path.starts_with(' ')) {
      const std::size_t digits = std::min(path.find_first_not_of("0123456789", 1), path.size());
      if (digits == 1) return false;
      path.remove_prefix(digits);
    }
    if (!path.empty() && path.front() != '/') return false;
    if (!path.empty()) path.remove_prefix(1);
  }
  return true;
}

/// Returns the repeats until the worst of these conductors fails at one place, from median lives. NaN: not known.
double place_life(const std::filesystem::path& life, const RatedCable& where) {
  const FileReader file(life, life_format());
  if (!file.has("/conductor/place_life")) return RankingRow::unknown;
  const auto path = file.read<std::string>("/conductor/component");
  const auto lives = file.read<double>("/conductor/place_life");
  double shortest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < path.size(); ++k)
    if (lies_in(path[k], where)) shortest = std::min(shortest, lives[k]);
  return shortest;
}

/// Sets the relative life of a row. Returns the reason if this is not possible; else empty.
std::string relate_one(const RatedCable& rated, const RankingRow& rig, RankingRow& row) {
  if (!rig.done()) return rig.failure;
  const double program = place_life(row.life_file, rated), cycles = place_life(rig.life_file, {});
  if (std::isnan(program) || std::isnan(cycles)) return "life.h5 does not say when conductors fail at one place";
  if (std::isinf(cycles)) return "the model sees no damage in its rig, to which a program could be related";
  const double per_hour = 3600 / row.repeat_seconds * (cycles / program);
  const RelativeLife relative{rated.name, rated.rig, per_hour, rated.rated_cycles};
  if (!row.relative || relative.hours() < row.relative->hours()) row.relative = relative;
  return "";
}

}  // namespace

bool has_ratings(const Job& job) {
  return std::ranges::any_of(job.dresspacks, [](const MountedDresspack& mounted) {
    const auto& parts = mounted.dresspack.components;
    return !mounted.dresspack.ratings.empty() ||
           std::ranges::any_of(parts, [](const Component& part) { return !part.plain && !part.ratings.empty(); });
  });
}

RatedStudy rated_study(const Study& study) {
  CableStudyMaker maker;
  if (study.keep == Keep::lives)
    return maker.take();  // a relative life needs the damage of every place, which only life.h5 contains
  for (const StudyJob& job : study.jobs)
    if (job.failure.empty() && job.job && has_ratings(job.job.with(Piece::rest))) maker.add(job);
  return maker.take();
}

std::vector<std::string> relate(const RatedStudy& rated, const std::vector<RankingRow>& rigs,
                                std::vector<RankingRow>& rows) {
  std::vector<std::string> silent;
  for (const RatedCable& cable : rated.cables) {
    RankingRow* const row = find_in(rows, &RankingRow::job, cable.job);
    if (!row || !row->done()) continue;
    const RankingRow* const rig = find_in(rigs, &RankingRow::job, cable.rig_job);
    const std::string reason = rig ? relate_one(cable, *rig, *row) : "its rig has not run";
    if (!reason.empty())
      silent.push_back(fmt::format("{}: no relative life of {} ({}): {}", cable.job, cable.name, cable.rig, reason));
  }
  return silent;
}

}  // namespace dresslife::pipeline
