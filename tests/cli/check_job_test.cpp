// dresslife check: warnings and refusals of a run, without the run.
#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <sstream>

#include "pipeline/commands/checking.h"
#include "pipeline/files/files.h"
#include "tests/catch.h"
#include "tests/cli/process.h"

using namespace dresslife::tests;
using namespace dresslife::pipeline;

TEST_CASE("check: a job without faults, one whose slip is a bound, one that is too short, one that is misspelt") {
  Scratch scratch;
  write_small_job(scratch);
  const Outcome bound = run(scratch, "dresslife", "check job.yaml");
  INFO(bound.out << bound.err);
  CHECK(bound.status == 0);
  CHECK(bound.out.find("strain.slip is stick") != std::string::npos);
  CHECK(
      unwrapped(bound.out).find(
          "The dresspack was checked at rest and in short runs, also with a softer and a stiffer hose. A run may also warn of strains") !=
      std::string::npos);
  std::istringstream lines(bound.out);
  for (std::string line; std::getline(lines, line);) CHECK(line.size() <= 120);
  const Outcome narrow =
      run_shell(scratch, "script -qec \"stty cols 70; '" DRESSLIFE_BIN_DIR "/dresslife' check job.yaml\" /dev/null");
  CHECK(narrow.status == 0);
  std::size_t longest = 0;
  std::istringstream narrow_lines(replaced_all(narrow.out, "\r", ""));
  for (std::string line; std::getline(narrow_lines, line);) longest = std::max(longest, line.size());
  CHECK(longest <= 70);
  CHECK(longest > 60);  // a line ends before a word that does not fit; the longest word here has 9 letters
  const Outcome too_short = run(scratch, "dresslife", "check job.yaml --set routing.free_length_m=0.7");
  CHECK(too_short.status == 1);
  CHECK(too_short.out.find("The simulation refuses the job: ") != std::string::npos);
  CHECK(too_short.out.find("too short") != std::string::npos);
  const Outcome far_too_long = run(scratch, "dresslife", "check job.yaml --set routing.free_length_m=9");
  CHECK(far_too_long.out.find("least slack, length too long") != std::string::npos);
  CHECK(far_too_long.out.find("note: The short run of the checks was left out") != std::string::npos);
  CHECK(far_too_long.out.find("The motion of the dresspack was not checked") != std::string::npos);
  const Outcome misspelt = run(scratch, "dresslife", "check job.yaml --set routing.free_lenght_m=0.7");
  CHECK(misspelt.status == 1);
  CHECK(misspelt.err.find("did you mean 'free_length_m'?") != std::string::npos);
  const auto entries = std::distance(fs::directory_iterator(scratch.folder()), fs::directory_iterator{});
  CHECK(entries == 4);  // job, poses, .out, .err: a check leaves no files
}

TEST_CASE("check: a single cable is warned of friction that gathers over too great a length, as in a run") {
  Scratch scratch;
  // Wires in long waves slide as lines, cores do not.
  const std::string job = "'" + std::string(DRESSLIFE_SOURCE_DIR) +
                          "/config/jobs/bending_cable.yaml' --set dresspack=control_cable --set "
                          "dresspack.components.1.data_sheet.lay_length_mm=250";
  CHECK_THAT(unwrapped(run(scratch, "dresslife", "check " + job).out),
             Catch::Contains("evens out over") && Catch::Contains("strain.friction_factor: 2.5"));
  CHECK_THAT(unwrapped(run(scratch, "dresslife", "check " + job + " --set strain.friction_factor=2.5").out),
             !Catch::Contains("evens out over"));
}

TEST_CASE("check: a rig that bends a cable tighter than allowed is warned of without a run") {
  const fs::path rig = fs::path(DRESSLIFE_SOURCE_DIR) / "config/rigs/two_pulley.yaml";
  const auto warned = [&](const std::string& limit) {
    const JobCheck check =
        check_of(rig, {"dresspack={cable: control_cable}", "dresspack.least_bend_radius_mm=" + limit});
    return std::any_of(check.warnings.begin(), check.warnings.end(),
                       [](const Warning& w) { return w.kind == WarningKind::bend_radius; });
  };
  CHECK(warned("200"));
  CHECK_FALSE(warned("10"));
}

TEST_CASE("check: what it warns of in the shipped jobs, a run warns of, too") {
  const Scratch scratch;
  const fs::path config = fs::path(DRESSLIFE_SOURCE_DIR) / "config";
  // Coarse and fast. With 32 segments the hose still bends as sharply as at rest.
  const std::vector<std::string> coarse{"simulation.segments=32",      "simulation.time_step_ms=10",
                                        "simulation.sample_rate_Hz=5", "strain.surface_fibres=0",
                                        "uncertainty.enabled=false",   "strain.cable_elements_per_segment=1"};
  std::vector<std::pair<std::string, std::string>> jobs;
  for (const auto& entry : fs::directory_iterator(config / "jobs"))
    if (entry.path().extension() == ".yaml") jobs.emplace_back(entry.path().stem().string(), "");
  for (const char* slip : {"stick", "free"}) {  // only bounds are computed: a note, which no run repeats as a warning
    const JobCheck bound = check_of(config / "jobs/bending_cable.yaml", {fmt::format("strain.slip={}", slip)});
    CHECK(std::any_of(bound.notes.begin(), bound.notes.end(),
                      [](const std::string& note) { return note.find("is a bound") != note.npos; }));
    CHECK(std::none_of(bound.warnings.begin(), bound.warnings.end(),
                       [](const Warning& w) { return w.kind == WarningKind::strain; }));
  }
  for (const char* motion : {"easy", "hard", "spot_robot_2"}) jobs.emplace_back("irb6640_spot_welding", motion);
  REQUIRE(jobs.size() > 8);
  for (const auto& [job, motion] : jobs) {
    CAPTURE(job, motion);
    std::vector<std::string> sets = coarse;
    if (!motion.empty()) sets.push_back("motion=" + motion);
    const fs::path file = config / "jobs" / (job + ".yaml");  // a name alone could be that of a study
    std::string line = "run '" + file.string() + "' --quiet -o " + job + motion;
    for (const std::string& set : sets) line += " --set " + set;
    const JobCheck check = check_of(file, sets);
    CHECK(check.refusal.empty());
    if (check.warnings.empty()) continue;  // no warning that a run would have to repeat
    must_run(scratch, "dresslife", line);
    const FileReader life(scratch / (job + motion + "/" + job + "/" + job + "/life.h5"), life_format(),
                          FileReader::Scope::attributes);
    std::set<WarningKind> kinds;
    for (const Warning& warning : warnings_from(life.text_attribute("warnings"))) kinds.insert(warning.kind);
    for (const Warning& warning : check.warnings) {
      INFO(warning.line());
      CHECK(kinds.count(warning.kind) == 1);
    }
  }
}
