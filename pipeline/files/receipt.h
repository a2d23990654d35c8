// The receipt of an output: what a stage made it from. Results are up to date when their receipts say so.
// No time of day and no order of times decides.
//
//   recipe: digest of the settings that the result depends on, of the files beside the job (robot programs,
//           meshes, recorded poses) and of the stage's program;
//   input:  checksum of the file of the stage before ("-" for a job);
//   output: checksum of the file that was made;
//   state:  size, inode and both times of the output as the stage left it (FileState). While they are the
//           same to the nanosecond, the checksum need not be compared again: a later change shows in one of
//           them, if the file system's clock moved on between the output and its receipt. Both times come
//           from the file system; no program can set them. Where the receipt is not younger than the output, the
//           bytes are compared;
//   results:   the results in the root of life.h5 and the checks of motion.h5 (checks.h), so that a study of ten thousand
//           jobs is ranked without opening these files;
//   with:   digests of the program and of each file, one by one: they show which of them changed.
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
  std::string text;   ///< where it is text
  double number = 0;  ///< where it is none
  bool operator==(const ResultValue&) const = default;
};
/// Those that the format names, of a file. Errors: InputError.
std::vector<ResultValue> results_in(const std::filesystem::path& file, const Format& format);

struct Receipt {
  std::string recipe, input, output;
  FileState state;
  std::vector<ResultValue> results{};
  /// What else the recipe is of, with digests: the program by its name, and files as seen from the folder of the
  /// output.
  std::vector<std::pair<std::string, std::string>> made_with{};
  std::int64_t written_ns = 0;  ///< when the receipt itself was changed last
  bool state_suffices() const { return state.exists() && written_ns > state.changed_ns; }
};

/// Digests of files by name, each worked out once.
class Digests {
 public:
  /// XXH3; "absent" for a file that cannot be read: the reader reports the error.
  const std::string& of(const std::filesystem::path& file);
  const std::map<std::filesystem::path, std::string>& all() const { return known_; }
  /// Takes the digests of note_digests() of those files that are as they were then, unread.
  void believe(std::string_view notes);

 private:
  std::map<std::filesystem::path, std::string> known_;
};

/// Digests of files by their canonical paths, a line each with the state that the file had: who starts many
/// programs looks at what all need once. Nothing of a file that is not there or was changed a moment ago,
/// when its state says too little.
std::string note_digests(const std::vector<std::filesystem::path>& files);

std::string recipe_of(std::string_view settings, const std::vector<std::filesystem::path>& files,
                      const std::filesystem::path& program, Digests& digests);

/// Nothing when there is none or it cannot be understood. Errors: DiskError.
std::optional<Receipt> read_receipt(const std::filesystem::path& file);

/// Errors: InputError when it cannot be written.
void write_receipt(const std::filesystem::path& file, Receipt receipt, const std::filesystem::path& output);

/// Notes the state of an output whose bytes are as noted, so that they need no look the next time.
void renew_receipt(const std::filesystem::path& file, const std::filesystem::path& output);

/// Whether `output` is the file that the receipt describes.
bool is_as_noted(const Receipt& receipt, const std::filesystem::path& output);

}  // namespace dresslife::pipeline
