// dresslife route: a job from a robot and a hose.

#include "pipeline/files/files.h"
#include "tests/catch.h"
#include "tests/cli/process.h"

using namespace dresslife::tests;
using dresslife::pipeline::FileReader;
using dresslife::pipeline::screening_format;

namespace {

/// Returns the number of receipts of stages below a folder; 0: no stage has run.
std::size_t results_in(const fs::path& folder) {
  if (!fs::exists(folder)) return 0;
  return static_cast<std::size_t>(std::count_if(fs::recursive_directory_iterator(folder), {}, [](const auto& entry) {
    return entry.path().extension() == ".receipt";
  }));
}

}  // namespace

TEST_CASE("route writes a job that runs, from a robot and a hose") {
  Scratch scratch;
  scratch.write("hose.yaml", thin_hose);
  const std::string line =
      "route abb_irb2600_12_165 --dresspack ./hose.yaml --scale 1 --tried 60 --short-runs 15 --off 0 --quiet "
      "--set simulation.segments=16 --set uncertainty.enabled=false --job found.yaml";
  const Outcome told = must_run(scratch, "dresslife", line);
  INFO(told.err);
  CHECK(told.out.find("base_clamp: {link: link_3, ") == 0);
  CHECK(told.out.find("tool_clamp: {link: link_6, ") != std::string::npos);
  CHECK(told.out.find("No program was given") != std::string::npos);
  CHECK(told.out.find("Job: found.yaml\nPreview: found_preview.html\n") != std::string::npos);
  CHECK(content(scratch / "found_preview.html").find("The simulation takes this job.") != std::string::npos);
  const std::string job = content(scratch / "found.yaml");
  CHECK(job.find("dresspack: ./hose.yaml\n") != std::string::npos);  // a reference is kept
  std::size_t runs = 0;
  for (const auto& entry : fs::directory_iterator(scratch / "runs/abb_irb2600_12_165_route"))
    runs += fs::exists(entry.path() / "life.h5");
  CHECK(runs == 1);  // only the winner's
  const Outcome ran = run(scratch, "dresslife-sim", "found.yaml -o motion.h5 --quiet");
  INFO(ran.err);
  CHECK(ran.status == 0);

  // The same command gives the same job again. A file of another origin is not changed.
  CHECK(run(scratch, "dresslife", line).status == 0);
  CHECK(content(scratch / "found.yaml") == job);
  const Outcome over = run(scratch, "dresslife", "route abb_irb2600_12_165 --job hose.yaml");
  CHECK(over.status == 1);
  CHECK(over.err ==
        "hose.yaml: error: is there already and was not written by dresslife, or was changed since; move it away, "
        "name another job with --job, or replace it with --force\n");

  // The job's own routing is no answer to the question for another link.
  const Outcome other =
      must_run(scratch, "dresslife",
               "route found.yaml --from link_4 --scale 1 --tried 60 --short-runs 15 --off 0 --quiet --job other.yaml");
  INFO(other.out << other.err);
  CHECK(other.out.find("base_clamp: {link: link_4, ") == 0);
  CHECK(other.out.find("own routing") == std::string::npos);
}

TEST_CASE("route finds clamps for a shipped hose that keep all limits in the whole chain") {
  Scratch scratch;
  const Outcome told =
      run(scratch, "dresslife",
          "route abb_irb4600_60_205 --scale 0.5 --tried 60 --short-runs 20 --quiet --bracket 145 "
          "--set simulation.segments=20 --set strain.surface_fibres=0 --set uncertainty.enabled=false");
  INFO(told.err + told.out);
  CHECK(told.status == 0);
  CHECK(told.out.find("one of the same make at 50 % of its size, 30 mm wide") != std::string::npos);
  CHECK(told.out.find("It keeps all limits in a run") != std::string::npos);
  // The job keeps the bracket's limit, and its preview checks it.
  CHECK_THAT(content(scratch / "abb_irb4600_60_205_routed.yaml"), Catch::Contains("longest_bracket_mm: 145\n"));
  CHECK_THAT(content(scratch / "abb_irb4600_60_205_routed_preview.html"), Catch::Contains("\"most_bracket\":0.145"));
}

