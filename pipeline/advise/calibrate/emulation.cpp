#include "pipeline/advise/calibrate/emulation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <utility>

#include "pipeline/advise/calibrate/life_over_parameters.h"
#include "pipeline/advise/calibrate/measured_bending.h"
#include "pipeline/advise/calibrate/own_spread.h"
#include "pipeline/advise/calibrate/typical_cables.h"
#include "pipeline/base/joined.h"
#include "pipeline/base/lists.h"
#include "pipeline/base/readable.h"
#include "pipeline/base/statistics.h"
#include "pipeline/files/files.h"
#include "pipeline/job/job.h"
#include "pipeline/life/first_failure.h"
#include "pipeline/study/study_problems.h"

namespace dresslife::pipeline {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

// samples of the individual values of a dresspack: the error of a share of failures is 3 % or less
constexpr std::size_t draws = 64;

struct LogLife {
  double median, spread;  ///< ln of the median life, and ln of the standard deviation of ln life
};
LogLife log_life_of(const Observation& observation, const RankingRow& row) {
  const std::array<double, 3> lives = lives_of(observation, row);
  if (!std::isfinite(lives[2])) return {endless_log_life, least_log_spread};
  const double spread = std::log(lives[2] / lives[0]) / (2 * normal_decile);
  return {std::min(endless_log_life, std::log(lives[1])), std::max(least_log_spread, std::log(spread))};
}

bool have_same_modes(const FailureModes& one, const FailureModes& other) {
  return std::equal(
      one.begin(), one.end(), other.begin(), other.end(),
      [](const LifeResponse& a, const LifeResponse& b) { return a.mode == b.mode && a.dresspack == b.dresspack; });
}

LifeEnd end_of(ObservedEnd end) {
  if (bounds_above(end) && bounds_below(end)) return LifeEnd::broken;
  return bounds_below(end) ? LifeEnd::at_least : LifeEnd::at_most;
}

/// Returns z as LifeOverParameters takes it: relative to the centre, which the jobs' keys contain. `rest` counts from its median,
/// because the place that a job has of its own is one of few, and not that of its key.
VectorXd beside(const VectorXd& z, const VectorXd& centre) {
  constexpr auto rest = static_cast<Index>(index_of(Uncertain::rest));
  VectorXd from_centre = z.head(centre.size()) - centre;
  from_centre[rest] = z[rest];
  return from_centre;
}

class RoundEmulation {
 public:
  RoundEmulation(const std::vector<ObservedTest>& tests, const RoundOfJobs& round, const std::vector<RankingRow>& rows,
                 const StudyPlaces& places)
      : round_(round), places_(places) {
    for (const RankingRow& row : rows) rows_[row.job] = &row;
    for (std::size_t t = 0; t < tests.size(); ++t) {
      const std::vector<RoundOfJobs::Runs>& runs = round.runs()[t];
      if (!tests[t].observation.is_life()) {
        made_.push_back(bending_of(tests[t], runs));
        continue;
      }
      made_.push_back({tests[t].observation.service.empty() ? life_of(tests[t], runs) : service_of(tests[t], runs)});
      made_.back().walls = walls_of(tests[t], runs);
      const std::size_t worst = most_damaging(tests[t], runs);
      made_.back().moved_by = moved_by(tests[t], runs[worst]);
      const RankingRow& row = row_of(tests[t], runs[worst].centre);
      if (!row.failing_mode.empty())
        made_.back().fails_first = fmt::format("{}, {:.0f} %", row.failing_mode, 100 * row.failing_mode_share);
    }
  }

  const std::vector<EmulatedTest>& made() const { return made_; }

 private:
  ObservedLife life_of(const ObservedTest& test, const std::vector<RoundOfJobs::Runs>& variants) {
    const Observation& observation = test.observation;
    ObservedLife life;
    life.log_life = std::log(observed_life(observation));
    life.end = end_of(observation.outcome);
    // a maker's rating is a promise for one cable
    life.specimens = observation.outcome == ObservedEnd::rating ? 1 : observation.specimens;
    life.unshared_spread = observation.unshared_log10 * std::numbers::ln10;
    for (const RoundOfJobs::Runs& runs : variants) {
      const RankingRow& row = life_row_of(test, runs.centre);
      life.variants.push_back(variant_of(test, runs, row));
      life.common_share = std::max(life.common_share, common_share(runs, log_life_of(observation, row)));
    }
    return life;
  }

  /// Returns the hours of operation until half have failed, if the program ran alone for its share of the time.
  double hours_alone(const ObservedTest& test, const std::vector<RoundOfJobs::Runs>& programs,
                     std::size_t program) const {
    const double share = test.variants[program].share_of_time;
    return lives_of(test.observation, row_of(test, programs[program].centre))[1] / share;
  }

