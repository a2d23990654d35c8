#include "pipeline/study/changes.h"

#include "pipeline/job/job.h"
#include "pipeline/settings/document.h"
#include "tests/catch.h"
#include "tests/pipeline/sample_life.h"
#include "tests/pipeline/scratch.h"

namespace dresslife::pipeline {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> between(const std::string& was, const std::string& now) {
  return changed_keys(parse_yaml(was, "was"), parse_yaml(now, "now"));
}
using Lines = std::vector<std::string>;

TEST_CASE("changes: of equal settings none, whatever their order") {
  CHECK(between("a: 1\nb: {c: [1, 2], d: x}\n", "b: {d: x, c: [1, 2]}\na: 1\n").empty());
}

TEST_CASE("changes: keys by their paths, in the order of the settings as they were") {
  CHECK(between("routing: {free_length_m: 2.035}\nfatigue: {stress: cyclic}\n",
                "fatigue: {stress: elastic}\nrouting: {free_length_m: 2.1}\n") ==
        Lines{"routing.free_length_m 2.035 -> 2.1", "fatigue.stress cyclic -> elastic"});
  CHECK(between("a: {old: 1}\n", "a: {new: {b: 1, c: 2}}\n") == Lines{"a.old 1 -> nothing", "a.new nothing -> 2 keys"});
  CHECK(between("clamp: {at: [0, 1, 2]}\n", "clamp: {at: [0, 1, 3]}\n") == Lines{"clamp.at [0, 1, 2] -> [0, 1, 3]"});
  CHECK(between("factor: 0.6129078387471198\n", "factor: 1\n") == Lines{"factor 0.612908 -> 1"});
  CHECK(between("factor: 1.0000000001\n", "factor: 1\n") == Lines{"factor 1.0000000001 -> 1"});
}

TEST_CASE("changes: of lists their items where there are as many, else their lengths") {
  CHECK(between("steps: [{dwell_s: 0}, {dwell_s: 0}]\n", "steps: [{dwell_s: 0}, {dwell_s: 2}]\n") ==
        Lines{"steps[2].dwell_s 0 -> 2"});
  CHECK(between("steps: [{a: 0}, {a: 0}]\n", "steps: [{a: 0}]\n") == Lines{"steps 2 entries -> 1 entries"});
  CHECK(between("wires: [[1, 2], [3]]\n", "wires: [[1, 2], [4]]\n") == Lines{"wires[2] [3] -> [4]"});
}

TEST_CASE("changes: a search ends when a file that its jobs read changes, goes or comes, and names it") {
  const Scratch scratch;
  Job job;
  job.motion.program = scratch.write("weld.src", "DEF weld()\n grip()\nEND\n");
  scratch.write("weld.dat", "DEFDAT weld\nENDDAT\n");
  const FilesAtStart files({std::make_shared<const Job>(job)});
  const auto ended = [&]() -> std::string {
    try {
      files.check();
    } catch (const FilesChanged& change) {
      return change.what();
    }
    return "";
  };
  const std::string correct = " during the search; let nothing change it meanwhile, then run again";
  scratch.write("other.src", "DEF other()\nEND\n");  // the program does not call it
  CHECK(ended().empty());
  scratch.write("grip.src", "DEF grip()\nEND\n");
  CHECK(ended() == (scratch / "grip.src").string() + ": error: came beside the program" + correct);
  fs::remove(scratch / "grip.src");
  CHECK(ended().empty());
  scratch.write("weld.dat", "DEFDAT weld\n;other\nENDDAT\n");
  CHECK(ended() == (scratch / "weld.dat").string() + ": error: has changed" + correct);
  fs::remove(scratch / "weld.dat");
  CHECK(ended() == (scratch / "weld.dat").string() + ": error: was removed" + correct);
}

TEST_CASE(
    "changes: files and programs of a stale job are compared with those of its receipts, of the last stages that belong together") {
  const Scratch scratch;
  Study study{"s", {}, Keep::all};
  const StudyPlaces places{scratch / "s", scratch / "bin"};
  const fs::path folder = places.job("one");
  fs::create_directories(folder), fs::create_directories(places.programs);
  study.jobs.push_back({"one", nullptr, ""});
  scratch.write("s/one/job.yaml", "a: 1\n");
  const auto file = [&](const std::string& name, const std::string& text) {
    return Digests().of(scratch.write(name, text));
  };
  using Made = std::vector<std::pair<std::string, std::string>>;
  const std::array<Made, stage_count> made{
      Made{{"dresslife-sim", file("bin/dresslife-sim", "1")}, {"../../weld.src", file("weld.src", "DEF")}},
      Made{{"dresslife-strain", file("bin/dresslife-strain", "2")}},
      Made{{"dresslife-fatigue", file("bin/dresslife-fatigue", "3")}}};
  const auto note = [&](std::size_t stage, const std::string& input, const std::string& output) {
    Receipt receipt{"recipe", input, output, {}};
    receipt.made_with = made[stage];
    write_receipt(folder / files_of_stage(stage).receipt, receipt, scratch.write("s/one/output", "x"));
  };
  note(0, "-", "motion"), note(1, "motion", "strain"), note(2, "strain", "life");
  const auto changed = [&] {
    std::vector<JobState> states(1);
    states[0].has_last = true;
    report_changes(study, places, states);
    return states[0].changed;
  };
  const std::string nothing = "its settings have changed (keep: lives keeps no old ones)",
                    weld = (scratch / "weld.src").string();
  CHECK(changed() == nothing);
  scratch.write("weld.src", "DEF weld");
  CHECK(changed() == weld + " has changed");
  fs::remove(scratch / "weld.src");
  CHECK(changed() == weld + " is gone");
  scratch.write("weld.src", "DEF");
  fs::create_directories(scratch / "deep/below");
  fs::create_directory_symlink(scratch / "s", scratch / "deep/below/link");
  std::vector<JobState> linked(1);
  linked[0].has_last = true;
  report_changes(study, {scratch / "deep/below/link", places.programs}, linked);
  CHECK(linked[0].changed == nothing);
  fs::remove(scratch / "weld.src");
  scratch.write("bin/dresslife-fatigue", "4"), scratch.write("bin/dresslife-sim", "4"),
      scratch.write("bin/dresslife-strain", "4");
  CHECK(changed() ==
        weld + " is gone; dresslife-sim is another program; dresslife-strain is another program; and 1 more");
  note(0, "-", "motion of another run");  // the simulation ran again since
  CHECK(changed() == "dresslife-strain is another program; dresslife-fatigue is another program");
}

TEST_CASE("changes: keys of names and sources are named last, as they change no life") {
  const Scratch scratch;
  Study study{"s", {}, Keep::all};
  const StudyPlaces places{scratch / "s", scratch / "bin"};
  fs::create_directories(places.job("one"));
  study.jobs.push_back({"one", nullptr, ""});
  SampleLife life;
  life.segments = 4, life.lines = 1, life.samples = 3;
  life.job = "robot: {name: a, source: b}\nfatigue: {source: c}\nstrain: {gate: 1, slip: free}\n";
  write_sample_life(places.life("one"), life);
  scratch.write("s/one/job.yaml",
                "robot: {name: z, source: z}\nfatigue: {source: z}\nstrain: {gate: 2, slip: stick}\n");
  std::vector<JobState> states(2);
  states[0].has_last = true;
  report_changes(study, places, states);
  CHECK(states[0].changed == "strain.gate 1 -> 2; strain.slip free -> stick; robot.name a -> z; and 2 more");
}

TEST_CASE("changes: a job whose output is gone or replaced by a link is stale because of this file") {
  const Scratch scratch;
  Study study{"s", {}, Keep::all};
  const StudyPlaces places{scratch / "s", scratch / "bin"};
  const fs::path folder = places.job("one");
  fs::create_directories(folder / ".stage");
  study.jobs.push_back({"one", nullptr, ""});
  SampleLife life;
  life.segments = 4, life.lines = 1, life.samples = 3;
  life.job = "a: 1\n";
  write_sample_life(places.life("one"), life);
  scratch.write("s/one/job.yaml", "a: 1\n");
  scratch.write("s/one/strain.h5", "x");
  write_receipt(folder / files_of_stage(1).receipt, {"recipe", "motion", "strain", {}}, folder / "strain.h5");
  const auto changed = [&] {
    std::vector<JobState> states(1);
    states[0].has_last = true;
    report_changes(study, places, states);
    return states[0].changed;
  };
  CHECK(changed() == "its last run did not end");  // the first stage has no receipt
  fs::rename(folder / "strain.h5", scratch / "strain.h5");
  CHECK(changed() == "strain.h5 is gone");
  fs::create_symlink(scratch / "strain.h5", folder / "strain.h5");
  CHECK(changed() == "strain.h5 is no plain file");
}

}  // namespace
}  // namespace dresslife::pipeline
