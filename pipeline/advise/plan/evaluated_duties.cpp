#include "pipeline/advise/plan/evaluated_duties.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <set>
#include <span>
#include <unordered_map>
#include <utility>

#include "pipeline/advise/plan/pooled_lives.h"
#include "pipeline/advise/plan/rounds.h"
#include "pipeline/base/joined.h"
#include "pipeline/base/lists.h"
#include "pipeline/base/plain_file.h"
#include "pipeline/base/readable.h"
#include "pipeline/base/text.h"
#include "pipeline/base/threads.h"
#include "pipeline/base/warning_words.h"
#include "pipeline/base/whole_file.h"
#include "pipeline/files/files.h"
#include "pipeline/job/job.h"
#include "pipeline/resolve/job_text.h"
#include "pipeline/settings/fields.h"
#include "pipeline/study/row_warnings.h"
#include "pipeline/study/row_words.h"
#include "pipeline/study/study_problems.h"

namespace dresslife::pipeline {
namespace {

constexpr double fewest_survivors =
    1e-3;  // share of the samples: percentiles of fewer than ten samples depend on chance

/// Finds the jobs of a study by their names.
class Jobs {
 public:
  explicit Jobs(const Study& study) : study_(study) {
    for (const StudyJob& job : study.jobs) by_name_.emplace(job.name, &job);
  }
  /// Returns null if no such job exists or it is invalid.
  const StudyJob* find(const std::string& name) const {
    const auto found = by_name_.find(name);
    return found == by_name_.end() || !found->second->job ? nullptr : found->second;
  }
  /// Errors: InputError if the program is not a job of the study.
  const StudyJob& of(const DutyProgram& program) const {
    if (const auto found = by_name_.find(program.job); found != by_name_.end()) return *found->second;
    const std::string near = nearest_word(program.job, mapped(study_.jobs, &StudyJob::name));
    throw InputError(program.where, fmt::format("study '{}' has no job '{}'", study_.name, program.job),
                     near.empty() ? "dresslife status STUDY lists its jobs" : fmt::format("did you mean '{}'?", near));
  }

 private:
  const Study& study_;
  std::unordered_map<std::string_view, const StudyJob*> by_name_;
};

/// Returns all sections of a job except the motion. The damage of two jobs can be added if their sections are equal.
std::map<std::string, std::string> beside_motion(const Job& job) {
  const Node text = parse_yaml(job_text(job), "job");
  std::map<std::string, std::string> sections;
  for (const Entry& section : text.entries)
    if (section.key != "motion" && section.key != "name") sections[section.key] = to_yaml(section.value);
  return sections;
}

/// Returns the job as text without its motion. Equal texts have equal sections except the motion.
std::string text_beside_motion(Job job) {
  job.motion = {};
  return job_text(job);
}

/// Returns a number for each different beside_motion() of the programs in a file; jobs with one result share one Job. Jobs with
/// equal texts are read once, because reading a job takes milliseconds.
std::map<const Job*, std::size_t> sections_of(const DutyFile& file, const Jobs& jobs) {
  std::map<const Job*, std::size_t> numbers;
  std::map<std::string, std::size_t> texts;
  std::map<PieceNumbers, std::size_t> known;  // (numbers of the pieces beside the motion)
  std::map<std::map<std::string, std::string>, std::size_t> sections;
  for (const Duty& duty : file.duties)
    for (const DutyProgram& program : duty.programs)
      if (const StudyJob* const of = jobs.find(program.job); of && !numbers.contains(of->job.get())) {
        const Job* const job = of->job.get();
        PieceNumbers pieces = of->job.numbers();
        pieces[index_of(Piece::motion)] = 0;
        if (const auto same = known.find(pieces); pieces != PieceNumbers{} && same != known.end()) {
          numbers[job] = same->second;
          continue;
        }
        const auto [text, is_new] = texts.try_emplace(text_beside_motion(*job), 0);
        if (is_new) text->second = sections.try_emplace(beside_motion(*job), sections.size()).first->second;
        numbers[job] = text->second;
        known.emplace(pieces, text->second);
      }
  return numbers;
}

void check_same_dresspack(const DutyFile& file, const Duty& duty, const Jobs& jobs,
                          const std::map<const Job*, std::size_t>& sections) {
  const StudyJob& first = jobs.of(duty.programs.front());
  if (!first.job) return;
  std::set<const Job*> known{first.job.get()};
  std::vector<DutyProgram> programs = duty.programs;
  for (const PastDuty& past : duty.history) {
    const std::vector<DutyProgram>& before = duty_named(file, past.duty, past.where).programs;
    programs.insert(programs.end(), before.begin(), before.end());
  }
  for (const DutyProgram& program : programs) {
    const StudyJob& job = jobs.of(program);
    if (!job.job || !known.insert(job.job.get()).second || sections.at(job.job.get()) == sections.at(first.job.get()))
      continue;
    const auto expected = beside_motion(*first.job);
    for (const auto& [key, text] : beside_motion(*job.job)) {
      const auto found = expected.find(key);
      if (found == expected.end() || found->second != text)
        throw InputError(
            program.where,
            fmt::format("jobs '{}' and '{}' differ in {}, so their damage does not add up", first.name, job.name, key),
            "a duty takes jobs that differ only in motion");
    }
  }
}

constexpr double turned = 20;  // [deg]: on one metre of hose a tenth of the twist that makers allow

/// Returns the joint angles [rad] in which a job's program starts; empty: not known.
std::vector<double> first_pose_in(const Job& job) {
  return job.motion.steps.empty() ? std::vector<double>{} : job.motion.steps.front().joints;
}

/// Returns the same for a robot program in a file, from its strain file. axes: joints of the robot; further axes move other
/// machines.
std::vector<double> first_pose_in(const RankingRow& row, std::size_t axes) {
  const std::filesystem::path strain = row.life_file.parent_path() / "strain.h5";
  std::vector<double> pose;
  if (!row.has_result() || kind_of(strain) != FileKind::file) return pose;
  const FileReader file(strain, strain_format());
  if (!file.has("/robot/joint_position")) return pose;
  file.read_rows("/robot/joint_position", 0, 1, pose);
  if (pose.size() > axes) pose.resize(axes);
  return pose;
}

bool is_turned(const std::vector<double>& a, const std::vector<double>& b) {
  for (std::size_t axis = 0; axis < std::min(a.size(), b.size()); ++axis)
    if (std::abs(a[axis] - b[axis]) > turned * std::numbers::pi / 180) return true;
  return false;
}

/// The poses in which the programs of duties start. The pose of a file is read once.
class FirstPoses {
 public:
  /// rows: rows of the study after its run; null: before the run.
  FirstPoses(const Study& study, const std::vector<RankingRow>* rows) : jobs_(study), runs_(rows) {
    if (rows)
      for (const RankingRow& row : *rows) rows_.emplace(row.job, &row);
  }
  /// Returns a warning if each program of the duty mounts the hose in another pose. Before the run it compares poses in jobs,
  /// after the run also poses of program files; a warning that was possible before the run is not repeated.
  std::optional<Warning> warning_of_mounting(const Duty& duty) {
    const StudyJob& first = jobs_.of(duty.programs.front());
    if (!first.job || !first.job->motion.needs_robot() || first.job->dresspacks.empty() ||
        !first.job->dresspacks.front().routing.mounting_pose.empty())
      return std::nullopt;
    for (const DutyProgram& program : duty.programs) {
      const StudyJob& other = jobs_.of(program);
      if (!other.job || other.job == first.job || other.name == first.name) continue;
      const bool in_jobs = !first_pose_in(*first.job).empty() && !first_pose_in(*other.job).empty();
      if (in_jobs == runs_) continue;
      const std::vector<double>&a = of(first), &b = of(other);
      const bool known = !a.empty() && !b.empty();
      if (!known && !runs_) continue;
      if (known && !is_turned(a, b)) continue;
      return warning(program, first.name, other.name, known);
    }
    return std::nullopt;
  }

