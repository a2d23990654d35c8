// Remedies of a large force: each proposed slack against the forces that a cable with this slack has.
#include "fatigue/cable_cures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>

#include "pipeline/cable/believable.h"
#include "pipeline/cable/excess.h"
#include "tests/catch.h"
#include "tests/fatigue/materials.h"

using namespace dresslife;
using namespace dresslife::fatigue;

namespace {

struct Cable {
  pipeline::Dresspack dresspack;
  CableFacts facts;
  pipeline::CableForce force;

  Cable() {
    auto copper = fatigue_tests::copper();
    copper.name = "copper", copper.tensile_strength = 230e6;
    dresspack.materials = {copper};
    dresspack.diameter = 0.05;
    dresspack.components.resize(2);
    pipeline::Component& cable = dresspack.components[1];
    cable.name = "cable", cable.radius = 3e-3, cable.laying.position = pipeline::Position::loose;
    cable.components.resize(1);
    pipeline::Component& wires = cable.components[0];
    wires.name = "wire", wires.material = "copper", wires.count = 100, wires.radius = 1e-4;
    force = pipeline::CableForce(dresspack, cable);
    facts = {"cable", "dresspack", "2", &cable, &dresspack};
    facts.has_room = true;
  }
  double limit() const { return pipeline::believable_share * force.strength(); }
  /// Returns the force of the cable with this slack where its path is longest, and where it is shortest [N].
  double pulled(double slack) const { return force.force(std::max(0.0, facts.most_gain - slack)); }
  double pressed(double slack) const {
    return pipeline::force_of_excess(force, slack - std::min(0.0, facts.least_gain), facts.room);
  }
  /// Returns the bend radius of the helix that it then makes, over its diameter.
  double bend(double slack) const {
    return facts.room / (2 * (slack - facts.least_gain)) / (2 * facts.component->radius);
  }
};

struct Proposed {
  double proposed, low, high;  // [%]
};
std::optional<Proposed> proposed_by(const std::string& remedy) {
  const std::string key = "dresspack.components.2.slack_percent: ";
  if (!remedy.starts_with(key)) return {};
  const std::size_t open = remedy.find('('), dots = remedy.find(" .. ");
  return Proposed{std::stod(remedy.substr(key.size())), std::stod(remedy.substr(open + 1)),
                  std::stod(remedy.substr(dots + 4))};
}

}  // namespace

TEST_CASE(
    "cures: a proposed slack keeps force and bend radius, a smaller or larger one does not, and if none is proposed none keeps them") {
  std::mt19937 random(2);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  int found = 0, none = 0, bends_less = 0;
  for (int round = 0; round < 80; ++round) {
    Cable cable;
    CableFacts& facts = cable.facts;
    facts.least_gain = between(-0.02, 0.02), facts.most_gain = facts.least_gain + between(-0.01, 0.05);
    facts.room = std::pow(10, between(-4, -2)), facts.slack_factor = between(0.5, 2);
    cable.dresspack.components[1].laying.slack = between(0, 4);
    const double slack = facts.slack_factor * cable.dresspack.components[1].laying.slack / 100;
    const std::string remedy = cure_of(facts, cable.force, false, round % 2 == 0, 80).remedy;
    const auto holds = [&](double of) {
      return cable.pulled(of) <= cable.limit() && cable.pressed(of) <= cable.limit() && of <= pipeline::largest_slack;
    };
    const auto keeps = [&](double of) {
      return holds(of) && (of <= facts.least_gain || cable.bend(of) >= 10);
    };  // ten diameters: the usual rule
    CAPTURE(round, remedy);
    if (remedy.starts_with("motion.acceleration_percent: 40 (now 80), dresspack.components.2.friction_coefficient")) {
      CHECK((cable.pulled(slack) <= cable.limit() && cable.pressed(slack) <= cable.limit()));
    } else if (const auto proposed = proposed_by(remedy)) {
      ++found;
      const double low = proposed->low / 100 * facts.slack_factor, high = proposed->high / 100 * facts.slack_factor;
      if (high < low) continue;  // the range is narrower than two digits
      CHECK((keeps(low) && keeps(high)));
      constexpr double digit = 0.11;  // two digits, rounded to the safe side, are at most a tenth away
      CHECK((low == 0 || !keeps(low / (1 + digit))));
      CHECK(!keeps(high * (1 + digit)));
      CHECK(proposed->proposed ==
            (cable.dresspack.components[1].laying.slack < proposed->low ? proposed->low : proposed->high));
    } else {
      bool any = false;
      for (double of = 0; of <= pipeline::largest_slack; of += 1e-3) any = any || keeps(of);
      CHECK_FALSE(any);
      const bool too_short = cable.pulled(pipeline::largest_slack) > cable.limit();
      CHECK((remedy.find("no slack up to 5 % cures it") == 0) == too_short);
      bends_less += too_short;
      if (too_short) continue;
      ++none;
      const double needed = std::stod(remedy.substr(remedy.find("It needs ") + 9)) / 1e3;
      const double least = std::max(0.0, facts.most_gain - cable.force.strain_at(cable.limit()));
      const auto enough = [&](double room) {
        facts.room = room;
        return cable.pressed(least) <= cable.limit() && (least <= facts.least_gain || cable.bend(least) >= 10);
      };
      CHECK((enough(1.06 * needed) && !enough(needed / 1.06)));  // two digits
    }
  }
  CHECK((found > 5 && none > 5 && bends_less > 0));
}

