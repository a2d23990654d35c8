// The receipt of an output contains digests of everything from which a stage made it. An output is up to date if its receipt
// matches. Neither the time of day nor the order of times matters.
//
//   recipe: digest of the settings that the result depends on, of the files beside the job (robot programs,
//           meshes, recorded poses) and of the stage's program;
//   input:  checksum of the file of the stage before ("-" for a job);
//   output: checksum of the file that was made;
//   state:  size, inode and both times of the output when the stage ended (FileState). While they are the same to the
//           nanosecond, the checksum is not compared again: a later change alters one of them, if the file system's clock
//           moved on between the output and its receipt. No program can set the change time. If the receipt is not younger
//           than the output, the bytes are compared;
//   results:   the results in the root of life.h5 and the checks of motion.h5 (checks.h), so that a study of ten thousand
//           jobs is ranked without opening these files;
//   with:   digests of the program and of each file separately: they show which of them changed.
//
// The receipt ends with a digest of everything before it.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/base/plain_file.h"

namespace dresslife::pipeline {

struct Format;

/// A root attribute of an output.
struct ResultValue {
  std::string name;
  std::string text;   ///< value of a text attribute
  double number = 0;  ///< value of a number attribute
  bool operator==(const ResultValue&) const = default;
};
/// Returns the root attributes of a file that the format lists. Errors: InputError.
std::vector<ResultValue> results_in(const std::filesystem::path& file, const Format& format);

struct Receipt {
  std::string recipe, input, output;
  FileState state;
  std::vector<ResultValue> results{};
  /// Inputs of the recipe with their digests: the program by its name, and files relative to the folder of the output.
  std::vector<std::pair<std::string, std::string>> made_with{};
  std::int64_t written_ns = 0;  ///< time of the last change of the receipt itself
  bool state_suffices() const { return state.exists() && written_ns > state.changed_ns; }
};

/// Digests of files by name, each computed once.
class Digests {
 public:
  /// Returns the XXH3 digest of a file; "absent" for a file that cannot be read, because its reader reports the error.
  const std::string& of(const std::filesystem::path& file);
  const std::map<std::filesystem::path, std::string>& all() const { return known_; }
  /// Takes the digests from note_digests() of all files whose state has not changed, without reading them.
  void believe(std::string_view notes);

 private:
  std::map<std::filesystem::path, std::string> known_;
};

/// Returns digests of files by their canonical paths, one line each with the file's state. A program that starts many others
/// computes the digests of common files once. Absent files and files that changed a moment ago are left out, because the state of
/// the latter may hide a change.
std::string note_digests(const std::vector<std::filesystem::path>& files);

std::string recipe_of(std::string_view settings, const std::vector<std::filesystem::path>& files,
                      const std::filesystem::path& program, Digests& digests);

/// Returns std::nullopt if the file is absent or no receipt. Errors: DiskError.
std::optional<Receipt> read_receipt(const std::filesystem::path& file);

/// Errors: InputError if it cannot be written.
void write_receipt(const std::filesystem::path& file, Receipt receipt, const std::filesystem::path& output);

/// Writes the current state of an output into its receipt if its bytes match, so that they are not compared the next time.
void renew_receipt(const std::filesystem::path& file, const std::filesystem::path& output);

/// Returns whether `output` is the file that the receipt describes.
bool is_as_noted(const Receipt& receipt, const std::filesystem::path& output);

}  // namespace dresslife::pipeline
