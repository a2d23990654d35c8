#include "pipeline/urdf/urdf.h"

#include <fmt/format.h>

#include <console_bridge/console.h>
#include <urdf_parser/urdf_parser.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <numbers>
#include <sstream>

#include "pipeline/base/joined.h"
#include "pipeline/base/lists.h"
#include "pipeline/resolve/sources.h"

namespace dresslife::pipeline {
namespace {

namespace fs = std::filesystem;
using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double degrees = 180 / std::numbers::pi;
constexpr double endless = 36000;    // limit of a continuous joint [deg]
constexpr double longest_link = 10;  // of a moving link [m]: arms of the largest robots are 2.5 m long
constexpr std::size_t largest_file = 8u << 20;
constexpr int most_elements = 2000;  // links and joints: the tree is processed recursively
constexpr int deepest = 50;          // nested elements: urdfdom's XML reader is recursive

// ---- places: urdfdom does not report lines ------------------------------------------------------------------

/// Lines of the named elements. Also checks that the tags close in the right order.
class XmlPlaces {
 public:
  XmlPlaces(const std::string& text, std::string file) : text_(text), file_(std::move(file)) { scan(); }

  Where of(const std::string& element, const std::string& name) const {
    const auto found = lines_.find(element + " " + name);
    return {file_, found == lines_.end() ? 0 : found->second, 0};
  }
  /// Returns the place of the element that the message names in quotes.
  Where mentioned(const std::string& message) const {
    for (const char* element : {"joint", "link"})
      for (const auto& [key, line] : lines_) {
        const std::string name = key.substr(key.find(' ') + 1);
        if (!key.starts_with(element) || name.empty()) continue;
        for (const char* quotes : {"[]", "''", "\"\""})
          if (message.find(quotes[0] + name + quotes[1]) != std::string::npos) return {file_, line, 0};
      }
    return {file_};
  }

 private:
  [[noreturn]] void fail(int line, const std::string& what) const {
    throw InputError({file_, line}, what, "correct the XML");
  }

  void advance(std::size_t to) {
    to = std::min(to, text_.size());
    line_ += static_cast<int>(
        std::count(text_.begin() + static_cast<long>(at_), text_.begin() + static_cast<long>(to), '\n'));
    at_ = to;
  }

  /// Moves behind the next `end`. Errors: InputError if there is none.
  void skip_past(const char* end, const char* what) {
    const std::size_t found = text_.find(end, at_);
    if (found == std::string::npos) fail(line_, fmt::format("{} is not closed", what));
    advance(found + std::string(end).size());
  }

  void scan() {
    if (text_.find('\0') != std::string::npos) fail(0, "is no XML text (it holds a byte 0)");
    while ((advance(text_.find('<', at_)), at_ < text_.size())) {
      if (text_.compare(at_, 4, "<!--") == 0)
        skip_past("-->", "a comment");
      else if (text_.compare(at_, 9, "<![CDATA[") == 0)
        skip_past("]]>", "a CDATA section");
      else if (text_.compare(at_, 2, "<?") == 0)
        skip_past("?>", "a declaration");
      else if (text_.compare(at_, 2, "<!") == 0)
        skip_past(">", "a declaration");
      else
        tag();
    }
    if (!open_.empty()) fail(open_.back().second, fmt::format("<{}> is not closed", open_.back().first));
    if (!any_) fail(0, "holds no XML element");
  }