TEST_CASE("cures: no slack and no room is proposed for a part whose breaking force is unknown") {
  Cable cable;
  cable.dresspack.materials.front().tensile_strength = 0;
  cable.force = pipeline::CableForce(cable.dresspack, cable.dresspack.components[1]);
  REQUIRE(cable.force.strength() == 0);
  cable.facts.least_gain = -0.004, cable.facts.most_gain = 0.03, cable.facts.room = 3e-3;
  for (const bool compressed : {false, true}) {
    const Cure cure = cure_of(cable.facts, cable.force, false, compressed, 80);
    CHECK_THAT(cure.remedy, Catch::StartsWith("motion.acceleration_percent: 40 (now 80)"));
    CHECK_THAT(cure.cause, !Catch::Contains("at most"));
  }
  cable.dresspack.components[1].laying.position = pipeline::Position::held;
  cable.dresspack.inner_diameter = 0.044;
  CHECK_THAT(cure_of(cable.facts, cable.force, false, false, 80).remedy,
             Catch::StartsWith("dresspack.components.2.position: loose, or dresspack.components.2.base_grip_N"));
}

TEST_CASE("cures: what holds a cable or sticks to it goes before its slack") {
  Cable cable;
  cable.facts.least_gain = -0.004, cable.facts.most_gain = 0.03, cable.facts.room = 4e-3;
  const auto cure = [&](bool sticks = false, bool compressed = false) {
    return cure_of(cable.facts, cable.force, sticks, compressed, 1);
  };
  CHECK(cure(true).remedy == "strain.slip: friction");
  pipeline::Component& part = cable.dresspack.components[1];
  part.laying.slack = 0.2, cable.facts.winding_slack = 0.008;  // the usual 1 % is more
  cable.facts.room = 0.1;
  CHECK_THAT(cure().cause, Catch::Contains("0.2 % of slack, too little to wind around the hose's axis"));
  // The slack to pull less is larger than that to wind: at 3 % of gain.
  CHECK_THAT(cure().remedy, Catch::StartsWith("dresspack.components.2.slack_percent: 1 (1 .. "));
  CHECK_THAT(cure(false, true).cause, Catch::Contains("where its path and its room take"));
  cable.facts.winding_slack = 0;
  CHECK_THAT(cure().cause, Catch::Contains("it has 1e+02 mm of room and 0.2 % of slack, and its path gets"));
  part.laying.position = pipeline::Position::held;
  CHECK_THAT(cure().cause, Catch::Contains("while its path changes by -0.4 .. 3 %"));
  CHECK_THAT(
      cure().remedy,
      Catch::Contains(
          "dresspack.inner_diameter_mm: 42.5 (ESTIMATE) if it lies in a hose, else the lengths and clamps that `dresslife improve` finds (less "
          "bend and twist), or dresspack.components.2.base_grip_N"));
  cable.dresspack.diameter = 2 * part.radius;  // a cable does not lie in a hose of its own width
  CHECK_THAT(cure().remedy, Catch::StartsWith("the lengths and clamps that `dresslife improve` finds"));
  cable.dresspack.diameter = 0.05;
  cable.dresspack.inner_diameter = 0.044;
  CHECK_THAT(cure().remedy,
             Catch::StartsWith("dresspack.components.2.position: loose, or dresspack.components.2.slack_percent: "));
  cable.facts.room = 0;
  CHECK_THAT(cure().remedy,
             Catch::StartsWith("dresspack.components.2.position: loose, or dresspack.components.2.base_grip_N"));
  cable.facts.has_room = false;
  CHECK_THAT(cure().remedy, Catch::StartsWith("dresspack.components.2.slack_percent (run dresslife-strain again"));
}
