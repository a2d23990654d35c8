#include "pipeline/job/calibration.h"

#include <algorithm>
#include <cmath>

#include "pipeline/job/learned_settings.h"
#include "pipeline/job/wall_strength.h"
#include "pipeline/resolve/job_text.h"
#include "pipeline/settings/fields.h"
#include "tests/catch.h"
#include "tests/pipeline/sample_job.h"
#include "tests/pipeline/scratch.h"

using namespace dresslife::pipeline;

namespace {

/// A calibration of strength and friction, learned from the sample job.
std::string two_learned() {
  const Job job = job_from(parse_yaml(sample_job, "test.yaml"));
  Calibration calibration;
  calibration.under = learned_under({&job});
  Node tree;
  tree["under"] = *echo_fields(calibration).find("under");
  return R"(format: dresslife-calibration
format_version: 2
parameters:
  - {name: strength, median: 0.5, mean: 0.4, covariance: [0.25, -0.1]}
  - {name: friction_inside, median: -1, mean: -0.9, covariance: [-0.1, 0.5]}
within: {least_strain_range: 1e-3, largest_strain_range: 6e-3, largest_curvature_1_per_m: 10, materials: copper}
observations:
  - {observation: bench, observed: 1000}
)" + to_yaml(tree);
}

/// Returns the error of a calibration: place in the file and words.
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
  scratch.write("learned.yaml", two_learned());
  const auto file = scratch.write("job.yaml", sample_job + "calibration: learned.yaml\n");
  const Job job = read_job(file);
  CHECK(job.fatigue.strength_factor == Approx(std::pow(1.3, 0.5)));
  CHECK(job.strain.factors.friction == Approx(1 / 2.2));
  CHECK(job.fatigue.model_factor == 1);
  // A value given in the job has priority.
  CHECK(read_job(file, {"strain.friction_factor=3"}).strain.factors.friction == 3);
  // Results depend on the calibration's content: the resolved job contains no file name.
  const Job again = job_from(parse_yaml(job_text(job), "elsewhere.yaml"));
  CHECK(job_text(again) == job_text(job));
  CHECK(again.fatigue.strength_factor == job.fatigue.strength_factor);
  const std::string before = part_text(job, JobPart::fatigue), sim = part_text(job, JobPart::sim);
  scratch.write("learned.yaml", edited(two_learned(), "0.25", "0.26"));
  CHECK(part_text(read_job(file), JobPart::fatigue) != before);
  CHECK(part_text(read_job(file), JobPart::sim) == sim);
}

