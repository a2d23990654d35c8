#include "pipeline/life/life_response.h"

#include <cmath>
#include <numeric>
#include <stdexcept>

#include "tests/catch.h"

using namespace dresslife::pipeline;

namespace {

constexpr double rounding = 1e-12;
constexpr std::size_t friction = index_of(Uncertain::friction_inside), slack = index_of(Uncertain::slack),
                      strength = index_of(Uncertain::strength), scatter = index_of(Uncertain::scatter),
                      model = index_of(Uncertain::model);
// Of a percentile's place among 10,000 draws that are spread evenly over each cause: measured 0.004 at worst
// over 20 names.
constexpr double draws_error = 0.02;
const double model_decades = uncertain_parameters()[model].deviation / std::log(10.0);

double normal(double z) { return std::erfc(-z / std::sqrt(2.0)) / 2; }

/// log10 life 5 +- 0.1 (10 and 90 %) by scatter, -a friction - b slack + c strength, all straight.
LifeResponse straight(double a, double b, double c) {
  LifeResponse response;
  response.construction = "hose", response.material = "copper";
  response.knowledge = prior_of({});
  response.planned = {{4.9, 5, 5.1}};
  response.points.clear(), response.worst_life.clear();
  response.strength = {-2, 0, 2};
  for (const double f : {0.0, -1.5, 1.5})
    for (const double s : {0.0, -1.5, 1.5}) {
      response.points.push_back({});
      response.points.back()[friction] = f, response.points.back()[slack] = s;
      for (const double of_strength : response.strength)
        response.worst_life.push_back(5.3 - a * f - b * s + c * of_strength);
    }
  return response;
}

ParameterPoint at(std::size_t parameter, double z) {
  ParameterPoint point{};
  point[parameter] = z;
  return point;
}

}  // namespace

TEST_CASE("a straight response is straight between its points and beyond them") {
  const LifeResponse response = straight(0.6, 0.2, 0.4);
  for (const double z : {-2.5, -1.5, -0.4, 0.0, 0.9, 3.0}) {
    CHECK(response.change(at(friction, z)) == Approx(-0.6 * z).margin(rounding));
    CHECK(response.change(at(slack, z)) == Approx(-0.2 * z).margin(rounding));
    CHECK(response.change(at(strength, z)) == Approx(0.4 * z).margin(rounding));
    CHECK(response.change(at(model, z)) == Approx(model_decades * z).margin(rounding));
    CHECK(response.change(at(scatter, z)) == 0);
  }
  CHECK(response.log10_life(at(friction, 1), 0) == Approx(4.4));
  CHECK(response.log10_life({}, 1.2815515655446004) == Approx(5.1));
}

TEST_CASE("a parameter by itself adds to the crossed ones, whatever they are") {
  LifeResponse response = straight(0.6, 0.2, 0);
  response.points.push_back({}), response.points.back()[index_of(Uncertain::play)] = 1.5;
  response.worst_life.insert(response.worst_life.end(), 3, 5.3 + 0.3);
  ParameterPoint z = at(friction, 1);
  z[slack] = -1, z[index_of(Uncertain::play)] = 0.5;
  CHECK(response.change(z) == Approx(-0.6 + 0.2 + 0.1));
}

TEST_CASE("drawn lives of a straight response: normal, with the sum of the variances, and each its share") {
  const double a = 0.6, b = 0.2, c = 0.4, by_scatter = 0.1 / 1.2815515655446004;
  const DrawnLives drawn = drawn_lives(straight(a, b, c), "job");
  const double variance = a * a + b * b + c * c + model_decades * model_decades + by_scatter * by_scatter;
  const double deviation = std::sqrt(variance);
  for (const auto& [k, z] :
       {std::pair{0, -1.2815515655446004}, std::pair{1, 0.0}, std::pair{2, 1.2815515655446004}})
    CHECK(std::log10(drawn.percentiles[k]) == Approx(5 + deviation * z).margin(draws_error * deviation));
  constexpr double share_error = 0.02;  // 25 groups cut the outermost tails off
  CHECK(drawn.share[friction] == Approx(a * a / variance).margin(share_error));
  CHECK(drawn.share[strength] == Approx(c * c / variance).margin(share_error));
  CHECK(drawn.share[uncertain_count] == Approx(by_scatter * by_scatter / variance).margin(share_error));
  CHECK(drawn.share[scatter] < share_error);
  CHECK(largest_share(drawn.share) == friction);
  CHECK(share_words(drawn.share).starts_with("friction_inside "));
}

TEST_CASE("what is known moves nothing, and what is known better moves less") {
  LifeResponse response = straight(0.6, 0, 0);
  response.knowledge.covariance.setZero();
  const DrawnLives by_scatter = drawn_lives(response, "job");
  CHECK(by_scatter.share[friction] == 0);
  CHECK(by_scatter.share[uncertain_count] == Approx(1).margin(0.02));
  CHECK(std::log10(by_scatter.percentiles[0]) == Approx(4.9).margin(0.002));
  response.knowledge.covariance(friction, friction) = 0.25;
  response.knowledge.mean(friction) = 1;
  CHECK(std::log10(drawn_lives(response, "job").percentiles[1]) == Approx(4.4).margin(0.01));
}

