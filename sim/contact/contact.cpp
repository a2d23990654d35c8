#include "sim/contact/contact.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace dresslife::sim {
namespace {

// Overlap is reduced by this share per step, at most with push_speed, so that a start inside an obstacle does not throw the hose
// away.
constexpr double overlap_share = 0.2, push_speed = 1.0;  // [1], [m/s]
// Softness of the normal direction [m/(N s) s]: with 1e-7 m/N two contacts at one point share their load.
constexpr double softness = 1e-7;
constexpr int sweeps = 100;
constexpr double smallest_change =
    1e-9;  // of an impulse [N s]; the weight of a 0.1 m hose of 2.5 kg/m gives 1e-2 N s in 5 ms

void add_dot(Twists::Row& to, const Twist6& a, const Twists& b) {
  Twists::Row sum{};
  for (int k = 0; k < 6; ++k) sum += a.value[k] * b.value[k];
  to += sum;
}

void add(Twist6& sum, double factor, const Twist6& x) {
  for (int k = 0; k < 6; ++k) sum.value[k] += factor * x.value[k];
}

// Returns a row of J: velocity of a segment's matter at the contact along an axis. weight: of the linear part.
Twist6 direction_at(const Vector3& arm, const Vector3& axis, double weight = 1) {
  const Vector3 turn = arm.cross(axis);
  return {{weight * axis.x(), weight * axis.y(), weight * axis.z(), turn.x(), turn.y(), turn.z()}};
}

// Returns two unit tangents that form a right-handed triad with the normal.
std::pair<Vector3, Vector3> tangents(const Vector3& normal) {
  const Vector3 first = normal.unitOrthogonal();
  return {first, normal.cross(first)};
}

auto place_of(const Contact& contact) { return std::tuple(contact.segment, contact.other, contact.obstacle); }

}  // namespace

Vector3 relative_velocity(const RodState& state, std::span<const Twist6> change, const Contact& contact) {
  const auto matter = [&](int i) {
    const Vector3 spin = state.angular_velocity[i] + change[i].angular();
    return Vector3(state.velocity[i] + change[i].linear() + spin.cross(contact.point - state.position[i]));
  };
  if (contact.share > 0) {
    const int i = contact.segment, j = contact.other;
    return (1 - contact.share) * (state.velocity[i] + change[i].linear()) +
           (state.angular_velocity[i] + change[i].angular()).cross(contact.arm) +
           contact.share * (state.velocity[j] + change[j].linear()) +
           (state.angular_velocity[j] + change[j].angular()).cross(contact.other_arm) - contact.obstacle_velocity;
  }
  const Vector3 velocity = matter(contact.segment) - contact.obstacle_velocity;
  return contact.other < 0 ? velocity : Vector3(velocity - matter(contact.other));
}

void ContactSolver::set_up(const RodState& state, std::span<const Twist6> change, const std::vector<Contact>& contacts,
                           double h) {
  const size_t rows = 3 * contacts.size();
  direction_.resize(rows), opposite_.assign(rows, Twist6{}), velocity_.resize(rows), answer_.assign(rows, 0.0);
  for (size_t k = 0; k < contacts.size(); ++k) {
    const Contact& c = contacts[k];
    const auto [first, second] = tangents(c.normal);
    const Vector3 velocity = relative_velocity(state, change, c);
    const Vector3 axes[3] = {c.normal, first, second};
    for (int q = 0; q < 3; ++q) {
      velocity_[3 * k + q] = velocity.dot(axes[q]);
      if (c.share > 0) {
        direction_[3 * k + q] = direction_at(c.arm, axes[q], 1 - c.share);
        opposite_[3 * k + q] = direction_at(c.other_arm, axes[q], c.share);
        continue;
      }
      direction_[3 * k + q] = direction_at(c.point - state.position[c.segment], axes[q]);
      if (c.other >= 0) opposite_[3 * k + q] = direction_at(c.point - state.position[c.other], -axes[q]);
    }
    velocity_[3 * k] -= c.depth > 0 ? std::min(overlap_share * c.depth / h, push_speed) : c.depth / h;
  }
}

// Computes (J A^-1 J^T), row by row.
void ContactSolver::condense(const RodSolver& solver, const std::vector<Contact>& contacts) {
  const int rows = static_cast<int>(direction_.size());
  effective_.resize(static_cast<size_t>(rows) * rows);
  response_.resize(solver.velocity_change().size());
  const auto foremost = [&](const Contact& c) { return c.other < 0 ? c.segment : std::min(c.segment, c.other); };
  int first = foremost(contacts.front());
  for (const Contact& c : contacts) first = std::min(first, foremost(c));
  for (int begin = 0; begin < rows; begin += Twists::count) {
    const int count = std::min(Twists::count, rows - begin);
    int begins = foremost(contacts[begin / 3]);
    std::fill(response_.begin() + first, response_.end(), Twists{});
    for (int r = 0; r < count; ++r) {
      const Contact& c = contacts[(begin + r) / 3];
      begins = std::min(begins, foremost(c));
      for (int q = 0; q < 6; ++q) {
        response_[c.segment].value[q][r] = direction_[begin + r].value[q];
        if (c.other >= 0) response_[c.other].value[q][r] = opposite_[begin + r].value[q];
      }
    }
    solver.respond(begins, first, response_);
    for (int k = 0; k < rows; ++k) {
      const Contact& at = contacts[k / 3];
      Twists::Row change{};
      add_dot(change, direction_[k], response_[at.segment]);
      if (at.other >= 0) add_dot(change, opposite_[k], response_[at.other]);
      for (int r = 0; r < count; ++r) effective_[static_cast<size_t>(k) * rows + begin + r] = change[r];
    }
  }
}

