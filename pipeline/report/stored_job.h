// The job in the text of a result file.
#pragma once

#include "pipeline/files/files.h"
#include "pipeline/resolve/job_text.h"

namespace dresslife::pipeline {

/// Returns the resolved job with which the file was made. Errors: InputError, which names the file.
inline Node stored_job(const FileReader& file) {
  return parse_yaml(file.text_attribute("job"), file.where().file + " (attribute job)");
}

}  // namespace dresslife::pipeline
