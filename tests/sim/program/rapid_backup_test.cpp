// ABB backups: choice of the task and of its modules.

#include "tests/pipeline/scratch.h"
#include "tests/sim/program/reading.h"

using namespace dresslife;
using dresslife::pipeline::Scratch;

namespace {

std::string go(double first) {
  return fmt::format("MoveAbsJ [[{},0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v1000,fine,tool0;\n", first);
}
std::string module(const std::string& name, const std::string& routine, const std::string& body) {
  return "MODULE " + name + "\nPROC " + routine + "()\n" + body + "ENDPROC\nENDMODULE\n";
}

sim::Program read(const std::filesystem::path& path) { return sim::read_program(tests::motion_by(path)); }

using tests::first_axes;
using Angles = std::vector<double>;

/// Writes a task whose list of contents has Main and Pick, but not old. slash: separator of folder and file.
void write_task(const Scratch& folder, const std::string& slash) {
  folder.write("RAPID/TASK1/PROGMOD/Main.mod", module("Main", "main", go(1) + "pick;\n"));
  folder.write("RAPID/TASK1/PROGMOD/pick.mod", module("pick", "pick", go(2)));
  folder.write("RAPID/TASK1/PROGMOD/old.mod", module("old", "main", go(3)));
  folder.write("RAPID/TASK1/SYSMOD/user.sys", "MODULE user(SYSMODULE)\nENDMODULE\n");
  folder.write("HOME/trial.mod", module("trial", "main", go(4)));
  folder.write("BACKINFO/backinfo.txt", ">>SYSTEM_ID:\ncell\n\n>>TASK1: (T_ROB1,,)\nPROGMOD" + slash +
                                            "Main.mod @ \nPROGMOD" + slash + "Pick.mod @ \nSYSMOD" + slash +
                                            "user.sys @ \n\n>>EOF:\n");
}

}  // namespace

TEST_CASE("rapid backup: the modules that its contents name are the program") {
  // HOME is the controller's disk and is not loaded; real controllers write '/', virtual ones '\'.
  for (const char* slash : {"/", "\\"}) {
    CAPTURE(slash);
    const Scratch folder;
    write_task(folder, slash);
    const sim::Program program = read(folder / "");
    CHECK(first_axes(program) == Angles{1, 2});
    CHECK(program.skipped.empty());
    // A backup within HOME is not loaded.
    folder.write("HOME/Backup_2019/RAPID/TASK1/PROGMOD/Main.mod", module("Main", "main", go(5)));
    CHECK(first_axes(read(folder / "")) == Angles{1, 2});
    CHECK(first_axes(read(folder / "HOME/Backup_2019")) == Angles{5});
  }
}

TEST_CASE("rapid backup: a backup of another controller may hold files that end like system modules or data lists") {
  const Scratch folder;
  folder.write("SYSTEM.SYS", "SYSTEM NO : YAS2.80\n");
  folder.write("ABSO.DAT", "0,0,0,0,0,0\n");
  folder.write("VAR.DAT", "/VAR\n//B 0\n");
  folder.write(
      "MAIN.JBI",
      "/JOB\n//NAME MAIN\n//POS\n///NPOS 1,0,0,0,0,0\n///TOOL 0\n///POSTYPE ANGLE\nC00000=7.0,0,0,0,0,0\n//INST\n///ATTR "
      "SC,RW\n///GROUP1 RB1\nNOP\nMOVJ C00000 VJ=10.00\nEND\n");
  CHECK(first_axes(read(folder / "")) == Angles{7});
}

TEST_CASE("rapid backup: a module that the contents name and that is not there is reported") {
  const Scratch folder;
  write_task(folder, "/");
  std::filesystem::remove(folder / "RAPID/TASK1/SYSMOD/user.sys");
  const sim::Program program = read(folder / "");
  CHECK(first_axes(program) == Angles{1, 2});
  REQUIRE(program.skipped.size() == 1);
  CHECK(program.skipped[0].may_move);
  CHECK_THAT(program.skipped[0].what, Catch::Contains("sysmod/user.sys"));
}

