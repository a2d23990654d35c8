// An installation works at any place: no file in it refers to the sources or the build.

#include "tests/cli/process.h"

#include "tests/catch.h"

using namespace dresslife::tests;

namespace {

/// Runs a shell command in the scratch folder, without environment variables that name a catalogue.
Outcome shell(const Scratch& scratch, const std::string& command) {
  const fs::path out = scratch / ".out", err = scratch / ".err";
  scratch.write(".command", "cd '" + scratch.folder().string() + "'\nunset DRESSLIFE_CONFIG\n" + command + "\n");
  const std::string line =
      "bash '" + (scratch / ".command").string() + "' >'" + out.string() + "' 2>'" + err.string() + "' </dev/null";
  const int status = std::system(line.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, content(out), content(err)};
}

/// Installs under `first`, then moves the installation to `place`, so that a path stored at installation is invalid.
void install(const Scratch& scratch, const std::string& place) {
  const Outcome installed =
      shell(scratch, "cmake --install '" DRESSLIFE_BIN_DIR "/..' --prefix first --strip && mv first '" + place + "'");
  INFO(installed.out << installed.err);
  REQUIRE(installed.status == 0);
}

const char* const programs[] = {"dresslife", "dresslife-sim", "dresslife-strain", "dresslife-fatigue",
                                "dresslife-import"};

}  // namespace

TEST_CASE("an installation has programs, catalogue, pages, manuals, completions and licence in their places") {
  Scratch scratch;
  install(scratch, "place");
  for (const std::string program : programs)
    for (const std::string& file :
         {"bin/" + program, "share/man/man1/" + program + ".1.gz", "share/bash-completion/completions/" + program,
          "share/zsh/site-functions/_" + program})
      CHECK(fs::exists(scratch / "place" / file));
  for (const std::string file :
       {"config/README.md", "config/jobs/irb6640_spot_welding.yaml", "config/robots/abb_irb6640_185_280.yaml"})
    CHECK(fs::exists(scratch / "place/share/dresslife" / file));
  for (const std::string page :
       {"copyright", "README.md", "CHANGELOG.md", "sim/README.md", "sim/program/README.md", "strain/README.md",
        "fatigue/README.md", "pipeline/README.md", "config/README.md", "config/studies/two_robots.png"})
    CHECK(fs::exists(scratch / "place/share/doc/dresslife" / page));
}

TEST_CASE("nothing installed holds a path of the sources") {
  Scratch scratch;
  install(scratch, "place");
  const std::string source = fs::canonical(DRESSLIFE_SOURCE_DIR).string();
  int files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(scratch / "place")) {
    CHECK_FALSE(entry.is_symlink());
    if (!entry.is_regular_file()) continue;
    ++files;
    INFO(entry.path());
    CHECK(content(entry.path()).find(source) == std::string::npos);
  }
  CHECK(files > 50);
}

TEST_CASE(
    "an installed dresslife runs a study from any folder, by path, link or search path, with its own "
    "catalogue") {
  Scratch scratch;
  install(scratch, "a place");
  write_small_job(scratch);
  scratch.write("study.yaml", "base: job.yaml\n");
  // The job names copper, which exists only in the catalogue. A change of it reveals which catalogue was read.
  const std::string copper = "a place/share/dresslife/config/materials/copper.yaml",
                    shipped = "youngs_modulus_GPa: 117";
  std::string text = content(scratch / copper);
  const std::size_t at = text.find(shipped);
  REQUIRE(at != std::string::npos);
  scratch.write(copper, text.replace(at, shipped.size(), "youngs_modulus_GPa: 111"));

  fs::create_directories(scratch / "links");
  fs::create_symlink("../a place/bin/dresslife", scratch / "links/dresslife");
  const std::string calls[] = {"'a place/bin/dresslife'", "links/dresslife", "PATH='a place/bin':$PATH dresslife"};
  std::string ranking;
  for (const std::string& call : calls) {
    const Outcome outcome = shell(scratch, "rm -rf runs; " + call + " run study.yaml");
    INFO(call << "\n" << outcome.err << outcome.out);
    REQUIRE(outcome.status == 0);
    CHECK(content(scratch / "runs/study/study/job.yaml").find("youngs_modulus_GPa: 111") != std::string::npos);
    if (ranking.empty()) ranking = content(scratch / "runs/study/ranking.csv");
    CHECK(content(scratch / "runs/study/ranking.csv") == ranking);
  }
  CHECK(ranking.find("\nstudy,") != std::string::npos);

  const Outcome version = shell(scratch, "links/dresslife --version");
  CHECK(version.out.find("\ncatalogue: " + (scratch / "a place/share/dresslife/config").string() + "\n") !=
        std::string::npos);
  CHECK(shell(scratch, "links/dresslife import --help").out.find("dresslife-import") != std::string::npos);
}

