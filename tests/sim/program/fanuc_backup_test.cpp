#include "sim/program/fanuc/backup.h"

#include "pipeline/job/motion.h"
#include "sim/program/backup.h"
#include "tests/pipeline/scratch.h"
#include "tests/sim/program/reading.h"

using namespace dresslife;
using namespace dresslife::sim;
using namespace dresslife::tests;
using dresslife::pipeline::Scratch;
namespace fs = std::filesystem;

namespace {

const char* numbers = R"([*NUMREG*]$NUMREG  Storage: SHADOW  Access: RW  : ARRAY[3] OF Numeric Reg
  [1] = 2  'parts'
  [2] = -2.700000  'step'
[*NUMREG*]$MAXREGNUM  Storage: CMOS  Access: RW  : INTEGER = 3
)";
const char* positions = R"([*POSREG*]$POSREG  Storage: SHADOW  Access: RW  : ARRAY[2,4] OF Position Reg
    [1,1] =   'HOME'   Group: 1
  J1 =    60.000 deg   J2 =   -50.000 deg   J3 =    10.000 deg 
  J4 =   -10.000 deg   J5 =   -95.000 deg   J6 =      .500 deg 

    [1,2] =   'set Uninitialized' Uninitialized
    [1,3] =   '' 
  Group: 1   Config: F U T, 0, 1, 0
  X:  -820.507   Y:  2309.503   Z:   945.836
  W:    90.594   P:    -1.149   R:  -160.248
  EXT1:   100.000 mm  
    [2,1] =   'HOME'   Group: 2
  J1 =    45.000 deg 
)";
const char* frames = R"([*SYSTEM*]$MNUFRAME  Storage: SHADOW  Access: RW  : ARRAY[1,2] OF POSITION
    [1,1] = 
  Group: 1   Config: N D B, 0, 0, 0
  X:  1563.580   Y:  1851.200   Z:   -80.440
  W:     0.000   P:     0.000   R:    90.000
    [1,2] = Uninitialized
[*SYSTEM*]$MNUFRAMENUM  Storage: SHADOW  Access: RW  : ARRAY[1] OF BYTE
  [1] = 1

[*SYSTEM*]$MNUTOOL  Storage: SHADOW  Access: RW  : ARRAY[1,2] OF POSITION
    [1,2] = 
  Group: 1   Config: N D B, 0, 0, 0
  X:     0.000   Y:     0.000   Z:   400.000
  W:     0.000   P:     0.000   R:     0.000
[*SYSTEM*]$MNUTOOLNUM  Storage: SHADOW  Access: RW  : ARRAY[1] OF BYTE
  [1] = 2
)";
const char* macros = R"([*SYSTEM*]$MACROTABLE  Storage: SHADOW  Access: RO  : ARRAY[2] OF MN_MCR_TABLE
     Field: $MACROTABLE[1].$MACRO_NAME Access: RO: STRING[37] = 'MOVE TO HOME'
     Field: $MACROTABLE[1].$PROG_NAME Access: RO: STRING[37] = 'MOV_HOME'
)";

std::string program(const std::string& name, const std::string& lines) {
  return "/PROG  " + name + "\n/MN\n" + lines + "/POS\n/END\n";
}

}  // namespace

TEST_CASE("fanuc backup: variable files give registers, positions, frames and macros") {
  FanucVariables read;
  for (const char* text : {numbers, positions, frames, macros}) read_fanuc_variables({"x.va", text}, read);
  CHECK(read.registers == std::map<int, double>{{1, 2}, {2, -2.7}});
  REQUIRE(read.position_registers.size() == 3);
  CHECK(read.position_registers.at(1).form == FanucPosition::Form::joints);
  CHECK(read.position_registers.at(1).values == std::vector<double>{60, -50, 10, -10, -95, 0.5});
  CHECK_FALSE(read.position_registers.at(2).known());
  CHECK(read.position_registers.at(3).values ==
        std::vector<double>{-820.507, 2309.503, 945.836, 90.594, -1.149, -160.248});
  CHECK(read.position_registers.at(3).configuration.text() == "fanuc FUT 0 1 0");
  CHECK(read.position_registers.at(3).external_axes == std::vector<double>{100});
  CHECK(read.frames.at(1).values[5] == 90);
  CHECK_FALSE(read.frames.at(2).known());
  CHECK(read.tools.at(2).values[2] == 400);
  CHECK(read.frame_number.value() == 1);
  CHECK(read.tool_number.value() == 2);
  CHECK(read.macros == std::map<std::string, std::string>{{"move to home", "mov_home"}});
}