  /// Returns the most damaging program of dresspacks in service; 0 for other tests, whose variants are no programs.
  std::size_t most_damaging(const ObservedTest& test, const std::vector<RoundOfJobs::Runs>& programs) const {
    std::size_t worst = 0;
    if (test.observation.service.empty()) return worst;
    for (std::size_t k = 1; k < programs.size(); ++k)
      if (hours_alone(test, programs, k) < hours_alone(test, programs, worst)) worst = k;
    return worst;
  }

  /// failures: whether failed dresspacks count as failures; else as dresspacks that lived until then.
  static std::vector<ServiceFactor> factors_of(const std::vector<ServiceRecord>& records, bool failures) {
    // Ages within 5 % of each other are one age: the mean error is 1.4 %, and lives scatter by tens of per cent.
    constexpr double within = 0.05;
    std::map<std::pair<long, bool>, int> counts;
    const auto add = [&](double hours, bool failed, int count) {
      counts[{std::lround(std::log(hours) / within), failed}] += count;
    };
    for (const ServiceRecord& one : records) {
      add(one.hours, failures && one.failed, 1);
      if (one.entry_hours > 0) add(one.entry_hours, false, -1);
    }
    std::vector<ServiceFactor> factors;
    for (const auto& [of, count] : counts)
      if (count != 0) factors.push_back({within * double(of.first), of.second, count});
    return factors;
  }

  /// Returns the life of dresspacks in service, under one program or under several with their shares of the time.
  ObservedLife service_of(const ObservedTest& test, const std::vector<RoundOfJobs::Runs>& programs) {
    ObservedLife life;
    life.service = factors_of(test.observation.service, true);
    const std::size_t worst = most_damaging(test, programs);
    const RankingRow& row = life_row_of(test, programs[worst].centre);
    const LogLife centre = log_life_of(test.observation, row);
    if (row.life_response.empty() || centre.median >= endless_log_life) {
      const double log_hours = std::min(endless_log_life, centre.median - std::log(test.variants[worst].share_of_time));
      life.variants.push_back([log_hours, centre](const VectorXd&) {
        return LifeAt{log_hours, std::exp(centre.spread)};
      });
      return life;
    }
    std::vector<ProgramModes> modes;
    for (std::size_t k = 0; k < programs.size(); ++k) {
      const RankingRow& of = life_row_of(test, programs[k].centre);
      modes.push_back({modes_from_text(of.life_response), test.variants[k].share_of_time * 3600 / of.repeat_seconds});
      if (!have_same_modes(modes.back().modes, modes.front().modes))
        throw InputError(test.where, fmt::format("'{}': its programs have different dresspacks", test.observation.name),
                         "name jobs that differ only in motion");
    }
    const auto over = std::make_shared<const LifeOverParameters>(std::move(modes), programs.front().moves);
    for (OwnValues& own : own_values(over->modes(), programs.front().own, round_.prior(), draws))
      life.variants.push_back([over, own = std::move(own), at = round_.centre()](const VectorXd& z) {
        const LifeAt hours = over->at(beside(z, at), &own, own_spread_at(z[own_spread_place]));
        return LifeAt{std::min(endless_log_life, hours.log_median), hours.spread};
      });
    return life;
  }

  /// Returns the ages of hoses that had not cracked before the end of a test, also if its wires failed. The individual value of
  /// each hose is its motion.
  std::map<std::string, ObservedLife> walls_of(const ObservedTest& test,
                                               const std::vector<RoundOfJobs::Runs>& variants) {
    const Observation& observation = test.observation;
    const bool in_service = !observation.service.empty();
    std::map<std::string, ObservedLife> walls;
    // a rating covers only the cable
    const bool lived = bounds_below(observation.outcome) && observation.outcome != ObservedEnd::rating;
    if (!in_service && !(observation.hours && lived)) return walls;
    std::map<std::string, std::vector<ProgramModes>> programs;
    for (std::size_t k = 0; k < variants.size(); ++k) {
      const RankingRow& row = row_of(test, variants[k].centre);
      constexpr const char* attribute = "wall_response";
      if (row.life_file.empty()) return walls;
      const FileReader life(row.life_file, life_format());
      if (!life.has_attribute(attribute)) return walls;
      const double share = in_service ? test.variants[k].share_of_time : 1;
      std::map<std::string, FailureModes> by_material;
      for (LifeResponse& wall : modes_from_text(life.text_attribute(attribute)))
        by_material[wall.material].push_back(wall);
      for (auto& [material, modes] : by_material)
        programs[material].push_back({std::move(modes), share * 3600 / row.repeat_seconds});
      if (!in_service) break;  // the other variants are other cables
    }
    std::array<bool, uncertain_count> moves{}, own{};
    moves[index_of(Uncertain::strength)] = true;
    constexpr std::size_t motion = index_of(Uncertain::motion);
    own[motion] = variants.front().own[motion] || variants.front().moves[motion];
    for (auto& [material, of] : programs) {
      ObservedLife& life = walls[material];
      life.service = in_service
                         ? factors_of(observation.service, false)
                         : std::vector<ServiceFactor>{{std::log(*observation.hours), false, observation.specimens}};
      const auto over = std::make_shared<const LifeOverParameters>(std::move(of), moves);
      for (OwnValues& each : own_values(over->modes(), own, round_.prior(), draws))
        life.variants.push_back([over, each = std::move(each)](const VectorXd& z) { return over->at(z, &each); });
    }
    return walls;
  }