 private:
  const std::vector<double>& of(const StudyJob& job) {
    const auto [found, is_new] = poses_.try_emplace(job.name);
    if (!is_new) return found->second;
    found->second = first_pose_in(*job.job);
    const auto row = rows_.find(job.name);
    if (found->second.empty() && row != rows_.end()) found->second = first_pose_in(*row->second, job.job->robot.axes());
    return found->second;
  }
  static Warning warning(const DutyProgram& program, const std::string& first, const std::string& other, bool known) {
    return warning_of(
        WarningKind::twist, program.where.text(),
        fmt::format("the hose is mounted without twist in the first pose of '{}' and again in that of '{}' ({})", first,
                    other,
                    known ? fmt::format("an axis differs by more than {:g} deg", turned)
                          : "these poses are not known, because the study keeps no strain.h5"),
        "the study has no routing.mounting_pose_deg",
        "routing.mounting_pose_deg: the joint angles in which the clamps were closed, for all programs");
  }

  Jobs jobs_;
  bool runs_;
  std::unordered_map<std::string_view, const RankingRow*> rows_;
  std::map<std::string, std::vector<double>> poses_;
};

[[noreturn]] void refuse_without_samples(const DutyProgram& program) {
  throw InputError(program.where, fmt::format("job '{}' has no samples of uncertain parameters", program.job),
                   "set uncertainty.enabled: true in the study");
}

/// Returns the round of a duty as a program. Precondition: the duty has an order.
DutyProgram program_of_round(const Duty& duty) {
  DutyProgram round;
  round.where = duty.order.front().where, round.job = round_name(duty);
  return round;
}

/// Results of the programs of all duties. Jobs that share their last stage are read once.
class Programs {
 public:
  Programs(const Study& study, const std::vector<RankingRow>& rows) : jobs_(study) {
    for (const RankingRow& row : rows) rows_.emplace(row.job, &row);
  }

