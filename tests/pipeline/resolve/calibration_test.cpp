#include "pipeline/job/calibration.h"

#include <cmath>

#include "pipeline/job/job.h"
#include "pipeline/resolve/job_text.h"
#include "pipeline/settings/fields.h"
#include "tests/catch.h"
#include "tests/pipeline/sample_job.h"
#include "tests/pipeline/scratch.h"

using namespace dresslife::pipeline;

namespace {

const std::string two_learned = R"(format: dresslife-calibration
format_version: 1
parameters:
  - {name: strength, median: 0.5, mean: 0.4, covariance: [0.25, -0.1]}
  - {name: friction_inside, median: -1, mean: -0.9, covariance: [-0.1, 0.5]}
within: {least_strain_range: 1e-3, largest_strain_range: 6e-3, largest_curvature_1_per_m: 10, materials: copper}
observations:
  - {observation: bench, observed: 1000}
)";

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  return text.replace(text.find(what), what.size(), by);
}

/// The place in the file and the words.
std::string refusal(const std::string& calibration) {
  const Scratch scratch;
  scratch.write("learned.yaml", calibration);
  const auto job = scratch.write("job.yaml", sample_job + "calibration: learned.yaml\n");
  const std::string message = message_of([&] { read_job(job); }), folder = (scratch / "").string();
  return message.starts_with(folder) ? message.substr(folder.size()) : message;
}

}  // namespace

TEST_CASE("calibration: the keys of a job that names one go to its medians") {
  const Scratch scratch;
  scratch.write("learned.yaml", two_learned);
  const auto file = scratch.write("job.yaml", sample_job + "calibration: learned.yaml\n");
  const Job job = read_job(file);
  CHECK(job.fatigue.strength_factor == Approx(std::exp(0.25 * 0.5)));
  CHECK(job.strain.factors.friction == Approx(std::exp(-0.78)));
  CHECK(job.fatigue.model_factor == 1);
  // What a job gives itself stands.
  CHECK(read_job(file, {"strain.friction_factor=3"}).strain.factors.friction == 3);
  // It is part of what results depend on, by its content: no name of a file is left.
  const Job again = job_from(parse_yaml(job_text(job), "elsewhere.yaml"));
  CHECK(job_text(again) == job_text(job));
  CHECK(again.fatigue.strength_factor == job.fatigue.strength_factor);
  const std::string before = part_text(job, Part::fatigue), sim = part_text(job, Part::sim);
  scratch.write("learned.yaml", replaced(two_learned, "0.25", "0.26"));
  CHECK(part_text(read_job(file), Part::fatigue) != before);
  CHECK(part_text(read_job(file), Part::sim) == sim);
}

TEST_CASE("calibration: draws are its own, of what it does not know the prior's") {
  const Scratch scratch;
  scratch.write("learned.yaml", two_learned);
  const Job job = read_job(scratch.write("job.yaml", sample_job + "calibration: learned.yaml\n"));
  const ParameterKnowledge known = knowledge_of(job);
  const auto strength = index_of(Uncertain::strength), friction = index_of(Uncertain::friction_inside),
             slack = index_of(Uncertain::slack);
  CHECK(known.mean[strength] == 0.4);
  CHECK(known.mean[slack] == 0);
  CHECK(known.covariance(strength, strength) == 0.25);
  CHECK(known.covariance(strength, friction) == -0.1);
  CHECK(known.covariance(friction, friction) == 0.5);
  CHECK(known.covariance(slack, slack) == Approx(1));
  CHECK(known.covariance(slack, friction) == 0);
}

TEST_CASE("calibration: bad files are refused at their place") {
  CHECK(refusal(two_learned) == "");
  CHECK(refusal(replaced(two_learned, "strength,", "strenght,"))
            .starts_with("learned.yaml:4:5: error: 'strenght' is no uncertain"));
  CHECK(refusal(replaced(two_learned, "friction_inside", "strength")).find("'strength' stands twice") !=
        std::string::npos);
  CHECK(refusal(replaced(two_learned, "dresslife-calibration", "dresslife-life")).find("has the format") !=
        std::string::npos);
  CHECK(refusal(replaced(two_learned, "version: 1", "version: 9")).find("is of version 9") !=
        std::string::npos);
  CHECK(refusal(replaced(two_learned, "[0.25, -0.1]", "[0.25]")).find("has 1 covariances") !=
        std::string::npos);
  CHECK(refusal(replaced(two_learned, "[0.25, -0.1]", "[0.25, 0.1]")).find("not symmetric") !=
        std::string::npos);
  CHECK(refusal(replaced(two_learned, "[0.25, -0.1]", "[0.01, -0.1]")).find("not symmetric and positive") !=
        std::string::npos);
  CHECK(refusal(replaced(two_learned, "0.25", ".nan")) != "");
  CHECK(refusal("just words\n").find("holds no calibration") != std::string::npos);
  CHECK(refusal(replaced(two_learned, "parameters", "parameter")).find("unknown key") != std::string::npos);
  const Scratch scratch;
  const auto lost = scratch.write("job.yaml", sample_job + "calibration: nowhere.yaml\n");
  CHECK(message_of([&] { read_job(lost); }).find("nowhere.yaml") != std::string::npos);
}

TEST_CASE("calibration: tells where a job goes beyond what it was learned from") {
  LearnedWithin within;
  within.least_strain_range = 1e-3;
  within.largest_strain_range = 6e-3;
  within.largest_curvature = 10;
  within.materials = "copper, silver";
  CHECK(beyond(within, {3e-3, 8, 100, {"copper"}}).empty());
  CHECK(beyond(within, {1.2e-2, 8, 0, {"copper"}}).at(0) ==
        "a strain range of 0.012 (at most 0.0060 in its tests)");
  CHECK(beyond(within, {3e-4, 8, 0, {"silver"}}).size() == 1);
  CHECK(beyond(within, {3e-3, 12, 0, {"opper"}}).size() == 2);
  CHECK(beyond({}, {1, 1, 1, {"gold"}}).empty());
}
