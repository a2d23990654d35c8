// A job whose routing is still open: from a robot's name, or from another job without its routing.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/job/job.h"
#include "pipeline/settings/document.h"

namespace dresslife::pipeline {

struct RouteRequest {
  std::string of;           ///< a job's file or name, or a robot's (also a URDF)
  std::string dresspack{};  ///< instead of the job's; of a robot spot_welding
  std::string motion{};     ///< instead of the job's; default of a robot: a motion of its wrist
  std::string base_link{}, tool_link{};  ///< that carry the clamps; empty: those of the job's routing; else
                                         ///< the link that axis 3 moves and the last one
  std::vector<std::string> sets{};
};

struct Draft {
  std::string name;       ///< of the job or robot, fit for a file
  Node document;          ///< as it was written
  Job job;                ///< only the links of its routing are valid
  bool exercise = false;  ///< its motion is a placeholder for a standard exercise
};

/// Errors: InputError: neither job nor robot; unknown links; more than one dresspack.
Draft draft_of(const RouteRequest& request);

/// The draft with a routing, and what else is given. routing, motion: YAML; motion may be empty. factor: of the
/// dresspack's size, 1: as it is. folder: the document reads back from there; absent: from any folder. Entries of the
/// shipped catalogue stay names. Where a folder is given, files stay references; all else is written out.
Node routed(const Draft& draft, const std::string& routing, const std::string& motion, double factor,
            const std::optional<std::filesystem::path>& folder = {});

}  // namespace dresslife::pipeline
