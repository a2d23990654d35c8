// A life file in the form that dresslife-fatigue writes. Formulas give its numbers. For tests of ranking and report.
#pragma once

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "pipeline/base/constants.h"
#include "pipeline/files/files.h"
#include "pipeline/life/unvalidated_modes.h"

namespace dresslife::pipeline {

struct SampleLife {
  double repeats = 12000;  ///< life of the worst wire; infinite: no damage
  int segments = 50, lines = 28, samples = 4500;
  int worst_from_tool = 3;
  bool causes = false;          ///< whether the file contains the damage by joint
  double hose_hours = 0;        ///< until the hose's wall cracks; 0: not evaluated
  std::string unvalidated{};    ///< unvalidated_text(); empty: only the wall, if it has hours
  std::string wall_response{};  ///< empty: no wall
  double planned_hours =
      0;  ///< time until in 10 % of cases a conductor has lost its share of wires at one place; 0: no plan
  double robot_life_hours = 0;  ///< fatigue.robot_life_hours; 0: no robot moves
  std::string life_response{};  ///< LifeResponse::text(); empty: nothing is uncertain. Used only with planned_hours
  bool wires = true;            ///< false: the dresspack contains no wires
  std::vector<std::string>
      dresspacks{};  ///< two names: each dresspack has half of the segments, the worst wire lies in the second
  std::vector<std::pair<std::string, double>> more_sites{};  ///< sites in the worst segment: path, damage
  std::vector<std::pair<std::string, double>> conductors{};  ///< path, repeats until it fails at one place
  std::string worst_component = "signal cable 3/conductor 2/layer 1/wire 17";
  std::string line_name = "weld spot";
  std::string job = "robot:\n  name: <R&D> \"two\"\n";
  std::string warnings{};  ///< warnings_text(); empty: none
};

/// Writes a consistent life file: the shares add up, and the named worst wire has the largest damage.
inline void write_sample_life(const std::filesystem::path& file, const SampleLife& sample = {}) {
  constexpr double rate = 25, free_length = 2.4;  // [Hz], [m]
  const bool damaged = sample.wires && std::isfinite(sample.repeats);
  const double damage = damaged ? 1 / sample.repeats : 0;
  const auto segments = static_cast<std::size_t>(sample.segments), lines = static_cast<std::size_t>(sample.lines),
             samples = static_cast<std::size_t>(sample.samples);
  const std::size_t worst_segment = segments - static_cast<std::size_t>(sample.worst_from_tool);

  std::vector<double> time(samples), strain(samples), line_damage(lines, 0.0), rate_row(samples, 0.0);
  std::vector<std::int32_t> step(samples);
  std::vector<std::string> text;
  for (std::size_t line = 0; line < lines; ++line)
    text.push_back(line % 7 == 0 ? "home"
                                 : sample.line_name + " " + std::to_string(line) + ": swing the gun past the fixture");
  for (std::size_t k = 0; k < samples; ++k) {
    time[k] = static_cast<double>(k) / rate;
    // Moves have different lengths. The program runs through its lines about three times.
    const double progress =
        3.0 * static_cast<double>(lines * k) / static_cast<double>(samples) + 0.4 * std::sin(0.3 * time[k]);
    step[k] = static_cast<std::int32_t>(std::clamp(progress, 0.0, 3.0 * sample.lines - 1)) % sample.lines;
    const double swing = std::sin(1.1 * time[k]) + 0.5 * std::sin(2.7 * time[k] + 1) + (step[k] % 5 == 2 ? 1.2 : 0.0);
    strain[k] = damaged || !sample.wires ? 0.004 * swing * (sample.wires ? 1 : 0) : 1e-5 * swing;
  }
  std::vector<std::uint32_t> cycle_site, begin, end;
  std::vector<double> range, mean, count, cycle_damage;
  double total = 0;
  for (std::size_t k = 0; damaged && k < 240; ++k) {
    cycle_site.push_back(0);
    range.push_back(0.018 * std::exp(-0.018 * static_cast<double>(k)));
    mean.push_back(0.001);
    count.push_back(k % 11 == 3 ? 0.5 : 1);
    begin.push_back(static_cast<std::uint32_t>(k * 17));
    end.push_back(static_cast<std::uint32_t>((k * 2654435761u) % samples));
    cycle_damage.push_back(count.back() * std::pow(range.back(), 3));
    total += cycle_damage.back();
  }
  for (std::size_t k = 0; k < cycle_damage.size(); ++k) {
    cycle_damage[k] *= damage / total;
    rate_row[end[k]] += cycle_damage[k];
    line_damage[static_cast<std::size_t>(step[end[k]])] += cycle_damage[k];
  }
  std::vector<double> segment_damage(segments, 0.0);
  for (std::size_t k = 0; k < segments; ++k) {
    const double distance = std::abs(static_cast<double>(k) - static_cast<double>(worst_segment));
    segment_damage[k] = damage * (std::exp(-0.5 * distance) + 1e-4 * std::pow(std::sin(0.4 * distance), 2));
  }
  segment_damage[worst_segment] = damage;

  const std::size_t sites = sample.wires ? 1 + sample.more_sites.size() : 0;
  const auto put = [](auto& writer, const char* path, const auto& values) {
    using Value = typename std::decay_t<decltype(values)>::value_type;
    writer.append(path, std::span<const Value>(values));
  };
  FileWriter writer(file, life_format());
  writer.set_axis("level", 3);
  writer.set_axis("sample", samples);
  put(writer, "/site/segment", std::vector<std::int32_t>(sites, static_cast<std::int32_t>(worst_segment)));
  std::vector<std::string> components(sites, sample.worst_component);
  std::vector<double> damages(sites, damage);
  for (std::size_t k = 1; k < sites; ++k) std::tie(components[k], damages[k]) = sample.more_sites[k - 1];
  put(writer, "/site/component", components);
  put(writer, "/site/helix", std::vector<double>(9 * sites, 0.0));
  put(writer, "/site/fibre", std::vector<double>(2 * sites, 0.0));
  put(writer, "/site/material", std::vector<std::string>(sites, "copper"));
  put(writer, "/damage", damages);
  put(writer, "/life", std::vector<double>(sites, damaged ? sample.repeats : infinity));
  put(writer, "/cycles/site", cycle_site);
  put(writer, "/cycles/range", range);
  put(writer, "/cycles/mean", mean);
  put(writer, "/cycles/count", count);
  put(writer, "/cycles/begin", begin);
  put(writer, "/cycles/end", end);
  put(writer, "/cycles/damage", cycle_damage);
  for (std::size_t k = 0; k < segments; ++k)
    put(writer, "/damage_rate", k == worst_segment ? rate_row : std::vector<double>(samples, 0.0));
  put(writer, "/segment/length", std::vector<double>(segments, free_length / sample.segments));
  put(writer, "/segment/worst_site", std::vector<std::uint32_t>(segments, sample.wires ? 0u : 4294967295u));
  put(writer, "/segment/damage", segment_damage);
  const std::vector<std::string> layers{"signal cable/conductor/layer 1/wire", "signal cable/conductor/layer 2/wire"};
  put(writer, "/layer/component", sample.wires ? layers : std::vector<std::string>{});
  put(writer, "/layer/worst_site", std::vector<std::uint32_t>(sample.wires ? 2 : 0, 0));
  put(writer, "/layer/damage", sample.wires ? std::vector<double>{damage, damage / 3} : std::vector<double>{});
  if (!sample.conductors.empty()) {
    std::vector<std::string> paths;
    std::vector<double> lives;
    for (const auto& [path, life] : sample.conductors) paths.push_back(path), lives.push_back(life);
    put(writer, "/conductor/component", paths);
    put(writer, "/conductor/place_life", lives);
  }
  put(writer, "/worst/strain", strain);
  put(writer, "/time", time);
  put(writer, "/program/step", step);
  put(writer, "/program/text", text);
  put(writer, "/program/damage", line_damage);

  if (sample.causes) {  // two joints and carrying: 80, -10 and 30 % of the damage of every line
    writer.set_axis("cause", 3);
    put(writer, "/joint/name", std::vector<std::string>{"joint_5", "joint_6", "carrying"});
    put(writer, "/joint/damage", std::vector<double>{0.8 * damage, -0.1 * damage, 0.3 * damage});
    std::vector<double> by_line;
    for (const double of : line_damage) by_line.insert(by_line.end(), {0.8 * of, -0.1 * of, 0.3 * of});
    put(writer, "/program/joint_damage", by_line);
    std::vector<std::string> clamps{"base clamp", "tool clamp"};
    std::vector<double> near{damage, 3 * damage};
    if (!sample.dresspacks.empty()) {
      for (std::string& clamp : clamps) clamp = sample.dresspacks[1] + ", " + clamp;
      clamps.insert(clamps.begin(), {sample.dresspacks[0] + ", base clamp", sample.dresspacks[0] + ", tool clamp"});
      near.insert(near.begin(), {damage / 2, damage / 8});
    }
    put(writer, "/clamp/name", clamps);
    put(writer, "/clamp/damage", near);
    writer.attribute("joint_explained", 0.75);
    writer.attribute("worst_joint", damaged ? "joint_5" : "");
    writer.attribute("worst_joint_share", damaged ? 0.8 : 0.0);
  }
  if (!sample.dresspacks.empty()) {
    writer.set_axis("dresspack", 2);
    std::vector<std::int32_t> of_segment(segments, 0);
    std::fill(of_segment.begin() + sample.segments / 2, of_segment.end(), 1);
    put(writer, "/segment/dresspack", of_segment);
    put(writer, "/dresspack/name", sample.dresspacks);
    put(writer, "/dresspack/worst_site", std::vector<std::uint32_t>{4294967295u, 0});
    put(writer, "/dresspack/damage", std::vector<double>{damage / 8, damage});
    writer.attribute("worst_dresspack", sample.dresspacks[1]);
  }
  const double repeats = damaged ? sample.repeats : infinity, seconds = time.back();
  const auto hours = [&](double times) { return times * seconds / 3600; };
  writer.attribute("life_repeats", repeats);
  writer.attribute("life_hours", hours(repeats));
  writer.attribute("life_months", hours(repeats) / 80 * 7 * 12 / 365.25);
  writer.attribute("damage_per_repeat", damage);
  writer.attribute("repeat_seconds", seconds);
  writer.attribute("life_repeats_all_stick", repeats / 400);
  writer.attribute("life_repeats_all_free", repeats * 1.5);
  writer.attribute("life_hours_all_stick", hours(repeats / 400));
  writer.attribute("life_hours_all_free", hours(repeats * 1.5));
  writer.attribute("worst_site", sample.wires ? 0.0 : -1.0);
  writer.attribute("worst_segment_from_tool", sample.wires ? static_cast<double>(sample.worst_from_tool) : 0.0);
  writer.attribute("worst_position_from_tool",
                   sample.wires ? (sample.worst_from_tool - 0.5) * free_length / sample.segments : 0.0);
  writer.attribute("worst_component", sample.wires ? sample.worst_component : "");
  writer.attribute("worst_time", damaged ? time[end[0]] : 0.0);
  writer.attribute("worst_step", damaged ? text[static_cast<std::size_t>(step[end[0]])] : "");
  if (sample.planned_hours > 0) {
    for (const auto& [percentile, factor] : {std::pair{"p10", 1.0}, std::pair{"p50", 1.5}, std::pair{"p90", 2.5}}) {
      writer.attribute(std::string("life_hours_") + percentile, factor * sample.planned_hours);
      writer.attribute(std::string("first_wire_life_hours_") + percentile, factor * sample.planned_hours / 4);
    }
    if (!sample.life_response.empty()) {
      for (const auto& [percentile, factor] : {std::pair{"p10", 2.0}, std::pair{"p50", 2.5}, std::pair{"p90", 3.0}})
        writer.attribute(std::string("scatter_life_hours_") + percentile, factor * sample.planned_hours);
      writer.attribute("life_response", sample.life_response);
      writer.attribute("life_shares", "friction_inside 53 %; strength 29 %; other 18 %");
      writer.attribute("best_test", "friction_inside");
      writer.attribute("best_test_life_hours_p10", 1.1 * sample.planned_hours);
      writer.attribute("best_test_life_hours_p90", 1.7 * sample.planned_hours);
      writer.attribute("measure_next", "friction_inside");
      writer.attribute("measure_next_share", 0.53);
    }
    writer.attribute("failing_mode", "wires of signal cable");
    writer.attribute("failing_mode_share", 0.75);
    for (const auto& [percentile, factor] : {std::pair{"p10", 1.0}, std::pair{"p50", 1.5}, std::pair{"p90", 2.5}}) {
      writer.attribute(std::string("life_hours_") + percentile + "_all_glued", factor * sample.planned_hours / 10);
      writer.attribute(std::string("life_hours_") + percentile + "_all_free", factor * sample.planned_hours * 10);
    }
    writer.attribute("life_months_p10", sample.planned_hours / 80 * 7 * 12 / 365.25);
    if (sample.robot_life_hours > 0) writer.attribute("robot_life_hours", sample.robot_life_hours);
    writer.attribute("failing_conductor", "signal cable 3/conductor 2");
    writer.attribute("failing_position_from_tool", 0.75);
  }
  std::string unvalidated = sample.unvalidated;
  if (sample.hose_hours > 0) {
    UnvalidatedMode wall;
    wall.mode = UnvalidatedMode::wall, wall.place = "hose 5", wall.step = text[1];
    wall.hours[1] = sample.hose_hours, wall.time = time[samples / 3];
    wall.segment_from_tool = 2, wall.position_from_tool = 1.5 * free_length / sample.segments;
    unvalidated = unvalidated_text({wall});
  }
  if (!sample.wall_response.empty()) writer.attribute("wall_response", sample.wall_response);
  writer.attribute("unvalidated_modes", unvalidated);
  writer.attribute("not_evaluated", sample.unvalidated.empty() ? "" : "water hose, kinks");
  if (!sample.warnings.empty()) writer.attribute("warnings", sample.warnings);
  writer.attribute("job", sample.job);
  writer.attribute(
      "history",
      std::string("dresslife-sim 1: dresslife-sim job.yaml\ndresslife-fatigue 1: dresslife-fatigue strain.h5"));
  writer.attribute("input_sha256", std::string(64, '0'));
  writer.commit();
}

}  // namespace dresslife::pipeline
