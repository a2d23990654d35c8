#include "pipeline/advise/calibrate/measured_bending.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "pipeline/base/csv_rows.h"
#include "pipeline/base/lists.h"

namespace dresslife::pipeline {
namespace {

/// A sum of values of M1: curvature > 0 -> factor.
using Sum = std::map<double, double>;

void add(Sum& sum, double curvature, double factor) {
  if (curvature != 0) sum[std::abs(curvature)] += curvature < 0 ? -factor : factor;
}

/// A point of reversal: curvature and moment.
struct Turn {
  double curvature;
  Sum moment;
};

class Path {
 public:
  Sum next(double curvature) {
    const double way = curvature - last_;
    if (way != 0 && direction_ != 0 && (way > 0) != (direction_ > 0)) turns_.push_back({last_, moment_at(last_)});
    if (way != 0) direction_ = way;
    while (closes(curvature)) turns_.resize(turns_.size() - (turns_.size() > 1 ? 2 : 1));
    last_ = curvature;
    return moment_at(curvature);
  }

 private:
  /// Returns whether the branch has reached the begin of the previous branch; for the first reversal, whether it has reached the
  /// same curvature on the other side.
  bool closes(double curvature) const {
    if (turns_.empty()) return false;
    const double begin = turns_.back().curvature;
    const double whole = turns_.size() > 1 ? turns_[turns_.size() - 2].curvature - begin : -2 * begin;
    return std::abs(curvature - begin) >= std::abs(whole) && (curvature - begin) * whole >= 0;
  }
  Sum moment_at(double curvature) const {
    Sum sum;
    if (turns_.empty()) {
      add(sum, curvature, 1);
      return sum;
    }
    sum = turns_.back().moment;
    add(sum, (curvature - turns_.back().curvature) / 2, 2);
    return sum;
  }