TEST_CASE("what was learned together stays together") {
  // friction and strength known by their sum alone: a life that hangs on the sum is known, on the difference
  // twice as little
  LifeResponse sum = straight(-0.3, 0, 0.3), difference = straight(0.3, 0, 0.3);
  for (LifeResponse* response : {&sum, &difference}) {
    response->knowledge.covariance.setZero();
    response->knowledge.covariance(friction, friction) = response->knowledge.covariance(strength, strength) =
        1;
    response->knowledge.covariance(friction, strength) = response->knowledge.covariance(strength, friction) =
        -1;
    response->planned = {{5, 5, 5}};
  }
  const DrawnLives known = drawn_lives(sum, "job"), wide = drawn_lives(difference, "job");
  CHECK(std::log10(known.percentiles[2] / known.percentiles[0]) == Approx(0).margin(1e-6));
  CHECK(std::log10(wide.percentiles[2] / wide.percentiles[0]) ==
        Approx(2 * 0.6 * 1.2815515655446004).epsilon(0.01));
}

TEST_CASE("the order of two jobs: what they share cancels, what each has for itself does not") {
  LifeResponse longer = straight(0.6, 0, 0.4), shorter = longer;
  for (auto& lives : longer.planned)
    for (double& life : lives) life += 0.2;
  for (LifeResponse* response : {&longer, &shorter})
    for (auto& lives : response->planned) lives[0] = lives[2] = lives[1];
  CHECK(share_outliving(draw_lives(longer, "one"), draw_lives(shorter, "other")) == 1);
  shorter.construction = longer.construction = "";
  shorter.material = "aluminium";  // strength is drawn for each by itself
  CHECK(share_outliving(draw_lives(longer, "one"), draw_lives(shorter, "other")) ==
        Approx(normal(0.2 / (0.4 * std::sqrt(2.0)))).margin(draws_error));
  LifeResponse first = straight(0, 0.3, 0), second = first;  // slack is each installation's own
  for (LifeResponse* response : {&first, &second}) response->planned = {{5, 5, 5}};
  CHECK(share_outliving(draw_lives(first, "one"), draw_lives(second, "other")) ==
        Approx(0.5).margin(draws_error));
}

TEST_CASE("what is installed apart is drawn apart, also when it was learned together with what is shared") {
  LifeResponse first = straight(0, 0.3, 0), second = straight(0, 0, 0.3);
  for (LifeResponse* response : {&first, &second}) {
    response->planned = {{5, 5, 5}};
    response->knowledge.covariance(slack, strength) = response->knowledge.covariance(strength, slack) = 0.9;
    response->knowledge.covariance(model, model) = 0;
  }
  const std::vector<double> once = draw_lives(second, "one"), again = draw_lives(second, "other");
  CHECK(once == again);  // strength is the same in all jobs
  CHECK(draw_lives(first, "one") != draw_lives(first, "other"));
}

TEST_CASE("lives without end: told as such, and no number between") {
  LifeResponse response = straight(0.6, 0, 0);
  response.planned = {{LifeResponse::endless, LifeResponse::endless, LifeResponse::endless}};
  for (double& life : response.worst_life) life = LifeResponse::endless;
  CHECK(std::isinf(response.log10_life({}, -2)));
  const DrawnLives drawn = drawn_lives(response, "job");
  CHECK(std::isinf(drawn.percentiles[1]));
  CHECK(std::isfinite(drawn.percentiles[0]));  // the model's own may be that wrong
}

TEST_CASE("a response and its text lead to each other; no other text is one") {
  const LifeResponse response = straight(0.6, 0.2, 0.4);
  const LifeResponse again = LifeResponse::from_text(response.text());
  CHECK(again.text() == response.text());
  const std::vector<double> drawn = draw_lives(response, "job", 100),
                            drawn_again = draw_lives(again, "job", 100);
  for (std::size_t d = 0; d < drawn.size(); ++d)
    CHECK(drawn_again[d] == Approx(drawn[d]).margin(1e-4));  // six digits each
  CHECK(again.construction == "hose");
  const std::string text = response.text();
  for (const std::string& wrong :
       {std::string("nothing"), text.substr(0, text.size() - 8), text + "strength 3 2 1\n", text + "mean x\n",
        text + "point 1\n", std::string()})
    CHECK_THROWS_AS(LifeResponse::from_text(wrong), std::exception);
}

TEST_CASE("few draws and many agree, and the same names give the same draws") {
  const LifeResponse response = straight(0.6, 0.2, 0.4);
  CHECK(drawn_lives(response, "a").log10_life == drawn_lives(response, "a").log10_life);
  const double many = std::log10(drawn_lives(response, "a").percentiles[0]);
  CHECK(std::log10(drawn_lives(response, "a", 2000).percentiles[0]) == Approx(many).margin(0.05));
}
