// HDF5 on open files of ours, instead of the library's own driver for files.
//
// Writing goes through a WholeFile. If a write fails, the driver reports success to the library, and
// WholeFile::commit() reports the error. Reason: after a failed close the library crashes when the program ends. It
// never sees a failure.
//
// Reading goes through InputBytes, which hold every read to the bytes that were checked and keep the first failure.
#pragma once

#include <cstdint>

namespace dresslife::pipeline {

class InputBytes;
class WholeFile;

/// An HDF5 identifier of a file access property list, for H5Fcreate() and H5Fopen() with any name; the caller
/// closes it. What is pointed to outlives the HDF5 file. Negative: out of memory.
std::int64_t access_for_writing(WholeFile& file);
std::int64_t access_for_reading(InputBytes& file);

}  // namespace dresslife::pipeline
