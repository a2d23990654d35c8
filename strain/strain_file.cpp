#include "strain/strain_file.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <list>
#include <memory>
#include <numeric>
#include <span>

#include "pipeline/base/warning_words.h"
#include "pipeline/cable/cable_bending.h"
#include "pipeline/cable/excess.h"
#include "pipeline/cable/overlap.h"
#include "pipeline/cable/stiffness.h"
#include "pipeline/job/job.h"
#include "pipeline/job/line_key.h"
#include "pipeline/resolve/plausible_job.h"
#include "strain/evaluation.h"
#include "strain/motion_reader.h"
#include "strain/passage.h"
#include "strain/shortening.h"
#include "strain/starts.h"
#include "strain/variations.h"

namespace dresslife::strain {
namespace {

using pipeline::FileReader;
using pipeline::FileWriter;
using pipeline::Warning;
using pipeline::WarningKind;

constexpr double first_pass_share = 0.05;  // share of the work, for the progress display
// Lives of three programs are 14 to 30 % too long at errors of 1.4 to 1.9 % (strain/measurements.md). At 1 % the life changes by about a
// sixth: less than any other uncertainty here.
constexpr double believable_mesh_error = 0.01;
constexpr double loose_pass_share = 0.5;  // first_pass_share with loose cables
constexpr double own_work_share = 0.75;   // share of the work without other stiffnesses of the hose
// Length of the end of the motion before the repeat that counts [s]. In it the first places of loose cables lose their influence
// (W42). The last start of robot 1 comes to its rest after 160 s. Cables of short programs that reach a cycle earlier stop.
constexpr double lead_in_time = 180;
// Time before the first sample at which variations continue from the first start [s]. With 170 s the lives of robot 1 and hard
// are the same. With 30 s one life of ten differs by 0.85 of a decade.
constexpr double lead_in_varied = 90;

void append_deformation(FileWriter& file, std::span<const Deformation> block) {
  std::vector<double> curvature, twist, elongation;
  for (const Deformation& d : block) {
    curvature.insert(curvature.end(), {d.curvature1, d.curvature2});
    twist.push_back(d.twist);
    elongation.push_back(d.elongation);
  }
  file.append("/deformation/curvature", curvature);
  file.append("/deformation/twist", twist);
  file.append("/deformation/elongation", elongation);
}

/// Appends sites under one group and counts the turning points.
class SiteWriter {
 public:
  SiteWriter(FileWriter& file, std::string group, const std::vector<std::unique_ptr<Evaluation>>& evaluations)
      : file_(file), group_(std::move(group)) {
    std::size_t path = 0, material = 0;
    for (const auto& evaluation : evaluations) {
      path = std::max(path, evaluation->longest_path());
      material = std::max(material, evaluation->longest_material());
    }
    file_.set_text_width(group_ + "/site/component", path);
    file_.set_text_width(group_ + "/site/material", material);
    put("/reversal/offset", std::vector<std::uint64_t>{0});
  }

  void append(const SiteRows& rows) {
    put("/site/segment", rows.segment);
    put("/site/component", rows.component);
    put("/site/helix", rows.helix);
    put("/site/fibre", rows.fibre);
    put("/site/material", rows.material);
    offsets_.clear();
    for (const std::uint64_t count : rows.turning) offsets_.push_back(total_ += count);
    put("/reversal/offset", offsets_);
    put("/reversal/strain", rows.strain);
    put("/reversal/sample", rows.sample);
  }

 private:
  template <class T>
  void put(const std::string& dataset, const std::vector<T>& rows) {
    file_.append(group_ + dataset, std::span<const T>(rows));
  }

  FileWriter& file_;
  std::string group_;
  std::uint64_t total_ = 0;
  std::vector<std::uint64_t> offsets_;
};

/// The job's motion with another stiffness of the hose.
struct OtherMotion {
  MotionReader reader;
  double z;  ///< of hose_stiffness
};

std::vector<OtherMotion> other_motions(const FileReader& motion, const pipeline::Job& job) {
  std::vector<OtherMotion> all;
  if (!job.uncertainty.enabled) return all;
  for (const std::string group : {"softer", "stiffer"})
    if (motion.has("/" + group + "/segment/position"))
      all.push_back({MotionReader(motion, job, "/" + group), motion.number_attribute(group + "_z")});
  return all;
}

/// Appends the results of the variations in one motion after those of the motions before.
class VariationWriter {
 public:
  /// before: number of variations in the file.
  VariationWriter(FileWriter& file, const Variations& variations, std::size_t before) : file_(file), before_(before) {
    if (variations.empty()) return;
    std::vector<double> z;
    for (const Variations::Point& point : variations.points()) z.insert(z.end(), point.begin(), point.end());
    file.append("/variation/z", z);
    std::vector<std::int32_t> inside;
    for (const pipeline::Inside one : variations.inside()) inside.push_back(static_cast<std::int32_t>(one));
    file.append("/variation/inside", inside);
    file.append("/variation/rest", variations.rests());
    file.append("/variation/stiffness", std::vector<double>(inside.size(), variations.stiffness()));
    put()(0, {}, {});  // a dresspack without wires has no rows
  }

