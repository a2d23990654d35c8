#include "pipeline/base/program_files.h"

#include <sstream>

#include "tests/pipeline/scratch.h"

using namespace dresslife::pipeline;

TEST_CASE("program files: what each maker's controller sees beside a program, sorted") {
  const Scratch scratch;
  std::istringstream names(
      "abb/a.MOD abb/b.txt abb/list.pgf abb/sys/c.sysx abb/BACKINFO.TXT kuka/a.src kuka/a.dat kuka/b.sub kuka/c.ls "
      "kuka/in/d.src backup/R1/Program/a.src backup/R1/Mada/b.dat backup/R1/b.ls backup/other.src yaskawa/a.jbi "
      "yaskawa/b.JBI yaskawa/tool.cnd yaskawa/var.dat yaskawa/other.dat fanuc/prog/a.ls fanuc/prog/b.ls "
      "fanuc/prog/c.va fanuc/d.va fanuc/e.ls universal/a.script universal/b.script");
  for (std::string name; names >> name;) scratch.write(name, "");
  const auto beside = [&](const std::string& program) {
    std::string found;
    for (const std::filesystem::path& file : program_files(scratch / program))
      found += std::filesystem::weakly_canonical(file).lexically_relative(scratch / "").string() + " ";
    return found;
  };
  CHECK(beside("abb") == "abb/BACKINFO.TXT abb/a.MOD abb/list.pgf abb/sys/c.sysx ");
  CHECK(beside("abb/list.pgf") == beside("abb"));
  CHECK(beside("abb/a.MOD").empty());
  CHECK(beside("kuka/a.src") == "kuka/a.dat kuka/b.sub ");
  CHECK(beside("backup/R1/Program/a.src") == "backup/R1/Mada/b.dat ");
  CHECK(beside("yaskawa/a.jbi") == "yaskawa/b.JBI yaskawa/tool.cnd yaskawa/var.dat ");
  CHECK(beside("fanuc/prog/a.ls") == "fanuc/d.va fanuc/prog/b.ls fanuc/prog/c.va ");
  CHECK(beside("universal/a.script").empty());
}
