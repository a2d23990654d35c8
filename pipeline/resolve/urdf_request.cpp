#include "pipeline/resolve/urdf_request.h"

#include "pipeline/settings/fields.h"

namespace dresslife::pipeline {

void describe(Fields& f, UrdfRequest& request) {
  f.path("urdf", request.urdf, Need::required,
         "a URDF from which the robot is made; all other keys of a robot go beside it and count more, joints "
         "and "
         "links by their names");
  f.text("tip", request.tip, Need::optional,
         "link of the URDF at the flange; without it tool0, flange, or the only end");
  f.path("package_folder", request.package_folder, Need::optional,
         "folder that holds the packages of package:// names; without it those above the URDF");
  f.choice("collision", request.collision, "whether the URDF's collision shapes are the links' shapes");
  f.numbers("accelerations_deg_per_s2", request.accelerations, Need::optional,
            "highest accelerations of the axes, in their order: a URDF has none");
}

}  // namespace dresslife::pipeline
