#include "pipeline/advise/plan/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <tuple>

#include "pipeline/advise/plan/pooled_lives.h"
#include "pipeline/base/digest.h"
#include "pipeline/base/lists.h"
#include "pipeline/base/random.h"
#include "pipeline/base/readable.h"
#include "pipeline/base/statistics.h"
#include "pipeline/base/threads.h"
#include "pipeline/base/warning_words.h"

namespace dresslife::pipeline {
namespace {

/// Returns the number of simulated plants. The error of a mean count is at most 3 % of its standard deviation. Small plants take
/// little time and rarely fail, so they get more: with one dresspack that fails in 1 of 1,000 plants, 100,000 plants have 100
/// failures.
std::size_t plant_count(std::size_t dresspacks, std::size_t windows) {
  // limit on the number of decisions: a tenth of a second
  constexpr std::size_t fewest = 1000, most = 100'000, decisions = 200'000;
  return std::clamp(decisions / (std::max<std::size_t>(1, dresspacks) * (windows + 1)), fewest, most);
}
constexpr double shortest_life = 1;  // [h] of a new dresspack in a simulated plant, so that the simulation ends
constexpr double days_per_year = 365.2425;
// of (D6), between a tenth of the shortest life and the robot's life, in steps of 4 to 7 %: the cost is flat near its minimum
constexpr std::size_t ages = 200;

/// Weights of worlds, and failure probabilities of one dresspack that lives at a given age.
class Worlds {
 public:
  Worlds(std::size_t count, const std::vector<double>& known) : Worlds(count) {
    if (!known.empty()) weight_ = known;
  }
  explicit Worlds(std::size_t count) : log_weight_(count, 0.0), weight_(count, 1.0 / static_cast<double>(count)) {}

  /// Adds ln of factors of the weights, (world).
  void add(const std::vector<double>& log_factors) {
    for (std::size_t w = 0; w < log_weight_.size(); ++w) log_weight_[w] += log_factors[w];
  }
  void weigh() {
    const double most = *std::ranges::max_element(log_weight_);
    double sum = 0;
    for (std::size_t w = 0; w < weight_.size(); ++w) sum += weight_[w] = std::exp(log_weight_[w] - most);
    for (double& weight : weight_) weight /= sum;
    all_alive_ = sum / static_cast<double>(weight_.size()) * std::exp(most);
  }
  /// Returns P(all dresspacks have survived), before the weights.
  double all_alive() const { return all_alive_; }
  /// Returns P(a new dresspack reaches an age).
  double reaches(const LifeTable& table, double age) const {
    double sum = 0;
    for (std::size_t w = 0; w < weight_.size(); ++w) sum += weight_[w] * table.alive(w, age);
    return sum;
  }
  double effective() const {
    return 1 / sum_of(weight_, [](double weight) { return weight * weight; });
  }
  const std::vector<double>& weights() const { return weight_; }

  /// Returns, (interval), P(failure in it | it lives at `now`), for intervals that end at these ages. Its survival is
  /// already included in the weights. Each life is spread evenly
  /// between the midpoints to its neighbours, because in an interval with few lives the result would depend on chance.
  std::vector<double> fails_in(const LifeTable& table, double now, const std::vector<double>& ends) const {
    std::vector<double> fails(ends.size(), 0.0);
    const auto interval_of = [&](double age) {
      return static_cast<std::size_t>(std::ranges::upper_bound(ends, age) - ends.begin());
    };
    double all = 0;
    for (std::size_t w = 0; w < weight_.size(); ++w) {
      const float *const begin = table.hours.data() + w * table.draws, *const end = begin + table.draws,
                         *const first = table.first_after(w, now);
      if (first == end) continue;
      all += weight_[w];
      const auto above = [&](const float* life) -> double {  // end of the interval of a life
        if (life + 1 != end && std::isfinite(life[1])) return (double(life[0]) + life[1]) / 2;
        return life == begin ? life[0] : life[0] + (double(life[0]) - life[-1]) / 2;
      };
      const auto below = [&](const float* life) -> double {
        return life == begin ? std::max(life[0] / 2.0, 2 * double(life[0]) - above(life)) : above(life - 1);
      };
      const auto left = [&](const float* life) {  // share of the interval of a life that lies after `now`
        const double from = std::isinf(*life) ? now : below(life), to = std::isinf(*life) ? now : above(life);
        return to > from ? std::clamp((to - now) / (to - from), 0.0, 1.0) : *life > now ? 1.0 : 0.0;
      };
      const float* life = first == begin ? first : first - 1;
      const double share = weight_[w] / (left(first) + double(end - first - 1) + (life == first ? 0 : left(life)));
      for (; life != end && std::isfinite(*life) && below(life) < ends.back(); ++life) {
        const double from = below(life), to = above(life), per_hour = to > from ? share / (to - from) : 0;
        double at = std::max(from, now);
        if (per_hour == 0 && *life > now) fails[std::min(ends.size() - 1, interval_of(*life))] += share;
        for (std::size_t k = interval_of(at); per_hour > 0 && at < to && k < ends.size(); ++k) {
          const double until = std::min(to, ends[k]);
          fails[k] += per_hour * std::max(0.0, until - at);
          at = std::max(at, until);
        }
      }
    }
    if (!(all > 0)) fails.front() = 1;  // no world has such a long life: it fails at once
    for (double& of_interval : fails) of_interval /= all > 0 ? all : 1;
    return fails;
  }

