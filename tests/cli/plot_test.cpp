// dresslife plot and show: a job's results as figures and in words.

#include "tests/cli/process.h"

#include <cmath>

#include "pipeline/cable/polymer.h"
#include "tests/catch.h"

using namespace dresslife::tests;

TEST_CASE("plot draws each figure of a job into a file that needs no page") {
  Scratch scratch;
  write_small_job(scratch);
  must_run(scratch, "dresslife", "run job.yaml --quiet");
  const std::string job = "runs/job/job";
  const std::pair<std::string, std::string> figures[] = {
      {"strain", "class=\"curve\""},      {"cycles", "class=\"bar\""},      {"damage", "class=\"bar-hot\""},
      {"deformation", "class=\"curve\""}, {"curvature", "class=\"curve\""}, {"scene", "class=\"hose-hot\""}};
  for (const auto& [what, draws] : figures) {
    const Outcome drawn = run(scratch, "dresslife", "plot " + job + " --what " + what + " -o " + what + ".svg");
    INFO(what << drawn.err);
    CHECK(drawn.status == 0);
    const std::string picture = unmarked_content(scratch / (what + ".svg"));
    CHECK(picture.rfind("<svg xmlns=\"http://www.w3.org/2000/svg\" width=", 0) == 0);
    CHECK(picture.find("var(") == std::string::npos);  // only browsers support variables
    CHECK(picture.find(draws) != std::string::npos);
  }
  // If strain.h5 exists, no history is reconstructed from its turning points.
  CHECK(content(scratch / "strain.svg").find("straight between") == std::string::npos);
  CHECK(content(scratch / "strain.svg").find(">cable ") != std::string::npos);
  fs::rename(scratch / "runs/job/job/strain.h5", scratch / "away.h5");
  must_run(scratch, "dresslife", "plot " + job + " --what strain -o gone.svg");
  CHECK(content(scratch / "gone.svg").find(", straight between its turning points") != std::string::npos);
  fs::rename(scratch / "away.h5", scratch / "runs/job/job/strain.h5");
  // Any file of a job represents its folder.
  CHECK(run(scratch, "dresslife", "plot " + job + "/strain.h5 --what deformation --time 0.5 -o d.svg").status == 0);
  CHECK(content(scratch / "d.svg").find("at 0.50 s") != std::string::npos);

  must_run(scratch, "dresslife", "plot " + job + " --what scene --time 1e9 -o s.svg");
  CHECK(content(scratch / "s.svg").find("dresspack at 1.00 s") != std::string::npos);  // the last sample
  CHECK(run(scratch, "dresslife", "plot " + job + " --what cycles --time 5 -o s.svg").err ==
        "--time: error: has no effect on the figure cycles; leave it out\n");

  const Outcome no_result = run(scratch, "dresslife", "plot job.yaml --what strain -o s.svg");
  CHECK(no_result.status == 1);
  CHECK(no_result.err.find("job.yaml: error: is neither a job's folder nor one of its files; name") == 0);
  const Outcome no_picture = run(scratch, "dresslife", "plot " + job + " --what strain -o s.txt");
  CHECK(no_picture.err.find("s.txt: error: is neither an .svg nor a .png; name") == 0);
  CHECK(run(scratch, "dresslife", "plot " + job + " --what strain -o " + job + "/life.h5.svg").status == 0);
  CHECK(run(scratch, "dresslife", "plot " + job + " --what strain -o job.yaml").status == 1);
}

TEST_CASE("plot draws the moment over curvature of a hose and its cable") {
  Scratch scratch;
  write_small_job(scratch);
  must_run(scratch, "dresslife", "run job.yaml --quiet");
  const std::string plot = "plot runs/job/job --what bending -o bending.svg";
  CHECK(run(scratch, "dresslife", plot)
            .err.find("strain.h5: error: comes from a job without friction in its cables (strain.slip); set") !=
        std::string::npos);
  scratch.write("dresspacks/thin.yaml", thin_hose);
  must_run(scratch, "dresslife",
           "run job.yaml --quiet --set strain.slip=friction --set dresspack=thin --set uncertainty.enabled=false "
           "--set simulation.sample_rate_Hz=20");
  must_run(scratch, "dresslife", plot);
  // E I without friction: the polymer, and six wires of copper, each about its own axis on a lay of 15 degrees (within 1 % of
  // the sum). Held wires have E A R^2/2 in addition.
  const std::string bending = unmarked_content(scratch / "bending.svg"), words = "cable: E I ";
  REQUIRE(bending.find(words) != std::string::npos);
  const double pi = std::acos(-1.0), polymer = dresslife::pipeline::jacketed_modulus * pi / 4 * std::pow(2e-3, 4),
               wire = 117e9 * pi / 4 * std::pow(1e-4, 4);
  CHECK(std::stod(bending.substr(bending.find(words) + words.size())) == Approx(polymer + 6 * wire).epsilon(0.01));
  const double held = std::stod(bending.substr(bending.find("sliding, ", bending.find(words)) + 9));
  CHECK(held ==
        Approx(polymer + 6 * (wire + 117e9 * pi * 1e-8 * 1e-6 / 2 * std::pow(std::cos(pi / 12), 3))).epsilon(0.05));
}

