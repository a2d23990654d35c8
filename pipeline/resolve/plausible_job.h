// Detects implausible numbers of a job outside of its dresspack (pipeline/cable/plausible.h) that a wrong unit explains. The
// ranges of the keys accept them, and all results would be wrong without a message.
#pragma once

#include <optional>
#include <string>

#include "pipeline/job/job.h"

namespace dresslife::pipeline {

/// A longer routing.free_length_m is in another unit [m]: the size of a cell; hoses on robots are 0.5 to 6 m long.
constexpr double longest_hose = 20;

/// Checks of keys that decide the motion (JobPart::sim): gravity that is not downward or not that of the earth; a sample rate that
/// misses the swing; limits, speeds and accelerations of the robot's axes in another unit or order; clamps in the air; and the
/// steps of a motion without a program. Motion::left_out contains these warnings.
std::vector<Warning> plausibility_of_motion(const Job& job);

/// Checks of other settings: those of strain and fatigue in another unit, angles of the dresspack in radians, a strain gate that
/// drops cycles which break wires, doubts of the calibration, and makers' ratings without an effect. dresslife-fatigue makes these checks, because it runs again if a key of any stage changes.
std::vector<Warning> plausibility_of_lives(const Job& job);

/// Returns the distance from a point in the frame of a link to its capsules and boxes, on the last link also to the flange [m];
/// std::nullopt: the link has meshes or no shapes.
std::optional<double> distance_to(const Robot& robot, const std::string& name, const Eigen::Vector3d& point);

/// Returns how far a clamp may be from its link's shapes without a doubt [m]: a bracket, which ends at the dresspack's surface.
double usual_distance(const Routing& routing, const Dresspack& dresspack);

/// Returns, if both clamps are on one link, the one that is probably on another: on the last link the base clamp, otherwise the
/// tool clamp. Null: they are on two links.
const Clamp* clamp_on_wrong_link(const Routing& routing, const Robot& robot);

/// Returns the link on which a clamp_on_wrong_link() probably is. Tool clamp: the last one. Base clamp: the one to whose surface its
/// coordinates are nearest; links that contain the point do not count.
std::string probable_link(const Clamp& clamp, const Robot& robot);

/// Returns whether the base clamp is on a link beyond that of the tool clamp, counted from the robot's base. plausibility_of_motion()
/// warns of it. Other limits of such a job say nothing.
bool clamps_exchanged(const Routing& routing, const Robot& robot);

/// Gives each warning whose place is the path of a key, "motion.tools.1", the place of that key in the document. A warning without a
/// place gets that of the first key in its problem.
std::vector<Warning> located(std::vector<Warning> warnings, const Node& document);

/// Returns construction_warnings_at() (pipeline/cable/excess.h) of all dresspacks. Errors: InputError if parts lie in each other.
std::vector<Warning> warnings_of_descriptions(const Job& job);

/// Checks for: a motion in which no axis moves; joint angles that are all radians; single targets in radians or in metres; times
/// in milliseconds; speeds that are shares or in another unit; dwells in milliseconds. Returns one warning per kind, at its first
/// step, with the number of further ones.
std::vector<Warning> plausibility_of_steps(const Motion& motion);

}  // namespace dresslife::pipeline
