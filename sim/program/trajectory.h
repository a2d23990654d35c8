// Recorded joint angles: comma separated columns, and ROS trajectory_msgs/JointTrajectory as YAML or JSON.
//
// Columns: one line of names, then numbers; the separator is a comma, a semicolon or a tab. Lines that begin
// with # are comments. A column called time, t, stamp and the like holds times [s, or as its name says: ms,
// us, ns]. Velocities, efforts, grippers, counters and their like are left out, and listed. Every other
// column is one axis.
//   unit   as the names say (joint_1_rad, a1 [deg]); without a word, degrees where a number is larger than
//          any axis turns in rad, else the user is asked: --value unit=deg or unit=rad.
//   order  by the numbers in the names (joint_6 ... joint_1), else of the names of a known arm (Universal
//          Robots, Motoman's S L U R B T), else the user is asked: --value joints=NAME,NAME,...
// Columns of points (x, y, z, ...) are no axes.
//
// ROS: joint_names and points with positions [rad] and time_from_start, within other keys and lists or not.
// The order of the axes follows the same rules. Where a file holds several trajectories, the user is asked:
// --value trajectory=2.
//
// A row with a time is a move that lasts until it, and goes over into the next one without a stop.
#pragma once

#include "sim/program/interpreter/program.h"

namespace dresslife::sim {

void read_joint_columns(const SourceFile& file, const ImportOptions& options, Program& program,
                        Problems& problems);
void read_ros_trajectory(const SourceFile& file, const ImportOptions& options, Program& program,
                         Problems& problems);

}  // namespace dresslife::sim
