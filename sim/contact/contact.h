// Contact of the hose with obstacles and with itself: Coulomb friction with the effective mass of the whole chain.
//
// With J the contact directions and A the step matrix (S3), the impulses p solve
// (S10) w = J (v + dv) - v_obstacle - b/h + (J A^-1 J^T) p,   0 <= p_n  perp  w_n >= 0,
//       |p_t| <= mu p_n, and where the hose slides p_t = -mu p_n w_t/|w_t|
// by projected Gauss-Seidel, so a touching segment has the mass and stiffness of its neighbours. A row of J
// has one block, or two blocks of opposite sign if two segments touch: one gains what the other loses. In a
// guide ring two neighbours share the ring's force.
#pragma once

#include <vector>

#include "sim/rod/rod.h"

namespace dresslife::sim {

inline constexpr int no_link = -2;  ///< no link of the robot
/// Obstacles that are not links of the robot.
inline constexpr int floor_obstacle = -1, hose_obstacle = -3, cell_obstacle = -4;
/// Guide ring k has the number first_ring - k.
inline constexpr int first_ring = -5;

struct Contact {
  int segment = 0;
  int other = -1;                               ///< second segment of the contact; -1: none; see also `share`
  int obstacle = 0;                             ///< robot link, or one of the above
  Vector3 point = Vector3::Zero();              ///< world [m]
  Vector3 normal = Vector3::UnitZ();            ///< unit, from the obstacle (the other segment) to the segment
  double depth = 0;                             ///< > 0: overlap, < 0: gap [m]
  double friction = 0;                          ///< Coulomb's mu
  Vector3 obstacle_velocity = Vector3::Zero();  ///< of the obstacle's matter at the point [m/s]
  /// > 0: the touched place lies between the centres of `segment` and `other`, at this share of the way. It moves with
  /// (1 - share) v + w x arm of `segment`, plus share v + w x other_arm of `other`; the arms contain the shares (S15).
  double share = 0;
  Vector3 arm = Vector3::Zero(), other_arm = Vector3::Zero();
  double normal_force = 0;                   ///< mean over the step [N]
  Vector3 friction_force = Vector3::Zero();  ///< on the segment [N]
  double sliding_speed = 0;                  ///< after the step [m/s]
};

/// Returns the velocity of the hose's matter at a contact relative to its contact partner, for these velocity changes.
Vector3 relative_velocity(const RodState& state, std::span<const Twist6> change, const Contact& contact);

class ContactSolver {
 public:
  /// Solves (S10) for the contacts of one step, sets their forces and adds the response to the velocity changes of `solver`.
  /// h: step [s]. Precondition: solver.solve() was called.
  void solve(const RodState& state, double h, RodSolver& solver, std::vector<Contact>& contacts);

 private:
  void set_up(const RodState& state, std::span<const Twist6> change, const std::vector<Contact>& contacts, double h);
  void condense(const RodSolver& solver, const std::vector<Contact>& contacts);
  void start_from_last_step(const std::vector<Contact>& contacts, double h);
  void iterate(const std::vector<Contact>& contacts, double h);
  double press(int row, double h);
  double rub(int row, double limit);
  void change_answer(int row, double change);

  std::vector<Twist6> direction_,
      opposite_;                  // (row): a contact's normal and two tangents in turn; of the other segment
  std::vector<Twists> response_;  // (segment)
  std::vector<Twist6> impulse_;   // (segment)
  std::vector<double> effective_, velocity_, answer_;  // (row, row), (row), (row)
  std::vector<Contact> last_;                          // of the previous step
};

}  // namespace dresslife::sim
