#include "pipeline/life/life_response.h"

#include <cmath>
#include <iterator>
#include <sstream>
#include <stdexcept>

#include "tests/catch.h"

using namespace dresslife::pipeline;

namespace {

constexpr double rounding = 1e-12;
constexpr std::size_t friction = index_of(Uncertain::friction_inside), slack = index_of(Uncertain::slack),
                      strength = index_of(Uncertain::strength), scatter = index_of(Uncertain::scatter),
                      model = index_of(Uncertain::model);
const double model_decades = uncertain_parameters()[model].deviation() / std::log(10.0);

/// log10 life 5 +- 0.1 (10 and 90 %) by scatter, -a friction - b slack + c strength, all straight.
LifeResponse straight(double a, double b, double c) {
  LifeResponse response;
  response.construction = "hose", response.material = "copper";
  response.knowledge = prior_of({});
  response.planned = {{4.9, 5, 5.1}};
  response.points.clear(), response.inside.clear(), response.worst_life.clear();
  response.strength = {-2, 0, 2};
  for (const double f : {0.0, -1.5, 1.5})
    for (const double s : {0.0, -1.5, 1.5}) {
      response.points.push_back({});
      response.inside.push_back(Inside::as_is);
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

TEST_CASE("each side of the median has the spread of its own percentile") {
  LifeResponse response = straight(0, 0, 0);
  response.planned = {{2, 3, 3.4}};
  for (const auto& [tenths, life] : {std::pair{-1, 2.0}, std::pair{0, 3.0}, std::pair{1, 3.4}})
    CHECK(response.log10_life({}, tenths * 1.2815515655446004) == Approx(life));
}

TEST_CASE("a parameter by itself adds to the crossed ones, whatever they are") {
  LifeResponse response = straight(0.6, 0.2, 0);
  response.points.push_back({}), response.points.back()[index_of(Uncertain::play)] = 1.5;
  response.inside.push_back(Inside::as_is);
  response.worst_life.insert(response.worst_life.end(), 3, 5.3 + 0.3);
  ParameterPoint z = at(friction, 1);
  z[slack] = -1, z[index_of(Uncertain::play)] = 0.5;
  CHECK(response.change(z) == Approx(-0.6 + 0.2 + 0.1));
}

TEST_CASE("what is never damaged lives without end, whatever the model's factor is") {
  LifeResponse response = straight(0.6, 0, 0);
  response.planned = {{LifeResponse::endless, LifeResponse::endless, LifeResponse::endless}};
  for (double& life : response.worst_life) life = LifeResponse::endless;
  CHECK(std::isinf(response.log10_life({}, -2)));
  CHECK(std::isinf(response.log10_life(at(model, -2), -2)));
}

TEST_CASE("beyond the rests of all starts a life is that of the last one") {
  constexpr std::size_t rest = index_of(Uncertain::rest);
  LifeResponse response = straight(0.6, 0.2, 0);
  for (const auto& [z, life] : {std::pair(-0.7, 4.3), {0.9, 6.3}}) {
    response.points.push_back({}), response.points.back()[rest] = z;
    response.inside.push_back(Inside::as_is);
    response.worst_life.insert(response.worst_life.end(), 3, life);
  }
  for (const auto& [z, change] :
       {std::pair(-3.0, -1.0), {-0.7, -1.0}, {-0.35, -0.5}, {0.0, 0.0}, {0.9, 1.0}, {3.0, 1.0}})
    CHECK(response.change(at(rest, z)) == Approx(change).margin(rounding));
}

TEST_CASE("a text from before there were rests is read: the same lives") {
  const LifeResponse response = straight(0.6, 0.2, 0.4);
  std::istringstream lines(response.text());
  constexpr std::size_t rest = index_of(Uncertain::rest);
  std::string older;
  std::size_t row = 0;  // of the covariance
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::vector<std::string> all{std::istream_iterator<std::string>(words), {}};
    if (all[0] == "covariance" && row++ == rest) continue;
    if (all[0] == "mean" || all[0] == "covariance" || all[0] == "point")
      all.erase(all.begin() + static_cast<std::ptrdiff_t>(1 + rest));
    for (const std::string& word : all) older += word + " ";
    older += "\n";
  }
  REQUIRE(older.find("point 0 0 -1.5 0 0 \n") != std::string::npos);
  const LifeResponse read = LifeResponse::from_text(older);
  for (const std::size_t parameter : {friction, slack, strength, model})
    CHECK(read.change(at(parameter, 0.8)) ==
          Approx(response.change(at(parameter, 0.8))).margin(1e-5));  // six digits
  CHECK(read.knowledge.covariance(rest + 1, rest + 1) == 1);
  CHECK(read.knowledge.covariance(rest, rest) == 0);
}

TEST_CASE("a response and its text lead to each other, no other text is one") {
  const LifeResponse response = straight(0.6, 0.2, 0.4);
  const LifeResponse again = LifeResponse::from_text(response.text());
  CHECK(again.text() == response.text());
  CHECK(again.log10_life(at(friction, 0.7), 0.3) ==
        Approx(response.log10_life(at(friction, 0.7), 0.3)).margin(1e-4));  // six digits each
  CHECK(again.construction == "hose");
  const std::string text = response.text();
  for (const std::string& wrong :
       {std::string("nothing"), text.substr(0, text.size() - 8), text + "strength 3 2 1\n", text + "mean x\n",
        text + "point 1\n", std::string()})
    CHECK_THROWS_AS(LifeResponse::from_text(wrong), std::exception);
}
