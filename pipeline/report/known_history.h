// A complete strain history: strain.h5 contains the histories of some wires, and only the turning points of the others.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "pipeline/files/files.h"

namespace dresslife::pipeline {

/// Returns whether a strain file contains the complete history of a site, as a probe or for its planes.
bool known_whole(const FileReader& strain, std::uint32_t site);

struct KnownHistory {
  std::string component;       ///< path of the wire
  double share = 1;            ///< its damage over the damage of the worst wire
  bool whole = false;          ///< false: only turning points are known, with straight lines between them
  std::vector<double> strain;  ///< (sample)

  /// Returns "signal cable 10/... (87.4 % of the worst wire's damage)".
  std::string words() const;
};

/// Returns the history of the job's worst wire if it is complete, else of the most damaged wire of its segment with a complete
/// history, else /worst/strain. strain: may be null. Errors: InputError when a file cannot be read.
KnownHistory known_history(const FileReader& life, const FileReader* strain);

}  // namespace dresslife::pipeline
