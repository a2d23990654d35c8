#include "strain/strain_file.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <list>
#include <memory>
#include <numeric>
#include <span>

#include "pipeline/base/threads.h"
#include "pipeline/base/warning_words.h"
#include "pipeline/cable/believable.h"
#include "pipeline/cable/cable_bending.h"
#include "pipeline/cable/excess.h"
#include "pipeline/cable/overlap.h"
#include "pipeline/cable/stiffness.h"
#include "pipeline/files/motion_layout.h"
#include "pipeline/job/job.h"
#include "pipeline/job/line_key.h"
#include "strain/evaluation.h"
#include "strain/starts.h"
#include "strain/variations.h"

namespace dresslife::strain {
namespace {

using pipeline::FileReader;
using pipeline::FileWriter;
using pipeline::Warning;
using pipeline::WarningKind;

constexpr std::size_t block_samples = 512;  // rows read at a time
constexpr double first_pass_share = 0.05;   // of the work, for the progress display
// 2 % of strain are a tenth of a life that goes with its fifth power: less than anything else here is known
// to.
constexpr double believable_mesh_error = 0.02;
constexpr double loose_pass_share = 0.5;  // the same where cables lie loose
constexpr double own_work_share = 0.75;   // the same of all but other stiffnesses of the hose
// Of the end of the motion [s], before the repeat that counts: loose cables forget their first places (W36). After 160 s
// the last start of robot 1 comes to its rest.
constexpr double rehearsed = 180;
// Variations go on from the first start so long before the first sample [s]. From 170 s the same lives follow for robot 1 and
// hard, from 30 s one of ten differs by 0.85 of a decade.
constexpr double rehearsed_varied = 90;

/// Some samples of all segments.
struct MotionBlock {
  std::size_t first;                         ///< sample
  std::span<const Deformation> deformation;  ///< (sample, segment) at its centre
  std::span<const Deformation> at_wires;     ///< (sample, segment) where its wires are evaluated (W39)
  std::span<const double> pull;              ///< (sample, segment, 2), see SpanBlock; empty: not asked for
};

/// Reads the motion block by block and measures the deformation of every segment.
class MotionReader {
 public:
  /// group: of the places of segments and clamps; empty: of the job's own motion.
  MotionReader(const FileReader& file, const pipeline::Job& job, std::string group = "")
      : file_(file),
        group_(std::move(group)),
        lengths_(file.read<double>("/segment/length")),
        samples_(file.rows("/time")),
        step_(step_of(file, job)),
        gravity_(job.simulation.gravity) {
    if (lengths_.empty()) return;
    spans_ = pipeline::motion_spans(file);
    for (std::size_t k = 0; k < spans_.size(); ++k)
      gauges_.emplace_back(lengths_of(spans_[k]), job.strain.deformation, free_end(job, k));
  }

  std::size_t samples() const { return samples_; }
  double step() const { return step_; }  ///< between samples [s]
  const std::vector<double>& lengths() const { return lengths_; }
  const std::vector<pipeline::MotionSpan>& spans() const { return spans_; }
  std::vector<double> lengths_of(const pipeline::MotionSpan& span) const {
    return {lengths_.begin() + span.first_segment, lengths_.begin() + span.first_segment + span.segments};
  }

  KnownEnds known_ends(std::size_t span) const { return gauges_[span].knows_ends(); }

  /// Whether no clamp holds the tool end of span k.
  bool ends_freely(const pipeline::Job& job, std::size_t k) const {
    const auto dresspack = static_cast<std::size_t>(spans_[k].dresspack);
    const bool last = k + 1 == spans_.size() || spans_[k + 1].dresspack != spans_[k].dresspack;
    if (dresspack >= job.dresspacks.size()) return false;  // check() reports it
    return last && !is_clamped(job.dresspacks[dresspack].routing.tool_end);
  }

