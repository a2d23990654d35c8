#include "pipeline/life/first_failure.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include "pipeline/life/unvalidated_modes.h"
#include "tests/catch.h"
#include "tests/pipeline/life/straight_response.h"

using namespace dresslife::pipeline;

namespace {

constexpr std::size_t motion = index_of(Uncertain::motion);
constexpr std::size_t friction = index_of(Uncertain::friction_inside), slack = index_of(Uncertain::slack),
                      strength = index_of(Uncertain::strength), scatter = index_of(Uncertain::scatter),
                      model = index_of(Uncertain::model);
constexpr double decile = 1.2815515655446004;  // of the normal distribution
// Of a percentile's rank among 10,000 samples that are stratified over each cause: at most 0.004 measured over 20 names.
constexpr double sampling_error = 0.02;
const double model_decades = uncertain_parameters()[model].deviation() / std::log(10.0);

double normal(double z) { return std::erfc(-z / std::sqrt(2.0)) / 2; }

LifeResponse straight(double a, double b, double c, double median = 5) {
  LifeResponse response = straight_response(a, b, c, median);
  response.knowledge.covariance(motion, motion) = 0;  // as if no robot moved; motion has its own test
  return response;
}

double sum(const CauseShares& share) { return std::accumulate(share.begin(), share.end(), 0.0); }

}  // namespace

TEST_CASE("samples of a straight response are normal, with the sum of the variances, and each cause its share") {
  const double a = 0.6, b = 0.2, c = 0.4, by_scatter = 0.1 / decile;
  const FirstFailures lives = summary_of({straight(a, b, c)}, "job");
  const double of_residual = residual_decades * residual_decades;
  const double variance = a * a + b * b + c * c + model_decades * model_decades + by_scatter * by_scatter + of_residual;
  const double deviation = std::sqrt(variance);
  for (const auto& [k, z] : {std::pair{0, -decile}, std::pair{1, 0.0}, std::pair{2, decile}})
    CHECK(std::log10(lives.percentiles[k]) == Approx(5 + deviation * z).margin(sampling_error * deviation));
  constexpr double share_error =
      0.03;  // 4000 samples have a random error of 1 / sqrt(4000) of the variance; twice that
  CHECK(lives.share[friction] == Approx(a * a / variance).margin(share_error));
  CHECK(lives.share[strength] == Approx(c * c / variance).margin(share_error));
  CHECK(lives.share[slack] == Approx(b * b / variance).margin(share_error));
  CHECK(lives.share[model] == Approx(model_decades * model_decades / variance).margin(share_error));
  CHECK(lives.share[uncertain_count] == Approx(by_scatter * by_scatter / variance).margin(share_error));
  CHECK(lives.share[uncertain_count + 1] == Approx(of_residual / variance).margin(share_error));
  CHECK(lives.share[scatter] == 0);
  CHECK(sum(lives.share) == Approx(1).margin(1e-12));
  CHECK(largest_share(lives.share) == friction);  // the residual is no cause that a test can reduce
  CHECK(lives.first == std::vector<double>{1});
  // A hundred times the life: the same samples have the same variances.
  const FirstFailures longer = summary_of({straight(a, b, c, 7)}, "job");
  for (std::size_t cause = 0; cause < lives.share.size(); ++cause)
    CHECK(longer.share[cause] == Approx(lives.share[cause]).margin(1e-9));
}

