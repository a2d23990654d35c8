// dresslife preview: a job before its run, also a job that the simulation refuses.

#include "pipeline/files/files.h"
#include "tests/catch.h"
#include "tests/cli/browser.h"
#include "tests/cli/process.h"

using namespace dresslife::tests;
using dresslife::pipeline::FileReader;
using dresslife::pipeline::preview_format;

TEST_CASE("preview reports how far the clamps are apart and which lengths suit") {
  Scratch scratch;
  write_small_job(scratch);
  const Outcome previewed = must_run(scratch, "dresslife", "preview job.yaml");
  INFO(previewed.err);
  // The distance of the clamps is 0.8 m at the start and falls to hypot(0.7, 0.05).
  CHECK(
      unwrapped(previewed.out)
          .find(
              "Dresspack is 0.900 m long. Over the program its clamps are 0.702 .. 0.800 m apart: its slack fits. For the slack alone 0.82 .. 1.20 m "
              "suit the program: 2 to 50 % longer than the largest distance.") != std::string::npos);
  // The warnings of `check` come first.
  const std::string checked = run(scratch, "dresslife", "check job.yaml").out;
  CHECK(checked.find("strain.slip is stick") != std::string::npos);
  CHECK(previewed.out.find(checked.substr(0, checked.find("Dresspack is"))) == 0);
  CHECK(previewed.out.find("Preview: job_preview.html\n") != std::string::npos);
  const std::string page = content(scratch / "job_preview.html");
  CHECK(page.find("The simulation takes this job.") != std::string::npos);
  CHECK(page.find("http") == page.find("http://"));  // only three.js's own, if any

  // A repeated preview replaces its own page, but no other file.
  CHECK(run(scratch, "dresslife", "preview job.yaml").status == 0);
  const Outcome over = run(scratch, "dresslife", "preview job.yaml -o job.yaml");
  CHECK(over.status == 1);
  CHECK(over.err == "job.yaml: error: is one of the files that are read; name another place with -o\n");
  const Outcome wrong = run(scratch, "dresslife", "preview job.yaml --set routing.free_length_m=-1");
  CHECK(wrong.status == 1);
  CHECK(wrong.err.find("routing.free_length_m is -1") != std::string::npos);
  // Files between the programs are in a temporary folder of their own, which is removed.
  fs::create_directory(scratch / "passing");
  CHECK(run_shell(scratch, "TMPDIR=passing '" DRESSLIFE_BIN_DIR "/dresslife' preview job.yaml").status == 0);
  CHECK(fs::is_empty(scratch / "passing"));
  CHECK(
      run_shell(scratch, "TMPDIR=nowhere '" DRESSLIFE_BIN_DIR "/dresslife' preview job.yaml").err ==
      "nowhere: error: takes no temporary folder (No such file or directory); make room there, or set TMPDIR to a folder "
      "that may be written, then run again\n");
}

TEST_CASE("preview opens a job that is refused where it is refused") {
  Scratch scratch;
  write_small_job(scratch);
  const Outcome previewed =
      must_run(scratch, "dresslife", "preview job.yaml --set routing.free_length_m=0.75 -o short.html");
  INFO(previewed.err);
  CHECK(previewed.out.find("The simulation refuses the job: ") != std::string::npos);
  CHECK(previewed.out.find("dresspack is 50.0 mm too short at 0.000 s") != std::string::npos);
  CHECK(unwrapped(previewed.out).find("apart: too short. For the slack alone ") != std::string::npos);
  CHECK(previewed.out.find("With the robot") == std::string::npos);  // the page of a refused length contains no results
  const std::string seen = in_browser(scratch, "short.html", R"(
    return [await evaluate('document.body.dataset.time'), await evaluate('dresslife.viewer() !== null'),
            await evaluate('document.getElementById("refusal").textContent.includes("too short")')].join(' ');)");
  if (seen.empty()) return;
  INFO(seen);
  CHECK(seen.find("\"problems\":[]") != std::string::npos);
  CHECK(result_of(seen) == "0.000 true true");
}

