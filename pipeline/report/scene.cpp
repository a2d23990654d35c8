#include "pipeline/report/scene.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "pipeline/base/constants.h"
#include "pipeline/base/lists.h"
#include "pipeline/files/files.h"
#include "pipeline/job/setup.h"
#include "pipeline/report/hose_line.h"
#include "pipeline/report/stored_job.h"

namespace dresslife::pipeline {
namespace {

constexpr double picture_width = 860, scene_margin = 24;  // [px]
constexpr double most_height = 620;                       // [px]
constexpr double azimuth = -62, elevation = 16;  // direction of view: angle from +x, and angle above the floor [deg]
constexpr double piece = 0.06;  // thick parts are divided into pieces of this length, which are sorted by depth [m]

/// A line with round ends.
struct Stroke {
  Vector3d from, to;  ///< [m]
  double radius;      ///< [m]
  std::string style;
  double nearness(const Vector3d& toward_viewer) const { return ((from + to) / 2).dot(toward_viewer); }
};

struct View {
  Vector3d right, up, toward_viewer;
  double scale = 1, left = 0, top = 0;  ///< [px/m], [m], [m]

  View() {
    const double a = azimuth * degree, e = elevation * degree;
    toward_viewer = {std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e)};
    right = Vector3d(-std::sin(a), std::cos(a), 0);
    up = toward_viewer.cross(right);
  }
  double x(const Vector3d& p) const { return scene_margin + scale * (p.dot(right) - left); }
  double y(const Vector3d& p) const { return scene_margin + scale * (top - p.dot(up)); }
};

void add_in_pieces(std::vector<Stroke>& strokes, const Stroke& whole) {
  const int pieces = std::max(1, static_cast<int>(std::ceil((whole.to - whole.from).norm() / piece)));
  for (int i = 0; i < pieces; ++i) {
    Stroke part = whole;
    part.from = whole.from + (whole.to - whole.from) * i / pieces;
    part.to = whole.from + (whole.to - whole.from) * (i + 1) / pieces;
    strokes.push_back(part);
  }
}

/// Position and orientation of a link's frame in the world.
struct Frame {
  Vector3d origin;
  Eigen::Quaterniond turn;
  Vector3d operator()(const Vector3d& place) const { return origin + turn * place; }
};

/// Returns, (link), the frames at a sample; empty: no robot moves.
std::vector<Frame> frames_at(const FileReader& file, std::size_t sample) {
  std::vector<double> poses;
  if (file.has("/robot/link_pose")) file.read_rows("/robot/link_pose", sample, 1, poses);
  std::vector<Frame> frames;
  for (std::size_t at = 0; at + 6 < poses.size(); at += 7) {
    const double* p = &poses[at];
    frames.push_back({{p[0], p[1], p[2]}, {p[3], p[4], p[5], p[6]}});
  }
  return frames;
}

void add_robot(std::vector<Stroke>& strokes, const std::vector<Frame>& frames, const Robot& robot) {
  for (std::size_t link = 0; link < std::min(robot.links.size(), frames.size()); ++link)
    for (const Capsule& capsule : robot.links[link].capsules)
      add_in_pieces(strokes,
                    {frames[link](capsule.from), frames[link](capsule.to), capsule.radius, link % 2 ? "arm" : "arm-2"});
}

/// Adds guide rings and intermediate clamps, as circles of short strokes around the hose.
void add_rings(std::vector<Stroke>& strokes, const std::vector<Frame>& frames, const Setup& setup) {
  constexpr int corners = 20;
  constexpr double thick = 0.006;  // [m]
  const auto circle = [&](const std::string& name, const Vector3d& centre, const Vector3d& axis, double radius) {
    const auto link =
        static_cast<std::size_t>(std::ranges::find(setup.robot.links, name, &Link::name) - setup.robot.links.begin());
    if (link >= frames.size()) return;
    const Vector3d middle = frames[link](centre), z = frames[link].turn * axis.normalized();
    const Vector3d x = z.unitOrthogonal(), y = z.cross(x);
    const auto corner = [&](int k) {
      const double angle = 2 * std::numbers::pi * k / corners;
      return Vector3d(middle + radius * (std::cos(angle) * x + std::sin(angle) * y));
    };
    for (int k = 0; k < corners; ++k) strokes.push_back({corner(k), corner(k + 1), thick, "arm-2"});
  };
  for (const MountedDresspack& mounted : setup.dresspacks) {
    for (const GuideRing& ring : mounted.routing.rings)
      circle(ring.link, ring.position, ring.direction, ring.radius + thick);
    for (const IntermediateClamp& between : mounted.routing.clamps)
      circle(between.clamp.link, between.clamp.position, between.clamp.direction,
             mounted.dresspack.diameter / 2 + thick);
  }
}

/// Returns the points of each dresspack.
std::vector<std::vector<Vector3d>> hose_points(const FileReader& file, std::size_t sample) {
  std::vector<double> clamps, centres;
  file.read_rows("/clamp/position", sample, 1, clamps);
  file.read_rows("/segment/position", sample, 1, centres);
  return mapped(hose_lines(file), [&](const DresspackLine& line) { return line.in(clamps, centres); });
}

/// Adds a dresspack. Segment i extends half way to its neighbours.
void add_hose(std::vector<Stroke>& strokes, const std::vector<Vector3d>& points, double radius, int from_tool) {
  const int segments = static_cast<int>(points.size()) - 2;
  for (int i = 1; i <= segments; ++i) {
    const Vector3d begin = i == 1 ? points[0] : Vector3d((points[i - 1] + points[i]) / 2);
    const Vector3d end = i == segments ? points[i + 1] : Vector3d((points[i] + points[i + 1]) / 2);
    const char* style = i == segments + 1 - from_tool ? "hose-hot" : "hose";
    strokes.push_back({begin, points[i], radius, style});
    strokes.push_back({points[i], end, radius, style});
  }
}

std::string stroke_line(const View& view, const Stroke& stroke, const char* style, double wider) {
  return fmt::format(
      "<line class=\"{}\" x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" "
      "stroke-width=\"{:.1f}\"/>\n",
      style, view.x(stroke.from), view.y(stroke.from), view.x(stroke.to), view.y(stroke.to),
      2 * stroke.radius * view.scale + wider);
}

View fit(const std::vector<Stroke>& strokes, double& height) {
  View view;
  double left = 1e9, right = -1e9, bottom = 1e9, top = -1e9;
  for (const Stroke& stroke : strokes)
    for (const Vector3d& p : {stroke.from, stroke.to}) {
      left = std::min(left, p.dot(view.right) - stroke.radius);
      right = std::max(right, p.dot(view.right) + stroke.radius);
      bottom = std::min(bottom, p.dot(view.up) - stroke.radius);
      top = std::max(top, p.dot(view.up) + stroke.radius);
    }
  view.scale = std::min((picture_width - 2 * scene_margin) / std::max(right - left, 0.1),
                        (most_height - 2 * scene_margin) / std::max(top - bottom, 0.1));
  view.left = left - ((picture_width - 2 * scene_margin) / view.scale - (right - left)) / 2;
  view.top = top;
  height = view.scale * (top - bottom) + 2 * scene_margin;
  return view;
}

/// Returns a bar of one metre (or a tenth of a metre for small scenes) for the lower left corner.
std::string scale_bar(const View& view, double height) {
  const double length = view.scale > 600 ? 0.1 : 1;
  const double y = height - 10;
  return fmt::format(
      "<line class=\"mark\" x1=\"{0:.1f}\" y1=\"{1:.1f}\" x2=\"{2:.1f}\" y2=\"{1:.1f}\" "
      "stroke-width=\"2\"/>\n"
      "<text class=\"tick\" x=\"{3:.1f}\" y=\"{4:.1f}\">{5}</text>\n",
      scene_margin, y, scene_margin + length * view.scale, scene_margin + 4, y - 5, length < 1 ? "100 mm" : "1 m");
}

}  // namespace

