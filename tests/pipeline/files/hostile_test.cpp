// Files that declare more data than they hold, or that point elsewhere. They are refused before memory is allocated or another
// file is read.
#include <hdf5.h>

#include <cstring>
#include <fstream>
#include <vector>

#include "pipeline/files/files.h"
#include "pipeline/files/list_deflate.h"
#include "tests/catch.h"
#include "tests/pipeline/scratch.h"

using namespace dresslife::pipeline;

namespace {

const Format two_rows{
    "dresslife-rows", 1, "dresslife-maker", "tests", {{"/group/rows", Type::f64, {"row", "2"}, "m", "rows"}}, {}};

/// A file of the format without a checksum block. `change` may replace a dataset.
class Made {
 public:
  Made() {
    FileWriter writer(scratch_ / "whole.h5", two_rows);
    writer.append("/group/rows", std::span<const double>(std::vector<double>{1, 2, 3, 4}));
    writer.attribute("job", std::string("a: 1\n"));
    writer.commit();
    std::ofstream(scratch_ / "f.h5", std::ios::binary) << bytes_of(scratch_ / "whole.h5").substr(512);
    file_ = H5Fopen((scratch_ / "f.h5").c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    REQUIRE(file_ >= 0);
  }
  hid_t file() const { return file_; }
  void remove(const char* path) const { REQUIRE(H5Ldelete(file_, path, H5P_DEFAULT) >= 0); }
  /// Writes a dataset with these lengths and its unit.
  void put(hid_t creation, std::vector<hsize_t> lengths) const {
    remove("/group/rows");
    const hid_t space = H5Screate_simple(static_cast<int>(lengths.size()), lengths.data(), nullptr);
    const hid_t made = H5Dcreate2(file_, "/group/rows", H5T_IEEE_F64LE, space, H5P_DEFAULT, creation, H5P_DEFAULT);
    REQUIRE(made >= 0);
    const hid_t type = H5Tcopy(H5T_C_S1), one = H5Screate(H5S_SCALAR);
    const hid_t unit = H5Acreate2(made, "unit", type, one, H5P_DEFAULT, H5P_DEFAULT);
    REQUIRE(H5Awrite(unit, type, "m") >= 0);
    H5Aclose(unit);
    H5Sclose(one);
    H5Tclose(type);
    H5Dclose(made);
    H5Sclose(space);
    H5Pclose(creation);
  }
  /// Returns the reader's error, without the file's name and the remedy.
  std::string refusal() {
    H5Fclose(file_);
    const std::string message =
        message_of([&] { FileReader(scratch_ / "f.h5", two_rows).read<double>("/group/rows"); });
    const std::string before = (scratch_ / "f.h5").string() + ": error: ",
                      after = "; make the file again with dresslife-maker, then run again";
    if (!message.starts_with(before) || !message.ends_with(after)) return message;
    return message.substr(before.size(), message.size() - before.size() - after.size());
  }
  const Scratch& scratch() const { return scratch_; }

 private:
  Scratch scratch_;
  hid_t file_ = -1;
};

hid_t chunked(std::vector<hsize_t> lengths) {
  const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
  H5Pset_chunk(creation, static_cast<int>(lengths.size()), lengths.data());
  return creation;
}

}  // namespace

TEST_CASE("hostile files: the file that the others are made of is read") {
  Made made;
  CHECK(made.refusal().empty());
}

TEST_CASE("hostile files: values that are promised and not there are refused before memory is taken") {
  Made made;
  made.put(chunked({1000, 2}), {1'000'000'000, 2});  // 16 GB in a file of some kilobytes
  const std::string refusal = made.refusal();
  CHECK(refusal.starts_with("dataset /group/rows promises 1000000 chunks of 16000 bytes in a file of "));
  Made few;
  few.put(chunked({1, 2}), {10, 2});
  CHECK(few.refusal() == "dataset /group/rows has 0 of its 10 chunks (the file is damaged)");
  Made endless;
  endless.put(chunked({1000, 2}), {hsize_t{1} << 62, 2});
  CHECK(endless.refusal() == "dataset /group/rows is too large");
  Made lumps;
  lumps.put(chunked({hsize_t{1} << 26, 2}), {hsize_t{1} << 26, 2});
  CHECK(lumps.refusal() == "dataset /group/rows has chunks of 1073741824 bytes");
  Made plain;
  plain.put(H5Pcreate(H5P_DATASET_CREATE), {1'000'000'000, 2});
  CHECK(plain.refusal() == "dataset /group/rows was never filled");
}

TEST_CASE("hostile files: data that lies in other files is not followed") {
  {
    Made made;
    const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
    REQUIRE(H5Pset_external(creation, "/etc/passwd", 0, 32) >= 0);
    made.put(creation, {2, 2});
    CHECK(made.refusal() == "dataset /group/rows lies in other files (the data must lie in the file itself)");
  }
  {
    Made made;
    hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
    const hsize_t lengths[] = {2, 2};
    const hid_t space = H5Screate_simple(2, lengths, nullptr);
    REQUIRE(H5Pset_virtual(creation, space, (made.scratch() / "whole.h5").c_str(), "/group/rows", space) >= 0);
    H5Sclose(space);
    made.put(creation, {2, 2});
    CHECK(made.refusal() == "dataset /group/rows lies in other files (the data must lie in the file itself)");
  }
  const std::string other = "whole.h5";
  for (const bool group : {false, true}) {
    const char* const way = group ? "/group" : "/group/rows";
    Made outside;
    outside.remove(way);
    REQUIRE(H5Lcreate_external(other.c_str(), way, outside.file(), way, H5P_DEFAULT, H5P_DEFAULT) >= 0);
    CHECK(outside.refusal() == std::string(way) + " is a link (the data must lie in the file itself)");
    Made inside;
    inside.remove(way);
    REQUIRE(H5Lcreate_soft(way, inside.file(), way, H5P_DEFAULT, H5P_DEFAULT) >= 0);  // a link to itself
    CHECK(inside.refusal() == std::string(way) + " is a link (the data must lie in the file itself)");
  }
}

TEST_CASE(
    "hostile files: an attribute that is no single value, or longer than its file, is refused before it is read") {
  const auto with_attribute = [](const char* name, hid_t type, hid_t space) {
    Made made;
    H5Adelete(made.file(), name);
    const hid_t attribute = H5Acreate2(made.file(), name, type, space, H5P_DEFAULT, H5P_DEFAULT);
    REQUIRE(attribute >= 0);
    H5Aclose(attribute);
    return made.refusal();
  };
  const hid_t text = H5Tcopy(H5T_C_S1), endless = H5Tcopy(H5T_C_S1);
  REQUIRE(H5Tset_size(endless, 0xfffffff0u) >= 0);  // 4 GB
  const hsize_t thousand = 1000;
  const hid_t many = H5Screate_simple(1, &thousand, nullptr), none = H5Screate(H5S_NULL);
  CHECK(with_attribute("format_version", H5T_STD_I32LE, many) ==
        "attribute 'format_version' holds 1000 values (must be one)");
  CHECK(with_attribute("format", text, many) == "attribute 'format' holds 1000 values (must be one)");
  CHECK(with_attribute("format", endless, none) == "attribute 'format' holds 0 values (must be one)");
  for (const hid_t type : {text, endless}) H5Tclose(type);
  for (const hid_t space : {many, none}) H5Sclose(space);
}

TEST_CASE("hostile files: nothing beyond the end of a file is read as zeros") {
  const Scratch scratch;
  const auto name = scratch / "whole.h5";
  {
    FileWriter writer(name, two_rows);
    writer.append("/group/rows", std::span<const double>(std::vector<double>(20'000, 1.0)));
    writer.commit();
  }
  const std::string bytes = bytes_of(name).substr(512);
  int read = 0;
  for (std::size_t length = bytes.size(); length > 512; length -= std::min<std::size_t>(length, 4096)) {
    const auto cut = scratch.write("cut.h5", bytes.substr(0, length));
    const std::string message = message_of([&] {
      const std::vector<double> rows = FileReader(cut, two_rows).read<double>("/group/rows");
      CHECK(rows == std::vector<double>(20'000, 1.0));
    });
    read += message.empty();
  }
  CHECK(read == 1);  // only the undamaged file
}

TEST_CASE("rows beyond the largest int are counted and read where they lie") {
  const Format numbers{"dresslife-numbers", 1, "dresslife-maker", "tests", {}, {}};
  Format format = numbers;
  Dataset dataset{"/numbers", Type::f32, {"number"}, "1", "numbers"};
  dataset.decimals = 6;
  format.datasets.push_back(dataset);
  const Scratch scratch;
  constexpr hsize_t in_a_chunk = 1 << 15, chunks = (hsize_t{1} << 31) / in_a_chunk + 1;
  {
    FileWriter writer(scratch / "one.h5", format);
    writer.append("/numbers", std::span<const float>(std::vector<float>(in_a_chunk, 0.25f)));
    writer.commit();
  }
  // Without the checksum block, and with one packed chunk referred to many times: 8 GB unpacked.
  const auto file = scratch.write("many.h5", bytes_of(scratch / "one.h5").substr(512));
  {
    const hid_t opened = H5Fopen(file.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    const hid_t rows = H5Dopen2(opened, "/numbers", H5P_DEFAULT);
    hsize_t first = 0, size = 0, length = chunks * in_a_chunk;
    REQUIRE(H5Dget_chunk_storage_size(rows, &first, &size) >= 0);
    std::vector<char> packed(size);
    std::uint32_t unfiltered = 0;
    REQUIRE(H5Dread_chunk(rows, H5P_DEFAULT, &first, &unfiltered, packed.data()) >= 0);
    REQUIRE(H5Dset_extent(rows, &length) >= 0);
    for (hsize_t chunk = 1; chunk < chunks; ++chunk) {
      first = chunk * in_a_chunk;
      if (H5Dwrite_chunk(rows, H5P_DEFAULT, 0, &first, packed.size(), packed.data()) < 0) FAIL("chunk " << chunk);
    }
    H5Dclose(rows);
    H5Fclose(opened);
  }
  const FileReader reader(file, format);
  REQUIRE(reader.rows("/numbers") == chunks * in_a_chunk);
  std::vector<float> some;
  reader.read_rows("/numbers", (hsize_t{1} << 31) - 2, 4, some);  // across the border
  CHECK(some == std::vector<float>(4, 0.25f));
  reader.read_rows("/numbers", reader.rows("/numbers") - 1, 1, some);
  CHECK(some == std::vector<float>(1, 0.25f));
}

namespace {

/// 20,000 numbers in chunks, in a file without a checksum.
struct Numbers {
  static constexpr std::size_t count = 20'000;
  Scratch scratch;
  Format format{"dresslife-numbers", 1, "dresslife-maker", "tests", {}, {}};
  std::filesystem::path file;

  explicit Numbers(Dataset dataset) {
    dataset.path = "/numbers";
    dataset.shape = {"number"};
    dataset.unit = "m";
    format.datasets.push_back(dataset);
    FileWriter writer(scratch / "one.h5", format);
    if (dataset.type == Type::u32)
      writer.append("/numbers", std::span<const std::uint32_t>(std::vector<std::uint32_t>(count, 7)));
    else
      writer.append("/numbers", std::span<const double>(std::vector<double>(count, 7)));
    writer.commit();
    file = scratch.write("f.h5", bytes_of(scratch / "one.h5").substr(512));
  }
  /// Replaces the first chunk by these bytes.
  void replace(const std::string& chunk, std::uint32_t filters_skipped) const {
    const hid_t opened = H5Fopen(file.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    const hid_t rows = H5Dopen2(opened, "/numbers", H5P_DEFAULT);
    const hsize_t first = 0;
    REQUIRE(H5Dwrite_chunk(rows, H5P_DEFAULT, filters_skipped, &first, chunk.size(), chunk.data()) >= 0);
    H5Dclose(rows);
    H5Fclose(opened);
  }
  std::vector<double> read() const {
    const FileReader reader(file, format);
    if (format.datasets[0].type != Type::u32) return reader.read<double>("/numbers");
    const auto numbers = reader.read<std::uint32_t>("/numbers");
    return {numbers.begin(), numbers.end()};
  }
  std::string refusal() const {
    return message_of([&] { read(); });
  }
};

const std::vector<double> sevens(Numbers::count, 7);

std::vector<Dataset> deflated() {
  Dataset table, list;
  table.type = Type::f64;
  table.deflate = true;
  list.type = Type::u32;
  list.lists = true;
  return {table, list};
}

std::size_t chunk_bytes_of(const std::filesystem::path& file) {
  const hid_t opened = H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  const hid_t rows = H5Dopen2(opened, "/numbers", H5P_DEFAULT), creation = H5Dget_create_plist(rows),
              type = H5Dget_type(rows);
  hsize_t numbers = 0;
  REQUIRE(H5Pget_chunk(creation, 1, &numbers) == 1);
  const std::size_t bytes = numbers * H5Tget_size(type);
  H5Tclose(type);
  H5Pclose(creation);
  H5Dclose(rows);
  H5Fclose(opened);
  return bytes;
}

constexpr const char* not_packed = "has a chunk that is not packed as it should be";

}  // namespace

TEST_CASE("a chunk that says it is not filtered and is shorter than a chunk is refused, not read behind its end") {
  for (const Dataset& dataset : deflated()) {
    const Numbers numbers(dataset);
    REQUIRE(numbers.read() == sevens);
    constexpr std::uint32_t all_filters = 3;
    numbers.replace(std::string(16, '\1'), all_filters);
    CHECK(numbers.refusal().find(not_packed) != std::string::npos);
  }
}

TEST_CASE("a deflated chunk of another size than a chunk is refused, not read behind its end") {
  for (const Dataset& dataset : deflated()) {
    const Numbers numbers(dataset);
    ListDeflater deflater;
    const std::size_t whole = chunk_bytes_of(numbers.file) / sizeof(std::uint32_t);
    for (const std::size_t held : {std::size_t{1}, whole - 1, whole + 1}) {
      CAPTURE(held);
      std::vector<char> chunk;
      deflater.pack(std::vector<std::uint32_t>(held, 7), chunk);
      numbers.replace({chunk.begin(), chunk.end()}, 0);
      CHECK(numbers.refusal().find(not_packed) != std::string::npos);
    }
  }
}

TEST_CASE("a plain chunk that the file's index says is short is read as the dataset says") {
  const Numbers numbers(Dataset{});
  std::string bytes = bytes_of(numbers.file);
  // A leaf of the index: TREE, chunks (1), level 0, entries, two siblings. An entry begins with its size in bytes.
  std::size_t found = 0;
  for (std::size_t at = bytes.find("TREE"); at != std::string::npos; at = bytes.find("TREE", at + 1)) {
    if (bytes[at + 4] != 1 || bytes[at + 5] != 0) continue;
    constexpr std::size_t header = 24, entry = 4 + 4 + 2 * 8 + 8;
    for (int k = 0; k < bytes[at + 6]; ++k, ++found) {
      std::uint32_t size = 0;
      std::memcpy(&size, bytes.data() + at + header + k * entry, sizeof(size));
      REQUIRE(size == 1 << 16);
      size = 16;
      std::memcpy(bytes.data() + at + header + k * entry, &size, sizeof(size));
    }
  }
  REQUIRE(found == 3);
  numbers.scratch.write("f.h5", bytes);
  CHECK(numbers.read() == sevens);
}

TEST_CASE("hostile files: chunks packed by filters that are not undone here are refused, and what to do instead") {
  Made made;
  const hid_t creation = chunked({2, 2});
  H5Pset_fletcher32(creation);
  H5Pset_alloc_time(creation, H5D_ALLOC_TIME_EARLY);
  made.put(creation, {2, 2});
  const std::string refusal = made.refusal();
  CHECK(refusal.find("dataset /group/rows is packed by a filter of HDF5 that is not read here; write it without "
                     "filters, or with deflate") != std::string::npos);
}