TEST_CASE("samples of a posterior that is not normal keep the dependence of its parameters") {
  // Strength follows from friction on a curve, so that lives are nearly equal, as after many failures in service. The covariance
  // of the two parameters is 0.
  constexpr double a = 0.5, c = 0.4;
  LifeResponse curved = straight(0, 0, c);
  for (std::size_t k = 0; k < curved.points.size(); ++k)  // the life is 5 - a |friction| + c strength
    for (std::size_t s = 0; s < 3; ++s)
      curved.worst_life[3 * k + s] = 5.3 - a * std::abs(curved.points[k][friction]) + c * curved.strength[s];
  curved.planned = {{5, 5, 5}};
  curved.knowledge.covariance.setZero();
  const std::vector<double> f = standard_strata(1000);
  double mean = 0, variance = 0;
  for (const double z : f) mean += std::abs(z) * a / c / 1000;
  for (const double z : f) variance += std::pow(std::abs(z) * a / c - mean, 2) / 1000;
  StandardSamples samples{{friction, strength}, Eigen::MatrixXd(1000, 2)};
  for (Eigen::Index k = 0; k < 1000; ++k) {
    const double z = f[static_cast<std::size_t>(k)];
    samples.numbers(k, 0) = z, samples.numbers(k, 1) = (std::abs(z) * a / c - mean) / std::sqrt(variance);
  }
  curved.knowledge.mean(strength) = mean;
  curved.knowledge.covariance(friction, friction) = 1, curved.knowledge.covariance(strength, strength) = variance;
  const auto width = [](const FirstFailures& lives) {
    return std::log10(lives.percentiles[2]) - std::log10(lives.percentiles[0]);
  };
  const FirstFailures normal = summary_of({curved}, "job");
  CHECK(width(normal) > 0.8);
  curved.knowledge.samples = std::make_shared<const StandardSamples>(std::move(samples));
  const FirstFailures lives = summary_of({curved}, "job");
  CHECK(width(lives) < 1e-9);
  CHECK(sum(lives.share) == Approx(1).margin(1e-9));
  // As text the numbers have three decimals, which change a life by at most (a + c) 0.0005 decades.
  const FailureModes read = modes_from_text(modes_text({curved, curved}));
  REQUIRE(read.size() == 2);
  CHECK(width(summary_of(read, "job")) < 2e-3);
  CHECK(modes_text(read) == modes_text({curved, curved}));
  CHECK_THROWS_AS(modes_from_text("samples strength 1 2\nsamples slope 1\n" + curved.text()), std::invalid_argument);
  CHECK_THROWS_AS(modes_from_text("samples weight 1 2\n" + curved.text()), std::invalid_argument);
  CHECK_THROWS_AS(modes_from_text("samples slope 1 two\n" + curved.text()), std::invalid_argument);
}

TEST_CASE("the swing of a mounted hose widens lives, each job's by its own") {
  LifeResponse swings = straight(0, 0, 0);
  swings.knowledge.covariance.setZero();
  swings.knowledge.covariance(motion, motion) = 1;
  swings.planned = {{5, 5, 5}};
  const double decades = std::log10(uncertain_parameters()[motion].value(1));
  const FirstFailures lives = summary_of({swings}, "job");
  CHECK(std::log10(lives.percentiles[0]) == Approx(5 - decile * decades).margin(sampling_error * decades));
  CHECK(lives.share[motion] == Approx(1));
  // Two jobs whose lives differ by one deviation of their difference: the longer outlives in Phi(1) of the samples.
  LifeResponse longer = straight(0, 0, 0, 5 + decades * std::sqrt(2.0));
  longer.knowledge = swings.knowledge;
  CHECK(share_outliving(first_failures({longer}, "one"), first_failures({swings}, "other")) ==
        Approx(normal(1)).margin(sampling_error));
  // With the same simulation both swing in the same way.
  CHECK(compared_failures({swings}, "one", "one", 500) == first_failures({swings}, "one", 500));
  CHECK(share_outliving(compared_failures({longer}, "one", "one", 500),
                        compared_failures({swings}, "other", "one", 500)) == 1);
}

TEST_CASE(
    "the swing has the share of its variance: apart from the others, learned together with one, of two dresspacks") {
  const double swing = std::log10(uncertain_parameters()[motion].value(1)), a = 0.5, b = 0.3, error = 0.03;  // as above
  LifeResponse one = straight(a, b, 0);
  one.knowledge.covariance(motion, motion) = 1;
  one.planned = {{5, 5, 5}};
  const double others = a * a + b * b + model_decades * model_decades + residual_decades * residual_decades;
  const auto share_of = [&](const FailureModes& modes) {
    const FirstFailures lives = summary_of(modes, "job");
    CHECK(sum(lives.share) == Approx(1).margin(1e-12));
    return lives.share[motion];
  };
  CHECK(share_of({one}) == Approx(swing * swing / (others + swing * swing)).margin(error));
  // A second dresspack that outlives the first changes nothing. It has its own swing, so sets of causes contain the swing.
  LifeResponse beside = straight(a, b, 0, 15);
  beside.knowledge = one.knowledge;
  one.dresspack = "one", beside.dresspack = "beside";
  CHECK(share_of({one, beside}) == Approx(swing * swing / (others + swing * swing)).margin(error));
  constexpr double together = -0.6;
  one.dresspack = "", one.knowledge.covariance(motion, static_cast<Eigen::Index>(model)) =
                          one.knowledge.covariance(static_cast<Eigen::Index>(model), motion) = together;
  // Of two normal causes x + y, each has half of the variance of the sum and half of the difference of what each explains alone.
  const double sum_of_both = swing * swing + model_decades * model_decades + 2 * together * swing * model_decades;
  const double by_swing = std::pow(swing + together * model_decades, 2),
               by_model = std::pow(model_decades + together * swing, 2);
  CHECK(share_of({one}) ==
        Approx((sum_of_both + by_swing - by_model) / 2 / (others - model_decades * model_decades + sum_of_both))
            .margin(error));
}