  double last_ = 0, direction_ = 0;
  std::vector<Turn> turns_;
};

/// Returns the number in a cell. Errors: InputError; for a decimal comma it contains the intended number.
double number_of(const CsvReader& table, const CsvCell& cell) {
  const std::optional<double> value = number_in(cell.text);
  if (value && std::isfinite(*value)) return *value;
  std::string with_point = cell.text;
  std::replace(with_point.begin(), with_point.end(), ',', '.');
  throw InputError(table.where(cell), fmt::format("'{}' is not a number", cell.text),
                   number_in(with_point)
                       ? fmt::format("write {} with a point", with_point)
                       : "write curvature and moment as numbers with a decimal point, one pair per line");
}

/// Returns the integral of M1 from 0 to a curvature [N m x 1/m]. Between two values of the table M1 is a power function; before
/// the first value it is the power function of the first two.
double work(const std::vector<double>& curvatures, const std::vector<double>& moments, double curvature) {
  double sum = 0;
  for (std::size_t k = 1; k < curvatures.size(); ++k) {
    const double power = std::log(moments[k] / moments[k - 1]) / std::log(curvatures[k] / curvatures[k - 1]);
    const bool last = curvature <= curvatures[k] || k + 1 == curvatures.size();
    const double end = last ? curvature : curvatures[k];
    const double moment = last ? std::exp(log_moment(curvatures, moments, curvature)) : moments[k];
    const double before = k == 1 ? 0 : curvatures[k - 1] * moments[k - 1];
    sum += (end * moment - before) / (power + 1);
    if (last) break;
  }
  return sum;
}

/// Returns the curvature of a clamped bar's first natural mode, 1 at the clamp. x: distance from the clamp over the length.
double first_form(double x) {
  constexpr double beta = 1.875104, ratio = 0.734096;
  return (std::cosh(beta * x) + std::cos(beta * x) - ratio * (std::sinh(beta * x) + std::sin(beta * x))) / 2;
}

}  // namespace

std::vector<BendingPoint> read_bending(const std::filesystem::path& file) {
  CsvReader table(read_text(file), file.string());
  const CsvRow titles = table.next();
  const auto column = [&](std::string_view title) {
    const auto found =
        std::find_if(titles.begin(), titles.end(), [&](const CsvCell& cell) { return cell.text == title; });
    if (titles.size() != 2 || found == titles.end())
      throw InputError(titles.empty() ? Where{file.string(), 1, 1} : table.where(titles.front()),
                       "is not the header of a bending test", "begin with 'curvature_1_per_m,moment_Nm'");
    return static_cast<std::size_t>(found - titles.begin());
  };
  const std::size_t curvature = column("curvature_1_per_m"), moment = column("moment_Nm");
  std::vector<BendingPoint> points;
  for (CsvRow row = table.next(); !row.empty(); row = table.next()) {
    if (row.size() != 2)
      throw InputError(table.where(row.front()), fmt::format("has {} columns (a bending test has 2)", row.size()),
                       "write curvature and moment, with the separator of the first line between them");
    points.push_back({number_of(table, row[curvature]), number_of(table, row[moment])});
  }
  const bool bent = std::any_of(points.begin(), points.end(),
                                [](const BendingPoint& p) { return p.curvature != 0 && p.moment != 0; });
  if (!bent) throw InputError({file.string()}, "holds no moment of a bent cable", "write a line per measured point");
  // Friction resists motion: the work over a loop is positive, and a first bend has the sign of its curvature.
  const BendingPoint& first =
      *std::find_if(points.begin(), points.end(), [](const BendingPoint& p) { return p.curvature != 0; });
  if (first.curvature * first.moment < 0)
    throw InputError({file.string()}, "the first moment has another sign than its curvature",
                     "turn the sign of one column");
  return points;
}

BendingNumbers bending_numbers(const std::vector<BendingPoint>& points, double noise) {
  // The error of an instrument is a share of its range. A share of each moment would give points near zero most of the weight.
  const double most = largest_of(points, 0.0, [](const BendingPoint& point) { return std::abs(point.moment); });
  BendingNumbers made;
  std::map<double, std::size_t> places;
  Path path;
  for (const BendingPoint& point : points) {
    const Sum sum = path.next(point.curvature);
    MeasuredNumber number{point.moment, noise * most, {}};
    for (const auto& [curvature, factor] : sum) {
      const auto [place, fresh] = places.try_emplace(curvature, made.curvatures.size());
      if (fresh) made.curvatures.push_back(curvature);
      number.parts.push_back({place->second, factor});
    }
    if (!number.parts.empty()) made.numbers.push_back(std::move(number));
  }
  const double share = static_cast<double>(made.numbers.size()) / most_independent_moments;
  if (share > 1)
    for (MeasuredNumber& number : made.numbers) number.deviation *= std::sqrt(share);
  return made;
}

double log_moment(const std::vector<double>& curvatures, const std::vector<double>& moments, double curvature) {
  const auto above = std::upper_bound(curvatures.begin() + 1, curvatures.end() - 1, curvature);
  const auto k = static_cast<std::size_t>(above - curvatures.begin());
  const double part = std::log(curvature / curvatures[k - 1]) / std::log(curvatures[k] / curvatures[k - 1]);
  return std::log(moments[k - 1]) + part * std::log(moments[k] / moments[k - 1]);
}

double log_decrement_by_slip(const std::vector<double>& curvatures, const std::vector<double>& moments,
                             double largest) {
  constexpr int places = 40;
  constexpr double least = 1e-4;
  double lost = 0, stored = 0;
  for (int i = 0; i < places; ++i) {
    const double curvature = largest * first_form((i + 0.5) / places);
    const double moment = std::exp(log_moment(curvatures, moments, curvature));
    lost += 8 * work(curvatures, moments, curvature) - 4 * curvature * moment;
    stored += curvature * moment;
  }
  return std::log(std::max(least, lost / stored));
}

}  // namespace dresslife::pipeline
