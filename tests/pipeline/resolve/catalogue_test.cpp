// Names of the catalogue, `from: NAME`, and --set.
#include <fmt/format.h>

#include "pipeline/base/constants.h"
#include "pipeline/job/job.h"
#include "pipeline/resolve/catalogue.h"
#include "pipeline/resolve/job_text.h"
#include "tests/catch.h"
#include "tests/pipeline/sample_job.h"
#include "tests/pipeline/scratch.h"

namespace dresslife::pipeline {
namespace {

/// Returns a block of the sample job, to be replaced by a catalogue entry.
std::string block_of(const std::string& from, const std::string& to) {
  const std::size_t begin = sample_job.find(from);
  return sample_job.substr(begin, sample_job.find(to) - begin);
}
const std::string robot_block = block_of("robot:", "motion:");
const std::string motion_block = block_of("motion:", "dresspack:");
const std::string dresspack_block = block_of("dresspack:", "routing:");

std::string indented_less(const std::string& block) {
  std::string text;
  for (std::size_t at = block.find('\n') + 1; at < block.size();) {
    const std::size_t end = block.find('\n', at);
    text += block.substr(at + 2, end - at - 1);
    at = end + 1;
  }
  return text;
}

std::string set_error(const std::string& set) {
  return message_of([&] { job_from(parse_yaml(sample_job, "job.yaml"), {set}); });
}
Job with(const std::vector<std::string>& sets) { return job_from(parse_yaml(sample_job, "job.yaml"), sets); }

TEST_CASE("catalogue: an entry is found beside the job and in the folders above it, nearest first") {
  const Scratch scratch;
  scratch.write("config/programs/nod.yaml", edited(indented_less(motion_block), "name: nod", "name: far"));
  const auto job = scratch.write("studies/deep/job.yaml", edited(sample_job, motion_block, "motion: nod\n"));
  CHECK(read_job(job).motion.name == "far");
  scratch.write("studies/programs/nod.yaml", edited(indented_less(motion_block), "name: nod", "name: near"));
  CHECK(read_job(job).motion.name == "near");
}

TEST_CASE("catalogue: an entry may be a file, named relative to who names it") {
  const Scratch scratch;
  scratch.write("other/my.yaml", indented_less(motion_block));
  const auto job = scratch.write("jobs/job.yaml", edited(sample_job, motion_block, "motion: ../other/my.yaml\n"));
  CHECK(read_job(job).motion.name == "nod");
  scratch.write("rig.yaml", "rig: {kind: torsion, twist_deg_per_m: 180}\n");  // a job with a rig needs no routing
  CHECK(read_job(scratch.write("rig_job.yaml", "motion: ./rig.yaml\ndresspack: {cable: sensor_cable}\n")).motion.rig);
  const std::string text = edited(sample_job, motion_block, "motion: absent.yaml\n");
  const auto lost = scratch.write("jobs/lost.yaml", text);
  CHECK(message_of([&] { read_job(lost); }) ==
        place_of(text, "absent", lost.string()) + ": error: there is no file '" +
            (scratch / "jobs/absent.yaml").string() +
            "'; check the path; it counts from the folder of the file that names it");
}

TEST_CASE("catalogue: a path that no system takes is refused like any other") {
  const Scratch scratch;
  const auto job =
      scratch.write("job.yaml", edited(sample_job, motion_block, "motion: " + std::string(300, 'x') + ".yaml\n"));
  CHECK(message_of([&] { read_job(job); }).find("cannot be read (File name too long)") != std::string::npos);
}

TEST_CASE("catalogue: a robot's program may stand where a motion is named") {
  const Scratch scratch;
  scratch.write("jobs/nod.csv", "t_s,joint_1_deg,joint_2_deg\n0,0,0\n1,10,5\n");
  const auto job = scratch.write("jobs/job.yaml", edited(sample_job, motion_block, "motion: nod.csv\n"));
  CHECK(read_job(job).motion.program == scratch / "jobs/nod.csv");
  for (const char* program :
       {"nod.mod", "nod.modx", "nod.prg", "nod.pgf", "nod.src", "nod.ls", "nod.JBI", "nod.script", "nod.urscript"}) {
    scratch.write(std::string("jobs/") + program, "");  // a program is read by the simulation
    scratch.write("jobs/job.yaml", edited(sample_job, motion_block, std::string("motion: ") + program + "\n"));
    CHECK(read_job(job).motion.program == scratch / "jobs" / program);
  }
  scratch.write("jobs/job.yaml", edited(sample_job, motion_block, "motion: nid.csv\n"));
  CHECK(message_of([&] { read_job(job); })
            .find("'nid.csv' is not in the catalogue (config/programs), and there is no file '" +
                  (scratch / "jobs/nid.csv").string() + "'") != std::string::npos);
}

TEST_CASE("catalogue: the shipped entries are always there") {
  const Job job = job_from(parse_yaml(edited(sample_job, dresspack_block, "dresspack: spot_welding\n"), "job.yaml"),
                           {"strain.slip=free"});
  CHECK(job.dresspacks[0].dresspack.diameter == 0.06);
  CHECK(job.dresspacks[0].dresspack.components[0].components[0].components.size() == 5);
  REQUIRE(job.dresspacks[0].dresspack.materials.size() == 3);  // of the wires, the jackets and the hose
  CHECK(job.dresspacks[0].dresspack.materials[0].name == "copper_halved");
}

TEST_CASE("catalogue: a name that is not there is answered with those that are") {
  const std::string text = edited(sample_job, dresspack_block, "dresspack: spot_weldin\n");
  const std::string message = message_of([&] { job_from(parse_yaml(text, "job.yaml")); });
  CHECK(message.starts_with(
      place_of(text, "spot_weldin\n", "job.yaml") +
      ": error: 'spot_weldin' is not in the catalogue (config/dresspacks); did you mean 'spot_welding'? one of: "));
  CHECK(message.find("spot_welding") != std::string::npos);

  const std::string wire = edited(sample_job, "material: copper", "material: coper");
  const std::string answer = message_of([&] { job_from(parse_yaml(wire, "job.yaml")); });
  CHECK(answer.starts_with(
      place_of(wire, "coper", "job.yaml") +
      ": error: 'coper' is not in the catalogue (config/materials); did you mean 'copper'? one of: "));
  CHECK(answer.find("copper") != std::string::npos);
}

TEST_CASE("catalogue: a material's file must hold the material of that name") {
  const Scratch scratch;
  scratch.write("materials/tin.yaml", "name: lead\nsource: nobody\n");
  const auto job = scratch.write("job.yaml", edited(sample_job, "material: copper", "material: tin"));
  CHECK(message_of([&] { read_job(job); })
            .find("materials/tin.yaml:1:1: error: the material is not named 'tin' as its "
                  "file is; write 'name: tin'") != std::string::npos);
}

TEST_CASE("catalogue: a dresspack may bring its own materials") {
  const std::string text =
      edited(sample_job, "  damping_source: guessed\n",
             "  damping_source: guessed\n  materials:\n    - {name: copper, source: mine, youngs_modulus_GPa: 100, "
             "fatigue_strength_MPa: 500, fatigue_strength_exponent: -0.1, fatigue_ductility: 0.5, "
             "fatigue_ductility_exponent: -0.5}\n");
  const Job job = job_from(parse_yaml(text, "job.yaml"));
  CHECK(job.dresspacks[0].dresspack.materials.size() == 1);
  CHECK(material_of(job, "copper").source == "mine");
}

TEST_CASE("catalogue: 'from' starts from an entry and overrides what is written beside it") {
  const std::string text =
      edited(sample_job, robot_block, "robot:\n  from: abb_irb6640_185_280\n  base_position_m: [0, 0, 1.5]\n");
  const std::string whole = edited(edited(edited(text, "link: base,", "link: base_link,"), "link: arm", "link: link_6"),
                                   "  mounting_pose_deg: [0, 7]\n", "");
  const std::string job_words = edited(whole, motion_block, "motion: easy\n");
  const Job job = job_from(parse_yaml(job_words, "job.yaml"));
  CHECK(job.robot.joints.size() == 6);
  CHECK(job.robot.base_position.z() == 1.5);
  CHECK(job.robot.name.find("6640") != std::string::npos);
}

TEST_CASE("catalogue: 'from' of 'from' works, in a circle it is refused") {
  const Scratch scratch;
  scratch.write("programs/a.yaml", indented_less(motion_block));
  scratch.write("programs/b.yaml", "from: a\nspeed_percent: 50\n");
  const auto job = scratch.write("job.yaml", edited(sample_job, motion_block, "motion: {from: b, name: mine}\n"));
  CHECK(read_job(job).motion.speed_percent == 50);
  CHECK(read_job(job).motion.name == "mine");
  scratch.write("programs/a.yaml", "from: b\n");
  CHECK(message_of([&] { read_job(job); }).find("error: 'from' goes in a circle; let one entry stand alone") !=
        std::string::npos);
}

TEST_CASE("set: a value replaces what the job says, in the order of the options") {
  CHECK(with({"simulation.segments=80"}).simulation.segments == 80);
  CHECK(with({"simulation.segments=80", "simulation.segments=90"}).simulation.segments == 90);
  CHECK(with({"strain.slip=stick"}).strain.slip == std::vector<Slip>{Slip::stick});
  CHECK(with({"simulation.gravity_m_per_s2=[0, 0, 0]"}).simulation.gravity == Vector3d::Zero());
  CHECK(with({"fatigue={stress: elastic}"}).fatigue.stress == Stress::elastic);
  CHECK(with({"dresspack.source=a = b, c"}).dresspacks[0].dresspack.source == "a = b, c");
}

TEST_CASE("set: a key that the job does not write is added, with the groups on the way") {
  const std::string bare = sample_job.substr(0, sample_job.find("simulation:"));
  const Job job = job_from(parse_yaml(bare, "job.yaml"), {"strain.gate=0.002", "simulation.segments=33"});
  CHECK(job.strain.gate == 0.002);
  CHECK(job.simulation.segments == 33);
}

TEST_CASE("set: items of a list count from 1") {
  CHECK(with({"motion.steps.2.steps.1.joints_deg.2=-7"}).motion.steps[1].steps[0].joints[1] == -7 * degree);
  CHECK(
      with({"dresspack.components.1.components.1.count=4"}).dresspacks[0].dresspack.components[0].components[0].count ==
      4);
  CHECK(set_error("motion.steps.4.dwell_s=1") ==
        "--set motion.steps.4.dwell_s=1: error: '4' of motion.steps.4.dwell_s is not an item of the list; "
        "items count from 1 to 3");
  CHECK(set_error("motion.steps.0.dwell_s=1").find("items count from 1 to 3") != std::string::npos);
  for (const char* word : {"first", "1x", "01", "+1", "-1", "18446744073709551617"})
    CHECK(set_error(fmt::format("motion.steps.{}.dwell_s=1", word)).find("items count from 1 to 3") !=
          std::string::npos);
}

TEST_CASE("set: a part is placed at the key that changed it, so that an overlap names it") {
  Node job = parse_yaml("dresspack:\n  components:\n    - {name: core, components: [{count: 6}]}\n", "hose.yaml");
  const auto place = [&](const char* path) { return value_at(job, path)->where.text(); };
  set_value(job, "dresspack.components.1.components.1.count", scalar("7"), {"job.yaml", 9, 3});
  CHECK(place("dresspack.components.1.components.1") == "job.yaml:9:3");
  CHECK(place("dresspack.components.1") == "hose.yaml:3:7");
  CHECK(place("dresspack") == "hose.yaml:2:3");
  set_value(job, "dresspack.components.1.count", scalar("7"), {});  // by a search, which has no place
  CHECK(place("dresspack.components.1") == "hose.yaml:3:7");
}

TEST_CASE("set: a catalogue entry may be named, and a key inside a named entry set") {
  CHECK(with({"motion=easy", "robot=abb_irb6640_185_280", "routing.base_clamp.link=base_link",
              "routing.tool_clamp.link=link_6", "routing.mounting_pose_deg=[0, 0, 0, 0, 30, 0]"})
            .motion.name == "easy");
  const std::string named = edited(sample_job, dresspack_block, "dresspack: spot_welding\n");
  const Job job = job_from(parse_yaml(named, "job.yaml"), {"strain.slip=free", "dresspack.components.1.count=5"});
  CHECK(job.dresspacks[0].dresspack.components[0].count == 5);
  CHECK(job.dresspacks[0].dresspack.components[0].components.size() == 1);
  const std::string from = edited(sample_job, dresspack_block, "dresspack: {from: spot_welding}\n");
  const Job other = job_from(parse_yaml(from, "job.yaml"), {"strain.slip=free", "dresspack.components.1.count=5"});
  CHECK(other.dresspacks[0].dresspack.components[0].count == 5);
  CHECK(other.dresspacks[0].dresspack.components[0].components.size() == 1);
}

TEST_CASE("lines: a key path at the first level of a job sets one key, a whole before its parts, --set goes over it") {
  const std::string named = edited(sample_job, dresspack_block, "dresspack: absent\n");
  const std::string lines = "dresspack.components.1.count: 5\ndresspack: spot_welding\nsimulation.segments: 31\n";
  const std::string whole = edited(named, "dresspack: absent\n", "") + lines;
  const Job job = job_from(parse_yaml(whole, "job.yaml"), {"strain.slip=free"});
  CHECK(job.dresspacks[0].dresspack.components[0].count == 5);
  CHECK(job.dresspacks[0].dresspack.components[0].components.size() == 1);
  CHECK(job.simulation.segments == 31);
  CHECK(job_from(parse_yaml(whole, "job.yaml"), {"strain.slip=free", "simulation.segments=32"}).simulation.segments ==
        32);
  CHECK_THROWS_WITH(job_from(parse_yaml(whole + "simulation.segmets: 3\n", "job.yaml")),
                    Catch::Contains("unknown key 'simulation.segmets'; did you mean 'segments'?"));
  Node study = parse_yaml(whole, "job.yaml");
  set_value(study, "simulation.segments", parse_yaml("33", "study.yaml"), {"study.yaml"});
  CHECK(job_from(study, {"strain.slip=free"}).simulation.segments ==
        33);  // a study's change has priority over the job's line
}

TEST_CASE("set: 'from' itself can be set") {
  const std::string from = edited(sample_job, dresspack_block, "dresspack: {from: absent, diameter_mm: 61}\n");
  const Job job = job_from(parse_yaml(from, "job.yaml"), {"strain.slip=free", "dresspack.from=spot_welding"});
  CHECK(job.dresspacks[0].dresspack.diameter == 61 * 1e-3);
  CHECK(job.dresspacks[0].dresspack.components[0].count == 10);
}

TEST_CASE("set: files are named from where the command is typed") {
  const Scratch scratch;
  const auto program =
      scratch.write("some/program.yaml", edited(indented_less(motion_block), "name: nod", "name: typed"));
  CHECK(with({"motion=" + program.string()}).motion.name == "typed");
  const auto relative = std::filesystem::proximate(program).string();
  CHECK(with({"motion=" + relative}).motion.name == "typed");
  const auto poses = scratch.write("some/poses.csv", "");
  const std::string no_motion = edited(sample_job, motion_block, "");
  const std::string no_clamps = edited(no_motion, block_of("  base_clamp", "  mounting_pose_deg"), "");
  const Job job = job_from(parse_yaml(edited(no_clamps, "  mounting_pose_deg: [0, 7]\n", ""), "elsewhere/job.yaml"),
                           {"motion={clamp_poses: " + std::filesystem::proximate(poses).string() + "}"});
  CHECK(job.motion.clamp_poses == poses);
}

TEST_CASE("set: mistakes are shown as they were typed") {
  CHECK(set_error("simulation.segments") ==
        "--set simulation.segments: error: is not key.path=value; write for example --set "
        "simulation.segments=80");
  CHECK(set_error("=3").find("is not key.path=value") != std::string::npos);
  CHECK(set_error("simulation..segments=3") ==
        "--set simulation..segments=3: error: has an empty word in its key path; write key.path=value");
  CHECK(set_error("simulation.segments.more=3") ==
        "--set simulation.segments.more=3: error: 'more' of simulation.segments.more lies inside a single "
        "value; shorten the path");
  CHECK(set_error("simulation.segments=-1") ==
        "--set simulation.segments=-1: error: simulation.segments is -1 (must be 4 .. 2000); give the number of "
        "rigid segments of each dresspack");
  CHECK(set_error("simulation.segmens=5") ==
        "--set simulation.segmens=5: error: unknown key 'simulation.segmens'; did you mean 'segments'?");
  CHECK(set_error("simulation.segments=") ==
        "--set simulation.segments=: error: simulation.segments has no value; give the number of rigid segments of "
        "each dresspack");
  CHECK(set_error("simulation.segments=[1").find("--set simulation.segments=[1") == 0);
}

TEST_CASE("catalogue: a program whose extension is none of a program is refused with those that are read") {
  const Scratch scratch;
  scratch.write("weld.txt", "DEF weld()\nEND\n");
  const auto job = scratch.write("job.yaml", "robot: kuka_kr16_2\nmotion: weld.txt\ndresspack: sensor_cable\n");
  CHECK_THROWS_WITH(
      read_job(job),
      Catch::Contains("weld.txt' is no robot program by its name ('.txt'); rename it by its language: RAPID .mod") &&
          Catch::Contains("KRL .src") && !Catch::Contains("there is no file"));
  std::filesystem::remove(scratch / "weld.txt");
  CHECK_THROWS_WITH(read_job(job), Catch::Contains("there is no file '"));
}

}  // namespace
}  // namespace dresslife::pipeline