TEST_CASE("show reports what lies in a file, with shapes, units, ranges and meanings") {
  Scratch scratch;
  write_small_job(scratch);
  must_run(scratch, "dresslife", "run job.yaml --quiet");
  for (const auto& [kind, version] : {std::pair<std::string, int>{"motion", 1}, {"strain", 2}, {"life", 1}}) {
    const Outcome shown = run(scratch, "dresslife", "show runs/job/job/" + kind + ".h5");
    INFO(shown.err);
    CHECK(shown.status == 0);
    CHECK(shown.out.find("dresslife-" + kind + " version " + std::to_string(version)) != std::string::npos);
    CHECK(shown.out.find("made by\n  dresslife-sim") != std::string::npos);
  }
  CHECK(run(scratch, "dresslife", "show runs/job/job").out ==
        run(scratch, "dresslife", "show runs/job/job/life.h5").out);
  CHECK(run(scratch, "dresslife", "show runs/job/job --json").err ==
        "runs/job/job: error: is no job, so --json and --set have no effect; leave them out, or name a job\n");
  CHECK(run(scratch, "dresslife", "show runs/job").err.find("runs/job: error: holds no life.h5; name") == 0);
  const std::string motion = run(scratch, "dresslife", "show runs/job/job/motion.h5").out;
  CHECK(motion.find("/segment/length          (segment 12) 0.075") != std::string::npos);  // 0.9 m
  CHECK(motion.find("  m\n") != std::string::npos);
  CHECK(run(scratch, "dresslife", "show job.yaml").out.find("free_length_m: 0.9") != std::string::npos);
}

TEST_CASE("export names every moment for ParaView, and writes over no file but its own") {
  Scratch scratch;
  write_small_job(scratch);
  must_run(scratch, "dresslife", "run job.yaml --quiet");
  must_run(scratch, "dresslife", "export runs/job/job --paraview job.xdmf");
  const std::string text = content(scratch / "job.xdmf");
  std::size_t moments = 0;
  for (std::size_t at = text.find("<Time "); at != std::string::npos; at = text.find("<Time ", at + 1)) ++moments;
  const std::string samples = run(scratch, "dresslife", "show runs/job/job/motion.h5").out;
  CHECK(samples.find("(sample " + std::to_string(moments) + ")") != std::string::npos);
  for (const std::string dataset : {"motion.h5:/tension", "strain.h5:/deformation/twist", "life.h5:/segment/damage"})
    CHECK(text.find("runs/job/job/" + dataset) != std::string::npos);
  CHECK(run(scratch, "dresslife", "export runs/job/job --paraview job.yaml").status == 1);
  scratch.write("mine.xdmf", "keep: me\n");
  const Outcome foreign = run(scratch, "dresslife", "export runs/job/job --paraview mine.xdmf");
  CHECK_THAT(foreign.err, Catch::StartsWith("mine.xdmf: error: is there already and was not written by dresslife") &&
                              Catch::Contains("name another file with --paraview, or replace it with --force\n"));
  CHECK(content(scratch / "mine.xdmf") == "keep: me\n");
  CHECK(run(scratch, "dresslife", "export runs/job/job --paraview job.xdmf").status == 0);  // its own file is replaced
}

TEST_CASE("the page for Python users runs as it stands") {
  if (std::system("/usr/bin/python3 -c 'import h5py' >/dev/null 2>&1") != 0) {
    WARN("python3-h5py is not installed: the page was not tried");
    return;
  }
  const std::string page = content(fs::path(DRESSLIFE_SOURCE_DIR) / "pipeline/files/README.md");
  const std::string open = "```python\n";
  const std::size_t begin = page.find(open) + open.size();
  Scratch scratch;
  write_small_job(scratch);
  must_run(scratch, "dresslife", "run job.yaml --quiet");
  scratch.write("runs/job/job/page.py", page.substr(begin, page.find("```", begin) - begin));
  const Outcome ran = run_shell(scratch, "cd runs/job/job && /usr/bin/python3 page.py");
  INFO(ran.err);
  CHECK(ran.status == 0);
  CHECK(ran.out.find(" h, strained most at ") != std::string::npos);
}
