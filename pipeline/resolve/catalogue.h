// Catalogue entries by name, and changes of single keys: builds the complete tree of a job from the written one.
#pragma once

#include <string>
#include <vector>

#include "pipeline/settings/document.h"
#include "pipeline/settings/problems.h"

namespace dresslife::pipeline {

/// Returns the entry of a name. folder: "robots", "programs", "dresspacks" or "materials". The name is searched beside the file
/// that names it and in its parent folders (FOLDER/NAME.yaml, config/FOLDER/NAME.yaml; for --set, from the working folder), then
/// in the same way beside the job (because a study or --set may change a job in another folder), then in the catalogue of
/// dresslife (installation.h; DRESSLIFE_CONFIG replaces it). Errors: InputError with similar names.
Node catalogue_entry(const std::string& folder, const std::string& name, const Where& named_at, const Where& job);

/// Returns the entry that a name probably means: kuka_kr16_2 for "KR 16-2", otherwise the nearest by spelling. Empty: none is
/// near.
std::string nearest_entry(const std::string& name, const std::vector<std::string>& entries);

/// Replaces the names of a job by their entries, data sheets of cables by their layers, and adds the materials that its
/// dresspacks name. Errors are added to `problems`, with the key whose value stays as written.
void resolve_job(Node& job, Problems& problems);
/// Calls resolve_job() above. Errors: InputErrors with all problems.
void resolve_job(Node& job);

/// Removes the lines `key.path: value` from the first level of a job and sets their values; maps before their parts. Errors:
/// InputError at the line.
void apply_lines(Node& job);

/// Applies the job's own lines, then sets the value at a key path (`simulation.segments`, `dresspacks.2.routing.free_length_m`).
/// where: place of the request.
void set_value(Node& job, const std::string& path, Node value, const Where& where);

/// Returns the value at a key path of a tree with resolved entries; null: there is none.
const Node* value_at(const Node& tree, const std::string& path);

/// Sets the value of `key.path=value` in a job's tree; items of lists count from 1. Errors: InputError.
void apply_set(Node& job, const std::string& set);

}  // namespace dresslife::pipeline
