// Recorded joint angles: comma separated columns, and ROS trajectory_msgs/JointTrajectory as YAML or JSON.
//
// Columns: one line of names, then numbers; the separator is a comma, a semicolon or a tab. Lines that begin
// with # are comments. A column named time, t, stamp or similar contains times [s, or the unit in its name: ms,
// us, ns, min, h]. Velocities, efforts, grippers, counters and similar columns are skipped and listed. Every other
// column is one axis.
//   unit   from the names (joint_1_rad, a1 [deg]). Without a unit: degrees if a number exceeds the range of any
//          axis in rad, else a question: --value unit=deg or unit=rad.
//   order  by the numbers in the names (joint_6 ... joint_1), else by the axis names of a known arm (Universal
//          Robots, Motoman's S L U R B T), else a question: --value joints=NAME,NAME,...
// Columns of points (x, y, z, ...) are not axes.
//
// ROS: joint_names and points with positions [rad] and time_from_start, at any level of keys and lists.
// The order of the axes follows the same rules. Several trajectories in a file are a question:
// --value trajectory=2.
//
// A row with a time is a move that ends at this time and continues into the next move without a stop.
#pragma once

#include "sim/program/interpreter/program.h"

namespace dresslife::sim {

void read_joint_columns(const SourceFile& file, const ImportOptions& options, Program& program, Problems& problems);
void read_ros_trajectory(const SourceFile& file, const ImportOptions& options, Program& program, Problems& problems);

}  // namespace dresslife::sim