 private:
  std::vector<double> log_weight_, weight_;
  double all_alive_ = 1;
};

double hours_in_day(const Installed& row, const LifeTable& table) {
  return row.hours_per_week.value_or(table.hours_per_week) / 7;
}

/// Returns the hours under the harder duty that wear a dresspack as much as an hour under a duty, by the medians of the lives: exact
/// if all lives differ by one factor.
double harder_hours_in_hour(const LifeTable& harder, const LifeTable& table) {
  constexpr double least = 1e-3;  // a window of a month still has a part of an hour
  if (&harder == &table) return 1;
  const double share = harder.median() / table.median();
  return std::isfinite(share) ? std::clamp(share, least, 1.0) : 1;
}

/// Hours of operation of a dresspack, over the days from today.
class Pace {
 public:
  /// earlier: lives under the duty before the change; of the same duty without a change
  Pace(const Installed& row, const LifeTable& table, const LifeTable& earlier)
      : after_(hours_in_day(row, table)),
        before_(row.change ? row.change->hours_per_day : after_),
        change_(row.change ? row.change->day : 0),
        harder_(&earlier != &table && earlier.median() < table.median() ? &earlier : &table),
        harder_before_(harder_hours_in_hour(*harder_, earlier)),
        harder_after_(harder_hours_in_hour(*harder_, table)) {}
  /// Returns the hours until a day. Days before today have negative hours.
  double hours(double day) const { return before_ * std::min(day, change_) + after_ * std::max(0.0, day - change_); }
  /// Returns the day after these hours.
  double day(double hours) const {
    const double until_change = before_ * change_;
    return hours < until_change ? hours / before_ : change_ + (hours - until_change) / after_;
  }
  /// Returns whether a time [hours from today] lies before the change.
  bool before_change(double hours) const { return hours < before_ * change_; }
  /// Returns the lives under the harder of both duties.
  const LifeTable& harder() const { return *harder_; }
  /// Returns hours from today as hours under the harder duty that wear as much.
  double harder_hours(double hours) const {
    const double before = std::min(hours, before_ * change_);
    return harder_before_ * before + harder_after_ * (hours - before);
  }