// velocity_ contains w for the present answer. A change of an impulse changes w by a column of the (symmetric)
// condensed matrix, so idle contacts cost nothing.
void ContactSolver::change_answer(int row, double change) {
  const int rows = static_cast<int>(direction_.size());
  const double* column = &effective_[static_cast<size_t>(row) * rows];
  answer_[row] += change;
  for (int k = 0; k < rows; ++k) velocity_[k] += change * column[k];
}

double ContactSolver::press(int row, double h) {
  const double soft = softness / h, mass = effective_[static_cast<size_t>(row) * direction_.size() + row] + soft;
  const double next = std::max(0.0, answer_[row] - (velocity_[row] + soft * answer_[row]) / mass);
  const double change = next - answer_[row];
  if (change != 0) change_answer(row, change);
  return std::abs(change);
}

namespace {
// Impulses and velocities are far from overflow, and std::hypot takes five times as long.
double length_of(double x, double y) { return std::sqrt(x * x + y * y); }
}  // namespace

// Updates both tangents, at `row` and row + 1. If friction suffices, the impulse is p - B^-1 w, which stops the sliding.
// Otherwise it is p - w/b, b the largest eigenvalue of the 2x2 matrix B, scaled back to the circle of the limit. This iteration
// is stationary only if p and w are opposite.
double ContactSolver::rub(int row, double limit) {
  const size_t rows = direction_.size();
  double* p = &answer_[row];
  const double* w = &velocity_[row];
  if (limit == 0 && p[0] == 0 && p[1] == 0) return 0;
  const double a = effective_[row * rows + row], b = effective_[row * rows + row + 1],
               d = effective_[(row + 1) * rows + row + 1], determinant = a * d - b * b;
  double next[2] = {p[0] - (d * w[0] - b * w[1]) / determinant, p[1] - (a * w[1] - b * w[0]) / determinant};
  if (!(length_of(next[0], next[1]) <= limit)) {
    const double largest = (a + d) / 2 + length_of((a - d) / 2, b);
    for (int k = 0; k < 2; ++k) next[k] = p[k] - w[k] / largest;
    const double length = length_of(next[0], next[1]), share = length > limit ? limit / length : 1;
    for (double& part : next) part *= share;
  }
  const double change[2] = {next[0] - p[0], next[1] - p[1]};
  for (int k = 0; k < 2; ++k)
    if (change[k] != 0) change_answer(row + k, change[k]);
  return length_of(change[0], change[1]);
}

void ContactSolver::iterate(const std::vector<Contact>& contacts, double h) {
  const int rows = static_cast<int>(direction_.size());
  for (int row = 0; row < rows; ++row) {
    const double start = answer_[row];
    if (start != 0) answer_[row] = 0, change_answer(row, start);
  }
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    double largest = 0;
    for (int row = 0; row < rows; row += 3) {
      largest = std::max(largest, press(row, h));
      largest = std::max(largest, rub(row + 1, contacts[row / 3].friction * answer_[row]));
    }
    if (largest < smallest_change) break;
  }
}

// Starts from the impulses of the previous step where the same segment touched the same obstacle. Both lists are in order of
// place_of().
void ContactSolver::start_from_last_step(const std::vector<Contact>& contacts, double h) {
  size_t k = 0;
  for (size_t c = 0; c < contacts.size(); ++c) {
    while (k < last_.size() && place_of(last_[k]) < place_of(contacts[c])) ++k;
    if (k == last_.size() || place_of(last_[k]) != place_of(contacts[c])) continue;
    const auto [first, second] = tangents(contacts[c].normal);
    answer_[3 * c] = h * last_[k].normal_force;
    answer_[3 * c + 1] = h * last_[k].friction_force.dot(first);
    answer_[3 * c + 2] = h * last_[k].friction_force.dot(second);
    ++k;
  }
}

void ContactSolver::solve(const RodState& state, double h, RodSolver& solver, std::vector<Contact>& contacts) {
  if (contacts.empty()) {
    last_.clear();
    return;
  }
  std::stable_sort(contacts.begin(), contacts.end(),
                   [](const Contact& a, const Contact& b) { return place_of(a) < place_of(b); });
  const std::span<const Twist6> change = solver.velocity_change();
  set_up(state, change, contacts, h);
  start_from_last_step(contacts, h);
  condense(solver, contacts);
  iterate(contacts, h);
  impulse_.assign(change.size(), Twist6{});
  for (size_t row = 0; row < direction_.size(); ++row) {
    const Contact& c = contacts[row / 3];
    add(impulse_[c.segment], answer_[row], direction_[row]);
    if (c.other >= 0) add(impulse_[c.other], answer_[row], opposite_[row]);
  }
  solver.apply_impulses(impulse_);
  for (size_t k = 0; k < contacts.size(); ++k) {
    Contact& c = contacts[k];
    const auto [first, second] = tangents(c.normal);
    c.normal_force = answer_[3 * k] / h;
    c.friction_force = (answer_[3 * k + 1] * first + answer_[3 * k + 2] * second) / h;
    const Vector3 velocity = relative_velocity(state, change, c);
    c.sliding_speed = (velocity - velocity.dot(c.normal) * c.normal).norm();
  }
  last_ = contacts;
}

}  // namespace dresslife::sim