  void tag() {
    const int line = line_;
    std::size_t end = at_ + 1;
    for (char quote = 0; end < text_.size() && (quote || text_[end] != '>'); ++end) {
      const char c = text_[end];
      if (quote ? c == quote : c == '"' || c == '\'') quote = quote ? '\0' : c;
    }
    if (end == text_.size()) fail(line, "a tag is not closed");
    const std::string tag = text_.substr(at_ + 1, end - at_ - 1);
    advance(end + 1);
    const bool closes = tag.starts_with('/'), empty = tag.ends_with('/');
    const std::size_t begin = closes ? 1 : 0;
    const std::string name = tag.substr(begin, tag.find_first_of(" \t\r\n/", begin) - begin);
    if (closes) {
      if (open_.empty() || open_.back().first != name)
        fail(line, fmt::format("</{}> closes nothing that is open", name));
      open_.pop_back();
      return;
    }
    any_ = true;
    if (name.starts_with("xacro:"))
      throw InputError({file_, line}, fmt::format("is xacro, from which a URDF is made (<{}>)", name),
                       fmt::format("run xacro first: xacro {} > robot.urdf", file_));
    if ((name == "link" || name == "joint") && ++elements_ > most_elements)
      fail(line, fmt::format("has more than {} links and joints", most_elements));
    lines_.try_emplace(name + " " + attribute(tag, "name"), line);
    if (name == "origin") refuse_degrees(attribute(tag, "rpy"), line);
    if (empty) return;
    open_.emplace_back(name, line);
    if (open_.size() > deepest) fail(line, fmt::format("elements lie more than {} deep in each other", deepest));
  }

  /// Errors: InputError for an angle of more than a turn. urdfdom does not store the angles.
  void refuse_degrees(const std::string& rpy, int line) const {
    constexpr double turn = 6.3;  // [rad], rounded up
    std::istringstream words(rpy);
    std::vector<double> angles;
    for (double angle = 0; words >> angle;) angles.push_back(angle);
    if (angles.size() != 3 || std::ranges::all_of(angles, [&](double angle) { return std::abs(angle) <= turn; }))
      return;
    throw InputError(
        {file_, line}, fmt::format("rpy=\"{}\" turns by more than {} rad", rpy, turn),
        fmt::format("write rpy=\"{:.6g} {:.6g} {:.6g}\" if those were degrees: angles of a URDF are in rad",
                    angles[0] / degrees, angles[1] / degrees, angles[2] / degrees));
  }

  static std::string attribute(const std::string& tag, const std::string& name) {
    std::size_t at = 0;
    while ((at = tag.find(name, at + 1)) != std::string::npos) {
      std::size_t quote = tag.find_first_not_of(" \t\r\n", at + name.size());
      if (!std::isspace(static_cast<unsigned char>(tag[at - 1])) || quote == std::string::npos || tag[quote] != '=')
        continue;
      quote = tag.find_first_of("\"'", quote);
      if (quote == std::string::npos) break;
      return tag.substr(quote + 1, tag.find(tag[quote], quote + 1) - quote - 1);
    }
    return "";
  }