TEST_CASE("calibration: draws are its own, of what it does not know the prior's") {
  const Scratch scratch;
  scratch.write("learned.yaml", two_learned());
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

TEST_CASE("calibration: the spread between dresspacks multiplies the deviations that each has for itself") {
  const Scratch scratch;
  scratch.write("learned.yaml", "own_spread: 0.5\n" + two_learned());
  const Job job = read_job(scratch.write("job.yaml", sample_job + "calibration: learned.yaml\n"));
  const ParameterKnowledge known = knowledge_of(job);
  for (const Uncertain own : {Uncertain::slack, Uncertain::grip, Uncertain::rest, Uncertain::motion})
    CHECK(known.covariance(index_of(own), index_of(own)) == Approx(0.25));
  for (const Uncertain shared : {Uncertain::play, Uncertain::model, Uncertain::scatter, Uncertain::hose_stiffness})
    CHECK(known.covariance(index_of(shared), index_of(shared)) == Approx(1));
  CHECK(known.covariance(index_of(Uncertain::strength), index_of(Uncertain::strength)) == 0.25);
  CHECK(job_text(job_from(parse_yaml(job_text(job), "elsewhere.yaml"))) == job_text(job));
  CHECK(refusal("own_spread: -1\n" + two_learned()).find("own_spread") != std::string::npos);
}

TEST_CASE(
    "calibration: the error of computed lives is smaller only for jobs with a motion and routing of its records") {
  const Scratch scratch;
  const auto file = scratch.write("job.yaml", sample_job + "calibration: learned.yaml\n");
  const std::string digest = motion_digest(job_from(parse_yaml(sample_job, "test.yaml")));
  scratch.write("learned.yaml", "own_spread: 0.5\n" +
                                    edited(two_learned(), "under:\n", "under:\n  motions: another, " + digest + "\n"));
  const auto spread = [&](const std::vector<std::string>& sets) {
    return read_job(file, sets).calibration->residual_spread;
  };
  CHECK(spread({}) == 0.5);
  CHECK(spread({"simulation.segments=20", "strain.slack_factor=1.2", "uncertainty.enabled=false"}) == 0.5);
  CHECK(spread({"routing.free_length_m=1.25"}) == 1);
  CHECK(spread({"motion.speed_percent=90"}) == 1);
  const Job job = read_job(file), again = job_from(parse_yaml(job_text(job), "elsewhere.yaml"));
  CHECK(again.calibration->residual_spread == 0.5);
  // A search compares jobs with the whole error, also after it wrote and read them.
  Job candidate = job;
  candidate.calibration->residual_spread = 1;
  CHECK(job_from(parse_yaml(job_text(candidate), "elsewhere.yaml")).calibration->residual_spread == 1);
  // A resolved job is another one after a change of its routing.
  CHECK(job_from(parse_yaml(job_text(job), "elsewhere.yaml"), {"routing.free_length_m=1.25"})
            .calibration->residual_spread == 1);
}

TEST_CASE("calibration: the strength of a hose's wall stands beside the wires' parameters and moves none of them") {
  const std::string wall = "wall strength of polyamide (0.01 1e+06, 0.001 1e+09)";
  const std::string with =
      edited(edited(edited(two_learned(), "[0.25, -0.1]", "[0, 0.25, -0.1]"), "[-0.1, 0.5]", "[0, -0.1, 0.5]"),
             "  - {name: strength,",
             "  - {name: '" + wall + "', median: 2, mean: 2, covariance: [0.3, 0, 0]}\n  - {name: strength,");
  const Scratch scratch;
  scratch.write("learned.yaml", two_learned()), scratch.write("wall.yaml", with);
  const Job before = read_job(scratch.write("job.yaml", sample_job + "calibration: learned.yaml\n")),
            job = read_job(scratch.write("walled.yaml", sample_job + "calibration: wall.yaml\n"));
  CHECK(job.fatigue.strength_factor == before.fatigue.strength_factor);
  CHECK(job.strain.factors.friction == before.strain.factors.friction);
  CHECK(knowledge_of(job).mean == knowledge_of(before).mean);
  CHECK(knowledge_of(job).covariance == knowledge_of(before).covariance);
  CHECK(job_text(job_from(parse_yaml(job_text(job), "elsewhere.yaml"))) == job_text(job));
  Material polyamide;
  polyamide.name = "polyamide", polyamide.strain_life_table = {{0.01, 1e6}, {0.001, 1e9}};
  CHECK(wall_strength_of(polyamide) == wall);
  const ParameterKnowledge known = wall_knowledge(job, polyamide);
  CHECK(known.mean[index_of(Uncertain::strength)] == 2);
  CHECK(known.covariance(index_of(Uncertain::strength), index_of(Uncertain::strength)) == 0.3);
}

TEST_CASE("calibration: samples that are standardised give the samples of the file") {
  const std::string with = edited(edited(two_learned(), "[0.25, -0.1]", "[0.25, -0.1], samples: [0.1, 0.9, 0.2]"),
                                  "[-0.1, 0.5]", "[-0.1, 0.5], samples: [-0.4, -1.8, -0.3]");
  const Scratch scratch;
  scratch.write("learned.yaml", with);
  const Job job = read_job(scratch.write("job.yaml", sample_job + "calibration: learned.yaml\n"));
  CHECK(job_text(job_from(parse_yaml(job_text(job), "elsewhere.yaml"))) == job_text(job));
  const ParameterKnowledge known = knowledge_of(job);
  REQUIRE(known.samples);
  constexpr std::size_t friction = index_of(Uncertain::friction_inside), strength = index_of(Uncertain::strength);
  CHECK(known.samples->parameters == std::vector{friction, strength});
  const Eigen::MatrixXd factor = triangular_factor(known.covariance, known.samples->parameters);
  const Eigen::MatrixXd z = known.samples->numbers * factor.transpose();
  for (const auto& [k, at_friction, at_strength] : {std::tuple{0, -0.4, 0.1}, {1, -1.8, 0.9}, {2, -0.3, 0.2}}) {
    CHECK(z(k, 0) - 0.9 == Approx(at_friction));
    CHECK(z(k, 1) + 0.4 == Approx(at_strength));
  }
  CHECK(refusal(edited(with, "[0.1, 0.9, 0.2]", "[0.1, 0.9]")).find("has 3 samples, another parameter has 2") !=
        std::string::npos);
}

TEST_CASE("calibration: bad files are refused at their place") {
  CHECK(refusal(two_learned()) == "");
  CHECK(refusal(edited(two_learned(), "strength,", "strenght,"))
            .starts_with("learned.yaml:4:5: error: 'strenght' is no uncertain"));
  CHECK(refusal(edited(two_learned(), "friction_inside", "strength")).find("'strength' is listed twice") !=
        std::string::npos);
  CHECK(refusal(edited(two_learned(), "dresslife-calibration", "dresslife-life")).find("has the format") !=
        std::string::npos);
  CHECK(refusal(edited(two_learned(), "version: 2", "version: 9")).find("is of version 9") != std::string::npos);
  CHECK(refusal(edited(two_learned(), "[0.25, -0.1]", "[0.25]")).find("has 1 covariances") != std::string::npos);
  CHECK(refusal(edited(two_learned(), "[0.25, -0.1]", "[0.25, 0.1]")).find("not symmetric") != std::string::npos);
  CHECK(refusal(edited(two_learned(), "[0.25, -0.1]", "[0.01, -0.1]")).find("not symmetric and positive") !=
        std::string::npos);
  CHECK(refusal(edited(two_learned(), "0.25", ".nan")) != "");
  CHECK(refusal("just words\n").find("holds no calibration") != std::string::npos);
  CHECK(refusal(edited(two_learned(), "parameters", "parameter")).find("unknown key") != std::string::npos);
  const Scratch scratch;
  const auto lost = scratch.write("job.yaml", sample_job + "calibration: nowhere.yaml\n");
  CHECK(message_of([&] { read_job(lost); }).find("nowhere.yaml") != std::string::npos);
}

TEST_CASE("calibration: reports where a job goes beyond what it was learned from") {
  LearnedWithin within;
  within.least_strain_range = 1e-3;
  within.largest_strain_range = 6e-3;
  within.largest_curvature = 10;
  CHECK(beyond(within, {3e-3, 8, 100}).empty());
  CHECK(beyond(within, {1.2e-2, 8, 0}).at(0) == "a strain range of 0.012 (at most 0.0060 in its tests)");
  CHECK(beyond(within, {3e-4, 8, 0}).size() == 1);
  within.left_out = "no test has the cable x, for which friction_inside is not used";
  CHECK(beyond(within, {3e-3, 12, 0}).at(1) == within.left_out);
  CHECK(beyond({}, {1, 1, 1}).empty());
}

namespace {

/// Returns the calibration's message about a job with these changes; "" if it applies.
std::string answer(const std::string& calibration, const std::vector<std::string>& sets) {
  const Scratch scratch;
  scratch.write("learned.yaml", calibration);
  const auto job = scratch.write("job.yaml", sample_job + "calibration: learned.yaml\n");
  return message_of([&] { read_job(job, sets); });
}

bool has(const std::string& text, const std::string& words) { return text.find(words) != std::string::npos; }

const std::string wires = "dresspack.components.1.components.1.";

}  // namespace

TEST_CASE("calibration: a job with other settings than its tests is refused, and both are named") {
  CHECK(answer(two_learned(), {}) == "");
  const std::string slip = answer(two_learned(), {"strain.slip=free"});
  CHECK(has(slip,
            "learned.yaml:1:1: error: was learned with strain.slip: [stick, free] (this job has free); set "
            "strain.slip as the tests had it, calibrate again with --set 'strain.slip=free', or leave"));
  CHECK(answer(two_learned(), {"strain.slip=[stick, free]"}) == "");
  const std::string both = answer(two_learned(), {"strain.kinematics=thesis", "fatigue.stress=elastic"});
  CHECK(has(both, "was learned with strain.kinematics: exact (this job has thesis); "));
  CHECK(has(both, "was learned with fatigue.stress: cyclic (this job has elastic); "));
  const std::string friction = answer(two_learned(), {wires + "friction_coefficient=0.5"});
  CHECK(has(friction, "was learned with friction_coefficient 0.3 and radial_line_load_N_per_m "));
  CHECK(has(friction, "(this job has friction_coefficient 0.5 and radial_line_load_N_per_m "));
  const std::string constants = answer(edited(two_learned(), "fatigue_strength_MPa ", "fatigue_strength_MPa 1"), {});
  CHECK(has(constants, "was learned with fatigue_strength_MPa 1"));
  CHECK(has(constants, " of material 'copper' (this job has fatigue_strength_MPa "));
  // Tests under several values of a setting are valid for each of them.
  const Scratch scratch;
  const auto file = scratch.write("job.yaml", sample_job);
  const Job one = read_job(file), other = read_job(file, {"strain.slip=free"});
  CHECK(learned_under({&one, &other, &one}).settings.size() == learned_under({&one}).settings.size() + 1);
  // Older files contain no settings.
  std::string old = two_learned();
  old.erase(old.find("under:"));
  CHECK(has(answer(old, {}),
            "does not say under which settings it was learned (strain.slip and others); run dresslife "
            "calibrate again"));
}

TEST_CASE("calibration: resolved jobs keep to its settings, too") {
  const Scratch scratch;
  scratch.write("learned.yaml", two_learned());
  const std::string text = job_text(read_job(scratch.write("job.yaml", sample_job + "calibration: learned.yaml\n")));
  CHECK(message_of([&] {
          job_from(parse_yaml(text, "resolved.yaml"), {"strain.slip=free"});
        }).find("was learned with") != std::string::npos);
  const std::size_t began = text.find("  under:\n"), ended = text.find("  within:\n");
  REQUIRE(ended > began);
  std::string older = text;
  older.erase(began, ended - began);
  CHECK(job_text(job_from(parse_yaml(older, "resolved.yaml"))).size() < text.size());
}

TEST_CASE("calibration: of a construction or a material that no test had its parameters are left out") {
  const Scratch scratch;
  scratch.write("learned.yaml", two_learned());
  const auto file = scratch.write("job.yaml", sample_job + "calibration: learned.yaml\n");
  // Another lay is another cable. Strength belongs to the material and stays, with its own variance.
  const Job cable = read_job(file, {wires + "lay_angle_deg=20"});
  CHECK(cable.strain.factors.friction == 1);
  CHECK(cable.fatigue.strength_factor == Approx(std::pow(1.3, 0.5)));
  REQUIRE(cable.calibration->parameters.size() == 1);
  CHECK(cable.calibration->parameters[0].covariance == std::vector<double>{0.25});
  CHECK(knowledge_of(cable).covariance(0, 0) == Approx(1));
  CHECK(cable.calibration->within.left_out == "no test has the cable test hose, for which friction_inside is not used");
  // Another material of wires: the friction stays.
  const Job material = read_job(file, {"fatigue.material=copper_halved"});
  CHECK(material.strain.factors.friction == Approx(1 / 2.2));
  CHECK(material.fatigue.strength_factor == 1);
  CHECK(material.calibration->within.left_out == "no test has wires of copper_halved, for which strength is not used");
  CHECK(read_job(file).calibration->within.left_out.empty());
}

TEST_CASE("calibration: a cable that was tested alone is known again in a hose") {
  const Scratch scratch;
  const std::string rig = "motion: {rig: {kind: torsion, twist_deg_per_m: 90}}\n";
  const Job alone = read_job(scratch.write(
      "a.yaml",
      rig +
          "dresspack: {cable: {from: spot_welding, part: signal cable}}\nstrain: {slip: [free, friction, friction]}\n"));
  const Job hose = read_job(scratch.write("b.yaml", rig + "dresspack: spot_welding\n"));
  const LearnedUnder a = learned_under({&alone}), b = learned_under({&hose});
  REQUIRE(a.cables.size() == 1);
  REQUIRE(b.cables.size() == 1);
  CHECK(a.cables[0].construction == b.cables[0].construction);
  CHECK(a.cables[0].friction == b.cables[0].friction);
  CHECK(a.cables[0].hose == "");
  CHECK(b.cables[0].hose == "spot_welding");
  Job job = hose;
  job.calibration.emplace().under = a;
  for (const char* name : {"friction_inside", "play", "slack", "strength"}) {
    LearnedParameter parameter;
    parameter.name = name;
    parameter.covariance = {1, 0, 0, 0};
    job.calibration->parameters.push_back(parameter);
  }
  CHECK_NOTHROW(check_learned_settings(job));
  leave_out_foreign_parameters(job);
  // A test of a single cable gives no information about the play in a hose.
  CHECK(job.calibration->within.left_out == "no test has the hose spot_welding, for which play is not used");
  CHECK(job.calibration->parameters.size() == 3);
}

namespace {

Job soft_copper(std::vector<std::string> sets = {}) {
  sets.insert(sets.begin(), {"fatigue.material=copper_halved", "strain.slip=friction"});
  return job_from(parse_yaml(sample_job, "test.yaml"), sets);
}

bool knows(const Job& job, const std::string& name) {
  return std::any_of(job.calibration->parameters.begin(), job.calibration->parameters.end(),
                     [&](const LearnedParameter& one) { return one.name == name; });
}

}  // namespace

TEST_CASE("ratings: a job without a calibration starts from what makers state of their cables") {
  const Job job = soft_copper();
  REQUIRE(job.calibration);
  CHECK(job.calibration->typical);
  // All ratings are lower bounds: they can only increase lives.
  CHECK(job.fatigue.strength_factor > 1);
  CHECK(job.fatigue.model_factor > 1);
  CHECK(job.strain.factors ==
        StrainFactors{});  // friction belongs to the single cable: strains do not depend on ratings
  const auto strength = static_cast<Eigen::Index>(index_of(Uncertain::strength));
  CHECK(knowledge_of(job).mean[strength] > 0);
  CHECK(knowledge_of(job).covariance(strength, strength) < 1);
  // The resolved job reads back unchanged and does not apply the ratings twice.
  CHECK(job_text(job_from(parse_yaml(job_text(job), "elsewhere.yaml"))) == job_text(job));
  for (const char* without : {"uncertainty.ratings=none", "uncertainty.enabled=false", "fatigue.stress=elastic"}) {
    const Job plain = soft_copper({without});
    INFO(without);
    CHECK(!plain.calibration);
    CHECK(plain.fatigue.strength_factor == 1);
    CHECK(plain.strain.factors == StrainFactors{});
  }
  // In a hose without parts nothing slips, so that strain.slip excludes no rating.
  Node bare = parse_yaml(sample_job, "test.yaml");
  std::erase_if(bare["dresspack"].entries, [](const Entry& entry) { return entry.key == "components"; });
  std::erase_if(bare.entries, [](const Entry& entry) { return entry.key == "strain"; });
  const Job hose = job_from(bare);
  CHECK((!hose.calibration && hose.uncertainty.ratings_left_out.empty()));
  // Only ratings that a setting excludes leave a trace in the job, for a warning.
  CHECK(soft_copper({"uncertainty.ratings=none"}).uncertainty.ratings_left_out.empty());
  const Job elastic = soft_copper({"fatigue.stress=elastic"});
  CHECK(elastic.uncertainty.ratings_left_out == "fatigue.stress: cyclic (this job has elastic)");
  CHECK(job_text(job_from(parse_yaml(job_text(elastic), "elsewhere.yaml"))) == job_text(elastic));
  // A key that is set later also takes them out of the resolved job.
  for (const char* without : {"uncertainty.ratings=none", "uncertainty.enabled=false"}) {
    const Job later = job_from(parse_yaml(job_text(job), "elsewhere.yaml"), {without});
    INFO(without);
    CHECK(job_text(later) == job_text(soft_copper({without})));
  }
}

TEST_CASE("ratings: a key that is changed in a resolved job has the same effect as in the job itself") {
  const std::string resolved = job_text(soft_copper());
  const auto changed = [&](const std::string& set) { return job_from(parse_yaml(resolved, "elsewhere.yaml"), {set}); };
  for (const char* set : {"uncertainty.strength=1.5", "uncertainty.model=1", "fatigue.model_factor=2",
                          "fatigue.strength_factor=1.1", "fatigue.mean_stress=morrow", "fatigue.scatter_shared=0.6"}) {
    INFO(set);
    CHECK(job_text(changed(set)) == job_text(soft_copper({set})));
  }
  const Job aluminium = changed("fatigue.material=aluminium_7070_t6");
  CHECK(!knows(aluminium, "strength"));
  CHECK(aluminium.fatigue.strength_factor == 1);
  CHECK(knows(aluminium, "model"));
}

TEST_CASE("ratings: what a job states itself stands") {
  const Job key = soft_copper({"fatigue.strength_factor=1.1"});
  CHECK(key.fatigue.strength_factor == 1.1);
  CHECK(!knows(key, "strength"));
  CHECK(knows(key, "model"));
  // A number has several spellings.
  const Job plain = soft_copper();
  const std::string median = fmt::format("fatigue.strength_factor={}0", plain.fatigue.strength_factor);
  CHECK(job_text(soft_copper({"fatigue.strength_factor=1.0", "fatigue.slope_change=0.0"})) == job_text(plain));
  CHECK(job_text(job_from(parse_yaml(job_text(plain), "elsewhere.yaml"), {median})) == job_text(plain));
  CHECK_THAT(message_of([] { soft_copper({"simulation.segmnts=5"}); }), !Catch::Contains("\n"));
  const Job deviation = soft_copper({"uncertainty.strength=1.1"});
  const auto strength = static_cast<Eigen::Index>(index_of(Uncertain::strength));
  CHECK(deviation.fatigue.strength_factor == 1);
  CHECK(knowledge_of(deviation).covariance(strength, strength) == Approx(std::pow(std::log(1.1) / std::log(1.3), 2)));
  // For wires of a metal that no rated cable has, only the other parameters apply.
  const Job aluminium = soft_copper({"fatigue.material=aluminium_7070_t6"});
  CHECK(!knows(aluminium, "strength"));
  CHECK(knows(aluminium, "model"));
}