TEST_CASE("preview names what a dresspack runs through, reports where, and opens there") {
  Scratch scratch;
  scratch.write("job.yaml", R"(robot: abb_irb6640_185_280
motion: easy
dresspack: spot_welding
routing:
  base_clamp: {link: link_3, position_m: [0.1, 0, 0], direction: [1, 0, 0]}
  tool_clamp: {link: link_6, position_m: [0.15, 0, 0.18], direction: [1, 0, -0.35]}
  free_length_m: 1.9
)");
  const Outcome previewed = must_run(scratch, "dresslife", "preview job.yaml");
  INFO(previewed.out << previewed.err);
  CHECK(previewed.out.find("mm deep through link_") != std::string::npos);
  CHECK(previewed.out.find("bring a clamp ") != std::string::npos);
  const std::size_t end = previewed.out.find(" m from its base clamp"), begin = previewed.out.rfind(' ', end - 1);
  REQUIRE(end != std::string::npos);
  const double place = std::stod(previewed.out.substr(begin, end - begin));
  const std::string seen = in_browser(scratch, "job_preview.html", R"(
    return await evaluate(`(() => { const {marked, tubes} = dresslife.viewer(); return (marked.visible ? (marked.segment + .5) / tubes[0].segments * 1.9 : -1) + ' ' +
        [...document.querySelectorAll('.label.mark')].map(label => label.textContent).join(); })()`);)");
  if (seen.empty()) return;
  INFO(seen);
  CHECK(std::stod(result_of(seen)) == Approx(place).margin(1.9 / 30));  // one segment
  CHECK(seen.find(" here\"") != std::string::npos);
}

TEST_CASE("a click on a link shows a clamp there, and a clamp that is dragged reports its length and clearance") {
  Scratch scratch;
  must_run(scratch, "dresslife", "preview irb6640_spot_welding");
  // The first clamp as it is; a click in the middle of link_2's shapes; a drag from the clamp to this place.
  const std::string seen = in_browser(scratch, "irb6640_spot_welding_preview.html", R"(
    const yaml = () => evaluate('document.getElementById("clamp-yaml").textContent');
    const words = () => evaluate('document.getElementById("clamp-words").textContent');
    const mouse = (type, [x, y]) => send('Input.dispatchMouseEvent', {type, x, y, button: 'left', buttons: 1, clickCount: 1});
    // Places on the page [px] where `hits`, a function of a place in the view, finds something, near an object's origin.
    const near = (object, hits) => evaluate(`(() => {
      const viewer = dresslife.viewer(), clamps = dresslife.clamps(), at = new viewer.camera.position.constructor();
      const size = viewer.canvas.getBoundingClientRect();
      (${object}).getWorldPosition(at).project(viewer.camera);
      const x = (at.x + 1) / 2 * size.width, y = (1 - at.y) / 2 * size.height;
      for (let far = 0; far < 60; far += 2)
        for (let turn = 0; turn < 16; ++turn) {
          const [u, v] = [x + far * Math.cos(turn * Math.PI / 8), y + far * Math.sin(turn * Math.PI / 8)];
          if ((${hits})(clamps, u, v)) return [size.left + u, size.top + v];
        }
      return null; })()`);
    const before = [await yaml(), await words()];
    await evaluate('window.scrollTo(0, 0)');
    const link = await near('viewer.links[2].children.find(part => part.userData.shape)',
        '(clamps, x, y) => clamps.surfaceAt(x, y)?.link === 2 && viewer.segmentAt(x, y) < 0');
    await press(...link);
    const clicked = await yaml();
    const off = await evaluate(`(() => { const clamp = dresslife.clamps().clamps[0]; return clamp.bracket - clamp.radius; })()`);
    await mouse('mousePressed', await near('clamps.clamps[1].group', '(clamps, x, y) => clamps.clampAt(x, y) === 1'));
    await mouse('mouseMoved', await near('viewer.links[5]', '(clamps, x, y) => clamps.surfaceAt(x, y)?.link === 5'));
    await mouse('mouseReleased', await near('viewer.links[5]', '(clamps, x, y) => clamps.surfaceAt(x, y)?.link === 5'));
    await sleep(500);
    return [...before, clicked, Math.abs(off) < 1e-3, await yaml(), await words()].join(' | ');)");
  if (seen.empty()) return;
  INFO(seen);
  CHECK(seen.find("\"problems\":[]") != std::string::npos);
  CHECK_THAT(seen,
             Catch::Contains("base_clamp: {link: link_3, position_m: [-0.1, 0, 0.45], direction: [0.912, 0, 0.41]}") &&
                 Catch::Contains("m apart, farthest at ") && Catch::Contains("2.020 m is long enough") &&
                 Catch::Contains("base_clamp: {link: link_2, position_m: [") && Catch::Contains(" | true | ") &&
                 Catch::Contains("tool_clamp: {link: link_5, position_m: [") && Catch::Contains("clearance "));
}

