// User errors at the command line: one line with place, reason and remedy, exit status 1, and no file left behind. Wrong jobs:
// wrong_inputs_test.cpp.
#include <algorithm>

#include "tests/catch.h"
#include "tests/cli/process.h"

using namespace dresslife::tests;

namespace {

void check_refused(const Scratch& scratch, const Outcome& outcome, const std::string& words,
                   const std::string& output) {
  INFO(outcome.err);
  CHECK(outcome.status == 1);
  CHECK(outcome.out.empty());
  CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
  CHECK(outcome.err.find(words) == 0);
  CHECK(outcome.err.find("; ") != std::string::npos);  // a remedy follows
  CHECK_FALSE(fs::exists(scratch / output));
  for (const auto& entry : fs::directory_iterator(scratch.folder())) CHECK(entry.path().extension() != ".part");
}

}  // namespace

TEST_CASE("dresslife-sim refuses what is not there") {
  Scratch scratch;
  check_refused(scratch, run(scratch, "dresslife-sim", "job.yaml -o motion.h5"),
                "job.yaml: error: cannot be read (No such file or directory)", "motion.h5");
  write_small_job(scratch);
  check_refused(scratch, run(scratch, "dresslife-sim", "job.yaml -o none/motion.h5"),
                "none/motion.h5: error: lies in a folder that does not exist", "none/motion.h5");
  check_refused(scratch, run(scratch, "dresslife-sim", "job.yaml -o motion.h5 --set segments"),
                "--set segments: error: is not key.path=value", "motion.h5");
}

TEST_CASE("the later stages refuse files that are not theirs, cut off or damaged") {
  Scratch scratch;
  write_small_job(scratch);
  must_run(scratch, "dresslife-sim", "job.yaml -o motion.h5");
  const std::string whole = content(scratch / "motion.h5");

  scratch.write("cut.h5", whole.substr(0, whole.size() / 2));
  check_refused(scratch, run(scratch, "dresslife-strain", "cut.h5 -o strain.h5"),
                "cut.h5: error: is cut off or has grown", "strain.h5");
  scratch.write("text.h5", "no HDF5 at all\n");
  check_refused(scratch, run(scratch, "dresslife-strain", "text.h5 -o strain.h5"),
                "text.h5: error: is not an HDF5 file", "strain.h5");
  check_refused(scratch, run(scratch, "dresslife-fatigue", "motion.h5 -o life.h5"),
                "motion.h5: error: holds 'dresslife-motion' ('dresslife-strain' is expected)", "life.h5");
  check_refused(scratch, run(scratch, "dresslife-strain", "none.h5 -o strain.h5"), "none.h5: error: is not there",
                "strain.h5");
  check_refused(scratch, run(scratch, "dresslife-strain", "motion.h5 -o motion.h5"),
                "motion.h5: error: is one of the files that are read", "strain.h5");
  CHECK(content(scratch / "motion.h5") == whole);
}

TEST_CASE("a command that does not exist is answered with the nearest one") {
  const Scratch scratch;
  const Outcome near = run(scratch, "dresslife", "improv job.yaml");
  CHECK(near.status == 2);
  CHECK(near.err.find("'improv' is no command of dresslife; did you mean 'improve'?\n") == 0);
  const Outcome far = run(scratch, "dresslife", "xylophone");
  CHECK(far.status == 2);
  CHECK(far.err == "'xylophone' is no command of dresslife; 'dresslife --help' lists them\n");
  CHECK(run(scratch, "dresslife", "help").out == run(scratch, "dresslife", "--help").out);
  CHECK(run(scratch, "dresslife", "help check").out == run(scratch, "dresslife", "check --help").out);
  const Outcome manual = run(scratch, "dresslife", "manual");
  CHECK(manual.status == 2);
  CHECK(manual.err.find("KEY, COLUMN, keys, files, ranking.csv, man, bash or zsh") != std::string::npos);
  CHECK(run(scratch, "dresslife", "").status == 2);
}

TEST_CASE("import writes what a program asks to one file, reads it back filled in, and replaces none") {
  const Scratch scratch;
  scratch.write(
      "cell.mod",
      "MODULE cell\n  CONST jointtarget home := [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\n  PROC main()\n"
      "    MoveAbsJ home, v500, fine, tool0;\n    IF ready() THEN\n      MoveJ pick, v100, fine, gun;\n    ENDIF\n"
      "  ENDPROC\nENDMODULE\n");
  const std::string call = "cell.mod -o cell.yaml --answers answers.yaml";
  const Outcome asked = run(scratch, "dresslife", "import " + call);
  CHECK(asked.status == 1);
  CHECK(asked.err.find("answers.yaml: holds these 3 questions") != std::string::npos);
  CHECK_FALSE(fs::exists(scratch / "cell.yaml"));
  const std::string file = content(scratch / "answers.yaml");
  // An empty answer ends the import. The file does not change, so the user's edits in it are kept.
  const std::string half = edited(file, "{name: 'ready', value: ''}", "{name: 'ready', value: 'TRUE'}");
  scratch.write("answers.yaml", half);
  CHECK(run(scratch, "dresslife-import", call).status == 1);
  CHECK(content(scratch / "answers.yaml") == half);
  CHECK_FALSE(fs::exists(scratch / "cell.yaml"));
  std::string whole = edited(half, "{name: 'pick', value: ''}",
                             "{name: 'pick', value: '[[600,0,900],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]]'}");
  whole = edited(whole, "{name: 'gun', position_mm: []", "{name: 'gun', position_mm: [0, 0, 150]");
  scratch.write("answers.yaml", whole);
  const Outcome read = run(scratch, "dresslife-import", call);
  INFO(read.err);
  CHECK(read.status == 0);
  CHECK(content(scratch / "answers.yaml") == whole);
  CHECK(content(scratch / "cell.yaml").find("position_mm: [600, 0, 900]") != std::string::npos);
}
