#include "sim/contact/world.h"

#include <ode/ode.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <mutex>
#include <new>

#include "sim/contact/self_contact.h"

namespace dresslife::sim {
namespace {

// Contacts are searched ahead by this many steps of the fastest relative motion, and at least by least_margin.
constexpr double margin_steps = 1.5, least_margin = 1e-3;  // [1], [m]
constexpr double bounds_slack = 1e-9;                      // [m] for rounding of bounds, which only exclude contacts
constexpr int most_points = 4;                             // points of one pair of shapes
constexpr double contact_work =
    0.2;  // cost of a contact with a segment or another contact, over that of a segment: ESTIMATE

// ODE does not check whether an allocation fails.
void* memory_or_throw(std::size_t bytes) {
  if (void* const memory = std::malloc(bytes)) return memory;
  throw std::bad_alloc();
}
void* more_memory_or_throw(void* memory, std::size_t, std::size_t bytes) {
  if (void* const moved = std::realloc(memory, bytes)) return moved;
  throw std::bad_alloc();
}

// ODE keeps data per process and per thread. Both calls can be repeated.
void prepare_ode() {
  static std::once_flag once;
  std::call_once(once, [] {
    dSetAllocHandler(memory_or_throw);
    dSetReallocHandler(more_memory_or_throw);
    dInitODE2(0);
  });
  dAllocateODEDataForThread(dAllocateMaskAll);
}

void place(dGeomID geom, const Frame& frame) {
  const Quaternion& q = frame.orientation;
  const dQuaternion quaternion = {q.w(), q.x(), q.y(), q.z()};
  dGeomSetPosition(geom, frame.position.x(), frame.position.y(), frame.position.z());
  dGeomSetQuaternion(geom, quaternion);
}

Frame along(const Vector3& from, const Vector3& to) {
  return {(from + to) / 2, turn_between(Vector3::UnitZ(), to - from)};
}

// Faster than any hose. ODE aborts the whole program for numbers near overflow.
constexpr double fastest = 1e6;  // [m/s], [rad/s]

bool believable(std::span<const Twist6> change) {
  return std::all_of(change.begin(), change.end(), [](const Twist6& twist) {
    return std::all_of(twist.value, twist.value + 6, [](double value) { return std::abs(value) < fastest; });
  });
}

void* tag(int number) { return reinterpret_cast<void*>(static_cast<std::intptr_t>(number)); }
int tag_of(dGeomID geom) { return static_cast<int>(reinterpret_cast<std::intptr_t>(dGeomGetData(geom))); }

/// All points within `radius` of a box about the shape's origin. The box of a capsule is its axis.
struct Bounds {
  Vector3 half = Vector3::Zero();  // [m]
  double radius = 0;               // [m]
};

struct Shape {
  dGeomID geom;
  int link;
  Frame local;   // in the link's frame
  double reach;  // radius of the shape about its own origin [m]
  Bounds bounds;
  double clear = 0;  // lower bound of the distance to the surface of any segment [m]; 0: unknown
  double moves = 0;  // upper bound of its movement in the next step [m]
};

struct GuideRing {
  RingShape shape;
  int link;
  double place = std::numeric_limits<double>::quiet_NaN();  // where the axis passes it; NaN: not searched yet
};

struct MeshShape {
  std::shared_ptr<const Mesh> mesh;
  int link;
  Frame local;
};

}  // namespace

/// A piece of a segment's axis, from its centre [m].
struct Piece {
  double from, to;
  double length() const { return to - from; }
};

struct World::Parts {
  Parts(const Rod& chain, const WorldSettings& given, const RodState& start, std::span<const Frame> frames)
      : rod(chain), settings(given), solver(rod), state(start), links(frames.begin(), frames.end()) {}

  const Rod rod;
  const WorldSettings settings;
  RodSolver solver;
  ContactSolver contact_solver;
  RodState state;
  std::vector<Frame> links;  // present poses
  std::vector<Contact> contacts;
  std::vector<std::pair<int, Contact>> found;  // with the number of the shape