TEST_CASE("fanuc backup: what lies beside a listing is read with it, a folder is a program") {
  const Scratch folder;
  folder.write("POSREG.VA", positions);
  folder.write("numreg.va", numbers);
  folder.write("sysframe.va", frames);
  folder.write("sysmacro.va", macros);
  folder.write("MAIN.LS", program("MAIN", "   1:  MOVE TO HOME ;\n   2:  CALL WORK(R[1]) ;\n"));
  folder.write("mov_home.ls", program("MOV_HOME", "   1:J PR[1] 50% FINE ;\n"));
  folder.write("work.LS",
               program("WORK", "   1:  FOR R[9]=1 TO AR[1] ;\n   2:L PR[3] 100mm/sec FINE ;\n   3:  ENDFOR ;\n"));
  folder.write("errall.ls", "ERRALL.LS     Robot Name ROBOT\nF Number: F00000\n");
  folder.write("idle.ls", program("IDLE", "   1:  DO[1]=ON ;\n"));

  for (const fs::path& given : {folder / "MAIN.LS", folder.folder()}) {
    const Program read = read_program(motion_by(given));
    REQUIRE(read.instructions.size() == 3);
    CHECK(read.instructions[0].routine == "mov_home");
    CHECK(read.instructions[0].target.joints[5] == Approx(0.5 * std::acos(-1) / 180).epsilon(1e-12));
    CHECK(read.tools.at(read.instructions[1].tool).name == "UTOOL[2]");
    CHECK(read.work_objects.at(read.instructions[1].work_object).frame.position.x() == Approx(1.56358));
  }
  const FanucFolder found = fanuc_folder(folder.folder());
  CHECK(found.listings.size() == 4);
  CHECK(found.variables.size() == 4);
  CHECK(uncalled_programs(found.calls) == std::vector<std::string>{"main"});

  folder.write("other.ls", program("OTHER", "   1:J PR[1] 50% FINE ;\n"));
  CHECK(read_program(motion_by(folder.folder(), "other")).instructions.size() == 1);
  folder.write("main2.ls", program("MAIN2", "   1:J PR[1] 50% FINE ;\n"));
  CHECK(read_program(motion_by(folder.folder())).instructions.size() == 3);  // MAIN is the one of several
  fs::remove(folder / "main2.ls");
  fs::remove(folder / "MAIN.LS");
  folder.write("cell.ls", program("CELL", "   1:  CALL WORK(1) ;\n"));
  CHECK_THROWS_WITH(read_program(motion_by(folder.folder())),
                    Catch::Contains("holds several programs, and none that calls them; name one in motion.routine: "
                                    "cell, mov_home, other"));
}

TEST_CASE("fanuc backup: listings in two languages lie in folders of their own, beside one set of registers") {
  const Scratch folder;
  folder.write("posreg.va", positions);
  folder.write("english/home.ls", program("HOME", "   1:J PR[1] 50% FINE ;\n"));
  CHECK(read_program(motion_by(folder / "english/home.ls")).instructions.size() == 1);
  CHECK(read_program(motion_by(folder.folder())).instructions.size() == 1);
  folder.write("german/home.ls", program("HOME", "   1:J PR[1] 50% FINE ;\n"));
  CHECK_THROWS_WITH(read_program(motion_by(folder.folder())), Catch::Contains("several robots or languages"));
}
