#include "strain/memory.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <set>

#include "pipeline/base/errors.h"
#include "pipeline/base/limits.h"
#include "pipeline/files/files.h"
#include "pipeline/files/motion_layout.h"
#include "pipeline/job/job.h"
#include "strain/construction.h"
#include "strain/history.h"
#include "strain/long_waves.h"
#include "strain/slip.h"
#include "strain/starts.h"
#include "strain/strain_file.h"
#include "strain/variations.h"

namespace dresslife::strain {
namespace {

constexpr double value = sizeof(double);

/// Counts of the construction of one dresspack.
struct Counts {
  double widest_bundle = 0, bundles = 0, cables = 0, rubbing = 0, loose = 0;
  double lines = 0;       ///< pairs of a layer of wires and a cable that may lie in long waves
  double clamp_rows = 0;  ///< histories of parts that slide from clamp to clamp, in the job and in the free bound
  double depth = 0;       ///< levels
  double most_fibres = 1;
};

Counts counts_of(const pipeline::Dresspack& dresspack, const pipeline::Strain& settings, double length) {
  const Construction construction(dresspack, settings.kinematics);
  const auto own = plan_slip(construction, settings.slip, length);
  const auto free = plan_slip(construction, {pipeline::Slip::free}, length);
  Counts counts;
  counts.depth = construction.levels();
  counts.bundles = static_cast<double>(construction.bundles().size());
  counts.most_fibres = std::max(1, settings.surface_fibres);
  // Cables of the shipped programs bend in up to six waves over their length. Eight waves are on the safe side.
  const std::vector<double> limits(construction.cables().size(), believable_evening * length / 8);
  const std::vector<int> long_waves = LongWaves::layers_of(construction, free, limits);
  std::set<std::pair<int, int>> lines;
  for (const Bundle& bundle : construction.bundles()) {
    double wires = 0;
    for (const int k : bundle.wire_layers) {
      wires += construction.layers()[k].count;
      if (std::ranges::find(long_waves, k) != long_waves.end()) lines.emplace(k, construction.cable_of(bundle.part));
      for (const auto* plan : {&own, &free})
        if ((*plan)[k].sliding == Sliding::clamp_to_clamp) counts.clamp_rows += waves_per_layer;
    }
    counts.widest_bundle = std::max(counts.widest_bundle, wires);
  }
  counts.lines = static_cast<double>(lines.size());
  for (const Part& part : construction.parts()) {
    const Layer& layer = construction.layers()[part.layer];
    if (layer.is_cable()) {
      counts.rubbing += pipeline::rubs(settings.slip.front()) && (layer.friction > 0 || layer.jacket_stiffness > 0);
      counts.cables += 1;
      counts.loose += free[part.layer].loose;
      continue;
    }
    for (const auto* plan : {&own, &free})
      if ((*plan)[part.layer].sliding == Sliding::clamp_to_clamp) counts.clamp_rows += 1;
  }
  return counts;
}

/// Numbers of parts of all levels and of wires in these components, computed without listing them.
struct Parts {
  double parts = 0, wires = 0;
};
Parts parts_in(const std::vector<pipeline::Component>& components) {
  Parts sum;
  for (const pipeline::Component& component : components) {
    const Parts inside = parts_in(component.components);
    const bool wire = is_wire(component);
    sum.parts += component.count * (wire ? 0 : 1 + inside.parts);
    sum.wires += component.count * (wire ? 1 : inside.wires);
  }
  return sum;
}

}  // namespace

void check_counts(const pipeline::Where& where, double samples, double sites) {
  if (!(samples <= most_numbered))
    throw pipeline::InputError(
        where, fmt::format("holds {:.4g} samples (strain.h5 numbers at most {:.0f})", samples, most_numbered),
        "choose a lower simulation.sample_rate_Hz, or split the motion");
  if (!(sites <= most_numbered))
    throw pipeline::InputError(
        where,
        fmt::format("has {:.4g} sites, fibres of wires in segments (strain.h5 numbers at most {:.0f})", sites,
                    most_numbered),
        "choose fewer simulation.segments or strain.surface_fibres, or split the dresspack");
}

pipeline::MemoryNeed memory_of(const pipeline::FileReader& motion, const pipeline::Job& job, std::size_t threads) {
  constexpr double program = 18 << 20;  // program, libraries and a job: the smallest jobs take 18.8 MB in total
  const std::size_t samples = motion.rows("/time"), segments = motion.rows("/segment/length");
  const double rows = static_cast<double>(samples), workers = static_cast<double>(threads);
  const std::vector<double> lengths = motion.read<double>("/segment/length");
  pipeline::MemoryNeed need;
  need.add(program, "the program");
  if (samples == 0 || segments == 0) return need;  // write_strain() reports it

  // For each span: lists of parts and wires with their names.
  double sites = 0, listed = 0;
  constexpr double of_a_part = 400, of_a_wire = 120;
  const std::vector<pipeline::MotionSpan> spans = pipeline::motion_spans(motion);
  for (const pipeline::MotionSpan& span : spans) {
    if (span.dresspack >= job.dresspacks.size()) continue;  // write_strain() reports it
    const Parts parts = parts_in(job.dresspacks[span.dresspack].dresspack.components);
    sites += static_cast<double>(span.segments) * parts.wires * std::max(1, job.strain.surface_fibres);
    listed += of_a_part * parts.parts + of_a_wire * parts.wires;
  }
  check_counts(motion.where(), rows, sites);
  need.add(listed, "parts and wires", "fewer of them (dresspack.components)");
  if (need.megabytes() > static_cast<double>(pipeline::installed_memory_mb())) return need;  // too many for the lists

  // Each other set of cable places is kept in addition to the job's own, each with four frictions and two bounds. Other starts
  // have one friction.
  const double laid = 1 + static_cast<double>(placements_at_most(job)), frictions = job.uncertainty.enabled ? 6 : 1;
  const double room = static_cast<double>(default_history_bytes) / 2 /
                      (static_cast<double>(spans.size()) * (laid + static_cast<double>(other_starts_at_most(job))));
  double cable_rows = 0, bent_rows = 0, line_rows = 0, part_rows = 0, found = 0;
  for (const pipeline::MotionSpan& span : spans) {
    if (span.dresspack >= job.dresspacks.size()) continue;
    const double length =
        std::accumulate(lengths.begin() + static_cast<std::ptrdiff_t>(span.first_segment),
                        lengths.begin() + static_cast<std::ptrdiff_t>(span.first_segment + span.segments), 0.0);
    const Counts counts =
        counts_of(job.dresspacks[span.dresspack].dresspack, job.strain, std::max(length, clamped_length(job)));
    const double in_span = static_cast<double>(span.segments);
    const double begun = laid + (counts.loose > 1 ? static_cast<double>(other_starts_at_most(job)) : 0);
    // Strain of each cable and the three strains that make its force; strain and pressing along a cable with friction
    // (cable_paths.h); curvature along a loose cable (segment_rows.h), and the rows of one segment.
    cable_rows += begun * (4 * counts.cables + in_span * 1.5 * counts.rubbing + 2 * counts.loose);
    cable_rows += (begun - laid + 1) * in_span * counts.rubbing / value;  // sides that rub (cable_rubbing.h)
    // Stores that exceed their room are in files (segment_rows.h). They hold the curvature of loose cables and of the hose
    // (evaluation.cpp), and strains of wires in long waves (long_waves.h). Each thread also holds one wire in long waves.
    const auto kept = [&](double of, double share) { return of * rows * value <= share * room ? of : 0; };
    bent_rows += begun * kept(in_span * counts.loose, 1);
    if (counts.loose < counts.cables) bent_rows += begun * kept(in_span, 1);
    line_rows += laid * frictions * kept(in_span * counts.lines, share_of_lines);
    cable_rows += counts.lines > 0 ? workers * in_span : 0;
    part_rows = std::max(part_rows, laid * frictions * counts.clamp_rows);
    // Per thread: states of a part and of its parent, and the held strains of every level.
    constexpr double states = 4, in_single = 3, turned = 1 + phases_per_pitch;
    found = std::max(
        found, workers * (2 * states * (counts.depth + 1) + in_single + laid * frictions * counts.depth * turned));
    // Bundles that wait to be written: turning points of every site, in lists and in rows (evaluation.cpp).
    constexpr double turns_of_samples = 0.25, point = 16;
    const double ahead = threads == 1 ? 1 : std::min(counts.bundles, 2 * workers);
    found = std::max(found, ahead * counts.widest_bundle * counts.most_fibres * turns_of_samples * point / value);
  }
  const std::string sampling = "a lower simulation.sample_rate_Hz, or split the motion";
  need.add(
      std::min(rows * static_cast<double>(segments) * sizeof(Deformation), static_cast<double>(default_history_bytes)),
      fmt::format("histories of {} segments", segments), sampling);
  need.add(bent_rows * rows * value, "where hose and loose cables bend", sampling);
  need.add(line_rows * rows * value, "strains of wires in long waves", sampling);
  need.add(cable_rows * rows * value, "what cables do in each segment", "fewer simulation.segments, " + sampling);
  need.add((part_rows + found) * rows * value, "what parts do at each sample", sampling);
  const std::map<std::string, std::size_t> axes{{"sample", samples},
                                                {"segment", segments},
                                                {"clamp", motion.length("clamp")},
                                                {"joint", motion.length("joint")},
                                                {"level", 4},
                                                {"site", static_cast<std::size_t>(sites)},
                                                {"probe", 2 * segments}};
  need.add(pipeline::file_buffers(pipeline::strain_format(), axes) +
               pipeline::file_buffers(pipeline::motion_format(), axes) / 4,  // a quarter of motion.h5 is read
           "what is being read and written");
  return need;
}

}  // namespace dresslife::strain
