// Files beside a program that the program can reach.
#include "pipeline/base/related_files.h"

#include <algorithm>

#include "tests/catch.h"
#include "tests/pipeline/scratch.h"

using namespace dresslife::pipeline;

TEST_CASE("related files: what a program names in whole words, what those name, and the controller's own") {
  const Scratch scratch;
  const auto file = [&](const std::string& name, const std::string& text) { return scratch.write(name, text); };
  const auto program = file("weld.src", "DEF weld()\nPTP position\n grip(1)\nLIN {X 1,Y 2}\nEND\n");
  const auto called = file("tongs.src", "GLOBAL DEF grip(x:IN)\nPTP xopen\nEND\n");
  const auto of_called =
      file("points.dat", "DEFDAT points PUBLIC\nDECL GLOBAL E6POS xopen={X 1,Y 2}, xshut={X 2,Y 3}\nENDDAT\n");
  const auto own_data = file("weld.dat", "DEFDAT weld\nENDDAT\n");
  const auto config = file("$config.dat", "DEFDAT $config\nENDDAT\n");
  // Its names are parts of words of the program, and its arguments and contents are words of the program.
  const auto unrelated = file("on.src", "DEF on(position:IN)\nEND\nGLOBAL E6POS xfar={X 1,Y 2}\n");
  const auto found = related_files({program}, {called, of_called, own_data, config, unrelated});
  std::vector<std::filesystem::path> expected{called, of_called, own_data, config};
  std::sort(expected.begin(), expected.end());
  CHECK(found == expected);
}

TEST_CASE("related files: copies of the program, its comments and routines of other files alone reach nothing") {
  const Scratch scratch;
  const auto file = [&](const std::string& name, const std::string& text) { return scratch.write(name, text); };
  const auto program = file("weld.src", "DEF weld()\n; after it: clean\n grip()\nEND\nDEF grip()\nPTP home\nEND\n");
  const auto copy = file("weld_old.src", "DEF weld()\n grip()\nEND\nDEF grip()\nEND\n");
  const auto in_comment = file("clean.src", "DEF clean()\nEND\n");
  const auto local = file("cell.src", "DEF cell()\nEND\nDEF home()\nEND\n");  // a file's second routine is local to it
  CHECK(related_files({program}, {copy, in_comment, local}).empty());
  // Calls have brackets or stand alone. A component of a position or a variable is not a call.
  const auto moves = file("moves.src", "DEF moves()\nPTP {X 1,Y 2}\nPTP place\n  last \nEND\n");
  const auto x = file("x.src", "DEF x()\nEND\n"), place = file("place.src", "DEF place()\nEND\n"),
             last = file("last.src", "DEF last()\nEND\n");
  CHECK(related_files({moves}, {x, place, last}) == std::vector{last});
  CHECK(related_files({moves}, {x, place}, "Place") == std::vector{place});
  const auto module = file("list.src", "DEF list()\n place:go()\nEND\n");
  CHECK(related_files({module}, {x, place}) == std::vector{place});
  // Names of the first program are local to it. Names of a module may occur in two files.
  CHECK(related_files({in_comment, program}, {copy}) == std::vector{copy});
  const auto system = file("more.dat", "DEFDAT $more\nDECL E6POS anywhere\nENDDAT\n");
  CHECK(related_files({program}, {system}) == std::vector{system});
}
