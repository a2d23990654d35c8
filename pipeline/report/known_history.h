// A complete strain history: strain.h5 contains those of some wires, of all others only turning points.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "pipeline/files/files.h"

namespace dresslife::pipeline {

/// Whether a strain file contains the complete history of a site, as a probe or for its planes.
bool known_whole(const FileReader& strain, std::uint32_t site);

struct KnownHistory {
  std::string component;  ///< path of the wire
  double share = 1;       ///< its damage over the worst wire's
  bool whole = false;     ///< false: straight between its turning points
  std::vector<double> strain;  ///< (sample)

  /// "signal cable 10/... (87.4 % of the worst wire's damage)".
  std::string words() const;
};

/// The job's worst wire if its history is complete, else the most damaged wire of its segment with a complete history,
/// else /worst/strain. strain: may be null. Errors: InputError when a file cannot be read.
KnownHistory known_history(const FileReader& life, const FileReader* strain);

}  // namespace dresslife::pipeline