  dWorldID world = nullptr;
  dThreadingImplementationID threading = nullptr;
  std::vector<dBodyID> bodies;
  dSpaceID hose = nullptr, obstacles = nullptr;
  std::vector<dGeomID> capsules;  // of the segments, `margin` larger than the hose
  // (segment) for collide_with(): coordinates of the centres; half a length plus the radius; distance of the surface [m]
  std::array<std::vector<double>, 3> middles;
  std::vector<double> reaches, beyonds;
  dGeomID end_sphere = nullptr, free_capsule = nullptr;  // of a segment that a clamp holds in part
  std::vector<Shape> shapes;
  std::vector<MeshShape> meshes;
  std::vector<GuideRing> rings;
  double self_clear = 0;  // see Shape::clear, for pairs of segments
  double margin = least_margin;
  double work = 0;

  void build();
  void build_hose();
  void add_shape(dGeomID geom, int link, const Frame& local, double reach, const Bounds& bounds);
  void push_state();
  void pull_state();
  void choose_margin(const ClampFrames& clamps, std::span<const Frame> next);
  void find_contacts(std::span<const Frame> next);
  void drop_distant_contacts();
  void collide_with(Shape& shape);
  void collide(dGeomID a, dGeomID b);
  void collide(int segment, size_t mesh, const Frame& frame);
  Frame placed(int link, const Frame& local, std::span<const Frame> frames) const;
  void add_contact(int segment, int shape, const dContactGeom& geometry);
  void keep(int shape, const Contact& contact);
  double friction(const Contact& contact) const;
  double radius(int segment) const { return rod.span_of(segment).properties.diameter / 2; }
  Piece free_piece(int segment, int link) const;
  Vector3 obstacle_velocity(int link, const Vector3& point, std::span<const Frame> next) const;
  void push_bodies();
};

// ---- building ---------------------------------------------------------------------------------------------

World::World(const Rod& rod, const WorldSettings& settings, const RodState& start, std::span<const Frame> links)
    : parts_(std::make_unique<Parts>(rod, settings, start, links)) {
  prepare_ode();
  parts_->build();
}

World::~World() {
  Parts& p = *parts_;
  if (p.hose != nullptr) {
    dSpaceDestroy(p.hose);
    dSpaceDestroy(p.obstacles);
    dGeomDestroy(p.end_sphere);
    dGeomDestroy(p.free_capsule);
  }
  dWorldDestroy(p.world);
  dThreadingFreeImplementation(p.threading);
}

// Worlds share one threading implementation by default, which is not safe between threads, so each world gets its own.
void World::Parts::build() {
  world = dWorldCreate();
  threading = dThreadingAllocateSelfThreadedImplementation();
  dWorldSetStepThreadingImplementation(world, dThreadingImplementationGetFunctions(threading), threading);
  dWorldSetStepIslandsProcessingMaxThreadCount(world, 1);
  dWorldSetAutoDisableFlag(world, 0);
  for (int i = 0; i < rod.segments(); ++i) {
    const Span& span = rod.span_of(i);
    const double transverse = span.transverse_inertia;
    dMass mass;
    dMassSetParameters(&mass, span.segment_mass, 0, 0, 0, transverse, transverse, span.axial_inertia, 0, 0, 0);
    const dBodyID body = dBodyCreate(world);
    dBodySetMass(body, &mass);
    dBodySetFiniteRotationMode(body, 1);
    dBodySetGyroscopicMode(body, 0);  // contained in (S3)
    bodies.push_back(body);
  }
  push_state();
  if (settings.floor) add_shape(dCreatePlane(nullptr, 0, 0, 1, 0), floor_obstacle, Frame{}, 0, {});
}

void World::Parts::build_hose() {
  hose = dSimpleSpaceCreate(nullptr);
  obstacles = dSimpleSpaceCreate(nullptr);
  for (int i = 0; i < rod.segments(); ++i) {
    const dGeomID capsule = dCreateCapsule(hose, radius(i) + margin, rod.span_of(i).segment_length);
    dGeomSetBody(capsule, bodies[i]);
    dGeomSetData(capsule, tag(i));
    capsules.push_back(capsule);
    reaches.push_back(rod.span_of(i).segment_length / 2 + radius(i));
  }
  end_sphere = dCreateSphere(nullptr, radius(0) + margin);
  free_capsule = dCreateCapsule(nullptr, radius(0) + margin, 1);
  for (std::vector<double>& places : middles) places.resize(capsules.size());
  beyonds.resize(capsules.size());
}

void World::Parts::add_shape(dGeomID geom, int link, const Frame& local, double reach, const Bounds& bounds) {
  assert(link < static_cast<int>(links.size()));
  if (hose == nullptr) build_hose();
  dGeomSetData(geom, tag(static_cast<int>(shapes.size())));
  dSpaceAdd(obstacles, geom);
  if (link != floor_obstacle) place(geom, placed(link, local, links));
  shapes.push_back({geom, link, local, reach, bounds});
}

void World::add(int link, const CapsuleShape& shape) {
  const double length = (shape.to - shape.from).norm();
  if (length < 1e-9)
    parts_->add_shape(dCreateSphere(nullptr, shape.radius), link, {shape.from, Quaternion::Identity()}, 0,
                      {Vector3::Zero(), shape.radius});
  else
    parts_->add_shape(dCreateCapsule(nullptr, shape.radius, length), link, along(shape.from, shape.to),
                      length / 2 + shape.radius, {{0, 0, length / 2}, shape.radius});
}

void World::add(int link, const BoxShape& shape) {
  parts_->add_shape(dCreateBox(nullptr, shape.sides.x(), shape.sides.y(), shape.sides.z()), link, shape.frame,
                    shape.sides.norm() / 2, {shape.sides / 2, 0});
}

void World::add(int link, std::shared_ptr<const Mesh> mesh, const Frame& local) {
  assert(link < static_cast<int>(parts_->links.size()));
  parts_->meshes.push_back({std::move(mesh), link, local});
}

void World::add(int link, const RingShape& ring) {
  assert(link < static_cast<int>(parts_->links.size()));
  parts_->rings.push_back({ring, link});
}

// ---- collision --------------------------------------------------------------------------------------------

// Sets the margin: a contact with the relative speed v can close within the step from a distance of v h.
void World::Parts::choose_margin(const ClampFrames& clamps, std::span<const Frame> next) {
  double speed2 = 0;
  for (const Vector3& v : state.velocity) speed2 = std::max(speed2, v.squaredNorm());
  const double h = settings.time_step;
  const double came = std::sqrt(speed2) * h;  // upper bound of each segment's movement in the last step
  self_clear -= 2 * came;
  for (int e = 0; e < clamps.ends(); ++e) {
    const RodProperties& p = rod.spans()[e / 2].properties;
    if ((e % 2 == 0 && p.slider) || (e % 2 == 1 && p.tool_end == End::free)) continue;  // not prescribed
    speed2 = std::max(speed2, (clamps.end(e).position - state.clamps.end(e).position).squaredNorm() / (h * h));
  }
  double obstacle = settings.self_contact ? std::sqrt(speed2) * h : 0;
  const auto consider = [&](int link, const Frame& local, double reach) {
    const Frame then = next[link] * local, now = links[link] * local;
    const double turn = then.orientation.angularDistance(now.orientation);
    const double way = (then.position - now.position).norm() + turn * reach;
    obstacle = std::max(obstacle, way);
    return way;
  };
  for (Shape& shape : shapes) {
    shape.clear -= came + shape.moves;
    if (shape.link >= 0) shape.moves = consider(shape.link, shape.local, shape.reach);
  }
  for (const MeshShape& shape : meshes)
    if (shape.link >= 0) consider(shape.link, shape.local, shape.mesh->radius());
  for (const GuideRing& ring : rings)
    if (ring.link >= 0) consider(ring.link, ring.shape.frame, ring.shape.radius);
  const double wanted = std::max(least_margin, margin_steps * (std::sqrt(speed2) * h + obstacle));
  if (wanted <= margin && wanted > 0.4 * margin) return;
  margin = 1.5 * wanted;
  if (hose == nullptr) return;
  for (int i = 0; i < rod.segments(); ++i)
    dGeomCapsuleSetParams(capsules[i], radius(i) + margin, rod.span_of(i).segment_length);
}

// Returns the piece that no clamp on this link holds, to its exact length: whole segments would make the results jump with
// their number.
Piece World::Parts::free_piece(int segment, int link) const {
  const Span& span = rod.span_of(segment);
  const int k = static_cast<int>(&span - rod.spans().data()), place = segment - span.first_segment;
  const double l = span.segment_length, diameter = span.properties.diameter;
  Piece free{-l / 2, l / 2};
  if (link < 0) return free;
  if (link == settings.end_link(2 * k)) free.from = std::max(free.from, diameter - (place + 0.5) * l);
  if (link == settings.end_link(2 * k + 1)) free.to = std::min(free.to, (span.segments() - place - 0.5) * l - diameter);
  return free;
}

Vector3 World::Parts::obstacle_velocity(int link, const Vector3& point, std::span<const Frame> next) const {
  if (link < 0) return Vector3::Zero();
  const Vector3 local = links[link].orientation.conjugate() * (point - links[link].position);
  return (next[link].point(local) - point) / settings.time_step;
}

void World::Parts::add_contact(int segment, int shape, const dContactGeom& geometry) {
  const double depth = geometry.depth - margin, l = rod.span_of(segment).segment_length;
  const Vector3 t = tangent(state.orientation[segment]), centre = state.position[segment];
  const Vector3 where(geometry.pos[0], geometry.pos[1], geometry.pos[2]);
  Contact contact;
  contact.segment = segment;
  contact.obstacle = shapes[shape].link;
  contact.normal = Vector3(geometry.normal[0], geometry.normal[1], geometry.normal[2]);
  contact.depth = depth;
  // The point on the hose's own surface, independent of the margin: from the nearest point of its axis against the normal.
  const double s = std::clamp((where - centre).dot(t), -l / 2, l / 2);
  contact.point = centre + s * t - radius(segment) * contact.normal;
  keep(shape, contact);
}

void World::Parts::keep(int shape, const Contact& contact) {
  for (const auto& [other, known] : found)  // same place, found through another shape of the segment
    if (other == shape && known.segment == contact.segment && known.normal.dot(contact.normal) > 0.99 &&
        (known.point - contact.point).norm() < rod.span_of(contact.segment).segment_length / 8)
      return;
  found.emplace_back(shape, contact);
}

Frame World::Parts::placed(int link, const Frame& local, std::span<const Frame> frames) const {
  return link < 0 ? local : frames[link] * local;
}

// A segment whose axis crosses the surface counts as overlapping by its whole diameter.
void World::Parts::collide(int segment, size_t mesh, const Frame& frame) {
  const MeshShape& shape = meshes[mesh];
  const Piece free = free_piece(segment, shape.link);
  if (free.length() <= 0) return;
  const double thick = radius(segment), reach = thick + margin;
  const Quaternion back = frame.orientation.conjugate();
  const Vector3 centre = back * (state.position[segment] - frame.position);
  if (centre.norm() > shape.mesh->radius() + rod.span_of(segment).segment_length / 2 + reach) return;
  const Vector3 t = back * tangent(state.orientation[segment]);
  for (const Mesh::MeshContact& touching : shape.mesh->near(centre + free.from * t, centre + free.to * t, reach)) {
    Contact contact;
    contact.segment = segment;
    contact.obstacle = shape.link;
    contact.normal = frame.orientation * touching.normal;
    contact.depth = touching.distance > 0 ? thick - touching.distance : 2 * thick;
    contact.point = frame.point(touching.on_axis) - thick * contact.normal;
    keep(static_cast<int>(shapes.size() + mesh), contact);
  }
}

// A segment can touch a shape only if its centre is nearer to the shape's bounds than half its length plus its radius. A shape is
// skipped if its last distance from all segments exceeds the movements since then. Plain loops over the segments, which
// the compiler vectorises: ODE's search over two spaces takes three times as long for the small number of shapes of a robot.
void World::Parts::collide_with(Shape& shape) {
  if (shape.clear > margin) return;
  const size_t n = capsules.size();
  const double more = shape.bounds.radius + bounds_slack;
  const double *x = middles[0].data(), *y = middles[1].data(), *z = middles[2].data(), *reach = reaches.data();
  double* beyond = beyonds.data();
  if (shape.link == floor_obstacle) {
    for (size_t i = 0; i < n; ++i) beyond[i] = z[i] - (reach[i] + more);
  } else {
    const Frame frame = placed(shape.link, shape.local, links);
    const Matrix3 axes = frame.orientation.toRotationMatrix();
    const Vector3 centre = frame.position, half = shape.bounds.half;
    for (size_t i = 0; i < n; ++i) {
      const double dx = x[i] - centre[0], dy = y[i] - centre[1], dz = z[i] - centre[2];
      double distance2 = 0;
      for (int k = 0; k < 3; ++k) {
        const double out = std::abs(axes(0, k) * dx + axes(1, k) * dy + axes(2, k) * dz) - half[k];
        const double gap = (out + std::abs(out)) / 2;  // max(out, 0) without a branch
        distance2 += gap * gap;
      }
      beyond[i] = std::sqrt(distance2) - (reach[i] + more);
    }
  }
  shape.clear = *std::min_element(beyonds.begin(), beyonds.end());
  if (shape.clear > margin) return;
  for (size_t i = 0; i < n; ++i)
    if (beyond[i] <= margin) collide(capsules[i], shape.geom);
}

void World::Parts::collide(dGeomID a, dGeomID b) {
  const int segment = tag_of(a), shape = tag_of(b);
  const Piece free = free_piece(segment, shapes[shape].link);
  if (free.length() <= 0) return;
  const Vector3 t = tangent(state.orientation[segment]);
  const auto on_axis = [&](double s) { return Vector3(state.position[segment] + s * t); };
  if (free.length() < rod.span_of(segment).segment_length) {
    a = free_capsule;
    dGeomCapsuleSetParams(a, radius(segment) + margin, free.length());
    place(a, {on_axis((free.from + free.to) / 2), state.orientation[segment]});
  }
  dContactGeom points[most_points];
  const int count = dCollide(a, b, most_points, points, sizeof(dContactGeom));
  if (count == 0) return;
  for (int k = 0; k < count; ++k) add_contact(segment, shape, points[k]);
  if (dGeomGetClass(b) != dBoxClass) return;
  // A capsule on a box gets one point and would rock about it. Its two end spheres give further points.
  dGeomSphereSetRadius(end_sphere, radius(segment) + margin);
  for (const double s : {free.from, free.to}) {
    const Vector3 end = on_axis(s);
    dGeomSetPosition(end_sphere, end.x(), end.y(), end.z());
    if (dCollide(end_sphere, b, 1, points, sizeof(dContactGeom)) > 0) add_contact(segment, shape, points[0]);
  }
}

void World::Parts::find_contacts(std::span<const Frame> next) {
  found.clear();
  contacts.clear();
  for (size_t i = 0; i < capsules.size(); ++i)
    for (int k = 0; k < 3; ++k) middles[k][i] = state.position[i][k];
  for (Shape& shape : shapes) collide_with(shape);
  for (size_t mesh = 0; mesh < meshes.size(); ++mesh) {
    const Frame frame = placed(meshes[mesh].link, meshes[mesh].local, links);
    for (int i = 0; i < rod.segments(); ++i) collide(i, mesh, frame);
  }
  std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) {
    return std::pair(a.second.segment, a.first) < std::pair(b.second.segment, b.first);
  });
  for (auto& [shape, contact] : found) {
    contact.obstacle_velocity = obstacle_velocity(contact.obstacle, contact.point, next);
    contacts.push_back(contact);
  }
  if (settings.self_contact && self_clear <= margin)
    self_clear = find_self_contacts(rod, state, margin, contacts) - bounds_slack;
  for (Contact& contact : contacts) contact.friction = friction(contact);
  for (size_t k = 0; k < rings.size(); ++k) {
    GuideRing& ring = rings[k];
    const Frame frame = placed(ring.link, ring.shape.frame, links);
    const size_t before = contacts.size();
    find_ring_contacts(rod, state, ring.shape, frame, static_cast<int>(k), margin, ring.place, contacts);
    for (size_t c = before; c < contacts.size(); ++c)
      contacts[c].obstacle_velocity = obstacle_velocity(ring.link, contacts[c].point, next);
  }
  drop_distant_contacts();
}

