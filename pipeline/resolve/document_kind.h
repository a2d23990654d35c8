// Determines the kind of a document, to refuse one of a wrong kind.
#pragma once

#include "pipeline/settings/document.h"

namespace dresslife::pipeline {

enum class DocumentKind { job, study, dresspack, robot, motion, observations, duties, material, unknown };

/// Returns the kind by a key that only this kind has.
DocumentKind kind_of_document(const Node& document);

/// Errors: InputError for a document that is certainly of another kind, with the command that accepts it.
void refuse_other_kind(const Node& document, DocumentKind wanted);

}  // namespace dresslife::pipeline