 private:
  double after_, before_;                ///< [hours per day]
  double change_;                        ///< [days from today]
  const LifeTable* harder_;              ///< of the two duties
  double harder_before_, harder_after_;  ///< harder_hours_in_hour()
};

double run_of(const Installed& row, const LifeTable& table, Day today) {
  return row.run_hours.value_or(days_between(row.since, today) * hours_in_day(row, table));
}

/// Returns the life of a dresspack with spells (D10), in hours of operation. spells: {hours, life under that duty alone}.
double life_after(std::span<const std::array<double, 2>> spells, double own_life) {
  double used = 0, hours = 0;
  for (const auto& [spell, life] : spells) {
    if (used + spell / life >= 1) return hours + (1 - used) * life;
    used += spell / life, hours += spell;
  }
  return hours + (1 - used) * own_life;
}

LifeTable lives_after(const std::vector<Installed::Spell>& before, const LifeTable& own,
                      const std::map<std::string, LifeTable>& tables) {
  LifeTable lives{own.worlds, own.draws, std::vector<float>(own.hours.size()), own.robot_life_hours,
                  own.hours_per_week};
  std::vector<const LifeTable*> of_spell;
  std::vector<std::array<double, 2>> spells;
  for (const Installed::Spell& spell : before)
    of_spell.push_back(&tables.at(spell.duty)), spells.push_back({spell.hours, 0});
  for (std::size_t w = 0; w < own.worlds; ++w) {
    float* const hours = lives.hours.data() + w * own.draws;
    for (std::size_t d = 0; d < own.draws; ++d) {
      for (std::size_t k = 0; k < spells.size(); ++k) spells[k][1] = of_spell[k]->life(w, d);
      hours[d] = static_cast<float>(life_after(spells, own.life(w, d)));
    }
    std::sort(hours, hours + own.draws);
  }
  return lives;
}

/// Returns the lives of today's dresspack with its hours from today as Pace::harder_hours().
LifeTable in_harder_hours(LifeTable lives, double age, const Pace& pace) {
  for (float& life : lives.hours)
    if (life > age && std::isfinite(life)) life = static_cast<float>(age + pace.harder_hours(life - age));
  return lives;
}

/// Returns ln of P(all dresspacks of these ages [h] have survived), (world), for (D3).
std::vector<double> log_all_alive(const LifeTable& table, const std::vector<double>& at_ages) {
  const PooledLives lives(table);
  std::vector<double> sums(table.worlds);
  for (std::size_t w = 0; w < table.worlds; ++w)
    for (const double age : at_ages) sums[w] += std::log(lives.alive(w, age));
  return sums;
}

Worlds worlds_of(const Fleet& fleet, const std::map<std::string, LifeTable>& tables,
                 const std::vector<std::shared_ptr<const LifeTable>>& first, Day today, const PlanRule& rule) {
  Worlds worlds(tables.begin()->second.worlds, rule.weights);
  if (!rule.weights.empty()) return worlds;
  if (!rule.knows_survivors) {
    std::vector<std::pair<const LifeTable*, std::vector<double>>>
        all;  // lives, and the age of each dresspack that has them
    std::map<const LifeTable*, std::size_t> known;
    for (std::size_t i = 0; i < first.size(); ++i) {
      const auto [at, is_new] = known.try_emplace(first[i].get(), all.size());
      if (is_new) all.emplace_back(first[i].get(), std::vector<double>{});
      all[at->second].second.push_back(run_of(fleet.rows[i], *first[i], today));
    }
    std::vector<std::vector<double>> evidence(all.size());  // (table, world)
    const std::size_t threads = std::min(thread_count(), all.size());
    in_parallel(threads, [&](std::size_t part) {
      for (std::size_t k = part; k < all.size(); k += threads)
        evidence[k] = log_all_alive(*all[k].first, all[k].second);
    });
    for (const std::vector<double>& of_table : evidence) worlds.add(of_table);
  }
  worlds.weigh();
  return worlds;
}

/// Future of a dresspack that lives at an age: means over the worlds in which it can live, at later ages in steps of a few hours.
class LaterLife {
 public:
  /// rate: (world) [1/h]
  LaterLife(const LifeTable& table, const std::vector<double>& weights, const Eigen::VectorXd& rate, double age,
            double last_age)
      : age_(age), step_((last_age - age) / double(steps)), alive_(steps + 1, 0.0), running_(steps + 1, 0.0) {
    // Before the sums below, each element contains the lives that end in the step before its age.
    std::vector<double> rate_ended(steps + 1, 0.0);
    double alive = 0, rate_alive = 0, run = 0;
    for (std::size_t w = 0; w < table.worlds; ++w) {
      const float* const end = table.hours.data() + (w + 1) * table.draws;
      const float* life = table.first_after(w, age);
      if (life == end) continue;
      const double weight = weights[w] / double(end - life), rated = weight * rate[static_cast<Eigen::Index>(w)];
      alive += weights[w], rate_alive += weights[w] * rate[static_cast<Eigen::Index>(w)];
      for (; life != end && *life <= last_age; ++life) {
        const auto k = std::min(steps, static_cast<std::size_t>(std::ceil((*life - age) / step_)));
        alive_[k] += weight, rate_ended[k] += rated, running_[k] += rated * (*life - age);
      }
    }
    const double all = alive > 0 ? alive : 1;
    for (std::size_t k = 0; k <= steps; ++k) {
      alive_[k] = (alive -= alive_[k]) / all;
      rate_alive -= rate_ended[k];
      running_[k] = ((run += running_[k]) + rate_alive * step_ * double(k)) / all;
    }
  }
  /// Returns the mean of S_w(later) / S_w(age).
  double alive(double later) const { return at(alive_, later); }
  /// Returns the mean of rate_w times the integral of S_w from the age until later / S_w(age).
  double running(double later) const { return at(running_, later); }

 private:
  static constexpr std::size_t steps = 8192;  // 8 h for a robot's life of 40,000 h: a tenth of a week

  double at(const std::vector<double>& values, double later) const {
    const double place = std::min((later - age_) / step_, double(steps));
    const auto below = std::min(static_cast<std::size_t>(place), steps - 1);
    return values[below] + (place - double(below)) * (values[below + 1] - values[below]);
  }

  double age_, step_;                    ///< [h]
  std::vector<double> alive_, running_;  ///< (step)
};

/// Decides on replacements by (D4) or (D5).
class Decision {
 public:
  /// tables: (row) tables of its duty. hours: largest number of hours of operation within the plan.
  Decision(const Fleet& fleet, const std::vector<const LifeTable*>& tables, const Worlds& worlds, const PlanRule& rule,
           double hours)
      : fleet_(fleet), tables_(tables), worlds_(worlds), rule_(rule), hours_(hours), policy_(fleet.rows.size()) {
    const std::vector<std::vector<std::size_t>> alike = rows_of_policies(fleet);
    const std::size_t threads = std::min(thread_count(), alike.size());
    in_parallel(threads, [&](std::size_t part) {
      for (std::size_t k = part; k < alike.size(); k += threads) {
        const auto policy = std::make_shared<const Policy>(policy_of(alike[k].front()));
        for (const std::size_t row : alike[k]) policy_[row] = policy;
      }
    });
  }

