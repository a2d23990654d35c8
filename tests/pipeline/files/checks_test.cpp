// What a receipt tells of a motion's checks.
#include "pipeline/files/checks.h"

#include <catch2/catch.hpp>
#include <limits>

#include "pipeline/files/files.h"
#include "tests/pipeline/scratch.h"

namespace dresslife::pipeline {
namespace {

/// A motion of no samples, with checks if there are any.
void write_motion(const std::filesystem::path& name, const std::vector<CheckedValue>& checks) {
  FileWriter file(name, motion_format());
  file.set_axis("segment", 1);
  file.set_axis("clamp", 2);
  for (const char* dataset : {"/time", "/segment/position", "/segment/orientation", "/clamp/position",
                              "/clamp/orientation", "/contact/max_depth", "/energy", "/tension"})
    file.append(dataset, std::span<const double>());
  for (const char* dataset : {"/program/step", "/contact/count"})
    file.append(dataset, std::span<const std::int32_t>());
  file.append("/program/text", std::vector<std::string>{"home"});
  file.append("/segment/length", std::vector<double>{0.1});
  std::vector<std::string> names;
  std::vector<double> values, limits;
  for (const CheckedValue& check : checks) {
    names.push_back(check.name);
    values.push_back(check.value);
    limits.push_back(check.limit);
  }
  if (!checks.empty()) {
    file.append("/check/name", names);
    file.append("/check/value", values);
    file.append("/check/limit", limits);
  }
  for (const char* attribute : {"job", "history", "input_sha256"}) file.attribute(attribute, "");
  file.commit();
}

}  // namespace

TEST_CASE("checks: a receipt tells those of its motion, bit for bit, when the motion is gone") {
  const Scratch scratch;
  const std::filesystem::path motion = scratch / "motion.h5", note = scratch / "sim.receipt";
  constexpr double endless = std::numeric_limits<double>::infinity();
  const std::vector<CheckedValue> checks{{"smallest bend radius", endless, 0.6},
                                         {"largest net twist", -1.0 / 3, endless},
                                         {"least slack: too short below", 0.1 + 0.2, 1e-300}};
  write_motion(motion, checks);
  write_receipt(note, {"recipe", "-", "output", {}, told_checks(motion)}, motion);
  std::filesystem::remove(motion);
  CHECK(checks_in(read_receipt(note)->told) == checks);

  write_motion(motion, {});
  CHECK(told_checks(motion).empty());
  CHECK(checks_in({}).empty());
}

}  // namespace dresslife::pipeline