  /// Returns all programs of a duty, on one dresspack.
  std::vector<EvaluatedProgram> of(const Duty& duty) {
    const std::vector<EvaluatedProgram> all =
        mapped(duty.programs, [&](const DutyProgram& program) { return of(program); });
    for (const EvaluatedProgram& program : all) check_layout(duty, all.front(), program.job, *program.wires);
    return all;
  }
  /// Returns the damage of the round of a duty's order, at the medians of the uncertain parameters; empty: no order.
  std::optional<WireDamage> round_of(const Duty& duty, const EvaluatedProgram& first) {
    if (duty.order.empty()) return std::nullopt;
    const DutyProgram round = program_of_round(duty);
    WireDamage wires = damages_.read(row(round).life_file, *first.modes, failed_wires_percent(round));
    check_layout(duty, first, round.job, wires);
    return wires;
  }
  const RankingRow& row(const DutyProgram& program) const {
    const auto row = rows_.find(program.job);
    if (row == rows_.end() || !row->second->done())
      throw InputError(
          program.where,
          fmt::format("job '{}' has no result{}", program.job, row == rows_.end() ? "" : ": " + row->second->failure),
          "correct the job and run again");
    return *row->second;
  }

  /// Returns null if the job is invalid.
  const Job* job(const DutyProgram& program) const { return jobs_.of(program).job.get(); }

  std::vector<RankingRow> rows(const Duty& duty) const {
    return mapped(duty.programs, [&](const DutyProgram& program) -> const RankingRow& { return row(program); });
  }

 private:
  static void check_layout(const Duty& duty, const EvaluatedProgram& first, const std::string& job,
                           const WireDamage& wires) {
    if (wires.layout != first.wires->layout && wires.layout->digest != first.wires->layout->digest)
      throw InputError(duty.where, fmt::format("the results of '{}' and '{}' have different wires", first.job, job),
                       "make the results again with dresslife run");
  }

  double failed_wires_percent(const DutyProgram& program) const {
    return jobs_.of(program).job->fatigue.failed_wires_percent;
  }

  EvaluatedProgram of(const DutyProgram& program) {
    const RankingRow& of = row(program);
    if (!of.has_wires()) refuse_without_wires(program.where, program.job);
    if (of.life_response.empty()) refuse_without_samples(program);
    // Jobs that share a result have hard links to one file (shared_stages.h).
    const FileState state = state_of(of.life_file);
    auto& [modes, wires] = lives_[{state.inode, state.changed_ns}];
    if (!modes) {
      modes = std::make_shared<const FailureModes>(modes_from_text(of.life_response));
      wires = std::make_shared<const WireDamage>(damages_.read(of.life_file, *modes, failed_wires_percent(program)));
    }
    return {of.job, of.repeat_seconds, modes, wires};
  }

  const Jobs jobs_;
  std::unordered_map<std::string_view, const RankingRow*> rows_;
  std::map<std::pair<std::uint64_t, std::int64_t>,
           std::pair<std::shared_ptr<const FailureModes>, std::shared_ptr<const WireDamage>>>
      lives_;  ///< key: inode and time of change
  WireDamages damages_;
};

/// Numbers of the different results and of the different jobs among the programs of duties.
struct Shares {
  std::vector<std::vector<std::size_t>> result, job;  ///< (duty, program) number of the result, number of the job
  std::vector<std::size_t> programs_of_result, programs_of_job;
  std::vector<const FailureModes*> modes_of_result;

  explicit Shares(std::span<const std::vector<EvaluatedProgram>> duties) {
    std::unordered_map<const FailureModes*, std::size_t> results;
    std::unordered_map<std::string_view, std::size_t> jobs;
    const auto number_in = [](auto& known, const auto& key, std::vector<std::size_t>& counts) {
      const auto [found, is_new] = known.try_emplace(key, counts.size());
      if (is_new) counts.push_back(0);
      ++counts[found->second];
      return found->second;
    };
    for (const std::vector<EvaluatedProgram>& duty : duties) {
      result.emplace_back(), job.emplace_back();
      for (const EvaluatedProgram& program : duty) {
        result.back().push_back(number_in(results, program.modes.get(), programs_of_result));
        if (modes_of_result.size() < programs_of_result.size()) modes_of_result.push_back(program.modes.get());
        job.back().push_back(number_in(jobs, std::string_view(program.job), programs_of_job));
      }
    }
  }
};

/// Damage of one repeat for one dresspack in each world. Programs with one result share it until the last duty has used it;
/// duties with one program share it, too. Later values take the memory of these, because new memory costs a quarter of the time.
class DrawDamage {
 public:
  /// prepared: (result).
  DrawDamage(const Shares& shares, const std::vector<PreparedModes>& prepared, std::size_t worlds)
      : worlds_(worlds),
        shares_(shares),
        prepared_(prepared),
        damage_(shares.programs_of_result.size()),
        factors_(shares.programs_of_job.size()) {}
  /// Begins with another dresspack.
  void begin(std::size_t draw) {
    dresspack_ = fmt::format("dresspack {}", draw);
    lives_.emplace(dresspack_, worlds_);
    for (std::size_t k = 0; k < damage_.size(); ++k) damage_[k].programs = shares_.programs_of_result[k];
    for (std::size_t k = 0; k < factors_.size(); ++k) factors_[k].programs = shares_.programs_of_job[k];
  }
  /// Returns, (world), the damage of the mode that fails first. Precondition: each duty is requested once after begin().
  std::vector<double> under(std::size_t duty, const std::vector<EvaluatedProgram>& programs,
                            const std::vector<Rate>& rates, const std::vector<double>& share) {
    const auto number = [&](const EvaluatedProgram& program) {
      return static_cast<std::size_t>(&program - programs.data());
    };
    std::vector<double> damage = first_mode_damage(
        programs, rates, share,
        [&](const EvaluatedProgram& program) -> const RepeatDamage& {
          const std::size_t result = shares_.result[duty][number(program)];
          RepeatDamage& of_repeat = damage_[result].value;
          if (of_repeat.empty()) of_repeat = damage_of_lives(lives_->of(prepared_[result], taken_from(spare_damage_)));
          return of_repeat;
        },
        [&](const EvaluatedProgram& program, double deviation_percent) -> const std::vector<double>& {
          auto& [deviation, factors] = factors_[shares_.job[duty][number(program)]].value;
          if (factors.empty() || deviation != deviation_percent)
            deviation = deviation_percent,
            factors = repeat_factors(program.job, deviation_percent, dresspack_, worlds_,
                                     factors.empty() ? taken_from(spare_factors_) : std::move(factors));
          return factors;
        });
    for (const std::size_t result : shares_.result[duty])
      if (--damage_[result].programs == 0) spare_damage_.push_back(std::exchange(damage_[result].value, {}));
    for (const std::size_t job : shares_.job[duty])
      if (--factors_[job].programs == 0) spare_factors_.push_back(std::exchange(factors_[job].value.second, {}));
    return damage;
  }

