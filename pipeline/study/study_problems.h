// Problems of invalid jobs as text.
#pragma once

#include <string>

namespace dresslife::pipeline {

struct Study;
struct StudyJob;

/// One line: a job's first problem, and the number of others. Empty: it is valid.
std::string first_problem(const StudyJob& job);

/// Each problem of a study's jobs once, with its jobs, a line each. Empty if first_problem() of every job is complete.
std::string problem_words(const Study& study);

}  // namespace dresslife::pipeline
