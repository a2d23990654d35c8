#include "strain/loose/ring.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "pipeline/base/random.h"

namespace dresslife::strain {
namespace {

using Eigen::Vector2d;

constexpr double at_rest = 1e-5;      // [rad]: 0.2 um of a cable 20 mm from the axis
constexpr double longest_turn = 0.2;  // in one step [rad]: 4 mm of such a cable
// A ring that snaps turns by up to 10 rad, which is 50 of the longest turns. If the iteration stops on the way, cables are bent
// to 50 1/m and pressed with 400 N instead of 5 1/m and 3 N.
constexpr int most_iterations = 300;
constexpr int most_tries = 8;
constexpr double least_shift = 1e-4;  // share of the largest diagonal, added if the matrix is not positive definite

/// Replaces a symmetric matrix with two bands beside the diagonal, (row, 3), by its factors. Returns the number of negative
/// pivots, which is the number of negative eigenvalues (Sylvester).
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

/// Returns the number of negative eigenvalues of a symmetric matrix, which is that of its negative pivots (Sylvester).
std::size_t negative_eigenvalues(const Eigen::MatrixXd& matrix) {
  return static_cast<std::size_t>((matrix.ldlt().vectorD().array() < 0).count());
}

/// Solve L y = r and L^T x = y with the factors L D L^T.
void eliminate(const std::vector<double>& bands, std::size_t rows, Eigen::VectorXd& right) {
  const auto at = [&](std::size_t i) -> double& { return right[static_cast<Eigen::Index>(i)]; };
  for (std::size_t i = 0; i < rows; ++i)
    for (std::size_t below = 1; below <= 2 && i + below < rows; ++below) at(i + below) -= bands[3 * i + below] * at(i);
}
void substitute(const std::vector<double>& bands, std::size_t rows, Eigen::VectorXd& right) {
  const auto at = [&](std::size_t i) -> double& { return right[static_cast<Eigen::Index>(i)]; };
  for (std::size_t i = rows; i-- > 0;)
    for (std::size_t below = 1; below <= 2 && i + below < rows; ++below) at(i) -= bands[3 * i + below] * at(i + below);
}

}  // namespace

std::vector<double> random_winding(std::size_t nodes, double length, double radius, double slack, std::uint64_t seed) {
  constexpr int waves = 4;  // half waves along the hose: shorter ones relax within a second
  pipeline::RandomNumbers random(seed);
  std::vector<double> turn(nodes, 0.0);
  const auto last = static_cast<double>(nodes - 1);
  for (int wave = 1; wave <= waves; ++wave) {
    const double size = random.normal() / wave;
    for (std::size_t i = 1; i + 1 < nodes; ++i) {
      const double x = std::numbers::pi * static_cast<double>(i) / last;
      turn[i] += size * std::sin(wave * x) * std::sin(x);
    }
  }
  double taken = 0;  // mean of (radius psi')^2 / 2
  for (std::size_t i = 1; i < nodes; ++i)
    taken += std::pow(radius * (turn[i] - turn[i - 1]) * last / length, 2) / (2 * last);
  for (double& at : turn) at *= taken > 0 ? std::sqrt(slack / taken) : 0;
  return turn;
}

Ring::Ring(const std::vector<LooseCable>& cables, const HoseLine& hose, double rest_curvature)
    : lines_(cables, hose, rest_curvature, CableLines::Use::turns),
      psi_(hose.nodes(), 0.0),
      velocity_(psi_),
      before_(psi_),
      turned_(psi_),
      frame_(hose.turn),
      bands_(3 * (hose.nodes() - 2)),
      slope_(hose.nodes() - 2) {
  const std::size_t lanes = lines_.batch().lanes;
  gained_.assign(slope_.size(), lanes);
  eliminated_.assign(slope_.size(), lanes);
  scaled_.assign(slope_.size(), lanes);
  products_.assign(lanes, lanes);
  sums_.assign(4 * slope_.size(), most_lanes);
}

void Ring::go_on_from(const Ring& other) {
  psi_ = other.psi_, velocity_ = other.velocity_, frame_ = other.frame_;
  lines_.go_on_from(other.lines_);
}

/// Moves every cable to its place at the turn psi_. with_slope: also computes slope and matrix there.
void Ring::place(const HoseLine& hose, bool with_slope) {
  for (std::size_t i = 1; i + 1 < hose.nodes(); ++i)
    frame_[i] = turned(hose.turn[i], {std::cos(psi_[i]), std::sin(psi_[i])});
  for (std::size_t i = 0; i < psi_.size(); ++i) turned_[i] = psi_[i] - before_[i];
  if (with_slope)
    lines_.turn(frame_, turned_, {slope_.data(), bands_.data(), gained_.data(), sums_.data()});
  else
    lines_.place(frame_);
}

/// Returns Newton's step to the minimum of the local quadratic, with a shift that makes it positive definite. Precondition:
/// place() with the slope.
Eigen::VectorXd Ring::newton_turn() {
  const std::size_t rows = slope_.size(), lanes = lines_.batch().lanes;
  const auto count = static_cast<Eigen::Index>(lines_.count());
  using Table = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const auto by_cable = [&](const LaneRows& of, std::size_t in_all) {
    return Eigen::Map<const Table, 0, Eigen::OuterStride<>>(of.data(), static_cast<Eigen::Index>(in_all), count,
                                                            Eigen::OuterStride<>(static_cast<Eigen::Index>(lanes)));
  };
  const auto scaled = by_cable(scaled_, rows), soft = by_cable(products_, lines_.count());
  Eigen::VectorXd root(count);  // square roots of each cable's stiffness against its mean gain
  for (Eigen::Index k = 0; k < count; ++k) root[k] = std::sqrt(lines_.batch().stiffness[k] / lines_.batch().length);
  double largest = 0;
  for (std::size_t i = 0; i < rows; ++i) largest = std::max(largest, std::abs(bands_[3 * i]));
  for (double shift = 0;; shift = shift == 0 ? least_shift * largest : 4 * shift) {
    factors_ = bands_;
    for (std::size_t i = 0; i < rows; ++i) factors_[3 * i] += shift;
    const std::size_t negative = factor(factors_, rows);
    if (negative > lines_.count()) continue;
    Eigen::VectorXd turn = -Eigen::Map<const Eigen::VectorXd>(slope_.data(), static_cast<Eigen::Index>(rows));
    eliminate(factors_, rows, turn);
    std::copy(gained_.data(), gained_.data() + rows * lanes, eliminated_.data());
    loose_kernels().eliminate_turn(factors_.data(), rows, lines_.batch(), eliminated_.data(), scaled_.data());
    loose_kernels().products(eliminated_.data(), scaled_.data(), rows, lines_.batch(), products_.data());
    const Eigen::MatrixXd whole =
        Eigen::MatrixXd::Identity(count, count) + root.asDiagonal() * (soft + soft.transpose()) / 2 * root.asDiagonal();
    // The whole matrix is positive definite if the numbers of negative eigenvalues of the two are equal (Haynsworth).
    if (negative > 0 && negative_eigenvalues(whole) != negative) continue;
    const Eigen::VectorXd pulled =
        root.cwiseProduct(whole.partialPivLu().solve(root.cwiseProduct(scaled.transpose() * turn)));
    for (std::size_t i = 0; i < rows; ++i) turn[static_cast<Eigen::Index>(i)] /= factors_[3 * i];
    turn -= scaled * pulled;
    substitute(factors_, rows, turn);
    return turn;
  }
}

/// Does one step of Newton's method. Returns its largest turn [rad].
double Ring::step(const HoseLine& hose) {
  const Eigen::VectorXd turn = newton_turn();
  const auto rows = static_cast<Eigen::Index>(slope_.size());
  const Eigen::Map<const Eigen::VectorXd> slope(slope_.data(), rows);
  const double most = turn.cwiseAbs().maxCoeff(), down = slope.dot(turn);
  double share = std::min(1.0, longest_turn / most);
  const std::vector<double> from = psi_;
  for (int tries = 0; tries < most_tries; ++tries) {
    for (Eigen::Index i = 0; i < rows; ++i) psi_[i + 1] = from[i + 1] + share * turn[i];
    place(hose, most >= at_rest);
    if (most < at_rest) break;
    const double there = slope.dot(turn);
    if (there <= -0.5 * down) break;
    share *= std::clamp(-down / (there - down), 0.1, 0.7);
  }
  return most;
}

bool Ring::advance(const HoseLine& hose, double time, bool goes_on) {
  before_ = psi_;
  const std::vector<const CableLines::Frame*> frames(lines_.count(), &hose.turn);
  lines_.begin(hose, frames, time, false, goes_on);
  for (std::size_t i = 0; goes_on && i < psi_.size(); ++i) psi_[i] += time * velocity_[i];
  frame_ = hose.turn;
  place(hose, true);
  bool rests = false;
  for (int k = 0; k < most_iterations && !rests; ++k) rests = step(hose) < at_rest;
  for (std::size_t i = 0; goes_on && i < psi_.size(); ++i) velocity_[i] = (psi_[i] - before_[i]) / time;
  lines_.end(hose, 0, {}, false);
  return rests;
}

}  // namespace dresslife::strain