  /// Precondition: all samples were added to the variations.
  void write_pulls(const Variations& variations) {
    for (const VariedPulls& of : variations.pulls()) {
      if (of.tension.empty()) continue;
      file_.append("/variation/tension", of.tension);
      file_.append("/variation/tension_sample", of.sample);
      file_.append("/variation/tension_place", of.place);
      file_.append("/variation/clamp_moment", of.moment);
      file_.append("/variation/clamp_moment_place", of.moment_place);
      file_.append("/variation/clamp_moment_tension", of.moment_tension);
    }
  }

  Variations::Put put() {
    return [this](std::size_t variation, const std::vector<std::size_t>& sites, const SiteRows& rows) {
      file_.append("/variation/row/variation",
                   std::vector<std::uint32_t>(sites.size(), static_cast<std::uint32_t>(before_ + variation)));
      file_.append("/variation/row/site", std::vector<std::uint32_t>(sites.begin(), sites.end()));
      file_.append("/variation/row/turning", std::vector<std::uint32_t>(rows.turning.begin(), rows.turning.end()));
      file_.append("/variation/strain", rows.strain);
    };
  }

 private:
  FileWriter& file_;
  std::size_t before_;
};

void copy_program(const FileReader& motion, FileWriter& strain) {
  strain.append("/time", motion.read<double>("/time"));
  strain.append("/segment/length", motion.read<double>("/segment/length"));
  if (motion.has("/segment/dresspack")) {
    strain.set_axis("dresspack", motion.rows("/dresspack/name"));
    strain.append("/segment/dresspack", motion.read<std::int32_t>("/segment/dresspack"));
    strain.append("/dresspack/name", motion.read<std::string>("/dresspack/name"));
  }
  strain.append("/program/step", motion.read<std::int32_t>("/program/step"));
  strain.append("/program/text", motion.read<std::string>("/program/text"));
  if (motion.has("/rubbing/work"))
    for (const char* table :
         {"/rubbing/dresspack", "/rubbing/place", "/rubbing/obstacle", "/rubbing/work", "/rubbing/time"})
      strain.copy(motion, table);
  const char* const joints = "/robot/joint_position";
  if (!motion.has(joints)) return;
  strain.set_axis("joint", motion.row_size(joints));
  std::vector<double> block;
  for (std::size_t first = 0; first < motion.rows(joints); first += motion_block_samples) {
    motion.read_rows(joints, first, std::min(motion_block_samples, motion.rows(joints) - first), block);
    strain.append(joints, block);
  }
}

void check(const FileReader& motion, const pipeline::Job& job, const MotionReader& reader) {
  if (reader.samples() == 0 || reader.lengths().empty())
    throw pipeline::InputError(motion.where(), "holds no samples of a dresspack (nothing to evaluate)",
                               "run dresslife-sim again");
  pipeline::check_lengths(motion, free_lengths(job));
  if (!(reader.step() > 0))
    throw pipeline::InputError(motion.where(), "has a second sample that is not later than the first",
                               "run dresslife-sim again");
}

/// Returns whether a path begins with the name of dresspack d. With a single dresspack every path does.
bool lies_in(const pipeline::Job& job, std::size_t d, const std::string& path) {
  const std::string name = pipeline::name_among(job, d);
  return name.empty() || path.starts_with(name + "/");
}

/// Returns the settings for dresspack d: only its own probes.
pipeline::Strain settings_of(const pipeline::Job& job, std::size_t d) {
  pipeline::Strain settings = job.strain;
  std::erase_if(settings.probes,
                [&](const pipeline::ProbeRequest& probe) { return !lies_in(job, d, probe.component); });
  return settings;
}

void check_probes(const pipeline::Job& job) {
  for (const pipeline::ProbeRequest& probe : job.strain.probes) {
    bool known = false;
    for (std::size_t d = 0; d < job.dresspacks.size(); ++d) known |= lies_in(job, d, probe.component);
    if (!known)
      throw pipeline::InputError(
          {}, fmt::format("strain.probes: '{}' does not begin with the name of a dresspack", probe.component),
          fmt::format("begin it with '{}/'", job.dresspacks.front().name));
  }
}

/// Construction of each dresspack, and one evaluation per span, because each span slips by itself from clamp to clamp.
struct Evaluations {
  std::vector<Construction> constructions;           // (dresspack)
  std::vector<std::unique_ptr<Evaluation>> of_span;  // refer to the constructions
  int levels = 0;                                    // level of the deepest wire