  /// Returns the future of the dresspack of a row with these lives that lives at this age, until the last age that replace() needs.
  LaterLife later_life(std::size_t row, const LifeTable& lives, double age) const {
    return later_life(lives, policy_[row]->rate, age);
  }
  /// Returns whether the dresspack of a row is replaced at the age `from`. life: its future from an earlier age. interval: hours
  /// until the next window. Precondition: both ages of a window lie within the plan.
  bool replace(std::size_t row, const LaterLife& life, double from, double interval) const {
    if (!rule_.by_cost) {
      const double left = life.alive(from);
      const double fails = left > 0 ? 1 - life.alive(from + interval) / left : 1;
      return fails > rule_.risk && 1 - policy_[row]->life.alive(interval) < fails;
    }
    const double saves = fleet_.rows[row].unplanned_cost - fleet_.rows[row].planned_cost;
    const auto saved = [&](double age) { return saves * life.alive(age) + life.running(age); };
    for (double hours = interval; hours < growth * std::max(interval, tables_[row]->horizon()); hours *= growth)
      if (saved(from) <= saved(from + hours)) return false;
    return true;
  }
  /// Returns whether a dresspack that is installed later is replaced at the age `from`.
  bool replace_new(std::size_t row, double from, double interval) const {
    return replace(row, policy_[row]->life, from, interval);
  }

 private:
  static constexpr double growth = 1.5;  // ratio of successive times T: the cost is a smooth function of T

  struct Policy {
    Eigen::VectorXd rate;  ///< (world) (D6); 0 without costs
    LaterLife life;        ///< future of a new dresspack
  };

  LaterLife later_life(const LifeTable& table, const Eigen::VectorXd& rate, double age) const {
    return {table, worlds_.weights(), rate, age,
            age + hours_ + (rule_.by_cost ? growth * std::max(hours_, table.horizon()) : hours_)};
  }

  Policy policy_of(std::size_t row) const {
    const LifeTable& table = *tables_[row];
    const auto count = static_cast<Eigen::Index>(table.worlds);
    Eigen::VectorXd rate = Eigen::VectorXd::Zero(count);
    if (rule_.by_cost)
      rate = age_rates(table, fleet_.rows[row].planned_cost, fleet_.rows[row].unplanned_cost)
                 .least(Eigen::VectorXd::Map(worlds_.weights().data(), count));
    LaterLife life = later_life(table, rate, 0);
    return {std::move(rate), std::move(life)};
  }

  const Fleet& fleet_;
  const std::vector<const LifeTable*>& tables_;
  const Worlds& worlds_;
  const PlanRule rule_;
  const double hours_;
  std::vector<std::shared_ptr<const Policy>> policy_;  ///< (row)
};

std::size_t weeks_until(double days) { return static_cast<std::size_t>(std::ceil(days / 7)); }

/// One simulated plant.
struct Outcome {
  std::vector<int> planned, unplanned;  ///< (year)
  std::vector<int> failures;            ///< (week) failures of dresspacks that were installed later
  std::vector<int> later;               ///< (window) planned replacements of dresspacks that were installed later
  double cost = 0;
};

class Simulation {
 public:
  /// tables, earlier: (row) tables of its duty, and of the duty before its change.
  Simulation(const Fleet& fleet, const std::vector<const LifeTable*>& tables,
             const std::vector<const LifeTable*>& earlier, const std::vector<Pace>& paces,
             const std::vector<RowPlan>& rows, const std::vector<double>& times, const Worlds& worlds)
      : fleet_(fleet), tables_(tables), earlier_(earlier), paces_(paces), rows_(rows), times_(times) {
    double sum = 0;
    for (const double weight : worlds.weights()) until_.push_back(sum += weight);
    for (const Installed& row : fleet.rows) names_.push_back(xxh3_64(row.name.data(), row.name.size()));
    years_ = static_cast<std::size_t>(std::ceil(times.back() / days_per_year));
    weeks_ = weeks_until(times.back());
  }

  /// Simulates one plant. world: position of its world in the sum of the weights, 0 .. 1. decision: null: only failed dresspacks are replaced. before: for dresspacks that are installed before a
  /// change of their duty, in Pace::harder_hours().
  Outcome plant(double world, std::uint64_t seed, const Decision* decision, const Decision* before) const {
    Outcome outcome{std::vector<int>(years_, 0), std::vector<int>(years_, 0), std::vector<int>(weeks_, 0),
                    std::vector<int>(times_.size() - 1, 0)};
    const std::size_t its_world = world_at(world);
    for (std::size_t i = 0; i < fleet_.rows.size(); ++i) {
      // A dresspack's numbers follow from its name, so the order of the rows and other dresspacks do not change them.
      RandomStream random(seed ^ names_[i]);
      dresspack(i, its_world, random, decision, before, outcome);
    }
    return outcome;
  }

