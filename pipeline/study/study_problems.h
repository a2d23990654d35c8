// Problems of invalid jobs as text.
#pragma once

#include <string>

namespace dresslife::pipeline {

struct Study;
struct StudyJob;

/// Returns one line: a job's first problem, and the number of its other problems. Empty: the job is valid.
std::string first_problem(const StudyJob& job);

/// Returns each problem of a study's jobs once, with its jobs, one per line. Empty if first_problem() of every job is complete.
std::string problem_words(const Study& study);

}  // namespace dresslife::pipeline