// The coefficients are those against a robot's paint. Between two hoses the smaller one is used.
double World::Parts::friction(const Contact& contact) const {
  if (settings.frictions.empty()) return settings.friction;
  const auto of = [&](int segment) { return settings.frictions[rod.span_of(segment).dresspack]; };
  return contact.other < 0 ? of(contact.segment) : std::min(of(contact.segment), of(contact.other));
}

// Drops contacts that cannot close within the step, which would only add idle rows to the contact problem.
void World::Parts::drop_distant_contacts() {
  const std::span<const Twist6> change = solver.velocity_change();
  std::erase_if(contacts, [&](const Contact& contact) {
    const double speed = std::abs(relative_velocity(state, change, contact).dot(contact.normal));
    return -contact.depth >= least_margin + 2 * settings.time_step * speed;
  });
}

// ---- stepping ---------------------------------------------------------------------------------------------

void World::Parts::push_state() {
  for (int i = 0; i < rod.segments(); ++i) {
    const Vector3 &x = state.position[i], &v = state.velocity[i], &w = state.angular_velocity[i];
    const Quaternion& q = state.orientation[i];
    const dQuaternion quaternion = {q.w(), q.x(), q.y(), q.z()};
    dBodySetPosition(bodies[i], x.x(), x.y(), x.z());
    dBodySetQuaternion(bodies[i], quaternion);
    dBodySetLinearVel(bodies[i], v.x(), v.y(), v.z());
    dBodySetAngularVel(bodies[i], w.x(), w.y(), w.z());
  }
}