  const std::string& text_;
  std::string file_;
  std::size_t at_ = 0;
  int line_ = 1;
  bool any_ = false;
  int elements_ = 0;
  std::vector<std::pair<std::string, int>> open_;
  std::map<std::string, int> lines_;  // key: "joint joint_1"
};

// ---- urdfdom ----------------------------------------------------------------------------------------------

/// Stores the messages of urdfdom instead of printing them.
class Listener final : public console_bridge::OutputHandler {
 public:
  Listener() { console_bridge::useOutputHandler(this); }
  ~Listener() override { console_bridge::restorePreviousOutputHandler(); }
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;
  void log(const std::string& text, console_bridge::LogLevel level, const char*, int) override {
    if (level == console_bridge::CONSOLE_BRIDGE_LOG_ERROR) errors.push_back(text);
  }
  std::vector<std::string> errors;  // the first error is the most precise one
};

std::string one_line(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < ' ') c = ' ';
  return text.substr(0, 300);
}

urdf::ModelInterfaceSharedPtr parse(const std::string& text, const XmlPlaces& places) {
  static std::mutex one_at_a_time;  // all threads of the process share the listener
  const std::lock_guard lock(one_at_a_time);
  Listener listener;
  urdf::ModelInterfaceSharedPtr model;
  try {
    model = urdf::parseURDF(text);
  } catch (const std::exception& error) {
    listener.errors.push_back(error.what());
  }
  if (model && model->getRoot()) return model;
  const std::string words = one_line(listener.errors.empty() ? "it names no reason" : listener.errors.front());
  throw InputError(places.mentioned(words), fmt::format("is no URDF that can be read (urdfdom: {})", words),
                   "correct it");
}

// ---- numbers ----------------------------------------------------------------------------------------------

Isometry3d transform(const urdf::Pose& pose) {
  Isometry3d made = Isometry3d::Identity();
  made.translation() = Vector3d(pose.position.x, pose.position.y, pose.position.z);
  made.linear() = Eigen::Quaterniond(pose.rotation.w, pose.rotation.x, pose.rotation.y, pose.rotation.z)
                      .normalized()
                      .toRotationMatrix();
  return made;
}

/// Returns roll, pitch, yaw about fixed axes. Roll is computed after yaw, so that their sum is exact at a pitch of +-90 deg.
Vector3d roll_pitch_yaw(const Eigen::Matrix3d& r) {
  const double yaw = std::atan2(r(1, 0), r(0, 0)), c = std::cos(yaw), s = std::sin(yaw);
  return {std::atan2(s * r(0, 2) - c * r(1, 2), c * r(1, 1) - s * r(0, 1)),
          std::atan2(-r(2, 0), c * r(0, 0) + s * r(1, 0)), yaw};
}

/// Builds maps whose keys and values all have one place.
class Tree {
 public:
  explicit Tree(Where where) : where_(std::move(where)) {
    map_.kind = Node::Kind::map;
    map_.where = where_;
  }
  Tree& put(const std::string& key, Node value) {
    value.where = where_;
    map_.entries.push_back({key, where_, std::move(value)});
    return *this;
  }
  Tree& text(const std::string& key, const std::string& value) {
    Node node = scalar(value);
    node.quoted = true;
    return put(key, std::move(node));
  }
  Tree& number(const std::string& key, double value) { return put(key, scalar(fmt::format("{}", value))); }
  Tree& vector(const std::string& key, const Vector3d& v) {
    std::vector<Node> numbers;
    for (int i = 0; i < 3; ++i) {
      numbers.push_back(scalar(fmt::format("{}", v[i] == 0 ? 0.0 : v[i])));
      numbers.back().where = where_;
    }
    return put(key, list_of(std::move(numbers)));
  }
  Tree& pose(const Isometry3d& frame, const std::string& position = "position_m",
             const std::string& angles = "rpy_deg") {
    vector(position, frame.translation());
    return vector(angles, degrees * roll_pitch_yaw(frame.linear()));
  }
  Node done() { return std::move(map_); }

 private:
  Where where_;
  Node map_;
};

// ---- the chain --------------------------------------------------------------------------------------------

bool turns(const urdf::Joint& joint) {
  return joint.type == urdf::Joint::REVOLUTE || joint.type == urdf::Joint::CONTINUOUS;
}

class Chain {
 public:
  Chain(const urdf::ModelInterface& model, const XmlPlaces& places, const UrdfRequest& request)
      : model_(model), places_(places), request_(request), file_{request.urdf.string()} {}

  Node robot() {
    walk();
    check_axes();
    follow();
    Tree robot(file_);
    robot.text("name", model_.getName().empty() ? request_.urdf.stem().string() : model_.getName());
    robot.text("source", "URDF " + request_.urdf.filename().string());
    add_base(robot);
    if (!external_.empty()) robot.put("external_axes", list_of(std::move(external_)));
    if (!fixed_.empty()) robot.put("fixed_links", list_of(std::move(fixed_)));
    if (!left_out_.empty()) robot.text("links_left_out", joined(left_out_, ", "));
    robot.pose(carried_, "flange_position_m", "flange_rpy_deg");
    std::vector<Node> joints;
    for (std::size_t k = 0; k < moved_.size(); ++k) joints.push_back(joint_node(k));
    robot.put("joints", list_of(std::move(joints)));
    robot.put("links", list_of(mapped(carriers_, [&](const Carrier& carrier) {
                return link_node(*carrier.link, &carrier != &carriers_.front());
              })));
    return robot.done();
  }

 private:
  /// A link of the robot: a moving link of the URDF and the links that are fixed to it.
  struct Carrier {
    const urdf::Link* link;
  };
  struct MovedLink {
    const urdf::Joint* joint;
    Isometry3d origin;  // in the preceding moving link
    int driver = -1;    // index of the joint that it follows
    double ratio = 1, offset = 0;
    double lower = 0, upper = 0, speed = 0;
  };

  [[noreturn]] void fail(const Where& where, const std::string& what, const std::string& remedy) const {
    throw InputError(where, what, remedy);
  }
  Where at(const urdf::Joint& joint) const { return places_.of("joint", joint.name); }

