// motion.h5 in, strain.h5 out: the evaluation wired to the files, in blocks of rows so that memory does not
// grow with the motion beyond a few histories.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "pipeline/base/warnings.h"
#include "pipeline/files/files.h"

namespace dresslife::pipeline {
struct Job;
}

namespace dresslife::strain {

/// Histories of so many bytes are held at a time, what friction holds counted in; for more, the motion is
/// read again for the next segments.
constexpr std::size_t default_history_bytes = std::size_t{128} << 20;

/// What the stage tells.
struct Notes {
  std::vector<pipeline::Warning> warnings;
  std::string summary;  ///< one line on the worst site
};

/// Writes every dataset of strain.h5. threads: any number gives the same bytes. progress: share of the work
/// done. Errors: InputError for a motion without samples, a dresspack without wires, and those of
/// Construction and Evaluation.
Notes write_strain(const pipeline::FileReader& motion, const pipeline::Job& job, pipeline::FileWriter& strain,
                   std::size_t threads, const std::function<void(double)>& progress,
                   std::size_t history_bytes = default_history_bytes);

}  // namespace dresslife::strain
