// The pages of the project: the real reader reads every YAML example, and every command runs.

#include <map>
#include <regex>
#include <set>
#include "tests/catch.h"

#include "pipeline/advise/plan/duty.h"
#include "pipeline/job/job.h"
#include "pipeline/resolve/job_text.h"
#include "pipeline/settings/document.h"
#include "pipeline/study/study.h"
#include "tests/cli/process.h"

using namespace dresslife;
using namespace dresslife::tests;

namespace {

const fs::path source = DRESSLIFE_SOURCE_DIR;

/// Returns every page except the change log, whose commands are those of older versions.
std::vector<fs::path> pages() {
  std::vector<fs::path> found{source / "README.md", source / "CONTRIBUTING.md"};
  for (const char* folder : {"config", "sim", "strain", "fatigue", "pipeline"})
    for (const auto& entry : fs::recursive_directory_iterator(source / folder))
      if (entry.path().extension() == ".md") found.push_back(entry.path());
  std::sort(found.begin(), found.end());
  return found;
}

/// Coarse and fast, with few uncertain parameters; the commands behave alike otherwise.
const std::string quick =
    " --quiet --set simulation.segments=10 --set simulation.time_step_ms=10 --set simulation.sample_rate_Hz=5 "
    "--set strain.surface_fibres=0 --set strain.cable_elements_per_segment=1 --set uncertainty.hose_stiffness=1 "
    "--set uncertainty.slack=1 --set uncertainty.friction_hose=1";

/// Commands of pages and the commands that the test runs instead: shipped files instead of the user's own, and fast settings.
/// `not run`: the command builds or takes hours; then its program must exist.
const std::map<std::string, std::string> instead{
    {"scripts/run config/studies/two_robots.yaml", "dresslife run two_robots" + quick},
    {"dresslife draw CABLE.yaml -o cable.svg", "dresslife draw control_cable -o cable.svg"},
    {"dresslife rate CABLE.yaml", "dresslife rate control_cable"},
    {"dresslife new --robot NAME_OR_URDF --program FILE --dresspack NAME JOB.yaml",
     "dresslife new --robot abb_irb6640_185_280 --program roof.mod --dresspack handling made.yaml"},
    {"dresslife new", "dresslife new"},
    {"dresslife run STUDY", "not run"},
    {"dresslife report STUDY", "not run"},
    {"dresslife new --robot abb_irb6640_185_280 --program door.mod --dresspack spot_welding job.yaml",
     "dresslife new --robot abb_irb6640_185_280 --program door.mod --dresspack spot_welding job.yaml"},
    {"dresslife check job.yaml", "dresslife check job.yaml"},
    {"dresslife run cell.yaml", "dresslife run cell.yaml" + quick},
    {"dresslife duty shift.yaml", "not run"},  // tests/cli/log_test
    {"dresslife duty shifts.yaml", "dresslife duty shifts.yaml" + quick},
    {"dresslife check JOB.yaml", "dresslife check irb6640_spot_welding --set simulation.segments=16"},
    {"dresslife preview JOB.yaml", "dresslife preview irb6640_spot_welding"},
    {"dresslife route ROBOT_OR_JOB",
     "dresslife route abb_irb4600_60_205 --scale 0.5 --tried 60 --short-runs 20 --seed 2 --set uncertainty.enabled=false --set "
     "dresspack.components.1.slack_percent=1" +
         quick},
    {"dresslife run JOB.yaml", "dresslife run irb6640_spot_welding" + quick},
    {"dresslife improve JOB_OR_STUDY",
     "dresslife improve side_panel --trials 2 --short-runs 0 --off 0 --set uncertainty.enabled=false" + quick},
    {"dresslife duty FILE", "dresslife duty two_robots" + quick},
    {"dresslife duty DUTIES.yaml", "dresslife duty two_robots" + quick},
    {"dresslife plan FLEET.csv --duties DUTIES.yaml --windows 2027-07-12..2027-08-01", "not run"},  // as below
    {"dresslife plan FLEET.csv --duties DUTIES.yaml --windows 2027-07-12..2027-08-01,2027-12-20..2028-01-02",
     "dresslife plan CONFIG/duties/fleet.csv --duties two_robots --today 2026-11-23 --windows "
     "2027-07-12..2027-08-01,2027-12-20..2028-01-02" +
         quick},
    {"dresslife reprogram JOB_OR_STUDY", "not run"},  // tests/cli/improve_test
    {"dresslife-sim JOB.yaml -o motion.h5", "dresslife-sim CONFIG/jobs/irb6640_spot_welding.yaml -o motion.h5" + quick},
    {"dresslife-strain motion.h5 -o strain.h5", "dresslife-strain motion.h5 -o strain.h5"},
    {"dresslife-fatigue strain.h5 -o life.h5", "not run"},  // its page comes before the page that makes strain.h5
    {"dresslife validate config/observations/published.yaml", "dresslife validate two_published.yaml"},
    {"dresslife validate config/observations/ratings.yaml", "not run"},  // like the file before
    {"dresslife validate config/observations/laws.yaml", "dresslife validate CONFIG/observations/laws.yaml"},
    {"dresslife rate control_cable --set calibration=config/observations/typical_cables.yaml",
     "dresslife rate control_cable --set calibration=CONFIG/observations/typical_cables.yaml"},
    {"dresslife calibrate your_cable", "dresslife calibrate your_cable"},
    {"dresslife draw control_cable", "dresslife draw control_cable"},
    {"dresslife rate control_cable", "dresslife rate control_cable"},
    {"dresslife rate control_cable --set calibration=runs/calibrate_your_cable/calibration.yaml",
     "dresslife rate control_cable --set calibration=runs/calibrate_your_cable/calibration.yaml"},
    {"dresslife-sim config/rigs/torsion.yaml -o motion.h5 --set 'dresspack.cable={from: spot_welding}'",
     "dresslife-sim CONFIG/rigs/torsion.yaml -o motion.h5 --set 'dresspack.cable={from: spot_welding}'"},
    {"dresslife import PROGRAM -o motion.yaml --answers answers.yaml",
     "dresslife import CONFIG/programs/pick_and_place.src -o answered.yaml --answers answers.yaml"},
    {"dresslife calibrate plant.csv", "not run"},  // tests/cli/calibrate_test
    {"dresslife run job.yaml --set calibration=runs/calibrate_plant/calibration.yaml", "not run"},
    {"dresslife manual KEY", "dresslife manual slack_percent"},
    {"dresslife manual data_sheet", "dresslife manual data_sheet"},
    {"dresslife check own_hose.yaml", "dresslife check own_hose.yaml"},
    {"dresslife rate sensor_cable", "dresslife rate sensor_cable"},
    {"dresslife preview irb6640_spot_welding --set routing.free_length_m=1.6 -o short.html",
     "dresslife preview irb6640_spot_welding --set routing.free_length_m=1.6 -o short.html"},
    {"dresslife draw NAME -o FILE.svg", "dresslife draw handling -o handling.svg"},
    {"dresslife show JOB.yaml", "dresslife show irb6640_spot_welding"},
    {"dresslife import PROGRAM -o motion.yaml", "dresslife import CONFIG/programs/pick_and_place.src -o motion.yaml"},
    {"dresslife import LOG.csv --log JOB.yaml -o shift.yaml", "not run"},       // tests/cli/log_test
    {"dresslife export runs/two_robots/hard --paraview hard.xdmf", "not run"},  // tests/cli/paraview_test
    {"dresslife plot JOB --what bending", "not run"},                           // tests/cli/plot_test
    {"dresslife show FILE.h5", "dresslife show motion.h5"},
    {"dresslife submit STUDY", "not run"},  // needs a cluster: tests/pipeline/study
    {"dresslife run --launcher WORDS", "not run"},
    {"dresslife clean STUDY", "not run"},  // tests/cli/study_test
    {"dresslife route ROBOT", "not run"},  // as above
    {"dresslife-sim --preview", "not run"},
};

/// Returns "dresslife run x" for "build/bin/dresslife run x   # words" and "$ dresslife run x"; empty: another command.
std::string command_of(std::string line) {
  line = std::regex_replace(line, std::regex("^\\s*(\\$ )?(build/bin/)?"), "");
  line = std::regex_replace(line, std::regex("\\s+#.*$|\\s+$"), "");
  static const std::regex ours("(dresslife(-sim|-strain|-fatigue|-import)?|scripts/[a-z]+)( .*)?");
  return std::regex_match(line, ours) ? line : "";
}

struct Piece {
  bool yaml = false;  ///< false: a command
  std::string text;
  int line = 0;
};

/// Returns the commands and YAML examples of a page in their order: indented or fenced lines, and `words like this`.
std::vector<Piece> pieces_of(const fs::path& page) {
  std::istringstream lines(content(page));
  std::vector<Piece> pieces;
  static const std::regex quoted("`([^`]+)`");
  int number = 0;
  bool yaml = false, fenced = false;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    if (line.find("<!-- generated below this line") != std::string::npos) break;
    if (line.starts_with("```")) {
      yaml = line == "```yaml", fenced = !fenced;
      if (yaml) pieces.push_back({true, "", number + 1});
    } else if (yaml) {
      pieces.back().text += line + "\n";
    } else if (fenced || line.starts_with("    ")) {
      if (const std::string command = command_of(line); !command.empty()) pieces.push_back({false, command, number});
    } else {
      for (std::sregex_iterator found(line.begin(), line.end(), quoted), end; found != end; ++found)
        if (const std::string command = command_of((*found)[1]); !command.empty())
          pieces.push_back({false, command, number});
    }
    if (line == "```") yaml = false;
  }
  return pieces;
}

