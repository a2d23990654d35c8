#include "pipeline/report/figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "pipeline/base/lists.h"
#include "pipeline/base/plain_file.h"
#include "pipeline/files/checksum.h"
#include "pipeline/files/files.h"
#include "pipeline/files/motion_layout.h"
#include "pipeline/report/bending_chart.h"
#include "pipeline/report/chart_style.h"
#include "pipeline/report/known_history.h"
#include "pipeline/report/life_charts.h"
#include "pipeline/report/marked_place.h"
#include "pipeline/report/plot.h"
#include "pipeline/report/scene.h"

namespace dresslife::pipeline {
namespace {

constexpr double percent = 100;
constexpr double degrees = 57.29577951308232;

/// The worst wire of a job, from its life file.
struct Worst {
  std::size_t segment = 0;  ///< index in the file
  int from_tool = 0;        ///< number in its dresspack, 1 is nearest to the tool
  std::string dresspack, component;
  double time = 0;  ///< [s]
};

std::optional<Worst> find_worst(const std::filesystem::path& life_file) {
  const FileReader file(life_file, life_format());
  const double site = file.number_attribute("worst_site");
  const int from_tool = static_cast<int>(file.number_attribute("worst_segment_from_tool"));
  if (site < 0 || from_tool < 1) return {};
  const auto segments = file.read<std::int32_t>("/site/segment");
  return Worst{static_cast<std::size_t>(segments.at(static_cast<std::size_t>(site))), from_tool,
               file.has_attribute("worst_dresspack") ? file.text_attribute("worst_dresspack") : "",
               file.text_attribute("worst_component"), file.number_attribute("worst_time")};
}

std::optional<Worst> worst_if_known(const JobFiles& files) {
  return kind_of(files.life) != FileKind::absent ? find_worst(files.life) : std::nullopt;
}

[[noreturn]] void refuse_undamaged(const std::filesystem::path& life_file) {
  throw InputError({life_file.string()}, "has no damaged wire to show", "choose another figure");
}

Worst worst_of(const std::filesystem::path& life_file) {
  if (const auto worst = find_worst(life_file)) return *worst;
  refuse_undamaged(life_file);
}

std::string needed(const std::string& chart, const std::filesystem::path& life_file) {
  if (chart.empty()) refuse_undamaged(life_file);
  return chart;
}

std::pair<double, double> extremes(const std::vector<double>& values) {
  const auto [low, high] = std::ranges::minmax_element(values);
  return values.empty() ? std::pair{0.0, 1.0} : std::pair{*low, *high};
}

/// Curvature, twist or elongation of the segments of one dresspack at one time.
struct Along {
  std::string title;
  std::vector<double> value;
};

std::array<Along, 3> deformation_at(const FileReader& strain, std::size_t sample, std::size_t first,
                                    std::size_t count) {
  std::array<Along, 3> all{{{"curvature [1/m]", {}}, {"twist [deg/m]", {}}, {"elongation [%]", {}}}};
  std::vector<double> curvature, twist, elongation;
  strain.read_rows("/deformation/curvature", sample, 1, curvature);
  strain.read_rows("/deformation/twist", sample, 1, twist);
  strain.read_rows("/deformation/elongation", sample, 1, elongation);
  for (std::size_t k = first; k < first + count; ++k) {
    all[0].value.push_back(std::hypot(curvature[2 * k], curvature[2 * k + 1]));
    all[1].value.push_back(degrees * twist[k]);
    all[2].value.push_back(percent * elongation[k]);
  }
  return all;
}

/// Returns three panels, one above the other, from the base clamp to the tool clamp.
std::string deformation_chart(const std::array<Along, 3>& all, const std::vector<double>& lengths,
                              const std::string& title) {
  constexpr double height = 120, gap = 18, heading = 26;
  const PlotAxis x{"base clamp   \u2192   along the dresspack [m]   \u2192   tool clamp", 0, sum_of(lengths)};
  Picture picture(chart_width, heading + 3 * (height + gap) + x_axis_height, title, title);
  picture.text(chart_left, 15, title, "note");
  for (std::size_t p = 0; p < all.size(); ++p) {
    const auto [low, high] = extremes(all[p].value);
    const Panel panel{chart_left, heading + static_cast<double>(p) * (height + gap),     chart_panel, height,
                      x,          linear_axis(all[p].title, std::min(low, 0.0), high, 4)};
    panel.draw_axes(picture, p + 1 == all.size());
    std::vector<std::pair<double, double>> points;
    double begin = 0;
    for (std::size_t k = 0; k < lengths.size(); ++k) {
      points.emplace_back(panel.across(begin + lengths[k] / 2), panel.down(all[p].value[k]));
      begin += lengths[k];
    }
    picture.curve(points, "curve");
  }
  return picture.svg();
}

std::string deformation_figure(const JobFiles& files, std::optional<double> time) {
  const FileReader strain(files.strain, strain_format());
  const auto worst = worst_if_known(files);
  const std::vector<double> times = strain.read<double>("/time");
  const std::size_t sample = nearest_sample(times, time.value_or(worst ? worst->time : 0));
  const std::vector<std::size_t> of_segment = dresspack_of_segments(strain);
  const std::vector<double> lengths = strain.read<double>("/segment/length");
  const std::size_t dresspack = worst ? of_segment[worst->segment] : 0;
  const auto range = std::equal_range(of_segment.begin(), of_segment.end(), dresspack);
  const auto first = static_cast<std::size_t>(range.first - of_segment.begin());
  const auto count = static_cast<std::size_t>(range.second - range.first);
  const std::string name = dresspack_names(strain)[dresspack];
  const auto begin = lengths.begin() + static_cast<std::ptrdiff_t>(first);
  return deformation_chart(
      deformation_at(strain, sample, first, count), {begin, begin + static_cast<std::ptrdiff_t>(count)},
      fmt::format("Deformation of the {} at {:.2f} s", name.empty() ? "dresspack" : name, times[sample]));
}

std::string curvature_figure(const JobFiles& files) {
  const Worst worst = worst_of(files.life);
  const FileReader strain_file(files.strain, strain_format()), life(files.life, life_format());
  const KnownHistory history = known_history(life, &strain_file);
  const std::vector<double>& strain = history.strain;
  const std::vector<double> all = strain_file.read<double>("/deformation/curvature");
  const std::size_t segments = strain_file.rows("/segment/length");
  std::vector<double> curvature;
  for (std::size_t k = 0; k < strain.size(); ++k) {
    const double* at = &all[2 * (k * segments + worst.segment)];
    curvature.push_back(std::hypot(at[0], at[1]));
  }
  const auto [low, high] = extremes(strain);
  const auto [straightest, most] = extremes(curvature);
  const Panel panel{chart_left,
                    10,
                    chart_panel,
                    420,
                    linear_axis("curvature of the segment [1/m]", std::min(straightest, 0.0), most, 9),
                    linear_axis("strain [%]", percent * low, percent * high)};
  const std::string words = fmt::format("{}, segment {} from the tool", history.words(), worst.from_tool);
  Picture picture(chart_width, panel.bottom() + x_axis_height, "Strain of the worst wire over curvature", words);
  panel.draw_axes(picture);
  picture.text(panel.left + 6, panel.top + 12, words, "note");
  std::vector<std::pair<double, double>> points;
  for (std::size_t k = 0; k < strain.size(); ++k)
    points.emplace_back(panel.across(curvature[k]), panel.down(percent * strain[k]));
  picture.curve(points, "curve");
  return picture.svg();
}

std::string bending_figure(const JobFiles& files) {
  const auto worst = worst_if_known(files);
  if (!worst) return bending_chart(files.strain, 0);
  return bending_chart(files.strain,
                       dresspack_of_segments(FileReader(files.strain, strain_format())).at(worst->segment));
}

std::string scene_figure(const JobFiles& files, std::optional<double> time) {
  std::optional<MarkedPlace> place;
  if (kind_of(files.life) != FileKind::absent) place = marked_place(FileReader(files.life, life_format()));
  return scene_picture(files.motion, time.value_or(place ? place->time : 0), place ? place->from_tool : 0,
                       place ? place->dresspack : "");
}

std::string chart(Figure what, const JobFiles& files, std::optional<double> time) {
  switch (what) {
    case Figure::strain:
      return needed(strain_chart(read_life(files.life, files.strain)), files.life);
    case Figure::cycles:
      return needed(cycle_chart(read_life(files.life)), files.life);
    case Figure::damage:
      return needed(segment_chart(read_life(files.life), worst_of(files.life).from_tool), files.life);
    case Figure::deformation:
      return deformation_figure(files, time);
    case Figure::curvature:
      return curvature_figure(files);
    case Figure::bending:
      return bending_figure(files);
    case Figure::scene:
      return scene_figure(files, time);
  }
  return {};
}

}  // namespace

std::filesystem::path life_in(const std::filesystem::path& folder) {
  const std::filesystem::path life = folder / "life.h5";
  if (kind_of(life) == FileKind::absent)
    throw InputError({folder.string()}, "holds no life.h5", "name the folder of a job that is done: runs/STUDY/JOB");
  return life;
}

JobFiles job_files(const std::filesystem::path& place) {
  const bool is_folder = kind_of(place) == FileKind::folder;
  const std::filesystem::path folder = is_folder ? place : place.parent_path();
  JobFiles files{folder / "motion.h5", folder / "strain.h5", folder / "life.h5"};
  if (is_folder) return files;
  const Format* format = format_of(place);
  if (!format)
    throw InputError({place.string()}, "is neither a job's folder nor one of its files",
                     "name a folder below runs/, or a motion.h5, strain.h5 or life.h5");
  (format == &motion_format() ? files.motion : format == &strain_format() ? files.strain : files.life) = place;
  return files;
}

void check_of_one_job(const JobFiles& files) {
  const auto exists = [](const std::filesystem::path& file) { return kind_of(file) != FileKind::absent; };
  const auto check = [](bool fits, const std::filesystem::path& file, const std::filesystem::path& input) {
    if (!fits)
      throw InputError({file.string()}, fmt::format("was not made from {} (they are not of one job)", input.string()),
                       "run the stages again, one after the other");
  };
  const auto check_input = [&](const Format& format, const std::filesystem::path& file,
                               const std::filesystem::path& input) {
    if (exists(file) && exists(input))
      check(FileReader(file, format, FileReader::Scope::attributes).text_attribute("input_sha256") ==
                sha256_as_checked(input),
            file, input);
  };
  check_input(life_format(), files.life, files.strain);
  check_input(strain_format(), files.strain, files.motion);
  if (exists(files.strain) || !exists(files.life) || !exists(files.motion)) return;
  const FileReader life(files.life, life_format(), {"/time", "/segment/length"}),
      motion(files.motion, motion_format(), {"/time", "/segment/length"});
  check(life.rows("/time") == motion.rows("/time") && life.rows("/segment/length") == motion.rows("/segment/length"),
        files.life, files.motion);
}

std::string figure(Figure what, const JobFiles& files, std::optional<double> time) {
  if (what != Figure::cycles && what != Figure::damage) check_of_one_job(files);  // these two are of life.h5 alone
  return standalone(chart(what, files, time));
}

}  // namespace dresslife::pipeline
