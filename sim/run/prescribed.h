// How a dresspack deforms when that is given instead of simulated, and the motion.h5 of it, so that strain
// and fatigue need no second way.
//
// (D1) The rotation of link i between the centres of segments i - 1 and i is the ordered product of exp(w ds)
//      along the given rates w(s) = (curvature1, curvature2, twist) in the turning frame. For rates that
//      change along the dresspack it is the fourth-order Magnus expansion over 1/8 of a segment at a time.
//      The cable starts at a base clamp at the world's origin, along z.
// (D2) The centre of the next segment lies where the simulated chain has it (S1, S17), further by elongation
//      times the link's length along the link's tangent.
//
// The strain stage measures rotations and gaps of the same links (W1 to W3). So it recovers what is uniform
// along the dresspack to rounding, and what changes along it as it does for a simulated chain (W2).
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "pipeline/base/warnings.h"
#include "pipeline/files/files.h"
#include "pipeline/job/setup.h"
#include "sim/rod/rod.h"

namespace dresslife::sim {

struct PrescribedDeformation {
  /// Of one place at one time.
  struct State {
    Vector3 rate = Vector3::Zero();  ///< curvature1, curvature2 [1/m], twist [rad/m], toward the tool
    double elongation = 0;
  };
  std::vector<double> times;            ///< (sample) from 0, increasing [s]
  std::vector<int> steps;               ///< (sample) line of the program
  std::vector<std::string> step_texts;  ///< (line)
  std::vector<double> positions;        ///< (place) from the base clamp, increasing [m]; one place: all along
  std::vector<State> states;  ///< (sample, place); between places on a line, beyond the ends as there

  State at(std::size_t sample, double position) const;
};

/// Poses of a chain at one sample (D1), (D2). n: segments; length [m].
RodState posed(const PrescribedDeformation& deformation, std::size_t sample, int n, double length);

/// The deformation of a setup whose motion is prescribed: read from its file, or of its rig.
/// Errors: InputError at the line of the file, or the rig, that cannot be.
PrescribedDeformation deformation_of(const pipeline::Setup& setup);

/// E A of the dresspack; of a cable by itself that has none, that of its wires, each by cos^3 of the lay
/// angles on the way to it [N].
double axial_stiffness(const pipeline::Dresspack& dresspack);

/// Writes every dataset of motion.h5. Nothing moves through the air here: energies but the elastic, contacts
/// and time step are 0 or absent. Returns what a person should look at.
std::vector<pipeline::Warning> write_prescribed(const pipeline::Setup& setup, pipeline::FileWriter& file,
                                                const std::function<void(double)>& progress);

}  // namespace dresslife::sim
