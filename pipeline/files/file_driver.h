// HDF5 driver for files of this project, which replaces the library's own file driver.
//
// A file is written through a WholeFile. If a write fails, the driver reports success to the library, and WholeFile::commit()
// reports the error. Reason: after a failed close the library crashes when the program ends, so it must not see a failure.
//
// A file is read through InputBytes, which compare every read with the checked bytes and store the first failure.
#pragma once

#include <cstdint>

namespace dresslife::pipeline {

class InputBytes;
class WholeFile;

/// Returns an HDF5 identifier of a file access property list, for H5Fcreate() and H5Fopen() with any name. The caller closes it.
/// Precondition: the argument outlives the HDF5 file. Negative: out of memory.
std::int64_t access_for_writing(WholeFile& file);
std::int64_t access_for_reading(InputBytes& file);

}  // namespace dresslife::pipeline