  /// samples: of the whole or the shortened motion. as_given: the same dresspacks without further factors. Loose cables get as many
  /// elements as those of as_given, so that both can be computed side by side.
  Evaluations(const pipeline::Job& job, const MotionReader& reader, std::size_t samples, std::size_t threads,
              const pipeline::StrainFactors& factors, const Scratch& scratch, const Evaluations* as_given = nullptr) {
    for (const pipeline::MountedDresspack& mounted : job.dresspacks) {
      constructions.emplace_back(mounted.dresspack, job.strain.kinematics, factors);
      levels = std::max(levels, constructions.back().levels());
    }
    const std::vector<pipeline::MotionSpan>& spans = reader.spans();
    SpanPlace place;
    std::size_t first = 0;  // first span of the dresspack
    place.levels = levels;
    place.stiffness_factor = reader.stiffness_factor();
    for (std::size_t k = 0; k < spans.size(); ++k) {
      const std::size_t d = spans[k].dresspack;
      if (k == 0 || d != spans[k - 1].dresspack) {
        if (k > 0) place.sites_before = of_span.back()->sites_so_far();
        place.segments_before = spans[k].first_segment;
        place.segments_in_all = 0;
        for (const pipeline::MotionSpan& span : spans)
          if (span.dresspack == d) place.segments_in_all += span.segments;
        place.first_arc = 0;
        first = k;
        place.dresspack = d;
        place.name = pipeline::name_among(job, d);
      }
      place.first_segment = spans[k].first_segment - place.segments_before;
      place.free_tool_end = reader.ends_freely(job, k);
      place.known_ends = reader.known_ends(k);
      const std::vector<std::array<pipeline::BendRelief, 2>> reliefs =
          pipeline::bend_reliefs(job.dresspacks[d].routing);
      for (std::size_t end = 0; end < 2 && k - first < reliefs.size(); ++end)
        place.relief_stiffness[end] = reliefs[k - first][end].length > 0 ? reliefs[k - first][end].stiffness : 0;
      place.clamped_length = pipeline::clamped_length(job);
      const std::vector<double> lengths = reader.lengths_of(spans[k]);
      pipeline::Strain settings = settings_of(job, d);
      if (as_given) settings.cable_elements = static_cast<int>(as_given->of_span[k]->cables().elements_per_segment());
      of_span.push_back(
          std::make_unique<Evaluation>(constructions[d], settings, lengths, samples, threads, place, scratch));
      place.first_arc += std::accumulate(lengths.begin(), lengths.end(), 0.0);
    }
  }
};

std::vector<Warning> restless_warnings(std::size_t samples, double sample_rate) {
  if (samples == 0) return {};
  return {pipeline::warning_of(
      WarningKind::mesh, "",
      fmt::format(
          "loose cables did not come to rest at {} samples: their curvatures there are not those of any balance",
          samples),
      "the hose moves too far from one sample to the next",
      fmt::format("simulation.sample_rate_Hz: {:g}", 2 * sample_rate))};
}

RepeatChange change_of(const Evaluation& evaluation) {
  const CablePaths& cables = evaluation.cables();
  if (!(cables.changed() > 0)) return {};
  const ChangedPlace most = cables.most_changed();
  double longest = 0;
  for (std::size_t k = 0; k < cables.cables(); ++k)
    if (cables.component(k) == cables.component(most.cable)) longest = std::max(longest, cables.path_gain(k)[1]);
  return {cables.changed(),
          evaluation.dresspack(),
          static_cast<std::size_t>(cables.component(most.cable)),
          evaluation.name_of_cable(most.cable),
          evaluation.arcs().front() - evaluation.lengths().front() / 2 + most.arc,
          longest};
}

/// Places of loose cables besides the job's own: of other starts and of variations.
struct OtherPlaces {
  std::size_t all = 0, moving = 0;  ///< moving: they do not end the repeat where they began it
  /// own: the job's own evaluations, which do not count; empty: in another motion.
  void add(const Passage& passage, std::size_t spans, const std::vector<std::unique_ptr<Evaluation>>& own) {
    for (std::size_t span = 0; span < spans; ++span) {
      const auto counts = [&](const Evaluation* of) {
        return of->any_loose() && (own.empty() || !of->cables().shares_loose(own[span]->cables()));
      };
      all += static_cast<std::size_t>(std::ranges::count_if(passage.evaluated(span), counts));
      moving += static_cast<std::size_t>(std::ranges::count_if(passage.open(span), counts));
    }
  }
};

/// Data from which the forces of all cables are computed: component, strains, and places at the clamps.
class CableRows {
 public:
  void add(std::int32_t span, const Evaluation& evaluation) {
    const CablePaths& cables = evaluation.cables();
    for (std::size_t k = 0; k < cables.cables(); ++k) {
      names_.push_back(evaluation.name_of_cable(k));
      span_.push_back(span);
      dresspack_.push_back(static_cast<std::int32_t>(evaluation.dresspack()));
      component_.push_back(cables.component(k));
      pulled_.push_back(&cables.pulled(k));
      for (const double slipped : cables.grip_slip(k)) slip_.push_back(slipped);
      for (const double gain : cables.path_gain(k)) gain_.push_back(gain);
      room_.push_back(cables.room(k));
      curvature_.push_back(cables.largest_curvature(k));
      for (const auto& at_clamp : pulled_.back()->place) place_.insert(place_.end(), at_clamp.begin(), at_clamp.end());
    }
  }
  std::size_t size() const { return names_.size(); }
  void write(FileWriter& file, std::size_t samples) const {
    file.set_axis("cable", names_.size());
    const auto shorter = [](const std::string& a, const std::string& b) { return a.size() < b.size(); };
    file.set_text_width("/cable/name", std::ranges::max_element(names_, shorter)->size());
    file.append("/cable/name", names_);
    file.append("/cable/span", span_);
    file.append("/cable/dresspack", dresspack_);
    file.append("/cable/component", component_);
    file.append("/cable/grip_slip", slip_);
    file.append("/cable/clamp_place", place_);
    file.append("/cable/path_gain", gain_);
    file.append("/cable/room", room_);
    file.append("/cable/curvature", curvature_);
    std::vector<double> rows;
    for (std::size_t t = 0; t < samples; ++t)
      for (const pipeline::PulledCable* of : pulled_)
        for (const std::vector<double>& strain : of->strain) rows.push_back(strain[t]);
    file.append("/cable/strain", rows);
  }