TEST_CASE("studies and jobs of the catalogue go by their names") {
  Scratch scratch;
  const Outcome status = run(scratch, "dresslife", "status two_robots");
  CHECK(status.status == 0);
  CHECK(status.out.find("spot_robot_1") != std::string::npos);
  CHECK(run(scratch, "dresslife", "show irb6640_spot_welding").out.find("abb_irb6640") != std::string::npos);
  const Outcome unknown = run(scratch, "dresslife", "status two_robot");
  CHECK(unknown.status == 1);
  CHECK(unknown.err.find("two_robot: error: is no file, and ") == 0);
  CHECK(unknown.err.find(
            "config holds no jobs/two_robot.yaml or studies/two_robot.yaml; did you mean 'two_robots'? Else write the "
            "path of a YAML file\n") != std::string::npos);
}

TEST_CASE("programs without their catalogue say what is missing, unless the job needs none") {
  Scratch scratch;
  install(scratch, "place");
  write_small_job(scratch);
  fs::rename(scratch / "place/share/dresslife/config", scratch / "kept");
  const Outcome without = shell(scratch, "place/bin/dresslife show job.yaml");
  CHECK(without.status == 1);
  CHECK(without.err == (scratch / "place/share/dresslife/config").string() +
                           ": error: does not exist (the catalogue is in share/, beside the programs' bin/); move both "
                           "together, or let DRESSLIFE_CONFIG name the catalogue\n");
  CHECK(shell(scratch, "DRESSLIFE_CONFIG=kept place/bin/dresslife show job.yaml").status == 0);
  fs::create_directories(scratch / "materials");
  fs::copy(scratch / "kept/materials/copper.yaml", scratch / "materials/copper.yaml");
  CHECK(shell(scratch, "place/bin/dresslife show job.yaml").status == 1);  // it needs the makers' ratings
  CHECK(shell(scratch, "place/bin/dresslife show job.yaml --set uncertainty.ratings=none").status == 0);
}

TEST_CASE("bash completes commands, options and their words") {
  Scratch scratch;
  // As readline does: the words typed so far; the last one is to be completed.
  const auto completed = [&](const std::string& program, const std::string& words) {
    const std::string function = program == "dresslife" ? "_dresslife" : "_dresslife_sim";
    scratch.write("try.sh", "source '" DRESSLIFE_BIN_DIR "/../share/bash-completion/completions/" + program +
                                "'\nCOMP_WORDS=(" + words + ")\nCOMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n" + function +
                                "\necho ${COMPREPLY[@]}\n");
    const Outcome outcome = shell(scratch, "bash try.sh");
    CHECK(outcome.err == "");
    return outcome.out;
  };
  CHECK(completed("dresslife", "dresslife r") == "run report reprogram rate route\n");
  CHECK(completed("dresslife", "dresslife run --q") == "--quiet\n");
  CHECK(completed("dresslife", "dresslife manual ''") == "keys files ranking.csv man bash zsh\n");
  CHECK(completed("dresslife", "dresslife run ''") == "\n");  // then bash offers files
  CHECK(completed("dresslife-sim", "dresslife-sim job.yaml --s") == "--set --screen --short-runs --seed --same\n");
  CHECK(completed("dresslife-sim", "dresslife-sim --manual b") == "bash\n");
}
