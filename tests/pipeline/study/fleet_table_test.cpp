#include "pipeline/study/fleet_table.h"

#include "pipeline/job/job.h"
#include "pipeline/study/study.h"
#include "tests/catch.h"
#include "tests/pipeline/sample_job.h"
#include "tests/pipeline/scratch.h"

namespace dresslife::pipeline {
namespace {

std::string refusal(const std::string& table) {
  const Scratch scratch;
  const std::string file = scratch.write("fleet.csv", table);
  const std::string message = message_of([&] { table_variants(file); });
  return message.starts_with(file) ? "fleet" + message.substr(file.size()) : message;
}

TEST_CASE("fleet table: each row is a job, each column a key, an empty cell the base's") {
  const Scratch scratch;
  scratch.write("job.yaml", sample_job);
  scratch.write("tables/fleet.csv",
                "\xEF\xBB\xBF# a plant\r\nname,simulation.segments, fatigue.stress,strain.slip\r\n"
                "\r\nleft, 30,elastic,\r\n\"right, rear\",,,\"[stick, stick]\"\r\n");
  const Study study = read_study(scratch.write("s.yaml", "base: job.yaml\ntable: tables/fleet.csv\n"));
  REQUIRE(study.jobs.size() == 2);
  CHECK(study.jobs[0].name == "left");
  CHECK(study.jobs[1].name == "right__rear");
  REQUIRE(study.jobs[0].job);
  REQUIRE(study.jobs[1].job);
  CHECK(study.jobs[0].job->simulation.segments == 30);
  CHECK(study.jobs[0].job->fatigue.stress == Stress::elastic);
  CHECK(study.jobs[1].job->simulation.segments == 20);
  CHECK(study.jobs[1].job->strain.slip == std::vector<Slip>{Slip::stick, Slip::stick});
}

TEST_CASE("fleet table: a job that cannot be run is reported at its cell") {
  const Scratch scratch;
  scratch.write("job.yaml", sample_job);
  const std::string table = scratch.write("fleet.csv", "name;simulation.segments\na;20\nb; 3\n");
  const Study study = read_study(scratch.write("s.yaml", "base: job.yaml\ntable: fleet.csv\n"));
  CHECK(study.jobs[0].failure.empty());
  CHECK(study.jobs[1].failure.starts_with(table + ":3:4: error: simulation.segments is 3 (must be 4 .. 2000)"));
}

TEST_CASE("fleet table: rows, values and draws multiply") {
  const Scratch scratch;
  scratch.write("job.yaml", sample_job);
  scratch.write("fleet.csv", "name\na\nb\n");
  const Study study =
      read_study(scratch.write("s.yaml",
                               "base: job.yaml\ntable: fleet.csv\nvary: {fatigue.stress: [cyclic, elastic]}\n"
                               "sample: {jobs: 3, keys: {dresspack.bending_stiffness_Nm2: !uniform [4, 6]}}\n"));
  REQUIRE(study.jobs.size() == 12);
  CHECK(study.jobs[5].name == "a-elastic-draw_3");
  // Compared variants have the same samples.
  const auto stiffness = [&](std::size_t k) { return study.jobs[k].job->dresspacks[0].dresspack.bending_stiffness; };
  CHECK(stiffness(0) == stiffness(3));
  CHECK(stiffness(0) == stiffness(9));
  CHECK(stiffness(0) != stiffness(1));
}

TEST_CASE("fleet table: a program is a motion of the catalogue or a controller's file") {
  const Scratch scratch;
  const auto variants = table_variants(scratch.write("f.csv", "name,program\na,easy\nb,./weld.mod\nc,own/nod.yaml\n"));
  REQUIRE(variants.size() == 3);
  CHECK(variants[0].changes[0].path == "motion");
  CHECK(variants[1].changes[0].path == "motion.program");
  CHECK(variants[2].changes[0].path == "motion");
  CHECK(variants[2].changes[0].value.where.column == 3);
}

TEST_CASE("fleet table: two columns that set one key are refused") {
  CHECK_THAT(refusal("name,motion,program\nx,easy,\ny,easy,hard\n"),
             Catch::StartsWith("fleet:3:8: error: motion is also set at ") &&
                 Catch::EndsWith("fleet.csv:3:3: one would replace the other; keep one of the two"));
  CHECK_THAT(refusal("name,motion.program,program\nx,a.mod,b.mod\n"),
             Catch::StartsWith("fleet:2:9: error: motion.program is also set at "));
}

TEST_CASE("fleet table: a cell is never cut off at a number sign") {
  CHECK(refusal("name,a\nx,line #3\n") ==
        "fleet:2:3: error: in 'line #3' the text behind # is a comment; write 'line #3' with these quotes");
  CHECK(refusal("name,a\nx,\"#3\"\n") ==
        "fleet:2:3: error: in '#3' the text behind # is a comment; write '#3' with these quotes");
  const Scratch scratch;
  const auto variants = table_variants(scratch.write("f.csv", "name,a\nx,'line #3'\ny,line#3\nz,\"[1, 'a #2']\"\n"));
  CHECK(variants.at(0).changes.at(0).value.text == "line #3");
  CHECK(variants.at(1).changes.at(0).value.text == "line#3");
  CHECK(variants.at(2).changes.at(0).value.items.at(1).text == "a #2");
}

TEST_CASE("fleet table: what is no table is refused at its cell") {
  CHECK(refusal("") == "fleet:1:1: error: holds no table; write a line of column titles, then a row per job");
  CHECK(refusal("# nothing") == "fleet:1:1: error: holds no table; write a line of column titles, then a row per job");
  CHECK(refusal("name,a\n") == "fleet:1:1: error: has titles and no row; write a row per job");
  CHECK(refusal("robot,a\nx,1\n") ==
        "fleet:1:1: error: the table has no column 'name' (it has a, robot); add it, or rename one");
  CHECK(refusal("name,a,a\n").starts_with("fleet:1:8: error: two columns are titled 'a'"));
  CHECK(refusal("name,,a\n").starts_with("fleet:1:6: error: a column has no title"));
  CHECK(refusal("name,a\nx,1,2\n").starts_with("fleet:2:5: error: a row of 3 cells (the table has 2 columns)"));
  CHECK(refusal("name,a\n,1\n").starts_with("fleet:2:1: error: a row has no name"));
  CHECK(refusal("name,a\nx,1\ny,2\nx,3\n").starts_with("fleet:4:1: error: 'x' is the name of line 2, too"));
  CHECK(
      refusal("name,a\nx,\"1\n").starts_with("fleet:2:3: error: a quote that opens here is never closed in its line"));
  CHECK(refusal("name,a\nx,\"1\"2\n").starts_with("fleet:2:6: error: text follows a closing quote"));
  CHECK(refusal("name,a\nx,[1\n").starts_with("fleet:2:3: error: '[1' is no value"));
}

}  // namespace
}  // namespace dresslife::pipeline