TEST_CASE("route refuses what it cannot route") {
  Scratch scratch;
  CHECK(run(scratch, "dresslife", "route nothing_like_it").err.find("'nothing_like_it' is not in the catalogue") !=
        std::string::npos);
  CHECK(run(scratch, "dresslife", "route abb_irb2600_12_165 --scale big").err ==
        "--scale: error: 'big' is neither auto nor a number from 0.05 to 2; write one\n");
  CHECK(run(scratch, "dresslife", "route abb_irb2600_12_165 --ring link_9 --scale 1").status == 1);
  CHECK(run(scratch, "dresslife", "route").status == 2);
  CHECK(
      run(scratch, "dresslife", "route side_panel --set routing.free_length_m=2").err ==
      "--set routing.free_length_m=2: error: routing.free_length_m is replaced by the search; leave it out, or write it "
      "into the job, whose routing is compared with those that are found\n");
  scratch.write("broken.yaml",
                "robot: abb_irb6640_185_280\nmotion: easy\ndresspack: sensor_cable\nrouting:\n"
                "  base_clamp: {link: link_3, position_m: [-0.1, 0, 0.45], direction: [1, 0, 0.45]}\n"
                "  tool_clamp: {link: link_6, position_m: [0.144, 0, 0.174], direction: [1, 0, -0.45]}\n"
                "  free_length_m: -2\n");
  const Outcome broken = run(scratch, "dresslife", "route broken.yaml");
  CHECK(broken.status == 1);
  CHECK_THAT(broken.err, Catch::StartsWith("broken.yaml:7:"));
}

TEST_CASE("route and improve refuse a cable that no routing can give room, before any search") {
  Scratch scratch;
  std::string hose = thin_hose;
  scratch.write("sound.yaml", hose);
  hose.replace(hose.find("slack_percent: 1"), 16, "slack_percent: 6");
  scratch.write("hose.yaml", hose);
  const auto refused = [&](const Outcome& told) {
    INFO(told.out + told.err);
    CHECK(told.status == 1);
    CHECK(told.out.empty());
    CHECK_THAT(told.err,
               Catch::StartsWith("hose.yaml:13:5: error: no routing can keep the limits: 'cable' is compressed with "));
    CHECK_THAT(told.err, Catch::Contains(" % of its breaking force (") && Catch::Contains("Remedy: slack_percent: ") &&
                             Catch::Contains("; correct the dresspack before the search\n"));
    CHECK_FALSE(fs::exists(scratch / "found.yaml"));
    for (const char* folder : {"runs/abb_irb2600_12_165_route", "runs/job_improve"})
      CHECK(results_in(scratch / folder) == 0);
  };
  const std::string quick =
      " --scale 1 --tried 20 --short-runs 4 --off 0 --quiet --set simulation.segments=12 --set uncertainty.enabled=false";
  refused(run(scratch, "dresslife", "route abb_irb2600_12_165 --dresspack ./hose.yaml --job found.yaml" + quick));
  const std::string job = R"(robot: abb_irb2600_12_165
motion: {name: nod, source: mine, steps: [{joints_deg: [0, 0, 0, 0, 30, 0]}, {joints_deg: [20, 0, 0, 0, 60, 90]}]}
dresspack: ./hose.yaml
routing:
  base_clamp: {link: link_3, position_m: [0, 0.1, 0.15], direction: [1, 0, 0.3]}
  tool_clamp: {link: link_6, position_m: [0.05, 0, 0.1], direction: [1, 0, 0]}
  free_length_m: 1.3
simulation: {segments: 12}
uncertainty: {enabled: false}
)";
  scratch.write("job.yaml", job);
  refused(run(scratch, "dresslife", "improve job.yaml --trials 2 --short-runs 0 --off 0 --quiet"));

  // If the slack itself is free, the search may correct it, so the fault is only a warning.
  const Outcome freed = run(scratch, "dresslife",
                            "improve job.yaml --trials 2 --short-runs 0 --off 0 --quiet --free "
                            "'dresspack.components.1.slack_percent=0.1 .. 6'");
  INFO(freed.out + freed.err);
  CHECK_THAT(freed.err, Catch::Contains("warning: 'cable' is compressed with "));
  CHECK_THAT(freed.err, !Catch::Contains("no routing can keep the limits"));
  CHECK(results_in(scratch / "runs/job_improve") > 0);

  // Accepted are the remedy's slack, a cable that cannot slide, and a cable with less excess length.
  for (const char* cure : {"./hose.yaml --set dresspack.components.1.slack_percent=5.8",
                           "./hose.yaml --set strain.slip=stick", "./sound.yaml"}) {
    const Outcome cured =
        run(scratch, "dresslife", std::string("route abb_irb2600_12_165 --job found.yaml --dresspack ") + cure + quick);
    INFO(cured.err);
    CHECK_THAT(cured.err, !Catch::Contains("no routing can keep the limits"));
    CHECK(fs::exists(scratch / "found.yaml"));
  }
}