  /// One block after the other, of all samples or of those in [from, end). with_pull: gives that, too.
  void run(bool with_pull, const std::function<void(const MotionBlock&)>& put) {
    run(with_pull, put, 0, samples_);
  }
  void run(bool with_pull, const std::function<void(const MotionBlock&)>& put, std::size_t from,
           std::size_t end) {
    const std::size_t segments = lengths_.size();
    const std::size_t clamps = file_.row_size("/clamp/position") / 3;
    std::vector<double> position, orientation, clamp_position, clamp_orientation;
    std::vector<Deformation> deformation, at_wires;
    std::vector<double> pull;
    for (std::size_t first = from; first < end; first += block_samples) {
      const std::size_t count = std::min(block_samples, end - first);
      file_.read_rows(group_ + "/segment/position", first, count, position);
      file_.read_rows(group_ + "/segment/orientation", first, count, orientation);
      file_.read_rows(group_ + "/clamp/position", first, count, clamp_position);
      file_.read_rows(group_ + "/clamp/orientation", first, count, clamp_orientation);
      deformation.resize(count * segments);
      at_wires.resize(count * segments);
      for (std::size_t t = 0; t < count; ++t) {
        auto row = [&](const std::vector<double>& of, std::size_t size) {
          return std::span(of).subspan(t * size, size);
        };
        for (std::size_t k = 0; k < spans_.size(); ++k) {
          const auto& [dresspack, begin, size, base, tool] = spans_[k];
          const std::size_t held = tool - base + 1;  // the first and the last count
          const auto own = [&, first = t * segments + begin, count = size](std::vector<Deformation>& of) {
            return std::span(of).subspan(first, count);
          };
          gauges_[k].measure({row(position, 3 * segments).subspan(3 * begin, 3 * size),
                              row(orientation, 4 * segments).subspan(4 * begin, 4 * size),
                              row(clamp_position, 3 * clamps).subspan(3 * base, 3 * held),
                              row(clamp_orientation, 4 * clamps).subspan(4 * base, 4 * held)},
                             own(deformation));
          std::ranges::copy(own(deformation), own(at_wires).begin());
          gauges_[k].move_to_ends(own(at_wires));
        }
      }
      if (with_pull) measure_pull(first, count, orientation, pull);
      put({first, deformation, at_wires, pull});
    }
  }

 private:
  static double step_of(const FileReader& file, const pipeline::Job& job) {
    std::vector<double> two;
    if (file.rows("/time") < 2) return 1 / job.simulation.sample_rate;
    file.read_rows("/time", 0, 2, two);
    return two[1] - two[0];
  }

  /// Gravity less acceleration in each segment's frame; the first and the last sample have their neighbour's
  /// acceleration.
  void measure_pull(std::size_t first, std::size_t count, const std::vector<double>& orientation,
                    std::vector<double>& pull) const {
    const std::size_t segments = lengths_.size(), row = 3 * segments;
    const std::size_t before = first > 0 ? 1 : 0, after = first + count < samples_ ? 1 : 0;
    std::vector<double> position;
    file_.read_rows(group_ + "/segment/position", first - before, count + before + after, position);
    const std::size_t rows = position.size() / row;
    pull.assign(count * segments * 2, 0.0);
    for (std::size_t t = 0; t < count; ++t) {
      const std::size_t middle = rows < 3 ? 0 : std::clamp<std::size_t>(t + before, 1, rows - 2);
      for (std::size_t i = 0; i < segments; ++i) {
        Eigen::Vector3d force = gravity_;
        for (std::size_t d = 0; rows >= 3 && d < 3; ++d) {
          const double* const at = position.data() + middle * row + 3 * i + d;
          force[static_cast<Eigen::Index>(d)] -= (at[row] - 2 * at[0] + *(at - row)) / (step_ * step_);
        }
        const double* const q = orientation.data() + (t * segments + i) * 4;
        const Eigen::Vector3d own = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).conjugate() * force;
        pull[(t * segments + i) * 2] = own.x();
        pull[(t * segments + i) * 2 + 1] = own.y();
      }
    }
  }

  /// Rates of the unloaded dresspack, if it ends freely at the tool end of span k.
  std::optional<Eigen::Vector3d> free_end(const pipeline::Job& job, std::size_t k) const {
    if (!ends_freely(job, k)) return {};
    return Eigen::Vector3d(0, job.dresspacks[spans_[k].dresspack].dresspack.rest_curvature, 0);
  }

