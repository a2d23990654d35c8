#include "pipeline/cable/plausible.h"

#include <numbers>
#include <utility>

#include "pipeline/cable/stiffness.h"
#include "pipeline/resolve/job_text.h"
#include "tests/catch.h"

namespace dresslife::pipeline {

TEST_CASE("plausible: no shipped dresspack is doubted") {
  for (const char* name : {"control_cable", "handling", "sensor_cable", "spot_welding", "thesis_welding"}) {
    CAPTURE(name);
    const auto warnings = plausibility_warnings(
        read_dresspack(DRESSLIFE_SOURCE_DIR "/config/dresspacks/" + std::string(name) + ".yaml"));
    CHECK(warnings.empty());
  }
}

TEST_CASE("plausible: a mass between that of its wires and of its parts in a heavy filling, to the gram") {
  Dresspack dresspack = read_dresspack(DRESSLIFE_SOURCE_DIR "/config/dresspacks/sensor_cable.yaml");
  const double section = std::numbers::pi / 4 * dresspack.diameter * dresspack.diameter;
  const auto limit = [&](double most) {
    dresspack.mass_per_length = 0.999 * most;
    CHECK(plausibility_warnings(dresspack).empty());
    dresspack.mass_per_length = 1.001 * most;
    CHECK(plausibility_warnings(dresspack).size() == 1);
  };
  limit(mass_of_construction(dresspack) + 2500 * section);
  const std::vector<Component> parts = std::exchange(dresspack.components, {});
  limit(8960 * section);  // of unknown parts: solid copper
  dresspack.components = parts;
  // Of ten straight wires alone, each 1 mm wide, a metre weighs 10 x 2700 x pi/4 x 1e-6 kg in aluminium.
  Component wires;
  wires.name = "wire", wires.material = "copper", wires.count = 10, wires.radius = 0.5e-3,
  wires.helix_radius = 3e-3;
  dresspack.components = {wires};
  const double least = 10 * 2700 * std::numbers::pi / 4 * 1e-6;
  dresspack.mass_per_length = 1.001 * least;
  CHECK(plausibility_warnings(dresspack).empty());
  dresspack.mass_per_length = 0.999 * least;
  REQUIRE(plausibility_warnings(dresspack).size() == 1);
  CHECK(plausibility_warnings(dresspack).front().words.find("its wires") != std::string::npos);
}

TEST_CASE("plausible: a swing that neither rings on nor stands still") {
  Dresspack dresspack = read_dresspack(DRESSLIFE_SOURCE_DIR "/config/dresspacks/spot_welding.yaml");
  for (const auto& [milliseconds, doubts] : {std::pair{0.0, 1}, {0.8, 1}, {0.9, 0}, {170.0, 0}, {180.0, 1}}) {
    dresspack.damping_time = 1e-3 * milliseconds;
    CAPTURE(milliseconds);
    CHECK(plausibility_warnings(dresspack).size() == static_cast<std::size_t>(doubts));
  }
}

}  // namespace dresslife::pipeline
