// Published tests of the laws of kinks, wear and bending, which need no robot and no rig, beside what the laws say.
//
//   law_tests:
//     - name: smc_6x4
//       what: tube of polyamide 12, 6 x 4 mm, bent until it is crushed
//       tube: {outer_mm: 6, bore_mm: 4, kinks_at_mm: 18}
//       source: ...
//     - name: pa66_on_pc
//       what: ...
//       wear: {material: hose_polyamide, against: dresspack, force_N: 10, way_m: 1000, worn_mm3: 0.12}
//       source: ...
//     - name: hm3_core_20
//       what: ...
//       bending: {cable: {radius_mm: 1.2, components: [...]}, curvature_1_per_m: 20, moment_mNm: 4.62}    cable: as in a dresspack
//       source: ...
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/job/dresspack.h"
#include "pipeline/settings/document.h"

namespace dresslife::pipeline {

class Fields;

/// A smooth tube bent in one plane: one of the three radii of its axis [m].
struct TubeTest {
  double outer = 0, bore = 0;        ///< diameters [m]
  std::optional<double> kinks_at;    ///< it kinks
  std::optional<double> oval_at;     ///< its diameter has changed by oval_share
  std::optional<double> allowed_at;  ///< its maker's least radius: it does not kink
  double oval_share = 0.05;
};
void describe(Fields& f, TubeTest& test);

/// A surface that was rubbed with a force over a way.
struct WearTest {
  std::string material;  ///< of the catalogue
  Counterface against = Counterface::robot;
  double force = 0, way = 0;        ///< [N], [m]
  std::optional<double> worn;       ///< volume [m3]
  std::optional<double> worn_more;  ///< of a rougher counterface than `against`: the law must say less [m3]
};
void describe(Fields& f, WearTest& test);

/// A cable by itself that was bent from straight for the first time, in one plane.
struct BendingTest {
  Dresspack cable;         ///< as `dresspack: {cable: ..}` of a job, with the friction that is estimated without a measurement
  double curvature = 0;    ///< [1/m]
  double moment = 0;       ///< [N m]
};
void describe(Fields& f, BendingTest& test);

struct LawTest {
  std::string name, what, source;
  bool sets_constant = false;  ///< the constants of the law come from this test: it cannot confirm them
  std::optional<TubeTest> tube;
  std::optional<WearTest> wear;
  std::optional<BendingTest> bending;
  Where where;
};
void describe(Fields& f, LawTest& test);

/// The prediction of a law for a test: percentiles 10, 50, 90 of a radius [m], a volume [m3] or a moment [N m].
struct LawPrediction {
  double low = 0, median = 0, high = 0;
};

/// Errors: InputError at the place in the file, also for a file with other keys beside law_tests.
std::vector<LawTest> read_law_tests(const std::filesystem::path& file);
/// Whether the file is of law tests and not of observations.
bool holds_law_tests(const std::filesystem::path& file);

/// Errors: InputError for a material that the catalogue does not have, or that has no wear rate of this pair.
LawPrediction predicted(const LawTest& test);

/// A bound: MISS if even the 10 % (or 90 %) is on its wrong side, agrees if the median is on the right one, else open. A
/// measured number: agrees if it lies in 10 .. 90 %, else MISS with the factor to the nearest end.
std::string verdict_of(const LawTest& test, const LawPrediction& prediction);

/// As a Markdown table, and a sentence with the sums.
std::string law_table(const std::vector<LawTest>& tests);

}  // namespace dresslife::pipeline
