// The world of one simulation: ODE's bodies, collision geometry and integrator for the chain.
//
// Every segment is an ODE body with a capsule. Elastic links (rod.h) and contacts (contact.h) give the force m dv/h and the
// torque I dv/h with which ODE's own step advances the bodies. Robot links are groups of geometry; the caller gives their poses
// for the end of every step. One World per simulation; different worlds can be used in different threads.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "sim/contact/contact.h"
#include "sim/contact/mesh.h"
#include "sim/contact/ring.h"
#include "sim/rod/rod.h"

namespace dresslife::sim {

struct WorldSettings {
  double time_step = 0.005;         ///< [s]
  double friction = 0.3;            ///< Coulomb coefficient of the hose against obstacles and itself
  std::vector<double> frictions{};  ///< (dresspack) replaces `friction`, between two the smaller one; empty: unused
  bool floor = false;               ///< plane z = 0
  bool self_contact = false;        ///< contacts of dresspacks with themselves and with each other
  /// Links that carry the end clamps; no_link: none. Contacts of these links with the first or last piece of a span, one diameter
  /// long beyond the clamp, are ignored, because the clamp holds this piece.
  int base_link = no_link, tool_link = no_link;
  std::vector<int> between_links{};  ///< links of the other ends, in the order of ClampFrames::between; empty: none

  int end_link(int e) const {
    if (e == 0) return base_link;
    if (between_links.empty()) return e == 1 ? tool_link : no_link;
    return e <= static_cast<int>(between_links.size()) ? between_links[e - 1] : tool_link;
  }
};

/// A capsule of a robot link, in the link's frame.
struct CapsuleShape {
  Vector3 from = Vector3::Zero(), to = Vector3::Zero();  ///< ends of its axis [m]
  double radius = 0;                                     ///< [m]
};

/// A box of a robot link, centred on `frame` in the link's frame.
struct BoxShape {
  Frame frame;
  Vector3 sides = Vector3::Zero();  ///< full lengths along the frame's axes [m]
};

struct StepReport {
  bool finite = true;    ///< false: the state is invalid, stop
  double max_depth = 0;  ///< deepest overlap at the start of the step [m]; 0: no contact
  int touching = 0;      ///< number of contacts that overlap or have a force
};

class World {
 public:
  /// Starts from `start`, with the robot links at `links`: one frame per link that shapes can name; may be empty.
  World(const Rod& rod, const WorldSettings& settings, const RodState& start, std::span<const Frame> links = {});
  ~World();
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  void add(int link, const CapsuleShape& shape);
  void add(int link, const BoxShape& shape);
  /// Adds a mesh in the frame `local` of the link. link: of the robot, or cell_obstacle for a mesh at rest in the world.
  void add(int link, std::shared_ptr<const Mesh> mesh, const Frame& local = {});
  /// Adds a guide ring; its frame is relative to the link. link: of the robot, or cell_obstacle.
  void add(int link, const RingShape& ring);

  /// Does one time step, at whose end the clamps and links have these poses.
  StepReport advance(const ClampFrames& clamps, std::span<const Frame> links = {});
  /// Does one time step with further loads on the segments (none, or one per segment).
  StepReport advance(const ClampFrames& clamps, std::span<const Frame> links, std::span<const Load> loads);

  const RodState& state() const;
  /// Replaces the state (for a restart, or for velocities set to zero while settling).
  void set_state(const RodState& state);
  /// Returns the contacts of the last step, in order of segment.
  const std::vector<Contact>& contacts() const;
  const Rod& rod() const;
  double time_step() const;
  /// Returns the computational work of all steps so far. Unit: a step of one segment without contact. A contact costs in
  /// proportion to the number of segments and contacts, because its impulse moves all of them.
  double work() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace dresslife::sim
