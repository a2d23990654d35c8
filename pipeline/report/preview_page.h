// The page of a job before its run, from the file of `dresslife-sim --preview`: robot, clamps, cell and each dresspack as a
// smooth curve over the program; the reason if the simulation refuses the job, and suitable lengths.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace dresslife::pipeline {

/// Returns suitable lengths of each dresspack and their bend radius at rest, as sentences. Errors: InputError when the file
/// cannot be read.
std::vector<std::string> length_words(const std::filesystem::path& preview_file);

/// Returns the reason why the simulation refuses the job; empty: it accepts the job.
std::string refusal_of(const std::filesystem::path& preview_file);

/// Returns the page as text. name: name of the job; made_from: 32 digits, which made_from_of() of page_shell.h
/// reads. failure: error of the simulation's run, shown if the simulation did not refuse the job.
std::string preview_page(const std::filesystem::path& preview_file, const std::string& name,
                         const std::string& made_from, const std::string& failure = "");

}  // namespace dresslife::pipeline
