// Pages on paper and on a phone: no content is cut, torn or compressed.

#include "pipeline/report/duty_page.h"
#include "pipeline/report/improvement_page.h"
#include "pipeline/report/plan_page.h"
#include "tests/catch.h"
#include "tests/cli/browser.h"
#include "tests/cli/process.h"

using namespace dresslife::tests;
using dresslife::pipeline::improvement_page;
using dresslife::pipeline::ImprovementStory;

namespace {

// A4 within Chromium's margins of 0.4 inches, at 96 px per inch.
constexpr const char* on_paper = R"(
  await evaluate(`window.dispatchEvent(new Event('beforeprint'))`);
  await send('Emulation.setEmulatedMedia', {media: 'print', features: [{name: 'prefers-color-scheme', value: 'dark'}]});
  await send('Emulation.setDeviceMetricsOverride', {width: 717, height: 1046, deviceScaleFactor: 1, mobile: false});
)";
constexpr const char* on_a_phone = R"(
  await evaluate(`window.dispatchEvent(new Event('afterprint'))`);
  await send('Emulation.setEmulatedMedia', {media: ''});
  await send('Emulation.setDeviceMetricsOverride', {width: 390, height: 844, deviceScaleFactor: 1, mobile: false});
)";

// Describes the faults of the page's current layout; '' for none.
constexpr const char* faults = R"(
  const faults = () => evaluate(`(() => {
    const words = [], root = document.documentElement, paper = matchMedia('print').matches;
    const shown = element => element.getClientRects().length > 0;
    const named = element => element.tagName + (element.id ? '#' + element.id : '') + (element.className.baseVal || element.className || '');
    if (root.scrollWidth > root.clientWidth) words.push('wider than the page: ' + root.scrollWidth);
    for (const element of document.querySelectorAll('canvas, svg, img')) {
      if (!shown(element)) continue;
      const size = element.getBoundingClientRect(), box = element.viewBox && element.viewBox.baseVal;
      const ratio = box && box.width ? box.width / box.height : (element.naturalWidth || element.width) / (element.naturalHeight || element.height);
      if (!box && Math.abs(size.width / size.height / ratio - 1) > .02) words.push(named(element) + ' is squeezed: ' + [size.width, size.height, ratio]);
      if (paper && size.height > root.clientHeight) words.push(named(element) + ' is higher than a sheet');
      let keeper = element;
      while (keeper && getComputedStyle(keeper).breakInside !== 'avoid') keeper = keeper.parentElement;
      if (paper && !keeper && !element.closest('#timeline')) words.push(named(element) + ' may be torn');
      const frame = element.closest('.chart');
      if (!paper && frame && frame.scrollWidth > frame.clientWidth && getComputedStyle(frame).overflowX !== 'auto')
        words.push(named(element) + ' is cut');
    }
    // What is read on a chart: at least 9 px high, as letters of 7 pt are on paper.
    for (const text of document.querySelectorAll('.chart text, .figure text, .figures text'))
      if (shown(text) && text.getBoundingClientRect().height > 0) {
        const svg = text.ownerSVGElement, scale = svg.getBoundingClientRect().width / svg.viewBox.baseVal.width;
        if (parseFloat(getComputedStyle(text).fontSize) * scale < (paper ? 7 : 9)) {
          words.push('too small to be read: ' + text.textContent);
          break;
        }
      }
    for (const head of document.querySelectorAll('h2, h3'))
      if (paper && shown(head) && getComputedStyle(head).breakAfter !== 'avoid') words.push('torn from what is below it: ' + head.textContent);
    if (paper)
      for (const canvas of document.querySelectorAll('#timeline canvas, #section canvas')) {
        const [red] = canvas.getContext('2d').getImageData(1, 1, 1, 1).data;
        if (red < 200) words.push('dark ground on paper');
      }
    if (paper && getComputedStyle(document.body).backgroundColor !== 'rgb(255, 255, 255)') words.push('dark page on paper');
    return words.join('; '); })()`);
  // A busy machine lays out and draws again somewhat later.
  const settled = async () => {
    let words = await faults();
    for (let k = 0; k < 50 && words; ++k) {
      await sleep(100);
      words = await faults();
    }
    return words;
  };
)";

void check_page(const Scratch& scratch, const std::string& page) {
  INFO(page);
  const std::string seen =
      in_browser(scratch, page,
                 fmt::format("{}{}const paper = await settled();\n{}return paper + ' | ' + await settled();", faults,
                             on_paper, on_a_phone));
  if (seen.empty()) return;
  INFO(seen);
  CHECK(result_of(seen) == " | ");
  CHECK(seen.find("\"problems\":[]") != std::string::npos);
}

}  // namespace

