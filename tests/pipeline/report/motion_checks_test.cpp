#include "pipeline/report/motion_checks.h"

#include <limits>

#include "pipeline/files/files.h"
#include "tests/catch.h"
#include "tests/pipeline/scratch.h"

namespace dresslife::pipeline {
namespace {

/// Writes one sample of two segments of half a metre; with two checks, or in the form of an older version.
void write_motion(const std::filesystem::path& name, bool checked, bool returns = true,
                  const std::vector<double>& values = {0.25, 3.14159265358979}, double position = 0.9,
                  const std::vector<std::int32_t>& dresspacks = {}, bool simulated = true) {
  FileWriter file(name, motion_format());
  file.set_axis("segment", 2);
  file.set_axis("clamp", 2);
  for (const char* dataset : {"/time", "/contact/max_depth"}) file.append(dataset, std::vector<double>{0});
  file.append("/segment/position", std::vector<double>(6));
  file.append("/segment/orientation", std::vector<double>(8));
  file.append("/segment/length", std::vector<double>{0.5, 0.5});
  file.append("/clamp/position", std::vector<double>(6));
  file.append("/clamp/orientation", std::vector<double>(8));
  for (const char* dataset : {"/program/step", "/contact/count"}) file.append(dataset, std::vector<std::int32_t>{0});
  file.append("/program/text", std::vector<std::string>{"home", "reach <far>"});
  file.append("/energy", std::vector<double>(3));
  file.append("/tension", std::vector<double>(2));
  if (checked) {
    file.append("/check/name", std::vector<std::string>{"smallest bend radius", "largest net twist"});
    file.append("/check/unit", std::vector<std::string>{"m", "rad"});
    file.append("/check/value", values);
    file.append("/check/limit", std::vector<double>{0.4, std::numeric_limits<double>::infinity()});
    file.append("/check/warning", std::vector<std::int32_t>{1, 0});
    file.append("/check/time", std::vector<double>{1.25, 2});
    file.append("/check/step", std::vector<std::int32_t>{1, 0});
    file.append("/check/position", std::vector<double>{position, -1});
    if (!dresspacks.empty()) {
      file.set_axis("dresspack", 2);
      file.append("/segment/dresspack", std::vector<std::int32_t>{0, 1});
      file.append("/dresspack/name", std::vector<std::string>{"hose", "red & blue"});
      file.append("/check/dresspack", dresspacks);
    }
    file.attribute("repeats", 3.0);
    if (returns) file.attribute("repeat_distance", 2e-4);
    if (simulated) file.attribute("time_step", 1e-4);
  }
  for (const char* attribute : {"job", "history", "input_sha256"}) file.attribute(attribute, "");
  file.commit();
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST_CASE("motion checks: a table in the units of cell designers") {
  const Scratch scratch;
  write_motion(scratch / "motion.h5", true);
  const std::string table = check_table(scratch / "motion.h5");
  CHECK(contains(table, "Repeat 3 of the motion; the dresspack ended it 0.2 mm from where it began it."));
  CHECK(contains(table,
                 "<td>smallest bend radius</td><td class=\"number failed\">250.0 mm</td><td "
                 "class=\"number\">400.0 mm</td><td class=\"number\">0.10 m</td>"));
  CHECK(contains(table, "reach &lt;far&gt;"));
  CHECK(contains(table, "<td>largest net twist</td><td class=\"number\">0.50 turns</td><td class=\"number\"></td>"));
  write_motion(scratch / "once.h5", true, false);
  CHECK(contains(check_table(scratch / "once.h5"), "was run once"));
  write_motion(scratch / "prescribed.h5", true, false, {0.25, 3.14159265358979}, 0.9, {}, false);
  CHECK_FALSE(contains(check_table(scratch / "prescribed.h5"), "was run once"));
}

TEST_CASE("motion checks: nothing has no sign") {
  const Scratch scratch;
  write_motion(scratch / "motion.h5", true, true, {-1e-7, -1e-9}, 1 + 1e-9);
  const std::string table = check_table(scratch / "motion.h5");
  CHECK(contains(table, ">0.0 mm<"));
  CHECK(contains(table, ">0.00 turns<"));
  CHECK(contains(table, ">0.00 m<"));
  CHECK_FALSE(contains(table, "-0"));
}

TEST_CASE("motion checks: each names its dresspack among several and counts from its tool") {
  const Scratch scratch;
  write_motion(scratch / "motion.h5", true, true, {0.25, 3.14159265358979}, 0.4, {1, 0});
  const std::string table = check_table(scratch / "motion.h5");
  CHECK(contains(table, "<td>red &amp; blue, smallest bend radius</td>"));
  CHECK(contains(table, "<td class=\"number\">0.10 m</td>"));
  CHECK(contains(table, "<td>hose, largest net twist</td>"));
  write_motion(scratch / "wrong.h5", true, true, {0.25, 3.14159265358979}, 0.4, {1, 2});
  CHECK(contains(message_of([&] { check_table(scratch / "wrong.h5"); }),
                 "/check/dresspack names dresspack 2; run dresslife-sim again"));
}

TEST_CASE("motion checks: a file without them has no table") {
  const Scratch scratch;
  write_motion(scratch / "old.h5", false);
  CHECK(check_table(scratch / "old.h5").empty());
}

}  // namespace
}  // namespace dresslife::pipeline
