#include "pipeline/life/life_response.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <stdexcept>

#include "tests/catch.h"
#include "tests/pipeline/life/straight_response.h"

using namespace dresslife::pipeline;

namespace {

constexpr double rounding = 1e-12;
constexpr std::size_t friction = index_of(Uncertain::friction_inside), slack = index_of(Uncertain::slack),
                      strength = index_of(Uncertain::strength), scatter = index_of(Uncertain::scatter),
                      model = index_of(Uncertain::model);
const double model_decades = uncertain_parameters()[model].deviation() / std::log(10.0);

ParameterPoint at(std::size_t parameter, double z) {
  ParameterPoint point{};
  point[parameter] = z;
  return point;
}

}  // namespace

TEST_CASE("a straight response is straight between its points and beyond them") {
  const LifeResponse response = straight_response(0.6, 0.2, 0.4);
  for (const double z : {-2.5, -1.5, -0.4, 0.0, 0.9, 3.0}) {
    CHECK(LifeSurface(response).change(at(friction, z)) == Approx(-0.6 * z).margin(rounding));
    CHECK(LifeSurface(response).change(at(slack, z)) == Approx(-0.2 * z).margin(rounding));
    CHECK(LifeSurface(response).change(at(strength, z)) == Approx(0.4 * z).margin(rounding));
    CHECK(LifeSurface(response).change(at(model, z)) == Approx(model_decades * z).margin(rounding));
    CHECK(LifeSurface(response).change(at(scatter, z)) == 0);
  }
  CHECK(LifeSurface(response).log10_life(at(friction, 1), 0) == Approx(4.4));
  CHECK(LifeSurface(response).log10_life({}, 1.2815515655446004) == Approx(5.1));
}

TEST_CASE("each side of the median has the spread of its own percentile") {
  LifeResponse response = straight_response(0, 0, 0);
  response.planned = {{2, 3, 3.4}};
  for (const auto& [tenths, life] : {std::pair{-1, 2.0}, std::pair{0, 3.0}, std::pair{1, 3.4}})
    CHECK(LifeSurface(response).log10_life({}, tenths * 1.2815515655446004) == Approx(life));
}

TEST_CASE("one cause changes a life as it does by itself, and the order of causes does not matter") {
  for (const double life : {-1.0, 4.0, 9.0, 25.0}) {
    CHECK(together(9, std::array{life}) == life);
    CHECK(together(9, std::array{9.0, life, 9.0}) == life);
  }
  CHECK(together(9, {}) == 9);
  CHECK(together(9, std::array{7.0, 12.0, 8.5}) == Approx(together(9, std::array{8.5, 7.0, 12.0})));
  // Lengthening causes are factors of the strain: their decades add. Equal shortening causes add equal strains.
  CHECK(together(9, std::array{10.0, 12.0}) == Approx(13));
  const double threefold = 5 * std::log10(3.0), twofold = 5 * std::log10(2.0);
  CHECK(together(9, std::array{9 - twofold, 9 - twofold}) == Approx(9 - threefold));
}

TEST_CASE("how long a life without end is decides nothing about lives that causes shorten") {
  // 1e-5 and 10^-4.2 are the strains of the lives 1e25 and 1e21, relative to 1 at a life of 1e0.
  for (const double shorter : {3.0, 6.0, 9.0})
    for (const double other : {6.0, 9.0, 12.0}) {
      const double from_far = together(25, std::array{shorter, other}),
                   from_near = together(21, std::array{shorter, other});
      const double strain = std::pow(10, -shorter / 5) + std::pow(10, -other / 5);
      CHECK(from_far == Approx(from_near).margin(5 / std::log(10.0) * 1e-4 / strain));
      CHECK(from_far <= std::min(shorter, other));
      CHECK(from_far >=
            std::min(shorter, other) - 5 * std::log10(2.0));  // the sum of two strains is at most twice the larger
    }
}

TEST_CASE("a parameter by itself joins the crossed ones, whatever they are") {
  LifeResponse response = straight_response(0.6, 0.2, 0);
  response.points.push_back({}), response.points.back()[index_of(Uncertain::play)] = 1.5;
  response.inside.push_back(Inside::as_is);
  response.worst_life.insert(response.worst_life.end(), 3, 5.3 + 0.3);
  ParameterPoint z = at(friction, 1);
  z[slack] = -1, z[index_of(Uncertain::play)] = 0.5;
  CHECK(LifeSurface(response).change(z) == Approx(-5 * std::log10(std::pow(10, 0.4 / 5) + std::pow(10, -0.1 / 5) - 1)));
}

