#include "pipeline/advise/improve/nudges.h"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include "pipeline/base/constants.h"
#include "pipeline/base/joined.h"
#include "pipeline/base/lists.h"
#include "pipeline/job/job.h"
#include "pipeline/settings/fields.h"

namespace dresslife::pipeline {
namespace {

std::string routings_of(const Job& job) {
  const auto text = [](const MountedDresspack& mounted) {
    return mounted.name + to_yaml(echo_fields(mounted.routing));
  };
  return joined(mapped(job.dresspacks, text), "");
}

std::string vector_text(const Vector3d& vector) {
  return fmt::format("[{:.6g}, {:.6g}, {:.6g}]", vector.x(), vector.y(), vector.z());
}

const char* sign_of(double off) { return off < 0 ? "−" : "+"; }

class Nudges {
 public:
  explicit Nudges(const MountingTolerance& by) : by_(by) {}

  void add_length(const std::string& key, const std::string& name, double own) {
    for (const double off : {-by_.off, by_.off})
      if (off != 0)
        add(fmt::format("{}, {} {:g} mm", name, sign_of(off), 1e3 * by_.off), fmt::format("{}={:.6g}", key, own + off));
  }

  void add_turn(const std::string& key, const std::string& name, double own) {
    for (const double turn : {-by_.turn, by_.turn})
      if (turn != 0)
        add(fmt::format("{}, {} {:g} deg", name, sign_of(turn), by_.turn / degree),
            fmt::format("{}={:.6g}", key, (own + turn) / degree));
  }

  /// Adds offsets of a position along the axes of its link, and of its direction about two axes perpendicular to it.
  void add_place(const std::string& path, const std::string& name, const Vector3d& position,
                 const Vector3d& direction) {
    if (!(by_.off > 0)) return;
    constexpr const char* axes = "xyz";
    for (int axis = 0; axis < 3; ++axis)
      for (const double off : {-by_.off, by_.off}) {
        Vector3d moved = position;
        moved[axis] += off;
        add(fmt::format("{}, {} {} {:g} mm", name, axes[axis], sign_of(off), 1e3 * by_.off),
            fmt::format("{}.position_m={}", path, vector_text(moved)));
      }
    const Vector3d along = direction.normalized(), first = along.unitOrthogonal();
    for (const Vector3d& about : {first, Vector3d(along.cross(first))})
      for (const double tilt : {-by_.tilt(), by_.tilt()}) {
        const Vector3d tilted = Eigen::AngleAxisd(tilt, about) * along;
        add(fmt::format("{}, tilted by {:.2g} deg to [{:.2f}, {:.2f}, {:.2f}]", name, by_.tilt() / degree, tilted.x(),
                        tilted.y(), tilted.z()),
            fmt::format("{}.direction={}", path, vector_text(tilted)));
      }
  }

  std::vector<Nudge> done() { return std::move(nudges_); }

 private:
  void add(std::string what, std::string set) { nudges_.push_back({std::move(what), {std::move(set)}}); }

  MountingTolerance by_;
  std::vector<Nudge> nudges_;
};

}  // namespace

MountingTolerance tolerance_of(double off_mm, const std::optional<double>& off_deg) {
  const double usual_turn = off_mm > 0 ? MountingTolerance{}.turn : 0;
  return {off_mm / 1000, off_deg ? *off_deg * degree : usual_turn};
}

std::vector<Nudge> nudges_of(const std::vector<StudyJob>& jobs, const MountingTolerance& by) {
  for (const StudyJob& job : jobs)
    if (!job.job || routings_of(*job.job) != routings_of(*jobs.front().job)) return {};
  Nudges nudges(by);
  const Job& job = *jobs.front().job;
  for (std::size_t k = 0; k < job.dresspacks.size(); ++k) {
    const MountedDresspack& mounted = job.dresspacks[k];
    const Routing& routing = mounted.routing;
    const std::string path = mounted.name.empty() ? "routing" : fmt::format("dresspacks.{}.routing", k + 1);
    const std::string of = mounted.name.empty() ? "" : mounted.name + ": ";
    const auto add_clamp = [&](const Clamp& clamp, const std::string& at, const std::string& name) {
      nudges.add_place(path + "." + at, of + name, clamp.position, clamp.direction);
    };
    nudges.add_length(path + ".free_length_m", of + "length", routing.free_length);
    if (routing.tool_clamp) nudges.add_turn(path + ".pre_twist_deg", of + "end at the tool turned", routing.pre_twist);
    if (routing.base_clamp) add_clamp(*routing.base_clamp, "base_clamp", "base clamp");
    if (routing.tool_clamp) add_clamp(*routing.tool_clamp, "tool_clamp", "tool clamp");
    for (std::size_t i = 0; i < routing.clamps.size(); ++i) {
      const std::string at = fmt::format("clamps.{}", i + 1), name = fmt::format("clamp {}", i + 1);
      nudges.add_length(fmt::format("{}.{}.at_length_m", path, at), of + name + ", its place on the hose",
                        routing.clamps[i].at_length);
      add_clamp(routing.clamps[i].clamp, at, name);
    }
    for (std::size_t i = 0; i < routing.rings.size(); ++i) {
      const GuideRing& ring = routing.rings[i];
      const std::string at = fmt::format("{}.rings.{}", path, i + 1), name = fmt::format("{}ring {}", of, i + 1);
      if (ring.at_length) nudges.add_length(at + ".at_length_m", name + ", its place on the hose", *ring.at_length);
      nudges.add_place(at, name, ring.position, ring.direction);
    }
  }
  return nudges.done();
}

bool has_mounting_tolerance(const std::string& key) {
  if (!key.starts_with("routing.") && !(key.starts_with("dresspacks.") && key.find(".routing.") != std::string::npos))
    return false;
  constexpr std::array ends{".free_length_m", ".at_length_m", ".position_m", ".direction", ".pre_twist_deg"};
  return std::ranges::any_of(ends, [&](const char* end) { return key.ends_with(end); });
}

std::string tolerance_text(const MountingTolerance& by) {
  std::string text;
  if (by.off > 0)
    text =
        fmt::format("a clamp or length off by {:g} mm, a clamp tilted by {:.2g} deg", 1e3 * by.off, by.tilt() / degree);
  if (by.turn > 0) text += fmt::format("{}an end turned by {:g} deg", text.empty() ? "" : " or ", by.turn / degree);
  return text;
}

}  // namespace dresslife::pipeline
