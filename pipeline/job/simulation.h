// Settings of dresslife-sim.
#pragma once

#include <Eigen/Core>

#include "pipeline/settings/document.h"

namespace dresslife::pipeline {

class Fields;

using Eigen::Vector3d;

struct SimulationSettings {
  int segments = 50;              ///< per dresspack
  double time_step = 0.005;       ///< [s]
  bool choose_time_step = false;  ///< time_step_ms: auto; then time_step is the first value of the choice
  double curvature_error = 0.5;   ///< allowed error of curvature from a chosen step [%]
  double sample_rate = 25;        ///< of motion.h5 [Hz]; 1/rate is a multiple of the step
  double stiffness_factor = 1;    ///< factor of each hose's bending stiffness, including its friction
  Vector3d gravity{0, 0, -9.81};  ///< [m/s2]
  bool contact = true;            ///< with the robot's links
  bool self_contact = true;       ///< of dresspacks with themselves and with each other
  bool floor = true;              ///< contact with the plane z = 0
  double periodic_tolerance =
      1e-3;              ///< a motion is repeated until the starts of two repeats differ by at most this distance [m]
  int most_repeats = 8;  ///< limit for the number of repeats
};

void describe(Fields& f, SimulationSettings& simulation);

/// Errors: InputError if the time between samples is not a multiple of the time step.
void check_simulation(const SimulationSettings& simulation, const Where& where);

}  // namespace dresslife::pipeline