/// Reads a job, a study, duties, or keys of a job, which are added to a small job.
void read_example(const std::string& text, const fs::path& file) {
  std::ofstream(file) << text;
  pipeline::Node document = pipeline::read_yaml(file);
  if (document.find("duties")) {
    CHECK_FALSE(pipeline::read_duties(file).duties.empty());
    return;
  }
  if (document.find("base")) {
    for (const pipeline::StudyJob& job : pipeline::read_study(file).jobs) {
      INFO(job.name << ": " << job.failure);
      CHECK(job.failure.empty());
    }
    return;
  }
  if (!document.find("motion")) {
    pipeline::Node job = pipeline::parse_yaml(
        "motion: {rig: {kind: torsion, twist_deg_per_m: 180}}\ndresspack: {cable: control_cable}\n", file.string());
    for (const pipeline::Entry& entry : document.entries)
      (entry.key == "ratings" ? job["dresspack"] : job)[entry.key] = entry.value;
    document = job;
  }
  CHECK_NOTHROW(pipeline::job_from(document));
}

/// Writes the first two of the published observations.
void write_two_published(const Scratch& scratch) {
  const std::string all = content(source / "config/observations/published.yaml");
  std::size_t end = 0;
  for (int rows = 0; rows < 3; ++rows) end = all.find("\n  - name:", end + 1);
  scratch.write("two_published.yaml", all.substr(0, end + 1));
}

