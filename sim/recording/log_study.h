// What a log becomes: a study with one job per motion, a file of duties with their numbers of repeats, and words for
// the terminal.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sim/recording/log_motions.h"

namespace dresslife::sim {

/// The jobs of a study: the base, with each of the motions. base: as seen from the study's folder. The dresspack is
/// mounted once: mounting lists the keys of mounting poses that the base lacks, which are the log's first row, as if
/// it were one motion (R7).
std::string study_text(const std::string& name, const std::filesystem::path& base, const Recording& log,
                       const std::vector<std::string>& mounting, const std::vector<LogMotion>& motions);

/// The duty of the log: each motion as often per hour as in the log, or, if ramps and gaps add time to motions
/// without stands, as often as an hour takes. study: as seen from this file.
std::string duty_text(const std::string& name, const std::string& study, const Course& course,
                      const std::vector<LogMotion>& motions);

/// Before a log is read: its size, and what it takes to read it and to run its study if nothing repeats.
std::string estimate_words(const std::filesystem::path& file, const LogSize& size);

/// What was read: a line on the format, and a table of the axes.
std::vector<std::string> read_words(const Recording& log, const Course& course);

/// What the log contains, one line each: rows that do not count, gaps, speeds, cycles, rest, time and disk of the
/// study.
std::vector<std::string> log_words(const Recording& log, const Course& course, const Cycles& cycles,
                                   const std::vector<LogMotion>& motions);

}  // namespace dresslife::sim