TEST_CASE("shares of causes that act together are divided between them and add up to 1") {
  // Friction has an effect only where slack is not 0: first-order shares of both would be 0.
  LifeResponse product = straight(0, 1, 0);
  for (std::size_t k = 0; k < product.points.size(); ++k)
    for (std::size_t s = 0; s < product.strength.size(); ++s)
      product.worst_life[3 * k + s] = 5.3 + 0.4 * product.points[k][friction] * product.points[k][slack];
  product.knowledge.covariance(model, model) = 0;
  product.planned = {{5, 5, 5}};
  const FirstFailures lives = summary_of({product}, "job");
  const double variance = 0.4 * 0.4, each = 0.5 * variance / (variance + residual_decades * residual_decades);
  CHECK(lives.share[friction] == Approx(each).margin(0.05));  // fourth moments of a product have a larger random error
  CHECK(lives.share[slack] == Approx(each).margin(0.05));
  CHECK(sum(lives.share) == Approx(1).margin(1e-12));
}

TEST_CASE("shares of causes that were learned together: by the conditional distribution, and they add up to 1") {
  // log10 life = friction + strength, deviations 1, correlation r: by symmetry half each, for every r
  for (const double r : {-0.5, 0.0, 0.8}) {
    LifeResponse response = straight(-1, 0, 1);
    response.planned = {{5, 5, 5}};
    response.knowledge.covariance.setZero();
    response.knowledge.covariance(friction, friction) = response.knowledge.covariance(strength, strength) = 1;
    response.knowledge.covariance(friction, strength) = response.knowledge.covariance(strength, friction) = r;
    CAPTURE(r);
    const FirstFailures lives = summary_of({response}, "job");
    CHECK(lives.share[friction] == Approx(0.5).margin(0.04));
    CHECK(sum(lives.share) == Approx(1).margin(1e-12));
    CHECK(std::log10(lives.percentiles[2] / lives.percentiles[0]) ==
          Approx(2 * decile * std::sqrt(2 + 2 * r)).epsilon(sampling_error));
    // A cause without effect has no share, whatever it correlates with.
    LifeResponse one = straight(-1, 0, 0);
    one.planned = response.planned, one.knowledge = response.knowledge;
    const FirstFailures of_one = summary_of({one}, "job");
    CHECK(of_one.share[friction] == Approx(1));
  }
}

TEST_CASE("shares of two causes that were learned together have the closed form of a straight response") {
  // With a, b and the correlation r: V(1) = (a + b r)^2, V(2) = (b + a r)^2, V(1, 2) = a^2 + b^2 + 2 a b r.
  for (const double r : {-0.6, 0.6, 0.9}) {
    const double a = 1, b = 0.5, of_a = std::pow(a + b * r, 2), of_b = std::pow(b + a * r, 2),
                 both = a * a + b * b + 2 * a * b * r;
    LifeResponse response = straight(-a, 0, b);
    response.planned = {{5, 5, 5}};
    response.knowledge.covariance.setZero();
    response.knowledge.covariance(friction, friction) = response.knowledge.covariance(strength, strength) = 1;
    response.knowledge.covariance(friction, strength) = response.knowledge.covariance(strength, friction) = r;
    CAPTURE(r);
    const auto is_closed_form = Approx((of_a + both - of_b) / (2 * both)).margin(0.03);
    CHECK(summary_of({response}, "job").share[friction] == is_closed_form);
    // Beside a mode of another construction that outlives it and has its own friction.
    LifeResponse longer = straight(-a, 0, b, 25);
    longer.planned = {{25, 25, 25}}, longer.knowledge = response.knowledge, longer.construction = "another";
    CHECK(summary_of({longer, response}, "job").share[friction] == is_closed_form);
    CHECK(summary_of({response, longer}, "job").share[friction] == is_closed_form);
  }
}

