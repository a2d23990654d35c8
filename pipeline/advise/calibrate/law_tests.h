// Published tests of the laws of kinks and wear, which need no robot and no rig, beside what the laws say.
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
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/job/material.h"
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

struct LawTest {
  std::string name, what, source;
  bool sets_constant = false;  ///< the constants of the law come from this test: it cannot confirm them
  std::optional<TubeTest> tube;
  std::optional<WearTest> wear;
  Where where;
};
void describe(Fields& f, LawTest& test);

/// The prediction of a law for a test: percentiles 10, 50, 90 of a radius [m] or a volume [m3].
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
