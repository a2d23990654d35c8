// HDF5 on open files of ours, instead of the library's own driver for files.
//
// Writing goes through a WholeFile: when a write fails, the library is told that all is well and the
// WholeFile keeps the error for whoever commits it. The library believes what a failed close leaves behind
// and crashes over it when the program ends; with a driver that never fails it has nothing to stumble over.
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
