// The two forms in which a job gives its dresspacks, and its keys in either.
#pragma once

#include "pipeline/job/job.h"

namespace dresslife::pipeline {

/// One dresspack by two keys of the job itself, or a list. The manual describes both.
struct JobForms {
  bool one = true, list = false;
};
/// Precondition of reading: the job's list is empty when the document has one.
JobForms forms_of(const Job& job);

void describe_keys(Fields& f, Job& job, const JobForms& forms);

}  // namespace dresslife::pipeline
