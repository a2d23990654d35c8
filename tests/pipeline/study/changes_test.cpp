#include "pipeline/study/changes.h"

#include "pipeline/settings/document.h"
#include "tests/catch.h"

namespace dresslife::pipeline {
namespace {

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

}  // namespace
}  // namespace dresslife::pipeline