 private:
  template <class Value>
  struct Shared {
    std::size_t programs = 0;  ///< number of programs that still need the value
    Value value{};
  };
  template <class List>
  static List taken_from(std::vector<List>& spare) {
    if (spare.empty()) return {};
    List last = std::move(spare.back());
    spare.pop_back();
    return last;
  }
  std::string dresspack_;
  std::size_t worlds_;
  const Shares& shares_;
  const std::vector<PreparedModes>& prepared_;
  std::optional<ModeLives> lives_;
  std::vector<RepeatDamage> spare_damage_;          ///< their memory
  std::vector<std::vector<double>> spare_factors_;  ///< their memory
  std::vector<Shared<RepeatDamage>> damage_;
  std::vector<Shared<std::pair<double, std::vector<double>>>> factors_;
};

/// Returns the repeats per hour, (program).
std::vector<double> repeats_of(const std::vector<DutyPart>& parts) {
  return mapped(parts, &DutyPart::repeats_per_hour);
}

/// The time that the programs of a duty take in an hour of operation.
class HourOfDuty {
 public:
  void add(double repeats, double seconds, const std::string& what) {
    time_ += repeats * seconds / 3600;
    constexpr double short_time = 0.1;
    words_ += fmt::format("{}{} x {} s of {}", words_.empty() ? "" : ", ", readable(repeats),
                          std::abs(seconds) < short_time ? readable(seconds, 2) : fmt::format("{:.1f}", seconds), what);
  }
  /// moves: time of the moves between the programs of a round.
  void add_moves(double rounds, double moves) {
    add(rounds, moves, "moves between them");
    moves_ = rounds * moves / 3600;
  }
  /// Errors: InputError if the programs take longer than the hour.
  void check(const Duty& duty) const {
    constexpr double rounding = 1e-4;  // of the times of repeats; it changes no life
    if (time_ > 1 + rounding)
      throw InputError(
          duty.where,
          fmt::format("the programs of duty '{}' take {:.1f} minutes of each hour ({})", duty.name, 60 * time_, words_),
          moves_ > 0 ? fmt::format("give fewer repeats, or shares of the time that leave {} % for the moves",
                                   readable(100 * moves_, 2))
                     : "give fewer repeats, or smaller shares of the time");
  }

