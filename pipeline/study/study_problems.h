// Problems of invalid jobs as text.
#pragma once

#include <string>

#include "pipeline/base/errors.h"

namespace dresslife::pipeline {

struct Study;
struct StudyJob;

/// Returns one line: a job's first problem, and the number of its other problems. Empty: the job is valid.
std::string first_problem(const StudyJob& job);

/// Returns each problem of a study's jobs once, with its jobs, one per line. Empty if first_problem() of every job is complete.
std::string problem_words(const Study& study);

/// Refuses a job whose dresspacks have no wires, for a command that compares lives.
[[noreturn]] void refuse_without_wires(const Where& where, const std::string& job);
/// Calls refuse_without_wires() for the first valid job without wires.
void require_wires(const Study& study, const Where& where);

}  // namespace dresslife::pipeline
