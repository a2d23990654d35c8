#include "pipeline/report/motion_data.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "pipeline/base/lists.h"
#include "pipeline/report/hose_line.h"
#include "pipeline/report/json.h"
#include "pipeline/report/key_samples.h"

namespace dresslife::pipeline {
namespace {

constexpr std::size_t most_motion_bytes = 2'150'000;  // bytes in the page, before base64 adds a third
// samples that are considered; of longer motions every second, third, ... sample
constexpr std::size_t most_samples = 20'000;
constexpr double first_miss = 0.5e-3;  // first tolerance of a position [m]
// tolerance of curvature and twist, as a share of their largest value, per metre of position tolerance
constexpr double shape_miss = 0.01 / first_miss;
constexpr std::size_t samples_at_once = 512;
constexpr std::string_view contact = "contact";  // name of a group

/// A spline through every second of 64 centres misses the centres between by hundredths of a millimetre.
constexpr std::size_t most_points = 34;  // points of a dresspack, including the two clamps

/// Consecutive quantities of a row with common steps and a common unit.
struct Group {
  std::string_view name;
  std::size_t begin, size;
  double weight;  ///< [m per unit of the quantity] turns an error into an error of position; 0: any error is allowed
  bool narrow;    ///< one byte per value, for quantities that are only shown as a colour
};

/// Returns every stride-th row of a dataset.
std::vector<double> read_strided(const FileReader& file, const std::string& dataset, std::size_t stride) {
  if (stride == 1) return file.read<double>(dataset);
  const std::size_t rows = file.rows(dataset), size = file.row_size(dataset);
  std::vector<double> all, some;
  for (std::size_t first = 0; first < rows; first += samples_at_once * stride) {
    file.read_rows(dataset, first, std::min(samples_at_once * stride, rows - first), some);
    for (std::size_t at = 0; at < some.size(); at += stride * size)
      all.insert(all.end(), some.begin() + static_cast<std::ptrdiff_t>(at),
                 some.begin() + static_cast<std::ptrdiff_t>(at + size));
  }
  return all;
}

double reach(const Link& link) {
  double farthest = 0.1;  // [m] for a link without shapes, whose frame is drawn
  for (const Capsule& capsule : link.capsules)
    farthest = std::max({farthest, capsule.from.norm() + capsule.radius, capsule.to.norm() + capsule.radius});
  for (const Box& box : link.boxes) farthest = std::max(farthest, box.position.norm() + box.sides.norm() / 2);
  return link.meshes.empty() ? farthest : std::max(farthest, 1.0);
}

/// Returns the segments of a line whose centres are included: evenly spread, with the first and the last.
std::vector<std::size_t> kept_centres(const DresspackLine& line) {
  const std::size_t pieces = std::min(line.segments, most_points) - 1;
  std::vector<std::size_t> kept;
  for (std::size_t k = 0; k <= pieces; ++k) kept.push_back(pieces ? k * (line.segments - 1) / pieces : 0);
  return kept;
}

class Player {
 public:
  Player(const FileReader& motion, const FileReader* strain, const Setup& setup)
      : stride_(1 + motion.rows("/time") / most_samples), lines_(hose_lines(motion)) {
    histories_.time = read_strided(motion, "/time", stride_);
    read_lines(motion);
    if (motion.has("/robot/link_pose")) read_links(motion, setup);
    if (motion.has("/robot/joint_position"))
      add("joints", read_strided(motion, "/robot/joint_position", stride_), first_miss / 2e-3, false);
    if (strain) read_shape(*strain);
    if (motion.has("/contact/force")) add(contact, read_strided(motion, "/contact/force", stride_), 0, true);
    join();
  }

  Json json() {
    double miss = first_miss;
    std::vector<std::size_t> keys = key_samples(histories_, tolerance(miss));
    while (keys.size() * row_bytes() > most_motion_bytes && keys.size() > 2)
      keys = key_samples(histories_, tolerance(miss *= 2));
    gather_contacts(keys);
    return written(keys);
  }