 private:
  std::vector<std::string> names_;
  std::vector<std::int32_t> span_, dresspack_, component_;
  std::vector<double> slip_, place_, gain_, room_, curvature_;
  std::vector<const pipeline::PulledCable*> pulled_;
};

/// Where the jackets of all cables rub.
class RubbingRows {
 public:
  /// first: number of the span's first cable in the file. rest: place of rest (W40).
  void add(std::size_t first, const Evaluation& evaluation, std::size_t rest) {
    const CablePaths& cables = evaluation.cables();
    for (std::size_t k = 0; k < cables.cables(); ++k) {
      const CableRubbing* const rubbing = cables.rubbing(k);
      if (!rubbing) continue;
      recorded_ = true;
      for (const CableRubbing::Patch& patch : rubbing->patches()) {
        cable_.push_back(static_cast<std::int32_t>(first + k));
        rest_.push_back(static_cast<std::int32_t>(rest));
        place_.insert(place_.end(), {evaluation.arcs()[patch.segment], evaluation.lengths()[patch.segment], patch.angle,
                                     CableRubbing::width()});
        work_.push_back(patch.work);
        sample_.push_back(static_cast<std::uint32_t>(patch.sample));
      }
    }
  }
  void write(FileWriter& file) const {
    if (!recorded_) return;
    file.set_axis("jacket_patch", work_.size());
    file.append("/jacket/cable", cable_);
    file.append("/jacket/rest", rest_);
    file.append("/jacket/place", place_);
    file.append("/jacket/work", work_);
    file.append("/jacket/sample", sample_);
  }

