// Comparison of the laws of kinks, wear and bending with published tests, which need no robot and no rig.
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

/// A smooth tube bent in one plane, with one of three radii of its axis [m].
struct TubeTest {
  double outer = 0, bore = 0;        ///< diameters [m]
  std::optional<double> kinks_at;    ///< radius at which it kinks
  std::optional<double> oval_at;     ///< radius at which its diameter has changed by oval_share
  std::optional<double> allowed_at;  ///< its maker's least radius, at which it does not kink
  double oval_share = 0.05;
};
void describe(Fields& f, TubeTest& test);

/// A surface that was rubbed with a force over a distance.
struct WearTest {
  std::string material;  ///< name in the catalogue
  Counterface against = Counterface::robot;
  double force = 0, way = 0;   ///< [N], [m]
  std::optional<double> worn;  ///< worn volume [m3]
  std::optional<double>
      worn_more;  ///< volume worn by a rougher counterface than `against` [m3]: the law must predict less
};
void describe(Fields& f, WearTest& test);

/// A single cable that was bent from straight for the first time, in one plane.
struct BendingTest {
  Dresspack
      cable;  ///< as in `dresspack: {cable: ..}` of a job, with the friction that is estimated without a measurement
  double curvature = 0;  ///< [1/m]
  double moment = 0;     ///< [N m]
};
void describe(Fields& f, BendingTest& test);

struct LawTest {
  std::string name, what, source;
  bool sets_constant = false;  ///< the constants of the law come from this test, so it cannot confirm them
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

/// Reads law tests. Errors: InputError at the place in the file, also for a file with keys other than law_tests.
std::vector<LawTest> read_law_tests(const std::filesystem::path& file);
/// Returns whether the file contains law tests and no observations.
bool holds_law_tests(const std::filesystem::path& file);

/// Returns the prediction. Errors: InputError for a material that is not in the catalogue or has no wear rate for this pair.
LawPrediction predicted(const LawTest& test);

/// Returns the verdict. For a bound: MISS if even the 10 % (or 90 %) value is on the wrong side, agrees if the median is on the
/// right side, else open. For a measured number: agrees within 10 .. 90 %, else MISS with the factor to the nearest end.
std::string verdict_of(const LawTest& test, const LawPrediction& prediction);

/// Returns a Markdown table, and a sentence with the totals.
std::string law_table(const std::vector<LawTest>& tests);

}  // namespace dresslife::pipeline
