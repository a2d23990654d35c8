#include "strain/strain_file.h"

#include <algorithm>
#include <functional>
#include <memory>
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
      : file_(file), lengths_(file.read<double>("/segment/length")), samples_(file.rows("/time")) {
    for (const SpanPlace& place : list_spans())
      spans_.push_back({place, DeformationGauge(lengths_of(spans_.size()), measure)});
  }

  std::size_t samples() const { return samples_; }
  const std::vector<double>& lengths() const { return lengths_; }
  std::size_t spans() const { return spans_.size(); }
  const SpanPlace& place(std::size_t span) const { return spans_[span].place; }
  /// Of the segments between one clamp and the next.
  std::vector<double> lengths_of(std::size_t span) const {
    return {lengths_.begin() + ends_[span], lengths_.begin() + ends_[span + 1]};
  }

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
        for (std::size_t k = 0; k < spans_.size(); ++k) {
          const std::size_t begin = ends_[k], size = ends_[k + 1] - begin;
          // A file that does not say where its clamps are has two that count, the first and the last.
          const std::size_t held = spans_.size() == 1 ? clamps : 2, clamp = spans_.size() == 1 ? 0 : k;
          spans_[k].gauge.measure({row(position, 3 * segments).subspan(3 * begin, 3 * size),
                                   row(orientation, 4 * segments).subspan(4 * begin, 4 * size),
                                   row(clamp_position, 3 * clamps).subspan(3 * clamp, 3 * held),
                                   row(clamp_orientation, 4 * clamps).subspan(4 * clamp, 4 * held)},
                                  std::span(deformation).subspan(t * segments + begin, size));
        }
      }
      put(first, deformation);
    }
  }

 private:
  struct OneSpan {
    SpanPlace place;
    DeformationGauge gauge;
  };

  /// Fills ends_: segments before each clamp.
  std::vector<SpanPlace> list_spans() {
    ends_ = {0, lengths_.size()};
    if (file_.has("/clamp/segment")) {
      const auto before = file_.read<std::int32_t>("/clamp/segment");
      const bool rises = std::is_sorted(before.begin(), before.end(), std::less_equal<>());
      if (before.size() < 2 || !rises || before.front() != 0 ||
          before.back() != static_cast<int>(lengths_.size()))
        throw pipeline::InputError(file_.where(),
                                   "/clamp/segment does not rise from 0 to the number of segments",
                                   "run dresslife-sim again");
      ends_.assign(before.begin(), before.end());
    }
    std::vector<SpanPlace> places;
    double arc = 0;
    for (std::size_t k = 0; k + 1 < ends_.size(); ++k) {
      places.push_back({ends_[k], lengths_.size(), arc});
      for (std::size_t i = ends_[k]; i < ends_[k + 1]; ++i) arc += lengths_[i];
    }
    return places;
  }

  const FileReader& file_;
  std::vector<double> lengths_;
  std::size_t samples_;
  std::vector<std::size_t> ends_;
  std::vector<OneSpan> spans_;
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
  if (job.dresspacks.size() > 1)
    throw pipeline::InputError(motion.where(), "comes from several dresspacks (one is evaluated)",
                               "simulate one of them alone");
  if (job.dresspacks.front().dresspack.components.empty())
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
  const Construction construction(job.dresspacks.front().dresspack, job.strain.kinematics);
  std::vector<std::unique_ptr<Evaluation>> evaluations;  // (span): each slips from clamp to clamp
  for (std::size_t k = 0; k < reader.spans(); ++k)
    evaluations.push_back(std::make_unique<Evaluation>(construction, job.strain, reader.lengths_of(k),
                                                       samples, threads, reader.place(k)));
  strain.set_axis("segment", segments);
  strain.set_axis("level", construction.levels());
  strain.set_axis("sample", samples);
  copy_program(motion, strain);
  SiteWriter sites(strain, "", *evaluations[0]), stick(strain, "/bound_stick", *evaluations[0]),
      free(strain, "/bound_free", *evaluations[0]);

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
    const std::size_t count = block.size() / segments;
    for (std::size_t k = 0; k < evaluations.size(); ++k) {
      const std::size_t begin = reader.place(k).first_segment, size = evaluations[k]->segments();
      DeformationHistory all(size, count);
      for (std::size_t t = 0; t < count; ++t)
        for (std::size_t i = 0; i < size; ++i) all.set(i, t, block[t * segments + begin + i]);
      evaluations[k]->add(all);
    }
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
  std::size_t span = 0;
  for (std::size_t segment = 0; segment < segments; ++segment) {
    if (segment == reader.place(span).first_segment + evaluations[span]->segments()) ++span;
    const std::size_t row = segment % per_pass;
    if (row == 0 && segment > 0)
      reader.run([&](std::size_t first, std::span<const Deformation> block) { keep(segment, first, block); });
    evaluations[span]->evaluate(segment - reader.place(span).first_segment, history, row, sink);
  }
  const auto worst =
      std::max_element(evaluations.begin(), evaluations.end(),
                       [](const auto& a, const auto& b) { return a->worst_range() < b->worst_range(); });
  return (*worst)->summary();
}

}  // namespace dresslife::strain