  /// Returns the factors by which one deviation of a parameter changes the median life, largest first: "model 2.0, strength 1.8".
  std::string moved_by(const ObservedTest& test, const RoundOfJobs::Runs& runs) const {
    const RankingRow& row = row_of(test, runs.centre);
    if (row.life_response.empty()) return "";
    constexpr double worth_a_word = 0.05;  // smallest change of ln life that is printed
    std::array<bool, uncertain_count> all = runs.moves;
    for (std::size_t p = 0; p < uncertain_count; ++p) all[p] = all[p] || runs.own[p];
    const LifeOverParameters life(modes_from_text(row.life_response), all);
    std::vector<std::pair<double, std::string>> factors;
    for (std::size_t p = 0; p < uncertain_count; ++p) {
      VectorXd z = VectorXd::Zero(uncertain_count);
      z[static_cast<Index>(p)] = round_.prior()[static_cast<Index>(p)];
      const double change = std::abs(life.log_median_at(z) - life.log_median_at(-z)) / 2;
      if (all[p] && change > worth_a_word)
        factors.emplace_back(-change,
                             fmt::format("{}{} {}", uncertain_parameters()[p].name,
                                         runs.own[p] ? " (each dresspack's own)" : "", readable(std::exp(change), 2)));
    }
    std::sort(factors.begin(), factors.end());
    return joined(mapped(factors, [](const auto& factor) { return factor.second; }), ", ");
  }

  const RankingRow& life_row_of(const ObservedTest& test, std::size_t job) const {
    const RankingRow& row = row_of(test, job);
    if (!row.has_wires()) refuse_without_wires(test.where, test.observation.name);
    return row;
  }

  const RankingRow& row_of(const ObservedTest& test, std::size_t job) const {
    const auto row = rows_.find(round_.study().jobs[job].name);
    if (row != rows_.end() && row->second->done()) return *row->second;
    throw InputError(test.where,
                     fmt::format("'{}': its job failed: {}", test.observation.name,
                                 row == rows_.end() ? "it was not computed" : row->second->failure),
                     "correct it, or leave the row out");
  }

  /// Returns the emulators of a bending test: sums of moments, or the decrement of a swing.
  EmulatedTest bending_of(const ObservedTest& test, const std::vector<RoundOfJobs::Runs>& variants) {
    const Observation& observation = test.observation;
    const double noise = observation.noise_percent / 100;
    EmulatedTest made;
    if (observation.decrement) {
      const MeasuredNumber number{
          *observation.decrement - observation.decrement_without_slip, noise * *observation.decrement, {{0, 1.0}}};
      const auto said = [&](const std::vector<double>& curvature, const std::vector<double>& moment) {
        return VectorXd::Constant(1, log_decrement_by_slip(curvature, moment, observation.at_curvature)).eval();
      };
      for (const RoundOfJobs::Runs& runs : variants) made.bending.push_back({bending_over(test, runs, said), {number}});
      return made;
    }
    const std::vector<BendingPoint> points =
        observation.stiffness
            ? std::vector<BendingPoint>{{observation.at_curvature, *observation.stiffness * observation.at_curvature}}
            : read_bending(observation.bending);
    const BendingNumbers bent = bending_numbers(points, noise);
    if (observation.stiffness) made.per_shown = observation.at_curvature;
    for (std::size_t k = 0; k < bent.numbers.size(); ++k)
      if (std::abs(bent.numbers[k].value) > std::abs(bent.numbers[made.shown].value)) made.shown = k;
    const auto said = [&](const std::vector<double>& curvature, const std::vector<double>& moment) {
      VectorXd values(static_cast<Index>(bent.curvatures.size()));
      for (std::size_t c = 0; c < bent.curvatures.size(); ++c)
        values[static_cast<Index>(c)] = log_moment(curvature, moment, bent.curvatures[c]);
      return values;
    };
    for (const RoundOfJobs::Runs& runs : variants)
      made.bending.push_back({bending_over(test, runs, said), bent.numbers});
    return made;
  }