TEST_CASE("shares of two causes that were learned together, where the response has a kink") {
  // log10 life = 5 + max(strength, 0) + a friction, deviations 1, correlation r. The positive parts of two standard normal numbers of
  // correlation c have the covariance C(c), and C(c) + a r + a^2 are V(1) at c = r^2 and V(1, 2) at c = 1. V(2) = C(1) + a r + a^2 r^2.
  const double pi = std::acos(-1.0), r = 0.99, a = 0.1;
  const auto covariance = [&](double c) { return (std::sqrt(1 - c * c) + c * (pi - std::acos(c)) - 1) / (2 * pi); };
  const double of_a = covariance(r * r) + a * r + a * a, of_b = covariance(1) + a * r + a * a * r * r,
               both = covariance(1) + a * r + a * a;
  LifeResponse response = straight(-a, 0, 0), longer = straight(0, 0, 0, 25);
  response.planned = {{5, 5, 5}}, longer.planned = {{25, 25, 25}};
  for (std::size_t k = 0; k < response.worst_life.size(); ++k)
    response.worst_life[k] += std::max(0.0, response.strength[k % response.strength.size()]);
  response.knowledge.covariance.setZero();
  response.knowledge.covariance(friction, friction) = response.knowledge.covariance(strength, strength) = 1;
  response.knowledge.covariance(friction, strength) = response.knowledge.covariance(strength, friction) = r;
  longer.knowledge = response.knowledge, longer.construction = "another";  // has its own friction
  double mean = 0;
  constexpr int names = 16;  // 4000 samples have an error of 0.02; the mean of 16 a quarter of it
  for (int k = 0; k < names; ++k) mean += summary_of({longer, response}, std::to_string(k)).share[friction] / names;
  CHECK(mean == Approx((of_a + both - of_b) / (2 * both)).margin(0.01));
}

TEST_CASE("what is known moves nothing, and what is known better moves less") {
  LifeResponse response = straight(0.6, 0, 0);
  response.knowledge.covariance.setZero();
  const FirstFailures by_scatter = summary_of({response}, "job");
  CHECK(by_scatter.share[friction] == 0);
  CHECK(by_scatter.share[uncertain_count] == Approx(1));
  CHECK(std::log10(by_scatter.percentiles[0]) == Approx(4.9).margin(0.002));
  CHECK_FALSE(by_scatter.best_test);
  response.knowledge.covariance(friction, friction) = 0.25;
  response.knowledge.mean(friction) = 1;
  CHECK(std::log10(summary_of({response}, "job").percentiles[1]) == Approx(4.4).margin(0.01));
}

TEST_CASE("the error of a percentile is that of few samples where the response is straight, and grows where it bends") {
  const double a = 0.6;
  LifeResponse response = straight(a, 0, 0);
  for (const std::size_t p : {strength, model})
    response.knowledge.covariance(static_cast<Eigen::Index>(p), static_cast<Eigen::Index>(p)) = 0;
  response.planned = {{5, 5, 5}};
  constexpr std::size_t samples = 10000;
  const auto errors = [&](const LifeResponse& of) { return summary_of({of}, "job", samples).error_factor; };
  // Error of a quantile q of s normal numbers with deviation a: a sqrt(q (1 - q) / s) / the standard normal's density.
  const LifePercentiles of_samples = errors(response);
  CHECK(std::log10(of_samples[1]) == Approx(a * std::sqrt(std::acos(-1.0) / 2 / samples)).epsilon(0.05));
  const double density = std::exp(-decile * decile / 2) / std::sqrt(2 * std::acos(-1.0));
  CHECK(std::log10(of_samples[0]) == Approx(a * 0.3 / density / std::sqrt(double(samples))).epsilon(0.05));
  // An additional node, whose life is 0.2 decades below the line. Without this node the life there is longer by 0.2.
  const double bend = 0.2, z = 0.75;
  response.points.push_back({});
  response.inside.push_back(Inside::as_is);
  response.points.back()[friction] = z;
  for (std::size_t k = 0; k < response.strength.size(); ++k) response.worst_life.push_back(5 + 0.3 - a * z - bend);
  // 10 % fail first at z = 1.28, between this node and the one at 1.5. The median is at z = 0, where nothing changes.
  const LifePercentiles bent = errors(response);
  const double by_node = bend * (1.5 - decile) / (1.5 - z), slope = a - bend / (1.5 - z);
  const double by_samples = slope * 0.3 / density / std::sqrt(double(samples));
  CHECK(std::log10(bent[0]) == Approx(std::hypot(by_node, by_samples)).epsilon(0.02));
  CHECK(std::log10(bent[1]) < 2 * std::log10(of_samples[1]));
}

/// Returns the response with the points at which `keeps` is true.
template <class Keeps>
LifeResponse with_points(LifeResponse response, const Keeps& keeps) {
  const LifeResponse all = response;
  response.points.clear(), response.inside.clear(), response.worst_life.clear();
  for (std::size_t k = 0; k < all.worst_life.size(); ++k) {
    const std::size_t point = k / all.strength.size();
    if (!keeps(all.points[point])) continue;
    if (k % all.strength.size() == 0)
      response.points.push_back(all.points[point]), response.inside.push_back(all.inside[point]);
    response.worst_life.push_back(all.worst_life[k]);
  }
  return response;
}