/// Writes the programs that config/own_programs.md uses as the user's own.
void write_own_programs(const Scratch& scratch) {
  const auto module = [](const std::string& name, const std::string& there) {
    const std::string home = "[[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]]", rest = ", v1000, fine, tool0;\n";
    return "MODULE " + name + "\n  PROC main()\n    MoveAbsJ " + home + rest + "    MoveAbsJ [[" + there +
           "],[9E9,9E9,9E9,9E9,9E9,9E9]]" + rest + "    MoveAbsJ " + home + rest + "  ENDPROC\nENDMODULE\n";
  };
  scratch.write("door.mod", module("door", "20,10,0,0,60,60"));
  scratch.write("roof.mod", module("roof", "-30,0,10,0,60,-90"));
}

/// Writes an example that begins with "# NAME.yaml" as a file for the commands after it.
void write_named_example(const Scratch& scratch, const std::string& text) {
  std::smatch found;
  if (std::regex_search(text, found, std::regex("^# ([a-z_]+\\.yaml)\n"))) scratch.write(found[1], text);
}

/// Checks that the program of a command that is not run exists and has this command.
void check_program(const std::string& command) {
  std::istringstream words(command);
  std::string program, name;
  words >> program >> name;
  if (program.starts_with("scripts/")) {
    const bool perl = content(source / program).starts_with("#!/usr/bin/env perl");
    CHECK(std::system(((perl ? "perl -c '" : "bash -n '") + (source / program).string() + "' 2>&1").c_str()) == 0);
    return;
  }
  static std::set<std::string> known;
  static const std::regex command_name("[a-z]+");
  const std::string called = program + (std::regex_match(name, command_name) ? " " + name : "");
  if (!known.insert(called).second) return;
  Scratch scratch;
  CHECK(run(scratch, program, called.substr(program.size()) + " --help").status == 0);
}

/// Runs a command of a page, or its substitute.
void try_command(const Scratch& scratch, const std::string& command) {
  const auto known = instead.find(command);
  const bool bare = command.find(' ') == command.rfind(' ') &&
                    command.find_first_of(".=/ ", command.find(' ') + 1) == std::string::npos;
  if (known == instead.end() && (bare || command.starts_with("scripts/"))) return check_program(command);
  INFO("a page's command that this test does not know: add it to `instead`");
  REQUIRE(known != instead.end());
  if (known->second == "not run") return check_program(command);
  const std::string line = replaced_all(known->second, "CONFIG", "'" + (source / "config").string() + "'");
  const std::size_t space = line.find(' ');
  const Outcome outcome = run(scratch, line.substr(0, space), line.substr(space + 1));
  INFO(line);
  INFO(outcome.out);
  INFO(outcome.err);
  // A routing with fast settings may exceed a limit. Then `improve` ends with 1 and reports that no other job keeps them.
  CHECK(
      (outcome.status == 0 || (outcome.status == 1 && command.find("improve") != std::string::npos &&
                               outcome.out.find("No other job that keeps all limits was found") != std::string::npos)));
}

}  // namespace

TEST_CASE("every YAML example of every page is read, and every command runs") {
  std::set<std::string> done;
  Scratch scratch;  // one for all pages: commands use files of the commands before them
  write_two_published(scratch);
  write_own_programs(scratch);
  for (const fs::path& page : pages()) {
    for (const Piece& piece : pieces_of(page)) {
      INFO(fs::relative(page, source).string() << ":" << piece.line << ": " << piece.text);
      if (piece.yaml) {
        write_named_example(scratch, piece.text);
        read_example(piece.text, scratch / "example.yaml");
      } else if (done.insert(piece.text).second) {
        try_command(scratch, piece.text);
      }
    }
  }
  CHECK(done.size() > 30);  // proves that pages are found
}