  const urdf::Link& tip() const {
    std::vector<std::string> names, ends;
    for (const auto& [name, link] : model_.links_) {
      names.push_back(name);
      if (link->child_joints.empty()) ends.push_back(name);
    }
    if (!request_.tip.empty()) {
      if (const auto link = model_.getLink(request_.tip)) return *link;
      fail(file_, fmt::format("has no link '{}' for the tip", request_.tip),
           fmt::format("one of: {}", joined(names, ", ")));
    }
    for (const char* usual : {"tool0", "flange"})
      if (const auto link = model_.getLink(usual)) return *link;
    if (ends.size() == 1) return *model_.getLink(ends[0]);
    fail(file_, "has several ends and none is called tool0 or flange",
         fmt::format("choose one with 'tip': {}", joined(ends, ", ")));
  }

  void walk() {
    std::vector<const urdf::Joint*> joints;  // starting at the root
    for (const urdf::Link* link = &tip(); link->parent_joint; link = link->getParent().get())
      joints.push_back(link->parent_joint.get());
    std::ranges::reverse(joints);
    carriers_.push_back({model_.getRoot().get()});
    for (const urdf::Joint* joint : joints) {
      const Isometry3d origin = carried_ * transform(joint->parent_to_joint_origin_transform);
      if (joint->type == urdf::Joint::FIXED) {
        carried_ = origin;
      } else if (turns(*joint)) {
        moved_.push_back({joint, origin});
        carriers_.push_back({model_.getLink(joint->child_link_name).get()});
        carried_ = Isometry3d::Identity();
      } else if (joint->type == urdf::Joint::PRISMATIC && moved_.empty()) {
        add_slide(*joint, origin);
      } else {
        fail(at(*joint), fmt::format("joint '{}' does not turn (only the base may slide)", joint->name),
             "choose another tip, or make it fixed");
      }
    }
  }

  /// Adds a track: it carries the base. The links before the first track do not move.
  void add_slide(const urdf::Joint& joint, const Isometry3d& origin) {
    if (joint.mimic)
      fail(at(joint),
           fmt::format("joint '{}' slides and mimics '{}' (a track has a drive of its own)", joint.name,
                       joint.mimic->joint_name),
           "leave out <mimic>, or make it fixed");
    external_.push_back(Tree(at(joint))
                            .text("name", joint.name)
                            .text("kind", "linear")
                            .pose(origin, "origin_m")
                            .vector("axis", {joint.axis.x, joint.axis.y, joint.axis.z})
                            .number("lower_mm", 1e3 * (joint.limits ? joint.limits->lower : 0))
                            .number("upper_mm", 1e3 * (joint.limits ? joint.limits->upper : 0))
                            .number("speed_mm_per_s", 1e3 * (joint.limits ? joint.limits->velocity : 0))
                            .done());
    const Node below = link_node(*carriers_[0].link, false);
    if (const bool has_shapes = below.entries.size() > 1; has_shapes && external_.size() == 1)
      fixed_.push_back(below);
    else if (has_shapes)
      left_out_.push_back(carriers_[0].link->name);
    carriers_[0] = {model_.getLink(joint.child_link_name).get()};
    carried_ = Isometry3d::Identity();
  }

  void check_axes() {
    const auto axes = std::ranges::count_if(moved_, [](const MovedLink& m) { return !m.joint->mimic; });
    if (axes < 4 || axes > 7)
      fail(file_, fmt::format("has {} axes between its root and its tip (a robot has 4 to 7)", axes),
           "choose another tip");
    // The base may be a track, and links before the first axis may be a portal.
    for (std::size_t k = 1; k < moved_.size(); ++k)
      refuse_millimetres(at(*moved_[k].joint), fmt::format("the origin of joint '{}'", moved_[k].joint->name),
                         "origin xyz", moved_[k].joint->parent_to_joint_origin_transform.position);
  }

