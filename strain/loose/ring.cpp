#include "strain/loose/ring.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace dresslife::strain {
namespace {

using Eigen::Vector2d;

constexpr double at_rest = 1e-5;      // [rad]: 0.2 um of a cable 20 mm from the axis
constexpr double longest_turn = 0.2;  // in one step [rad]: 4 mm of such a cable
constexpr int most_iterations = 30;
constexpr int most_tries = 8;
constexpr double least_shift = 1e-4;  // of the largest diagonal, where the matrix is not positive

/// A symmetric matrix with two bands beside the diagonal, (row, 3), as factors in place. Returns how many
/// pivots are negative, which is how many eigenvalues are (Sylvester).
std::size_t factor(std::vector<double>& bands, std::size_t rows) {
  std::size_t negative = 0;
  for (std::size_t i = 0; i < rows; ++i) {
    double* const row = bands.data() + 3 * i;
    negative += row[0] < 0;
    const double one = row[1] / row[0], two = row[2] / row[0];
    if (i + 1 < rows) row[3] -= one * row[1], row[4] -= one * row[2];
    if (i + 2 < rows) row[6] -= two * row[2];
    row[1] = one, row[2] = two;
  }
  return negative;
}

/// table: (row, column) right-hand sides, which become solutions.
void substitute(const std::vector<double>& bands, std::size_t rows, std::size_t columns, double* table) {
  for (std::size_t i = 0; i < rows; ++i)
    for (std::size_t below = 1; below <= 2 && i + below < rows; ++below)
      for (std::size_t c = 0; c < columns; ++c)
        table[(i + below) * columns + c] -= bands[3 * i + below] * table[i * columns + c];
  for (std::size_t i = rows; i-- > 0;) {
    for (std::size_t c = 0; c < columns; ++c) table[i * columns + c] /= bands[3 * i];
    for (std::size_t below = 1; below <= 2 && i + below < rows; ++below)
      for (std::size_t c = 0; c < columns; ++c)
        table[i * columns + c] -= bands[3 * i + below] * table[(i + below) * columns + c];
  }
}

Vector2d across(const Vector2d& vector) { return {-vector.y(), vector.x()}; }

}  // namespace

Ring::Ring(const HoseLine& hose, double rest_curvature)
    : rest_curvature_(rest_curvature),
      psi_(hose.nodes(), 0.0),
      velocity_(psi_),
      frame_(hose.turn),
      bands_(3 * hose.nodes()) {}

void Ring::add(const LooseCable& cable, const HoseLine& hose) {
  lines_.emplace_back(cable, hose, rest_curvature_);
}

/// Every cable to where the turn has it.
void Ring::place(const HoseLine& hose) {
  for (std::size_t i = 1; i + 1 < hose.nodes(); ++i)
    frame_[i] = turned(hose.turn[i], {std::cos(psi_[i]), std::sin(psi_[i])});
  for (CableLine& line : lines_) {
    const Vector2d a0(line.cable().place[0], line.cable().place[1]);
    for (std::size_t i = 1; i + 1 < hose.nodes(); ++i) line.move(i, turned(a0, frame_[i]));
    line.measure(hose);
    line.smooth_slope(hose);
  }
}

/// Slope, matrix and rank-one terms of the turn, to bands_ and table_.
void Ring::assemble(const HoseLine& hose) {
  const std::size_t last = hose.nodes() - 1, columns = lines_.size() + 1;
  const double h = hose.spacing;
  std::fill(bands_.begin(), bands_.end(), 0.0);
  table_.assign((last - 1) * columns, 0.0);
  for (std::size_t k = 0; k < lines_.size(); ++k) {
    const CableLine& line = lines_[k];
    const double bending = line.cable().bending_stiffness / (h * h * h);
    const std::vector<double>& T = line.pull().tension;
    const std::vector<Vector2d>& path = line.path();
    for (std::size_t i = 1; i < last; ++i) {
      const Vector2d way = across(path[i]);
      const bool at_clamp = i == 1 || i + 1 == last;
      const double diagonal = bending * (at_clamp ? 7 : 6) + (T[i - 1] + T[i]) / h + h * line.drag();
      double* const row = bands_.data() + 3 * (i - 1);
      row[0] += diagonal * path[i].squaredNorm() - line.slope()[i].dot(path[i]);
      if (i + 1 < last) row[1] -= (4 * bending + T[i] / h) * path[i].dot(path[i + 1]);
      if (i + 2 < last) row[2] += bending * path[i].dot(path[i + 2]);
      table_[(i - 1) * columns + 1 + k] = line.gained()[i].dot(way);
    }
  }
}

