// Names the URDF of a robot's entry.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pipeline/base/words.h"
#include "pipeline/settings/document.h"

namespace dresslife::pipeline {

/// Keys of a robot entry for its URDF.
struct UrdfRequest {
  std::filesystem::path urdf;
  std::string tip;                       ///< link at the flange; empty: tool0, else flange, else the only end
  std::filesystem::path package_folder;  ///< contains the packages of package://; empty: searched above the URDF
  enum class Collision { keep, drop } collision = Collision::keep;
  std::vector<double> accelerations;  ///< of the axes, in their order [rad/s2]
  Where accelerations_where;
};
constexpr std::string_view word(UrdfRequest::Collision value) { return word_at({"keep", "drop"}, value); }

/// Accelerations in config/robots, the smallest and the largest, for robots whose URDF has none.
inline constexpr const char* shipped_accelerations = "260 to 9,400 deg/s2, the wrist more than the arm";

class Fields;
void describe(Fields& f, UrdfRequest& request);

/// Returns the robot of a URDF as the tree of a catalogue entry (pipeline/urdf/urdf.h). A program links one of two definitions:
/// that of dresslife_urdf reads the file, that of dresslife_without_urdf refuses it. Stages that need no robot link the second
/// one and no parser. Errors: InputError.
Node robot_from_urdf(const UrdfRequest& request);

}  // namespace dresslife::pipeline
