#include "pipeline/report/bending_chart.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "pipeline/base/lists.h"
#include "pipeline/base/readable.h"
#include "pipeline/base/statistics.h"
#include "pipeline/cable/cable_bending.h"
#include "pipeline/cable/stiffness.h"
#include "pipeline/files/files.h"
#include "pipeline/files/motion_layout.h"
#include "pipeline/job/job.h"
#include "pipeline/report/plot.h"
#include "pipeline/report/stored_job.h"

namespace dresslife::pipeline {
namespace {

using Curve = std::vector<double>;

struct Law {
  std::string name;
  double largest;  ///< largest curvature in the motion [1/m]
  /// Returns the moment of the first bend [N m]; friction: a factor on the friction.
  std::function<Curve(double friction, const Curve& curvature)> moment;
  std::function<double(double curvature)>
      simulated;  ///< moment of the first bend in the simulation [N m]; empty: not simulated
};

constexpr int curve_steps = 120;  // number of points of a curve, about 7 px apart

/// Returns the moments for rising curvature, between minus and plus the largest curvature.
Curve way_up(const Law& law, double friction) {
  Curve half;
  for (int k = 0; k <= curve_steps; ++k) half.push_back(law.largest * k / curve_steps);
  Curve moment = law.moment(friction, half);
  const double end = moment.back();
  for (double& at : moment) at = 2 * at - end;
  return moment;
}

/// Returns "0.0081 N m2 sliding, 1.7 held; friction 0.017 N m (0.006 .. 0.05)": both ends of the law, with no and all layers
/// sliding.
std::string words_of(const Law& law, const std::array<double, 3>& frictions) {
  constexpr double none = 1e-6, all = 1e4;  // [1/m]: curvatures at which no part slides, and at which all parts slide
  const auto friction = [&](double factor) {
    const Curve at = law.moment(factor, {all, 2 * all});
    const double held = 2 * at[0] - at[1];
    return readable(held > 1e-12 * at[1] ? held : 0);  // a smaller value is rounding
  };
  const Curve at = law.moment(frictions[1], {none, all, 2 * all});
  return fmt::format(
      "{}: E I {} N m2 sliding, {} held; friction {} N m (10 .. 90 %: {} .. {}); largest curvature {} 1/m", law.name,
      readable((at[2] - at[1]) / all), readable(at[0] / none), friction(frictions[1]), friction(frictions[0]),
      friction(frictions[2]), readable(law.largest));
}

void draw(Picture& picture, const Panel& panel, const Law& law, const std::array<double, 3>& frictions) {
  const Curve low = way_up(law, frictions[0]), middle = way_up(law, frictions[1]), high = way_up(law, frictions[2]);
  const auto point = [&](int k, double moment, int sign) {
    return std::pair(panel.across(sign * law.largest * (2.0 * k / curve_steps - 1)), panel.down(sign * moment));
  };
  std::vector<std::pair<double, double>> loop, first, simulated;
  for (const int sign : {1, -1}) {
    std::vector<std::pair<double, double>> band;
    for (int k = 0; k <= curve_steps; ++k) band.push_back(point(k, high[k], sign));
    for (int k = curve_steps; k >= 0; --k) band.push_back(point(k, low[k], sign));
    picture.curve(band, "dark");
  }
  panel.draw_axes(picture);
  for (const int sign : {1, -1})
    for (int k = 0; k <= curve_steps; ++k) loop.push_back(point(k, middle[k], sign));
  for (int k = 0; k <= curve_steps; ++k) {
    const double curvature = law.largest * k / curve_steps;
    first.emplace_back(panel.across(curvature), panel.down((middle[k] + middle.back()) / 2));
    if (law.simulated) simulated.emplace_back(panel.across(curvature), panel.down(law.simulated(curvature)));
  }
  picture.curve(loop, "curve-hot");
  picture.curve(first, "curve");
  picture.curve(simulated, "leader");
  picture.text(panel.left + 6, panel.top + 12, words_of(law, frictions), "note", Picture::Anchor::start,
               panel.width - 12);
}

Law law_of_hose(const Dresspack& dresspack, double largest) {
  const auto simulated = [&dresspack](double curvature) {
    const auto held = [&](const BendingFriction& of) { return of.stiffness * std::min(curvature, of.slides_at); };
    return sum_of(dresspack.bending_friction, held, elastic_bending_stiffness(dresspack) * curvature);
  };
  return {inner_radius(dresspack) ? "hose with all in it" : dresspack.name, largest,
          [&dresspack](double friction, const Curve& at) { return bending_moments(dresspack, friction, at); },
          dresspack.cable_alone ? std::function<double(double)>() : simulated};
}

/// Returns the largest curvature of the segments of a dresspack [1/m].
double bend_of_hose(const FileReader& strain, std::size_t dresspack) {
  const std::vector<std::size_t> of_segment = dresspack_of_segments(strain);
  std::vector<double> row;
  double most = 0;
  for (std::size_t t = 0; t < strain.rows("/time"); ++t) {
    strain.read_rows("/deformation/curvature", t, 1, row);
    for (std::size_t k = 0; k < of_segment.size(); ++k)
      if (of_segment[k] == dresspack) most = std::max(most, std::hypot(row[2 * k], row[2 * k + 1]));
  }
  return most;
}

/// Returns the largest curvature of the cables of a component [1/m]; 0: they are held, or an older file does not contain it.
double bend_of_cables(const FileReader& strain, std::size_t dresspack, std::size_t component) {
  if (!strain.has("/cable/curvature")) return 0;
  const auto bends = strain.read<double>("/cable/curvature");
  const auto of_dresspack = strain.read<std::int32_t>("/cable/dresspack"),
             of_component = strain.read<std::int32_t>("/cable/component");
  double most = 0;
  for (std::size_t k = 0; k < bends.size(); ++k)
    if (of_dresspack[k] == static_cast<int>(dresspack) && of_component[k] == static_cast<int>(component))
      most = std::max(most, bends[k]);
  return most;
}

}  // namespace

std::string bending_chart(const std::filesystem::path& strain_file, std::size_t which) {
  const FileReader strain(strain_file, strain_format());
  const Job job = job_from(stored_job(strain));
  if (std::ranges::none_of(job.strain.slip, rubs))
    throw InputError({strain_file.string()}, "comes from a job without friction in its cables (strain.slip)",
                     "set strain.slip: friction and run again");
  const Dresspack& dresspack = job.dresspacks.at(which).dresspack;
  const double bend = bend_of_hose(strain, which);
  if (!(bend > 0))
    throw InputError({strain_file.string()}, "has no bend (the motion twists or pulls alone)", "choose another figure");
  std::vector<Law> laws{law_of_hose(dresspack, bend)};
  std::vector<std::string> left_out;
  for (std::size_t c = 0; c < dresspack.components.size() && inner_radius(dresspack); ++c) {
    const Component& cable = dresspack.components[c];
    if (cable.components.empty()) {
      left_out.push_back(cable.name);
      continue;
    }
    const double own = bend_of_cables(strain, which, c);
    laws.push_back({own > 0 ? cable.name : cable.name + " (bent as the hose)",
                    own > 0 ? own : bend,
                    [&](double friction, const Curve& at) { return bending_moments(dresspack, cable, friction, at); },
                    {}});
  }
  const auto friction = [&](double share) {
    const auto at = static_cast<Eigen::Index>(index_of(Uncertain::friction_inside));
    const double deviation = std::sqrt(knowledge_of(job).covariance(at, at));
    const UncertainParameter& parameter = uncertain_parameters()[index_of(Uncertain::friction_inside)];
    return job.strain.factors.friction * parameter.value(deviation * normal_quantile(share));
  };
  const std::array<double, 3> frictions{friction(0.1), friction(0.5), friction(0.9)};
  constexpr double height = 300, heading = 44, below = 62;  // [px]
  const std::string title = "Moment over curvature";
  Picture picture(chart_width, heading + (height + below) * static_cast<double>(laws.size()), title, title);
  picture.text(
      chart_left, 15,
      "Blue: first bend; red: loop of the largest bend in the motion; grey: with the friction of 10 .. 90 %; dashed: as simulated",
      "note");
  if (!left_out.empty())
    picture.text(chart_left, 32,
                 fmt::format("Left out, because they have no wires that are described: {}", fmt::join(left_out, ", ")),
                 "note");
  for (std::size_t k = 0; k < laws.size(); ++k) {
    const double most = way_up(laws[k], frictions[2]).back(),
                 by_simulation = laws[k].simulated ? laws[k].simulated(laws[k].largest) : 0;
    const double highest = std::max(most, by_simulation);
    const Panel panel{chart_left,
                      heading + (height + below) * static_cast<double>(k),
                      chart_panel,
                      height,
                      linear_axis("curvature [1/m]", -laws[k].largest, laws[k].largest, 9),
                      linear_axis("moment [N m]", -highest, highest)};
    draw(picture, panel, laws[k], frictions);
  }
  return picture.svg();
}

}  // namespace dresslife::pipeline
