// Inputs that are not regular files, or that are too large: each is refused with one line, and no program waits.
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <iostream>
#include <random>

#include "tests/catch.h"
#include "tests/cli/process.h"
#include "tests/faults/failing_calls.h"

using namespace dresslife::tests;

namespace {

/// A program that reads a file. INPUT stands for the strange file.
struct Reader {
  std::string program, arguments, ending;
  std::string beside{};  ///< a file that refers to it
};
const std::vector<Reader> readers{
    {"dresslife", "run INPUT", ".yaml"},
    {"dresslife", "status INPUT", ".yaml"},
    {"dresslife", "report INPUT", ".yaml"},
    {"dresslife", "clean INPUT", ".yaml"},
    {"dresslife", "submit INPUT --only-write", ".yaml"},
    {"dresslife", "submit study.yaml --only-write --cluster INPUT", ".yaml"},
    {"dresslife", "duty INPUT", ".yaml"},
    {"dresslife", "plan INPUT --duties duties.yaml --today 2026-11-23 --windows 2027-01-05", ".csv"},
    {"dresslife", "plan fleet.csv --duties INPUT --today 2026-11-23 --windows 2027-01-05", ".yaml"},
    {"dresslife", "improve INPUT", ".yaml"},
    {"dresslife", "reprogram INPUT", ".yaml"},
    {"dresslife", "check INPUT", ".yaml"},
    {"dresslife", "new --robot INPUT --program swing.mod new.yaml", ".urdf"},
    {"dresslife", "page INPUT", ""},
    {"dresslife", "show INPUT", ".yaml"},
    {"dresslife", "show INPUT", ".h5"},
    {"dresslife", "plot INPUT --what cycles -o p.svg", ".h5"},
    {"dresslife", "export INPUT --paraview p.xdmf", ".h5"},
    {"dresslife", "rate INPUT", ".yaml"},
    {"dresslife", "validate INPUT", ".yaml"},
    {"dresslife", "calibrate INPUT", ".yaml"},
    {"dresslife", "draw INPUT", ".yaml"},
    {"dresslife", "preview INPUT", ".yaml"},
    {"dresslife", "route INPUT", ".yaml"},
    {"dresslife-sim", "INPUT -o m.h5", ".yaml"},
    {"dresslife-sim", "named.yaml -o m.h5", ".csv", "motion: {clamp_poses: INPUT}\n"},
    {"dresslife-sim", "named.yaml -o m.h5", ".mod", "robot: abb_irb6640_185_280\nmotion: {program: INPUT}\n"},
    {"dresslife-sim", "named.yaml -o m.h5", ".urdf", "robot: {urdf: INPUT}\nmotion: easy\n"},
    {"dresslife-sim", "named.yaml -o m.h5", ".stl",
     "motion: {clamp_poses: poses.csv}\ncell: {meshes: [{file: INPUT}]}\n"},
    {"dresslife-strain", "INPUT -o s.h5", ".h5"},
    {"dresslife-strain", "motion.h5 --job INPUT -o s.h5", ".yaml"},
    {"dresslife-fatigue", "INPUT -o l.h5", ".h5"},
    {"dresslife-import", "INPUT -o i.yaml", ".mod"},
    {"dresslife-import", "INPUT -o i.yaml", ".src"},
    {"dresslife-import", "INPUT -o i.yaml", ".ls"},
    {"dresslife-import", "INPUT -o i.yaml", ".csv"},
    {"dresslife-import", "INPUT -o i.yaml", ".jbi"},
    {"dresslife-import", "INPUT -o i.yaml", ".script"},
    {"dresslife-import", "INPUT -o i.yaml", ".json"},
    {"dresslife-import", "swing.mod --answers INPUT -o i.yaml", ".yaml"},
    {"dresslife-import", "swing.mod --frames INPUT -o i.yaml", ".yaml"},
    {"dresslife-import", "swing.mod --module INPUT -o i.yaml", ".mod"},
    {"dresslife", "status named.yaml", ".csv", "base: job.yaml\ntable: INPUT\n"},
    {"dresslife", "status named.yaml", ".yaml", "base: INPUT\n"},
};

/// Creates the strange files in the folder. Returns all names.
std::vector<std::string> make_strange_files(const Scratch& scratch, const std::string& ending) {
  REQUIRE(::mkfifo((scratch / ("pipe" + ending)).c_str(), 0600) == 0);
  fs::create_symlink("/dev/zero", scratch / ("zero" + ending));
  fs::create_symlink("/dev/null", scratch / ("null" + ending));
  scratch.write("sparse" + ending, "");
  fs::resize_file(scratch / ("sparse" + ending), std::uintmax_t{1} << 40);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::string name = (scratch / ("socket" + ending)).string();
  REQUIRE(name.size() < sizeof address.sun_path);
  name.copy(address.sun_path, name.size());
  const int made = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  REQUIRE(::bind(made, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0);
  ::close(made);
  return {"pipe" + ending, "zero" + ending, "null" + ending, "sparse" + ending, "socket" + ending};
}

}  // namespace

TEST_CASE("a pipe, a device, a socket and a terabyte of nothing are refused as any input, at once") {
  const unsigned seed = std::random_device{}();
  std::mt19937 random(seed);
  int tries = 0;
  for (const Reader& reader : readers) {
    Scratch scratch;
    write_small_job(scratch);
    scratch.write("study.yaml", "base: job.yaml\n");
    scratch.write("fleet.csv", "name,duty,installed\nr,d,\n");
    scratch.write("swing.mod", "MODULE swing\n  PROC main()\n    MoveJ p, v100, fine, tool0;\n  ENDPROC\nENDMODULE\n");
    const auto replaced = [](std::string text, const std::string& by) {
      return text.replace(text.find("INPUT"), 5, by);
    };
    if (reader.arguments.starts_with("motion.h5")) must_run(scratch, "dresslife-sim", "job.yaml -o motion.h5");
    for (const std::string& name : make_strange_files(scratch, reader.ending)) {
      if (rounds(1) == 1 && random() % 3 != 0) continue;
      std::string arguments = reader.arguments;
      if (reader.beside.empty())
        arguments = replaced(arguments, name);
      else if (reader.beside.starts_with("base"))
        scratch.write("named.yaml", replaced(reader.beside, name));
      else {
        const std::string job = content(scratch / "job.yaml");
        scratch.write("named.yaml", replaced(reader.beside, name) + job.substr(job.find("dresspack:")));
      }
      constexpr const char* longest =
          "timeout -s KILL 20";  // [s] on a busy machine; each usually takes a tenth of a second
      const Outcome outcome = run_with(scratch, longest, reader.program, arguments);
      INFO(reader.program << ' ' << arguments << ": " << outcome.status << '\n' << outcome.err);
      CHECK(outcome.status == 1);
      // A job without clamps is refused before its program is read. A device is named as the target of the link.
      const bool without_clamps = outcome.err.find("routing.base_clamp is missing") != std::string::npos;
      CHECK((without_clamps || is_one_error(outcome.err)));
      CHECK((without_clamps || outcome.err.find(name) != std::string::npos ||
             outcome.err.find("dev/") != std::string::npos));
      CHECK_FALSE(holds_parts(scratch.folder()));
      ++tries;
    }
  }
  std::cout << "strange inputs with seed " << seed << ": " << tries << " refused\n";
}

TEST_CASE("a strange file in the place of a result stops nothing but what needs it, and nothing waits for it") {
  for (const std::string name :
       {"motion.h5", "strain.h5", "life.h5", "page.html", "job.yaml", "log", ".stage/sim.receipt", ".stage/failure",
        "../ranking.csv", "../report.html", "../.stage/study", "../.lock"}) {
    Scratch scratch;
    write_small_job(scratch);
    scratch.write("study.yaml", "base: job.yaml\njobs: {a: {}}\n");
    must_run(scratch, "dresslife", "run study.yaml --quiet");
    const fs::path file = scratch / ("runs/study/a/" + name);
    fs::remove(file);
    REQUIRE(::mkfifo(file.c_str(), 0600) == 0);
    for (const std::string command :
         {"status study.yaml", "report study.yaml", "page runs/study/a", "show runs/study/a",
          "plot runs/study/a --what cycles -o p.svg", "run study.yaml", "clean study.yaml"}) {
      const Outcome outcome = run_with(scratch, "timeout -s KILL 20", "dresslife", command);
      INFO(name << ": " << command << ": " << outcome.status << outcome.err);
      CHECK((outcome.status == 0 || outcome.status == 1));
      CHECK((outcome.status == 0 || !outcome.err.empty()));
    }
    if (name.ends_with(".h5"))  // a result that exists but cannot be read must not be left out
      for (const std::string command : {"page runs/study/a", "export runs/study/a --paraview p.xdmf"}) {
        const Outcome outcome = run_with(scratch, "timeout -s KILL 20", "dresslife", command);
        INFO(name << ": " << command << ": " << outcome.status << outcome.err);
        CHECK(outcome.status == 1);
        CHECK(outcome.err.find(name + ": error: is a device or a pipe, not a file") != std::string::npos);
      }
    CHECK(fs::is_fifo(file));
  }
}

TEST_CASE("no run waits for a pipe or writes through a link among the notes of a study") {
  Scratch scratch;
  write_small_job(scratch);
  scratch.write("study.yaml", "base: job.yaml\njobs: {a: {}}\n");
  scratch.write("mine.txt", "mine\n");
  must_run(scratch, "dresslife", "run study.yaml --quiet");
  const std::string changed = "run study.yaml --quiet --set strain.gate=0.0007";
  for (const std::string name : {"a/.stage/strain.log", ".stage/.ninja_log", ".stage/.ninja_deps"})
    for (const bool is_pipe : {true, false}) {
      const fs::path note = scratch / ("runs/study/" + name);
      fs::remove(note);
      if (is_pipe)
        REQUIRE(::mkfifo(note.c_str(), 0600) == 0);
      else
        fs::create_symlink(scratch / "mine.txt", note);
      const Outcome outcome = run_with(scratch, "timeout -s KILL 20", "dresslife", changed);
      INFO(name << ": " << outcome.status << outcome.err);
      CHECK(outcome.status == 1);
      CHECK(outcome.err.find(name + ": error: is a link, a device or a pipe") != std::string::npos);
      CHECK(content(scratch / "mine.txt") == "mine\n");
      fs::remove(note);
    }
  CHECK(run(scratch, "dresslife", changed).status == 0);
}

TEST_CASE("a folder in the place of the poses is refused in every mode of the simulation") {
  Scratch scratch;
  write_small_job(scratch);
  fs::remove(scratch / "poses.csv");
  fs::create_directory(scratch / "poses.csv");
  scratch.write("list.yaml", "- {routing.free_length_m: 0.95}\n");
  for (const std::string mode : {"", "--preview", "--screen list.yaml", "--screen list.yaml --by-short-runs"}) {
    const Outcome outcome = run(scratch, "dresslife-sim", "job.yaml -o out.h5 --quiet " + mode);
    INFO(mode << ": " << outcome.err);
    CHECK(outcome.status == 1);
    CHECK(outcome.err.find("poses.csv: error: is a folder, not a file; name a file") != std::string::npos);
    CHECK(is_one_error(outcome.err));
    CHECK_FALSE(fs::exists(scratch / "out.h5"));
  }
}

TEST_CASE("three million values and a hundred megabytes of comment are refused before they are understood") {
  Scratch scratch;
  write_small_job(scratch);
  const std::string job = content(scratch / "job.yaml");
  scratch.write("comment.yaml", "# " + std::string(100'000'000, 'x') + '\n' + job);
  std::string list = "note: [";
  for (int k = 0; k < 3'000'000; ++k) list += "1,";
  scratch.write("list.yaml", list + "1]\n" + job);
  for (const char* name : {"comment.yaml", "list.yaml"}) {
    // Half a second of time, and memory of the text's size.
    const Outcome outcome =
        run_with(scratch, "ulimit -t 4; ulimit -v 800000;", "dresslife", std::string("show ") + name);
    INFO(outcome.err);
    CHECK(outcome.status == 1);
    CHECK(is_one_error(outcome.err));
    CHECK(outcome.err.find("are read") != std::string::npos);
  }
}
