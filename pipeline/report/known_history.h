// A strain history without gaps: strain.h5 holds some wires' whole, of all others their turning points.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "pipeline/files/files.h"

namespace dresslife::pipeline {

/// Whether a strain file holds the whole history of a site, as a probe or to judge its planes.
bool known_whole(const FileReader& strain, std::uint32_t site);

struct KnownHistory {
  std::string component;  ///< path of the wire
  double share = 1;       ///< its damage over the worst wire's
  bool whole =
      false;  ///< else straight between its turning points, which misses most of what lies between them
  std::vector<double> strain;  ///< (sample)

  /// "signal cable 10/... (87.4 % of the worst wire's damage)".
  std::string words() const;
};

/// The job's worst wire where it is known whole, else that of the probed wires of its segment that is damaged
/// most, else the worst as /worst/strain has it. strain: may be none. Errors: InputError when a file cannot
/// be read.
KnownHistory known_history(const FileReader& life, const FileReader* strain);

}  // namespace dresslife::pipeline
