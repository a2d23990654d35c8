// The place of a dresspack that the pictures of a job mark.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "pipeline/files/files.h"

namespace dresslife::pipeline {

struct MarkedPlace {
  std::size_t segment = 0;  ///< index in the file
  int from_tool = 0;        ///< number in its dresspack, 1 is nearest to the tool
  std::string dresspack;    ///< empty: there is one
  double time = 0;          ///< at which the most damaging cycle closes there [s]
  bool fails_first =
      false;  ///< the place of the conductor that fails first; else of the worst wire, if no conductor can fail or an
              ///< older file does not state it
};

/// Returns the place; absent: no wire is damaged.
std::optional<MarkedPlace> marked_place(const FileReader& life);

}  // namespace dresslife::pipeline