 private:
  std::size_t world_at(double position) const {
    const double at = position * until_.back();
    const auto world = static_cast<std::size_t>(std::ranges::upper_bound(until_, at) - until_.begin());
    return std::min(world, until_.size() - 1);
  }

  /// Samples a life in a world that is longer than an age. If no life of this world is, it is one of another world, as in
  /// Worlds::fails_in().
  double draw(const LifeTable& table, std::size_t world, double age, RandomStream& random) const {
    constexpr int tries = 100;
    for (int k = 0; k < tries; ++k, world = world_at(random.uniform())) {
      const float *const first = table.first_after(world, age), *const end =
                                                                    table.hours.data() + (world + 1) * table.draws;
      if (first != end) return first[static_cast<std::size_t>(random.uniform() * double(end - first))];
    }
    return age;  // it fails at once
  }

  /// Samples the life of a dresspack that is installed at these hours from today.
  double draw_new(std::size_t i, std::size_t world, double begun, RandomStream& random) const {
    const LifeTable& table = *tables_[i];
    const double until_change = fleet_.rows[i].change ? paces_[i].hours(fleet_.rows[i].change->day) - begun : 0;
    if (!(until_change > 0)) return draw(table, world, 0, random);
    const auto d = static_cast<std::size_t>(random.uniform() * double(table.draws));
    return life_after({{{until_change, earlier_[i]->life(world, d)}}}, table.life(world, d));
  }

  void dresspack(std::size_t i, std::size_t world, RandomStream& random, const Decision* decision,
                 const Decision* before, Outcome& outcome) const {
    const Pace& pace = paces_[i];
    // All times are hours of operation from today.
    double begun = -rows_[i].age_hours, fails = begun + draw(*rows_[i].lives, world, rows_[i].age_hours, random);
    std::size_t window = 0;
    bool is_first = true;
    const auto put_in = [&](double at, bool planned) {
      const double day = pace.day(at);
      ++(planned ? outcome.planned
                 : outcome.unplanned)[std::min(years_ - 1, static_cast<std::size_t>(day / days_per_year))];
      if (planned && !is_first) ++outcome.later[window];
      if (!planned && !is_first) ++outcome.failures[std::min(weeks_ - 1, static_cast<std::size_t>(day / 7))];
      outcome.cost += planned ? fleet_.rows[i].planned_cost : fleet_.rows[i].unplanned_cost;
      begun = at, is_first = false;
      fails = begun + std::max(shortest_life, draw_new(i, world, begun, random));
    };
    const double end = pace.hours(times_.back());
    while (true) {
      const double opens = pace.hours(times_[window]);
      const bool at_window = decision && window + 1 < times_.size() && opens < fails;
      const double next = at_window ? opens : fails;
      if (!(next < end)) return;
      if (!at_window) {
        put_in(next, false);
        continue;
      }
      const auto replaces_new = [&] {
        const double until = pace.hours(times_[window + 1]);
        if (!pace.before_change(begun)) return decision->replace_new(i, opens - begun, until - opens);
        const double now = pace.harder_hours(opens);
        return before->replace_new(i, now - pace.harder_hours(begun), pace.harder_hours(until) - now);
      };
      const bool replaces = is_first ? rows_[i].window == window : replaces_new();
      if (replaces) put_in(next, true);
      ++window;
    }
  }