 private:
  bool recorded_ = false;
  std::vector<std::int32_t> cable_, rest_;
  std::vector<double> place_, work_;
  std::vector<std::uint32_t> sample_;
};

/// Writes the data of all cables from which their forces follow. Writes nothing if there is no cable. Returns warnings: elements
/// that are too long, and samples without rest.
std::vector<Warning> write_cables(FileWriter& file, const pipeline::Job& job,
                                  const std::vector<std::unique_ptr<Evaluation>>& evaluations, const Starts& starts) {
  CableRows rows;
  RubbingRows rubbing;
  std::vector<const std::vector<double>*> hose_moment;  // (span with cables)
  std::vector<Warning> warnings;
  double mesh_error = 0;
  std::size_t pieces = 0, restless = 0;
  for (std::size_t span = 0; span < evaluations.size(); ++span) {
    const auto& evaluation = evaluations[span];
    if (!evaluation->any_cables()) continue;
    for (std::size_t rest = 0; rest < starts.rests(); ++rest) rubbing.add(rows.size(), *starts.spans(rest)[span], rest);
    rows.add(static_cast<std::int32_t>(hose_moment.size()), *evaluation);
    hose_moment.push_back(&evaluation->cables().hose_moment());
    restless += evaluation->cables().restless();
    warnings = pipeline::joined(std::move(warnings), cycle_warnings(job, change_of(*evaluation)));
    if (const double error = evaluation->cables().mesh_error(); error > mesh_error)
      mesh_error = error, pieces = evaluation->cables().elements_per_segment();
  }
  if (hose_moment.empty()) return {};
  const std::size_t samples = hose_moment.front()->size();
  rows.write(file, samples);
  rubbing.write(file);
  file.set_axis("cable_span", hose_moment.size());
  std::vector<double> moments;
  for (std::size_t t = 0; t < samples; ++t)
    for (const std::vector<double>* of : hose_moment) moments.push_back((*of)[t]);
  file.append("/cable_span/hose_moment", moments);
  if (mesh_error > 0) file.attribute("loose_mesh_error", mesh_error);
  warnings = pipeline::joined(pipeline::joined(mesh_warnings(mesh_error, pieces, job.simulation.segments),
                                               restless_warnings(restless, job.simulation.sample_rate)),
                              warnings);
  if (evaluations.size() != 1 || !evaluations[0]->any_loose()) return warnings;
  const CablePaths& cables = evaluations[0]->cables();
  const std::vector<std::uint32_t> offset_samples(cables.offset_samples().begin(), cables.offset_samples().end());
  file.append("/cable/offset_sample", offset_samples);
  file.append("/cable/offset", cables.offsets());
  return warnings;
}

/// Returns whether the lay of a layer is an estimate of a data sheet, whose layers have the names `core` and `wire`.
bool has_estimated_lay(const pipeline::Dresspack& dresspack, const std::string& layer) {
  const char* const key = layer.ends_with("/wire") ? " wire_lay_length_mm" : " lay_length_mm";
  return dresspack.estimates.find(key) != std::string::npos;
}

/// Returns warnings of layers whose strain evens out over too great a length for the closed forms of friction (strain/slip.h).
std::vector<Warning> evening_warnings(const std::vector<std::unique_ptr<Evaluation>>& evaluations,
                                      const pipeline::Job& job) {
  constexpr double most_held = 2.5;  // times the cap, measured with lines that slide (strain/slip.h)
  std::vector<Warning> all;
  if (job.strain.factors.friction >= most_held) return all;
  for (const auto& evaluation : evaluations) {
    const Evaluation::BendScale& of = evaluation->evening();
    if (of.layer < 0 || of.longest <= believable_evening * of.bend_wave) continue;
    const std::string layer = evaluation->name_of_layer(of.layer);
    const bool estimated = !of.straight && has_estimated_lay(job.dresspacks[evaluation->dresspack()].dresspack, layer);
    const pipeline::Remedy remedy{
        {{"strain.friction_factor", fmt::format("{:g}", most_held)}},
        std::string(", which counts with the most that friction could hold") +
            (estimated ? "" : "; or the hand and the lay length that the cable's maker states"),
        estimated ? "the lay length that the cable's maker states, in data_sheet; or " : ""};
    all.push_back(pipeline::warning_of(
        WarningKind::material, "",
        fmt::format(
            "the strain of {} evens out over {:.3g} m, and the bend changes over {:.3g} m (limit of the first over the "
            "second {:g}): friction could hold up to {:g} times as much strain",
            layer, of.longest, of.bend_wave, believable_evening, most_held),
        of.straight ? "it has no lay"
        : of.own_lay
            ? fmt::format("its lay length{} is not short beside the bend", estimated ? ", an ESTIMATE," : "")
            : "its hand or that of its conductor differs from that of the next outer layer, and their lay lengths are nearly "
              "equal",
        remedy));
  }
  return all;
}

/// Returns warnings of layers that lack the strain of incomplete turns in a bend (strain/net_bend.h).
std::vector<Warning> net_bend_warnings(const std::vector<std::unique_ptr<Evaluation>>& evaluations,
                                       const pipeline::Job& job) {
  // The strain range of wires could double. With slope 7 of copper their life is then up to 100 times shorter, more than all stated
  // errors together.
  constexpr double most_share = 1;
  constexpr double harmless = 2e-4;  // range with which copper wire lives 1e17 cycles
  std::vector<Warning> all;
  for (const auto& evaluation : evaluations) {
    const NetBend::Largest net = evaluation->net_bend();
    if (net.layer < 0 || net.strain <= most_share * net.own || net.strain < harmless) continue;
    const std::string layer = evaluation->name_of_layer(net.layer);
    const bool estimated = has_estimated_lay(job.dresspacks[evaluation->dresspack()].dresspack, layer);
    all.push_back(pipeline::warning_of(
        WarningKind::material, "",
        fmt::format(
            "a bend contains few turns of {} (lay {:.0f} mm) and ends within a turn. This lengthens and shortens the "
            "layer by up to {:.2g} %, {:.2g} times the bending strain of its wires (limit {:g}). No strain of this job "
            "contains it, so the life is too long",
            layer, 1e3 * net.lay, 100 * net.strain, net.strain / net.own, most_share),
        fmt::format("the lay length{} is not short beside the bend", estimated ? ", an ESTIMATE," : ""),
        {{}, "", "a cable with a shorter lay, or the lay length that the cable's maker states"}));
  }
  return all;
}

/// Writes the moment of a cable by itself, from the curvature of a hanging cable to that of a wire around a finger.
void write_bending(FileWriter& file, const pipeline::Job& job) {
  const pipeline::Dresspack& dresspack = job.dresspacks.front().dresspack;
  const bool rub = std::ranges::any_of(job.strain.slip, [](pipeline::Slip slip) { return rubs(slip); });
  if (!dresspack.cable_alone || !rub || dresspack.components.size() != 1 || dresspack.components[0].components.empty())
    return;
  constexpr int of_a_decade = 20, decades = 5;
  constexpr double least = 1e-3;  // [1/m]
  std::vector<double> curvature, moment;
  for (int k = 0; k <= decades * of_a_decade; ++k) curvature.push_back(least * std::pow(10, double(k) / of_a_decade));
  try {
    moment = pipeline::bending_moments(dresspack, dresspack.components[0], job.strain.factors.friction, curvature);
  } catch (const pipeline::InputError&) {
    return;  // straight parts beside the axis: their sliding depends on the length
  }
  file.append("/bending/curvature", curvature);
  file.append("/bending/moment", moment);
}

/// Writes the rest of each start: (start).
void write_rests(FileWriter& file, const Starts& starts) {
  const std::vector<std::int32_t> rests(starts.rest_of().begin(), starts.rest_of().end());
  if (!rests.empty()) file.append("/start/rest", rests);
}

/// Progress of the work.
class Work {
 public:
  Work(const std::function<void(double)>& progress, bool loose, std::size_t others)
      : progress_(progress),
        first_pass_(loose ? loose_pass_share : first_pass_share),
        own_(others == 0 ? 1 : own_work_share),
        others_(static_cast<double>(others)) {}
  /// Report progress: the share of the first pass, the share of the segments, the number of other motions.
  void first_pass(double share) const { progress_(own_ * first_pass_ * share); }
  void segments(double share) const { progress_(own_ * (first_pass_ + (1 - first_pass_) * share)); }
  void other_motions(std::size_t done) const { progress_(own_ + (1 - own_) * static_cast<double>(done) / others_); }

