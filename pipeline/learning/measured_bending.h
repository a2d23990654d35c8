// A cable that was bent and its moment measured: what of it a model must say.
//
// A first bend follows M1(curvature), which the strain file of a job tells (/bending). Sliders with constant caps remember
// where bending turned (Masing): from a turning point (k0, M0) on
//     M = M0 + 2 M1((k - k0)/2),                                                              (P4)
// a branch that closes a loop goes on as the one before it. So each measured moment is a sum of values of M1.
#pragma once

#include <filesystem>
#include <vector>

#include "pipeline/job/document.h"
#include "pipeline/statistics/likelihood.h"

namespace dresslife::pipeline {

struct BendingPoint {
  double curvature = 0;  ///< [1/m]
  double moment = 0;     ///< [N m]
};

/// A CSV with a header and two columns, curvature_1_per_m and moment_Nm, in the order in which it was bent, from straight.
/// Errors: InputError at the line.
std::vector<BendingPoint> read_bending(const std::filesystem::path& file);

/// The points as sums of M1 at curvatures > 0 [1/m]. noise: of a moment, as a share of it; a tenth of the largest moment's
/// noise at least, as scales have.
struct BendingNumbers {
  std::vector<double> curvatures;
  std::vector<MeasuredNumber> numbers;
};
BendingNumbers bending_numbers(const std::vector<BendingPoint>& points, double noise);

/// ln M1 at a curvature, between the values of a rising table, straight in logarithms.
double log_moment(const std::vector<double>& curvatures, const std::vector<double>& moments, double curvature);

}  // namespace dresslife::pipeline
