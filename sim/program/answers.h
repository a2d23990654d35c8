// The file of answers: all that a program asks, in one YAML file with the keys of a job's motion.
#pragma once

#include <string>
#include <vector>

#include "pipeline/job/motion.h"
#include "sim/program/program.h"

namespace dresslife::sim {

/// Every question of the problems as an entry to fill in, behind the answers that were given before. Each has its line of the
/// program, what is missing there and how an answer is written. Answers that are safe stand there already.
std::string answers_text(const std::vector<Problem>& problems, const pipeline::Motion& given);

/// How many entries that makes without the answers given before.
std::size_t question_count(const std::vector<Problem>& problems);

/// Adds what a file of answers holds; an entry that is empty counts as not given.
/// Errors: InputError.
void add_answers(const std::filesystem::path& file, pipeline::Motion& motion);

}  // namespace dresslife::sim
