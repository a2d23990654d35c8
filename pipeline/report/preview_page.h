// The page of a job before its run: robot, clamps, cell and each dresspack in a smooth curve, over the
// program; what the simulation refuses, and which lengths suit. From the file that `dresslife-sim --preview`
// writes.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace dresslife::pipeline {

/// Which lengths each dresspack may have, and how hard they are bent at rest: sentences for terminal and
/// page. Errors: InputError when the file cannot be read.
std::vector<std::string> length_words(const std::filesystem::path& preview_file);

/// Why the simulation refuses the job; empty: it takes it.
std::string refusal_of(const std::filesystem::path& preview_file);

/// The page as text. name: of the job; made_from: 32 digits, which made_from_of() of page_shell.h finds in
/// it. failure: what stopped the simulation on its way, shown where it refuses nothing before.
std::string preview_page(const std::filesystem::path& preview_file, const std::string& name,
                         const std::string& made_from, const std::string& failure = "");

}  // namespace dresslife::pipeline
