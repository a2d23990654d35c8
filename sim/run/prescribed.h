// A dresspack with a given deformation instead of a simulated one, and its motion.h5, so that strain
// and fatigue need no special case.
//
// (D1) The rotation of link i between the centres of segments i - 1 and i is the ordered product of exp(w ds)
//      along the given rates w(s) = (curvature1, curvature2, twist) in the rotating frame. For rates that
//      change along the dresspack it is the fourth-order Magnus expansion with steps of 1/8 of a segment.
//      The cable starts at a base clamp at the world's origin, along z.
// (D2) The centre of the next segment is at the place of a simulated chain (S1, S17), displaced by elongation
//      times the link's length along the link's tangent.
//
// The strain stage measures rotations and gaps of the same links (W1 to W3). So it recovers a uniform deformation
// exactly up to rounding, and a variable one with the same error as for a simulated chain (W2).
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
  /// Deformation at one place and time.
  struct State {
    Vector3 rate = Vector3::Zero();  ///< curvature1, curvature2 [1/m], twist [rad/m], toward the tool
    double elongation = 0;
  };
  std::vector<double> times;            ///< (sample) from 0, increasing [s]
  std::vector<int> steps;               ///< (sample) line of the program
  std::vector<std::string> step_texts;  ///< (line)
  std::vector<double> positions;        ///< (place) from the base clamp, increasing [m]; one place: the whole length
  std::vector<State> states;            ///< (sample, place); linear between places, constant beyond the outermost ones

  State at(std::size_t sample, double position) const;
};

/// Returns the poses of a chain at one sample (D1), (D2). n: segments; length [m].
RodState posed(const PrescribedDeformation& deformation, std::size_t sample, int n, double length);

/// Returns the deformation of a setup with prescribed motion: from its file or from its rig.
/// Errors: InputError at the line of the file, or at a rig that is not possible.
PrescribedDeformation deformation_of(const pipeline::Setup& setup);

/// Returns E A of the dresspack; for a single cable without it the sum over its wires, each times cos^3 of its lay
/// angles [N].
double axial_stiffness(const pipeline::Dresspack& dresspack);

/// Writes every dataset of motion.h5. There is no dynamics: all energies except the elastic one, contacts
/// and time step are 0 or absent. Returns the warnings.
std::vector<pipeline::Warning> write_prescribed(const pipeline::Setup& setup, pipeline::FileWriter& file,
                                                const std::function<void(double)>& progress);

}  // namespace dresslife::sim
