#include "pipeline/cable/plausible.h"

#include <algorithm>
#include <numbers>
#include <utility>

#include "pipeline/cable/stiffness.h"
#include "pipeline/resolve/job_text.h"
#include "tests/catch.h"

namespace dresslife::pipeline {

TEST_CASE("plausible: no shipped dresspack is doubted") {
  for (const char* name : {"control_cable", "handling", "sensor_cable", "spot_welding", "thesis_welding"}) {
    CAPTURE(name);
    const auto warnings =
        plausibility_warnings(read_dresspack(DRESSLIFE_SOURCE_DIR "/config/dresspacks/" + std::string(name) + ".yaml"));
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
  limit(8960 * section);  // solid copper as the bound for unknown parts
  dresspack.components = parts;
  // Less than 30 % of the mass of its parts, or than its wires in aluminium: ten straight ones of 1 mm have 10 x 2700 x pi/4 x 1e-6 kg/m.
  const auto least = [&](double bound) {
    dresspack.mass_per_length = 1.001 * bound;
    CHECK(plausibility_warnings(dresspack).empty());
    dresspack.mass_per_length = 0.999 * bound;
    CHECK(plausibility_warnings(dresspack).size() == 1);
  };
  least(0.3 * mass_of_construction(dresspack));
  Component wires;
  wires.name = "wire", wires.material = "copper", wires.count = 10, wires.radius = 0.5e-3, wires.helix_radius = 3e-3;
  dresspack.components = {wires};
  least(std::max(10 * 2700 * std::numbers::pi / 4 * 1e-6, 0.3 * mass_of_construction(dresspack)));
}

TEST_CASE("plausible: a wire without a density is named where its mass is computed") {
  Dresspack dresspack = read_dresspack(DRESSLIFE_SOURCE_DIR "/config/dresspacks/sensor_cable.yaml");
  for (Material& of : dresspack.materials) of.density.reset();
  CHECK(plausibility_warnings(dresspack).empty());  // its mass is given
  dresspack.mass_from_construction = true;
  const std::vector<Warning> warnings = plausibility_warnings(dresspack);
  REQUIRE(warnings.size() == 1);
  CHECK_THAT(warnings[0].words, Catch::Contains("has no density (limit: one is needed; '") &&
                                    Catch::Contains("density_kg_per_m3: 8900 for copper"));
}

TEST_CASE("plausible: a wire that is too thin names the slip behind it, for a part and for a data sheet") {
  const auto words = [](double radius) {
    Dresspack dresspack = read_dresspack(DRESSLIFE_SOURCE_DIR "/config/dresspacks/sensor_cable.yaml");
    Component wire;
    wire.name = "thin", wire.material = "copper", wire.radius = radius;
    dresspack.components.push_back(wire);
    for (const Warning& warning : plausibility_warnings(dresspack))
      if (warning.words.find("'thin'") != std::string::npos) return warning.words;
    return std::string();
  };
  CHECK(words(0.01e-3) == "");
  const std::string digit = words(0.0075e-3);  // 'wire 0.015 mm' of a data sheet
  CHECK_THAT(digit, Catch::Contains("Likely cause: a missing digit") &&
                        Catch::Contains("radius_mm: 0.075 if a digit is missing") &&
                        Catch::Contains("in a data sheet wire_diameter_mm: 0.15 if a digit is missing") &&
                        !Catch::Contains("metres instead"));
  CHECK_THAT(words(0.0001e-3),
             Catch::Contains("Likely cause: metres") && Catch::Contains("radius_mm: 0.1 if that was metres"));
  CHECK_THAT(words(1e-9),
             Catch::Contains("Likely cause: another unit. Remedy: radius_mm: half of the wire's diameter"));
}

TEST_CASE("plausible: a swing that neither rings on nor stands still") {
  Dresspack dresspack = read_dresspack(DRESSLIFE_SOURCE_DIR "/config/dresspacks/spot_welding.yaml");
  for (const auto& [milliseconds, doubts] : {std::pair{0.0, 1}, {0.8, 1}, {0.9, 0}, {170.0, 0}, {180.0, 1}}) {
    dresspack.damping_time = 1e-3 * milliseconds;
    CAPTURE(milliseconds);
    CHECK(plausibility_warnings(dresspack).size() == static_cast<std::size_t>(doubts));
  }
}

TEST_CASE("plausible: tubes whose bore or radius is half or twice what it should be") {
  const auto words = [](double radius, double bore) {
    Dresspack dresspack = read_dresspack(DRESSLIFE_SOURCE_DIR "/config/dresspacks/handling.yaml");
    for (Component& of : dresspack.components)
      if (of.plain && of.plain->bore) of.radius = radius / 1e3, of.plain->bore = bore / 1e3, of.count = 1;
    std::string all;
    for (const Warning& warning : plausibility_warnings(dresspack)) all += warning.words + "\n";
    return all;
  };
  // Tubes of polyamide and polyurethane from makers, and a hydraulic hose with one steel braid.
  for (const auto& [outer, bore] :
       {std::pair{4.0, 2.0}, {4.0, 2.5}, {6.0, 4.0}, {8.0, 5.0}, {8.0, 5.5}, {8.0, 6.0}, {16.0, 13.0}, {13.4, 6.4}}) {
    CAPTURE(outer, bore);
    CHECK(words(outer / 2, bore) == "");
  }
  CHECK_THAT(words(4, 2.75), Catch::Contains("is 2.75, and it is 8 mm wide outside by radius_mm 4") &&
                                 Catch::Contains("bore_mm: 5.5 if 2.75 is half the bore"));
  CHECK_THAT(words(8, 5.5),
             Catch::Contains("bore_mm: 11 if 5.5 is half the bore; or radius_mm: 4 if 8 is the outer diameter"));
  CHECK_THAT(words(3, 5.9), Catch::Contains("bore_mm: 4 (ESTIMATE)"));
  CHECK_THAT(words(4, 0.0055), Catch::Contains("bore_mm: 5.5 if that was metres"));
}

TEST_CASE("plausible: friction of the hose and of a part, up to the limit that is printed") {
  for (const auto& [friction, doubts] : {std::pair{0.0, 0u}, {1.0, 0u}, {1.5, 0u}, {1.51, 1u}, {15.0, 1u}}) {
    CAPTURE(friction);
    Dresspack hose = read_dresspack(DRESSLIFE_SOURCE_DIR "/config/dresspacks/handling.yaml"), part = hose;
    hose.friction = part.components[1].friction.emplace(friction);
    for (const Dresspack& of : {hose, part}) {
      const auto warnings = plausibility_warnings(of);
      REQUIRE(warnings.size() == doubts);
      if (doubts) CHECK_THAT(warnings[0].words, Catch::Contains("(limit 1.5 or less)"));
    }
  }
}

TEST_CASE("plausible: a jacket in metres is doubted") {
  Dresspack dresspack = read_dresspack(DRESSLIFE_SOURCE_DIR "/config/dresspacks/spot_welding.yaml");
  dresspack.components.at(0).jacket->thickness = 1.3e-6;
  const auto warnings = plausibility_warnings(dresspack);
  REQUIRE(warnings.size() == 1);
  CHECK_THAT(warnings[0].words, Catch::Contains("thickness_mm: 1.3 if that was metres"));
}

TEST_CASE("plausible: wear rates between a tenth of the least that slides and more than abrasive cloth takes off") {
  Dresspack dresspack = read_dresspack(DRESSLIFE_SOURCE_DIR "/config/dresspacks/spot_welding.yaml");
  const auto words = [&](double rate) {
    for (Material& of : dresspack.materials)
      if (of.name == "hose_polyamide") of.wear.at(0).rate = 1e-9 * rate;
    std::string text;
    for (const Warning& warning : plausibility_warnings(dresspack)) text += warning.words + "\n";
    return text;
  };
  CHECK((words(1.01e-8).empty() && words(0.099).empty()));
  CHECK_THAT(words(3e-15), Catch::Contains("rate_mm3_per_Nm: 3e-06 if that was m3/(N m)"));
  CHECK_THAT(words(0.11), Catch::Contains("rate_mm3_per_Nm of 'hose_polyamide' is 0.11 (limits 1e-08 .. 0.1)"));
}

TEST_CASE("plausible: the rig of a rating beside the diameter of its cable, also in the core") {
  const auto words = [](const auto& change) {
    Dresspack core = read_dresspack(DRESSLIFE_SOURCE_DIR "/config/dresspacks/spot_welding.yaml");
    Component& power = core.core_components.at(1);  // 8 mm
    REQUIRE(power.ratings.size() == 1);
    change(power.ratings[0].rig);
    std::string all;
    for (const Warning& warning : plausibility_warnings(core)) all += warning.words + "\n";
    Dresspack alone = read_dresspack(DRESSLIFE_SOURCE_DIR "/config/dresspacks/sensor_cable.yaml");
    alone.ratings = power.ratings, alone.diameter = 2 * power.radius;  // other keys contradict this diameter
    const auto doubts = plausibility_warnings(alone);
    CHECK(std::any_of(doubts.begin(), doubts.end(), [](const Warning& warning) {
            return warning.words.find("in a rating of") != std::string::npos;
          }) == !all.empty());
    return all;
  };
  const auto bent = [&](RigKind kind, double millimetres) {
    return words([&](Rig& rig) {
      rig = Rig{};
      rig.kind = kind;
      (kind == RigKind::two_pulley ? rig.pulley_diameter : rig.radius) = 1e-3 * millimetres;
      if (kind == RigKind::rolling_flex) rig.travel = 1;
    });
  };
  for (const double radius : {16.0, 32.0, 90.0, 800.0}) CHECK(bent(RigKind::rolling_flex, radius) == "");
  CHECK(bent(RigKind::tick_tock, 12) == "");
  CHECK(bent(RigKind::two_pulley, 24) == "");
  CHECK_THAT(
      bent(RigKind::rolling_flex, 7.5),
      Catch::Contains("radius_mm in a rating of 'power cable' is 7.5: its axis is bent to 0.938 diameters (limits 2 .. "
                      "100)") &&
          Catch::Contains("radius_diameters: 7.5 if so"));
  CHECK_THAT(bent(RigKind::rolling_flex, 10000), Catch::Contains("bent to 1.25e+03 diameters"));
  CHECK_THAT(bent(RigKind::tick_tock, 0.08), Catch::Contains("radius_mm: 80 if that was metres"));
  CHECK_THAT(bent(RigKind::two_pulley, 1), Catch::Contains("pulley_diameter_mm in a rating of 'power cable' is 1"));
  CHECK_THAT(words([](Rig& rig) { rig.radius.reset(), rig.radius_diameters = 1.9; }),
             Catch::Contains("radius_diameters in a rating of 'power cable' is 1.9"));
  CHECK_THAT(words([](Rig& rig) { rig.travel = 320; }),
             Catch::Contains("travel_m in a rating of 'power cable' is 320 (limit 20 or less)") &&
                 Catch::Contains("travel_m: 0.32 if that was mm"));
  const auto twisted = [&](double degrees) {
    return words([&](Rig& rig) {
      rig = Rig{};
      rig.twist = degrees * std::numbers::pi / 180;
    });
  };
  for (const double twist : {10.0, 180.0, 2700.0, 3600.0}) CHECK(twisted(twist) == "");
  CHECK_THAT(twisted(3.14),
             Catch::Contains("twist_deg_per_m in a rating of 'power cable' is 3.14 (limits 10 .. 3600)") &&
                 Catch::Contains("twist_deg_per_m: 179.9 if that was rad/m"));
  CHECK_THAT(twisted(1e5), Catch::Contains("is 100000 (limits 10 .. 3600)"));
}

TEST_CASE("plausible: slack as a share") {
  Dresspack dresspack = read_dresspack(DRESSLIFE_SOURCE_DIR "/config/dresspacks/handling.yaml");
  for (const auto& [percent, doubts] : {std::pair{0.0, 0u}, {0.01, 1u}, {0.049, 1u}, {0.051, 0u}, {1.0, 0u}}) {
    CAPTURE(percent);
    dresspack.components[1].laying.slack = percent;
    CHECK(plausibility_warnings(dresspack).size() == doubts);
  }
}

TEST_CASE("plausible: a corrugation beside its two diameters, and a bend radius of a slip") {
  Dresspack dresspack = read_dresspack(DRESSLIFE_SOURCE_DIR "/config/dresspacks/handling.yaml");
  REQUIRE(dresspack.hose_corrugation);
  const double height = (dresspack.diameter - inner_radius(dresspack).value() * 2) / 2;
  dresspack.inner_diameter = dresspack.diameter - 2 * height;
  const auto words = [&] {
    std::string all;
    for (const Warning& warning : plausibility_warnings(dresspack)) all += warning.words + "\n";
    return all;
  };
  for (const auto& [factor, doubt] : {std::pair{0.81, false}, {1.19, false}, {0.79, true}, {1.21, true}, {2.0, true}}) {
    CAPTURE(factor);
    dresspack.hose_corrugation->height = factor * height;
    CHECK((words().find("height_mm of hose_corrugation is") != std::string::npos) == doubt);
    CHECK((words().find(fmt::format("height_mm: {:.3g}, or the diameters", 1e3 * height)) != std::string::npos) ==
          doubt);
  }
  dresspack.hose_corrugation->height = height;
  CHECK(words() == "");
  dresspack.least_bend_radius = 0.26 * dresspack.diameter;
  CHECK_THAT(words(), Catch::Contains(fmt::format("least_bend_radius_mm: {:.4g} if a digit is missing",
                                                  2.6e3 * dresspack.diameter)));
}

}  // namespace dresslife::pipeline