 private:
  double time_ = 0, moves_ = 0;
  std::string words_;
};

std::vector<Rate> rates_of(const Duty& duty, Programs& programs, std::vector<DutyPart>& parts) {
  std::vector<Rate> rates;
  HourOfDuty hour;
  for (const DutyProgram& program : duty.programs) {
    const double seconds = programs.row(program).repeat_seconds;
    const double rate = program.rate(seconds, duty.shift_hours, duty.repeats_per_hour);
    rates.push_back({rate, program.deviation_percent});
    parts.push_back({.job = program.job,
                     .repeats_per_hour = rate,
                     .share_of_time = rate * seconds / 3600,
                     .recording_of = program.recording_of});
    hour.add(rate, seconds, fmt::format("'{}'", program.job));
  }
  if (!duty.order.empty()) {
    double moves = programs.row(program_of_round(duty)).repeat_seconds;  // moves between the programs of a round
    for (const OrderedProgram& ordered : duty.order)
      for (const DutyProgram& program : duty.programs)
        if (program.job == ordered.job) moves -= programs.row(program).repeat_seconds;
    hour.add_moves(repeats_in_rounds(duty, repeats_of(parts)).back(), moves);
  }
  hour.check(duty);
  return rates;
}

/// Returns whether the order without this program would still have changes. No round was computed for them.
bool leaves_changes(const Duty& duty, const std::string& job) {
  std::set<std::string> order;
  for (const OrderedProgram& program : duty.order) order.insert(program.job);
  return order.erase(job) > 0 && order.size() > 1;
}

/// Computes lives for other numbers of repeats, for one program at a time.
void vary_repeats(const Duty& duty, const SamePlace& places, DutyResult& result) {
  constexpr int steps = 10;  // points of a chart
  constexpr double not_known = std::numeric_limits<double>::quiet_NaN();
  const std::vector<double> repeats = repeats_of(result.parts);
  const double idle = sum_of(
      result.parts, [](const DutyPart& part) { return -part.share_of_time; }, 1.0);
  for (std::size_t k = 0; k < repeats.size(); ++k) {
    DutyPart& part = result.parts[k];
    const bool leaves = leaves_changes(duty, part.job);
    const auto lives_at = [&](double factor) {
      if (factor == 0 && leaves) return LifePercentiles{not_known, not_known, not_known};
      std::vector<double> times(repeats.size(), 1), changed = repeats;
      times[k] = factor, changed[k] *= factor;
      return lives_with(result.damage, times, places.at(changed, repeats_in_rounds(duty, changed)));
    };
    part.without = lives_at(0), part.as_twice = lives_at(2);
    if (part.share_of_time > idle * (1 + 1e-9)) part.as_twice.fill(not_known);  // the hour is too short
    if (!(part.share_of_time > 0)) continue;
    const double most =
        std::max(part.share_of_time, part.share_of_time + idle);  // at least the present share, without rounding
    for (int i = 0; i <= steps; ++i)
      part.over_share.push_back({most * i / steps, lives_at(most * i / steps / part.share_of_time)});
  }
}

/// Returns DutyPart::at_other_rests, for the mode that fails first at the medians.
std::array<double, 2> at_other_rests(const FailureModes& modes) {
  const std::size_t rest = index_of(Uncertain::rest);
  const auto at = static_cast<Eigen::Index>(rest);
  const auto beside_median = [&](const LifeResponse& mode, double by) {
    ParameterPoint z{};
    z[rest] = mode.knowledge.mean(at) + by;  // z counts from the job's own rest
    return z;
  };
  const auto median = [&](const LifeResponse& mode) {
    return LifeSurface(mode).log10_life(beside_median(mode, 0), 0, Inside::as_is);
  };
  const LifeResponse& first = *std::ranges::min_element(modes, {}, median);
  const double deviation = std::sqrt(first.knowledge.covariance(at, at));
  if (!(deviation > 0)) return {};
  const LifeSurface life(first);
  std::array<double, 2> ratios{1, 1};
  if (!life.depends_on(rest)) return ratios;
  for (const int side : {-1, 1})
    ratios[side > 0] =
        std::pow(10, life.change(beside_median(first, 0)) - life.change(beside_median(first, side * deviation)));
  return ratios;
}

}  // namespace

std::vector<DutyMode> other_modes(const std::vector<DutyPart>& parts, const std::vector<RankingRow>& rows) {
  std::vector<DutyMode> modes;
  std::vector<std::array<double, 2>> per_hour;                  // (mode) early, median
  const auto is_predicted = [&](const UnvalidatedMode& mode) {  // by all programs that run
    for (std::size_t k = 0; k < parts.size(); ++k)
      for (const UnvalidatedMode& one : rows[k].unvalidated)
        if (parts[k].share_of_time > 0 && one.mode == mode.mode && one.dresspack == mode.dresspack && !is_credible(one))
          return false;
    return is_credible(mode);
  };
  for (std::size_t k = 0; k < parts.size(); ++k)
    for (const UnvalidatedMode& mode : rows[k].unvalidated) {
      if (!is_predicted(mode)) continue;
      const std::string part = mode.mode == UnvalidatedMode::rating ? mode.place : "";
      const auto found = std::ranges::find_if(modes, [&](const DutyMode& one) {
        return one.mode == mode.mode && one.dresspack == mode.dresspack && one.place == part;
      });
      const auto at = static_cast<std::size_t>(found - modes.begin());
      if (found == modes.end()) modes.push_back({mode.mode, mode.dresspack, part}), per_hour.emplace_back();
      per_hour[at][0] += parts[k].share_of_time / mode.early_hours();
      per_hour[at][1] += parts[k].share_of_time / mode.hours[1];
      modes[at].visible_from = std::fmax(modes[at].visible_from, mode.visible_from);
    }
  for (std::size_t m = 0; m < modes.size(); ++m)
    modes[m].hours = 1 / per_hour[m][0], modes[m].median = 1 / per_hour[m][1];
  return modes;
}

void check_programs(const DutyFile& file, const Study& study) {
  if (study.keep == Keep::lives)
    throw InputError(
        file.where,
        fmt::format("study '{}' keeps no life.h5 (keep: lives), from which duties take their damage", study.name),
        "keep: histories, or all, in the study");
  Problems problems;
  const Jobs jobs(study);
  const std::map<const Job*, std::size_t> sections = sections_of(file, jobs);
  for (const Duty& duty : file.duties)
    problems.attempt("", duty.where, [&] {
      for (const DutyProgram& program : duty.programs)
        if (const StudyJob& of = jobs.of(program); of.job && !of.job->uncertainty.enabled)
          refuse_without_samples(program);
      check_same_dresspack(file, duty, jobs, sections);
    });
  problems.finish(file.where.file);
}

void check_hours(const DutyFile& file, const std::map<std::string, double>& repeat_seconds) {
  Problems problems;
  for (const Duty& duty : file.duties)
    problems.attempt("", duty.where, [&] {
      HourOfDuty hour;
      for (const DutyProgram& program : duty.programs)
        if (const auto known = repeat_seconds.find(program.job); known != repeat_seconds.end())
          hour.add(program.rate(known->second, duty.shift_hours, duty.repeats_per_hour), known->second,
                   fmt::format("'{}'", program.job));
      hour.check(duty);
    });
  problems.finish(file.where.file);
}

std::vector<Warning> mounting_warnings(const DutyFile& file, const Study& study, const std::vector<RankingRow>* rows) {
  std::vector<Warning> warnings;
  FirstPoses poses(study, rows);
  for (const Duty& duty : file.duties)
    if (auto warning = poses.warning_of_mounting(duty)) warnings.push_back(std::move(*warning));
  return warnings;
}

std::vector<Warning> uncounted_changes(const DutyFile& file, const Study& study, const std::vector<RankingRow>& rows) {
  std::vector<Warning> warnings;
  Programs programs(study, rows);
  for (const Duty& duty : file.duties) {
    const RankingRow* const row = find_in(rows, &RankingRow::job, round_name(duty));
    if (duty.order.empty() || !row || !row->done()) continue;  // the evaluation of the duty states why it failed
    const std::vector<EvaluatedProgram> evaluated = programs.of(duty);
    const std::optional<WireDamage> round = programs.round_of(duty, evaluated.front());
    for (std::size_t m = 0; m < round->worst.size(); ++m)
      if (round->worst[m] > 0 &&
          std::ranges::all_of(evaluated, [&](const EvaluatedProgram& one) { return one.wires->worst[m] == 0; }))
        warnings.push_back(warning_of(
            WarningKind::motion, duty.where.text(),
            fmt::format("the order of duty '{}' damages {} by {:.2g} per round, and its programs alone do not, so the "
                        "changes between them are not counted for this mode",
                        duty.name, (*evaluated.front().modes)[m].mode, round->worst[m]),
            "programs that strain these wires too little, on different sides",
            "a job with one motion of all programs instead of the order"));
  }
  return warnings;
}

std::vector<RankingRow> rows_of(const DutyFile& file, const std::vector<RankingRow>& rows) {
  std::set<std::string> named;
  for (const Duty& duty : file.duties) {
    for (const DutyProgram& program : duty.programs) named.insert(program.job);
    if (!duty.order.empty()) named.insert(round_name(duty));
  }
  return filtered(rows, [&](const RankingRow& row) { return named.contains(row.job); });
}

namespace {

/// Returns the parts and modes without a life under one of the programs, each once.
std::string not_evaluated_by(const std::vector<RankingRow>& rows) {
  std::vector<std::string> names;
  const auto add = [&](const std::string& name) {
    if (!name.empty() && std::ranges::find(names, name) == names.end()) names.push_back(name);
  };
  for (const RankingRow& row : rows) {
    for (const std::string& name : parts_between(row.not_evaluated, ", ")) add(name);
    for (const UnvalidatedMode& mode : row.unvalidated)
      if (!is_credible(mode)) add(mode.mode + (mode.dresspack.empty() ? "" : " of " + mode.dresspack));
  }
  return joined(names, ", ");
}

/// Returns the part of the result that needs no samples. rates: receives the rates of the programs.
DutyResult outline_of(const Duty& duty, Programs& programs, std::vector<Rate>& rates) {
  DutyResult result;
  result.name = duty.name;
  result.hours_per_week = duty.hours_per_week;
  result.has_order = !duty.order.empty();
  rates = rates_of(duty, programs, result.parts);
  if (result.has_order) {
    result.rounds_per_hour = repeats_in_rounds(duty, repeats_of(result.parts)).back();
    for (const DutyPart& part : result.parts) {
      const double in_rounds = sum_of(duty.order, [&](const OrderedProgram& ordered) {
        return ordered.job == part.job ? result.rounds_per_hour * ordered.repeats : 0;
      });
      constexpr double worth_a_word = 0.01;
      if (const double outside = 1 - in_rounds / part.repeats_per_hour; outside > worth_a_word)
        result.outside.push_back(fmt::format("{} ({:.0f} %)", part.job, 100 * outside));
    }
  }
  result.others = other_modes(result.parts, programs.rows(duty));
  result.not_evaluated = not_evaluated_by(programs.rows(duty));
  std::vector<DutyProgram> all;  // programs that run
  for (std::size_t k = 0; k < duty.programs.size(); ++k)
    if (result.parts[k].repeats_per_hour > 0) all.push_back(duty.programs[k]);
  if (!duty.order.empty()) all.push_back(program_of_round(duty));
  for (const DutyProgram& program : all)
    if (const RankingRow& row = programs.row(program); !is_believable(row)) {
      result.doubtful.push_back(fmt::format("{} ({})", row.job, warning_kinds(row)));
      for (const Warning& warning : warnings_of(row))
        if (spoils_plan(warning)) result.warnings.push_back(row.job + ": " + warning.text());
    } else if (const std::string input = doubtful_input(row); !input.empty()) {
      result.unconfirmed.push_back(fmt::format("the {} of {}", input, row.job));
    }
  result.robot_life_hours = programs.row(duty.programs.front()).robot_life_hours;
  if (const Job* const job = programs.job(duty.programs.front())) result.inspection = job->inspection;
  return result;
}

/// Returns DutyResult::errors. share: (program) share of the damage.
std::array<double, 3> errors_under(const Duty& duty, const std::vector<double>& share, Programs& programs) {
  std::array<double, 3> errors{};
  for (std::size_t i = 0; i < errors.size(); ++i) {
    double logarithm = 0;
    for (std::size_t k = 0; k < share.size(); ++k)
      if (share[k] > 0) logarithm += share[k] * std::log(programs.row(duty.programs[k]).planned_errors[i]);
    errors[i] = std::exp(logarithm);
  }
  return errors;
}

}  // namespace

std::vector<DutyResult> outlines(const DutyFile& file, const Study& study, const std::vector<RankingRow>& rows,
                                 const std::set<std::string>& needed) {
  Programs programs(study, rows);
  std::vector<DutyResult> results;
  std::vector<Rate> rates;
  for (const Duty& duty : file.duties)
    if (needed.contains(duty.name)) results.push_back(outline_of(duty, programs, rates));
  return results;
}

std::vector<DutyResult> evaluated(const DutyFile& file, const Study& study, const std::vector<RankingRow>& rows) {
  Programs programs(study, rows);
  // All duties use one dresspack name, the one in a job's own summary, so that a dresspack keeps its values when its duty
  // changes.
  const std::string dresspack;
  std::vector<DutyResult> results;
  for (const Duty& duty : file.duties) {
    std::vector<Rate> rates;
    DutyResult& result = results.emplace_back(outline_of(duty, programs, rates));
    const std::vector<EvaluatedProgram> evaluated = programs.of(duty);
    for (std::size_t k = 0; k < evaluated.size(); ++k)
      if (!result.parts[k].recording_of.empty()) result.parts[k].at_other_rests = at_other_rests(*evaluated[k].modes);
    for (const LifeResponse& mode : *evaluated.front().modes) result.modes.push_back(mode.mode);
    const std::optional<WireDamage> round = programs.round_of(duty, evaluated.front());
    const SamePlace places(evaluated, round ? &*round : nullptr);
    const std::vector<double> repeats = repeats_of(result.parts), apart = places.at(repeats);
    const std::vector<double> share = places.at(repeats, repeats_in_rounds(duty, repeats));
    for (std::size_t m = 0; m < share.size(); ++m) result.changes.push_back(apart[m] > 0 ? share[m] / apart[m] : 1);
    result.damage = damage_under(evaluated, rates, share, dresspack);
    vary_repeats(duty, places, result);
  }
  for (std::size_t d = 0; d < file.duties.size(); ++d) {
    std::vector<PastDamage> history;
    for (const PastDuty& past : file.duties[d].history) {
      const auto& named = duty_named(file, past.duty, past.where);
      const DutyResult& before = results[static_cast<std::size_t>(&named - file.duties.data())];
      history.push_back({&before.damage, past.hours.value_or(0)});
      results[d].past_hours += past.hours.value_or(0);
    }
    if (results[d].past_hours >= results[d].robot_life_hours)
      throw InputError(file.duties[d].where,
                       fmt::format("the history of duty '{}' is {} long, the life of the robot {}", file.duties[d].name,
                                   hours_text(results[d].past_hours), hours_text(results[d].robot_life_hours)),
                       "give hours of operation, or a larger fatigue.robot_life_hours");
    results[d].lives = lives_under(results[d].damage, history);
    results[d].errors = errors_under(file.duties[d], results[d].lives.share, programs);
    if (results[d].past_hours > 0 && results[d].lives.survived < fewest_survivors)
      throw InputError(
          file.duties[d].where,
          fmt::format("duty '{}': {:.2g} % of the samples survive its history of {}, so the model contradicts "
                      "this dresspack",
                      file.duties[d].name, 100 * results[d].lives.survived, hours_text(results[d].past_hours)),
          "learn from it first: dresslife calibrate");
  }
  return results;
}

namespace {

/// Values on which the lives of programs depend and that dresspacks share. Those of a result are computed once for all duties.
class SharedValues {
 public:
  explicit SharedValues(std::size_t worlds) : worlds_(worlds) {}
  /// Returns each value once.
  std::vector<SharedValue> of(const std::vector<EvaluatedProgram>& programs) {
    std::vector<SharedValue> values;
    for (const EvaluatedProgram& program : programs) {
      const auto [known, is_new] = of_result_.try_emplace(program.modes.get());
      if (is_new) known->second = of(*program.modes);
      add(known->second, values);
    }
    return values;
  }