namespace {

constexpr std::size_t play = index_of(Uncertain::play), slope = index_of(Uncertain::slope);

/// Random values at every point of a response with unequally spaced nodes on every axis.
struct RandomTable {
  std::mt19937 engine{7};
  std::map<std::size_t, std::vector<double>> nodes{{friction, {-1.5, 0, 1, 2.5}}, {slack, {-2, 0, 1}},
                                                   {play, {0, 0.5, 2}},           {strength, {-2, -0.5, 0, 1}},
                                                   {slope, {-1, 0, 3}},           {scatter, {-1, 0, 0.5}}};
  LifeResponse response = straight_response(0, 0, 0);

  double random() { return std::uniform_real_distribution<double>(4, 6)(engine); }
  void add(Inside inside, double f, double s, double p) {
    response.points.push_back({}), response.inside.push_back(inside);
    response.points.back()[friction] = f, response.points.back()[slack] = s, response.points.back()[play] = p;
  }
  explicit RandomTable(bool crossed = true) {
    response.points.clear(), response.inside.clear(), response.worst_life.clear(), response.planned.clear();
    response.strength = nodes[strength], response.slope = nodes[slope], response.scatter = nodes[scatter];
    add(Inside::as_is, 0, 0, 0);
    for (const double p : {2.0, 0.5}) add(Inside::as_is, 0, 0, p);
    for (const double s : nodes[slack]) add(Inside::glued, 0, s, 0);
    for (const double f : {2.5, 1.0, -1.5, 0.0})
      for (const double s : {1.0, 0.0, -2.0})
        if ((f != 0 || s != 0) && (crossed || f == 0 || s == 0)) add(Inside::as_is, f, s, 0);
    response.worst_life.resize(response.points.size() * 12);
    for (double& life : response.worst_life) life = random();
    response.planned.resize(3);
    for (auto& lives : response.planned) lives = {random() - 3, random(), random() + 3};
    response.bound = {LifeResponse::undamaged, 3.7, 8};
  }
  /// Returns W at nodes.
  double worst(Inside inside, double f, double s, double p, double of_strength, double of_slope) const {
    const auto at = [](const std::vector<double>& list, double z) {
      return std::find(list.begin(), list.end(), z) - list.begin();
    };
    for (std::size_t k = 0; k < response.points.size(); ++k)
      if (response.inside[k] == inside && response.points[k][friction] == f && response.points[k][slack] == s &&
          response.points[k][play] == p)
        return response
            .worst_life[k * 12 + std::size_t(at(response.strength, of_strength) * 3 + at(response.slope, of_slope))];
    throw std::out_of_range("no such point");
  }
  ParameterPoint random_node() {
    ParameterPoint z{};
    for (const auto& [parameter, values] : nodes) z[parameter] = values[engine() % values.size()];
    return z;
  }
};

}  // namespace

TEST_CASE("a response has the values of its table at every combination of nodes") {
  RandomTable table;
  const LifeResponse& of = table.response;
  for (int k = 0; k < 300; ++k) {
    const ParameterPoint z = table.random_node();
    const auto worst = [&](Inside inside, double f, double s, double p) {
      return table.worst(inside, f, s, p, z[strength], z[slope]);
    };
    const double here = worst(Inside::as_is, 0, 0, 0), alone = worst(Inside::as_is, 0, 0, z[play]);
    const double at_zero = table.worst(Inside::as_is, 0, 0, 0, 0, 0),
                 glued_at_zero = table.worst(Inside::glued, 0, 0, 0, 0, 0);
    const auto with_play = [&](double core) { return together(here, std::array{core, alone}) - at_zero; };
    const double change = with_play(worst(Inside::as_is, z[friction], z[slack], 0));
    CHECK(LifeSurface(of).change(z) == Approx(change).margin(rounding));
    CHECK(LifeSurface(of).change(z, Inside::glued) ==
          Approx(with_play(3.7 + worst(Inside::glued, 0, z[slack], 0) - glued_at_zero)).margin(rounding));
    // Without values for no friction, the result is the job's own, shifted.
    CHECK(LifeSurface(of).change(z, Inside::free) ==
          Approx(with_play(8 - at_zero + worst(Inside::as_is, 0, z[slack], 0))).margin(rounding));
    const auto scatter_at = std::size_t(z[scatter] < 0 ? 0 : z[scatter] > 0 ? 2 : 1);
    for (const int tenths : {-1, 0, 1})
      CHECK(LifeSurface(of).log10_life(z, tenths * 1.2815515655446004) ==
            Approx(of.planned[scatter_at][std::size_t(tenths + 1)] + change));
  }
  // Without values for combinations, friction and slack combine like other parameters.
  RandomTable apart(false);
  for (const double f : {-1.5, 1.0})
    for (const double s : {-2.0, 1.0}) {
      ParameterPoint z = at(friction, f);
      z[slack] = s;
      const std::array alone{LifeSurface(apart.response).change(at(friction, f)),
                             LifeSurface(apart.response).change(at(slack, s))};
      CHECK(LifeSurface(apart.response).change(z) == Approx(together(0, alone)).margin(rounding));
    }
}

