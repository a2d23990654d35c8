// Reads a file with the HDF5 library and the library's own filters.
#pragma once

#include <hdf5.h>

#include <filesystem>
#include <string>
#include <vector>

#include "tests/catch.h"

namespace dresslife::pipeline {

/// Returns all numbers of a dataset. type: the HDF5 type of T in memory.
template <class T>
std::vector<T> read_by_library(const std::filesystem::path& file, const std::string& dataset, hid_t type) {
  const hid_t opened = H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  REQUIRE(opened >= 0);
  const hid_t numbers = H5Dopen2(opened, dataset.c_str(), H5P_DEFAULT), space = H5Dget_space(numbers);
  REQUIRE(H5Sget_simple_extent_npoints(space) > 0);
  std::vector<T> read(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
  REQUIRE(H5Dread(numbers, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, read.data()) >= 0);
  H5Sclose(space);
  H5Dclose(numbers);
  H5Fclose(opened);
  return read;
}

}  // namespace dresslife::pipeline
