// Setup: the parts of a job that dresslife-sim needs. A file that includes only this header is not compiled again after a change
// of keys of strain or fatigue.
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

/// One dresspack of the robot with its routing.
struct MountedDresspack {
  std::string name;  ///< empty: the only one, given by the job's own keys `dresspack` and `routing`
  Dresspack dresspack;
  Routing routing;
  Where where;
};

void describe(Fields& f, MountedDresspack& mounted);

struct Setup {
  Robot robot;  ///< without joints if the motion needs no robot
  Motion motion;
  std::vector<MountedDresspack> dresspacks = std::vector<MountedDresspack>(1);  ///< at least one
  Cell cell;
  SimulationSettings simulation;
};

/// Returns the unstretched length between the end clamps of each dresspack [m], (dresspack).
std::vector<double> free_lengths(const Setup& setup);
/// Returns the cell with the links of the robot that do not move.
Cell surroundings(const Setup& setup);
/// Returns the length of a rig's cable from clamp to clamp (rig.h) [m]; 0 without a rig.
double clamped_length(const Setup& setup);

/// name_among returns the name of a dresspack; empty if it is the only one. dresspack_words returns the subject of a sentence:
/// "dresspack 'main hose'" or "dresspack".
std::string name_among(const Setup& setup, std::size_t dresspack);
std::string dresspack_words(const Setup& setup, std::size_t dresspack);

}  // namespace dresslife::pipeline