  const FileReader& file_;
  std::string group_;
  std::vector<double> lengths_;
  std::size_t samples_;
  double step_;
  Eigen::Vector3d gravity_;
  std::vector<pipeline::MotionSpan> spans_;
  std::vector<DeformationGauge> gauges_;  // (span)
};

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

/// Appends site sets under one group, keeping count of the turning points.
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

/// Appends what variations make of likely worst wires.
class VariationWriter {
 public:
  /// The variations of others follow the first ones.
  VariationWriter(FileWriter& file, const Variations& variations, const std::vector<OtherMotion>& others) : file_(file) {
    std::vector<double> z;
    for (const Variations::Point& point : variations.points()) z.insert(z.end(), point.begin(), point.end());
    z.resize(z.size() + others.size() * Variations::Point{}.size());
    if (z.empty()) return;
    file.append("/variation/z", z);
    std::vector<std::int32_t> inside, rests = variations.rests();
    for (const pipeline::Inside one : variations.inside()) inside.push_back(static_cast<std::int32_t>(one));
    std::vector<double> stiffness(inside.size());
    for (const OtherMotion& other : others) stiffness.push_back(other.z);
    inside.resize(stiffness.size()), rests.resize(stiffness.size());
    file.append("/variation/inside", inside);
    file.append("/variation/rest", rests);
    if (!others.empty()) file.append("/variation/stiffness", stiffness);
  }

  void append(std::size_t variation, const std::vector<std::size_t>& sites, const SiteRows& rows) {
    file_.append("/variation/row/variation",
                 std::vector<std::uint32_t>(sites.size(), static_cast<std::uint32_t>(variation)));
    file_.append("/variation/row/site", std::vector<std::uint32_t>(sites.begin(), sites.end()));
    file_.append("/variation/row/turning",
                 std::vector<std::uint32_t>(rows.turning.begin(), rows.turning.end()));
    file_.append("/variation/strain", rows.strain);
  }

 private:
  FileWriter& file_;
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
  for (std::size_t first = 0; first < motion.rows(joints); first += block_samples) {
    motion.read_rows(joints, first, std::min(block_samples, motion.rows(joints) - first), block);
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
  for (std::size_t d = 0; d < job.dresspacks.size(); ++d)
    if (const pipeline::Dresspack& dresspack = job.dresspacks[d].dresspack; !has_wires(dresspack)) {
      const std::string name = pipeline::name_among(job, d);
      throw pipeline::InputError(
          motion.where(),
          fmt::format("comes from a dresspack {}without {} (there is no wire to evaluate)",
                      name.empty() ? "" : "'" + name + "' ",
                      dresspack.components.empty() ? "components" : "wires"),
          "give dresspack.components that hold wires");
    }
}

/// Whether a path begins with the name of dresspack d among several.
bool lies_in(const pipeline::Job& job, std::size_t d, const std::string& path) {
  const std::string name = pipeline::name_among(job, d);
  return name.empty() || path.starts_with(name + "/");
}

/// The settings as they hold for dresspack d: with its own probes.
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

/// What lies in each dresspack, and one evaluation per span: each slips from clamp to clamp.
struct Evaluations {
  std::vector<Construction> constructions;           // (dresspack)
  std::vector<std::unique_ptr<Evaluation>> of_span;  // refer to them
  int levels = 0;                                    // of the deepest wire

