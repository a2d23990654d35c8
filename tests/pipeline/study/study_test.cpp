#include "pipeline/study/study.h"

#include <filesystem>
#include <set>

#include "pipeline/job/job.h"
#include "pipeline/resolve/job_text.h"
#include "tests/catch.h"
#include "tests/pipeline/sample_job.h"
#include "tests/pipeline/scratch.h"

using namespace dresslife::pipeline;
namespace fs = std::filesystem;

namespace {

Study study_of(const Scratch& scratch, const std::string& text, const std::vector<std::string>& sets = {}) {
  scratch.write("job.yaml", sample_job);
  return read_study(scratch.write("my study.yaml", text), sets);
}

std::vector<std::string> names(const Study& study) {
  std::vector<std::string> list;
  for (const StudyJob& job : study.jobs) list.push_back(job.name);
  return list;
}
using Names = std::vector<std::string>;

std::string refusal(const std::string& text) {
  const Scratch scratch;
  const std::string message = message_of([&] { study_of(scratch, text); });
  const std::string file = (scratch / "my study.yaml").string();
  return message.starts_with(file) ? "study" + message.substr(file.size()) : message;
}

TEST_CASE("study: every combination of the varied values becomes a job, the last key fastest") {
  const Scratch scratch;
  const Study study = study_of(
      scratch, "base: job.yaml\nvary:\n  fatigue.stress: [cyclic, elastic]\n  simulation.segments: [20, 40]\n");
  CHECK(study.name == "my_study");
  CHECK(names(study) ==
        Names{"cyclic-segments=20", "cyclic-segments=40", "elastic-segments=20", "elastic-segments=40"});
  CHECK(study.jobs[2].job->fatigue.stress == Stress::elastic);
  CHECK(study.jobs[2].job->simulation.segments == 20);
  for (const StudyJob& job : study.jobs) CHECK(job.failure.empty());
}

TEST_CASE("study: named changes are varied, too") {
  const Scratch scratch;
  const Study study =
      study_of(scratch,
               "name: other\nbase: job.yaml\njobs:\n  stiff: {dresspack.bending_stiffness_Nm2: 8}\n  plain:\n"
               "vary: {strain.slip: [free, stick]}\n");
  CHECK(study.name == "other");
  CHECK(names(study) == Names{"stiff-free", "stiff-stick", "plain-free", "plain-stick"});
  CHECK(study.jobs[1].job->dresspacks[0].dresspack.bending_stiffness == 8);
  CHECK(study.jobs[2].job->dresspacks[0].dresspack.bending_stiffness == 5);
}

TEST_CASE("study: each job has the stiffness of its own construction, in any order of the jobs") {
  const Scratch scratch;
  const Study study =
      study_of(scratch,
               "base: irb6640_spot_welding\njobs:\n  usual: {}\n  also: {simulation.segments: 32}\n"
               "  warm: {cell.temperature_C: 60}\n  full: {dresspack.core_bending_stiffness_Nm2: 20}\n  again: {}\n");
  for (const StudyJob& job : study.jobs) REQUIRE(job.failure == "");
  const auto hose = [&](std::size_t k) { return study.jobs[k].job->dresspacks[0].dresspack; };
  for (const std::size_t k : {1, 4}) {
    CHECK(hose(k).mass_per_length == hose(0).mass_per_length);
    CHECK(hose(k).bending_stiffness == hose(0).bending_stiffness);
    CHECK(hose(k).torsional_stiffness == hose(0).torsional_stiffness);
    CHECK(hose(k).axial_stiffness == hose(0).axial_stiffness);
    CHECK(hose(k).bending_friction.size() == hose(0).bending_friction.size());
  }
  CHECK_FALSE(hose(0).bending_friction.empty());
  CHECK(hose(2).bending_stiffness < hose(0).bending_stiffness);
  CHECK(hose(3).bending_stiffness > hose(0).bending_stiffness + 1);
}

TEST_CASE("study: a varied section keeps the keys that a named change sets in it") {
  const Scratch scratch;
  const Study study =
      study_of(scratch,
               "base: job.yaml\njobs:\n  fine: {simulation.segments: 40}\n  plain:\n"
               "vary: {simulation: [{segments: 20, time_step_ms: 2}, {segments: 20, time_step_ms: 4}]}\n");
  REQUIRE(study.jobs.size() == 4);
  for (const StudyJob& job : study.jobs) REQUIRE(job.failure.empty());
  CHECK(study.jobs[0].job->simulation.segments == 40);
  CHECK(study.jobs[0].job->simulation.time_step == 0.002);
  CHECK(study.jobs[1].job->simulation.time_step == 0.004);
  CHECK(study.jobs[2].job->simulation.segments == 20);
}

TEST_CASE("study: a base alone is one job with the study's name") {
  const Scratch scratch;
  const Study study = study_of(scratch, "base: job.yaml\n");
  CHECK(names(study) == Names{"my_study"});
  CHECK(job_text(*study.jobs[0].job) == job_text(read_job(scratch / "job.yaml")));
}

TEST_CASE("study: jobs are named by their values, fit for a folder") {
  const Scratch scratch;
  CHECK(names(study_of(scratch, "base: job.yaml\nvary: {simulation.contact: [true, false]}\n")) ==
        Names{"contact=true", "contact=false"});
  CHECK(names(study_of(scratch, "base: job.yaml\nvary: {routing.tool_clamp.direction: [[1, 0, 0], [0, 0, 1]]}\n")) ==
        Names{"direction=1", "direction=2"});
  CHECK(names(study_of(scratch, "base: job.yaml\nvary: {routing.free_length_m: [1.2, 1.5e0]}\n")) ==
        Names{"free_length_m=1.2", "free_length_m=1.5e0"});
  CHECK(names(study_of(scratch, "base: job.yaml\njobs: {'a b/c': {}, ..: {}, .hidden: {}}\n")) ==
        Names{"a_b_c", "_.", "_hidden"});
  CHECK(names(study_of(scratch, "base: job.yaml\nname: ..\n")) == Names{"_."});
  CHECK(study_of(scratch, "base: job.yaml\nname: ''\n").name == "my_study");
}

TEST_CASE("study: a job that cannot be run is reported with its place, the others stand") {
  const Scratch scratch;
  const std::string text = "base: job.yaml\nvary:\n  simulation.segments: [20, 3, 40]\n";
  const Study study = study_of(scratch, text);
  REQUIRE(study.jobs.size() == 3);
  CHECK(study.jobs[0].failure.empty());
  CHECK(study.jobs[2].failure.empty());
  CHECK(study.jobs[1].failure == place_of(text, "3, 40", (scratch / "my study.yaml").string()) +
                                     ": error: simulation.segments is 3 (must be 4 .. 2000); give the number of "
                                     "rigid segments of each dresspack");
}

TEST_CASE("study: --set comes after the study's own changes") {
  const Scratch scratch;
  const Study study = study_of(scratch, "base: job.yaml\nvary: {simulation.segments: [20, 40]}\n",
                               {"simulation.segments=60", "fatigue.stress=elastic"});
  CHECK(study.jobs[0].job->simulation.segments == 60);
  CHECK(study.jobs[1].job->fatigue.stress == Stress::elastic);
}

TEST_CASE("study: names of jobs state no values that the jobs do not have") {
  const std::string why =
      ": one would replace the other, and names of jobs would state values that the jobs do not have; keep one of the two";
  const Scratch scratch;
  const std::string file = (scratch / "my study.yaml").string(), head = "base: job.yaml\n";
  const auto refused = [&](const std::string& text, const std::string& path, const std::string& at,
                           const std::string& other) {
    CHECK(message_of([&] { study_of(scratch, head + text); }) == fmt::format("{}: error: {} is also set at {}{}",
                                                                             place_of(head + text, at, file), path,
                                                                             place_of(head + text, other, file), why));
  };
  const std::string small = "jobs:\n  small: {simulation.segments: 20}\n  big: {simulation.segments: 40}\n";
  refused(small + "vary: {simulation.segments: [30]}\n", "simulation.segments", "simulation.segments: [30",
          "simulation.segments: 20");
  refused(small + "sample: {jobs: 3, keys: {simulation.segments: !uniform [20, 60]}}\n", "simulation.segments",
          "simulation.segments: !", "simulation.segments: 20");
  refused("jobs: {a: {simulation: {segments: 20}}}\nvary: {simulation.segments: [30]}\n", "simulation.segments",
          "simulation.segments:", "simulation:");
  refused("vary: {simulation.segments: [20, 30]}\nsample: {jobs: 3, keys: {simulation.segments: !choice [20, 60]}}\n",
          "simulation.segments", "simulation.segments: [", "simulation.segments: !");
  const std::string sections = "simulation: [{segments: 20}, {segments: 40}]", keys = "simulation.segments: [30, 50]";
  for (const std::string& both : {sections + ", " + keys, keys + ", " + sections})
    refused("vary: {" + both + "}\n", "simulation.segments", "simulation.segments", "simulation:");
  CHECK(names(study_of(scratch, head + "vary: {simulation: [{segments: 20}], simulation.time_step_ms: [2, 4]}\n"))
            .size() == 2);
}

TEST_CASE("study: --set of a varied key is refused, and notes name the jobs whose own value it replaces") {
  const Scratch scratch;
  const auto notes_of = [&](const std::string& text, const std::string& set) {
    scratch.write("job.yaml", sample_job);
    return replaced_by_sets(scratch.write("study.yaml", "base: job.yaml\n" + text), {"strain.gate=0.001", set});
  };
  const auto refused = [&](const std::string& text, const std::string& set, const std::string& key) {
    CHECK_THAT(message_of([&] { notes_of(text, set); }),
               Catch::StartsWith(fmt::format("--set {}: error: replaces the values of {}, which the study varies: the "
                                             "names of its jobs would state values that the jobs do not have; leave it "
                                             "out, or change the values at ",
                                             set, key)));
  };
  const std::string varied = "vary: {simulation.segments: [20, 40]}\n";
  refused(varied, "simulation.segments=30", "simulation.segments");
  refused(varied, "simulation={segments: 30}", "simulation.segments");
  refused("sample: {jobs: 3, keys: {simulation.segments: !uniform [20, 60]}}\n", "simulation.segments=30",
          "simulation.segments");
  const std::string sections = "vary: {simulation: [{segments: 20}, {segments: 40}]}\n";
  refused(sections, "simulation.segments=30", "simulation");
  CHECK(notes_of(sections, "simulation.time_step_ms=2") ==
        "note: --set simulation.time_step_ms changes all values of simulation, which the study varies\n");
  const std::string named =
      "jobs:\n  a: {simulation.segments: 20}\n  b: {simulation: {segments: 30}}\n  c: {}\n  d: {simulation.segments: 40}\n"
      "  e: {simulation.segments: 50}\n";
  CHECK(notes_of(named, "simulation.segments=60") ==
        "note: --set simulation.segments replaces the own value of a, b, d and 1 more jobs\n");
  CHECK(notes_of(named, "simulation.time_step_ms=2").empty());
  CHECK(notes_of(varied, "simulation.segments_=2").empty());
  CHECK(replaced_by_sets(scratch / "job.yaml", {"simulation.segments=30"}).empty());
}

TEST_CASE("study: what is no study is refused where it stands") {
  CHECK(refusal("") == "study:1:1: error: holds no study; write base: and vary: or jobs:");
  CHECK(refusal("vary: {a: [1]}\n") ==
        "study:1:1: error: base is missing; add 'base: ...': a job of config/jobs, a file, or the job itself");
  CHECK(refusal("base: job.yaml\nvery: {}\n") ==
        "study:2:1: error: unknown key 'very' of a study; did you mean 'vary'?");
  CHECK(refusal("base: job.yaml\nvary: [a]\n") ==
        "study:2:7: error: vary must be a map of keys to lists of values; write 'vary: {KEY.PATH: [A, B]}'");
  CHECK(refusal("base: job.yaml\nvary: {a.b: 3}\n") ==
        "study:2:13: error: vary.a.b must be a list of values; write [A, B, ...]");
  CHECK(refusal("base: job.yaml\nvary: {a.b: []}\n") ==
        "study:2:13: error: vary.a.b must be a list of values; write [A, B, ...]");
  CHECK(refusal("base: job.yaml\njobs: {a: 3}\n") ==
        "study:2:11: error: job 'a' must be a map of keys to values; write {KEY.PATH: VALUE}");
  CHECK(refusal("base: job.yaml\nvary: {fatigue.stress: [cyclic, cyclic]}\n") ==
        "study:1:1: error: two jobs are named 'cyclic'; give each combination another name");
  CHECK(
      refusal("base: nowhere\n").find("study:1:7: error: 'nowhere' is not in the catalogue (config/jobs); one of: ") ==
      0);
  std::string many = "base: job.yaml\nvary:\n";
  for (const char* key : {"a", "b", "c", "d", "e", "f"}) many += std::string("  ") + key + ": [0,1,2,3,4,5,6,7,8,9]\n";
  CHECK(refusal(many) == "study:8:3: error: the study has more than 100000 jobs; split it");
}

TEST_CASE("study: jobs that differ in their routing are those that are read alone, also if some are refused") {
  const Scratch scratch;
  const std::string head = "base: irb6640_spot_welding\n";
  const std::string changes[] = {"{routing.free_length_m: 2.05}",
                                 "{routing.tool_clamp.bend_relief.bending_stiffness_Nm2: 500}",  // causes a warning
                                 "{routing.free_length_m: 2.1, dresspack.components.1.slack_percent: 2}",
                                 "{routing.free_length_m: 2.15, dresspack.components.1.slack_percent: 2}",
                                 "{routing.free_length_m: 0.3, routing.tool_clamp.link: link_5}",
                                 "{routing.free_length_m: -2}",
                                 "{routing.mounting_pose_deg: [0, 0]}",
                                 "{routing.side: left, simulation.segments: 32}",
                                 "{routing.side: right, simulation.segments: 32}",
                                 "{routing.base_clamp.position_m: [0, 0, 90]}",
                                 "{routing.free_length_m: 2.05, motion.dwell_s: 1}"};
  std::string together = head + "jobs:\n";
  // Every job has in its own study the line that it has in the common one, because messages name the line.
  for (const std::string& change : changes) together += fmt::format("  j{}: {}\n", &change - changes, change);
  const Study all = read_study(scratch.write("study.yaml", together), {"routing.tool_end=clamped"});
  REQUIRE(all.jobs.size() == std::size(changes));
  std::size_t refused = 0, doubted = 0;
  for (std::size_t k = 0; k < all.jobs.size(); ++k) {
    INFO(changes[k]);
    const std::string alone = fmt::format("{}jobs:\n{}  j{}: {}\n", head, std::string(k, '\n'), k, changes[k]);
    const Study one = read_study(scratch.write("study.yaml", alone), {"routing.tool_end=clamped"});
    CHECK(all.jobs[k].failure == one.jobs[0].failure);
    refused += !one.jobs[0].failure.empty();
    REQUIRE((all.jobs[k].job == nullptr) == (one.jobs[0].job == nullptr));
    if (!one.jobs[0].job) continue;
    const Job &mine = *all.jobs[k].job, &his = *one.jobs[0].job;
    CHECK(job_text(mine) == job_text(his));
    CHECK(mine.dresspacks[0].routing.where.text() == his.dresspacks[0].routing.where.text());
    CHECK(mine.motion.left_out == his.motion.left_out);
    doubted += std::ranges::any_of(his.motion.left_out, [](const Warning& of) {
      return of.line().find("bending_stiffness_Nm2 is 500") != std::string::npos;
    });
    for (const JobPart part : {JobPart::sim, JobPart::strain, JobPart::fatigue})
      CHECK(part_text(mine, part) == part_text(his, part));
  }
  CHECK(refused >= 3);
  CHECK(doubted == 1);
}

TEST_CASE("study: jobs from pieces of other jobs are those that are read alone, also if some are refused") {
  const Scratch scratch;
  struct Varied {
    std::string key, values[2];
  };
  const Varied varied[] = {{"motion", {"spot_robot_1", "easy"}},
                           {"robot.joints.2.upper_deg", {"20", "85"}},  // the motions need more than 20
                           {"routing.free_length_m", {"2.05", "0.3"}},
                           {"simulation.segments", {"32", "64"}},
                           {"dresspack.diameter_mm", {"80", "75"}}};
  const std::size_t count = std::size_t{1} << std::size(varied);
  const std::vector<std::string> sets{"simulation.sample_rate_Hz=20"};
  std::string together = "base: irb6640_spot_welding\nvary:\n";
  for (const Varied& of : varied) together += fmt::format("  {}: [{}, {}]\n", of.key, of.values[0], of.values[1]);
  const fs::path file = scratch.write("study.yaml", together);
  const Study all = read_study(file, sets);
  REQUIRE(all.jobs.size() == count);
  PieceTexts texts(scratch / "runs");
  std::size_t refused = 0;
  std::set<std::size_t> dresspacks;
  for (std::size_t k = 0; k < count; ++k) {
    INFO(all.jobs[k].name);
    std::string alone = "base: irb6640_spot_welding\nvary:\n";  // each value at the same place as in the common study
    for (std::size_t v = 0; v < std::size(varied); ++v) {
      const bool second = (k >> (std::size(varied) - 1 - v)) % 2 == 1;
      alone += fmt::format("  {}: [{}{}]\n", varied[v].key,
                           std::string(second ? varied[v].values[0].size() + 2 : 0, ' '), varied[v].values[second]);
    }
    scratch.write("study.yaml", alone);
    const StudyJob &mine = all.jobs[k], his = read_study(file, sets).jobs.at(0);
    CHECK(mine.name == his.name);
    CHECK(mine.failure == his.failure);
    refused += !his.failure.empty();
    REQUIRE((mine.job == nullptr) == (his.job == nullptr));
    if (!his.job) continue;
    CHECK(job_text(*mine.job) == job_text(*his.job));
    CHECK(mine.job->motion.left_out == his.job->motion.left_out);
    for (const JobPart part : {JobPart::sim, JobPart::strain, JobPart::fatigue})
      CHECK(texts.part_text(mine.job, part) == part_text(*his.job, part));
    CHECK(texts.stored_job_text(mine.job, mine.name) == stored_job_text(*his.job, scratch / "runs" / mine.name));
    dresspacks.insert(mine.job.numbers()[index_of(Piece::rest)]);
  }
  CHECK(refused >= count / 2);
  CHECK(refused < count);
  CHECK(dresspacks.size() < count - refused);  // they are shared
  CHECK_FALSE(dresspacks.contains(0));
}

TEST_CASE(
    "study: a key that a calibration sets belongs to the rest of a job, and a part of a job is divided with care") {
  for (const UncertainParameter& parameter : uncertain_parameters()) {
    CHECK(piece_of(parameter.key) == Piece::rest);
    // job_from_pieces() takes this key of `simulation` from the rest.
    if (parameter.key.starts_with("simulation.")) CHECK(parameter.key == "simulation.stiffness_factor");
  }
  CHECK(piece_of("simulation.segments") == Piece::simulation);
  CHECK(piece_of("motion") == Piece::motion);
  CHECK(piece_of("robot.joints.1.upper_deg") == Piece::robot);
  CHECK(piece_of("routing.side") == Piece::routing);
  CHECK(piece_of("routings") == Piece::rest);
  CHECK_FALSE(piece_of("simulation"));
  CHECK_FALSE(piece_of("dresspacks.1.routing.side"));
}

TEST_CASE("study: a changed copy of a job has no pieces, and a file in the study's folder is named as from each job") {
  const Scratch scratch;
  fs::create_directories(scratch / "runs/study");
  scratch.write("runs/study/weld.csv", "0,0\n1,1\n");
  scratch.write("job.yaml", sample_job);
  Study study = read_study(scratch.write("study.yaml",
                                         "base: job.yaml\nvary:\n  simulation.segments: [20, 30]\n"
                                         "  dresspack.friction_coefficient: [0.2, 0.3]\n"));
  StudyJob& job = study.jobs.at(0);
  REQUIRE(job.job);
  CHECK(job.job.numbers() != PieceNumbers{});
  Job changed = *job.job;
  changed.motion.program = scratch / "runs/study/a/weld.csv";
  PieceTexts texts(scratch / "runs/study");
  const PieceNumbers numbers = job.job.numbers();
  fs::create_directory_symlink(scratch.folder(), scratch / "runs/study/link");
  for (const char* name : {"a", "b", "link"}) {
    CHECK(texts.stored_job_text({std::make_shared<const Job>(changed), numbers}, name) ==
          stored_job_text(changed, scratch / "runs/study" / name));
    changed.motion.program = name == std::string("b") ? scratch / "elsewhere/weld.csv" : changed.motion.program;
  }
  CHECK(texts.stored_job_text({std::make_shared<const Job>(changed), numbers}, "c") ==
        stored_job_text(changed, scratch / "runs/study/c"));
  job.job = std::make_shared<const Job>(changed);
  CHECK(job.job.numbers() == PieceNumbers{});
}

}  // namespace
