// KUKA backups: choice of the programs and data lists that are read, and of the start program.

#include "tests/pipeline/scratch.h"
#include "tests/sim/program/reading.h"

using namespace dresslife;
using dresslife::pipeline::Scratch;

namespace {

std::string program(const std::string& name, const std::string& body) {
  return "DEF " + name + "()\n" + body + "\nEND\n";
}

/// Writes a backup: a cell that calls `called` by number, two programs with a point of the same name, system files.
void write_backup(const Scratch& folder, const std::string& called) {
  folder.write("KRC/R1/Cell.src",
               program("CELL", "INT N\nBAS(#INITMOV,0)\nLOOP\nP00(#EXT_PGNO,#PGNO_GET,DMY[],0)\nSWITCH PGNO\nCASE 1\n" +
                                   called + "\nENDSWITCH\nENDLOOP"));
  folder.write("KRC/R1/System/$config.dat",
               "DEFDAT $CONFIG\nREAL DEF_VEL_CP=2.0\nDECL FDAT FDAT_ACT\nDECL PDAT PDAT_ACT\nDECL FRAME "
               "TOOL_DATA[16]\nTOOL_DATA[1]={X 0.0,Y 0.0,Z 775.0,A 0.0,B 0.0,C 0.0}\nENDDAT\n");
  folder.write("KRC/R1/System/bas.src", program("BAS", "nonsense ((("));
  folder.write("KRC/STEU/$config.dat", "DEFDAT $CONFIG\nREAL DEF_VEL_CP=0.001\nENDDAT\n");
  folder.write("C/KRC/Roboter/Template/vorgabe.src", program("vorgabe", "PTP XHOME"));
  const std::string form = "FDAT_ACT=FP1\nPDAT_ACT=PP1\nBAS(#PTP_PARAMS,60)\nPTP XP1\n";
  const auto list = [](const std::string& name, double x) {
    return fmt::format(
        "DEFDAT {}\nDECL E6POS XP1={{X {},Y 0,Z 1000,A 0,B 90,C 0}}\nDECL FDAT FP1={{TOOL_NO 1,BASE_NO "
        "0,IPO_FRAME #BASE}}\nDECL PDAT PP1={{VEL 100,ACC 50,APO_DIST 0}}\nENDDAT\n",
        name, x);
  };
  folder.write("KRC/R1/Program/pick.src", program("pick", form + "place()"));
  folder.write("KRC/R1/Program/PICK.DAT", list("pick", 900));
  folder.write("KRC/R1/Program/deep/place.src", program("place", form));
  folder.write("KRC/R1/Program/deep/place.dat", list("place", 800));
}

pipeline::Motion read(const std::filesystem::path& path, const std::string& routine = "") {
  const pipeline::Motion asked = tests::motion_by(path, routine);
  return sim::motion_of(sim::read_program(asked), asked);
}

std::vector<double> places(const pipeline::Motion& motion) {
  std::vector<double> x;
  for (const pipeline::MotionStep& step : motion.steps) x.push_back(std::round(1000 * step.position.at(0)));
  return x;
}

}  // namespace

TEST_CASE("krl: a backup begins in the program that CELL calls") {
  const Scratch folder;
  write_backup(folder, "pick()");
  const pipeline::Motion motion = read(folder / "");
  CHECK(places(motion) == std::vector<double>{900, 800});
  CHECK(motion.steps[0].tool == "TOOL_DATA[1]");
  CHECK(motion.steps[0].speed_percent.value() == 60);
}

TEST_CASE("krl: a program within a backup sees all of it") {
  const Scratch folder;
  write_backup(folder, "pick()");
  CHECK(places(read(folder / "KRC/R1/Program/pick.src")) == std::vector<double>{900, 800});
  CHECK(places(read(folder / "KRC/R1/Program/deep/place.src")) == std::vector<double>{800});
}

TEST_CASE("krl: where several programs could be meant, one is asked for") {
  const Scratch folder;
  write_backup(folder, "pick()\nCASE 2\nplace()");
  CHECK_THROWS_WITH(read(folder / ""), Catch::Contains("motion.routine") && Catch::Contains("pick, place"));
  CHECK(places(read(folder / "", "place")) == std::vector<double>{800});
}

TEST_CASE("krl: a fresh CELL calls nobody: the program that nobody calls begins") {
  const Scratch folder;
  write_backup(folder, ";EXAMPLE1()");
  CHECK(places(read(folder / "")) == std::vector<double>{900, 800});
}

TEST_CASE("krl: two robots in a folder are not one") {
  const Scratch folder;
  folder.write("a/KRC/R1/Program/m.src", program("m", "PTP XP1"));
  folder.write("b/KRC/R1/Program/m.src", program("m", "PTP XP1"));
  CHECK_THROWS_WITH(read(folder / ""), Catch::Contains("the programs of 2 robots"));
}

TEST_CASE("krl: a program finds the lists and programs beside it, whatever the case of their names") {
  const Scratch folder;
  const auto axis = [](double first) { return fmt::format("{{A1 {},A2 -90,A3 90,A4 0,A5 30,A6 0}}", first); };
  folder.write("Main.src", program("main", "PTP XP1\nsub()"));
  folder.write("MAIN.DAT", "DEFDAT main\nE6AXIS XP1=" + axis(1) + "\nENDDAT\n");
  folder.write("SUB.SRC", program("sub", "PTP XP1"));
  folder.write("Sub.dat", "DEFDAT sub\nE6AXIS XP1=" + axis(2) + "\nENDDAT\n");
  folder.write("other.dat", "DEFDAT other\nINT z=1\nENDDAT\n");
  pipeline::Motion asked;
  asked.program = folder / "Main.src";
  asked.modules.push_back({folder / "other.dat"});
  CHECK(sim::read_program(asked).instructions.size() == 2);
}