 private:
  /// values: (sample, quantity)
  void add(std::string_view name, std::vector<double> values, double weight, bool narrow) {
    const std::size_t samples = histories_.time.size(), size = values.size() / samples;
    groups_.push_back({name, histories_.width, size, weight, narrow});
    parts_.push_back(std::move(values));
    histories_.width += size;
  }

  std::size_t row_bytes() const {
    return sum_of(
        groups_, [](const Group& group) { return group.size * (group.narrow ? 1 : 2); }, sizeof(float));
  }

  /// Reads the points of each dresspack: base clamp, segment centres, tool clamp.
  void read_lines(const FileReader& motion) {
    const std::vector<double> clamps = read_strided(motion, "/clamp/position", stride_),
                              centres = read_strided(motion, "/segment/position", stride_);
    const std::size_t samples = histories_.time.size();
    const std::size_t clamp_row = clamps.size() / samples, centre_row = centres.size() / samples;
    std::vector<double> points;
    for (std::size_t k = 0; k < samples; ++k) {
      const double *clamp = &clamps[k * clamp_row], *centre = &centres[k * centre_row];
      for (const DresspackLine& line : lines_) {
        points.insert(points.end(), clamp + 3 * line.base_clamp, clamp + 3 * line.base_clamp + 3);
        for (const std::size_t segment : kept_centres(line)) {
          const double* of = centre + 3 * (line.first_segment + segment);
          points.insert(points.end(), of, of + 3);
        }
        points.insert(points.end(), clamp + 3 * line.tool_clamp, clamp + 3 * line.tool_clamp + 3);
      }
    }
    add("points", std::move(points), 1, false);
  }

  /// Reads the link poses with quaternions of continuous sign, so that they can be interpolated.
  void read_links(const FileReader& motion, const Setup& setup) {
    const std::vector<double> poses = read_strided(motion, "/robot/link_pose", stride_);
    const std::size_t samples = histories_.time.size(), links = poses.size() / samples / 7;
    std::vector<double> positions, turns;
    double farthest = 0;
    for (std::size_t link = 0; link < std::min(links, setup.robot.links.size()); ++link)
      farthest = std::max(farthest, reach(setup.robot.links[link]));
    for (std::size_t k = 0; k < samples; ++k)
      for (std::size_t link = 0; link < links; ++link) {
        const double* pose = &poses[7 * (k * links + link)];
        positions.insert(positions.end(), pose, pose + 3);
        double sign = 1;
        if (k > 0) {
          const double* before = &turns[4 * ((k - 1) * links + link)];
          double dot = 0;
          for (int q = 0; q < 4; ++q) dot += before[q] * pose[3 + q];
          sign = dot < 0 ? -1 : 1;
        }
        for (int q = 0; q < 4; ++q) turns.push_back(sign * pose[3 + q]);
      }
    add("link_positions", std::move(positions), 1, false);
    // A quaternion error of e is a rotation error of at most 2 e.
    add("link_quaternions", std::move(turns), 2 * farthest, false);
  }

  void read_shape(const FileReader& strain) {
    const std::vector<double> pairs = read_strided(strain, "/deformation/curvature", stride_);
    std::vector<double> curvature, twist = read_strided(strain, "/deformation/twist", stride_);
    for (std::size_t i = 0; i + 1 < pairs.size(); i += 2) curvature.push_back(std::hypot(pairs[i], pairs[i + 1]));
    const auto weight = [](const std::vector<double>& values) {
      return 1 / (shape_miss * largest_of(values, 1e-9, [](double value) { return std::abs(value); }));
    };
    const double of_curvature = weight(curvature), of_twist = weight(twist);
    add("curvature", std::move(curvature), of_curvature, true);
    add("twist", std::move(twist), of_twist, true);
  }

  void join() {
    const std::size_t samples = histories_.time.size();
    histories_.rows.resize(samples * histories_.width);
    for (std::size_t g = 0; g < groups_.size(); ++g)
      for (std::size_t k = 0; k < samples; ++k)
        std::copy_n(&parts_[g][k * groups_[g].size], groups_[g].size,
                    &histories_.rows[k * histories_.width + groups_[g].begin]);
    parts_.clear();
  }

