// The checks of a motion, kept in its receipt.
#include "pipeline/files/checks.h"

#include <limits>

#include "tests/catch.h"
#include "tests/pipeline/files/still_motion.h"
#include "tests/pipeline/scratch.h"

namespace dresslife::pipeline {
namespace {

/// Writes a motion without samples, with these checks.
void write_motion(const std::filesystem::path& name, const std::vector<CheckedValue>& checks) {
  std::vector<std::string> names;
  std::vector<double> values, limits;
  for (const CheckedValue& check : checks) {
    names.push_back(check.name);
    values.push_back(check.value);
    limits.push_back(check.limit);
  }
  write_still_motion(name, 1, 2, [&](FileWriter& file) {
    if (checks.empty()) return;
    file.append("/check/name", names);
    file.append("/check/value", values);
    file.append("/check/limit", limits);
  });
}

}  // namespace

TEST_CASE("checks: a receipt reports those of its motion, bit for bit, when the motion is gone") {
  const Scratch scratch;
  const std::filesystem::path motion = scratch / "motion.h5", note = scratch / "sim.receipt";
  constexpr double endless = std::numeric_limits<double>::infinity();
  const std::vector<CheckedValue> checks{{"smallest bend radius", endless, 0.6},
                                         {"largest net twist", -1.0 / 3, endless},
                                         {"least slack, length too short", 0.1 + 0.2, 1e-300}};
  write_motion(motion, checks);
  write_receipt(note, {"recipe", "-", "output", {}, results_of_checks(motion)}, motion);
  std::filesystem::remove(motion);
  CHECK(checks_in(read_receipt(note)->results) == checks);

  write_motion(motion, {});
  CHECK(results_of_checks(motion).empty());
  CHECK(checks_in({}).empty());
}

}  // namespace dresslife::pipeline
