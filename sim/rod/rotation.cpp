#include "sim/rod/rotation.h"

namespace dresslife::sim {

Quaternion turn_between(const Vector3& from, const Vector3& to) { return Quaternion::FromTwoVectors(from, to); }

}  // namespace dresslife::sim