TEST_CASE("the residual of the response is an error of computed lives and widens the samples of each dresspack") {
  const double b = 0.6;  // log10 life = 5 - b slack, from nodes at 0 and +-1.5
  LifeResponse response = with_points(straight(0, b, 0), [](const auto& point) { return point[friction] == 0; });
  response.planned = {{5, 5, 5}};
  response.knowledge.covariance.setZero();
  response.knowledge.covariance(slack, slack) = 1;
  constexpr std::size_t samples = 10000;
  const FirstFailures summary = summary_of({response}, "job", samples);
  const LifePercentiles &percentiles = summary.percentiles, &error = summary.error_factor;
  // The samples are normal with the variance of both.
  CHECK(std::log10(percentiles[0]) == Approx(5 - decile * std::hypot(b, residual_decades)).margin(sampling_error));
  CHECK(std::log10(percentiles[2]) == Approx(5 + decile * std::hypot(b, residual_decades)).margin(sampling_error));
  // Three places each have a share of the residual. The shares add up to at most 1.
  for (const double factor : error) {
    CHECK(std::log10(factor) > residual_decades / 2);
    CHECK(std::log10(factor) < residual_decades);
  }
  response.residual_spread = 0.25;  // a calibration's factor of the residual
  const LifePercentiles narrow = summary_of({response}, "job", samples).percentiles;
  const double spread = std::hypot(b, 0.25 * residual_decades);
  CHECK(std::log10(narrow[0]) == Approx(5 - decile * spread).margin(sampling_error));
  CHECK(std::log10(narrow[2]) == Approx(5 + decile * spread).margin(sampling_error));
  CHECK(residual_of({response}) == Approx(0.25 * residual_decades));
}

TEST_CASE("the best test is that of the cause that spreads most, and its range is that of what is left") {
  const double a = 0.8, c = 0.4, by_scatter = 0.1 / decile;
  const FirstFailures lives = summary_of({straight(a, 0, c)}, "job");
  REQUIRE(lives.best_test == friction);
  const UncertainParameter& of = uncertain_parameters()[friction];
  const double error = of.test_deviation / of.deviation(), left = error * error / (1 + error * error);
  const double deviation = std::sqrt(a * a * left + c * c + model_decades * model_decades + by_scatter * by_scatter);
  CHECK(std::log10(lives.after_test[0]) == Approx(5 - decile * deviation).margin(sampling_error));
  CHECK(std::log10(lives.after_test[2]) == Approx(5 + decile * deviation).margin(sampling_error));
}

TEST_CASE("the first failure of two modes that share nothing is the lesser of two lives") {
  LifeResponse one = straight(0.6, 0, 0), other = straight(0.6, 0, 0, 5.3);
  for (LifeResponse* mode : {&one, &other}) {
    mode->knowledge.covariance(model, model) = 0;
    for (auto& lives : mode->planned) lives[0] = lives[2] = lives[1];
  }
  one.mode = "one", one.construction = "a", other.mode = "other", other.construction = "b";
  const FirstFailures lives = summary_of({one, other}, "job");
  // Both normal, 5 and 5.3 +- 0.6: the first fails first in 64 %, and 1 - (1 - P1)(1 - P2) have failed by t.
  CHECK(lives.first[0] == Approx(normal(0.3 / (0.6 * std::sqrt(2.0)))).margin(sampling_error));
  CHECK(lives.first[0] + lives.first[1] == Approx(1));
  const double at = std::log10(lives.percentiles[0]);
  CHECK(1 - normal(-(at - 5) / 0.6) * normal(-(at - 5.3) / 0.6) == Approx(0.1).margin(0.01));
  CHECK(sum(lives.share) == Approx(1).margin(1e-12));

  other.construction = "a";  // one friction for both: the same mode is always first
  CHECK(summary_of({one, other}, "job").first == std::vector<double>{1, 0});
}

TEST_CASE("bounds: the same samples with nothing and with endless friction inside") {
  LifeResponse response = straight(0.6, 0.2, 0.4);
  for (const Inside inside : {Inside::glued, Inside::free})
    for (const double s : {0.0, -1.5, 1.5}) {
      response.points.push_back({});
      response.points.back()[slack] = s;
      response.inside.push_back(inside);
      for (const double of_strength : response.strength)
        response.worst_life.push_back((inside == Inside::glued ? 3.5 : 8.0) - 0.2 * s + 0.4 * of_strength);
    }
  // The bound's worst wire is not among the wires of the response: its life is 0.2 decades shorter.
  response.bound = {LifeResponse::endless, 3.3, 8.0};
  const FirstFailures lives = summary_of({response}, "job");
  const double deviation = std::sqrt(0.2 * 0.2 + 0.4 * 0.4 + model_decades * model_decades + std::pow(0.1 / decile, 2) +
                                     residual_decades * residual_decades);
  // P is 0.3 below W
  CHECK(std::log10(lives.glued[0]) == Approx(3.0 - decile * deviation).margin(sampling_error));
  CHECK(std::log10(lives.free[1]) == Approx(7.7).margin(sampling_error));
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(lives.glued[i] < lives.percentiles[i]);
    CHECK(lives.percentiles[i] < lives.free[i]);
  }
  response.points.resize(9), response.inside.resize(9), response.worst_life.resize(27);
  // Bounds that are known only at z = 0 are the job's own lives without their friction, shifted.
  CHECK(std::log10(summary_of({response}, "job").glued[1]) == Approx(3.0).margin(sampling_error));
}

