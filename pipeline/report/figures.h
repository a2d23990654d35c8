// Single figures of one job as files (`dresslife plot`). Some are figures 14 to 19 of the thesis.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "pipeline/base/words.h"

namespace dresslife::pipeline {

enum class Figure { strain, cycles, damage, deformation, curvature, bending, scene };
constexpr std::string_view word(Figure value) {
  return word_at({"strain", "cycles", "damage", "deformation", "curvature", "bending", "scene"}, value);
}

/// Result files of a job.
struct JobFiles {
  std::filesystem::path motion, strain, life;
};

/// Returns the name of life.h5 in a job's folder. Errors: InputError if it is absent.
std::filesystem::path life_in(const std::filesystem::path& folder);

/// Returns the result files in a job's folder; or, for one of its files, this file and the others beside it under their usual
/// names. Errors: InputError for other places.
JobFiles job_files(const std::filesystem::path& place);

/// Reads the files whole. Errors: InputError if an existing file was not made from another existing one: life.h5 from strain.h5 and
/// strain.h5 from motion.h5, according to the digests of their inputs; without strain.h5, if life.h5 and motion.h5 have different
/// numbers of samples or segments.
void check_of_one_job(const JobFiles& files);

/// Returns an SVG file.
///   strain       of the worst wire over time, the program below it (thesis, figures 16 and 17)
///   cycles       of the worst wire: number and damage of the cycles of each range
///   damage       of the worst wire of each segment, along the dresspack
///   deformation  curvature, twist and elongation along the dresspack at a time (figure 14 shows their effect
///                on a wire)
///   curvature    strain of the worst wire over the curvature of its segment (figure 15 multiplies by E)
///   bending      moment over curvature of the hose and its cables (bending_chart.h)
///   scene        robot and dresspack at a time, the worst segment marked (figures 18 and 19)
/// time: [s], the nearest sample is shown; absent: the time at which the most damaging cycle closes. Errors: InputError for a
/// file that is missing or cannot be read, files of several jobs, or a job without a damaged wire if the figure needs one.
std::string figure(Figure what, const JobFiles& files, std::optional<double> time);

}  // namespace dresslife::pipeline
