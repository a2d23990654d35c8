// One of the stages' programs, started and waited for.
#pragma once

#include <string>
#include <vector>

namespace dresslife::pipeline {

/// Runs the program of this name, which lies beside this one; it says what it says and ends with this one.
/// Returns its exit status. Errors: InputError when it cannot be started or is killed.
int run_stage_program(const std::string& program, const std::vector<std::string>& arguments);

}  // namespace dresslife::pipeline