 private:
  const std::function<void(double)>& progress_;
  double first_pass_, own_, others_;
};

/// Writes the results of the job's own evaluation.
class OwnResults {
 public:
  OwnResults(FileWriter& file, const std::vector<std::unique_ptr<Evaluation>>& evaluations)
      : sites_(file, "", evaluations),
        stick_(file, "/bound_stick", evaluations),
        free_(file, "/bound_free", evaluations) {
    sink_.sites = [&](const SiteRows& rows) { sites_.append(rows); };
    sink_.bound_stick = [&](const SiteRows& rows) { stick_.append(rows); };
    sink_.bound_free = [&](const SiteRows& rows) { free_.append(rows); };
    sites_.append({});  // a dresspack without wires has no site and no probe
    file.append("/probe/site", std::vector<std::uint32_t>{});
    file.append("/probe/strain", std::vector<float>{});
    sink_.probe = [&file](const Probe& probe) {
      file.append("/probe/site", std::vector<std::uint32_t>{static_cast<std::uint32_t>(probe.site)});
      file.append("/probe/strain", probe.strain);
      file.append("/probe/shear", probe.shear);
    };
    sink_.fibre = [&file](const FibreHistory& fibre) {
      file.append("/plane/site", std::vector<std::uint32_t>{static_cast<std::uint32_t>(fibre.site)});
      file.append("/plane/strain", std::vector<float>(fibre.strain.begin(), fibre.strain.end()));
      file.append("/plane/shear", std::vector<float>(fibre.shear.begin(), fibre.shear.end()));
    };
  }
  OwnResults(const OwnResults&) = delete;
  OwnResults& operator=(const OwnResults&) = delete;
  const Sink& sink() const { return sink_; }

