// A job with an open routing: made from a robot's name, or from another job without its routing.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/job/job.h"
#include "pipeline/settings/document.h"

namespace dresslife::pipeline {

struct RouteRequest {
  std::string of;           ///< file or name of a job or of a robot (also a URDF)
  std::string dresspack{};  ///< replaces that of the job; default for a robot: spot_welding
  std::string motion{};     ///< replaces that of the job; default for a robot: a motion of its wrist
  /// links with the clamps; empty: the links of the job's routing, or the link moved by axis 3 and the last link
  std::string base_link{}, tool_link{};
  std::vector<std::string> sets{};
};

struct Draft {
  std::string name;                  ///< name of the job or robot, fit for a file name
  Node document;                     ///< document as it was written
  std::vector<Entry> robot_lines{};  ///< the name of the robot and the lines that change it, "robot.links.7.boxes"
  Job job;                           ///< only the links of its routing are valid
  bool exercise = false;             ///< true: the motion is a placeholder for a standard exercise
  /// Line of a job with an estimated shape for the space of the program's tool; absent: its shape is known, or no tool is named.
  std::optional<Entry> tool_space{};
};

/// Returns whether a search keeps this key of a routing ("side"): it replaces all others.
bool is_kept_by_search(std::string_view key);

/// Makes a draft. Errors: InputError for a name that is neither job nor robot; unknown links; more than one dresspack.
Draft draft_of(const RouteRequest& request);

/// Gives the last link of the draft's robot an estimated shape if the program names a tool whose shape is not known, so that a search
/// places no hose through the tool. Errors: InputError when dresslife-sim cannot be started.
void fill_tool_space(Draft& draft);

/// Returns sentences about the estimated shape; empty: there is none.
std::string tool_space_words(const Draft& draft);

/// Returns the draft's document with a routing and the other changes. routing, motion: YAML; motion may be empty. factor: scale
/// of the dresspack's size, 1: unchanged. folder: folder from which the document can be read; absent: any folder. Entries of the
/// shipped catalogue stay names. If a folder is given, files stay references; all other values are written out.
Node routed(const Draft& draft, const std::string& routing, const std::string& motion, double factor,
            const std::optional<std::filesystem::path>& folder = {});

}  // namespace dresslife::pipeline
