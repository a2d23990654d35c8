#include "sim/contact.h"

#include <algorithm>
#include <cmath>

namespace dresslife::sim {
namespace {

// Overlap is pushed out by this share per step, and no faster than push_speed, so that a start inside an
// obstacle does not fling the hose away.
constexpr double overlap_share = 0.2, push_speed = 1.0;  // [1], [m/s]
// Softness of the normal direction [m/(N s) s]: 1e-7 m/N lets two contacts at one point share their load.
constexpr double softness = 1e-7;
constexpr int sweeps = 100;
constexpr double smallest_change =
    1e-9;  // of an impulse [N s]; a 2.5 kg/m hose of 0.1 m loads 5 ms with 1e-2 N s

double dot(const Twist6& a, const Twist6& b) {
  double sum = 0;
  for (int k = 0; k < 6; ++k) sum += a.value[k] * b.value[k];
  return sum;
}

// Row of J: velocity of the segment's matter at the contact along an axis.
Twist6 direction_at(const Vector3& arm, const Vector3& axis) {
  const Vector3 turn = arm.cross(axis);
  return {{axis.x(), axis.y(), axis.z(), turn.x(), turn.y(), turn.z()}};
}

// Unit tangents that make a right-handed triad with the normal.
std::pair<Vector3, Vector3> tangents(const Vector3& normal) {
  const Vector3 first = normal.unitOrthogonal();
  return {first, normal.cross(first)};
}

}  // namespace

// (J A^-1 J^T), row by row.
void ContactSolver::condense(const RodSolver& solver, const std::vector<Contact>& contacts) {
  const int rows = static_cast<int>(direction_.size());
  effective_.resize(static_cast<size_t>(rows) * rows);
  response_.resize(solver.velocity_change().size());
  int first = contacts.front().segment;
  for (const Contact& contact : contacts) first = std::min(first, contact.segment);
  for (int row = 0; row < rows; ++row) {
    solver.unit_response(contacts[row / 3].segment, direction_[row].value, first, response_);
    for (int other = 0; other < rows; ++other)
      effective_[static_cast<size_t>(other) * rows + row] =
          dot(direction_[other], response_[contacts[other / 3].segment]);
  }
}

// Projected Gauss-Seidel on (S10). velocity_ holds w for the present answer; a changed impulse changes it by
// a column of the (symmetric) condensed matrix, and idle contacts cost nothing.
void ContactSolver::iterate(double friction, double h) {
  const int rows = static_cast<int>(direction_.size());
  const auto change_answer = [&](int row, double change) {
    const double* column = &effective_[static_cast<size_t>(row) * rows];
    for (int k = 0; k < rows; ++k) velocity_[k] += change * column[k];
  };
  for (int row = 0; row < rows; ++row)
    if (answer_[row] != 0) change_answer(row, answer_[row]);
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    double largest = 0;
    for (int row = 0; row < rows; ++row) {
      const bool normal = row % 3 == 0;
      const double soft = normal ? softness / h : 0,
                   mass = effective_[static_cast<size_t>(row) * rows + row] + soft;
      const double wanted = answer_[row] - (velocity_[row] + soft * answer_[row]) / mass;
      const double limit = normal ? 0 : friction * answer_[row - row % 3];
      const double next = normal ? std::max(0.0, wanted) : std::clamp(wanted, -limit, limit);
      const double change = next - answer_[row];
      if (change == 0) continue;
      answer_[row] = next;
      change_answer(row, change);
      largest = std::max(largest, std::abs(change));
    }
    if (largest < smallest_change) break;
  }
}

// The impulses of the step before, where the same segment touched the same obstacle, are a good first answer.
// Both lists are in order of segment.
void ContactSolver::start_from_last_step(const std::vector<Contact>& contacts, double h) {
  size_t k = 0;
  for (size_t c = 0; c < contacts.size(); ++c) {
    while (k < last_.size() && last_[k].segment < contacts[c].segment) ++k;
    size_t match = k;
    while (match < last_.size() && last_[match].segment == contacts[c].segment &&
           last_[match].obstacle != contacts[c].obstacle)
      ++match;
    if (match >= last_.size() || last_[match].segment != contacts[c].segment) continue;
    const auto [first, second] = tangents(contacts[c].normal);
    answer_[3 * c] = h * last_[match].normal_force;
    answer_[3 * c + 1] = h * last_[match].friction_force.dot(first);
    answer_[3 * c + 2] = h * last_[match].friction_force.dot(second);
    if (match == k) ++k;
  }
}

void ContactSolver::solve(const RodState& state, double friction, double h, RodSolver& solver,
                          std::vector<Contact>& contacts) {
  if (contacts.empty()) {
    last_.clear();
    return;
  }
  const std::span<const Twist6> change = solver.velocity_change();
  const int rows = 3 * static_cast<int>(contacts.size());
  direction_.resize(rows), velocity_.resize(rows), answer_.assign(rows, 0.0);
  for (size_t k = 0; k < contacts.size(); ++k) {
    const Contact& c = contacts[k];
    const auto [first, second] = tangents(c.normal);
    const Vector3 arm = c.point - state.position[c.segment];
    const Vector3 spin = state.angular_velocity[c.segment] + change[c.segment].angular();
    const Vector3 velocity =
        state.velocity[c.segment] + change[c.segment].linear() + spin.cross(arm) - c.obstacle_velocity;
    const Vector3 axes[3] = {c.normal, first, second};
    for (int q = 0; q < 3; ++q) {
      direction_[3 * k + q] = direction_at(arm, axes[q]);
      velocity_[3 * k + q] = velocity.dot(axes[q]);
    }
    velocity_[3 * k] -= c.depth > 0 ? std::min(overlap_share * c.depth / h, push_speed) : c.depth / h;
  }
  start_from_last_step(contacts, h);
  condense(solver, contacts);
  iterate(friction, h);
  impulse_.assign(change.size(), Twist6{});
  for (int row = 0; row < rows; ++row)
    for (int k = 0; k < 6; ++k)
      impulse_[contacts[row / 3].segment].value[k] += direction_[row].value[k] * answer_[row];
  solver.apply_impulses(impulse_);
  for (size_t k = 0; k < contacts.size(); ++k) {
    Contact& c = contacts[k];
    const auto [first, second] = tangents(c.normal);
    c.normal_force = answer_[3 * k] / h;
    c.friction_force = (answer_[3 * k + 1] * first + answer_[3 * k + 2] * second) / h;
    const Vector3 spin = state.angular_velocity[c.segment] + change[c.segment].angular();
    const Vector3 velocity = state.velocity[c.segment] + change[c.segment].linear() +
                             spin.cross(c.point - state.position[c.segment]) - c.obstacle_velocity;
    c.sliding_speed = (velocity - velocity.dot(c.normal) * c.normal).norm();
  }
  last_ = contacts;
}

}  // namespace dresslife::sim