  /// Returns emulators of logarithms over z. said: computes them from a table of curvatures and moments of a first bend.
  template <typename Said>
  std::vector<Emulator> bending_over(const ObservedTest& test, const RoundOfJobs::Runs& runs, const Said& said) const {
    const auto of_job = [&](std::size_t job) {
      row_of(test, job);
      const FileReader strain(places_.job(round_.study().jobs[job].name) / "strain.h5", strain_format());
      if (!strain.has("/bending/moment"))
        throw InputError(
            test.where,
            fmt::format(
                "'{}': its job gives no curve of moment over curvature (this needs one cable alone, in which parts "
                "rub and none lies straight beside the axis)",
                test.observation.name),
            "write dresspack: {cable: NAME}, and strain.slip: friction or no strain.slip");
      return said(strain.read<double>("/bending/curvature"), strain.read<double>("/bending/moment"));
    };
    const VectorXd middle = of_job(runs.centre);
    Eigen::MatrixXd low = middle.replicate(1, uncertain_count), high = low;
    for (std::size_t p = 0; p < uncertain_count; ++p) {
      if (!runs.arms[p]) continue;
      low.col(static_cast<Index>(p)) = of_job(runs.arms[p]->low);
      high.col(static_cast<Index>(p)) = of_job(runs.arms[p]->high);
    }
    std::vector<Emulator> made;
    for (Index c = 0; c < middle.size(); ++c)
      made.emplace_back(round_.centre(), round_.step(), middle[c], low.row(c).transpose(), high.row(c).transpose());
    return made;
  }

  LifeVariant variant_of(const ObservedTest& test, const RoundOfJobs::Runs& runs, const RankingRow& row) {
    const LogLife centre = log_life_of(test.observation, row);
    if (row.life_response.empty() || centre.median >= endless_log_life)
      return [centre](const VectorXd&) { return LifeAt{centre.median, std::exp(centre.spread)}; };
    FailureModes modes = modes_from_text(row.life_response);
    const auto life = std::make_shared<const LifeOverParameters>(modes, runs.moves);
    for (LifeResponse& mode : modes)
      mode.knowledge.mean.setZero();  // the row's lives are those of the job's own values
    const LifeAt modelled = LifeOverParameters(std::move(modes), runs.moves).at(VectorXd::Zero(uncertain_count));
    return
        [life, centre, modelled, at = round_.centre(), typical = test.typical, moves = runs.moves](const VectorXd& z) {
          const VectorXd from_centre = beside(z, at);
          const LifeAt here = life->at(from_centre);
          const double between =
              typical ? deviation_between_cables([&](const VectorXd& there) { return life->log_median_at(there); },
                                                 moves, from_centre)
                      : 0;
          return LifeAt{std::min(endless_log_life, centre.median + here.log_median - modelled.log_median),
                        std::exp(centre.spread) * here.spread / modelled.spread, between, life->residual()};
        };
  }

  /// Returns the share of the variance of a specimen's ln life that is common to all specimens of a spool.
  double common_share(const RoundOfJobs::Runs& runs, const LogLife& centre) const {
    const Fatigue& fatigue = round_.study().jobs[runs.centre].job->fatigue;
    const double wires = fatigue.scatter_log10 * fatigue.scatter_factor * std::numbers::ln10;
    const double spread = std::exp(centre.spread);
    return std::min(1.0, fatigue.scatter_shared * wires * wires / (spread * spread));
  }

  const RoundOfJobs& round_;
  std::map<std::string, const RankingRow*> rows_;
  const StudyPlaces& places_;
  std::vector<EmulatedTest> made_;
};

}  // namespace

double EmulatedTest::log_likelihood_at(const VectorXd& z) const {
  if (life) return log_likelihood(*life, z);
  return log_mean(mapped(bending, [&](const Measurement& variant) { return log_likelihood(variant, z); }));
}

std::vector<EmulatedTest> emulate(const std::vector<ObservedTest>& tests, const RoundOfJobs& round,
                                  const std::vector<RankingRow>& rows, const StudyPlaces& places) {
  return RoundEmulation(tests, round, rows, places).made();
}

std::vector<LogLikelihood> terms_of(const std::vector<EmulatedTest>& tests, const Axes& axes) {
  std::vector<LogLikelihood> terms;
  for (const EmulatedTest& test : tests)
    terms.push_back([&test, &axes](const VectorXd& some) { return test.log_likelihood_at(axes.all(some)); });
  return terms;
}

}  // namespace dresslife::pipeline
