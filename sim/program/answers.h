// The file of answers: all questions of a program, in one YAML file with the keys of a job's motion.
#pragma once

#include <string>
#include <vector>

#include "pipeline/job/motion.h"
#include "sim/program/interpreter/program.h"

namespace dresslife::sim {

/// Every question of the problems as an entry to fill in, after the given answers. Each has its line of the program,
/// the missing value and the form of the answer. Safe answers are filled in.
std::string answers_text(const std::vector<Problem>& problems, const pipeline::Motion& given);

/// Number of entries without the given answers.
std::size_t question_count(const std::vector<Problem>& problems);

/// Adds the answers of a file; empty entries are ignored.
/// Errors: InputError.
void add_answers(const std::filesystem::path& file, pipeline::Motion& motion);

}  // namespace dresslife::sim