TEST_CASE("what was learned together stays together") {
  // Only the sum of friction and strength is known. A life that depends on the sum is certain. In a life that depends on
  // their difference both deviations add.
  LifeResponse sum = straight(-0.3, 0, 0.3), difference = straight(0.3, 0, 0.3);
  for (LifeResponse* response : {&sum, &difference}) {
    response->knowledge.covariance.setZero();
    response->knowledge.covariance(friction, friction) = response->knowledge.covariance(strength, strength) = 1;
    response->knowledge.covariance(friction, strength) = response->knowledge.covariance(strength, friction) = -1;
    response->planned = {{5, 5, 5}};
  }
  const FirstFailures known = summary_of({sum}, "job"), wide = summary_of({difference}, "job");
  CHECK(std::log10(known.percentiles[2] / known.percentiles[0]) == Approx(0).margin(1e-6));
  CHECK(std::log10(wide.percentiles[2] / wide.percentiles[0]) == Approx(2 * 0.6 * decile).epsilon(0.01));
}

TEST_CASE("the order of two jobs: what they share cancels, what each has for itself does not") {
  LifeResponse longer = straight(0.6, 0, 0.4), shorter = longer;
  for (auto& lives : longer.planned)
    for (double& life : lives) life += 0.2;
  for (LifeResponse* response : {&longer, &shorter})
    for (auto& lives : response->planned) lives[0] = lives[2] = lives[1];
  CHECK(share_outliving(first_failures({longer}, "one"), first_failures({shorter}, "other")) == 1);
  shorter.construction = longer.construction = "";
  shorter.material = "aluminium";  // strength is sampled independently for each material
  CHECK(share_outliving(first_failures({longer}, "one"), first_failures({shorter}, "other")) ==
        Approx(normal(0.2 / (0.4 * std::sqrt(2.0)))).margin(sampling_error));
  LifeResponse first = straight(0, 0.3, 0), second = first;  // slack is independent for each installation
  for (LifeResponse* response : {&first, &second}) response->planned = {{5, 5, 5}};
  CHECK(share_outliving(first_failures({first}, "one"), first_failures({second}, "other")) ==
        Approx(0.5).margin(sampling_error));
}

TEST_CASE("what is installed apart is sampled apart, also when it was learned together with what is shared") {
  LifeResponse first = straight(0, 0.3, 0), second = straight(0, 0, 0.3);
  for (LifeResponse* response : {&first, &second}) {
    response->planned = {{5, 5, 5}};
    response->knowledge.covariance(slack, strength) = response->knowledge.covariance(strength, slack) = 0.9;
    response->knowledge.covariance(model, model) = 0;
  }
  const std::vector<double> once = first_failures({second}, "one"), again = first_failures({second}, "other");
  CHECK(once == again);  // strength is equal in all jobs
  CHECK(first_failures({first}, "one") != first_failures({first}, "other"));
}

TEST_CASE("what is never damaged lives without end in every sample") {
  LifeResponse response = straight(0.6, 0, 0);
  response.planned = {{LifeResponse::undamaged, LifeResponse::undamaged, LifeResponse::undamaged}};
  for (double& life : response.worst_life) life = LifeResponse::undamaged;
  const FirstFailures lives = summary_of({response}, "job");
  CHECK(std::isinf(lives.percentiles[0]));
  CHECK(sum(lives.share) == 0);
  CHECK(share_words(lives.share).empty());
  CHECK(lives.first == std::vector<double>{0});
  CHECK_FALSE(lives.best_test);
}

TEST_CASE("few samples and many agree, and the same names give the same samples") {
  const FailureModes modes{straight(0.6, 0.2, 0.4)};
  CHECK(first_failures(modes, "a") == first_failures(modes, "a"));
  const double many = std::log10(summary_of(modes, "a").percentiles[0]);
  CHECK(std::log10(summary_of(modes, "a", 2000).percentiles[0]) == Approx(many).margin(0.05));
}

