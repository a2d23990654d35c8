#include "pipeline/study/changes.h"

#include "pipeline/job/job.h"
#include "pipeline/settings/document.h"
#include "tests/catch.h"
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
  CHECK(between("a: {old: 1}\n", "a: {new: {b: 1, c: 2}}\n") ==
        Lines{"a.old 1 -> nothing", "a.new nothing -> 2 keys"});
  CHECK(between("clamp: {at: [0, 1, 2]}\n", "clamp: {at: [0, 1, 3]}\n") ==
        Lines{"clamp.at [0, 1, 2] -> [0, 1, 3]"});
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

}  // namespace
}  // namespace dresslife::pipeline