/// Newton's way to the minimum of the quadratic at hand, shifted by as much as makes that positive.
Eigen::VectorXd Ring::newton_turn(const HoseLine& hose, const Eigen::VectorXd& right) {
  const std::size_t rows = hose.nodes() - 2, columns = lines_.size() + 1;
  const auto count = static_cast<Eigen::Index>(lines_.size());
  assemble(hose);
  for (std::size_t i = 0; i < rows; ++i) table_[i * columns] = right[static_cast<Eigen::Index>(i)];
  using Table = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const Eigen::Map<Table> table(table_.data(), static_cast<Eigen::Index>(rows), count + 1);
  const Table unsolved = table;
  const Eigen::MatrixXd gained = table.rightCols(count);
  Eigen::VectorXd root(count);  // of each cable's stiffness against its mean gain
  for (Eigen::Index k = 0; k < count; ++k) root[k] = std::sqrt(lines_[k].pull().stiffness / hose.length);
  double largest = 0;
  for (std::size_t i = 0; i < rows; ++i) largest = std::max(largest, std::abs(bands_[3 * i]));
  const std::vector<double> bands = bands_;
  for (double shift = 0;; shift = shift == 0 ? least_shift * largest : 4 * shift) {
    bands_ = bands;
    for (std::size_t i = 0; i < rows; ++i) bands_[3 * i] += shift;
    std::ranges::copy(unsolved.reshaped<Eigen::RowMajor>(), table_.begin());
    const std::size_t negative = factor(bands_, rows);
    if (negative > lines_.size()) continue;
    substitute(bands_, rows, columns, table_.data());
    const Eigen::MatrixXd soft = gained.transpose() * table.rightCols(count);
    const Eigen::MatrixXd whole = Eigen::MatrixXd::Identity(count, count) +
                                  root.asDiagonal() * (soft + soft.transpose()) / 2 * root.asDiagonal();
    // The whole matrix is positive if as many eigenvalues are negative here as there (Haynsworth).
    const Eigen::VectorXd eigenvalues =
        negative == 0 ? Eigen::VectorXd()
                      : Eigen::VectorXd(whole.selfadjointView<Eigen::Lower>().eigenvalues());
    if (static_cast<std::size_t>((eigenvalues.array() < 0).count()) != negative) continue;
    const Eigen::VectorXd pulled =
        root.cwiseProduct(whole.partialPivLu().solve(root.cwiseProduct(gained.transpose() * table.col(0))));
    return table.col(0) - table.rightCols(count) * pulled;
  }
}

/// A step of Newton's. Returns its largest turn [rad].
double Ring::step(const HoseLine& hose) {
  const Eigen::VectorXd right = -slope();
  const std::size_t rows = hose.nodes() - 2;
  const Eigen::VectorXd turn = newton_turn(hose, right);
  const double most = turn.cwiseAbs().maxCoeff(), down = -turn.dot(right);
  double share = std::min(1.0, longest_turn / most);
  const std::vector<double> from = psi_;
  for (int tries = 0; tries < most_tries; ++tries) {
    for (std::size_t i = 0; i < rows; ++i)
      psi_[i + 1] = from[i + 1] + share * turn[static_cast<Eigen::Index>(i)];
    place(hose);
    const double there = slope().dot(turn);
    if (most < at_rest || there <= -0.5 * down) break;
    share *= std::clamp(-down / (there - down), 0.1, 0.7);
  }
  return most;
}

/// Of the sum of the energies, over the turn of each node inside.
Eigen::VectorXd Ring::slope() const {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(psi_.size() - 2));
  for (const CableLine& line : lines_)
    for (std::size_t i = 1; i + 1 < psi_.size(); ++i)
      sum[static_cast<Eigen::Index>(i - 1)] += line.slope()[i].dot(across(line.path()[i]));
  return sum;
}

bool Ring::advance(const HoseLine& hose, double time, bool goes_on) {
  const std::vector<double> before = psi_;
  for (CableLine& line : lines_) line.begin(hose, hose.turn, time, false);
  for (std::size_t i = 0; goes_on && i < psi_.size(); ++i) psi_[i] += time * velocity_[i];
  frame_ = hose.turn;
  place(hose);
  bool rests = false;
  const int most = goes_on ? most_iterations : 10 * most_iterations;
  for (int k = 0; k < most && !rests; ++k) rests = step(hose) < at_rest;
  for (std::size_t i = 0; goes_on && i < psi_.size(); ++i) velocity_[i] = (psi_[i] - before[i]) / time;
  CableState ignored;
  for (CableLine& line : lines_) line.end(hose, hose.turn, 0, ignored);
  return rests;
}

}  // namespace dresslife::strain
