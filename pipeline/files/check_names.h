// Names of the checks of motions in motion.h5 (/check/name), shared by the code that writes them and the code that reads them.
#pragma once

#include <array>
#include <string_view>

namespace dresslife::pipeline::check_name {

inline constexpr char bend_radius[] = "smallest bend radius";
inline constexpr char bend_radius_at_rest[] = "smallest bend radius at rest";  // by `dresslife check`
inline constexpr char twist[] = "largest twist";
inline constexpr char net_twist[] = "largest net twist";
inline constexpr char twist_left[] = "net twist left by a repeat";
inline constexpr char tension[] = "largest tension";
inline constexpr char contact_depth[] = "deepest contact";
inline constexpr char contact_force[] = "largest contact force";
inline constexpr char too_short[] = "least slack, length too short";
inline constexpr char too_long[] = "least slack, length too long";
inline constexpr char most_slack[] = "most slack";
inline constexpr char travel[] = "travel of the retraction unit";

inline constexpr std::array<std::string_view, 11> all{bend_radius, twist,         net_twist,     twist_left,
                                                      tension,     contact_depth, contact_force, too_short,
                                                      too_long,    most_slack,    travel};

}  // namespace dresslife::pipeline::check_name
