// The two forms of dresspacks in a job, and the keys of each form.
#pragma once

#include "pipeline/job/job.h"

namespace dresslife::pipeline {

/// `one`: the job's own keys describe one dresspack. `list`: a list of dresspacks. The manual describes both forms.
struct JobForms {
  bool one = true, list = false;
};
/// Returns the form of a job. Precondition of reading: the job's list is empty if the document has a list.
JobForms forms_of(const Job& job);

void describe_keys(Fields& f, Job& job, const JobForms& forms);

}  // namespace dresslife::pipeline