  /// Contacts change from sample to sample, so they do not choose key samples. A key sample gets the largest contact force since
  /// the key sample before it.
  void gather_contacts(const std::vector<std::size_t>& keys) {
    for (const Group& group : groups_) {
      if (group.name != contact) continue;
      for (std::size_t k = keys.size(); k-- > 1;)
        for (std::size_t sample = keys[k - 1] + 1; sample < keys[k]; ++sample)
          for (std::size_t q = group.begin; q < group.begin + group.size; ++q) {
            double& largest = histories_.rows[keys[k] * histories_.width + q];
            largest = std::max(largest, histories_.row(sample)[q]);
          }
    }
  }

  std::vector<double> tolerance(double miss) const {
    std::vector<double> of;
    for (const Group& group : groups_) of.insert(of.end(), group.size, miss / group.weight);
    return of;
  }

  Json written(const std::vector<std::size_t>& keys) const {
    const std::vector<double> misses = largest_misses(histories_, keys);
    Json groups{};
    for (const Group& group : groups_) {
      double low = std::numeric_limits<double>::infinity(), high = -low, miss = 0;
      for (std::size_t q = group.begin; q < group.begin + group.size; ++q) {
        miss = std::max(miss, misses[q]);
        for (const std::size_t key : keys) {
          low = std::min(low, histories_.row(key)[q]);
          high = std::max(high, histories_.row(key)[q]);
        }
      }
      const Steps steps(low, high, group.narrow ? 255 : 65535);
      groups.add(group.name, {{"begin", group.begin},
                              {"size", group.size},
                              {"low", low},
                              {"high", high},
                              {"step", steps.step},
                              {"miss", miss + steps.step / 2},
                              {"narrow", group.narrow},
                              {"numbers", numbers(group, steps, keys)}});
    }
    const auto times =
        mapped(keys, [&](std::size_t key) { return static_cast<float>(histories_.time[key] - histories_.time[0]); });
    return {{"begin", histories_.time.front()},
            {"end", histories_.time.back()},
            {"keys", keys.size()},
            {"samples", histories_.time.size()},
            {"stride", stride_},
            {"width", histories_.width},
            {"lines", line_descriptions()},
            {"groups", groups},
            {"time", base64_of(times)}};
  }

  /// Returns the values of a group, (key, quantity).
  Json numbers(const Group& group, const Steps& steps, const std::vector<std::size_t>& keys) const {
    std::vector<std::uint16_t> wide;
    std::string narrow;
    for (const std::size_t key : keys)
      for (std::size_t q = group.begin; q < group.begin + group.size; ++q)
        if (group.narrow)
          narrow += static_cast<char>(steps.of(histories_.row(key)[q]));
        else
          wide.push_back(steps.of(histories_.row(key)[q]));
    return group.narrow ? Json(base64(narrow)) : base64_of(wide);
  }

  /// places: positions of the points along the line, in segments from the base clamp.
  std::vector<Json> line_descriptions() const {
    std::vector<Json> list;
    for (const DresspackLine& line : lines_) {
      std::vector<double> places{0};
      for (const std::size_t segment : kept_centres(line)) places.push_back(static_cast<double>(segment) + 0.5);
      places.push_back(static_cast<double>(line.segments));
      list.push_back({{"first_segment", line.first_segment}, {"segments", line.segments}, {"places", places}});
    }
    return list;
  }

  std::size_t stride_;
  std::vector<DresspackLine> lines_;
  Histories histories_;
  std::vector<Group> groups_;
  std::vector<std::vector<double>> parts_;
};

}  // namespace

Json motion_data(const FileReader& motion, const FileReader* strain, const Setup& setup) {
  return Player(motion, strain, setup).json();
}

Json program_data(const FileReader& file) {
  const auto time = file.read<double>("/time");
  const auto step = file.read<std::int32_t>("/program/step");
  std::vector<double> begin, line;
  for (std::size_t k = 0; k < step.size(); ++k) {
    const double here = time[k] < 0 ? -1 : step[k];
    if (!line.empty() && line.back() == here) continue;
    begin.push_back(time[k] - time[0]);
    line.push_back(here);
  }
  return {{"text", file.read<std::string>("/program/text")}, {"begin", begin}, {"line", line}};
}

}  // namespace dresslife::pipeline
