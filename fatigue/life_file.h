// Reads strain.h5 and writes the datasets of life.h5 that pipeline/files/formats.cpp lists for dresslife-life.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "pipeline/base/warnings.h"
#include "pipeline/files/files.h"

namespace dresslife::pipeline {
struct Job;
}

namespace dresslife::fatigue {

/// Messages that the stage prints on a terminal.
struct Notes {
  std::vector<pipeline::Warning> warnings;
  std::string summary;  ///< one line: life, place, wire
};

/// Writes all of life.h5 except the stamp. Memory: the damage of every site, the reversals of a block of sites, and one row of
/// samples; apart from that it does not grow with the length of the motion.
/// @throws pipeline::InputError when the strain file contradicts itself.
Notes write_life(const pipeline::FileReader& strain, const pipeline::Job& job, pipeline::FileWriter& life,
                 std::size_t threads, const std::function<void(double)>& progress);

}  // namespace dresslife::fatigue
