// Memory of a strain evaluation, from the sizes of its motion and its dresspacks (pipeline/stage/memory.h).
#pragma once

#include <cstddef>

#include "pipeline/base/errors.h"
#include "pipeline/stage/memory.h"

namespace dresslife::pipeline {
struct Job;
class FileReader;
}  // namespace dresslife::pipeline

namespace dresslife::strain {

/// Errors: InputError if the samples or sites exceed the numbers of strain.h5, and the errors of Construction.
pipeline::MemoryNeed memory_of(const pipeline::FileReader& motion, const pipeline::Job& job, std::size_t threads);

/// strain.h5 numbers samples and sites in 32 bits. The largest 32-bit number means "none".
inline constexpr double most_numbered = 4294967294.0;
/// Throws InputError at `where` if one of the numbers exceeds most_numbered.
void check_counts(const pipeline::Where& where, double samples, double sites);

}  // namespace dresslife::strain
