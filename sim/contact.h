// Contact of the hose with obstacles: Coulomb friction on the effective mass of the whole chain.
//
// With J the contact directions and A the step matrix (S3), the impulses p solve
// (S10) w = J (v + dv) - v_obstacle - b/h + (J A^-1 J^T) p,   0 <= p_n  perp  w_n >= 0,   |p_t| <= mu p_n
// by projected Gauss-Seidel, so a touching segment feels the mass and stiffness of its neighbours.
#pragma once

#include <vector>

#include "sim/rod.h"

namespace dresslife::sim {

struct Contact {
  int segment = 0;
  int obstacle = 0;                             ///< robot link; floor_obstacle for the floor
  Vector3 point = Vector3::Zero();              ///< world [m]
  Vector3 normal = Vector3::UnitZ();            ///< unit, from the obstacle to the hose
  double depth = 0;                             ///< > 0: overlap, < 0: still apart [m]
  Vector3 obstacle_velocity = Vector3::Zero();  ///< of the obstacle's matter at the point [m/s]
  double normal_force = 0;                      ///< mean over the step [N]
  Vector3 friction_force = Vector3::Zero();     ///< on the hose [N]
  double sliding_speed = 0;                     ///< after the step [m/s]
};

inline constexpr int floor_obstacle = -1;

class ContactSolver {
 public:
  /// Solves (S10) for the contacts of one step, fills their forces and adds the answer to solver's velocity
  /// changes. friction: Coulomb's mu, h: step [s]. Call after solver.solve().
  void solve(const RodState& state, double friction, double h, RodSolver& solver,
             std::vector<Contact>& contacts);

 private:
  void condense(const RodSolver& solver, const std::vector<Contact>& contacts);
  void start_from_last_step(const std::vector<Contact>& contacts, double h);
  void iterate(double friction, double h);

  std::vector<Twist6> direction_, response_, impulse_;  // (row): contact's normal and two tangents in turn
  std::vector<double> effective_, velocity_, answer_;   // (row, row), (row), (row)
  std::vector<Contact> last_;                           // of the step before
};

}  // namespace dresslife::sim
