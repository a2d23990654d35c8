// The result of a log: a study with one job per motion, a file of duties with their numbers of repeats, and text for
// the terminal.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sim/recording/log_motions.h"

namespace dresslife::sim {

/// Returns the study: the base job with each of the motions. base: path relative to the study's folder. The dresspack is
/// mounted once: `mounting` lists the keys of mounting poses that the base does not have. They get the log's first row, as if
/// the log were one motion (R7).
std::string study_text(const std::string& name, const std::filesystem::path& base, const Recording& log,
                       const std::vector<std::string>& mounting, const std::vector<LogMotion>& motions);

/// Returns the duty of the log: each motion with its repeats per hour in the log; or, if ramps and gaps add time to motions
/// without standstills, with the number that fits into an hour. motions: end at samples. study: path relative to this file.
std::string duty_text(const std::string& name, const std::string& study, const Course& course,
                      const std::vector<LogMotion>& motions);

/// Returns text for the time before a log is read: its size, and the cost of reading it and of running its study if nothing
/// repeats.
std::string estimate_words(const std::filesystem::path& file, const LogSize& size);

/// Returns a line on the format, and a table of the axes.
std::vector<std::string> read_words(const Recording& log, const Course& course);

/// Returns the content of the log, one line each: ignored rows, gaps, speeds, cycles, rest, time and disk of the
/// study.
std::vector<std::string> log_words(const Recording& log, const Course& course, const Cycles& cycles,
                                   const std::vector<LogMotion>& motions);

}  // namespace dresslife::sim
