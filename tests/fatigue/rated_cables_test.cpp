// Ratings against closed forms: the rig's own cycle, half and twice its range, Miner's sum.
#include "fatigue/rated_cables.h"

#include <cmath>
#include <numbers>

#include "tests/catch.h"

namespace dresslife::fatigue {
namespace {

using pipeline::RigKind;

constexpr double radius = 0.01, rated = 1e6;

pipeline::Rating rating(RigKind kind, double amount, double cycles = rated) {
  pipeline::Rating one;
  one.rig.kind = kind;
  one.cycles = cycles;
  if (kind == RigKind::torsion) one.rig.twist = amount;
  if (kind == RigKind::rolling_flex) one.rig.radius = amount, one.rig.travel = 0.1;
  if (kind == RigKind::tick_tock) one.rig.radius = amount;
  if (kind == RigKind::two_pulley) one.rig.pulley_diameter = 2 * amount, one.rig.travel = 10;
  return one;
}

pipeline::Component cable(std::vector<pipeline::Rating> ratings) {
  pipeline::Component part;
  part.name = "power cable", part.radius = radius;
  part.plain.emplace();
  part.plain->kind = pipeline::PlainKind::cable;
  part.ratings = std::move(ratings);
  return part;
}

/// Returns a motion with bends about an axis at `angle` from d1, and with twists.
SegmentMotion motion(const std::vector<double>& bends, const std::vector<double>& twists, double angle = 0) {
  SegmentMotion segment;
  for (const double bend : bends)
    segment.curvature1.push_back(bend * std::cos(angle)), segment.curvature2.push_back(bend * std::sin(angle));
  segment.twist = twists;
  return segment;
}

double repeats(const pipeline::Component& part, const SegmentMotion& segment) {
  return rated_life(part, {&segment, 1}).repeats;
}

const std::vector<double> none(5, 0.0);

}  // namespace

TEST_CASE("rating: a motion that is the rig's cycle lasts what the maker promises") {
  const double on_mandrel = 1 / (0.1 + radius);
  CHECK(repeats(cable({rating(RigKind::rolling_flex, 0.1)}), motion({0, 10, 10, 0, 0}, none)) == Approx(rated));
  CHECK(repeats(cable({rating(RigKind::tick_tock, 0.1)}), motion({0, on_mandrel, 0, -on_mandrel, 0}, none)) ==
        Approx(rated));
  CHECK(repeats(cable({rating(RigKind::torsion, 3)}), motion(none, {0, 3, 0, -3, 0})) == Approx(rated));
  // Each stroke of the carriage bends the cable to both sides, and straightens it in between.
  CHECK(repeats(cable({rating(RigKind::two_pulley, 0.1)}),
                motion({0, -on_mandrel, on_mandrel, 0, on_mandrel, -on_mandrel, 0}, std::vector<double>(7, 0.0))) ==
        Approx(rated));
  pipeline::Rating far = rating(RigKind::rolling_flex, 0.1);
  far.rig.travel = 8;  // bent and straightened in each stroke, so that one bend is half a cycle
  CHECK(repeats(cable({far}), motion({0, 10, 0, 0, 0}, none)) == Approx(2 * rated));
}

TEST_CASE("rating: another range lives by the exponent, whose deviation is the only spread") {
  for (const double factor : {0.25, 0.5, 2.0}) {
    const SegmentMotion segment = motion({0, 10 * factor, 0, 0, 0}, none);
    pipeline::Component part = cable({rating(RigKind::rolling_flex, 0.1)});
    const RatedLife life = rated_life(part, {&segment, 1});
    CHECK(life.repeats == Approx(rated * std::pow(factor, -pipeline::usual_damage_exponent)));
    CHECK(life.log10_spread == Approx(pipeline::damage_exponent_deviation * std::abs(std::log10(factor))));
    CHECK(life.bend_times == Approx(factor));
    CHECK(life.twist_times == 0);
    part.plain->damage_exponent = 3;
    CHECK(repeats(part, segment) == Approx(rated * std::pow(factor, -3)));
  }
  const SegmentMotion at_rating = motion({0, 10, 0, 0, 0}, none);
  CHECK(rated_life(cable({rating(RigKind::rolling_flex, 0.1)}), {&at_rating, 1}).log10_spread ==
        Approx(0).margin(1e-12));  // rounding
}

TEST_CASE("rating: nothing moves, nothing is used up") {
  const SegmentMotion still = motion(none, none), bent = motion({4, 4, 4, 4, 4}, none);
  const pipeline::Component part = cable({rating(RigKind::rolling_flex, 0.1), rating(RigKind::torsion, 3)});
  CHECK(std::isinf(repeats(part, still)));
  CHECK(std::isinf(repeats(part, bent)));
  CHECK(std::isinf(rated_life(part, {}).repeats));
}

TEST_CASE("rating: the plane of a bend hardly matters") {
  const pipeline::Component part = cable({rating(RigKind::rolling_flex, 0.1)});
  // At most half of the 15 degrees between tested directions: cos(7.5 deg)^5
  const double missed = std::pow(std::cos(std::numbers::pi / 24), -pipeline::usual_damage_exponent);
  for (int k = 0; k <= 24; ++k) {
    const double life = repeats(part, motion({0, 10, 0, 0, 0}, none, std::numbers::pi * k / 24));
    CHECK(life >= Approx(rated));
    CHECK(life <= Approx(rated * missed));
  }
}

TEST_CASE(
    "rating: of two of one kind the larger promise counts, bends and twist add up, a kind without a rating does no damage") {
  const SegmentMotion both = motion({0, 10, 0, 0, 0}, {0, 3, 0, -3, 0});
  CHECK(repeats(cable({rating(RigKind::rolling_flex, 0.1), rating(RigKind::rolling_flex, 0.2)}), both) ==
        Approx(rated));
  CHECK(repeats(cable({rating(RigKind::rolling_flex, 0.1), rating(RigKind::rolling_flex, 0.1, 3 * rated)}), both) ==
        Approx(3 * rated));
  const RatedLife life =
      rated_life(cable({rating(RigKind::rolling_flex, 0.1), rating(RigKind::torsion, 3, 3 * rated)}), {&both, 1});
  CHECK(life.repeats == Approx(0.75 * rated));
  CHECK(life.twist_share == Approx(0.25));
  CHECK(life.twist_times == Approx(1));
  const RatedLife twisted = rated_life(cable({rating(RigKind::torsion, 3)}), {&both, 1});
  CHECK(twisted.repeats == Approx(rated));
  CHECK_FALSE(twisted.bends);
  CHECK(twisted.twists);
}

TEST_CASE("rating: the worst segment has the place and the time") {
  const std::vector<SegmentMotion> segments{motion({0, 5, 0, 0, 0}, none), motion({0, 0, 0, 8, 0}, none),
                                            motion({0, 6, 0, 0, 0}, none)};
  const RatedLife life = rated_life(cable({rating(RigKind::rolling_flex, 0.1)}), segments);
  CHECK(life.segment == 1);
  CHECK(life.sample == 3);
}

}  // namespace dresslife::fatigue
