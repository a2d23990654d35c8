#include "pipeline/files/file_driver.h"

#include <hdf5.h>

#include <algorithm>
#include <new>

#include "pipeline/base/whole_file.h"
#include "pipeline/files/checksum.h"

namespace dresslife::pipeline {
namespace {

static_assert(sizeof(hid_t) == sizeof(std::int64_t));

/// Data of the access list for open_file().
struct Target {
  WholeFile* written = nullptr;
  InputBytes* read = nullptr;  ///< one of the two pointers is set
};

/// An open file of the library; the library's own part is first.
struct OpenFile {
  H5FD_t library{};
  Target target;
  haddr_t end_of_use = 0;   ///< bytes that the library has allocated
  haddr_t end_of_file = 0;  ///< bytes that were written
};

OpenFile& opened(H5FD_t* file) { return *reinterpret_cast<OpenFile*>(file); }
const OpenFile& opened(const H5FD_t* file) { return *reinterpret_cast<const OpenFile*>(file); }

H5FD_t* open_file(const char*, unsigned, hid_t access, haddr_t) {
  const void* info = H5Pget_driver_info(access);
  if (!info) return nullptr;
  auto* made = new (std::nothrow) OpenFile;
  if (!made) return nullptr;
  made->target = *static_cast<const Target*>(info);
  if (made->target.read) made->end_of_file = made->target.read->size();
  return &made->library;
}

herr_t close_file(H5FD_t* file) {
  delete &opened(file);
  return 0;
}

/// Flags like those of the library's own driver: the library collects small pieces before it calls the driver.
herr_t print_abilities(const H5FD_t*, unsigned long* flags) {
  if (flags)
    *flags = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE |
             H5FD_FEAT_AGGREGATE_SMALLDATA;
  return 0;
}

haddr_t get_end_of_use(const H5FD_t* file, H5FD_mem_t) { return opened(file).end_of_use; }
herr_t set_end_of_use(H5FD_t* file, H5FD_mem_t, haddr_t address) {
  opened(file).end_of_use = address;
  return 0;
}
haddr_t get_end_of_file(const H5FD_t* file, H5FD_mem_t) { return opened(file).end_of_file; }

/// A file that is only read has no bytes beyond its end, whatever lengths its tables state. A file that is being written has
/// allocated places without content yet; they are read as zeros.
herr_t read_bytes(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t address, size_t count, void* bytes) {
  const OpenFile& from = opened(file);
  const std::size_t there = address >= from.end_of_file ? 0 : std::min<haddr_t>(count, from.end_of_file - address);
  if (from.target.read) return there == count && from.target.read->read(bytes, count, address) ? 0 : -1;
  std::fill_n(static_cast<char*>(bytes) + there, count - there, '\0');
  return from.target.written->read_back(bytes, there, address) ? 0 : -1;
}

herr_t write_bytes(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t address, size_t count, const void* bytes) {
  OpenFile& to = opened(file);
  if (!to.target.written) return -1;
  to.target.written->write_at(bytes, count, address);
  to.end_of_file = std::max<haddr_t>(to.end_of_file, address + count);
  return 0;
}

/// Called after the library has returned its last space. The length is always set, also if the last write produced it already:
/// otherwise the path of the code would depend on the sizes of packed data.
herr_t cut_file(H5FD_t* file, hid_t, hbool_t) {
  OpenFile& of = opened(file);
  if (!of.target.written) return 0;
  of.target.written->set_length(of.end_of_use);
  of.end_of_file = of.end_of_use;
  return 0;
}

H5FD_class_t driver_table() {
  H5FD_class_t table{};
#ifdef H5FD_CLASS_VERSION  // in HDF5 1.14, not in 1.10
  table.version = H5FD_CLASS_VERSION;
  table.value = 256;  // the first value for programs; no file contains it
#endif
  table.name = "dresslife";
  table.maxaddr = HADDR_MAX;
  table.fc_degree = H5F_CLOSE_WEAK;
  table.fapl_size = sizeof(Target);
  table.open = open_file;
  table.close = close_file;
  table.query = print_abilities;
  table.get_eoa = get_end_of_use;
  table.set_eoa = set_end_of_use;
  table.get_eof = get_end_of_file;
  table.read = read_bytes;
  table.write = write_bytes;
  table.truncate = cut_file;
  const H5FD_mem_t map[] = H5FD_FLMAP_DICHOTOMY;  // that of the library: raw data separate from its tables
  std::ranges::copy(map, table.fl_map);
  return table;
}

hid_t access_for(const Target& target) {
  static const H5FD_class_t table = driver_table();
  static const hid_t driver = H5FDregister(&table);
  const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
  if (access >= 0 && H5Pset_driver(access, driver, &target) < 0) {
    H5Pclose(access);
    return -1;
  }
  return access;
}

}  // namespace

std::int64_t access_for_writing(WholeFile& file) { return access_for({&file, nullptr}); }
std::int64_t access_for_reading(InputBytes& file) { return access_for({nullptr, &file}); }

}  // namespace dresslife::pipeline
