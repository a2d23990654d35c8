#include "pipeline/resolve/urdf_request.h"

#include "pipeline/settings/fields.h"

namespace dresslife::pipeline {

void describe(Fields& f, UrdfRequest& request) {
  f.path("urdf", request.urdf, Need::required,
         "A URDF file that describes the robot. Further keys of a robot beside it replace its values, "
         "joints and links by their names.");
  f.text("tip", request.tip, Need::optional,
         "The link of the URDF at the flange. Default: tool0, flange, or the only end.");
  f.path("package_folder", request.package_folder, Need::optional,
         "The folder of the packages of package:// names. Default: the folders above the URDF.");
  f.choice("collision", request.collision, "Whether the collision shapes of the URDF become the shapes of the links.");
  f.numbers("accelerations_deg_per_s2", request.accelerations, Need::optional,
            "The highest accelerations of the axes in their order. A URDF has none.");
  f.place_of("accelerations_deg_per_s2", request.accelerations_where);
}

}  // namespace dresslife::pipeline