TEST_CASE("pages of a job, a study and a preview can be printed and read on a phone") {
  Scratch scratch;
  write_small_job(scratch);
  scratch.write("a_job_whose_name_does_not_fit_on_a_phone.yaml", content(scratch / "job.yaml"));
  scratch.write("lengths.yaml", "base: job.yaml\nvary: {routing.free_length_m: [0.88, 0.9]}\n");
  must_run(scratch, "dresslife", "run lengths.yaml --quiet");
  must_run(scratch, "dresslife",
           "preview a_job_whose_name_does_not_fit_on_a_phone.yaml --set routing.free_length_m=0.75");
  check_page(scratch, "runs/lengths/free_length_m=0.9/page.html");
  check_page(scratch, "runs/lengths/report.html");
  check_page(scratch, "a_job_whose_name_does_not_fit_on_a_phone_preview.html");
}

TEST_CASE("the page of an improvement can be printed and read on a phone, its charts at two widths") {
  Scratch scratch;
  dresslife::pipeline::ImprovementStory story;
  story.name = "hose";
  story.second_title = "free length [m]";
  story.changes = {{"dresspack.components.1.routing.base_clamp.position_m", "[0.1, 0.2, 0.3]", "[0.15, 0.2, 0.3]"}};
  story.before = story.after = ImprovementStory::Lives{
      "", "all kept", "jacket wear from 5,890 h, abrasion of the outer hose from 25,000 h", 100, 1000, 1e9};
  for (int trial = 0; trial < 60; ++trial)
    story.points.push_back({trial, true, trial % 3 != 0, 100.0 * (1 + trial * 37 % 60), "bend radius"});
  story.front = {{2.0, 100}, {2.1, 2000}, {2.2, 4000}};
  story.nudges = {{"base clamp, z + 10 mm", true, 0.86, "", "jacket wear", 5000}};
  scratch.write("improve.html", improvement_page(story));
  check_page(scratch, "improve.html");
}

TEST_CASE("the pages of a plan and of duties can be sorted, printed and read on a phone") {
  using namespace dresslife::pipeline;
  Scratch scratch;
  LifeTable table{2, 100, {}, 40000, 80};
  for (const double scale : {2000.0, 9000.0})
    for (int d = 0; d < 100; ++d)
      table.hours.push_back(static_cast<float>(scale * std::pow(-std::log1p(-(d + 0.5) / 100), 0.4)));
  Fleet fleet;
  fleet.has_costs = true;
  const Day today = *day_from("2026-11-23");
  for (int i = 0; i < 120; ++i)
    fleet.rows.push_back(
        {{}, fmt::format("robot with a long name in hall {}", i), "day", today - std::chrono::days(3 * i), {}, 1, 10});
  const Plan plan =
      plan_of(fleet, {{"day", table}}, windows_from("2027-02-12..2027-02-21,2027-07-12", today), today, {0.1, true});
  scratch.write("plan.html",
                plan_page("line", fleet, plan, {{"A doubt."}, "Saves:\n  10  a\n", {"A note."}}, "plan.csv"));
  check_page(scratch, "plan.html");
  const std::string sorted = in_browser(scratch, "plan.html", R"(
    const first = () => evaluate(`document.querySelector('#ranking tbody tr').cells[1].textContent.split(' ').pop()`);
    const seen = [];
    for (let k = 0; k < 2; ++k) {
      await evaluate(`document.querySelectorAll('#ranking th button')[4].click()`);
      seen.push(await first());
    }
    return seen.join(' ');)");
  if (!sorted.empty()) CHECK(result_of(sorted) == "119 0");  // by age
  DutyResult duty;
  duty.name = "day", duty.robot_life_hours = 40000, duty.modes = {"wires"}, duty.damage.same_place = {1},
  duty.changes = {1};
  duty.lives.percentiles = {900, 20000, 3e6}, duty.lives.share = {0.9, 0.1};
  for (const char* job : {"a_program_with_a_name_that_is_long", "idle"})
    duty.parts.push_back({job,
                          5,
                          0.3,
                          {1e3, 1e4, HUGE_VAL},
                          {500, 1e4, 2e6},
                          {{0, {1e3, 1e4, HUGE_VAL}}, {0.3, {900, 20000, 3e6}}, {0.6, {450, 1e4, 1e6}}}});
  scratch.write("duty.html", duty_page("line", {duty}, "duty.csv"));
  check_page(scratch, "duty.html");
}
