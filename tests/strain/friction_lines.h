// An independent reference for friction inside cables: one wire as a line that slides against its bed. It uses no formula of
// (W16), (W17) and (W29). It only assumes that a wire is elastic and that friction per length is limited.
#pragma once

#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

namespace friction_lines {

/// A wire of equal cells whose ends do not slide. The displacement u of the nodes against the bed adds u' to the strain of
/// the glued wire. At a node the force changes by at most the limit. Below the limit the node sticks. At the limit it
/// slides in the direction in which the change of force pulls it.
class SlidingWire {
 public:
  /// limit: of the change of the force per length, divided by E A [1/m].
  SlidingWire(std::size_t cells, double cell, double limit)
      : cell_(cell),
        limit_(limit * cell),
        u_(cells + 1, 0.0),
        sliding_(cells + 1, 0),
        strain_(cells, 0.0),
        glued_(strain_) {}

  /// Moves the wire to the next state. glued: strain of each cell. If the set of sliding nodes is not found, the step is halved.
  void move(const std::vector<double>& glued, int halvings = 0) {
    const SlidingWire before = *this;
    if (found(glued)) return;
    if (halvings == 12) throw std::runtime_error("which nodes of a line slide was not found");
    *this = before;
    std::vector<double> half = glued;
    for (std::size_t i = 0; i < half.size(); ++i) half[i] = (glued[i] + glued_[i]) / 2;
    move(half, halvings + 1);
    move(glued, halvings + 1);
  }
  const std::vector<double>& strain() const { return strain_; }

 private:
  /// Block principal pivoting (J. J. Judice and F. M. Pires, Computers Ops Res. 21 (1994)): all nodes in a wrong state change
  /// their state. If ten such rounds do not reduce their number, only the last one changes until the number falls.
  bool found(const std::vector<double>& glued) {
    constexpr int most_rounds = 300, patience = 10;
    const std::vector<double> before = u_;
    std::size_t fewest = u_.size() + 1;
    int left = patience;
    for (int round = 0; round < most_rounds; ++round) {
      solve(glued, before);
      const auto wrong = wrong_nodes(before);
      if (wrong.empty()) {
        glued_ = glued;
        return true;
      }
      if (wrong.size() < fewest)
        fewest = wrong.size(), left = patience;
      else
        --left;
      if (left >= 0)
        for (const auto& [node, state] : wrong) sliding_[node] = state;
      else
        sliding_[wrong.back().first] = wrong.back().second;
    }
    return false;
  }
  /// Solves the equilibrium in which exactly the marked nodes slide. The matrix is tridiagonal; the method is elimination.
  void solve(const std::vector<double>& glued, const std::vector<double>& before) {
    const std::size_t n = strain_.size();
    std::vector<double> upper(n + 1, 0.0);
    for (std::size_t i = 1; i < n; ++i) {
      u_[i] = before[i];
      if (sliding_[i] == 0) continue;
      const double right = cell_ * (glued[i] - glued[i - 1] - sliding_[i] * limit_);
      const double pivot = 2 - upper[i - 1];
      upper[i] = 1 / pivot;
      u_[i] = (right + u_[i - 1]) / pivot;
    }
    for (std::size_t i = n; i-- > 1;) u_[i] += upper[i] * u_[i + 1];
    for (std::size_t i = 0; i < n; ++i) strain_[i] = glued[i] + (u_[i + 1] - u_[i]) / cell_;
  }
  /// Returns the nodes that stick above the limit or slide with the friction force, with their correct state.
  std::vector<std::pair<std::size_t, int>> wrong_nodes(const std::vector<double>& before) const {
    constexpr double little = 1e-6;  // of the limit
    std::vector<std::pair<std::size_t, int>> wrong;
    for (std::size_t i = 1; i + 1 < u_.size(); ++i) {
      const double pull = strain_[i] - strain_[i - 1];
      if (sliding_[i] == 0 && std::abs(pull) > limit_ * (1 + little))
        wrong.push_back({i, pull > 0 ? 1 : -1});
      else if (sliding_[i] * (u_[i] - before[i]) < -little * limit_ * cell_)
        wrong.push_back({i, 0});
    }
    return wrong;
  }

  double cell_, limit_;
  std::vector<double> u_;
  std::vector<int> sliding_;
  std::vector<double> strain_, glued_;
};

}  // namespace friction_lines
