// A small job that contains every kind of entry, for tests that read and write jobs.
#pragma once

#include <string>

namespace dresslife::pipeline {

inline const std::string sample_job = R"(robot:
  name: two axes
  source: made for the tests
  base_rpy_deg: [0, 0, 30]
  joints:
    - {name: axis_1, origin_m: [0, 0, 0.5], axis: [0, 0, 1], lower_deg: -170, upper_deg: 170, speed_deg_per_s: 100,
       acceleration_deg_per_s2: 400}
    - {name: axis_2, origin_m: [0.3, 0, 0], axis: [0, 1, 0], lower_deg: -60.1, upper_deg: 80, speed_deg_per_s: 90,
       acceleration_deg_per_s2: 300}
  links:
    - name: base
    - name: turret
      capsules:
        - {from_m: [0, 0, 0], to_m: [0, 0, 0.4], radius_mm: 120}
    - name: arm
motion:
  name: nod
  zone_deg: 2
  steps:
    - {text: home, joints_deg: [0, 0], zone_deg: 0}
    - repeat: 3
      text: nodding
      steps:
        - {joints_deg: [10.7, -5], speed_percent: 50}
        - {dwell_s: 0.5}
    - {joints_deg: [0.1, 0], speed_deg_per_s: 33.3}
dresspack:
  name: test hose
  source: made for the tests
  diameter_mm: 60
  mass_kg_per_m: 2.5
  bending_stiffness_Nm2: 5
  torsional_stiffness_Nm2: 4
  axial_stiffness_N: 1e5
  damping_time_ms: 10
  damping_source: guessed
  components:
    - name: cable
      count: 3
      radius_mm: 5
      helix_radius_mm: 18.45
      components:
        - {name: wire, count: 6, radius_mm: 0.1, helix_radius_mm: 2.5, lay_angle_deg: 25, hand: left, material: copper}
routing:
  free_length_m: 1.2
  base_clamp: {link: base, position_m: [0, 0, 0.2], direction: [0, 0, 1]}
  tool_clamp: {link: arm, position_m: [0.4, 0, 0], direction: [1, 0, 0], roll_deg: 12}
  mounting_pose_deg: [0, 7]
simulation: {segments: 20, time_step_ms: 5, sample_rate_Hz: 25, contact: false}
strain: {slip: [stick, free], gate: 1e-4, probes: [{segment_from_tool: 2, component: cable 1/wire 1}]}
fatigue: {mean_stress: swt, listed_sites: 3}
)";

}  // namespace dresslife::pipeline