void World::Parts::pull_state() {
  for (int i = 0; i < rod.segments(); ++i) {
    const dReal *x = dBodyGetPosition(bodies[i]), *q = dBodyGetQuaternion(bodies[i]);
    const dReal *v = dBodyGetLinearVel(bodies[i]), *w = dBodyGetAngularVel(bodies[i]);
    state.position[i] = {x[0], x[1], x[2]};
    state.orientation[i] = Quaternion(q[0], q[1], q[2], q[3]);
    state.velocity[i] = {v[0], v[1], v[2]};
    state.angular_velocity[i] = {w[0], w[1], w[2]};
  }
}

// Passes the velocity changes as the force m dv/h and torque I dv/h with which ODE's own step produces them.
void World::Parts::push_bodies() {
  const double h = settings.time_step;
  const std::span<const Twist6> change = solver.velocity_change();
  for (const Span& span : rod.spans()) {
    const double mass = span.segment_mass / h, transverse = span.transverse_inertia / h;
    const double excess = span.axial_inertia / h - transverse;
    for (int i = span.first_segment; i < span.first_segment + span.segments(); ++i) {
      const Vector3 t = tangent(state.orientation[i]), dw = change[i].angular();
      const Vector3 force = mass * change[i].linear(), torque = transverse * dw + (excess * t.dot(dw)) * t;
      dBodyAddForce(bodies[i], force.x(), force.y(), force.z());
      dBodyAddTorque(bodies[i], torque.x(), torque.y(), torque.z());
    }
  }
  dWorldStep(world, h);
}