std::size_t nearest_sample(const std::vector<double>& times, double time) {
  const auto later = std::ranges::lower_bound(times, time);
  const auto at = static_cast<std::size_t>(later - times.begin());
  if (at == 0) return 0;
  return later == times.end() || time - times[at - 1] <= *later - time ? at - 1 : at;
}

std::string scene_picture(const std::filesystem::path& motion_file, double time, int from_tool,
                          const std::string& marked_dresspack) {
  const FileReader file(motion_file, motion_format());
  const Setup setup = setup_from(stored_job(file));
  const std::vector<double> times = file.read<double>("/time");
  const std::size_t sample = nearest_sample(times, time);
  std::vector<Stroke> strokes;
  const std::vector<Frame> frames = frames_at(file, sample);
  add_robot(strokes, frames, setup.robot);
  add_rings(strokes, frames, setup);
  const std::vector<std::vector<Vector3d>> hoses = hose_points(file, sample);
  for (std::size_t d = 0; d < std::min(hoses.size(), setup.dresspacks.size()); ++d)
    add_hose(strokes, hoses[d], setup.dresspacks[d].dresspack.diameter / 2,
             name_among(setup, d) == marked_dresspack ? from_tool : 0);

  double height = 0;
  const View view = fit(strokes, height);
  std::ranges::stable_sort(strokes, [&](const Stroke& a, const Stroke& b) {
    return a.nearness(view.toward_viewer) < b.nearness(view.toward_viewer);
  });
  std::string body;
  for (const Stroke& stroke : strokes) {
    if (stroke.style.starts_with("hose")) body += stroke_line(view, stroke, "halo", 3);
    body += stroke_line(view, stroke, stroke.style.c_str(), 0);
  }
  return fmt::format(
      "<svg viewBox=\"0 0 {:.0f} {:.0f}\" role=\"img\"><title>Robot and dresspack at {:.2f} "
      "s</title>\n{}{}</svg>\n",
      picture_width, height, times[sample], body, scale_bar(view, height));
}

}  // namespace dresslife::pipeline
