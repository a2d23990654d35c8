#include "tests/strain/loose/ode_cables.h"

#include <algorithm>
#include <cmath>

namespace dresslife::strain::test {
namespace {

using Eigen::Matrix3d, Eigen::Quaterniond, Eigen::Vector2d, Eigen::Vector3d;

constexpr int pieces = 800;   // of the axis; its frames turn by 1e-3 rad in each
constexpr double h = 1;       // [s]; only mass / h^2 matters
constexpr double drag = 3e3;  // per displacement in a step [N/m2]; steps stay below the gap between cables
constexpr double spin = 300;  // drag against rotation, per length [N]: half the tension with which ODE's springs rotate

Quaterniond turned_by(const Vector3d& angle) {
  return Quaterniond(Eigen::AngleAxisd(angle.norm(), angle.norm() > 0 ? angle.normalized() : Vector3d(1, 0, 0)));
}

Vector3d rotation_vector(const Quaterniond& q) {
  const Eigen::AngleAxisd by(q.w() < 0 ? Quaterniond(-q.coeffs()) : q);
  return by.angle() * by.axis();
}

}  // namespace

HoseCurve::HoseCurve(double length, const std::function<HoseNode(double)>& hose) : length_(length) {
  Frame frame{Vector3d::Zero(), Matrix3d::Identity()};
  frames_.push_back(frame);
  const double ds = length / pieces;
  for (int k = 0; k < pieces; ++k) {
    const HoseNode node = hose((k + 0.5) / pieces);
    const Vector3d half = ds / 2 * Vector3d(node.curvature1, node.curvature2, node.twist);
    const Matrix3d step = turned_by(half).toRotationMatrix();
    frame.axes = frame.axes * step;
    frame.at += ds * (1 + node.elongation) * frame.axes.col(2);
    frame.axes = frame.axes * step;
    frames_.push_back(frame);
  }
}

HoseCurve::Frame HoseCurve::beside(const Vector3d& point, double near) const {
  double arc = near * pieces;
  Frame frame = frames_.front();
  for (int k = 0; k < 20; ++k) {
    const auto low = static_cast<std::size_t>(std::clamp(std::floor(arc), 0.0, pieces - 1.0));
    const double share = arc - static_cast<double>(low);
    const Frame &a = frames_[low], &b = frames_[low + 1];
    const Quaterniond from(a.axes), to(b.axes);
    frame = {a.at + share * (b.at - a.at),
             (from * turned_by(share * rotation_vector(from.conjugate() * to))).toRotationMatrix()};
    const double along = (point - frame.at).dot(frame.axes.col(2)) / (length_ / pieces);
    arc += along;
    if (std::abs(along) < 1e-9) break;
  }
  return frame;
}

OdeCables::OdeCables(const std::vector<LooseCable>& cables, double length, int segments, double twisting,
                     double inner_radius, double core_radius)
    : length_(length),
      l_(length / segments),
      inner_radius_(inner_radius),
      core_radius_(core_radius),
      segments_(segments) {
  dInitODE2(0);
  dAllocateODEDataForThread(dAllocateMaskAll);
  world_ = dWorldCreate();
  threading_ = dThreadingAllocateSelfThreadedImplementation();
  dWorldSetStepThreadingImplementation(world_, dThreadingImplementationGetFunctions(threading_), threading_);
  dWorldSetCFM(world_, 1e-12);
  contacts_ = dJointGroupCreate(0);
  for (const LooseCable& cable : cables) add_chain(cable, twisting);
}

OdeCables::~OdeCables() {
  dJointGroupDestroy(contacts_);
  dWorldDestroy(world_);
  dThreadingFreeImplementation(threading_);
}

/// Returns the length that a link between segments represents; at the clamps with Gregory's end correction.
double OdeCables::spring_length(int j) const {
  return l_ * (j == 0 || j == segments_ ? 5.0 / 12 : j == 1 || j == segments_ - 1 ? 13.0 / 12 : 1.0);
}

void OdeCables::add_chain(const LooseCable& cable, double twisting) {
  Chain& chain = chains_.emplace_back();
  chain.cable = cable;
  for (int i = 0; i <= segments_ + 1; ++i) {
    const dBodyID body = chain.bodies.emplace_back(dBodyCreate(world_));
    dBodySetAutoDisableFlag(body, 0);
    dBodySetGyroscopicMode(body, 0);
    dBodySetPosition(body, cable.place[0], cable.place[1], i == 0 ? 0 : i > segments_ ? length_ : (i - 0.5) * l_);
    if (i == 0 || i > segments_) {
      dBodySetKinematic(body);
      continue;
    }
    dMass mass;
    dMassSetParameters(&mass, drag * l_, 0, 0, 0, spin * l_, spin * l_, spin * l_, 0, 0, 0);
    dBodySetMass(body, &mass);
  }
  const double bending = cable.bending_stiffness, stiffness[3] = {bending, bending, twisting * bending};
  for (int j = 0; j <= segments_; ++j) {
    const dJointID ball = chain.balls.emplace_back(dJointCreateBall(world_, nullptr));
    dJointAttach(ball, chain.bodies[j], chain.bodies[j + 1]);
    dJointSetBallAnchor(ball, cable.place[0], cable.place[1], j * l_);
    const double stretched = l_ * (j == 0 || j == segments_ ? 0.5 : 1);
    dJointSetBallParam(ball, dParamCFM, stretched / (h * cable.axial_stiffness));
    dJointSetBallParam(ball, dParamERP, 1);
    const dJointID motor = chain.motors.emplace_back(dJointCreateAMotor(world_, nullptr));
    dJointAttach(motor, chain.bodies[j], chain.bodies[j + 1]);
    dJointSetAMotorMode(motor, dAMotorUser);
    dJointSetAMotorNumAxes(motor, 3);
    for (int k = 0; k < 3; ++k) {
      const int group = dParamGroup * k;
      dJointSetAMotorParam(motor, dParamLoStop + group, 0);
      dJointSetAMotorParam(motor, dParamHiStop + group, 0);
      dJointSetAMotorParam(motor, dParamStopCFM + group, spring_length(j) / (h * std::max(stiffness[k], 1e-6)));
      dJointSetAMotorParam(motor, dParamStopERP + group, 1);
    }
  }
}

Vector3d OdeCables::position(dBodyID body) const {
  const dReal* x = dBodyGetPosition(body);
  return {x[0], x[1], x[2]};
}

Quaterniond OdeCables::orientation(dBodyID body) const {
  const dReal* q = dBodyGetQuaternion(body);
  return {q[0], q[1], q[2], q[3]};
}

Vector3d OdeCables::turn(const Chain& chain, int j) const {
  return rotation_vector(orientation(chain.bodies[j]).conjugate() * orientation(chain.bodies[j + 1]));
}

void OdeCables::clamp(const Chain& chain, const HoseCurve& hose) {
  for (const bool tool : {false, true}) {
    const HoseCurve::Frame frame = hose.end(tool);
    const dBodyID body = tool ? chain.bodies.back() : chain.bodies.front();
    const Vector3d at = frame.at + frame.axes * Vector3d(chain.cable.place[0], chain.cable.place[1], 0);
    const Quaterniond q(frame.axes);
    const dQuaternion quaternion = {q.w(), q.x(), q.y(), q.z()};
    dBodySetPosition(body, at.x(), at.y(), at.z());
    dBodySetQuaternion(body, quaternion);
  }
}

/// Sets the links' rotation vectors as the angles of their motors (of body 1 against body 2, hence the sign).
void OdeCables::bend(const Chain& chain) {
  for (int j = 0; j <= segments_; ++j) {
    const Vector3d phi = turn(chain, j);
    const Matrix3d axes = (orientation(chain.bodies[j]) * turned_by(0.5 * phi)).toRotationMatrix();
    for (int k = 0; k < 3; ++k) {
      dJointSetAMotorAxis(chain.motors[j], k, 0, axes(0, k), axes(1, k), axes(2, k));
      dJointSetAMotorAngle(chain.motors[j], k, -phi[k]);
    }
  }
}

/// Adds a soft, smooth contact at the middle of a segment. normal: outward from the touched body.
void OdeCables::push(const Chain& chain, int segment, const Vector3d& normal, double depth) {
  const Vector3d at = position(chain.bodies[segment]);
  dContact contact{};
  contact.surface.mode = dContactSoftCFM | dContactSoftERP;
  contact.surface.mu = 0;
  contact.surface.soft_erp = 1;
  contact.surface.soft_cfm = 1 / (h * chain.cable.wall_stiffness * l_);
  for (int k = 0; k < 3; ++k) {
    contact.geom.pos[k] = at[k];
    contact.geom.normal[k] = normal[k];
  }
  contact.geom.depth = depth;
  dJointAttach(dJointCreateContact(world_, contacts_, &contact), chain.bodies[segment], nullptr);
}

/// Adds the contacts with wall, core, limits of play and other cables. Between two cables the contact is with the plane
/// halfway between them at the start of the step.
void OdeCables::meet(const HoseCurve& hose) {
  // Contacts are added a little before the bodies touch. A contact joint only pushes, and without it in one step a
  // body could jump over the plane.
  constexpr double margin = 1e-4;
  for (const Chain& chain : chains_)
    for (int i = 1; i <= segments_; ++i) {
      const Vector3d x = position(chain.bodies[i]);
      const HoseCurve::Frame frame = hose.beside(x, (i - 0.5) / segments_);
      const Vector3d arm = x - frame.at;
      const auto outside = [&](const Vector3d& from_centre, double reach) {
        const double away = from_centre.norm();
        if (away > reach - margin) push(chain, i, -from_centre / away, away - reach);
      };
      if (chain.cable.play < without_limit) {
        outside(arm - frame.axes * Vector3d(chain.cable.place[0], chain.cable.place[1], 0), chain.cable.play);
        continue;
      }
      outside(arm, inner_radius_ - chain.cable.radius);
      const double nearest = core_radius_ + chain.cable.radius;
      if (core_radius_ > 0 && arm.norm() < nearest + margin) push(chain, i, arm.normalized(), nearest - arm.norm());
      for (const Chain& other : chains_) {
        if (&other == &chain) continue;
        const Vector3d along = orientation(chain.bodies[i]) * Vector3d(0, 0, 1);
        Vector3d apart = x - position(other.bodies[i]);
        apart -= apart.dot(along) * along;
        const double room = (apart.norm() - chain.cable.radius - other.cable.radius) / 2;
        if (room < margin) push(chain, i, apart.normalized(), -room);
      }
    }
}

double OdeCables::follow(const HoseCurve& hose, const std::function<HoseNode(double)>& nodes, int steps) {
  double longest = 0;
  for (int step = 0; step < steps; ++step) {
    dJointGroupEmpty(contacts_);
    std::vector<Vector3d> before;
    for (const Chain& chain : chains_) {
      clamp(chain, hose);
      bend(chain);
      for (int i = 1; i <= segments_; ++i) {
        const dBodyID body = chain.bodies[i];
        before.push_back(position(body));
        dBodySetLinearVel(body, 0, 0, 0);
        dBodySetAngularVel(body, 0, 0, 0);
        const HoseNode node = nodes((i - 0.5) / segments_);
        const Matrix3d axes = hose.beside(position(body), (i - 0.5) / segments_).axes;
        const Vector3d weight = chain.cable.mass_per_length * l_ * (axes * Vector3d(node.pull[0], node.pull[1], 0));
        dBodyAddForce(body, weight.x(), weight.y(), weight.z());
      }
    }
    meet(hose);
    dWorldStep(world_, h);
    longest = 0;
    auto from = before.begin();
    for (const Chain& chain : chains_)
      for (int i = 1; i <= segments_; ++i) longest = std::max(longest, (position(chain.bodies[i]) - *from++).norm());
  }
  return longest;
}

OdeState OdeCables::state(std::size_t cable, const HoseCurve& hose) const {
  const Chain& chain = chains_[cable];
  OdeState state;
  for (int i = 1; i <= segments_; ++i) {
    const Vector3d x = position(chain.bodies[i]);
    const HoseCurve::Frame frame = hose.beside(x, (i - 0.5) / segments_);
    const Vector3d own = frame.axes.transpose() * (x - frame.at);
    state.place.push_back(own.head<2>());
  }
  for (int j = 0; j <= segments_; ++j) {
    dVector3 a, b;
    dJointGetBallAnchor(chain.balls[j], a);
    dJointGetBallAnchor2(chain.balls[j], b);
    const Matrix3d axes = orientation(chain.bodies[j]).toRotationMatrix();
    state.strain += axes.col(2).dot(Vector3d(b[0] - a[0], b[1] - a[1], b[2] - a[2])) / length_;
    if (j < 2 || j + 2 > segments_) continue;
    const Vector3d middle = (position(chain.bodies[j]) + position(chain.bodies[j + 1])) / 2;
    const Vector3d bent = orientation(chain.bodies[j]) * turn(chain, j) / l_;
    state.curvature.push_back(
        (hose.beside(middle, static_cast<double>(j) / segments_).axes.transpose() * bent).head<2>());
  }
  return state;
}

}  // namespace dresslife::strain::test