 private:
  static void add(const std::vector<SharedValue>& more, std::vector<SharedValue>& values) {
    for (const SharedValue& value : more)
      if (std::ranges::none_of(
              values, [&](const SharedValue& one) { return one.parameter == value.parameter && one.of == value.of; }))
        values.push_back(value);
  }
  std::vector<SharedValue> of(const FailureModes& modes) const {
    std::vector<SharedValue> values;
    for (const LifeResponse& mode : modes) {
      const LifeSurface life(mode);
      for (std::size_t p = 0; p < uncertain_count; ++p) {
        const SharedBy by = uncertain_parameters()[p].shared;
        const auto at = static_cast<Eigen::Index>(p);
        if (by == SharedBy::installation || !(mode.knowledge.covariance(at, at) > 0) || !life.depends_on(p)) continue;
        const std::string of = by == SharedBy::construction ? mode.construction
                               : by == SharedBy::material   ? mode.material
                                                            : "";
        add({{p, of, shared_samples(mode, p, worlds_)}}, values);
      }
    }
    return values;
  }

  std::size_t worlds_;
  std::map<const FailureModes*, std::vector<SharedValue>> of_result_;
};

}  // namespace

/// A duty with what its lives need.
struct PlantLives::Task {
  const Duty* duty;
  double robot_life_hours;
  std::vector<Rate> rates;
  std::vector<double> share;
};

struct PlantLives::Read {
  std::vector<Task> tasks;                         ///< (duty)
  std::vector<std::vector<EvaluatedProgram>> all;  ///< (duty, program)
  std::optional<Shares> shares;
  std::vector<PreparedModes> prepared;  ///< (result)
};

PlantLives::PlantLives(const DutyFile& file, const Study& study, const std::vector<RankingRow>& rows,
                       const std::set<std::string>& needed) {
  auto read = std::make_unique<Read>();
  Programs programs(study, rows);
  for (const Duty& duty : file.duties)
    if (needed.contains(duty.name)) read->tasks.push_back({&duty, 0, {}, {}}), read->all.push_back(programs.of(duty));
  for (std::size_t k = 0; k < read->tasks.size(); ++k) {
    const Duty& duty = *read->tasks[k].duty;
    const std::vector<EvaluatedProgram>& evaluated = read->all[k];
    std::vector<DutyPart> parts;
    read->tasks[k].rates = rates_of(duty, programs, parts);
    const std::optional<WireDamage> round = programs.round_of(duty, evaluated.front());
    const std::vector<double> repeats = repeats_of(parts);
    read->tasks[k].share =
        SamePlace(evaluated, round ? &*round : nullptr).at(repeats, repeats_in_rounds(duty, repeats));
    read->tasks[k].robot_life_hours = programs.row(duty.programs.front()).robot_life_hours;
  }
  read->shares.emplace(read->all);
  read->prepared =
      mapped(read->shares->modes_of_result, [](const FailureModes* modes) { return PreparedModes(*modes); });
  read_ = std::move(read);
}

PlantLives::~PlantLives() = default;

std::map<std::string, LifeTable> PlantLives::in(std::size_t worlds, std::size_t draws, bool keep_draws) const {
  const std::vector<Task>& tasks = read_->tasks;
  const auto& all = read_->all;
  std::map<std::string, LifeTable> tables;
  std::vector<LifeTable*> of_task;  // (duty)
  SharedValues shared(worlds);
  for (std::size_t k = 0; k < tasks.size(); ++k) {
    const Duty& duty = *tasks[k].duty;
    LifeTable& table = tables[duty.name];
    table.worlds = worlds, table.draws = draws, table.hours.resize(worlds * draws);
    table.hours_per_week = duty.hours_per_week;
    table.shared = shared.of(all[k]);
    table.robot_life_hours = tasks[k].robot_life_hours;
    of_task.push_back(&table);
  }
  // The lives of a draw do not depend on other draws, so the number of threads does not change the result. The loop runs over
  // draws and inside over duties, so that the data of one draw stay in the processor's cache.
  const std::size_t threads = std::min(thread_count(), draws);
  in_parallel(threads, [&](std::size_t part) {
    DrawDamage plant(*read_->shares, read_->prepared, worlds);
    for (std::size_t d = draws * part / threads; d < draws * (part + 1) / threads; ++d) {
      plant.begin(d);
      for (std::size_t k = 0; k < tasks.size(); ++k) {
        const std::vector<double> damage = plant.under(k, all[k], tasks[k].rates, tasks[k].share);
        float* const hours = of_task[k]->hours.data() + d * worlds;
        for (std::size_t w = 0; w < worlds; ++w)
          hours[w] = damage[w] > 0 ? static_cast<float>(1 / damage[w]) : std::numeric_limits<float>::infinity();
      }
    }
  });
  // From (draw, world) to (world, draw).
  in_parallel(threads, [&](std::size_t part) {
    for (std::size_t k = tasks.size() * part / threads; k < tasks.size() * (part + 1) / threads; ++k) {
      LifeTable& table = *of_task[k];
      std::vector<float> by_draw = table.hours;
      for (std::size_t w = 0; w < worlds; ++w)
        for (std::size_t d = 0; d < draws; ++d) table.hours[w * draws + d] = by_draw[d * worlds + w];
      if (keep_draws) table.of_draw = std::move(by_draw);
      remove_chance(table);
    }
  });
  return tables;
}

}  // namespace dresslife::pipeline
