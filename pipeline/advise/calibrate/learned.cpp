#include "pipeline/advise/calibrate/learned.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "pipeline/base/lists.h"
#include "pipeline/base/readable.h"
#include "pipeline/base/statistics.h"
#include "pipeline/base/warning_words.h"
#include "pipeline/job/uncertainty.h"
#include "pipeline/job/wall_strength.h"
#include "pipeline/life/planning.h"
#include "pipeline/study/row_warnings.h"

namespace dresslife::pipeline {
namespace {

using Eigen::Index;

std::string parameter_lines(const Learned& learned) {
  std::string text =
      fmt::format("{:<17} {:>24} {:>24}  {}\n", "parameter", "before (80 %)", "after (80 %)", "width after/before");
  const auto range = [](const PredictedDeciles& of) {
    return fmt::format("{} ({} .. {})", readable(of[1]), readable(of[0]), readable(of[2]));
  };
  for (std::size_t p = 0; p < uncertain_count; ++p) {
    const LearnedAxis& axis = learned.axes[p];
    const bool is_of_one = uncertain_parameters()[p].shared == SharedBy::installation;
    text += fmt::format("{:<17} {:>24} {:>24}  {}\n", uncertain_parameters()[p].name, range(axis.before),
                        axis.learned ? range(axis.after) : "-",
                        axis.learned ? fmt::format("{:.0f} %{}", 100 * axis.narrowed, is_of_one ? ", only there" : "")
                                     : why_not_learned(axis));
  }
  return text;
}

/// Adds warnings about records that were improbable before the calibration, and about dresspacks older than it predicts.
void add_service_doubts(const LearnedTest& test, double surprising, Learned& learned) {
  const ServiceChance &before = test.chance_before, &after = test.chance_after;
  const std::string name = test.observation.name, seen = observed_text(test.observation);
  const auto percent = [](double share) { return readable(100 * share, 2) + " %"; };
  // a probability below 1e-12 is printed as this limit
  if (const double chance = std::min(before.few, before.many); chance < surprising)
    learned.warnings.push_back(fmt::format(
        "'{}': {} failures than predicted ({}): without any observation (makers' ratings, too) 1 of {} such plants has as {}. The predicted life of half of them "
        "changed from {} to {}. Correct the job, the dates or the hours per week if one of them is wrong",
        name, before.few < before.many ? "fewer" : "more", seen, readable(1 / std::max(chance, 1e-12), 2),
        before.few < before.many ? "few" : "many", life_text(test.before[1], 2), life_text(test.after[1], 2)));
  if (after.reach < usual_reach) {
    const auto ages =
        filtered(mapped(test.observation.service, &ServiceRecord::entry_hours), [](double age) { return age > 0; });
    learned.warnings.push_back(fmt::format(
        "'{}': {} dresspacks were in use when the records begin, half of them {} old or older. By this calibration {} of new ones reach such "
        "ages (before: {}), half of them live {}. The hours before the records do not count, because the table may lack dresspacks that were "
        "removed then. If it has every removal from an earlier day on, give that day: --records-since DATE. Otherwise do not plan with this "
        "calibration: these dresspacks live longer than it predicts",
        name, ages.size(), hours_text(quantile(ages, 0.5)), percent(after.reach), percent(before.reach),
        life_text(test.after[1], 2)));
  }
}

/// Returns the line below the table that compares ages of dresspacks in service.
std::string service_line(const LearnedTest& test) {
  if (!test.fit.observed)
    return fmt::format("\nThe records of '{}' have fewer than {} dresspacks of one age: no observed hours.\n",
                       test.observation.name, ObservedAges::fewest);
  return fmt::format(
      "\nObserved hours of '{}' (Kaplan-Meier): {}. Predicted after, of new ones: 10 % by {}, half by {}.\n",
      test.observation.name, words_of(*test.fit.observed), life_text(test.after[0], 2) + " h",
      life_text(test.after[1], 2) + " h");
}

double surprise(const LearnedTest& test, PredictedDeciles predicted) {
  const Observation& observation = test.observation;
  if (!observation.service.empty()) return 0;  // many lives have no single surprise
  double seen = observation.is_life() ? observed_life(observation) : test.measured;
  if (seen < 0) {  // the largest moment of a loop that ends in the other direction
    seen = -seen;
    predicted = {-predicted[2], -predicted[1], -predicted[0]};
  }
  if (!observation.is_life() && seen > 0 && predicted[2] < 0) return std::numeric_limits<double>::infinity();
  const auto off = [&](double side) {
    return std::log(seen / predicted[1]) / (std::log(side / predicted[1]) / normal_decile);
  };
  if (!(seen > 0) || !std::isfinite(predicted[2])) return 0;
  const bool both = !observation.is_life() || observation.outcome == ObservedEnd::broken;
  if (seen > predicted[1]) return both || bounds_below(observation.outcome) ? off(predicted[2]) : 0;
  return both || bounds_above(observation.outcome) ? off(predicted[0]) : 0;
}

std::string chance_words(double deviations) {
  constexpr double most = 1e6;  // tails of the predictions beyond it are not known
  const double observations = 1 / std::erfc(deviations / std::numbers::sqrt2);
  return fmt::format("by chance {} 1 of {} observations is as far off", observations > most ? "fewer than" : "about",
                     readable(std::min(observations, most), 1));
}

}  // namespace

std::optional<Warning> contradiction_of(const LearnedTest& test) {
  const ServiceFit& fit = test.fit;
  if (fit.chance >= least_service_chance) return std::nullopt;
  constexpr double alike = 1.2;  // b, a change of the scatter that is no cause of a contradiction
  const bool narrower = fit.shape > alike, wider = fit.shape < 1 / alike;
  std::string what = fmt::format("'{}': {} after the calibration (probability {} {}, limit 1 %)", test.observation.name,
                                 records_contradict, fit.chance < 1e-6 ? "below" : "of",
                                 fit.chance < 1e-6 ? "0.0001 %" : readable(100 * fit.chance, 2) + " %");
  if (fit.observed) {
    what += ". Observed: " + words_of(*fit.observed);
    if (fit.observed->tenth)
      what += fmt::format(". Predicted: {} by {}", readable(100 * fit.predicted_tenth, 2) + " %",
                          hours_text(*fit.observed->tenth));
    if (fit.observed->half)
      what += fmt::format(", {} by {}", readable(100 * fit.predicted_half, 2) + " %", hours_text(*fit.observed->half));
  }
  const std::string cause =
      narrower
          ? "dresspacks that were replaced by plan at one age and are marked as failed, or dates that were copied from row to row"
      : wider ? "failures by another cause than wear, wrong dates, or dresspacks with different motions under one job"
              : "a job, dates or hours per week that are not theirs";
  std::string remedy = "do not plan with this calibration";
  if (fit.observed && fit.observed->tenth)
    remedy += fmt::format(". Plan with the observed hours: 10 % had failed by {}", hours_text(*fit.observed->tenth));
  else if (fit.observed)
    remedy += fmt::format(". Plan with the observed hours: fewer than 10 % had failed by {}",
                          hours_text(fit.observed->until));
  remedy += narrower ? "; or correct the reasons (preventive) and dates of the rows"
                     : "; or correct the rows, or give each motion its own job (column job)";
  return warning_of(WarningKind::calibration, "", what, cause, remedy);
}

double surprise(const LearnedTest& test) { return surprise(test, test.before); }
double surprise_by_others(const LearnedTest& test) { return surprise(test, test.by_others); }

std::vector<LearnedAxis> learned_axes(const Posterior& posterior, const Axes& axes) {
  std::vector<LearnedAxis> learned(uncertain_count);
  for (std::size_t p = 0; p < uncertain_count; ++p) {
    const UncertainParameter& parameter = uncertain_parameters()[p];
    const double decile = normal_decile * axes.prior()[static_cast<Index>(p)];
    learned[p].before = {parameter.value(-decile), parameter.value(0), parameter.value(decile)};
    learned[p].after = learned[p].before;
    learned[p].is_own = axes.has_own(static_cast<Index>(p));
  }
  for (Index i = 0; i < axes.size(); ++i) {
    const auto p = static_cast<std::size_t>(axes.places()[static_cast<std::size_t>(i)]);
    const UncertainParameter& parameter = uncertain_parameters()[p];
    learned[p].learned = true;
    learned[p].after = {parameter.value(posterior.low[i]), parameter.value(posterior.median[i]),
                        parameter.value(posterior.high[i])};
    learned[p].narrowed = std::sqrt(posterior.covariance(i, i)) / axes.prior()[static_cast<Index>(p)];
  }
  return learned;
}

std::string_view why_not_learned(const LearnedAxis& axis) {
  if (axis.before[0] == axis.before[2]) return "the jobs state it";
  return axis.is_own ? "each dresspack has its own" : "no test depends on it";
}

std::string words_of(const PredictedDeciles& deciles) {
  return fmt::format("{} ({}, {})", life_text(deciles[0], 2), life_text(deciles[1], 2), life_text(deciles[2], 2));
}

std::string doubt_of(const LearnedTest& test, double surprising) {
  if (const double off = surprise(test); off > surprising)
    return fmt::format(
        "'{}' is far from its prediction: {}. Remedy: check its construction and its test before you use this calibration",
        test.observation.name, chance_words(off));
  if (const double apart = surprise_by_others(test); apart > surprising)
    return fmt::format(
        "'{}' contradicts the other observations, which predict {}: {}. Remedy: check the cables, the tests and the outcomes "
        "before you use this calibration",
        test.observation.name, words_of(test.by_others), chance_words(apart));
  return "";
}

std::string misfit_of(const LearnedTest& test) {
  constexpr double most = 3;  // standard deviations
  const Observation& observation = test.observation;
  const bool is_life = observation.is_life();
  if (is_life ? surprise(test, test.after) <= most : test.misfit <= test.usual_misfit) return "";
  const bool is_curve = !observation.bending.empty();
  std::string text = fmt::format(
      "'{}': the model does not reproduce this row after it learned from it: observed {}, predicted after {}",
      observation.name,
      is_curve ? "a largest moment of " + readable(test.measured, 3) + " N m" : observed_text(observation),
      words_of(test.after));
  if (!is_life)
    text += fmt::format("; {} by {} times its noise_percent (limit {})",
                        is_curve ? "its moments differ (root mean square)" : "they differ", readable(test.misfit, 2),
                        readable(test.usual_misfit, 2));
  if (is_curve)
    return text +
           ". Likely cause: a curve of another shape than the model's (another construction, a jacket that creeps, play of the "
           "clamps), wrong units, or a noise_percent that is too small. Remedy: give the moment over the curvature at the largest "
           "curvature as a row with stiffness_Nm2 and at_curvature_1_per_m instead of the curve, or correct the curve; do not use "
           "the ranges of this calibration";
  return text +
         ". Likely cause: rows that contradict each other, wrong units or another construction. Remedy: correct them or leave the "
         "wrong row out; do not use this calibration";
}

void add_doubts(Learned& learned, const Axes& axes) {
  constexpr double surprising = 2, skewed = 0.3;  // standard deviations
  for (const LearnedTest& test : learned.tests) {
    if (const auto contradiction = contradiction_of(test)) learned.warnings.push_back(contradiction->words);
    add_service_doubts(test, normal_share(-surprising), learned);
  }
  for (const LearnedTest& test : learned.tests)
    if (const std::string doubt = doubt_of(test, surprising); !doubt.empty()) learned.notes.push_back(doubt);
  const Posterior& posterior = learned.posterior;
  for (Index i = 0; i < axes.size(); ++i) {
    const double off = (posterior.median[i] - posterior.laplace.most_likely[i]) / std::sqrt(posterior.covariance(i, i));
    if (std::abs(off) > skewed)
      learned.notes.push_back(fmt::format(
          "{}: values far {} its likeliest one remain possible, because what has not failed bounds it on one side only. "
          "The ranges above include them",
          uncertain_parameters()[static_cast<std::size_t>(axes.places()[static_cast<std::size_t>(i)])].name,
          off > 0 ? "above" : "below"));
  }
}

std::string learned_table(const Learned& learned) {
  const auto seen = [](const LearnedTest& test) {
    return test.observation.bending.empty() ? observed_text(test.observation) : readable(test.measured, 3) + " N m";
  };
  std::string text = parameter_lines(learned);
  if (learned.own_spread)
    text += fmt::format(
        "\nSpread between dresspacks: x {} ({} .. {}), before x 1 ({} .. {}). It multiplies the deviations of slack, grip, rest and motion\n"
        "between dresspacks, and of the error of computed lives.\n",
        readable(learned.own_spread->factor), readable(learned.own_spread->low), readable(learned.own_spread->high),
        readable(own_spread_at(-normal_decile)), readable(own_spread_at(normal_decile)));
  for (const LearnedWall& wall : learned.walls) {
    const auto factor = [](double z) { return readable(std::pow(wall_strength_step, z)); };
    text += fmt::format(
        "\n{}, not validated, from hoses that had not cracked: x {} ({} .. {}), before x 1 ({} .. {})\n", wall.name,
        factor(wall.median), factor(wall.low), factor(wall.high), factor(-normal_decile), factor(normal_decile));
  }
  const std::size_t name = largest_of(learned.tests, std::size_t{22},
                                      [](const LearnedTest& test) { return columns_of(test.observation.name); });
  constexpr const char* columns = "{:<{}} {:>20} {:>31} {:>31} {:>31}  {}\n";
  text += "\n" + fmt::format(fmt::runtime(columns), "observation", name, "observed", "predicted before",
                             "predicted by the others", "predicted after", "fails first");
  for (const LearnedTest& test : learned.tests)
    text += fmt::format(fmt::runtime(columns), test.observation.name, name, seen(test), words_of(test.before),
                        words_of(test.by_others), words_of(test.after), test.fails_first);
  for (const LearnedTest& test : learned.tests)
    if (!test.observation.service.empty()) text += service_line(test);
  for (const LearnedTest& test : learned.tests)
    if (!test.observation.service.empty())
      text += fmt::format(
          "\nThe life of '{}' depends most on (factor of the life, if a usual uncertainty of the parameter is added): {}\n",
          test.observation.name, test.moved_by.empty() ? "of none" : test.moved_by);
  text +=
      "\nParameters: factors of the job's keys (slope: added to b): the middle value, and the range that holds it in 8 of 10 cases.\n"
      "Width after/before: of this range. Above 100 %: the observations leave more values possible than were assumed before.\n"
      "Only there: each dresspack has its own value, so the calibration leaves out what the observed one had.\n"
      "Predicted: the life after which 10 % of such specimens have failed (half, 90 %); of a bending test its largest moment.\n"
      "Predicted before: without any observation. By the others: without this observation. Fails first: in which share of the samples that fail.\n"
      "Compare 'predicted after' with the 'replace after' that dresslife run prints for a job with this calibration. They differ somewhat,\n"
      "because run is for another dresspack, and computes the strains at the middle values above. If no warning follows, plan with those of\n"
      "run. 'Predicted before' is not what run prints without a calibration: run includes makers' ratings (uncertainty.ratings), which a\n"
      "calibration replaces.\n";
  if (!learned.settled)
    text +=
        fmt::format("warning: after {} rounds the result still changes: it is less exact than usual\n", learned.rounds);
  for (const std::string& warning : learned.warnings) text += "warning: " + warning + "\n";
  for (const std::string& note : learned.notes) text += "note: " + note + "\n";
  return text;
}

}  // namespace dresslife::pipeline