TEST_CASE("lives at another stiffness of the hose count as computed, and combine there with friction and slack") {
  constexpr std::size_t stiffness = index_of(Uncertain::hose_stiffness);
  RandomTable table;
  LifeResponse& of = table.response;
  std::map<std::array<double, 3>, double> computed;  // (friction, slack, stiffness) W
  const auto add = [&](Inside inside, double f, double s, double k) {
    table.add(inside, f, s, 0);
    of.points.back()[stiffness] = k;
    const double life = table.random();
    of.worst_life.insert(of.worst_life.end(), 12, life);
    return life;
  };
  for (const double k : {-1.65, 1.65}) {
    for (const double f : table.nodes[friction]) computed[{f, 0, k}] = add(Inside::as_is, f, 0, k);
    computed[{0, -2, k}] = add(Inside::as_is, 0, -2, k);
  }
  const double glued = add(Inside::glued, 0, 0, 1.65);
  const auto at_zero = [&](double f, double s) { return table.worst(Inside::as_is, f, s, 0, 0, 0); };
  const auto change = [&](double f, double s, double k, Inside inside = Inside::as_is) {
    ParameterPoint z = at(friction, f);
    z[slack] = s, z[stiffness] = k;
    return LifeSurface(of).change(z, inside);
  };
  const auto is = [&](double life) { return Approx(life - at_zero(0, 0)).margin(rounding); };
  for (const double k : {-1.65, 1.65}) {
    for (const double f : table.nodes[friction]) CHECK(change(f, 0, k) == is(computed[{f, 0, k}]));
    CHECK(change(0, -2, k) == is(computed[{0, -2, k}]));
    // Without values for a combination, friction and slack combine at this stiffness, and slack with stiffness at the job's own.
    const double loose = together(at_zero(0, 0), std::array{at_zero(0, 1), computed[{0, 0, k}]});
    CHECK(change(0, 1, k) == is(loose));
    for (const double f : {-1.5, 1.0, 2.5})
      for (const auto& [s, slack_alone] : {std::pair(-2.0, computed[{0, -2, k}]), {1.0, loose}})
        CHECK(change(f, s, k) == is(together(computed[{0, 0, k}], std::array{slack_alone, computed[{f, 0, k}]})));
  }
  ParameterPoint with_play = at(stiffness, 1.65);
  with_play[play] = 2;
  CHECK(LifeSurface(of).change(with_play) ==
        is(together(at_zero(0, 0), std::array{computed[{0, 0, 1.65}], table.worst(Inside::as_is, 0, 0, 2, 0, 0)})));
  // A bound counts as computed, too. Elsewhere it changes with the stiffness as the job does.
  const double shift = 3.7 - table.worst(Inside::glued, 0, 0, 0, 0, 0);
  CHECK(change(0, 0, 1.65, Inside::glued) == is(glued + shift));
  const double soft = 3.7 + computed[{0, 0, -1.65}] - at_zero(0, 0);
  CHECK(change(0, 0, -1.65, Inside::glued) == is(soft));
  CHECK(change(0, 1, -1.65, Inside::glued) ==
        is(together(3.7, std::array{shift + table.worst(Inside::glued, 0, 1, 0, 0, 0), soft})));
}