TEST_CASE("a search that ends without a routing names the limit that decides, and a remedy that works") {
  Scratch scratch;
  scratch.write("hose.yaml", thin_hose);
  const auto routed = [&](const std::string& radius) {
    return run(
        scratch, "dresslife",
        "route abb_irb2600_12_165 --dresspack ./hose.yaml --scale 1 --tried 60 --short-runs 15 --off 0 --quiet "
        "--set simulation.segments=16 --set uncertainty.enabled=false --job found.yaml --set dresspack.least_bend_radius_mm=" +
            radius);
  };
  const Outcome failed = routed("3000");
  INFO(failed.err);
  CHECK(failed.status == 1);
  CHECK_FALSE(fs::exists(scratch / "found.yaml"));
  CHECK_THAT(failed.err,
             Catch::Contains("error: no routing was found that runs; the limit that decides: bend radius, ") &&
                 Catch::Contains(" mm of at least 3000 mm; "));
  const std::string key = "dresspack.least_bend_radius_mm: ";
  const std::size_t at = failed.err.find(key);
  REQUIRE(at != std::string::npos);
  const std::string proposed =
      failed.err.substr(at + key.size(), failed.err.find(' ', at + key.size()) - at - key.size());
  CAPTURE(proposed);
  CHECK(std::stod(proposed) > 60);
  const Outcome cured = routed(proposed);
  INFO(cured.out + cured.err);
  CHECK(cured.status == 0);
  CHECK_THAT(cured.out, Catch::Contains("It keeps all limits in a run"));
}

TEST_CASE("screen grades every change of a job, and says which is no job") {
  Scratch scratch;
  write_small_job(scratch);
  scratch.write("list.yaml",
                "- {routing.free_length_m: 0.9}\n- {routing.free_length_m: 0.7}\n- {routing.free_length_m: -1}\n");
  must_run(scratch, "dresslife-sim", "job.yaml --screen list.yaml -o screening.h5 --quiet");
  const Outcome shown = run(scratch, "dresslife", "show screening.h5");
  INFO(shown.out + shown.err);
  CHECK(shown.status == 0);
  CHECK(shown.out.find("dresslife-screening version 1") != std::string::npos);
  const auto refusals =
      FileReader(scratch / "screening.h5", screening_format()).read<std::string>("/candidate/refusal");
  REQUIRE(refusals.size() == 3);
  CHECK(refusals[0].empty());
  CHECK(refusals[2].find("routing.free_length_m is -1") != std::string::npos);

  // In a run the first candidate sags, which the geometry does not include. The others never run.
  const auto beyond = [&] {
    return FileReader(scratch / "screening.h5", screening_format()).read<double>("/candidate/beyond");
  };
  const std::vector<double> by_geometry = beyond();
  must_run(scratch, "dresslife-sim", "job.yaml --screen list.yaml --by-short-runs -o screening.h5 --quiet");
  const std::vector<double> in_a_run = beyond();
  REQUIRE(in_a_run.size() == by_geometry.size());
  constexpr std::size_t bend = 2, limits = 7;
  CHECK(in_a_run[bend] != by_geometry[bend]);
  const FileReader told_in_pieces(scratch / "screening.h5", screening_format());
  const auto bends = told_in_pieces.read<double>("/candidate/bend");
  const auto row = static_cast<std::ptrdiff_t>(told_in_pieces.length("bend"));
  REQUIRE(bends.size() == 3 * static_cast<std::size_t>(row));
  CHECK(*std::max_element(bends.begin(), bends.begin() + row) ==
        Approx(in_a_run[bend]).margin(0.02));  // the run also checks between samples
  CHECK(
      std::all_of(bends.begin() + row, bends.end(), [](double g) { return g == 0; }));  // of candidates that do not run
  CHECK(std::vector(in_a_run.begin() + limits, in_a_run.end()) ==
        std::vector(by_geometry.begin() + limits, by_geometry.end()));
  const auto refused = FileReader(scratch / "screening.h5", screening_format()).read<std::string>("/candidate/refusal");
  CHECK(refused[0].empty());
  CHECK(refused[1].find("too short") != std::string::npos);
  CHECK(run(scratch, "dresslife-sim", "job.yaml --screen job.yaml -o screening.h5 --quiet").status == 1);
  CHECK(run(scratch, "dresslife-sim", "job.yaml --propose none -o screening.h5 --quiet").status == 2);
}

TEST_CASE("a folder of runs that has the name of a job is refused") {
  Scratch scratch;
  for (const char* line : {"route abb_irb2600_12_165 -o found.yaml", "run two_robots -o found.yaml"}) {
    const Outcome refused = run(scratch, "dresslife", line);
    CHECK(refused.status == 1);
    CHECK_THAT(refused.err, Catch::Contains("'found.yaml' is the name of a job, not of a folder") &&
                                Catch::Contains("route --job names the job"));
    CHECK_FALSE(fs::exists(scratch / "found.yaml"));
  }
}