TEST_CASE("rapid backup: the task that moves is read, of two one is asked for") {
  const Scratch folder;
  write_task(folder, "/");
  folder.write("RAPID/TASK2/PROGMOD/watch.mod", module("watch", "main", "! MoveJ is only a word here\nWaitTime 1;\n"));
  CHECK(first_axes(read(folder / "")) == Angles{1, 2});
  folder.write("RAPID/TASK3/PROGMOD/second.mod", module("second", "main", go(7)));
  CHECK_THROWS_WITH(read(folder / ""),
                    Catch::Contains("holds several tasks that move a robot") && Catch::Contains("TASK3"));
  CHECK(first_axes(read(folder / "RAPID/TASK3")) == Angles{7});
}

TEST_CASE("rapid backup: a list of modules says what a program is") {
  const Scratch folder;
  const auto list = [](const std::string& file) {
    return "<?xml version=\"1.0\" encoding=\"ISO-8859-1\" ?>\n<Program>\n<Module>" + file + "</Module>\n</Program>\n";
  };
  folder.write("cell.pgf", list("cell.mod"));
  folder.write("cell.mod", module("cell", "main", go(1)));
  folder.write("trial.mod", module("trial", "main", go(2)));
  CHECK(first_axes(read(folder / "cell.pgf")) == Angles{1});
  CHECK(first_axes(read(folder / "")) == Angles{1});
  folder.write("older/cell.pgf", list("cell.mod"));
  folder.write("older/cell.mod", module("cell", "main", go(3)));
  CHECK(first_axes(read(folder / "")) == Angles{1});  // the list in the folder itself is used
  std::filesystem::remove(folder / "cell.pgf");
  folder.write("RAPID/PROGMOD/cell.pgf", list("cell.mod"));
  folder.write("RAPID/PROGMOD/cell.mod", module("cell", "main", go(4)));
  CHECK(first_axes(read(folder / "")) == Angles{4});  // RAPID is the controller's own folder
  folder.write("third/RAPID/cell.pgf", list("cell.mod"));
  folder.write("third/RAPID/cell.mod", module("cell", "main", go(5)));
  CHECK_THROWS_WITH(read(folder / ""), Catch::Contains("holds several lists of modules"));
  folder.write("fourth/lost.pgf", list("lost.mod"));
  CHECK_THROWS_WITH(read(folder / "fourth/lost.pgf"), Catch::Contains("lists lost.mod, which is not beside it"));
}

TEST_CASE("rapid backup: a byte order mark is no letter of the program") {
  const Scratch folder;
  CHECK(first_axes(read(folder.write("m.mod", "\xEF\xBB\xBF" + module("m", "main", go(1))))) == Angles{1});
}

TEST_CASE("rapid backup: persistent data that another task writes may have any value") {
  // TASK2 moves no robot; it writes `go_on` and its own `mine`. TASK1's initial value of go_on is not used.
  const Scratch folder;
  const std::string shared = "PERS bool go_on:=FALSE;\nPERS bool quiet:=FALSE;\nVAR bool mine:=FALSE;\n";
  const std::string body = go(1) + "IF go_on THEN\n" + go(2) + "ENDIF\nIF quiet OR mine THEN\n" + go(3) + "ENDIF\n";
  folder.write("RAPID/TASK1/PROGMOD/Main.mod",
               "MODULE Main\n" + shared + "PROC main()\n" + body + "ENDPROC\nENDMODULE\n");
  folder.write("RAPID/TASK2/PROGMOD/plc.mod",
               "MODULE plc\nPERS bool go_on;\nPERS bool quiet;\nVAR bool mine;\nPROC "
               "main()\ngo_on:=TRUE;\nmine:=TRUE;\n"
               "ENDPROC\nENDMODULE\n");
  CHECK_THROWS_WITH(read(folder / ""), Catch::Contains("'go_on' may be written by plc.mod of the task TASK2") &&
                                           !Catch::Contains("quiet") && !Catch::Contains("mine"));
  pipeline::Motion asked;
  asked.program = folder / "";
  asked.values.push_back({"go_on", "FALSE"});
  CHECK(first_axes(sim::read_program(asked)) == Angles{1});
}