TEST_CASE("modes and their text lead to each other, also from a response alone, no other text is one") {
  LifeResponse one = straight(0.6, 0.2, 0.4), other = straight(0.1, 0.2, 0.4);
  one.mode = "wires of signal cable", other.mode = "wires of power cable", other.scatter_shared = 0.5;
  other.residual_spread = 0.25;
  other.inside[4] = Inside::glued;
  const FailureModes again = modes_from_text(modes_text({one, other, one}));
  REQUIRE(again.size() == 3);
  CHECK(again[0].mode == one.mode);
  CHECK(again[1].scatter_shared == 0.5);
  CHECK(again[0].residual_spread == 1);
  CHECK(again[1].residual_spread == 0.25);
  CHECK(again[1].inside[4] == Inside::glued);
  CHECK(modes_text(again) == modes_text({one, other, one}));
  CHECK(modes_from_text(one.text()).size() == 1);
  CHECK_THROWS_AS(modes_from_text(""), std::exception);
  CHECK_THROWS_AS(modes_from_text(one.text() + "mode second\n"), std::exception);
}

TEST_CASE("unvalidated modes are read as written") {
  UnvalidatedMode kink;
  kink.mode = UnvalidatedMode::kink, kink.hours = {1, 2, 3}, kink.first_share = 0.1, kink.together_p10 = 4,
  kink.place = "hose 5";
  kink.found_share = 0.2, kink.unseen_share = 0.3, kink.visible_from = 0.5, kink.margin = 1.5;
  CHECK(unvalidated_from(unvalidated_text({kink})) == std::vector{kink});
}

TEST_CASE("percentiles are straight between the middles of samples, shares of outliving count pairs") {
  std::vector<double> lives;
  for (int k = 19; k >= 0; --k) lives.push_back(k / 10.0);
  const LifePercentiles of =
      percentiles_of(lives);  // of 20 samples, 7.5 and 12.5 % are below the middles of the second and third
  CHECK(std::log10(of[0]) == Approx(0.15));
  CHECK(std::log10(of[1]) == Approx(0.95));
  CHECK(std::log10(of[2]) == Approx(1.75));
  for (std::size_t k = 0; k < 5; ++k) lives[k] = std::numeric_limits<double>::infinity();
  CHECK(percentiles_of(lives)[1] == Approx(of[1]));
  CHECK(std::isinf(percentiles_of(lives)[2]));
  CHECK(percentiles_of({3})[0] == Approx(1000));
  CHECK(share_outliving({1, 2, 3, 4, 5}, {2, 2, 1, 1, 1}) == 0.7);
  CHECK(share_outliving({2, 2, 1, 1, 1}, {1, 2, 3, 4, 5}) == Approx(0.3));
}

TEST_CASE("two modes of one dresspack share the part of their scatter that is given") {
  for (const double shared : {1.0, 0.5, 0.0}) {
    LifeResponse one = straight(0, 0, 0), other = one;
    for (LifeResponse* mode : {&one, &other}) mode->knowledge.covariance.setZero(), mode->scatter_shared = shared;
    one.mode = "one", other.mode = "other";
    // Share of samples in which both of two normal lives with this correlation are above their median.
    const double both = 0.25 + std::asin(shared) / (2 * std::acos(-1.0));
    const std::vector<double> lives = first_failures({one, other}, "job");
    const auto above = std::count_if(lives.begin(), lives.end(), [](double life) { return life > 5; });
    CHECK(double(above) / double(lives.size()) == Approx(both).margin(sampling_error));
    const LifePercentiles alone = percentiles_of(first_failures({one}, "job"));
    CHECK(std::log10(alone[0]) == Approx(4.9).margin(sampling_error * 0.1));
    CHECK(std::log10(alone[2]) == Approx(5.1).margin(sampling_error * 0.1));
  }
}

TEST_CASE("shares as words are whole per cents that add up to 100") {
  CauseShares share{};
  share[friction] = 0.407, share[strength] = 0.294, share[model] = 0.292, share[slack] = 0.007;
  CHECK(share_words(share) == "friction_inside 41 %; strength 29 %; model 29 %; other 1 %");
  share = {};
  share[friction] = 0.3349, share[strength] = 0.3331, share[model] = 0.332;
  CHECK(share_words(share) == "friction_inside 34 %; strength 33 %; model 33 %");
  CHECK(largest_share(share) == friction);
  share = {};
  share[slack] = share[friction] = share[strength] = share[model] =
      0.25;  // equal shares are in the order of the parameters
  CHECK(share_words(share) == "friction_inside 25 %; slack 25 %; strength 25 %; model 25 %");
  share = {};
  share[slack] = 0.01, share[uncertain_count] = 0.99;
  CHECK(share_words(share) == "scatter of wires 99 %; slack 1 %");
  share = {};
  share[uncertain_count] = 0.9, share[uncertain_count + 1] = 0.1;
  CHECK(share_words(share) == "scatter of wires 90 %; numerical error 10 %");
  share = {};
  share[friction] = 0.816, share[strength] = 0.204, share[model] = -0.02;
  CHECK(share_words(share) == "friction_inside 80 %; strength 20 %");
}

