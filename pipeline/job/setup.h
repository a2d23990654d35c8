// What moves and how: all of a job that dresslife-sim needs. A file that includes only this header is not compiled
// again after a change of the keys of strain or fatigue.
#pragma once

#include <string>
#include <vector>

#include "pipeline/job/dresspack.h"
#include "pipeline/job/motion.h"
#include "pipeline/job/robot.h"
#include "pipeline/job/routing.h"
#include "pipeline/job/shapes.h"
#include "pipeline/job/simulation.h"
#include "pipeline/settings/document.h"

namespace dresslife::pipeline {

/// One of the robot's dresspacks as it is clamped.
struct MountedDresspack {
  std::string name;  ///< empty: the only one, given by the job's own keys `dresspack` and `routing`
  Dresspack dresspack;
  Routing routing;
  Where where;
};

void describe(Fields& f, MountedDresspack& mounted);

struct Setup {
  Robot robot;  ///< no joints where the motion needs none
  Motion motion;
  std::vector<MountedDresspack> dresspacks = std::vector<MountedDresspack>(1);  ///< at least one
  Cell cell;
  SimulationSettings simulation;
};

/// (dresspack) what lies between its clamps, unstretched [m].
std::vector<double> free_lengths(const Setup& setup);
/// Of a rig's cable from clamp to clamp (rig.h) [m]; 0: no rig.
double clamped_length(const Setup& setup);

/// The words for one of several dresspacks: its name, or nothing where it is the only one; and the same as the
/// subject of a sentence: "dresspack 'main hose'", "dresspack".
std::string name_among(const Setup& setup, std::size_t dresspack);
std::string dresspack_words(const Setup& setup, std::size_t dresspack);

}  // namespace dresslife::pipeline
