// Ranges of free keys, and searches over jobs without runs.
#include <cmath>

#include "pipeline/advise/improve/freedom.h"
#include "pipeline/advise/improve/improvement.h"
#include "pipeline/advise/improve/obstacle.h"
#include "pipeline/base/errors.h"
#include "pipeline/files/files.h"
#include "pipeline/job/job.h"
#include "pipeline/resolve/job_text.h"
#include "tests/catch.h"
#include "tests/pipeline/scratch.h"

namespace dresslife::pipeline {
namespace {

using Eigen::VectorXd;

std::shared_ptr<const Job> shipped_job() {
  return std::make_shared<const Job>(read_job(DRESSLIFE_SOURCE_DIR "/config/jobs/side_panel.yaml"));
}
Freedom freed(const std::string& yaml) { return Freedom::from(parse_yaml(yaml, "s.yaml"), {shipped_job()}); }
VectorXd place_of(std::initializer_list<double> values) {
  VectorXd made(static_cast<Eigen::Index>(values.size()));
  std::copy(values.begin(), values.end(), made.data());
  return made;
}
/// Returns the vector of "KEY=[x, y, z]".
Eigen::Vector3d vector_of(const std::string& set) {
  const Node list = parse_yaml(set.substr(set.find('=') + 1), "v");
  return {std::stod(list.items[0].text), std::stod(list.items[1].text), std::stod(list.items[2].text)};
}

}  // namespace

TEST_CASE("a range is gone through from end to end, in round numbers") {
  const Freedom freedom = freed("routing.free_length_m: 1.9 .. 2.6");
  REQUIRE(freedom.variables() == 1);
  CHECK(freedom.sets_at(place_of({0})) == std::vector<std::string>{"routing.free_length_m=1.9"});
  CHECK(freedom.sets_at(place_of({1})) == std::vector<std::string>{"routing.free_length_m=2.6"});
  CHECK(freedom.sets_at(place_of({1.0 / 3})) == std::vector<std::string>{"routing.free_length_m=2.13333"});
  REQUIRE(freedom.place_of_job());
  CHECK((*freedom.place_of_job())[0] == Approx((2.035 - 1.9) / 0.7));
  CHECK_FALSE(freed("routing.free_length_m: 3 .. 4").place_of_job());
}

TEST_CASE("of a job that says nothing its length and all its clamps and rings are free, about where they are") {
  const auto job = std::make_shared<const Job>(read_job(DRESSLIFE_SOURCE_DIR "/config/jobs/irb6640_guided.yaml"));
  const Freedom freedom = Freedom::from(Freedom::usual(*job), {job});
  CHECK(freedom.variables() ==
        1 + 4 * 5 + 2 + 1);  // length, two clamps, one between and a ring, the lengths up to these two, twist
  CHECK(freedom.place_of_job());
}

TEST_CASE("a key at an end of its range is reported") {
  const Freedom freedom = freed(
      "routing.free_length_m: 1.9 .. 2.6\nrouting.tool_clamp.position_m: 0.1 around [0, 0.2, 0.3]\n"
      "routing.tool_clamp.direction: 30 deg around\ndresspack: [spot_welding, sensor_cable]");
  using Words = std::vector<std::string>;
  CHECK(freedom.at_ends(place_of({0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 1})) == Words());
  CHECK(freedom.at_ends(place_of({0.99, 0.5, 0, 1, 0.5, 1, 0})) ==
        Words{"routing.free_length_m, at most 2.6", "routing.tool_clamp.position_m, y at least 0.1, z at most 0.4",
              "routing.tool_clamp.direction, at most 30 deg around"});
  CHECK(freed("routing.base_clamp.position_m: -0.2 .. 0.3 along link_3").at_ends(place_of({0})) ==
        Words{"routing.base_clamp.position_m, at least -0.2 along its line"});
}

TEST_CASE("where nothing is feasible it is reported which limit binds, how near the best came, and what to widen") {
  const Freedom freedom = freed("{routing.free_length_m: 1.9 .. 2.6, routing.pre_twist_deg: -90 .. 90}");
  const auto trial = [](double u, double v, double bend, double twist) {
    Trial made;
    made.place = place_of({u, v});
    made.worst.beyond.assign(outcome_limits, -1);
    made.worst.beyond[0] = bend, made.worst.beyond[1] = twist;
    made.worst.hours = 1000 * (1 + v);
    return made;
  };
  using Lines = std::vector<std::string>;
  Trial failed = trial(0, 0, 0, 0);
  failed.worst.failure = "too short by 3 mm";
  Trial nearest = trial(0.999, 0.125, 0.125, 0.25);
  nearest.worst.reached.resize(outcome_limits);
  nearest.worst.reached[0] = "529 mm, at least 600 mm";
  CHECK(
      obstacle_words({trial(0.5, 0.5, 0.5, -0.1), failed, nearest}, freedom) ==
      Lines{
          "Nearest is trial 2: bend radius violated by 12 % (529 mm, at least 600 mm), twist violated by 25 %; it lives 0.75 times as long as "
          "the jobs as they are",
          "No trial keeps bend radius: the best violates it by 12 % (529 mm, at least 600 mm; trial 2)",
          "A free key is at the end of its range: routing.free_length_m, at most 2.6; widen it"});
  CHECK(obstacle_words({trial(0.5, 0.5, 0.5, -0.1), trial(0.5, 0.5, -0.1, 0.75)}, freedom) ==
        Lines{"Nearest are the jobs as they are: bend radius violated by 39 %",
              "Each limit is kept by some trial, but not with the others: bend radius",
              "No free key is at an end of its range: allow more trials, free other keys, or take another dresspack"});
  CHECK(obstacle_words({failed}, freedom) == Lines{"No trial runs; the last: too short by 3 mm"});
}

TEST_CASE("directions stay in their cone, and the job's own lies in its middle") {
  const Freedom freedom = freed("routing.tool_clamp.direction: 30 deg around");
  REQUIRE(freedom.variables() == 2);
  const Eigen::Vector3d own = Eigen::Vector3d(1, 0, -0.35).normalized();
  double widest = 1;
  for (double u = 0; u <= 1; u += 0.1)
    for (double v = 0; v <= 1; v += 0.1)
      widest = std::min(widest, vector_of(freedom.sets_at(place_of({u, v})).front()).normalized().dot(own));
  CHECK(std::acos(widest) * 180 / M_PI == Approx(30).margin(0.02));  // directions have four decimals
  REQUIRE(freedom.place_of_job());
  CHECK((*freedom.place_of_job() - place_of({0.5, 0.5})).norm() < 1e-9);
  // From the key to the place and back.
  const Freedom about = freed("routing.tool_clamp.direction: 40 deg around [0.9, 0.2, -0.1]");
  REQUIRE(about.place_of_job());
  CHECK((vector_of(about.sets_at(*about.place_of_job()).front()) - own).norm() < 2e-4);
}

TEST_CASE("a given centre replaces the job's own value") {
  const Freedom length = freed("routing.free_length_m: 0.1 around 2.2");
  CHECK(length.sets_at(place_of({0})) == std::vector<std::string>{"routing.free_length_m=2.1"});
  CHECK(length.sets_at(place_of({1})) == std::vector<std::string>{"routing.free_length_m=2.3"});
  for (const std::string range : {"0.1 around here", "20 deg around 1"})
    CHECK_THROWS_WITH(freed("routing.tool_clamp.direction: " + range), Catch::Contains("' is no "));
}

TEST_CASE("positions move in a box, along a line, along a link") {
  const Freedom box = freed("routing.base_clamp.position_m: 0.05 around");
  CHECK(box.sets_at(place_of({0, 0.5, 1})) ==
        std::vector<std::string>{"routing.base_clamp.position_m=[-0.15, 0, 0.5]"});
  const Freedom line = freed("routing.base_clamp.position_m: -0.2 .. 0.3 along [0, 0, 2]");
  CHECK(line.sets_at(place_of({1})) == std::vector<std::string>{"routing.base_clamp.position_m=[-0.1, 0, 0.75]"});
  REQUIRE(line.place_of_job());
  CHECK((*line.place_of_job())[0] == Approx(0.4));
  // link_2 carries link_3 at (0, 0, 1.075).
  const Freedom link = freed("routing.base_clamp.position_m: 0 .. 0.1 along link_2");
  CHECK(link.sets_at(place_of({1})) == std::vector<std::string>{"routing.base_clamp.position_m=[-0.1, 0, 0.55]"});
}

TEST_CASE("one of a list") {
  const Freedom freedom = freed("dresspack.bending_stiffness_Nm2: [4, 5, 6]\nmotion: [easy, [easy, hard, hard]]");
  CHECK(freedom.sets_at(place_of({0.99, 0.6})) ==
        std::vector<std::string>{"dresspack.bending_stiffness_Nm2=6", "motion=[easy, hard, hard]"});
}

TEST_CASE("what nothing can be freed by is refused with its place") {
  const auto words = [](const std::string& yaml) { return message_of([&] { freed(yaml); }); };
  CHECK(words("routing.free_length_m: 2.6 .. 1.9") ==
        "s.yaml:1:24: error: free.routing.free_length_m is '2.6 .. 1.9', which holds nothing; write the "
        "smaller number first");
  CHECK(words("routing.free_length_m: long").find("is 'long'; write LOW .. HIGH") != std::string::npos);
  CHECK(words("routing.free_length_m: 1 .. two").find("'two' is no number") != std::string::npos);
  CHECK(words("routing.free_length_m: 0 around").find("may not change at all") != std::string::npos);
  CHECK(words("routing.tool_clamp.direction: 95 deg around").find("is a cone of 95 deg") != std::string::npos);
  CHECK(words("routing.free_length_m: 5 deg around").find("is no direction") != std::string::npos);
  CHECK(words("routing.nothing_m: 0.1 around").find("its own value, which it has not") != std::string::npos);
  CHECK(words("routing.rings.0.position_m: 0.1 around").find("count from 1") != std::string::npos);
  CHECK(words("routing.base_clamp.position_m: 0 .. 1 along link_9").find("no link that carries") != std::string::npos);
  for (const std::string key : {"fatigue.failed_wires_percent", "simulation.segments", "dresspack.least_bend_radius_mm",
                                "dresspacks.1.dresspack.most_tension_N", "motion.hold_joint"})
    CHECK_THAT(words(key + ": 20 .. 40"),
               Catch::Contains("free." + key + " is a limit or a setting of the calculation"));
  for (const std::string keys :
       {"{routing.tool_clamp.position_m: 0.05 around, routing.tool_clamp.position_m.2: 0 .. 0.1}",
        "{routing.tool_clamp.position_m.2: 0 .. 0.1, routing.tool_clamp.position_m: 0.05 around}"})
    CHECK_THAT(words(keys), Catch::Contains("set the same value; keep one of the two"));
  CHECK(words("{routing.tool_clamp.position_m.1: 0 .. 0.1, routing.tool_clamp.position_m.2: 0 .. 0.1}") == "");
  CHECK(words("routing.free_length_m: []").find("one of nothing") != std::string::npos);
  CHECK(words("[1, 2]").find("must be a map") != std::string::npos);
}

TEST_CASE("without a word the clamps and the length are free") {
  const auto job = shipped_job();
  const Freedom freedom = Freedom::from(Freedom::usual(*job), {job});
  CHECK(freedom.variables() == 12);
  REQUIRE(freedom.place_of_job());
  for (const std::string& set : freedom.sets_at(*freedom.place_of_job()))
    if (set.starts_with("routing.free_length_m=")) CHECK(std::stod(set.substr(22)) == Approx(2.035).margin(1e-4));
}

}  // namespace dresslife::pipeline
