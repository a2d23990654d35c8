// The world of one simulation: ODE's bodies, collision geometry and integrator around the chain.
//
// Every segment is an ODE body with a capsule; the elastic links (rod.h) and contacts (contact.h) enter as
// the force m dv/h and torque I dv/h with which ODE's own step advances the bodies. Robot links are groups of
// geometry whose poses the caller gives for the end of every step. One World per simulation; worlds may live
// in different threads.
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
  double friction = 0.3;            ///< Coulomb, hose against obstacles and itself
  std::vector<double> frictions{};  ///< (dresspack) instead, between two the smaller; empty: all alike
  bool floor = false;               ///< plane z = 0
  bool self_contact = false;        ///< whether dresspacks feel themselves and each other
  /// Link to which each end is clamped: contacts of a span's first or last piece, one diameter long beyond
  /// the clamp, with that link do not push (the clamp holds it there). no_link: none.
  int base_link = no_link, tool_link = no_link;
  std::vector<int> between_links{};  ///< of the other ends, as ClampFrames::between; empty: none

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
  bool finite = true;    ///< false: the state is useless, stop
  double max_depth = 0;  ///< deepest overlap at the start of the step, 0 when nothing touches [m]
  int touching = 0;      ///< contacts that overlap or carry force
};

class World {
 public:
  /// Starts from `start`, with robot links at `links` (one frame per link that shapes may name; may be
  /// empty).
  World(const Rod& rod, const WorldSettings& settings, const RodState& start,
        std::span<const Frame> links = {});
  ~World();
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  void add(int link, const CapsuleShape& shape);
  void add(int link, const BoxShape& shape);
  /// A mesh, in the frame `local` of the link. link: of the robot, or cell_obstacle for what stands still in
  /// the world.
  void add(int link, std::shared_ptr<const Mesh> mesh, const Frame& local = {});
  /// A guide ring, its frame that of the link; link: of the robot, or cell_obstacle.
  void add(int link, const RingShape& ring);

  /// One time step, at whose end the clamps and links are as given.
  StepReport advance(const ClampFrames& clamps, std::span<const Frame> links = {});
  /// The same with further loads on the segments (none, or one per segment).
  StepReport advance(const ClampFrames& clamps, std::span<const Frame> links, std::span<const Load> loads);

  const RodState& state() const;
  /// Replaces the state (a restart, or velocities taken away while settling).
  void set_state(const RodState& state);
  /// Contacts of the last step, in order of segment.
  const std::vector<Contact>& contacts() const;
  const Rod& rod() const;
  double time_step() const;
  /// Of all steps so far, in steps of one segment without contact. A contact's impulse moves all segments and all contacts.
  double work() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace dresslife::sim
