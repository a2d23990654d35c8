#include "strain/strain_file.h"

#include <algorithm>
#include <span>

#include "strain/evaluation.h"

namespace dresslife::strain {
namespace {

using pipeline::FileReader;
using pipeline::FileWriter;

constexpr std::size_t block_samples = 512;  // rows read at a time
constexpr double first_pass_share = 0.05;   // of the work, for the progress display

/// Reads the motion block by block and measures the deformation of every segment.
class MotionReader {
 public:
  MotionReader(const FileReader& file, pipeline::DeformationMeasure measure)
      : file_(file),
        lengths_(file.read<double>("/segment/length")),
        samples_(file.rows("/time")),
        gauge_(lengths_, measure) {}

  std::size_t samples() const { return samples_; }
  const std::vector<double>& lengths() const { return lengths_; }

  /// Calls put(first sample, deformations (sample, segment)) for one block after the other.
  void run(const std::function<void(std::size_t, std::span<const Deformation>)>& put) {
    const std::size_t segments = lengths_.size();
    const std::size_t clamps = file_.row_size("/clamp/position") / 3;
    std::vector<double> position, orientation, clamp_position, clamp_orientation;
    std::vector<Deformation> deformation;
    for (std::size_t first = 0; first < samples_; first += block_samples) {
      const std::size_t count = std::min(block_samples, samples_ - first);
      file_.read_rows("/segment/position", first, count, position);
      file_.read_rows("/segment/orientation", first, count, orientation);
      file_.read_rows("/clamp/position", first, count, clamp_position);
      file_.read_rows("/clamp/orientation", first, count, clamp_orientation);
      deformation.resize(count * segments);
      for (std::size_t t = 0; t < count; ++t) {
        auto row = [&](const std::vector<double>& of, std::size_t size) {
          return std::span(of).subspan(t * size, size);
        };
        gauge_.measure({row(position, 3 * segments), row(orientation, 4 * segments),
                        row(clamp_position, 3 * clamps), row(clamp_orientation, 4 * clamps)},
                       std::span(deformation).subspan(t * segments, segments));
      }
      put(first, deformation);
    }
  }

 private:
  const FileReader& file_;
  std::vector<double> lengths_;
  std::size_t samples_;
  DeformationGauge gauge_;
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
  SiteWriter(FileWriter& file, std::string group, const Evaluation& evaluation)
      : file_(file), group_(std::move(group)) {
    file_.set_text_width(group_ + "/site/component", evaluation.longest_path());
    file_.set_text_width(group_ + "/site/material", evaluation.longest_material());
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

void copy_program(const FileReader& motion, FileWriter& strain) {
  strain.append("/time", motion.read<double>("/time"));
  strain.append("/segment/length", motion.read<double>("/segment/length"));
  strain.append("/program/step", motion.read<std::int32_t>("/program/step"));
  strain.append("/program/text", motion.read<std::string>("/program/text"));
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
  if (std::any_of(reader.lengths().begin(), reader.lengths().end(),
                  [](double length) { return !(length > 0); }))
    throw pipeline::InputError(motion.where(), "has a segment whose rest length is not above 0",
                               "run dresslife-sim again");
  if (job.dresspack.components.empty())
    throw pipeline::InputError(motion.where(),
                               "comes from a dresspack without components (there is no wire to evaluate)",
                               "give dresspack.components");
}

}  // namespace

std::string write_strain(const FileReader& motion, const pipeline::Job& job, FileWriter& strain,
                         std::size_t threads, const std::function<void(double)>& progress,
                         std::size_t history_bytes) {
  MotionReader reader(motion, job.strain.deformation);
  check(motion, job, reader);
  const std::size_t segments = reader.lengths().size(), samples = reader.samples();
  const Construction construction(job.dresspack, job.strain.kinematics);
  Evaluation evaluation(construction, job.strain, reader.lengths(), samples, threads);
  strain.set_axis("segment", segments);
  strain.set_axis("level", construction.levels());
  strain.set_axis("sample", samples);
  copy_program(motion, strain);
  SiteWriter sites(strain, "", evaluation), stick(strain, "/bound_stick", evaluation),
      free(strain, "/bound_free", evaluation);

  const std::size_t per_pass =
      std::clamp<std::size_t>(history_bytes / (samples * sizeof(Deformation)), 1, segments);
  DeformationHistory history(per_pass, samples);  // of segments [first_segment, first_segment + per_pass)
  auto keep = [&](std::size_t first_segment, std::size_t first, std::span<const Deformation> block) {
    for (std::size_t k = 0; k < block.size(); ++k)
      if (const std::size_t segment = k % segments;
          segment >= first_segment && segment < first_segment + per_pass)
        history.set(segment - first_segment, first + k / segments, block[k]);
  };
  reader.run([&](std::size_t first, std::span<const Deformation> block) {
    append_deformation(strain, block);
    DeformationHistory all(segments, block.size() / segments);
    for (std::size_t k = 0; k < block.size(); ++k) all.set(k % segments, k / segments, block[k]);
    evaluation.add(all);
    keep(0, first, block);
    progress(first_pass_share * static_cast<double>(first) / static_cast<double>(samples));
  });

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
  sink.progress = [&](double share) { progress(first_pass_share + (1 - first_pass_share) * share); };
  for (std::size_t segment = 0; segment < segments; ++segment) {
    const std::size_t row = segment % per_pass;
    if (row == 0 && segment > 0)
      reader.run([&](std::size_t first, std::span<const Deformation> block) { keep(segment, first, block); });
    evaluation.evaluate(segment, history, row, sink);
  }
  return evaluation.summary();
}

}  // namespace dresslife::strain
