// The job whose text a result file holds.
#pragma once

#include "pipeline/files/files.h"
#include "pipeline/resolve/job_text.h"

namespace dresslife::pipeline {

/// Resolved, as it ran. Errors: InputError, which names the file.
inline Node stored_job(const FileReader& file) {
  return parse_yaml(file.text_attribute("job"), file.where().file + " (attribute job)");
}

}  // namespace dresslife::pipeline