TEST_CASE("lives of many programs with common samples are those of each program alone") {
  std::vector<FailureModes> programs;
  for (const double b : {0.0, 0.2, 0.5}) programs.push_back({straight(0.6, b, 0.4), straight(0.1, b, 0.3, 6)});
  programs[1][0].mode = "another", programs[1][0].scatter_shared = programs[2][0].scatter_shared = 0.5;
  programs[2][1].construction = "other hose";
  programs[2][0].knowledge.mean(strength) = 1;
  programs.push_back(programs[0]);
  programs[3][1].knowledge.covariance(friction, friction) = 0.25;
  programs.push_back(programs[0]);
  programs[4][0].material = "aluminium", programs[4][1].dresspack = "second";
  constexpr std::size_t count = 200;
  ModeLives lives("plant", count);
  for (const FailureModes& modes : programs) CHECK(lives.of(PreparedModes(modes)) == mode_lives(modes, "plant", count));
  for (const FailureModes& modes : programs) CHECK(lives.of(PreparedModes(modes)) == mode_lives(modes, "plant", count));
}

TEST_CASE("samples have the means and covariances that were learned, of any parameters together") {
  LifeResponse response = straight(0.6, 0.2, 0.4);
  std::mt19937 random(8);
  std::normal_distribution<double> normal;
  const auto n = static_cast<Eigen::Index>(uncertain_count);
  Eigen::MatrixXd root(n, n);
  for (Eigen::Index a = 0; a < n; ++a)
    for (Eigen::Index b = 0; b < n; ++b) root(a, b) = normal(random);
  response.knowledge.covariance = root * root.transpose();
  for (Eigen::Index a = 0; a < n; ++a) response.knowledge.mean[a] = normal(random);
  constexpr std::size_t count = 20000;
  std::vector<std::vector<double>> samples;
  std::vector<Eigen::Index> of;
  for (std::size_t p = 0; p < uncertain_count; ++p)
    if (uncertain_parameters()[p].shared != SharedBy::installation)
      samples.push_back(shared_samples(response, p, count)), of.push_back(static_cast<Eigen::Index>(p));
  REQUIRE(of.size() == 8);
  const Eigen::MatrixXd& covariance = response.knowledge.covariance;
  for (std::size_t a = 0; a < of.size(); ++a) {
    constexpr double strata = 1e-9;  // each stream has a mean of 0
    const double mean = std::accumulate(samples[a].begin(), samples[a].end(), 0.0) / double(count);
    CHECK(mean == Approx(response.knowledge.mean[of[a]]).margin(strata));
    for (std::size_t b = 0; b <= a; ++b) {
      double sum = 0;
      for (std::size_t s = 0; s < count; ++s)
        sum += (samples[a][s] - response.knowledge.mean[of[a]]) * (samples[b][s] - response.knowledge.mean[of[b]]);
      const double expected = covariance(of[a], of[b]), variances = covariance(of[a], of[a]) * covariance(of[b], of[b]);
      // five standard deviations of the covariance of so many samples
      CHECK(sum / double(count) ==
            Approx(expected).margin(5 * std::sqrt((variances + expected * expected) / double(count))));
    }
  }
}

TEST_CASE("only a wall that contradicts the published test and would fail within a robot's time is not credible") {
  for (const double bends : {0.0, 1.0, 0.99 * published_wall_bends, published_wall_bends, 2 * published_wall_bends})
    for (const double hours : {9.9e4, 1e5, 1e9}) {
      UnvalidatedMode mode;
      mode.bends_at_limit = bends, mode.hours = {hours, 2 * hours, 3 * hours};
      CAPTURE(bends, hours);
      CHECK(is_credible(mode) == !(bends > 0 && bends < published_wall_bends && hours < 1e5));
    }
}

TEST_CASE(
    "lives have the residual of computed places if any other place of the cables has other lives, longer or shorter") {
  for (const double decades : {-0.5, 0.0, 0.5}) {
    LifeResponse response = straight(0.6, 0, 0);
    response.points.push_back({}), response.points.back()[slack] = 1.5;
    response.inside.push_back(Inside::as_is);
    response.worst_life.insert(response.worst_life.end(), 3, 5.3 + decades);
    CHECK(residual_of({response}) == (decades == 0 ? 0 : residual_decades));
  }
}
