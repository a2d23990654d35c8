// Recorded joint angles: comma separated columns, and ROS trajectory_msgs/JointTrajectory as YAML or JSON.
//
// Columns: one line of names, then numbers; the separator is a comma, a semicolon or a tab. A first column
// whose name begins with "t" holds times [s]; the others hold one axis each, in deg, or in rad where a name
// ends in "rad". Lines that begin with # are comments. ROS: joint_names and points with positions [rad] and
// time_from_start, alone or within one enclosing key. A row with a time is a move that lasts until it, and
// goes over into the next one without a stop.
#pragma once

#include "sim/program/program.h"

namespace dresslife::sim {

void read_joint_columns(const SourceFile& file, Program& program, Problems& problems);
void read_ros_trajectory(const SourceFile& file, Program& program, Problems& problems);

}  // namespace dresslife::sim
