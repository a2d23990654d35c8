// A job with a list of dresspacks: read, checked, changed and written.
#include <algorithm>

#include "pipeline/job/job.h"
#include "pipeline/resolve/job_text.h"
#include "tests/catch.h"
#include "tests/pipeline/sample_job.h"
#include "tests/pipeline/scratch.h"

using namespace dresslife::pipeline;

namespace {

std::string block(const std::string& from, const std::string& to) {
  const std::size_t begin = sample_job.find(from);
  return sample_job.substr(begin, sample_job.find(to) - begin);
}

/// Returns a block of the sample job with the indentation of an item of the list.
std::string indented(const std::string& text) {
  std::string result;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = text.find('\n', begin) + 1;
    result += "    " + text.substr(begin, end - begin);
    begin = end;
  }
  return result;
}

const std::string dresspack_block = block("dresspack:", "routing:"), routing_block = block("routing:", "simulation:");

std::string item(const std::string& name) {
  return "  - name: " + name + "\n" + indented(dresspack_block) + indented(routing_block);
}

/// Returns the sample job with a list instead of its dresspack.
std::string listed(const std::string& items) {
  return edited(edited(sample_job, dresspack_block, ""), routing_block, "dresspacks:\n" + items);
}
const std::string two = item("main hose") + item("sensor cable");

/// Returns the last place of a needle, "job.yaml:line:column".
std::string place_of_last(const std::string& text, const std::string& needle) {
  const std::size_t at = text.rfind(needle);
  const std::string before = text.substr(0, at);
  return fmt::format("job.yaml:{}:{}", 1 + std::count(before.begin(), before.end(), '\n'),
                     at - (before.rfind('\n') + 1) + 1);
}

Job job_of_text(const std::string& text, const std::vector<std::string>& sets = {}) {
  return job_from(parse_yaml(text, "job.yaml"), sets);
}

TEST_CASE("dresspacks: a list is read item by item") {
  const Job job = job_of_text(listed(two), {"dresspacks.2.routing.free_length_m=0.9"});
  REQUIRE(job.dresspacks.size() == 2);
  CHECK(job.dresspacks[0].name == "main hose");
  CHECK(job.dresspacks[0].routing.free_length == 1.2);
  CHECK(job.dresspacks[1].name == "sensor cable");
  CHECK(job.dresspacks[1].routing.free_length == 0.9);
  CHECK(job.dresspacks[1].dresspack.materials.at(0).name == "copper");
  CHECK(job.dresspacks[1].where.text() == place_of(listed(two), "name: sensor cable", "job.yaml"));
  CHECK(name_among(job, 1) == "sensor cable");
  CHECK(dresspack_words(job, 0) == "dresspack 'main hose'");
  CHECK(material_of(job, "copper").name == "copper");
}

TEST_CASE("dresspacks: the settings read back to the same job, for every stage") {
  for (const std::string& text : {sample_job, listed(item("main hose")), listed(two)}) {
    const Job job = job_of_text(text);
    const std::string echo = job_text(job);
    const Job again = job_from(parse_yaml(echo, "echo"));
    CHECK(job_text(again) == echo);
    for (const JobPart part : {JobPart::sim, JobPart::strain, JobPart::fatigue})
      CHECK(part_text(again, part) == part_text(job, part));
  }
}

TEST_CASE("dresspacks: two keys of the job are written as two keys, a list as a list") {
  const Job one = job_of_text(sample_job), list = job_of_text(listed(item("main hose")));
  CHECK(name_among(one, 0).empty());
  CHECK(name_among(list, 0).empty());  // a single dresspack needs no name
  CHECK(dresspack_words(list, 0) == "dresspack");
  for (const std::string& text : {job_text(one), part_text(one, JobPart::sim)}) {
    CHECK(text.find("\ndresspack:\n") != std::string::npos);
    CHECK(text.find("\nrouting:\n") != std::string::npos);
    CHECK(text.find("dresspacks") == std::string::npos);
  }
  CHECK(part_text(one, JobPart::strain).starts_with("components:\n"));
  CHECK(part_text(one, JobPart::fatigue).starts_with("materials:\n"));
  for (const std::string& text : {job_text(list), part_text(list, JobPart::sim)})
    CHECK(text.find("\ndresspacks:\n") != std::string::npos);
  CHECK(job_text(list).find("\nrouting:\n") == std::string::npos);
}

