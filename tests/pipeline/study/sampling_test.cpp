#include "pipeline/study/sampling.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "pipeline/settings/fields.h"
#include "tests/catch.h"
#include "tests/pipeline/scratch.h"

using namespace dresslife::pipeline;

namespace {

Node section(const std::string& text) { return *parse_yaml("sample: " + text + "\n", "s.yaml").find("sample"); }

Distribution distribution(const std::string& text) {
  const Node map = parse_yaml("a.b: " + text + "\n", "s.yaml");
  return Distribution::from("a.b", map.entries.front().value);
}

double number(const Distribution& of, double u) { return std::stod(of.value_at(u).text); }

std::string refusal(const std::string& text) {
  return message_of([&] { sampled_variants(section(text)); });
}

TEST_CASE("sampling: values are quantiles, after tables of the normal distribution") {
  constexpr double halving = 1e-12;
  const Distribution normal = distribution("!normal {mean: 10, deviation: 2}");
  CHECK(number(normal, 0.5) == Approx(10).epsilon(halving));
  CHECK(number(normal, 0.975) == Approx(10 + 2 * 1.959963984540054).epsilon(halving));
  CHECK(number(normal, 1e-9) == Approx(10 - 2 * 5.997807015007686).epsilon(1e-9));
  const Distribution uniform = distribution("!uniform [-1, 3]");
  CHECK(number(uniform, 0.25) == 0);
  const Distribution choice = distribution("!choice [easy, [1, 2], 3]");
  CHECK(choice.value_at(0.3).text == "easy");
  CHECK(choice.value_at(0.5).items.size() == 2);
  CHECK(choice.value_at(std::nextafter(1.0, 0.0)).text == "3");
}

TEST_CASE("sampling: a normal between bounds has the quantiles of what is left") {
  const Distribution half = distribution("!normal {mean: 0, deviation: 1, at_least: 0}");
  CHECK(number(half, 0.5) == Approx(0.6744897501960817).epsilon(1e-12));  // three quarters of the whole
  CHECK(number(half, 1e-12) >= 0);
  const Distribution narrow = distribution("!normal {mean: 0, deviation: 1, at_least: -1e-3, at_most: 1e-3}");
  CHECK(number(narrow, 0.75) == Approx(5e-4).epsilon(1e-3));  // the density is constant there: phi(0)
}

TEST_CASE("sampling: a latin hypercube has one value in each part, keys in orders of their own") {
  constexpr std::size_t count = 97;
  const auto first = unit_numbers(SamplingMethod::latin_hypercube, 3, "a", count);
  std::set<int> parts;
  for (const double u : first) parts.insert(static_cast<int>(u * count));
  CHECK(parts.size() == count);
  CHECK(*parts.begin() == 0);
  const auto second = unit_numbers(SamplingMethod::latin_hypercube, 3, "b", count);
  double together = 0;
  for (std::size_t k = 0; k < count; ++k) together += (first[k] - 0.5) * (second[k] - 0.5) * 12 / count;
  CHECK(std::abs(together) <
        4 / std::sqrt(count));  // four standard deviations of the correlation of independent numbers
  CHECK(first != unit_numbers(SamplingMethod::latin_hypercube, 4, "a", count));
  CHECK(first == unit_numbers(SamplingMethod::latin_hypercube, 3, "a", count));
}

TEST_CASE("sampling: more random draws, or another key, leave those before as they were") {
  const auto values = [](const std::string& text) {
    std::vector<std::string> list;
    for (const Variant& variant : sampled_variants(section(text)))
      list.push_back(variant.name + " " + variant.changes.front().path + " " + variant.changes.front().value.text);
    return list;
  };
  const auto few = values("{jobs: 3, method: random, keys: {a: !uniform [0, 1]}}");
  const auto more = values("{jobs: 5, method: random, keys: {a: !uniform [0, 1], b: !uniform [0, 1]}}");
  REQUIRE(more.size() == 5);
  CHECK(std::equal(few.begin(), few.end(), more.begin()));
  CHECK(few[0] != values("{jobs: 3, seed: 2, method: random, keys: {a: !uniform [0, 1]}}")[0]);
}

TEST_CASE("sampling: what is no distribution is refused where it stands") {
  const std::string remedy = "; write !normal {mean: M, deviation: S}, !uniform [LOW, HIGH] or !choice [A, B, ...]";
  CHECK(refusal("{jobs: 2, keys: {a: 3}}") == "s.yaml:1:29: error: a has no distribution" + remedy);
  CHECK(refusal("{jobs: 2, keys: {a: !gamma [1, 2]}}") == "s.yaml:1:29: error: a has no distribution" + remedy);
  CHECK(refusal("{jobs: 2}") == "s.yaml:1:9: error: sample.keys must be a map of keys to distributions" + remedy);
  CHECK(refusal("{jobs: 2, keys: {a: !uniform [2, 2]}}") ==
        "s.yaml:1:29: error: !uniform of a must be two rising numbers" + remedy);
  CHECK(refusal("{jobs: 2, keys: {a: !choice []}}").find("!choice of a must be a list of values") != std::string::npos);
  CHECK(refusal("{jobs: 2, keys: {a: !normal {mean: 1}}}").find("normal.deviation is missing") != std::string::npos);
  CHECK(refusal("{jobs: 2, keys: {a: !normal {mean: 1, deviation: 0}}}").find("normal.deviation is 0 (must be > 0)") !=
        std::string::npos);
  CHECK(refusal("{jobs: 2, keys: {a: !normal {mean: 0, deviation: 1, at_least: 9}}}")
            .find("between at_least and at_most of a lies none of its !normal") != std::string::npos);
  CHECK(refusal("{jobs: 0, keys: {a: !uniform [0, 1]}}").find("sample.jobs is 0 (must be 1 .. 100000)") !=
        std::string::npos);
  CHECK(refusal("{jobs: 2, sed: 1, keys: {a: !uniform [0, 1]}}").find("'seed'") != std::string::npos);
  CHECK(refusal("[1]").find("sample must be a map") != std::string::npos);
}

}  // namespace