 private:
  SiteWriter sites_, stick_, free_;
  Sink sink_;
};

using LikelySites = std::vector<std::vector<Evaluation::Site>>;  ///< (segment)

/// Writes the variations in the motion of a hose with another stiffness.
void write_other_motion(MotionReader& motion, const Shortening& shortening, Starts::Spans& laid,
                        const Variations& variations, HistoryWindow& window, std::size_t threads,
                        const LikelySites& likely, OtherPlaces& places, const Variations::Put& put) {
  Starts starts(laid);
  Passage passage(motion, shortening, starts, window, threads);
  passage.take_along(variations);
  passage.lead_in(passage.samples_in(lead_in_varied), 0);
  passage.run([](const MotionBlock&) {});
  places.add(passage, laid.size(), {});
  variations.find_bent();
  std::size_t seen = 0;
  passage.each_segment([&](std::size_t span, std::size_t segment, std::size_t row) {
    variations.evaluate(likely[seen++], span, segment, window.history(), row, put);
  });
}

}  // namespace

std::vector<Warning> mesh_warnings(double error, std::size_t pieces, int segments) {
  if (error <= believable_mesh_error) return {};
  pipeline::Remedy remedy{{}, " or more"};
  if (2 * pieces <= std::size_t{pipeline::most_cable_elements})
    remedy.values = {{"strain.cable_elements_per_segment", std::to_string(2 * pieces)}};
  else
    remedy.values = {{"strain.cable_elements_per_segment", std::to_string(pieces)},
                     {"simulation.segments", std::to_string(2 * segments)}};
  return {pipeline::warning_of(
      WarningKind::mesh, "",
      fmt::format(
          "loose cables are cut into {} pieces in each segment, which misses {:.3g} of their curvature (limit {:g}): lives are too long",
          pieces, error, believable_mesh_error),
      "the cables lie in waves shorter than these pieces resolve", remedy)};
}

std::vector<Warning> cycle_warnings(const pipeline::Job& job, const RepeatChange& change) {
  constexpr double most = LooseCables::most_change;
  if (!(change.share > most)) return {};
  const pipeline::MountedDresspack& mounted = job.dresspacks[change.dresspack];
  const pipeline::Component& component = mounted.dresspack.components[change.component];
  const double now = component.laying.slack / 100;
  // Below half of the slack of one turn, and below the gain of its path, bends of the hose pull the cable (pipeline/cable/excess.h).
  const double less = std::max(
      {now / 2, pipeline::winding_slack(mounted, component) / 2, change.longest_path / job.strain.factors.slack});
  pipeline::Remedy remedy{
      {},
      "another free length or other clamps, which `dresslife route` finds: less slack would let bends pull this cable"};
  if (less < now)
    remedy = {{{fmt::format("{}.components.{}.slack_percent", line_key(job, change.dresspack, "dresspack"),
                            entry_number(mounted.dresspack.components, change.component)),
                pipeline::percent_above(less)}},
              fmt::format(" (now {:.3g}; a shorter excess length has fewer places to rest; not tried)",
                          component.laying.slack)};
  Warning warning = pipeline::warning_of(
      WarningKind::periodic, "",
      fmt::format(
          "loose cables do not end the repeat where they began it: their curvature changes by {:.0f} % (limit {:.0f} %), that of "
          "'{}' most, {:.2f} m from the base clamp, and the life counts this change in each repeat",
          100 * change.share, 100 * most, change.cable, change.arc),
      fmt::format("the cables have not reached a cycle in {:.0f} s of motion and {} further repeats", lead_in_time,
                  Passage::most_closing_repeats),
      remedy);
  warning.amount = change.share / most;
  return {warning};
}

Notes write_strain(const FileReader& motion, const pipeline::Job& job, FileWriter& strain, std::size_t threads,
                   const std::function<void(double)>& progress, std::size_t history_bytes) {
  MotionReader reader(motion, job);
  check(motion, job, reader);
  std::vector<OtherMotion> others = other_motions(motion, job);
  const std::size_t segments = reader.lengths().size(), samples = reader.samples();
  check_probes(job);
  const Shortening shortening = job.uncertainty.enabled ? shortening_of(motion, reader, job) : Shortening(samples);
  // The other half of the limit is for the hose's deformation.
  const Scratch scratch{
      history_bytes / 2 / (reader.spans().size() * (1 + other_starts_at_most(job) + placements_at_most(job))),
      strain.final_name()};
  Evaluations all(job, reader, samples, threads, job.strain.factors, scratch);
  const auto& evaluations = all.of_span;
  const auto record_net_bends = [](const Evaluations& own) {
    for (const auto& evaluation : own.of_span) evaluation->record_net_bend();
  };
  record_net_bends(all);
  std::list<Evaluations> otherwise_laid;
  Variations variations(
      job, evaluations, shortening,
      [&](const pipeline::StrainFactors& factors, std::size_t followed) -> const Variations::Spans& {
        return otherwise_laid.emplace_back(job, reader, followed, threads, factors, scratch, &all).of_span;
      });
  Starts starts(all.of_span, [&]() -> Starts::Spans& {
    Evaluations& laid = otherwise_laid.emplace_back(job, reader, samples, threads, job.strain.factors, scratch, &all);
    record_net_bends(laid);  // a rest that is not the first one can become the job's own
    return laid.of_span;
  });
  strain.set_axis("segment", segments);
  strain.set_axis("level", all.levels);
  strain.set_axis("sample", samples);
  copy_program(motion, strain);
  for (const auto& evaluation : evaluations) strain.append("/segment/wires_at", evaluation->places());
  OwnResults results(strain, evaluations);

  std::size_t held_bytes = 0;
  for (const auto& evaluation : evaluations) held_bytes += evaluation->held_bytes();
  const std::size_t window_bytes = history_bytes - std::min(held_bytes, history_bytes);
  HistoryWindow window(segments, samples, window_bytes);
  Passage passage(reader, shortening, starts, window, threads);
  const Work work(progress, passage.any_loose(), others.size());
  const std::size_t lead_in_of_variations = passage.repeats_in(lead_in_varied);
  passage.lead_in(passage.samples_in(lead_in_time), lead_in_of_variations);
  variations.go_on();
  passage.take_along(variations);
  passage.lead_in(lead_in_of_variations, 0);
  passage.record_rubbing();
  passage.run([&](const MotionBlock& block) {
    append_deformation(strain, block.deformation);
    work.first_pass(static_cast<double>(block.first) / static_cast<double>(samples));
  });
  passage.choose(job.strain.rest);
  OtherPlaces places;
  places.add(passage, evaluations.size(), evaluations);
  variations.find_bent();
  variations.add(starts);
  static_cast<void>(pipeline::warnings_of_descriptions(job));  // for its errors; dresslife-fatigue writes the warnings
  const std::vector<Warning> warnings =
      pipeline::joined(pipeline::joined(evening_warnings(evaluations, job), net_bend_warnings(evaluations, job)),
                       write_cables(strain, job, evaluations, starts));
  write_bending(strain, job);
  write_rests(strain, starts);
  VariationWriter variation_rows(strain, variations, 0);
  variation_rows.write_pulls(variations);
  const Variations::Put put = variation_rows.put();
  LikelySites likely;
  passage.each_segment([&](std::size_t span, std::size_t segment, std::size_t row) {
    evaluations[span]->evaluate(segment, window.history(), row, results.sink());
    likely.push_back(evaluations[span]->likely_worst());
    variations.evaluate(likely.back(), span, segment, window.history(), row, put);
    work.segments(static_cast<double>(likely.size()) / static_cast<double>(segments));
  });
  std::size_t written = variations.points().size();
  for (std::size_t other = 0; other < others.size(); ++other) {
    otherwise_laid.clear();  // frees its memory
    MotionReader& of = others[other].reader;
    const Shortening of_other = shortening_of(motion, of, job);
    window.begin(of_other.samples(), window_bytes);
    Evaluations laid(job, of, of_other.samples(), threads, job.strain.factors, scratch, &all);
    const Variations varied(
        job, others[other].z, laid.of_span, of_other,
        [&](const pipeline::StrainFactors& factors, std::size_t followed) -> const Variations::Spans& {
          return otherwise_laid.emplace_back(job, of, followed, threads, factors, scratch, &all).of_span;
        });
    VariationWriter rows(strain, varied, written);
    write_other_motion(of, of_other, laid.of_span, varied, window, threads, likely, places, rows.put());
    rows.write_pulls(varied);
    written += varied.points().size();
    work.other_motions(other + 1);
  }
  for (const char* taut : {"softer_taut_z", "stiffer_taut_z"})
    if (motion.has_attribute(taut)) strain.attribute(taut, motion.number_attribute(taut));
  if (places.all > 0) strain.attribute("moving_places", static_cast<double>(places.moving));
  const auto worst = std::ranges::max_element(
      evaluations, [](const auto& a, const auto& b) { return a->worst_range() < b->worst_range(); });
  return {warnings, (*worst)->summary(evaluations.back()->sites_so_far())};
}

}  // namespace dresslife::strain