  /// Errors: InputError for lengths that no moving link of a robot has.
  void refuse_millimetres(const Where& where, const std::string& what, const char* attribute,
                          const urdf::Vector3& lengths) const {
    const double largest = std::max({std::abs(lengths.x), std::abs(lengths.y), std::abs(lengths.z)});
    if (largest > longest_link)
      fail(where, fmt::format("{} has {:.6g} m (at most {:g} in a link that moves)", what, largest, longest_link),
           fmt::format("write {}=\"{:g} {:g} {:g}\" if those were millimetres: lengths of a URDF are in m", attribute,
                       lengths.x / 1e3, lengths.y / 1e3, lengths.z / 1e3));
  }

  /// Finds the drivers of following joints. The limits of a follower reduce those of its driver.
  void follow() {
    std::map<std::string, int> index;
    for (std::size_t k = 0; k < moved_.size(); ++k) index[moved_[k].joint->name] = static_cast<int>(k);
    for (MovedLink& moved : moved_) {
      const bool limited = moved.joint->type == urdf::Joint::REVOLUTE && moved.joint->limits;
      moved.lower = limited ? degrees * moved.joint->limits->lower : -endless;
      moved.upper = limited ? degrees * moved.joint->limits->upper : endless;
      moved.speed = moved.joint->limits ? degrees * moved.joint->limits->velocity : 0;
      const urdf::Joint* joint = moved.joint;
      for (std::size_t hops = 0; joint->mimic; ++hops) {
        const auto driver = index.find(joint->mimic->joint_name);
        if (hops > moved_.size())
          fail(at(*moved.joint), fmt::format("joint '{}' mimics itself, directly or through others", moved.joint->name),
               "let one joint of the circle mimic none");
        if (driver == index.end())
          fail(at(*moved.joint),
               fmt::format("joint '{}' mimics '{}', which is no axis of the chain", moved.joint->name,
                           joint->mimic->joint_name),
               "choose another tip, or let it mimic a joint between root and tip");
        moved.offset += moved.ratio * degrees * joint->mimic->offset;
        moved.ratio *= joint->mimic->multiplier;
        moved.driver = driver->second;
        joint = moved_[driver->second].joint;
      }
    }
    for (const MovedLink& moved : moved_) {
      if (moved.driver < 0 || moved.ratio == 0) continue;
      MovedLink& driver = moved_[moved.driver];
      double low = (moved.lower - moved.offset) / moved.ratio, high = (moved.upper - moved.offset) / moved.ratio;
      if (low > high) std::swap(low, high);
      driver.lower = std::max(driver.lower, low);
      driver.upper = std::min(driver.upper, high);
      if (moved.speed > 0) driver.speed = std::min(driver.speed, moved.speed / std::abs(moved.ratio));
    }
  }

  /// Sets the base frame of the programs. ROS-Industrial names this frame `base`. Fixed joints connect it with the root, or with
  /// the sliding base.
  void add_base(Tree& robot) const {
    const urdf::Link* link = model_.getLink("base").get();
    if (!link) return;
    Isometry3d frame = Isometry3d::Identity();
    for (; link != carriers_[0].link; link = link->getParent().get()) {
      if (!link->parent_joint || link->parent_joint->type != urdf::Joint::FIXED) return;
      frame = transform(link->parent_joint->parent_to_joint_origin_transform) * frame;
    }
    robot.vector("program_base_m", frame.translation());
    if (!frame.linear().isIdentity(1e-9))
      robot.vector("program_base_rpy_deg", degrees * roll_pitch_yaw(frame.linear()));
  }

  Node joint_node(std::size_t k) const {
    const MovedLink& moved = moved_[k];
    Tree tree(at(*moved.joint));
    tree.text("name", moved.joint->name).pose(moved.origin, "origin_m");
    tree.vector("axis", {moved.joint->axis.x, moved.joint->axis.y, moved.joint->axis.z});
    if (moved.driver >= 0) {
      tree.text("follows", moved_[moved.driver].joint->name);
      tree.number("ratio", moved.ratio).number("offset_deg", moved.offset);
      return tree.done();
    }
    tree.number("lower_deg", moved.lower).number("upper_deg", moved.upper).number("speed_deg_per_s", moved.speed);
    const auto axis = static_cast<std::size_t>(std::count_if(moved_.begin(), moved_.begin() + static_cast<long>(k),
                                                             [](const MovedLink& m) { return m.driver < 0; }));
    Node made = tree.done();
    if (axis < request_.accelerations.size()) {
      Node& acceleration = made["acceleration_deg_per_s2"];
      acceleration = scalar(fmt::format("{}", degrees * request_.accelerations[axis]));
      place_at(acceleration, request_.accelerations_where);
      made.entries.back().where = request_.accelerations_where;
    }
    return made;
  }

