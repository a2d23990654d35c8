// Bending and decay tests of a cable, predicted from the model's first bend.
//
// A first bend follows M1(curvature), which the strain file of a job contains (/bending). After a reversal
// at (k0, M0) the friction keeps a memory of this point (Masing):
//     M = M0 + 2 M1((k - k0)/2),                                                                      (P6)
// A branch that closes a loop continues the previous branch. So each measured moment is a sum of values of M1.
//
// A cable that is held at one end and swings has curvatures between -k phi and k phi. phi(x) is the curvature of the first
// mode of a clamped bar, 1 at the clamp. In each period the loop of (P6) takes a part of the stored energy:
//     decrement = sum over x of [8 int_0^(k phi) M1 - 4 k phi M1(k phi)] / sum over x of k phi M1(k phi) (P7)
#pragma once

#include <filesystem>
#include <vector>

#include "pipeline/advise/calibrate/likelihood.h"
#include "pipeline/settings/document.h"

namespace dresslife::pipeline {

struct BendingPoint {
  double curvature = 0;  ///< [1/m]
  double moment = 0;     ///< [N m]
};

/// Reads a CSV file with a header and two columns, curvature_1_per_m and moment_Nm, in the order of the test, from straight.
/// Errors: InputError at the line.
std::vector<BendingPoint> read_bending(const std::filesystem::path& file);

/// All readings of a loop share the errors of its scale, its grips and the model's shape, so more readings do not make the result
/// ever more certain. Ten are two or three per branch of a loop.
inline constexpr double most_independent_moments = 10;

/// Returns the points as sums of M1 at curvatures > 0 [1/m]. noise: error of each moment over the largest moment. More points than
/// most_independent_moments together count as so many.
struct BendingNumbers {
  std::vector<double> curvatures;
  std::vector<MeasuredNumber> numbers;
};
BendingNumbers bending_numbers(const std::vector<BendingPoint>& points, double noise);

/// Returns ln M1 at a curvature, by linear interpolation in logarithms of a rising table.
double log_moment(const std::vector<double>& curvatures, const std::vector<double>& moments, double curvature);

/// Returns ln of the part of slip in the logarithmic decrement (P7). curvatures, moments: table of M1, both > 0 and rising.
/// largest: curvature beside the clamp at the end of a swing [1/m]. The result is at least ln 1e-4, which is below that of air.
double log_decrement_by_slip(const std::vector<double>& curvatures, const std::vector<double>& moments, double largest);

}  // namespace dresslife::pipeline