TEST_CASE("dresspacks: entries of the catalogue are looked up in the list and opened by key paths") {
  const Scratch scratch;
  scratch.write("dresspacks/hose.yaml",
                "name: test hose\nsource: made for the tests\ndiameter_mm: 60\nmass_kg_per_m: 2.5\n"
                "bending_stiffness_Nm2: 5\ntorsional_stiffness_Nm2: 4\naxial_stiffness_N: 1e5\n"
                "damping_time_ms: 10\ndamping_source: guessed\n");
  const std::string text =
      listed("  - name: main hose\n    dresspack: hose\n" + indented(routing_block) + item("sensor cable"));
  const auto file = scratch.write("job.yaml", text);
  const Job job = read_job(file, {"strain.slip=free", "dresspacks.1.dresspack.diameter_mm=50"});
  CHECK(job.dresspacks[0].dresspack.diameter == 0.05);
  CHECK(job.dresspacks[0].dresspack.mass_per_length == 2.5);
  CHECK(job.dresspacks[1].dresspack.diameter == 0.06);
  const Job changed = read_job(file, {"strain.slip=free", "dresspacks.2.dresspack=hose"});
  CHECK(changed.dresspacks[1].dresspack.components.empty());
}

TEST_CASE("dresspacks: what is wrong with the list is reported where it stands") {
  const std::string list = listed(two);
  const auto check = [](const std::string& text, const std::string& needle, const std::string& message) {
    INFO(message);
    CHECK(message_of([&] { job_of_text(text); }) == place_of_last(text, needle) + ": error: " + message);
  };
  const std::string before = "simulation: {segments";
  check(edited(list, before, dresspack_block + before), "name: test hose",
        "both dresspacks and dresspack are given (each of the list has its own dresspack); keep one of the "
        "two");
  check(edited(list, before, routing_block + before), "free_length_m",
        "both dresspacks and routing are given (each of the list has its own routing); keep one of the two");
  check(edited(edited(sample_job, dresspack_block, ""), routing_block, ""), "robot:",
        "dresspack is missing (and there is no list dresspacks); give dresspack and routing, or a list "
        "dresspacks of name, dresspack, routing\n" +
            place_of_last(sample_job, "robot:") +
            ": error: routing is missing (and there is no list dresspacks); give dresspack and routing, or a list "
            "dresspacks of name, dresspack, routing");
  check(edited(sample_job, routing_block, ""), "robot:",
        "routing is missing (and there is no list dresspacks); give dresspack and routing, or a list "
        "dresspacks "
        "of name, dresspack, routing");
  const std::string empty = edited(edited(sample_job, dresspack_block, ""), routing_block, "dresspacks: []\n");
  check(empty, "[]\n", "dresspacks holds no dresspack; write a list of name, dresspack and routing");
  check(edited(list, "sensor cable", "main hose"), "name: main hose",
        "two dresspacks are named 'main hose'; give each another name");
  check(edited(list, "sensor cable", "a/b"), "name: a/b",
        "name 'a/b' holds a '/'; choose another: it begins the paths of the dresspack's wires");
  check(edited(list, "sensor cable", "''"), "''", "dresspacks[2].name must be text; give A unique name without '/'");
  CHECK_THAT(message_of([&] { job_of_text(list, {"motion={rig: {kind: torsion, twist_deg_per_m: 90}}"}); }),
             Catch::Contains("dresspacks is given, and motion.rig deforms one dresspack; give one with the key"));
  CHECK(message_of([&] { job_of_text(list, {"motion={clamp_poses: poses.csv}"}); })
            .find("motion.clamp_poses brings the clamps of one dresspack (there are 2); describe the motion by a "
                  "robot, or keep one dresspack") != std::string::npos);
}

TEST_CASE("dresspacks: what they share must agree") {
  const Job job = job_of_text(listed(two));
  CHECK(job.dresspacks[1].routing.mounting_pose.size() == 2);
  CHECK(message_of([&] { job_of_text(listed(two), {"dresspacks.2.routing.mounting_pose_deg=[0, 8]"}); })
            .find("mounting_pose_deg differs from that of dresspack 'main hose' (all are clamped in one pose); "
                  "give the same, or give it once") != std::string::npos);
  const std::string soft =
      "dresspacks.2.dresspack.materials=[{name: copper, source: guessed, youngs_modulus_GPa: 100, "
      "fatigue_strength_MPa: 500, fatigue_strength_exponent: -0.1, fatigue_ductility: 0.5, "
      "fatigue_ductility_exponent: -0.6}]";
  CHECK(message_of([&] { job_of_text(listed(two), {soft}); })
            .find("material 'copper' is another than that of the dresspack before; give one of the two another "
                  "name") != std::string::npos);
  // The number of slip levels is that of the deepest dresspack.
  CHECK(message_of([&] {
          job_of_text(listed(two), {"strain.slip=[stick, free, free]"});
        }).find("strain.slip lists 3 levels (the dresspack has 2)") != std::string::npos);
}

}  // namespace