  // ---- shapes -------------------------------------------------------------------------------------------

  struct Shapes {
    std::vector<Node> capsules, boxes, meshes;
  };

  /// moves: false for a floor or a fence beside the base, which may be of any size.
  Node link_node(const urdf::Link& link, bool moves) const {
    Tree tree(places_.of("link", link.name));
    tree.text("name", link.name);
    if (request_.collision == UrdfRequest::Collision::drop) return tree.done();
    Shapes shapes;
    gather(link, Isometry3d::Identity(), moves, shapes);
    if (!shapes.capsules.empty()) tree.put("capsules", list_of(std::move(shapes.capsules)));
    if (!shapes.boxes.empty()) tree.put("boxes", list_of(std::move(shapes.boxes)));
    if (!shapes.meshes.empty()) tree.put("meshes", list_of(std::move(shapes.meshes)));
    return tree.done();
  }

  void gather(const urdf::Link& link, const Isometry3d& frame, bool moves, Shapes& shapes) const {
    for (const auto& collision : link.collision_array)
      if (collision && collision->geometry) {
        if (moves) refuse_large(link, *collision);
        add_shape(*collision->geometry, frame * transform(collision->origin), places_.of("link", link.name), shapes);
      }
    for (const auto& joint : link.child_joints)
      if (joint->type == urdf::Joint::FIXED)
        gather(*model_.getLink(joint->child_link_name), frame * transform(joint->parent_to_joint_origin_transform),
               moves, shapes);
  }

  /// Refuses shapes in millimetres. Meshes are checked when they are read.
  void refuse_large(const urdf::Link& link, const urdf::Collision& collision) const {
    const Where where = places_.of("link", link.name);
    refuse_millimetres(where, fmt::format("the origin of a shape of link '{}'", link.name), "origin xyz",
                       collision.origin.position);
    const urdf::Geometry& geometry = *collision.geometry;
    if (geometry.type == urdf::Geometry::BOX) {
      refuse_millimetres(where, fmt::format("a box of link '{}'", link.name), "box size",
                         static_cast<const urdf::Box&>(geometry).dim);
    } else if (geometry.type == urdf::Geometry::CYLINDER || geometry.type == urdf::Geometry::SPHERE) {
      const bool round = geometry.type == urdf::Geometry::SPHERE;
      const double radius = round ? static_cast<const urdf::Sphere&>(geometry).radius
                                  : static_cast<const urdf::Cylinder&>(geometry).radius;
      const double length = round ? 0 : static_cast<const urdf::Cylinder&>(geometry).length;
      if (std::max(radius, length) > longest_link)
        fail(where,
             fmt::format("a {} of link '{}' has {:.6g} m (at most {:g} in a link that moves)",
                         round ? "sphere" : "cylinder", link.name, std::max(radius, length), longest_link),
             fmt::format("write radius=\"{:g}\"{} if those were millimetres: lengths of a URDF are in m", radius / 1e3,
                         round ? "" : fmt::format(" length=\"{:g}\"", length / 1e3)));
    }
  }

