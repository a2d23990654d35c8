// Settings of dresslife-sim.
#pragma once

#include <Eigen/Core>

#include "pipeline/settings/document.h"

namespace dresslife::pipeline {

class Fields;

using Eigen::Vector3d;

struct SimulationSettings {
  int segments = 50;                 ///< of each dresspack
  double time_step = 0.005;          ///< [s]
  bool choose_time_step = false;     ///< time_step_ms: auto; time_step is then where the choice begins
  double curvature_error = 0.5;      ///< that a chosen step may leave [%]
  double sample_rate = 25;           ///< of motion.h5 [Hz]; 1/rate is a multiple of the step
  double stiffness_factor = 1;       ///< of each hose's bending, with its friction
  Vector3d gravity{0, 0, -9.81};     ///< [m/s2]
  bool contact = true;               ///< with the robot's links
  bool self_contact = true;          ///< of dresspacks with themselves and each other
  bool floor = true;                 ///< contact with the plane z = 0 too
  double periodic_tolerance = 1e-3;  ///< a motion is repeated until repeats begin this much alike [m]
  int most_repeats = 8;              ///< of the motion, also when they do not
};

void describe(Fields& f, SimulationSettings& simulation);

/// Errors: InputError where samples are not a whole number of steps apart.
void check_simulation(const SimulationSettings& simulation, const Where& where);

}  // namespace dresslife::pipeline
