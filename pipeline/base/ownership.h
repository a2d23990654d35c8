// Which files are ours. A program of ours replaces and removes only what one of them has written, and sees that by a
// mark in the file: each kind of file that they write begins in a way of its own. Anything else is the user's and is
// neither replaced nor removed. WholeFile, by which every file is written, holds to it.
//
// Marks of new files are lines of comment (with_mark()). Where people edit such files, the mark has a digest of all
// that follows it: a file that was edited is the user's from then on.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace dresslife::pipeline {

enum class Mark {
  yaml,    ///< "# ...": the user's once it is edited
  script,  ///< after "#!...": the user's once it is edited
  xml,     ///< "<!-- ... -->", after "<?xml ...>": the user's once it is edited; SVG, XDMF, Markdown
  page,    ///< after "<!DOCTYPE html>": always ours; is_as_marked() finds damage
  png,     ///< a chunk of text: always ours
};
std::string with_mark(const std::string& text, Mark mark);
/// Text behind its mark; a text without one as it is.
std::string_view without_mark(std::string_view text);
/// Whether a text has a mark, and all behind it is as it was marked.
bool is_as_marked(std::string_view text);

/// By its first bytes (ownership_bytes of them suffice): of one of our kinds. Of a text that is the user's once it
/// is edited all of it is needed.
bool begins_as_ours(std::string_view text);
inline constexpr std::size_t ownership_bytes = 512;

/// Whether it is a plain file that one of our programs wrote, or an empty one. Errors: DiskError.
bool is_ours(const std::filesystem::path& file);

/// Whether it lies in such notes of our programs as make_notes() makes. Errors: DiskError.
bool lies_in_notes(const std::filesystem::path& file);

/// Errors: InputError where a file stands that is not ours, a folder, a device, a pipe, a link, or a file that this
/// program reads.
void check_replaceable(const std::filesystem::path& file);
/// Lets this program replace files of others, too, where a user says so (--force). Inputs stay.
void let_replace_files_of_others();
bool replaces_files_of_others();
/// What this program reads for the user it never replaces.
void note_input(const std::filesystem::path& file);

/// Removes a file that is ours, and leaves any other. Returns whether it is gone. Errors: InputError when it is ours
/// and cannot be removed.
bool remove_ours(const std::filesystem::path& file);

/// Removes a folder when nothing is in it.
void remove_empty(const std::filesystem::path& folder);

/// Makes a folder, of the name .stage, for what our programs note beside results; all in it is ours. Errors:
/// InputError when it is there already and not ours, or cannot be made.
void make_notes(const std::filesystem::path& folder);
/// Shells and Ninja also write into such a folder, and they would wait for a pipe and write through a link. Errors:
/// InputError when one is in it; DiskError.
void check_notes(const std::filesystem::path& folder);
/// Removes what our programs have put into such a folder, and the folder when nothing else is in it; leaves any other.
void remove_notes(const std::filesystem::path& folder);

/// Removes a temporary folder of our own with all that it holds. What fails to go stays.
void remove_temporary(const std::filesystem::path& folder);

}  // namespace dresslife::pipeline