TEST_CASE("a run shows the jobs that the simulation refuses, until they are mended") {
  Scratch scratch;
  write_small_job(scratch);
  scratch.write("study.yaml", "base: job.yaml\nvary:\n  routing.free_length_m: [0.75, 0.9]\n");
  const Outcome first = run(scratch, "dresslife", "run study.yaml");
  CHECK(first.status == 1);
  const fs::path page = scratch / "runs/study/free_length_m=0.75/preview.html";
  INFO(first.err);
  REQUIRE(fs::exists(page));
  CHECK_FALSE(fs::exists(scratch / "runs/study/free_length_m=0.9/preview.html"));
  CHECK(first.err.find("can be seen in runs/study/free_length_m=0.75/preview.html") != std::string::npos);
  CHECK(content(scratch / "runs/study/report.html").find("<a href=\"free_length_m%3D0.75/preview.html\">") !=
        std::string::npos);
  const auto written = fs::last_write_time(page);
  run(scratch, "dresslife", "run study.yaml");
  CHECK(fs::last_write_time(page) == written);
  // After the correction this page is removed.
  scratch.write("study.yaml", "base: job.yaml\njobs:\n  free_length_m=0.75: {routing.free_length_m: 0.95}\n");
  CHECK(run(scratch, "dresslife", "run study.yaml").status == 0);
  CHECK_FALSE(fs::exists(page));
  const Outcome alone = run(scratch, "dresslife-sim", "job.yaml --set routing.free_length_m=0.75 -o x.h5");
  CHECK(alone.err.find("or move a clamp (dresslife preview shows it)\n") != std::string::npos);
}

TEST_CASE("the preview's file: curves of the right length from clamp to clamp") {
  Scratch scratch;
  write_small_job(scratch);
  double missing[2]{};  // share of the length that the chords of 24 and 96 segments miss, at worst
  for (const int fine : {0, 1}) {
    const int segments = fine ? 96 : 24;
    must_run(scratch, "dresslife-sim",
             fmt::format("job.yaml --preview -o preview.h5 --set simulation.segments={}", segments));
    const FileReader file(scratch / "preview.h5", preview_format());
    CHECK(file.text_attribute("refusal").empty());
    const auto centres = file.read<double>("/segment/position"), clamps = file.read<double>("/clamp/position"),
               ways = file.read<double>("/span/way"), times = file.read<double>("/time");
    REQUIRE(ways.size() == times.size());
    CHECK(times.front() == 0);
    CHECK(times.back() == Approx(1));
    for (std::size_t k = 0; k < times.size(); ++k) {
      const double *base = &clamps[6 * k], *tool = base + 3, *line = &centres[3 * segments * k];
      CHECK(ways[k] == Approx(std::hypot(tool[0] - base[0], tool[1] - base[1], tool[2] - base[2])));
      double along = 0;
      const double* before = base;
      for (int i = 0; i <= segments; ++i) {
        const double* next = i < segments ? line + 3 * i : tool;
        along += std::hypot(next[0] - before[0], next[1] - before[1], next[2] - before[2]);
        before = next;
      }
      CHECK(along <= 0.9 * (1 + 1e-6));
      missing[fine] = std::max(missing[fine], 0.9 - along);
    }
  }
  // Chords of length l miss curvature^2 l^3 / 24 each, in total as l^2: a sixteenth for a quarter of l.
  CHECK(missing[0] < 0.01);
  CHECK(missing[0] / missing[1] == Approx(16).epsilon(0.25));
}