  void add_shape(const urdf::Geometry& geometry, const Isometry3d& frame, const Where& where, Shapes& into) const {
    const auto capsule = [&](double half, double radius) {
      into.capsules.push_back(Tree(where)
                                  .vector("from_m", frame * Vector3d(0, 0, -half))
                                  .vector("to_m", frame * Vector3d(0, 0, half))
                                  .number("radius_mm", 1e3 * radius)
                                  .done());
    };
    const auto box = [&](const Isometry3d& pose, const Vector3d& sides) {
      into.boxes.push_back(Tree(where).pose(pose).vector("sides_m", sides).done());
    };
    switch (geometry.type) {
      case urdf::Geometry::SPHERE:
        return capsule(0, static_cast<const urdf::Sphere&>(geometry).radius);
      case urdf::Geometry::BOX: {
        const auto& dim = static_cast<const urdf::Box&>(geometry).dim;
        return box(frame, {dim.x, dim.y, dim.z});
      }
      case urdf::Geometry::CYLINDER: {
        // Four rectangles between opposite sides of the octagon, 45 deg apart, together form the octagon.
        const auto& cylinder = static_cast<const urdf::Cylinder&>(geometry);
        const double half = cylinder.length / 2, radius = cylinder.radius, eighth = std::numbers::pi / 8;
        if (half > radius) capsule(half - radius, radius);
        for (int k = 0; k < 4; ++k)
          box(frame * Eigen::AngleAxisd(2 * k * eighth, Vector3d::UnitZ()),
              {2 * radius * std::cos(eighth), 2 * radius * std::sin(eighth), cylinder.length});
        return;
      }
      case urdf::Geometry::MESH:
        into.meshes.push_back(mesh_node(static_cast<const urdf::Mesh&>(geometry), frame, where));
    }
  }

  Node mesh_node(const urdf::Mesh& mesh, const Isometry3d& frame, const Where& where) const {
    const double scale = mesh.scale.x;
    constexpr double rounding = 1e-9;
    if (!(scale > 0) || std::abs(mesh.scale.y - scale) > rounding * scale ||
        std::abs(mesh.scale.z - scale) > rounding * scale)
      fail(where, fmt::format("mesh '{}' is scaled by different factors", mesh.filename), "scale it evenly");
    const fs::path file = mesh_file(mesh.filename, where);
    std::string end = file.extension().string();
    std::ranges::transform(end, end.begin(), [](unsigned char c) { return std::tolower(c); });
    if (end != ".stl" && end != ".obj")
      fail(where, fmt::format("mesh '{}' is neither STL nor OBJ", mesh.filename),
           "convert it, or leave the URDF's shapes out with 'collision: drop'");
    return Tree(where)
        .text("file", fs::absolute(file).lexically_normal().string())
        .number("scale", scale)
        .pose(frame)
        .done();
  }

  fs::path mesh_file(const std::string& name, const Where& where) const {
    const std::string package = "package://", plain = "file://";
    const fs::path folder = fs::absolute(request_.urdf).lexically_normal().parent_path();
    fs::path looked_for;
    if (!name.starts_with(package)) {
      looked_for = folder / (name.starts_with(plain) ? name.substr(plain.size()) : name);
      if (is_file(looked_for)) return looked_for;
    } else {
      const fs::path inside = name.substr(package.size());  // PACKAGE/path
      std::vector<fs::path> places;
      if (!request_.package_folder.empty()) places.push_back(request_.package_folder);
      for (fs::path above = folder; above != above.parent_path(); above = above.parent_path())
        places.push_back(above.parent_path());
      for (const fs::path& place : places)
        if (is_file(place / inside)) return place / inside;
      looked_for = places.empty() ? inside : places.front() / inside;
    }
    fail(where, fmt::format("mesh '{}' is not there (looked for {})", name, looked_for.string()),
         "give 'package_folder', or leave the URDF's shapes out with 'collision: drop'");
  }

  const urdf::ModelInterface& model_;
  const XmlPlaces& places_;
  const UrdfRequest& request_;
  Where file_;
  std::vector<Carrier> carriers_;  // link 0 is the base
  std::vector<MovedLink> moved_;
  std::vector<Node> external_, fixed_;           // tracks, and links before them
  std::vector<std::string> left_out_;            // links between two tracks
  Isometry3d carried_ = Isometry3d::Identity();  // of the current link, in the last moving link
};

}  // namespace

Node robot_from_urdf(const UrdfRequest& request) { return robot_from_urdf(request, read_source(request.urdf)); }

Node robot_from_urdf(const UrdfRequest& request, const std::string& text) {
  const std::string file = request.urdf.string();
  if (text.size() > largest_file)
    throw InputError({file}, fmt::format("has {} bytes (at most {})", text.size(), largest_file),
                     "give a smaller URDF");
  const XmlPlaces places(text, file);
  const urdf::ModelInterfaceSharedPtr model = parse(text, places);
  return Chain(*model, places, request).robot();
}

}  // namespace dresslife::pipeline
