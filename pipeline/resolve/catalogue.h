// Catalogue entries by name, and changes of single keys: from a job as it is written to one whole tree.
#pragma once

#include <string>
#include <vector>

#include "pipeline/settings/document.h"
#include "pipeline/settings/problems.h"

namespace dresslife::pipeline {

/// Folders of the catalogue: "robots", "programs", "dresspacks", "materials". A name is looked up beside the
/// file that names it and in its parents (FOLDER/NAME.yaml, config/FOLDER/NAME.yaml; the working folder for
/// --set), then in the same way beside the job (a study or --set may change a job of another place), then in
/// the catalogue that comes with dresslife (installation.h: DRESSLIFE_CONFIG names another). Errors:
/// InputError with the near names.
Node catalogue_entry(const std::string& folder, const std::string& name, const Where& named_at,
                     const Where& job);

/// The entry that a name probably means: "KR 16-2" is kuka_kr16_2, else the nearest by spelling. Empty: none is near.
std::string nearest_entry(const std::string& name, const std::vector<std::string>& entries);

/// Writes out every entry that a job names, the cables that it gives by data sheets, and the materials that
/// its dresspacks name. What cannot be is added to the problems, with the key that stays as it was written.
void resolve_job(Node& job, Problems& problems);
/// The same. Errors: InputError, all at once.
void resolve_job(Node& job);

/// Takes the lines `key.path: value` of a job's first level out of it and sets what they name, wholes before their
/// parts. Errors: InputError at the line.
void apply_lines(Node& job);

/// Applies the job's own lines, then sets the value at a key path (`simulation.segments`, `dresspacks.2.routing.free_length_m`); where: who
/// asks for it.
void set_value(Node& job, const std::string& path, Node value, const Where& where);

/// The value at a key path of a tree whose entries are written out. Null: nothing there.
const Node* value_at(const Node& tree, const std::string& path);

/// Sets the value at `key.path=value` in a job's tree; list items count from 1. Errors: InputError.
void apply_set(Node& job, const std::string& set);

}  // namespace dresslife::pipeline