TEST_CASE("a response is straight along each axis between neighbouring nodes and beyond the last, as far as 3.5") {
  RandomTable table;
  const LifeResponse& of = table.response;
  for (int k = 0; k < 40; ++k)
    for (const auto& [parameter, values] : table.nodes) {
      ParameterPoint z = table.random_node();
      if (parameter == play)
        z[friction] = z[slack] = 0;  // changes of several parameters combine as strains
      else
        z[play] = 0;
      const auto life = [&, &parameter = parameter](double at) {
        ParameterPoint moved = z;
        moved[parameter] = at;
        return LifeSurface(of).log10_life(moved, 0);
      };
      for (std::size_t node = 0; node + 1 < values.size(); ++node) {
        const double low = values[node], high = values[node + 1];
        CHECK(life(0.75 * low + 0.25 * high) == Approx(0.75 * life(low) + 0.25 * life(high)));
        if (node == 0) CHECK(life(low - 0.3) == Approx(life(low) + 0.3 * (life(low) - life(high)) / (high - low)));
        if (node + 2 == values.size())
          CHECK(life(high + 0.3) == Approx(life(high) + 0.3 * (life(high) - life(low)) / (high - low)));
      }
      if (parameter != scatter) CHECK(life(9) == Approx(life(3.5)));
      if (parameter != scatter) CHECK(life(-9) == Approx(life(-3.5)));
    }
}

TEST_CASE("a response depends on what its table varies over, and on nothing else of the strain and the material") {
  const LifeResponse full = RandomTable().response;
  for (const std::size_t varied : {friction, slack, play, strength, slope, scatter}) {
    LifeResponse response = full;
    for (std::size_t k = 0; k < full.worst_life.size(); ++k) {
      const auto& point = full.points[k / 12];
      ParameterPoint z{};
      std::copy(point.begin(), point.end(), z.begin());
      z[strength] = double(k % 12 / 3), z[slope] = double(k % 3);
      response.worst_life[k] = varied == scatter || full.inside[k / 12] != Inside::as_is ? 5 : 5 + 0.1 * z[varied];
    }
    for (auto& lives : response.planned)
      lives = {4, 5, varied == scatter && &lives == &response.planned[1] ? 6.0 : 5.5};
    const LifeSurface surface(response);
    for (std::size_t p = 0; p < uncertain_count; ++p) {
      CAPTURE(varied, p);
      CHECK(surface.depends_on(p) == (p == varied || p == model || p == index_of(Uncertain::motion)));
    }
  }
}

TEST_CASE("what is never damaged lives without end, whatever the model's factor is") {
  LifeResponse response = straight_response(0.6, 0, 0);
  response.planned = {{LifeResponse::undamaged, LifeResponse::undamaged, LifeResponse::undamaged}};
  for (double& life : response.worst_life) life = LifeResponse::undamaged;
  CHECK(std::isinf(LifeSurface(response).log10_life({}, -2)));
  CHECK(std::isinf(LifeSurface(response).log10_life(at(model, -2), -2)));
}

TEST_CASE("beyond the rests of all starts a life is that of the last one") {
  constexpr std::size_t rest = index_of(Uncertain::rest);
  LifeResponse response = straight_response(0.6, 0.2, 0);
  for (const auto& [z, life] : {std::pair(-0.7, 4.3), {0.9, 6.3}}) {
    response.points.push_back({}), response.points.back()[rest] = z;
    response.inside.push_back(Inside::as_is);
    response.worst_life.insert(response.worst_life.end(), 3, life);
  }
  for (const auto& [z, change] :
       {std::pair(-3.0, -1.0), {-0.7, -1.0}, {-0.35, -0.5}, {0.0, 0.0}, {0.9, 1.0}, {3.0, 1.0}})
    CHECK(LifeSurface(response).change(at(rest, z)) == Approx(change).margin(rounding));
}

TEST_CASE("a response and its text lead to each other, no other text is one") {
  const LifeResponse response = straight_response(0.6, 0.2, 0.4);
  const LifeResponse again = LifeResponse::from_text(response.text());
  CHECK(again.text() == response.text());
  CHECK(LifeSurface(again).log10_life(at(friction, 0.7), 0.3) ==
        Approx(LifeSurface(response).log10_life(at(friction, 0.7), 0.3)).margin(1e-4));  // six digits each
  CHECK(again.construction == "hose");
  const std::string text = response.text();
  for (const std::string& wrong : {std::string("nothing"), text.substr(0, text.size() - 8), text + "strength 3 2 1\n",
                                   text + "mean x\n", text + "point 1\n", std::string()})
    CHECK_THROWS_AS(LifeResponse::from_text(wrong), std::exception);
}
