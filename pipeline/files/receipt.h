// What a stage notes beside its output: from what it made it. Results are up to date when their receipts say
// so; no time of day and no order of times decides.
//
//   recipe: digest of the settings that the result depends on, of the files beside the job (robot programs,
//   meshes,
//           recorded poses) and of the stage's program;
//   input:  checksum of the file of the stage before ("-" for a job);
//   output: checksum of the file that was made;
//   state:  of the output as the stage left it. While size, inode and the two times are what they were then
//   to the nanosecond, the checksum need not be compared again: a later change shows in one of them
//   (FileState), if the file system's clock had moved on between the output and its receipt. Both times are
//   the file system's own, which nobody can set. Where the receipt is not the younger one, the bytes are
//   compared;
//   told:   what the root of life.h5 says of the result, so that ten thousand are gathered without opening
//   them, and
//           the checks of motion.h5 (checks.h);
//   with:   digests of the program and of each file, one by one: which of them changed.
//
// The receipt ends with a digest of all that stands before.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/base/whole_file.h"

namespace dresslife::pipeline {

struct Format;

/// A root attribute of an output.
struct Told {
  std::string name;
  std::string text;   ///< where it is text
  double number = 0;  ///< where it is none
  bool operator==(const Told&) const = default;
};
/// Those that the format names, of a file. Errors: InputError.
std::vector<Told> told_by(const std::filesystem::path& file, const Format& format);

struct Receipt {
  std::string recipe, input, output;
  FileState state;
  std::vector<Told> told{};
  /// What else the recipe is of, with digests: the program by its name, and files by their paths.
  std::vector<std::pair<std::string, std::string>> made_with{};
  std::int64_t written_ns = 0;  ///< when the receipt itself was changed last
  bool state_suffices() const { return state.exists() && written_ns > state.changed_ns; }
};

/// Digests of files by name, each worked out once.
class Digests {
 public:
  /// XXH3; "absent" for a file that cannot be read: whoever needs it will say so.
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

/// Nothing when there is none or it cannot be understood.
std::optional<Receipt> read_receipt(const std::filesystem::path& file);

/// Errors: InputError when it cannot be written.
void write_receipt(const std::filesystem::path& file, Receipt receipt, const std::filesystem::path& output);

/// Notes the state of an output whose bytes are as noted, so that they need no look the next time.
void renew_receipt(const std::filesystem::path& file, const std::filesystem::path& output);

/// Gives an output a second name; where the file system has none for it, a copy. Replaces what is there.
/// Errors: InputError when it cannot be written.
void give_output(const std::filesystem::path& output, const std::filesystem::path& name);

/// Whether `output` is the file that the receipt tells of.
bool is_as_noted(const Receipt& receipt, const std::filesystem::path& output);

}  // namespace dresslife::pipeline
