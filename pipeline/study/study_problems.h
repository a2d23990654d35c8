// Why jobs of a study cannot be made, for people.
#pragma once

#include <string>

namespace dresslife::pipeline {

struct Study;
struct StudyJob;

/// In one line: a job's first problem, and how many more it has. Empty: it can be made.
std::string first_problem(const StudyJob& job);

/// Each problem of a study's jobs once, with the jobs that have it, in the order in which they are met, a
/// line each. Empty where first_problem() of every job says it all.
std::string problem_words(const Study& study);

}  // namespace dresslife::pipeline
