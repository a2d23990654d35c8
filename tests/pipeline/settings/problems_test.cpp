#include "pipeline/settings/problems.h"

#include "pipeline/base/text.h"
#include "pipeline/job/job.h"
#include "pipeline/resolve/job_text.h"
#include "tests/catch.h"
#include "tests/pipeline/sample_job.h"
#include "tests/pipeline/scratch.h"

namespace dresslife::pipeline {
namespace {

/// Errors of the sample job after changes, line by line; words are without the places.
struct Said {
  std::vector<std::string> places, words;
};

Said said_of(const std::vector<std::pair<std::string, std::string>>& changes,
             const std::vector<std::string>& sets = {}) {
  std::string text = sample_job;
  for (const auto& [from, to] : changes) text = edited(text, from, to);
  Said said;
  const std::string mark = ": error: ";
  for (const std::string& line :
       parts_between(message_of([&] { job_from(parse_yaml(text, "job.yaml"), sets); }), "\n")) {
    const std::size_t at = line.find(mark);
    REQUIRE(at != std::string::npos);
    said.places.push_back(line.substr(0, at));
    const std::size_t words = at + mark.size();
    said.words.push_back(line.substr(words, line.find(';') - words));
  }
  return said;
}

using Words = std::vector<std::string>;

TEST_CASE("problems: all mistakes of a job are reported at once, in the order of the file") {
  const Said said = said_of({{"radius_mm: 120", "radius_mm: -120"},
                             {"fatigue: {", "colour: red\nfatigue: {"},
                             {"axial_stiffness_N: 1e5", "axial_stiffness_N: stiff"},
                             {"segments: 20", "segments: 20.5"},
                             {"gate: 1e-4", "kinematics: exakt"}});
  REQUIRE(said.words.size() == 5);
  CHECK(said.words[0] == "robot.links[2].capsules[1].radius_mm is -120 (must be > 0 mm)");
  CHECK(said.words[1] ==
        "dresspack.axial_stiffness_N is 'stiff' (must be a number or from_construction, the unit is in the key: N)");
  CHECK(said.words[2] == "simulation.segments is 20.5 (must be a whole number)");
  CHECK(said.words[3].starts_with("strain.kinematics is 'exakt' (must be "));
  CHECK(said.words[4] == "unknown key 'colour'");
}

TEST_CASE("problems: what follows from a mistake is not told") {
  // A key under a wrong name is not also reported as missing.
  CHECK(said_of({{"free_length_m:", "free_length:"}}).words == Words{"unknown key 'routing.free_length'"});
  // If the robot was not read, neither the clamps' links nor the number of angles is checked against it.
  CHECK(said_of({{"robot:\n", "robot: [no, map]\nformer:\n"}}).words ==
        Words{"robot must be a map of settings", "unknown key 'former'"});
}

TEST_CASE("problems: contradictions of parts that were read stand beside what cannot be read in others") {
  const Said said = said_of({{"{link: base", "{link: basement"}, {"gate: 1e-4", "kinematics: exakt"}});
  REQUIRE(said.words.size() == 2);
  CHECK(said.words[0] == "routing.base_clamp.link 'basement' is not a link of the robot");
  CHECK(said.words[1].starts_with("strain.kinematics"));
}

TEST_CASE("problems: every change of the command line that cannot be made is reported") {
  const Said said = said_of({}, {"simulation.segments.more=3", "routing=", "no equals sign"});
  REQUIRE(said.places.size() == 3);
  CHECK(said.words[0].starts_with("'more' of simulation.segments.more lies inside a single value"));
}

TEST_CASE("problems: the same line is reported once, and no more lines than a person reads") {
  Problems problems;
  CHECK_NOTHROW(problems.finish());
  const Where here{"a.yaml", 3, 1};
  for (int i = 0; i < 2; ++i) problems.add(here, "is wrong", "correct it", "a.b");
  CHECK(message_of([&] { problems.finish("a.yaml"); }) == "a.yaml:3:1: error: is wrong; correct it");
  CHECK(problems.touch("a"));
  CHECK(problems.touch("a.b"));
  CHECK(problems.touch("a.b[2].c"));
  CHECK_FALSE(problems.touch("a.bc"));
  CHECK_FALSE(problems.touch("b"));
  for (int i = 0; i < 1000; ++i) problems.add({"b.yaml", i + 1, 1}, fmt::format("problem {}", i), "");
  problems.add({"a.yaml", 2, 1}, "beyond what is kept", "");
  const std::vector<std::string> lines = parts_between(message_of([&] { problems.finish("a.yaml"); }), "\n");
  CHECK(lines.size() == 101);
  CHECK(lines.front() == "a.yaml:3:1: error: is wrong; correct it");
  CHECK(lines.back() == "a.yaml: error: only the first 100 problems are shown; correct them first");
}

}  // namespace
}  // namespace dresslife::pipeline
