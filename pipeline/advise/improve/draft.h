// A job with an open routing: made from a robot's name, or from another job without its routing.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
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
  std::string name;       ///< name of the job or robot, fit for a file name
  Node document;          ///< document as it was written
  Job job;                ///< only the links of its routing are valid
  bool exercise = false;  ///< true: the motion is a placeholder for a standard exercise
};

/// Makes a draft. Errors: InputError for a name that is neither job nor robot; unknown links; more than one dresspack.
Draft draft_of(const RouteRequest& request);

/// Returns the draft's document with a routing and the other changes. routing, motion: YAML; motion may be empty. factor: scale
/// of the dresspack's size, 1: unchanged. folder: folder from which the document can be read; absent: any folder. Entries of the
/// shipped catalogue stay names. If a folder is given, files stay references; all other values are written out.
Node routed(const Draft& draft, const std::string& routing, const std::string& motion, double factor,
            const std::optional<std::filesystem::path>& folder = {});

}  // namespace dresslife::pipeline