  const Fleet& fleet_;
  const std::vector<const LifeTable*>&tables_, &earlier_;
  const std::vector<Pace>& paces_;
  const std::vector<RowPlan>& rows_;
  const std::vector<double>& times_;
  std::vector<double> until_;
  std::vector<std::uint64_t> names_;  ///< (row) digest of the name
  std::size_t years_ = 1, weeks_ = 1;
};

double middle_of(std::vector<float> all) {
  const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
  std::nth_element(all.begin(), middle, all.end());
  return *middle;
}

}  // namespace

double LifeTable::alive(std::size_t world, double age) const {
  return double(hours.data() + (world + 1) * draws - first_after(world, age)) / double(draws);
}

double LifeTable::horizon() const {
  constexpr double longest = 1e5;  // [h]: twice a robot's life; needed because a test rig has no robot life
  return std::min(robot_life_hours, longest);
}

const float* LifeTable::first_after(std::size_t world, double age) const {
  const float* const first = hours.data() + world * draws;
  return std::upper_bound(first, first + draws, static_cast<float>(age));
}

double LifeTable::median() const { return middle_of(hours); }

bool LifeTable::half_end_before(double limit) const {
  return static_cast<std::size_t>(std::ranges::count_if(hours, [&](float life) { return life < limit; })) >
         hours.size() / 2;
}

double LifeTable::horizon_or_median() const {
  const double until = horizon();
  const auto finite = std::ranges::count_if(hours, [](float life) { return std::isfinite(life); });
  if (finite == 0 || std::ranges::count_if(hours, [&](float life) { return life <= until; }) > finite / 2)
    return until;  // the median is not later
  return middle_of(filtered(hours, [](float life) { return std::isfinite(life); }));
}

double LifeTable::running(std::size_t world, double from, double to) const {
  double sum = 0;
  for (const float* life = first_after(world, from); life != hours.data() + (world + 1) * draws; ++life)
    sum += std::min<double>(*life, to) - from;
  return sum / double(draws);
}

Eigen::VectorXd AgeRates::least(const Eigen::VectorXd& weights) const {
  Eigen::Index best = 0;
  (rate * weights).minCoeff(&best);
  return rate.row(best).transpose();
}

AgeRates age_rates(const LifeTable& table, double planned_cost, double unplanned_cost) {
  const double shortest = *std::ranges::min_element(table.hours), last = table.horizon();
  const double first = std::max(shortest_life, std::min(last, shortest)) / 10;
  AgeRates rates{Eigen::MatrixXd(Eigen::Index(ages), Eigen::Index(table.worlds))};
  std::vector<double> at;
  for (std::size_t k = 0; k < ages; ++k) at.push_back(first * std::pow(last / first, double(k) / double(ages - 1)));
  const double of_draw = 1 / double(table.draws);
  for (std::size_t w = 0; w < table.worlds; ++w) {
    // Ages and lives are rising, so one pass through both is enough.
    const float *life = table.hours.data() + w * table.draws, *const end = life + table.draws;
    double ended = 0;  // [h] sum of the lives until this age
    for (std::size_t k = 0; k < ages; ++k) {
      for (; life != end && *life <= static_cast<float>(at[k]); ++life) ended += *life;
      const auto alive = double(end - life);
      const double lives = alive * of_draw, running = (ended + alive * at[k]) * of_draw;
      rates.rate(Eigen::Index(k), Eigen::Index(w)) =
          (planned_cost * lives + unplanned_cost * (1 - lives)) / std::max(running, first);
    }
  }
  return rates;
}

std::vector<std::vector<std::size_t>> rows_of_policies(const Fleet& fleet) {
  std::map<std::tuple<std::string_view, double, double>, std::vector<std::size_t>> alike;
  for (std::size_t i = 0; i < fleet.rows.size(); ++i) {
    const Installed& row = fleet.rows[i];
    alike[{row.duty, row.planned_cost, row.unplanned_cost}].push_back(i);
  }
  return mapped(alike, [](const auto& one) { return one.second; });
}

std::vector<double> times_of(const std::vector<Window>& windows, Day today) {
  std::vector<double> times =
      mapped(windows, [&](const Window& window) -> double { return days_between(today, window.first); });
  const double interval = times.size() > 1 ? times.back() - times[times.size() - 2] : days_per_year;
  times.push_back(times.back() + interval);
  return times;
}

Day end_of(const std::vector<Window>& windows, Day today) {
  return today + std::chrono::days(std::llround(times_of(windows, today).back()));
}

void keep_ages(Fleet& changed, const Fleet& now, const std::map<std::string, LifeTable>& tables, Day today, Day from) {
  for (Installed& row : changed.rows) {
    const Installed* const old = find_in(now.rows, &Installed::name, row.name);
    if (!old || old->since != row.since) continue;
    const LifeTable& before = tables.at(old->duty);
    row.run_hours = run_of(*old, before, today);
    row.before = old->before;
    if (old->duty == row.duty && from <= today) continue;
    double own = *row.run_hours;
    for (const Installed::Spell& spell : old->before) own -= spell.hours;
    const double days = std::max<double>(0, days_between(today, from));
    row.before.push_back({old->duty, own + days * hours_in_day(*old, before)});
    if (days > 0) row.change = {{days, hours_in_day(*old, before)}};
  }
}

double worn_hours(const Installed& row, double age, const std::function<double(const std::string&)>& life) {
  double worn = 0;
  for (const Installed::Spell& spell : row.before) {
    const double hours = std::min(spell.hours, age);
    age -= hours;
    worn += spell.duty == row.duty ? hours : hours * life(row.duty) / life(spell.duty);
  }
  return worn + age;
}

std::vector<Warning> add_histories(Fleet& fleet, const DutyFile& file, const std::map<std::string, LifeTable>& tables,
                                   Day today) {
  const Installed* younger = nullptr;
  std::string words;
  std::size_t count = 0;
  for (Installed& row : fleet.rows) {
    const Duty& duty = duty_named(file, row.duty, row.where);
    if (duty.history.empty()) continue;
    const auto hours_in = [&](double days, const std::string& of) { return days * hours_in_day(row, tables.at(of)); };
    double days = days_between(row.since, today), given = 0;
    std::vector<double> past_hours;
    for (const PastDuty& past : duty.history) {
      past_hours.push_back(past.hours.value_or(0));
      if (past.from.empty()) {
        given += past_hours.back();
        continue;
      }
      const std::array<Day, 2> dates = past.days(today);
      const double under =
          std::max(0.0, days_between(std::max(dates[0], row.since), std::min(dates[1] + std::chrono::days(1), today)));
      days -= under;
      past_hours.back() = hours_in(under, past.duty);
    }
    const double all = hours_in(std::max(0.0, days), row.duty), counted = given > all ? all / given : 1;
    double run = all - counted * given;
    for (std::size_t k = 0; k < past_hours.size(); ++k) {
      const PastDuty& past = duty.history[k];
      row.before.push_back({past.duty, past_hours[k] * (past.from.empty() ? counted : 1)});
      run += row.before.back().hours;
    }
    row.run_hours = run;
    // a tolerance of one week, because dates are often inexact
    if (days > 0 && given > all + hours_in(7, row.duty) && count++ == 0)
      younger = &row,
      words = fmt::format("{}, and its history by hours has more: {}", hours_text(all), hours_text(given));
  }
  if (!younger) return {};
  return {warning_of(WarningKind::motion, younger->where.text(),
                     fmt::format("'{}' was installed on {} and has run {}{}", younger->name, day_text(younger->since),
                                 words, count > 1 ? fmt::format(" (and {} more)", count - 1) : ""),
                     "a history of another dresspack, or another week; all of its hours count as those of the history",
                     "a history by dates (from, to), which counts from the day on which each dresspack was installed")};
}

std::vector<std::shared_ptr<const LifeTable>> first_lives(const Fleet& fleet,
                                                          const std::map<std::string, LifeTable>& tables) {
  std::vector<std::shared_ptr<const LifeTable>> lives(fleet.rows.size());
  const std::size_t threads = std::min(thread_count(), lives.size());
  in_parallel(threads, [&](std::size_t part) {
    for (std::size_t i = part; i < lives.size(); i += threads) {
      const LifeTable& own = tables.at(fleet.rows[i].duty);
      if (fleet.rows[i].before.empty())
        lives[i] = {std::shared_ptr<const LifeTable>(), &own};  // refers to `tables` without owning it
      else
        lives[i] = std::make_shared<const LifeTable>(lives_after(fleet.rows[i].before, own, tables));
    }
  });
  return lives;
}

Plan plan_of(const Fleet& fleet, const std::map<std::string, LifeTable>& tables, const std::vector<Window>& windows,
             Day today, const PlanRule& rule, std::uint64_t seed) {
  Plan plan;
  plan.today = today, plan.windows = windows;
  plan.risk = rule.risk, plan.by_cost = rule.by_cost;
  const std::vector<double> times = times_of(windows, today);
  plan.end = end_of(windows, today);
  const std::vector<std::shared_ptr<const LifeTable>> first = first_lives(fleet, tables);
  const Worlds worlds = worlds_of(fleet, tables, first, today, rule);
  plan.weights = worlds.weights();
  plan.effective_worlds = worlds.effective();
  plan.all_alive = worlds.all_alive();
  if (plan.effective_worlds < rule.enough_worlds) return plan;
  std::vector<const LifeTable*> of_row, earlier, harder;
  Fleet under_harder = fleet;
  std::vector<Pace> paces;
  double most_hours = 0;  // hours of operation within the plan
  for (const Installed& row : fleet.rows) {
    of_row.push_back(&tables.at(row.duty));
    earlier.push_back(row.change ? &tables.at(row.before.back().duty) : of_row.back());
    const Pace& pace = paces.emplace_back(row, *of_row.back(), *earlier.back());
    most_hours = std::max(most_hours, pace.hours(times.back()));
    harder.push_back(&pace.harder());
    if (harder.back() != of_row.back()) under_harder.rows[harder.size() - 1].duty = row.before.back().duty;
    plan.rows.emplace_back().age_hours = run_of(row, *of_row.back(), today);
    plan.rows.back().lives = first[plan.rows.size() - 1];
  }
  const Decision decision(fleet, of_row, worlds, rule, most_hours);
  // A replacement before a change of duty is decided by the wear under both duties.
  std::optional<const Decision> before_change;
  if (std::ranges::any_of(fleet.rows, [](const Installed& row) { return row.change.has_value(); }))
    before_change.emplace(under_harder, harder, worlds, rule, most_hours);
  const auto plan_row = [&](std::size_t i) {
    RowPlan& row = plan.rows[i];
    const LifeTable& lives = *row.lives;
    row.reach_its_age = worlds.reaches(lives, row.age_hours);
    const auto age_at = [&](double day) { return row.age_hours + paces[i].hours(day); };
    std::vector<double> weeks;
    for (std::size_t week = 1; week <= weeks_until(times.back()); ++week)
      weeks.push_back(age_at(std::min(7.0 * double(week), times.back())));
    row.fails_in_week = worlds.fails_in(lives, row.age_hours, weeks);
    // The same law as for the weeks, so that their sums agree.
    const std::vector<double> fails_until = worlds.fails_in(lives, row.age_hours, mapped(times, age_at));
    row.fails_before_first = fails_until.front();
    double failed = row.fails_before_first;
    const LaterLife life = decision.later_life(i, lives, row.age_hours);
    std::optional<LaterLife> until_change;
    if (fleet.rows[i].change)
      until_change = before_change->later_life(i, in_harder_hours(lives, row.age_hours, paces[i]), row.age_hours);
    const auto replaces_at = [&](double from, double to) {
      const double opens = from - row.age_hours;
      if (!paces[i].before_change(opens)) return decision.replace(i, life, from, to - from);
      const double now = paces[i].harder_hours(opens), until = paces[i].harder_hours(to - row.age_hours);
      return before_change->replace(i, *until_change, row.age_hours + now, until - now);
    };
    for (std::size_t n = 0; n < windows.size(); ++n) {
      const double left = 1 - failed, from = age_at(times[n]), to = age_at(times[n + 1]);
      const double fails = fails_until[n + 1];
      row.fails_until_next.push_back(left > 0 ? fails / left : 1);
      if (!row.window && replaces_at(from, to)) row.window = n, row.fails_before = failed;
      failed += fails;
    }
    if (!row.window) row.fails_before = failed;
  };
  const std::size_t threads = std::min(thread_count(), plan.rows.size());
  in_parallel(threads, [&](std::size_t part) {
    for (std::size_t i = part; i < plan.rows.size(); i += threads) plan_row(i);
  });
  for (const RowPlan& row : plan.rows) plan.reach_their_age += row.reach_its_age / double(fleet.rows.size());
  plan.failures_in_week.resize(weeks_until(times.back()));
  plan.failures_in_week_without_windows = plan.failures_in_week;
  for (const RowPlan& row : plan.rows)
    for (std::size_t week = 0; week < row.fails_in_week.size(); ++week) {
      const double until =
          row.window ? times[*row.window] / 7 - double(week) : 1;  // time until its replacement [weeks]
      plan.failures_in_week[week] += std::clamp(until, 0.0, 1.0) * row.fails_in_week[week];
      plan.failures_in_week_without_windows[week] += row.fails_in_week[week];
    }
  const Simulation simulation(fleet, of_row, earlier, paces, plan.rows, times, worlds);
  const std::size_t plants = plant_count(fleet.rows.size(), windows.size());
  const auto share = 1 / static_cast<double>(plants);
  std::vector<std::vector<double>> replaced;  // (year, plant)
  plan.later_in_window.resize(windows.size());
  for (std::size_t p = 0; p < plants; ++p) {
    // Both simulations of a plant use the same random numbers, so that their costs are comparable. Worlds are equally spaced in the
    // sum of their weights, so that each has its share of the plants.
    const std::uint64_t own = mixed(seed + p);
    const double world = (double(p) + 0.5) * share;
    const Outcome outcome = simulation.plant(world, own, &decision, before_change ? &*before_change : nullptr);
    plan.years.resize(outcome.planned.size());
    replaced.resize(outcome.planned.size());
    for (std::size_t n = 0; n < windows.size(); ++n) plan.later_in_window[n] += outcome.later[n] * share;
    for (std::size_t y = 0; y < plan.years.size(); ++y) {
      plan.years[y].planned += outcome.planned[y] * share;
      plan.years[y].unplanned += outcome.unplanned[y] * share;
      replaced[y].push_back(outcome.planned[y] + outcome.unplanned[y]);
    }
    const Outcome without = simulation.plant(world, own, nullptr, nullptr);
    for (std::size_t week = 0; week < plan.failures_in_week.size(); ++week) {
      plan.failures_in_week[week] += outcome.failures[week] * share;
      plan.failures_in_week_without_windows[week] += without.failures[week] * share;
    }
    plan.cost += outcome.cost * share;
    plan.cost_without_windows += without.cost * share;
  }
  for (std::size_t y = 0; y < plan.years.size(); ++y) {
    std::ranges::sort(replaced[y]);
    plan.years[y].low = number_at(replaced[y], 0.05 * double(plants - 1));
    plan.years[y].high = number_at(replaced[y], 0.95 * double(plants - 1));
  }
  return plan;
}

}  // namespace dresslife::pipeline
