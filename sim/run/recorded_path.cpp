// RecordedPath of clamp_path.h: reading clamp poses from CSV.
#include <algorithm>

#include "pipeline/base/csv_rows.h"
#include "pipeline/base/plain_file.h"
#include "sim/run/clamp_path.h"

namespace dresslife::sim {
namespace {

using pipeline::CsvCell;
using pipeline::CsvRow;
using pipeline::InputError;
using pipeline::Where;

constexpr int columns = 15;

std::string column_name(int column) {
  constexpr const char* parts[] = {"x", "y", "z", "qw", "qx", "qy", "qz"};
  return column == 0 ? "t" : fmt::format("{} of the {} clamp", parts[(column - 1) % 7], column <= 7 ? "base" : "tool");
}

/// Four decimals of each component give |q| within 1e-4 of 1; a larger error means other numbers.
constexpr double length_tolerance = 1e-3;
/// Dot product of the quaternions of successive rows for a rotation of 120 deg.
constexpr double smallest_dot = 0.5;

class Rows {
 public:
  explicit Rows(const std::filesystem::path& file) : where_{file.string(), 0, 0} {
    pipeline::CsvReader reader(pipeline::read_text(file), file.string());
    for (CsvRow cells = reader.next(); !cells.empty(); cells = reader.next()) {
      where_.line = reader.line();
      add(cells);
    }
    where_.line = reader.line();
    if (times.empty()) throw InputError(where_, "clamp_poses holds no row", "write t and 14 numbers per row");
  }

  std::vector<double> times;
  std::vector<Eigen::Matrix<double, columns - 1, 1>> poses;

 private:
  [[noreturn]] void fail(int column, const std::string& what, const std::string& remedy) const {
    throw InputError({where_.file, where_.line, column}, what, remedy);
  }

  void add(const CsvRow& cells) {
    const bool header = times.empty() && !header_seen_ && std::ranges::none_of(cells, [](const CsvCell& cell) {
                          return pipeline::number_in(cell.text).has_value();
                        });
    if (header) {
      header_seen_ = true;
      return;
    }
    if (cells.size() != columns)
      fail(cells.back().column,
           fmt::format("row has {} cells (must be {}, separated by commas)", cells.size(), columns),
           "write t, then x y z qw qx qy qz of the base clamp and of the tool clamp");
    Eigen::Matrix<double, columns, 1> row;
    for (int k = 0; k < columns; ++k) row[k] = value_of(cells[k], k);
    check_time(row[0], cells[0].column);
    Eigen::Matrix<double, columns - 1, 1> pose = row.tail<columns - 1>();
    for (const int first : {3, 10}) join_quaternion(pose, first, cells[first + 1].column);
    times.push_back(row[0]);
    poses.push_back(pose);
  }

  double value_of(const CsvCell& cell, int column) const {
    const std::optional<double> value = pipeline::number_in(cell.text);
    if (!value || !std::isfinite(*value))
      fail(cell.column, fmt::format("'{}' is not a finite number ({})", cell.text, column_name(column)),
           "write a decimal number");
    return *value;
  }

  void check_time(double time, int column) const {
    if (times.empty() && time != 0)
      fail(column, fmt::format("first time is {} s (must be 0)", time), "subtract it from every row");
    if (!times.empty() && time <= times.back())
      fail(column, fmt::format("time {} s does not follow {} s (must increase)", time, times.back()),
           "sort the rows and drop repeated ones");
  }

  /// Normalises the quaternion at pose[first] and gives it the sign that is nearer to the previous row.
  void join_quaternion(Eigen::Matrix<double, columns - 1, 1>& pose, int first, int column) const {
    auto q = pose.segment<4>(first);
    if (std::abs(q.norm() - 1) > length_tolerance)
      fail(column, fmt::format("quaternion has length {:.6g} (must be 1 within {})", q.norm(), length_tolerance),
           "write a unit quaternion, w first");
    q.normalize();
    if (poses.empty()) return;
    const double dot = q.dot(poses.back().segment<4>(first));
    if (std::abs(dot) < smallest_dot)
      fail(column,
           fmt::format("clamp turns by {:.1f} deg from the row before (more than 120: which way is not clear)",
                       2 * std::acos(std::abs(dot)) * 180 / EIGEN_PI),
           "write rows closer in time");
    if (dot < 0) q = -q;
  }

  Where where_;
  bool header_seen_ = false;
};

Frame frame_of(const Eigen::VectorXd& values, int first) {
  const Eigen::Vector4d q = values.segment<4>(first + 3).normalized();
  return {values.segment<3>(first), Quaternion(q[0], q[1], q[2], q[3])};
}

}  // namespace

RecordedPath::RecordedPath(const std::filesystem::path& file) {
  Rows rows(file);
  Eigen::MatrixXd values(columns - 1, static_cast<long>(rows.poses.size()));
  for (size_t k = 0; k < rows.poses.size(); ++k) values.col(static_cast<long>(k)) = rows.poses[k];
  duration_ = rows.times.back();
  step_texts_ = {"clamp poses of " + file.filename().string()};
  poses_ = std::make_unique<CubicSpline>(std::move(rows.times), std::move(values));
}

Pose RecordedPath::at(double time) const {
  const Eigen::VectorXd values = poses_->at(time);
  Pose pose;
  pose.clamps = {frame_of(values, 0), frame_of(values, 7)};
  return pose;
}

}  // namespace dresslife::sim
