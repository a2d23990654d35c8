// The page of a job: written with its results, and opened in a browser if one is installed.

#include "pipeline/base/readable.h"
#include "pipeline/files/files.h"
#include "pipeline/report/plot.h"
#include "pipeline/report/report.h"
#include "pipeline/settings/units.h"
#include "tests/catch.h"
#include "tests/cli/browser.h"
#include "tests/cli/process.h"

using namespace dresslife::tests;

namespace {

const char* what_a_reader_does = R"(
  // The canvas is not blank: more than a few colours on it.
  const colours = await evaluate(`(() => {
    const canvas = dresslife.viewer().canvas, flat = document.createElement('canvas');
    flat.width = canvas.width; flat.height = canvas.height;
    const context = flat.getContext('2d');
    context.drawImage(canvas, 0, 0);
    const bytes = context.getImageData(0, 0, flat.width, flat.height).data, seen = new Set();
    for (let i = 0; i < bytes.length; i += 4) seen.add(bytes[i] << 16 | bytes[i + 1] << 8 | bytes[i + 2]);
    return seen.size; })()`);
  // A click on the hose chooses the segment that is there.
  const place = await evaluate(`(() => {
    const at = dresslife.viewer().placeOf(3), size = dresslife.viewer().canvas.getBoundingClientRect();
    return {x: at.x + size.left, y: at.y + size.top}; })()`);
  await press(place.x, place.y);
  const segment = await evaluate('document.body.dataset.segment');
  const damage = await evaluate('document.querySelector("[data-name=damage]").dataset.value');
  // A click on the timeline goes there, and play goes on from there.
  const line = await evaluate(`(() => { const t = dresslife.timeline(), c = t.canvas; c.scrollIntoView();
    const size = c.getBoundingClientRect(); return {x: size.left + t.xAt(.25), y: size.top + 30}; })()`);
  await press(line.x, line.y);
  const clicked = Number(await evaluate('document.body.dataset.time'));
  await evaluate('document.activeElement.blur()');
  await key(' ');
  const playing = await evaluate('document.body.dataset.playing');
  let moved = false;
  for (let k = 0; k < 100 && !moved; ++k) { await sleep(50); moved = Number(await evaluate('document.body.dataset.time')) > clicked + .02; }
  await key(' ');
  const stopped = await evaluate('document.body.dataset.playing');
  // A draw of the whole scene by hand: play may have had too few frames for its own mean.
  const frame = await evaluate(`(() => { const start = performance.now(); for (let k = 0; k < 3; ++k) { dresslife.setTime(.1 * k); dresslife.viewer().draw(); }
    return ((performance.now() - start) / 3).toFixed(1); })()`);
  // Damage now and the two drawings of the worst wire.
  await evaluate(`dresslife.setColour('rate')`);
  const coloured = await evaluate('dresslife.state.colour');
  const shapes = await evaluate(`document.querySelectorAll('#cycles rect').length > 0 && document.querySelectorAll('#loops path').length === 1`);
  const cycles = await evaluate('dresslife.life.cycles.rows.reduce((sum, row) => sum + row[3], 0)');
  // The cross-section of the chosen place: drawn, its worst wire that of the numbers beside it; of the worst place at last.
  const across = await evaluate(`[...document.querySelectorAll('#section canvas')].every(c => { const data = c.getContext('2d').getImageData(0, 0, c.width, c.height).data;
    return new Set(data.filter((_, k) => k % 4 < 3)).size > 50; }) && document.querySelectorAll('#section canvas').length === 2`);
  await evaluate('dresslife.choose(dresslife.life.worst_segment)');
  const row = await evaluate(`(() => { const row = document.querySelector('#section tbody tr'); return row.cells[0].textContent.replace(/ /g, '_') + ' ' + row.cells[1].dataset.value; })()`);
  const sampled = await evaluate('dresslife.life.strains.rows.every(row => row.sampled)');
  await evaluate('dresslife.setTime(0)');
  const life = await evaluate('dresslife.life.life_hours');
  const rows = await evaluate('dresslife.life.strains.rows.length');
  // A segment without damage, which has no closings, leaves the scale of damage now.
  const sparse = await evaluate('delete dresslife.closings.of[0] && dresslife.closings.most() > 0');
  return [colours > 50, segment, Math.abs(clicked - .25) < .01, playing, moved, stopped, rows > 0, damage, life, frame, coloured, shapes, cycles, across, row, sampled, sparse].join(' ');
)";

}  // namespace

