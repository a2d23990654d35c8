#include "pipeline/base/errors.h"
#include "pipeline/resolve/urdf_request.h"

namespace dresslife::pipeline {

Node robot_from_urdf(const UrdfRequest& request) {
  throw InputError({request.urdf.string()}, "is a URDF, which this stage does not read (it needs no robot)",
                   "name the resolved job after --job: dresslife show JOB.yaml > RESOLVED.yaml");
}

}  // namespace dresslife::pipeline
