// What stands where before a run: the robot over its program, clamps, and each dresspack in a smooth curve of
// its length; how far its clamps are apart, which lengths suit that, and how hard each would be bent at rest.
#pragma once

#include "pipeline/files/files.h"

namespace dresslife::pipeline {
struct Setup;
}

namespace dresslife::sim {

/// Lengths with slack as the checks ask for (checks.h): at least least_slack_share of the length L where the
/// way w is longest, at most most_slack_share there: w / (1 - least) <= L <= w / (1 - most).
struct WorkingLength {
  double least = 0, most = 0;  ///< [m]
};
WorkingLength working_length(double longest_way);

/// Writes all of preview_format() but the stamp. The first sample stands at -1 s in the mounting pose where
/// that is not the program's first. Errors: InputError for a motion that the robot cannot run; what the
/// simulation itself refuses stands in the file.
void write_preview(const pipeline::Setup& setup, pipeline::FileWriter& file);

}  // namespace dresslife::sim
