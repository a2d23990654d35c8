#include "pipeline/job/calibration.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>

#include "pipeline/base/joined.h"
#include "pipeline/base/lists.h"
#include "pipeline/base/readable.h"
#include "pipeline/job/wall_strength.h"
#include "pipeline/settings/fields.h"

namespace dresslife::pipeline {

void describe(Fields& f, LearnedParameter& parameter) {
  f.place(parameter.where);
  f.text("name", parameter.name, Need::required, "as in job.uncertainty");
  f.number("median", parameter.median, Need::required, between(-20, 20), "of its standardised variable z");
  f.number("mean", parameter.mean, Need::required, between(-20, 20), "likewise");
  f.number("prior", parameter.prior, Need::optional, at_least(0), "standard deviation of z before the observations");
  f.numbers("covariance", parameter.covariance, Need::required, "of z with every parameter of this list");
  f.numbers("samples", parameter.samples, Need::optional, "of z; a place in this list is one sample of all parameters");
  f.number("value", parameter.value, Need::optional, any_number(), "median of its key, for people");
  f.number("value_p10", parameter.value_p10, Need::optional, any_number(),
           "80 % of what is likely lie between this ...");
  f.number("value_p90", parameter.value_p90, Need::optional, any_number(), "... and this");
}

void describe(Fields& f, LearnedFrom& from) {
  f.text("observation", from.observation, Need::required, "its name");
  f.text("observed", from.observed, Need::optional, "what was seen");
  f.text("predicted_before", from.predicted_before, Need::optional,
         "median and 10 .. 90 % of the same, from the prior");
  f.text("predicted_after", from.predicted_after, Need::optional, "and from what was learned");
  f.text("digest", from.digest, Need::optional, "of the row and the files that it names");
}

void describe(Fields& f, LearnedWithin& within) {
  f.maybe_number("least_strain_range", within.least_strain_range, at_least(0), "of the worst wire, over the tests");
  f.maybe_number("largest_strain_range", within.largest_strain_range, at_least(0), "likewise");
  f.maybe_number("largest_curvature_1_per_m", within.largest_curvature, at_least(0), "of the tests");
  f.maybe_number("largest_twist_deg_per_m", within.largest_twist, at_least(0), "of the tests");
  f.maybe_number("fewest_cycles", within.fewest_cycles, at_least(0), "that were observed");
  f.maybe_number("most_cycles", within.most_cycles, at_least(0), "likewise");
  f.text("materials", within.materials, Need::optional, "of the wires, comma-separated");
  f.text("left_out", within.left_out, Need::optional,
         "parameters that do not hold for the job, and why: in resolved jobs");
}

void describe(Fields& f, LearnedSetting& setting) {
  f.text("key", setting.key, Need::required, "of a job");
  f.text("value", setting.value, Need::required, "its value in a test; any: it does not matter there");
}

void describe(Fields& f, LearnedCable& cable) {
  f.text("name", cable.name, Need::required, "of the cable");
  f.text("hose", cable.hose, Need::optional, "dresspack that it lay in; empty: it was tested alone");
  f.text("construction", cable.construction, Need::required, "digest of its parts, without names and friction keys");
  f.text("friction", cable.friction, Need::optional, "friction keys of its parts");
}

void describe(Fields& f, LearnedMaterial& material) {
  f.text("name", material.name, Need::required, "of a material of wires");
  f.text("constants", material.constants, Need::required, "its keys");
}

void describe(Fields& f, LearnedUnder& under) {
  f.text("motions", under.motions, Need::optional,
         "digests of motion and routing of dresspacks in service; own_spread is that of their lives");
  f.list("settings", under.settings, Need::optional, "a job with others is refused");
  f.list(
      "cables", under.cables, Need::optional,
      "a job with other friction keys is refused; for a job with other cables friction_inside, friction_hose and play "
      "keep their priors");
  f.list("materials", under.materials, Need::optional,
         "a job with other constants is refused; for a job with other materials strength, slope and scatter keep their "
         "priors");
}

void describe(Fields& f, Calibration& calibration) {
  f.place(calibration.where);
  f.text("format", calibration.format, Need::required, Calibration::format_word);
  f.integer("format_version", calibration.format_version, Need::required, at_least(1), "of the file");
  f.boolean("applied", calibration.applied, Need::optional,
            "whether its medians stand in the job's keys already: in resolved jobs");
  f.boolean("typical", calibration.typical, Need::optional,
            "whether it was learned from cables of different makers, for a cable that none of its tests had");
  f.text("note", calibration.note, Need::optional, "how it was learned");
  f.text("contradiction", calibration.contradiction, Need::optional,
         "warning that its records contradict the prediction with it");
  f.text("doubts", calibration.doubts, Need::optional, "warnings of doubtful observations, one per line");
  f.list("parameters", calibration.parameters, Need::required, "what was learned");
  f.number("own_spread", calibration.own_spread, Need::optional, between(0.001, 100),
           "factor of the spread between dresspacks: of slack, rest and motion, and of the error of computed lives");
  f.number("residual_spread", calibration.residual_spread, Need::optional, between(0.001, 100),
           "factor of the error of computed lives, in resolved jobs: own_spread if the records have the job's motion");
  f.group("under", calibration.under, Need::optional, "what the tests were computed with");
  f.group("within", calibration.within, Need::optional, "the range of the tests; outside it nothing was tested");
  f.list("observations", calibration.observations, Need::optional, "from what it was learned");
}

namespace {

/// Returns the number of samples of the first parameter that is none of a wall.
std::size_t samples_in(const Calibration& calibration) {
  const auto found = std::ranges::find_if(calibration.parameters, [](const LearnedParameter& parameter) {
    return index_of(parameter.name) < uncertain_count;
  });
  return found == calibration.parameters.end() ? 0 : found->samples.size();
}

void check_parameter(const Calibration& calibration, std::size_t i) {
  const LearnedParameter& parameter = calibration.parameters[i];
  if (index_of(parameter.name) == uncertain_count && !is_wall_strength(parameter.name)) {
    throw InputError(
        parameter.where, fmt::format("'{}' is no uncertain parameter", parameter.name),
        fmt::format("one of: {}", joined(mapped(uncertain_parameters(), &UncertainParameter::name), ", ")));
  }
  for (std::size_t other = 0; other < i; ++other)
    if (calibration.parameters[other].name == parameter.name)
      throw InputError(parameter.where, fmt::format("'{}' is listed twice", parameter.name), "keep one of the two");
  if (parameter.covariance.size() != calibration.parameters.size())
    throw InputError(parameter.where,
                     fmt::format("'{}' has {} covariances (there are {} parameters)", parameter.name,
                                 parameter.covariance.size(), calibration.parameters.size()),
                     "run dresslife calibrate again");
  if (index_of(parameter.name) < uncertain_count && parameter.samples.size() != samples_in(calibration))
    throw InputError(parameter.where,
                     fmt::format("'{}' has {} samples, another parameter has {}", parameter.name,
                                 parameter.samples.size(), samples_in(calibration)),
                     "run dresslife calibrate again");
}

Eigen::MatrixXd covariance_of(const Calibration& calibration) {
  const auto n = static_cast<Eigen::Index>(calibration.parameters.size());
  Eigen::MatrixXd covariance(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j)
      covariance(i, j) = calibration.parameters[static_cast<std::size_t>(i)].covariance[static_cast<std::size_t>(j)];
  return covariance;
}

/// Returns the calibration's samples; null: it has none.
std::shared_ptr<const StandardSamples> standard_samples(const Calibration& calibration,
                                                        const ParameterKnowledge& knowledge) {
  if (samples_in(calibration) == 0) return nullptr;
  auto samples = std::make_shared<StandardSamples>();
  std::vector<const LearnedParameter*> of;
  for (const std::size_t p : sampling_order())
    if (const LearnedParameter* const found =
            find_in(calibration.parameters, &LearnedParameter::name, uncertain_parameters()[p].name))
      samples->parameters.push_back(p), of.push_back(found);
  const Eigen::MatrixXd factor = triangular_factor(knowledge.covariance, samples->parameters);
  Eigen::MatrixXd& numbers = samples->numbers;
  numbers.setZero(static_cast<Eigen::Index>(samples_in(calibration)), factor.rows());
  for (Eigen::Index k = 0; k < factor.rows(); ++k) {
    if (factor(k, k) == 0) continue;  // the parameter is known
    const LearnedParameter& parameter = *of[static_cast<std::size_t>(k)];
    const Eigen::Map<const Eigen::VectorXd> z(parameter.samples.data(), numbers.rows());
    numbers.col(k) = ((z.array() - parameter.mean).matrix() - numbers.leftCols(k) * factor.row(k).head(k).transpose()) /
                     factor(k, k);
  }
  return samples;
}

}  // namespace

void check_calibration(const Calibration& calibration) {
  if (calibration.format != Calibration::format_word)
    throw InputError(calibration.where, fmt::format("has the format '{}'", calibration.format),
                     fmt::format("name a file that dresslife calibrate wrote ({})", Calibration::format_word));
  if (calibration.format_version > Calibration::newest_version)
    throw InputError(calibration.where,
                     fmt::format("is of version {} (this dresslife reads up to {})", calibration.format_version,
                                 Calibration::newest_version),
                     "use the dresslife that wrote it, or calibrate again");
  for (std::size_t i = 0; i < calibration.parameters.size(); ++i) check_parameter(calibration, i);
  const Eigen::MatrixXd covariance = covariance_of(calibration);
  constexpr double rounding = 1e-6;  // of printed numbers
  const bool symmetric = (covariance - covariance.transpose()).norm() <= rounding * covariance.norm();
  // A known parameter has variance 0.
  const Eigen::MatrixXd lifted =
      covariance + rounding * Eigen::MatrixXd::Identity(covariance.rows(), covariance.cols());
  if (!symmetric || lifted.llt().info() != Eigen::Success)
    throw InputError(calibration.where, "has covariances that are not symmetric and positive",
                     "run dresslife calibrate again");
}

ParameterKnowledge knowledge_of(const Calibration& calibration, ParameterKnowledge prior) {
  ParameterKnowledge& knowledge = prior;
  for (std::size_t p = 0; p < uncertain_count; ++p)
    if (uncertain_parameters()[p].shared == SharedBy::installation) {
      knowledge.covariance.row(static_cast<Eigen::Index>(p)) *= calibration.own_spread;
      knowledge.covariance.col(static_cast<Eigen::Index>(p)) *= calibration.own_spread;
    }
  const Eigen::MatrixXd covariance = covariance_of(calibration);
  std::vector<std::pair<Eigen::Index, Eigen::Index>> places;  // index in the list, index of the parameter
  for (std::size_t i = 0; i < calibration.parameters.size(); ++i)
    if (const std::size_t p = index_of(calibration.parameters[i].name); p < uncertain_count) places.emplace_back(i, p);
  for (const auto& [i, p] : places) {
    knowledge.mean[p] = calibration.parameters[static_cast<std::size_t>(i)].mean;
    for (const auto& [j, q] : places) knowledge.covariance(p, q) = covariance(i, j);
  }
  knowledge.samples = standard_samples(calibration, knowledge);
  return knowledge;
}

std::vector<std::string> beyond(const LearnedWithin& within, const Experience& experience) {
  constexpr double hardly = 1.05;  // the tests' quantities are known to a few per cent
  // A test's strains may differ by this factor between the last round of a calibration and its medians. ESTIMATE.
  constexpr double strains = 1.25;
  std::vector<std::string> words;
  const auto at_most = [&](const char* what, double value, const std::optional<double>& most, double margin) {
    if (most && value > margin * *most)
      words.push_back(fmt::format("{} of {} (at most {} in its tests)", what, readable(value, 2), readable(*most, 2)));
  };
  at_most("a strain range", experience.strain_range, within.largest_strain_range, strains);
  if (within.least_strain_range && experience.strain_range > 0 &&
      experience.strain_range * strains < *within.least_strain_range)
    words.push_back(fmt::format("a strain range of {} (at least {} in its tests)", readable(experience.strain_range, 2),
                                readable(*within.least_strain_range, 2)));
  at_most("a curvature [1/m]", experience.curvature, within.largest_curvature, hardly);
  at_most("a twist [rad/m]", experience.twist, within.largest_twist, hardly);
  if (!within.left_out.empty()) words.push_back(within.left_out);
  return words;
}

}  // namespace dresslife::pipeline