TEST_CASE("a run writes a page for each job, the report links to it, and it is written again only when needed") {
  Scratch scratch;
  write_small_job(scratch);
  must_run(scratch, "dresslife", "run job.yaml");
  const fs::path page = scratch / "runs/job/job/page.html";
  REQUIRE(fs::exists(page));
  CHECK(content(scratch / "runs/job/report.html").find("<a href=\"job/page.html\">") != std::string::npos);
  const auto written = fs::last_write_time(page);
  CHECK(run(scratch, "dresslife", "run job.yaml").status == 0);
  CHECK(fs::last_write_time(page) == written);
  fs::remove(page);
  CHECK(run(scratch, "dresslife", "report job.yaml").status == 0);
  CHECK(fs::exists(page));

  fs::remove(page);
  const Outcome asked = run(scratch, "dresslife", "page runs/job/job");
  CHECK(asked.status == 0);
  CHECK(asked.out == "runs/job/job/page.html\n");
  CHECK(fs::exists(page));
  const Outcome nothing = run(scratch, "dresslife", "page runs/job");
  CHECK(nothing.status == 1);
  CHECK(nothing.err == "runs/job: error: holds no life.h5; name the folder of a job that is done: runs/STUDY/JOB\n");

  fs::rename(page, scratch / "page.html");
  scratch.write("runs/job/job/page.html", "mine");
  CHECK(
      run(scratch, "dresslife", "page runs/job/job").err ==
      "runs/job/job/page.html: error: is there already and was not written by dresslife; move it away, or replace it with "
      "--force\n");
  fs::rename(scratch / "page.html", page);

  // Without three.js a run succeeds as well.
  REQUIRE(run_shell(scratch, "DRESSLIFE_THREE=/nowhere '" DRESSLIFE_BIN_DIR "/dresslife' run job.yaml").status == 0);
  CHECK(content(page).size() < 500'000);

  // The page of an outdated result is marked with what changed. With the original settings the mark is removed.
  const auto mark = [&](const std::string& length) {
    const std::string job = content(scratch / "job.yaml"), key = "free_length_m: ";
    const std::size_t value = job.find(key) + key.size(), end = job.find('\n', value);
    scratch.write("job.yaml", job.substr(0, value) + length + job.substr(end));
    run(scratch, "dresslife", "report job.yaml");
    const std::string text = content(page), open = "<p class=\"failed\" id=\"stale\">";
    const std::size_t at = text.find(open);
    CHECK(text.find(open, at + 1) == std::string::npos);
    return at == std::string::npos ? "" : text.substr(at + open.size(), text.find("</p>", at) - at - open.size());
  };
  CHECK(mark("0.9") == "");
  const std::string unmarked = content(page);
  CHECK(mark("0.95") == "stale: since this result routing.free_length_m 0.9 -&gt; 0.95");
  CHECK(mark("0.97") == "stale: since this result routing.free_length_m 0.9 -&gt; 0.97");
  const std::string marked = content(page);
  must_run(scratch, "dresslife", "page runs/job/job");
  CHECK(content(page) == marked);
  CHECK(mark("0.9") == "");
  CHECK(content(page) == unmarked);

  // Files of different motions make no page and no figure, also with equal numbers of samples and segments.
  must_run(scratch, "dresslife-sim", "job.yaml --set routing.free_length_m=0.92 -o other.h5");
  fs::copy_file(scratch / "other.h5", scratch / "runs/job/job/motion.h5", fs::copy_options::overwrite_existing);
  for (const std::string command :
       {"page runs/job/job", "export runs/job/job --paraview a.xdmf", "plot runs/job/job --what scene -o a.svg"}) {
    const Outcome mixed = run(scratch, "dresslife", command);
    CHECK(mixed.status == 1);
    CHECK_THAT(mixed.err, Catch::Contains("strain.h5: error: was not made from runs/job/job/motion.h5"));
  }
  must_run(scratch, "dresslife", "plot runs/job/job --what cycles -o a.svg");
}

TEST_CASE("the page in a browser: no complaints, a picture, play and clicks, the numbers of life.h5") {
  Scratch scratch;
  write_small_job(scratch);
  must_run(scratch, "dresslife", "run job.yaml");
  const std::string seen = in_browser(scratch, "runs/job/job/page.html", what_a_reader_does);
  if (seen.empty()) return;
  INFO(seen);
  CHECK(seen.find("\"problems\":[]") != std::string::npos);
  // One request, for the page itself.
  CHECK(seen.find("\"requests\":[\"file://" + (scratch / "runs/job/job/page.html").string() + "\"]") !=
        std::string::npos);
  std::istringstream words(result_of(seen));
  std::string colours, segment, jumped, playing, moved, stopped, histories;
  std::string frame, coloured, shapes;
  double damage = 0, hours = 0, of_cycles = 0;
  std::string across, worst, sampled, sparse;
  double of_worst = 0;
  words >> colours >> segment >> jumped >> playing >> moved >> stopped >> histories >> damage >> hours >> frame >>
      coloured >> shapes >> of_cycles >> across >> worst >> of_worst >> sampled >> sparse;
  WARN("a frame took " << frame << " ms");
  CHECK(colours == "true");
  CHECK(segment == "3");
  CHECK(jumped == "true");
  CHECK(playing == "true");
  CHECK(moved == "true");
  CHECK(stopped == "false");
  CHECK(histories == "true");
  const dresslife::pipeline::FileReader life(scratch / "runs/job/job/life.h5", dresslife::pipeline::life_format());
  CHECK(damage == life.read<double>("/segment/damage").at(3));
  CHECK(hours == life.number_attribute("life_hours"));
  CHECK(coloured == "rate");
  CHECK(shapes == "true");
  CHECK(of_cycles == Approx(life.number_attribute("damage_per_repeat")));
  CHECK(across == "true");
  std::string component = life.text_attribute("worst_component");
  std::replace(component.begin(), component.end(), ' ', '_');
  CHECK(worst == component);
  CHECK(of_worst == life.number_attribute("damage_per_repeat"));
  CHECK(sampled == "true");  // no history is reconstructed from its turning points
  CHECK(sparse == "true");
}

TEST_CASE("pages print the numbers of the files: hours, shares of damage, draws") {
  using dresslife::pipeline::FileReader;
  using dresslife::pipeline::printed;
  using dresslife::pipeline::printed_hours;
  Scratch scratch;
  write_small_job(scratch);
  scratch.write("lengths.yaml", "base: job.yaml\nvary: {routing.free_length_m: [0.88, 0.92]}\n");
  must_run(scratch, "dresslife", "run lengths.yaml --quiet");
  const std::string report = content(scratch / "runs/lengths/report.html"),
                    table = content(scratch / "runs/lengths/ranking.csv");
  const auto holds = [](const std::string& page, const std::string& words) {
    INFO(words);
    CHECK(page.find(words) != std::string::npos);
  };
  for (const std::string job : {"free_length_m=0.88", "free_length_m=0.92"}) {
    const FileReader life(scratch / "runs/lengths" / job / "life.h5", dresslife::pipeline::life_format());
    const std::string page = content(scratch / "runs/lengths" / job / "page.html");
    const double hours = life.number_attribute("life_hours_p10");
    // The parts stick to each other: cables have forces that exceed their strength.
    holds(page, fmt::format("<p><b>Do not plan with {}: ", dresslife::pipeline::hours_text(hours)));
    holds(page, fmt::format("Half have failed after {}, ", printed_hours(life.number_attribute("life_hours_p50"))));
    holds(page, fmt::format("The median of the worst wire is {} h.", printed(life.number_attribute("life_hours"))));
    holds(report,
          fmt::format("data-value=\"{}\"><b>!{}</b>", dresslife::pipeline::shortest_text(hours), printed(hours)));
    // Shares of the damage near clamps and in layers.
    const auto clamps = life.read<double>("/clamp/damage"), layers = life.read<double>("/layer/damage");
    const auto names = life.read<std::string>("/clamp/name");
    for (std::size_t k = 0; k < clamps.size(); ++k)
      for (const std::string& text : {page, report})
        holds(text, fmt::format("{} {:.0f} %", names[k], 100 * clamps[k] / (clamps[0] + clamps[1])));
    for (const double damage : layers)
      if (damage > 0) holds(page, fmt::format("<td class=\"number\">{}</td>", printed(damage)));
  }
  // The best job's share of samples, according to the table.
  const std::size_t header = table.find("outlives_next"), line = table.find('\n') + 1;
  REQUIRE(header != std::string::npos);
  const auto column = std::count(table.begin(), table.begin() + static_cast<std::ptrdiff_t>(header), ',');
  std::istringstream cells(table.substr(line, table.find('\n', line) - line));
  std::string cell;
  bool quoted = false;
  for (std::ptrdiff_t k = 0; k <= column; ++k) {
    cell.clear();
    for (char c = 0; cells.get(c) && (c != ',' || quoted); cell += c) quoted ^= c == '"';
  }
  holds(report, fmt::format("Lives longer than the next job in {:.0f} of 100 samples", 100 * std::stod(cell)));
}

TEST_CASE("the page of a study in a browser: sorted, filtered, two jobs side by side with what differs") {
  Scratch scratch;
  write_small_job(scratch);
  scratch.write("lengths.yaml", "base: job.yaml\nvary: {routing.free_length_m: [0.88, 0.9, 0.92]}\n");
  must_run(scratch, "dresslife", "run lengths.yaml");
  const std::string seen = in_browser(scratch, "runs/lengths/report.html", R"(
    const jobs = () => evaluate(`[...document.querySelectorAll('#ranking tbody tr')].filter(r => !r.hidden)
        .map(r => r.dataset.job.slice(-4)).join()`);
    const order = () => evaluate(`document.querySelectorAll('#ranking th')[1].getAttribute('aria-sort')`);
    const click = (what, k) => evaluate(`document.querySelectorAll('${what}')[${k}].click()`);
    const seen = [];
    await click('#ranking th button', 1);
    seen.push(await jobs(), await order());
    await click('#ranking th button', 1);
    seen.push(await jobs(), await order());
    await evaluate(`{ const words = document.querySelector('.tools input'); words.value = '0.9'; words.dispatchEvent(new Event('input')); }`);
    seen.push(await evaluate(`document.querySelector('[role=status]').textContent.replace(/ /g, '_')`));
    await evaluate(`{ const words = document.querySelector('.tools input'); words.value = ''; words.dispatchEvent(new Event('input')); }`);
    await click('.pick input', 0);
    await click('.pick input', 2);
    seen.push(await evaluate(`[...document.querySelectorAll('#compared table')][1].innerText.split(/\\s+/).join('_')`));
    return seen.join(' ');)");
  if (seen.empty()) return;
  INFO(seen);
  CHECK(seen.find("\"problems\":[]") != std::string::npos);
  std::istringstream words(result_of(seen));
  std::string rising, up, falling, down, count, settings;
  words >> rising >> up >> falling >> down >> count >> settings;
  CHECK(rising == "0.88,=0.9,0.92");
  CHECK(up == "ascending");
  CHECK(falling == "0.92,=0.9,0.88");
  CHECK(down == "descending");
  CHECK(count == "2_of_3_jobs");
  CHECK(settings.find("routing.free_length_m_0.92_0.88") != std::string::npos);
}

TEST_CASE("the page of a study of 2,000 jobs in a browser: a hundred rows at once, sorted and filtered over all") {
  Scratch scratch;
  dresslife::pipeline::RankingRow row;
  row.damage_per_repeat = 1e-4;
  row.life_repeats = row.life_repeats_all_stick = row.life_repeats_all_free = 1e4;
  row.repeat_seconds = 60;
  row.worst_component = "signal cable/layer 1/wire 2";
  row.worst_segment_from_tool = 1;
  std::vector<dresslife::pipeline::RankingRow> rows(2000, row);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    rows[k].job = fmt::format("job-{:04}", k);
    rows[k].life_hours = 1e5 - static_cast<double>(k);
  }
  dresslife::pipeline::write_report(scratch / "report.html", "many", rows);
  const std::string seen = in_browser(scratch, "report.html", R"(
    const rows = () => evaluate(`document.querySelectorAll('#ranking tbody tr').length`);
    const first = () => evaluate(`document.querySelector('#ranking tbody tr').dataset.job`);
    const ask = text => evaluate(`{ const words = document.querySelector('.tools input'); words.value = '${text}'; words.dispatchEvent(new Event('input')); }`);
    const seen = [await rows()];
    await evaluate(`document.querySelectorAll('#ranking th button')[2].click()`);
    await evaluate(`document.querySelectorAll('#ranking th button')[2].click()`);
    seen.push(await first());
    await ask('job-19');
    seen.push(await rows(), await first());
    await ask('job-0777');
    seen.push(await rows());
    await ask('');
    await evaluate(`[...document.querySelectorAll('.tools button')].find(b => b.textContent === 'all').click()`);
    seen.push(await rows());
    return seen.join(' ');)");
  if (seen.empty()) return;
  INFO(seen);
  CHECK(seen.find("\"problems\":[]") != std::string::npos);
  CHECK(result_of(seen) == "100 job-1999 100 job-1999 1 2000");
}
