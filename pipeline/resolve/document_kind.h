// Which kind of file a document is, for one that is given where another belongs.
#pragma once

#include "pipeline/settings/document.h"

namespace dresslife::pipeline {

enum class DocumentKind { job, study, dresspack, robot, motion, observations, duties, material, unknown };

/// By the keys that only this kind has.
DocumentKind kind_of_document(const Node& document);

/// Errors: InputError for a document that is surely of another kind, with the command that takes it.
void refuse_other_kind(const Node& document, DocumentKind wanted);

}  // namespace dresslife::pipeline