StepReport World::advance(const ClampFrames& clamps, std::span<const Frame> links) {
  return advance(clamps, links, {});
}

StepReport World::advance(const ClampFrames& clamps, std::span<const Frame> links, std::span<const Load> loads) {
  Parts& p = *parts_;
  const std::vector<Frame> still(links.empty() ? p.links : std::vector<Frame>());
  const std::span<const Frame> next = links.empty() ? std::span<const Frame>(still) : links;
  assert(next.size() == p.links.size());
  prepare_ode();
  StepReport report;
  const double h = p.settings.time_step;
  report.finite = p.solver.solve(p.state, clamps, h, loads);
  if (!report.finite) return report;
  p.contacts.clear();
  if (p.hose != nullptr || p.settings.self_contact || !p.meshes.empty() || !p.rings.empty()) {
    p.choose_margin(clamps, next);
    p.find_contacts(next);
    p.contact_solver.solve(p.state, h, p.solver, p.contacts);
  }
  const double segments = p.rod.segments(), contacts = static_cast<double>(p.contacts.size());
  p.work += segments + contact_work * contacts * (segments + contacts);
  report.finite = believable(p.solver.velocity_change());
  if (!report.finite) return report;
  p.push_bodies();
  p.pull_state();
  p.solver.finish(p.state);
  for (size_t k = 0; k < p.links.size(); ++k) p.links[k] = next[k];
  for (const Shape& shape : p.shapes)
    if (shape.link >= 0) place(shape.geom, p.links[shape.link] * shape.local);
  for (const Contact& contact : p.contacts) {
    report.max_depth = std::max(report.max_depth, contact.depth);
    if (contact.depth > 0 || contact.normal_force > 0) ++report.touching;
  }
  report.finite = p.rod.finite(p.state);
  return report;
}

const RodState& World::state() const { return parts_->state; }
void World::set_state(const RodState& state) {
  parts_->state = state;
  parts_->push_state();
  parts_->self_clear = 0;  // distances of the new state are unknown
  for (Shape& shape : parts_->shapes) shape.clear = 0;
}
const std::vector<Contact>& World::contacts() const { return parts_->contacts; }
const Rod& World::rod() const { return parts_->rod; }
double World::time_step() const { return parts_->settings.time_step; }
double World::work() const { return parts_->work; }

}  // namespace dresslife::sim