  /// as_given: the same dresspacks without further factors, with whose cables these lie side by side, in as
  /// many pieces.
  Evaluations(const pipeline::Job& job, const MotionReader& reader, std::size_t threads,
              const pipeline::StrainFactors& factors, const Scratch& scratch,
              const Evaluations* as_given = nullptr) {
    for (const pipeline::MountedDresspack& mounted : job.dresspacks) {
      constructions.emplace_back(mounted.dresspack, job.strain.kinematics, factors);
      levels = std::max(levels, constructions.back().levels());
    }
    const std::vector<pipeline::MotionSpan>& spans = reader.spans();
    SpanPlace place;
    std::size_t first = 0;  // span of its dresspack
    place.levels = levels;
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
      const std::vector<std::array<pipeline::BendRelief, 2>> reliefs = pipeline::bend_reliefs(job.dresspacks[d].routing);
      for (std::size_t end = 0; end < 2 && k - first < reliefs.size(); ++end)
        place.relief_stiffness[end] = reliefs[k - first][end].length > 0 ? reliefs[k - first][end].stiffness : 0;
      place.clamped_length = pipeline::clamped_length(job);
      const std::vector<double> lengths = reader.lengths_of(spans[k]);
      pipeline::Strain settings = settings_of(job, d);
      if (as_given)
        settings.cable_elements = static_cast<int>(as_given->of_span[k]->cables().elements_per_segment());
      of_span.push_back(std::make_unique<Evaluation>(constructions[d], settings, lengths, reader.samples(),
                                                     threads, place, scratch));
      place.first_arc += std::accumulate(lengths.begin(), lengths.end(), 0.0);
    }
  }
};

/// pieces: of a loose cable in a segment.
std::vector<Warning> mesh_warnings(double error, std::size_t pieces, int segments) {
  if (error <= believable_mesh_error) return {};
  return {pipeline::warning_of(
      WarningKind::mesh, "",
      fmt::format("loose cables are cut into {} pieces in each segment, which misses {:.3g} of their curvature (limit {:g})",
                  pieces, error, believable_mesh_error),
      "the cables lie in waves shorter than these pieces resolve",
      2 * pieces <= std::size_t{pipeline::most_cable_elements}
          ? fmt::format("strain.cable_elements_per_segment: {} or more", 2 * pieces)
          : fmt::format("simulation.segments: {} or more", 2 * segments))};
}

std::vector<Warning> restless_warnings(std::size_t samples, double sample_rate) {
  if (samples == 0) return {};
  return {pipeline::warning_of(
      WarningKind::mesh, "",
      fmt::format("loose cables did not come to rest at {} samples: their curvatures there are not those of any balance",
                  samples),
      "the hose moves too far from one sample to the next", fmt::format("simulation.sample_rate_Hz: {:g}", 2 * sample_rate))};
}

/// The data of all spans' cables for their forces: whose metal they are of, their strains, and where they meet the
/// clamps.
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
      for (const auto& at_clamp : pulled_.back()->place)
        place_.insert(place_.end(), at_clamp.begin(), at_clamp.end());
    }
  }
  std::size_t size() const { return names_.size(); }
  void write(FileWriter& file, std::size_t samples) const {
    file.set_axis("cable", names_.size());
    const auto shorter = [](const std::string& a, const std::string& b) { return a.size() < b.size(); };
    file.set_text_width("/cable/name", std::max_element(names_.begin(), names_.end(), shorter)->size());
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

/// Where the jackets of all spans' cables rub.
class RubbingRows {
 public:
  /// first: number of the span's first cable in the file.
  void add(std::size_t first, const Evaluation& evaluation) {
    const CablePaths& cables = evaluation.cables();
    for (std::size_t k = 0; k < cables.cables(); ++k) {
      const CableRubbing* const rubbing = cables.rubbing(k);
      if (!rubbing) continue;
      recorded_ = true;
      for (const CableRubbing::Patch& patch : rubbing->patches()) {
        cable_.push_back(static_cast<std::int32_t>(first + k));
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
    file.append("/jacket/place", place_);
    file.append("/jacket/work", work_);
    file.append("/jacket/sample", sample_);
  }

 private:
  bool recorded_ = false;
  std::vector<std::int32_t> cable_;
  std::vector<double> place_, work_;
  std::vector<std::uint32_t> sample_;
};

/// What the cables of all spans do, of which their forces follow. Nothing where there is no cable. Returns
/// what a person should look at: pieces that are too long.
std::vector<Warning> write_cables(FileWriter& file, const pipeline::SimulationSettings& settings,
                                  const std::vector<std::unique_ptr<Evaluation>>& evaluations) {
  CableRows rows;
  RubbingRows rubbing;
  std::vector<const std::vector<double>*> hose_moment;  // of spans with cables
  double mesh_error = 0;
  std::size_t pieces = 0, restless = 0;
  for (const auto& evaluation : evaluations) {
    if (!evaluation->any_cables()) continue;
    rubbing.add(rows.size(), *evaluation);
    rows.add(static_cast<std::int32_t>(hose_moment.size()), *evaluation);
    hose_moment.push_back(&evaluation->cables().hose_moment());
    restless += evaluation->cables().restless();
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
  const std::vector<Warning> warnings =
      pipeline::joined(mesh_warnings(mesh_error, pieces, settings.segments),
                       restless_warnings(restless, settings.sample_rate));
  if (evaluations.size() != 1 || !evaluations[0]->any_loose()) return warnings;
  const CablePaths& cables = evaluations[0]->cables();
  const std::vector<std::uint32_t> offset_samples(cables.offset_samples().begin(),
                                                  cables.offset_samples().end());
  file.append("/cable/offset_sample", offset_samples);
  file.append("/cable/offset", cables.offsets());
  return warnings;
}

/// Wires whose strain evens out over too much of a bend for the closed forms of friction (strain/slip.h).
std::vector<Warning> evening_warnings(const std::vector<std::unique_ptr<Evaluation>>& evaluations) {
  std::vector<Warning> all;
  for (const auto& evaluation : evaluations) {
    const Evaluation::BendScale& of = evaluation->evening();
    if (of.layer < 0 || of.longest <= believable_evening * of.bend_wave) continue;
    all.push_back(pipeline::warning_of(
        WarningKind::material, "",
        fmt::format("the strain of {} evens out over {:.3g} m, and the bend changes over {:.3g} m (limit of the first over the "
                    "second {:g}): friction could hold up to 2.5 times as much strain",
                    evaluation->name_of_layer(of.layer), of.longest, of.bend_wave, believable_evening),
        of.straight ? "it has no lay, or fewer than four turns"
                    : "its hand or that of its conductor differs from that of the next outer layer, and their lay lengths are nearly "
                      "equal",
        "strain.friction_factor: 2.5, which counts with the most that friction could hold; or the hand and the lay length that "
        "the cable's maker states"));
  }
  return all;
}

/// What is wrong in the descriptions of dresspacks, whatever the motion: parts that lie in each other, a
/// stiffness that is not that of the parts.
std::vector<Warning> construction_warnings(const pipeline::Job& job) {
  std::vector<Warning> all;
  for (std::size_t d = 0; d < job.dresspacks.size(); ++d)
    all = pipeline::joined(std::move(all), pipeline::construction_warnings_at(line_key(job, d, "dresspack"), job.dresspacks[d].dresspack,
                                                                              slides(job.strain.slip.front())));
  return all;
}

/// How a cable by itself bends, from the curvature of a hanging cable to that of a wire around a finger.
void write_bending(FileWriter& file, const pipeline::Job& job) {
  const pipeline::Dresspack& dresspack = job.dresspacks.front().dresspack;
  const bool rub = std::any_of(job.strain.slip.begin(), job.strain.slip.end(),
                               [](pipeline::Slip slip) { return rubs(slip); });
  if (!dresspack.cable_alone || !rub || dresspack.components.size() != 1 ||
      dresspack.components[0].components.empty())
    return;
  constexpr int of_a_decade = 20, decades = 5;
  constexpr double least = 1e-3;  // [1/m]
  std::vector<double> curvature, moment;
  for (int k = 0; k <= decades * of_a_decade; ++k)
    curvature.push_back(least * std::pow(10, double(k) / of_a_decade));
  try {
    moment =
        pipeline::bending_moments(dresspack, dresspack.components[0], job.strain.factors.friction, curvature);
  } catch (const pipeline::InputError&) {
    return;  // straight parts beside the axis: how far they slide depends on the length
  }
  file.append("/bending/curvature", curvature);
  file.append("/bending/moment", moment);
}

}  // namespace

Notes write_strain(const FileReader& motion, const pipeline::Job& job, FileWriter& strain,
                   std::size_t threads, const std::function<void(double)>& progress,
                   std::size_t history_bytes) {
  MotionReader reader(motion, job);
  check(motion, job, reader);
  std::vector<OtherMotion> others = other_motions(motion, job);
  const std::size_t segments = reader.lengths().size(), samples = reader.samples();
  const double own_work = others.empty() ? 1 : own_work_share;
  check_probes(job);
  // Half of the room: the hose's deformation wants the other.
  const Scratch scratch{
      history_bytes / 2 / (reader.spans().size() * (1 + other_starts_at_most(job) + placements_at_most(job))),
      strain.final_name()};
  Evaluations all(job, reader, threads, job.strain.factors, scratch);
  const auto& evaluations = all.of_span;
  std::list<Evaluations> otherwise_laid;
  Variations variations(
      job, evaluations, [&](const pipeline::StrainFactors& factors) -> const Variations::Spans& {
        return otherwise_laid.emplace_back(job, reader, threads, factors, scratch, &all).of_span;
      });
  Starts starts(all.of_span, [&]() -> Starts::Spans& {
    return otherwise_laid.emplace_back(job, reader, threads, job.strain.factors, scratch, &all).of_span;
  });
  strain.set_axis("segment", segments);
  strain.set_axis("level", all.levels);
  strain.set_axis("sample", samples);
  copy_program(motion, strain);
  for (const auto& evaluation : evaluations) strain.append("/segment/wires_at", evaluation->places());
  SiteWriter sites(strain, "", evaluations), stick(strain, "/bound_stick", evaluations),
      free(strain, "/bound_free", evaluations);

  std::size_t held_bytes = 0;
  for (const auto& evaluation : evaluations) held_bytes += evaluation->held_bytes();
  held_bytes = std::min(held_bytes, history_bytes);
  const std::size_t per_pass =
      std::clamp<std::size_t>((history_bytes - held_bytes) / (samples * sizeof(Deformation)), 1, segments);
  DeformationHistory history(per_pass, samples);  // of segments [first_segment, first_segment + per_pass)
  auto keep = [&](std::size_t first_segment, std::size_t first, std::span<const Deformation> block) {
    for (std::size_t k = 0; k < block.size(); ++k)
      if (const std::size_t segment = k % segments;
          segment >= first_segment && segment < first_segment + per_pass)
        history.set(segment - first_segment, first + k / segments, block[k]);
  };
  using OfSpan = std::function<std::vector<Evaluation*>(std::size_t)>;
  // use: evaluations of a span that go through the same motion.
  const auto each_span = [&](const MotionBlock& block, const OfSpan& of_span_all, const auto& use) {
    const std::size_t count = block.deformation.size() / segments;
    std::vector<double> pull;
    std::vector<Deformation> ends;
    for (std::size_t k = 0; k < evaluations.size(); ++k) {
      const auto [begin, size] = std::pair(reader.spans()[k].first_segment, reader.spans()[k].segments);
      DeformationHistory of_span(size, count);
      pull.clear();
      ends.clear();
      for (std::size_t t = 0; t < count; ++t) {
        for (std::size_t i = 0; i < size; ++i) of_span.set(i, t, block.deformation[t * segments + begin + i]);
        for (const std::size_t i : {begin, begin + size - 1})
          ends.push_back(block.at_wires[t * segments + i]);
        if (block.pull.empty()) continue;
        const auto own = block.pull.subspan((t * segments + begin) * 2, size * 2);
        pull.insert(pull.end(), own.begin(), own.end());
      }
      const SpanBlock span_block{of_span, pull, reader.step(), ends};
      std::vector<std::vector<Evaluation*>> of_thread(threads);  // those that share loose cables in one
      std::size_t next = 0;
      for (Evaluation* const evaluation : of_span_all(k)) {
        const auto shares = [&](const std::vector<Evaluation*>& own) {
          return std::ranges::any_of(own, [&](const Evaluation* other) {
            return other->cables().shares_loose(evaluation->cables());
          });
        };
        const auto found = std::ranges::find_if(of_thread, shares);
        (found != of_thread.end() ? *found : of_thread[next++ % threads]).push_back(evaluation);
      }
      pipeline::in_parallel(threads, [&](std::size_t part) {
        if (!of_thread[part].empty()) use(of_thread[part], span_block);
      });
    }
  };
  // use: of a span, its segment, and where `history` has that. `history` has the first segments before.
  const auto each_segment = [&](MotionReader& of, const std::function<void(std::size_t, std::size_t, std::size_t)>& use) {
    for (std::size_t k = 0, span = 0; k < segments; ++k) {
      if (k == reader.spans()[span].first_segment + reader.spans()[span].segments) ++span;
      if (k % per_pass == 0 && k > 0)
        of.run(false, [&](const MotionBlock& block) { keep(k, block.first, block.at_wires); });
      use(span, k - reader.spans()[span].first_segment, k % per_pass);
    }
  };
  const auto any = [&](auto does) { return std::any_of(evaluations.begin(), evaluations.end(), does); };
  const bool loose = any([](const auto& evaluation) { return evaluation->any_loose(); });
  const auto samples_of = [&](double seconds) {
    return static_cast<std::size_t>(std::ceil(seconds / reader.step()));
  };
  // The job's own motion, or another: samples before the first one, from `left` to `until` of them before it, of the motion's
  // end or of whole repeats.
  const auto rehearse = [&](MotionReader& of, Starts& those, const OfSpan& evaluated, std::size_t left, std::size_t until) {
    while (left > until) {
      const std::size_t first = (samples - left % samples) % samples,
                        count = std::min(left - until, samples - first);
      const auto move = [&](const MotionBlock& block) {
        each_span(block, evaluated, Evaluation::rehearse);
        those.merge();
      };
      of.run(true, move, first, first + count);
      left -= count;
    }
  };
  // put: of every block.
  const auto pass = [&](MotionReader& of, Starts& those, const OfSpan& evaluated, const std::function<void(const MotionBlock&)>& put) {
    of.run(loose, [&](const MotionBlock& block) {
      put(block);
      each_span(block, evaluated, [](std::span<Evaluation* const> own, const SpanBlock& of_span) {
        Evaluation::add(own, of_span);
      });
      those.merge();
      keep(0, block.first, block.at_wires);
    });
    for (std::size_t k = 0; k < evaluations.size(); ++k)
      for (Evaluation* const evaluation : evaluated(k)) evaluation->end_first_pass();
    if (any([](const auto& evaluation) { return evaluation->wants_again(); }))
      of.run(false, [&](const MotionBlock& block) {
        each_span(block, evaluated, [](std::span<Evaluation* const> own, const SpanBlock& of_span) {
          for (Evaluation* const evaluation : own)
            if (evaluation->wants_again()) evaluation->add_again(of_span.deformation);
        });
      });
  };
  const auto choose = [&](MotionReader& of, Starts& those) {
    if (those.rests() == 1) return;
    for (std::size_t rest = 0; rest < those.rests(); ++rest)
      for (const auto& evaluation : those.spans(rest)) evaluation->find_bent();
    std::vector<double> damage(those.rests(), 0.0);
    each_segment(of, [&](std::size_t span, std::size_t segment, std::size_t row) {
      for (std::size_t rest = 0; rest < those.rests(); ++rest)
        damage[rest] = std::max<double>(damage[rest], those.spans(rest)[span]->damage_of_bent(segment, history, row));
    });
    those.choose(job.strain.rest, damage);
    if (per_pass < segments)
      of.run(false, [&](const MotionBlock& block) { keep(0, block.first, block.at_wires); });
  };
  const auto of_starts = [](const Starts& those, std::size_t span) {
    std::vector<Evaluation*> all_starts{those.spans(0)[span].get()};
    for (Evaluation* const placed : those.placed(span)) all_starts.push_back(placed);
    return all_starts;
  };
  bool varied = false;  // whether variations go through the motion, too
  const OfSpan own_and_varied = [&](std::size_t span) {
    std::vector<Evaluation*> together = of_starts(starts, span);
    if (varied)
      for (Evaluation* const placed : variations.placed(span)) together.push_back(placed);
    return together;
  };
  if (loose && samples > 1) rehearse(reader, starts, own_and_varied, samples_of(rehearsed), samples_of(rehearsed_varied));
  variations.go_on();
  varied = true;
  if (loose && samples > 1) rehearse(reader, starts, own_and_varied, samples_of(rehearsed_varied), 0);
  for (std::size_t k = 0; k < evaluations.size(); ++k)  // each of these may become the job's own
    for (Evaluation* const evaluation : of_starts(starts, k)) evaluation->record_rubbing();
  pass(reader, starts, own_and_varied, [&](const MotionBlock& block) {
    append_deformation(strain, block.deformation);
    progress(own_work * (loose ? loose_pass_share : first_pass_share) * static_cast<double>(block.first) /
             static_cast<double>(samples));
  });
  choose(reader, starts);
  for (std::size_t k = 0; k < evaluations.size(); ++k)
    for (Evaluation* const placed : variations.placed(k)) placed->find_bent();
  variations.add(starts);
  const std::vector<Warning> warnings =
      pipeline::joined(pipeline::joined(construction_warnings(job), evening_warnings(evaluations)),
                       write_cables(strain, job.simulation, evaluations));
  write_bending(strain, job);

  Sink sink;
  sink.sites = [&](const SiteRows& rows) { sites.append(rows); };
  sink.bound_stick = [&](const SiteRows& rows) { stick.append(rows); };
  sink.bound_free = [&](const SiteRows& rows) { free.append(rows); };
  sink.probe = [&](const Probe& probe) {
    strain.append("/probe/site", std::vector<std::uint32_t>{static_cast<std::uint32_t>(probe.site)});
    strain.append("/probe/strain", probe.strain);
    strain.append("/probe/shear", probe.shear);
  };
  sink.fibre = [&](const FibreHistory& fibre) {
    strain.append("/plane/site", std::vector<std::uint32_t>{static_cast<std::uint32_t>(fibre.site)});
    strain.append("/plane/strain", std::vector<float>(fibre.strain.begin(), fibre.strain.end()));
    strain.append("/plane/shear", std::vector<float>(fibre.shear.begin(), fibre.shear.end()));
  };
  if (const std::vector<std::int32_t> rests(starts.rest_of().begin(), starts.rest_of().end()); !rests.empty())
    strain.append("/start/rest", rests);
  VariationWriter variation_rows(strain, variations, others);
  std::size_t segment = 0;
  sink.progress = [&](double) {
    const double share = static_cast<double>(segment + 1) / static_cast<double>(segments);
    const double done = loose ? loose_pass_share : first_pass_share;
    progress(own_work * (done + (1 - done) * share));
  };
  std::vector<std::vector<Evaluation::Site>> likely;  // (segment)
  each_segment(reader, [&](std::size_t span, std::size_t in_span, std::size_t row) {
    evaluations[span]->evaluate(in_span, history, row, sink);
    likely.push_back(evaluations[span]->likely_worst());
    variations.evaluate(span, in_span, history, row,
                        [&](std::size_t variation, const std::vector<std::size_t>& of, const SiteRows& rows) {
                          variation_rows.append(variation, of, rows);
                        });
    ++segment;
  });
  for (Evaluations& laid : otherwise_laid) laid.of_span.clear();  // their memory is for others
  for (std::size_t other = 0; other < others.size(); ++other) {
    MotionReader& of = others[other].reader;
    std::list<Evaluations> laid;
    const auto lay = [&]() -> Starts::Spans& {
      return laid.emplace_back(job, of, threads, job.strain.factors, scratch, &all).of_span;
    };
    Starts those(lay(), lay);
    const OfSpan evaluated = [&](std::size_t span) { return of_starts(those, span); };
    if (loose && samples > 1) rehearse(of, those, evaluated, samples_of(rehearsed_varied), 0);
    pass(of, those, evaluated, [&](const MotionBlock&) {});
    choose(of, those);
    if (those.rests() == 1)  // else it is done
      for (const auto& evaluation : those.spans(0)) evaluation->find_bent();
    std::size_t seen = 0;
    each_segment(of, [&](std::size_t span, std::size_t in_span, std::size_t row) {
      Evaluation& evaluation = *those.spans(0)[span];
      std::vector<Evaluation::Site> wires = with_likely_of_bent(likely[seen++], evaluation, in_span, history, row);
      if (wires.empty()) return;
      std::vector<std::size_t> rows;
      for (const Evaluation::Site site : wires) rows.push_back(evaluation.row_of(in_span, site));
      variation_rows.append(variations.points().size() + other, rows,
                            evaluation.varied(wires, {1.0}, in_span, history, row).front());
    });
    progress(own_work + (1 - own_work) * static_cast<double>(other + 1) / static_cast<double>(others.size()));
  }
  const auto worst =
      std::max_element(evaluations.begin(), evaluations.end(),
                       [](const auto& a, const auto& b) { return a->worst_range() < b->worst_range(); });
  return {warnings, (*worst)->summary(evaluations.back()->sites_so_far())};
}

}  // namespace dresslife::strain
