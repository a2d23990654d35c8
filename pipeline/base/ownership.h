// Determines which files programs of this project may replace or remove: only those that one of them has written. They know such
// a file by a mark: each kind of file begins with its own mark. Any other file is the user's and is neither replaced nor removed.
// WholeFile, which writes every file, checks this.
//
// Marks of new files are comment lines (with_mark()). For files that users edit, the mark contains a digest of the text behind
// it. An edited file belongs to the user.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace dresslife::pipeline {

enum class Mark {
  yaml,    ///< "# ...": the user's after an edit
  script,  ///< after "#!...": the user's after an edit
  xml,     ///< "<!-- ... -->", after "<?xml ...>": the user's after an edit; SVG, XDMF, Markdown
  page,    ///< after "<!DOCTYPE html>": never the user's; is_as_marked() detects damage
  png,     ///< a text chunk: never the user's
};
std::string with_mark(const std::string& text, Mark mark);
/// Returns the text behind the mark; the whole text if it has no mark.
std::string_view without_mark(std::string_view text);
/// Returns whether a text has a mark and is unchanged behind it.
bool is_as_marked(std::string_view text);

/// Returns whether a text begins like one of our files. The first ownership_bytes bytes are enough, except for a file that is the
/// user's after an edit: for this kind, pass the whole text.
bool begins_as_ours(std::string_view text);
inline constexpr std::size_t ownership_bytes = 512;

/// Returns whether this is a plain file that is empty or was written by one of our programs. Errors: DiskError.
bool is_ours(const std::filesystem::path& file);

/// Returns whether the file is in a notes folder (make_notes()). Errors: DiskError.
bool lies_in_notes(const std::filesystem::path& file);

/// Checks that a file may be written under this name. another_name: the remedy, with the option that names the file. Errors:
/// InputError if the name is a file that is not ours, an input of this program, a folder, a device, a pipe or a link.
void check_replaceable(const std::filesystem::path& file,
                       const std::string& another_name = "name another place with -o");
/// Lets this program also replace files that are not ours (--force). Inputs are never replaced.
void let_replace_files_of_others();
bool replaces_files_of_others();
/// Registers an input of this program, which it never replaces.
void note_input(const std::filesystem::path& file);

/// Removes a file if it is ours. Returns whether it is gone. Errors: InputError if it is ours and cannot be removed.
bool remove_ours(const std::filesystem::path& file);

/// Removes a folder if it is empty.
void remove_empty(const std::filesystem::path& folder);

/// Makes a notes folder, named .stage, for files that our programs keep beside results. Everything in it is ours. Errors:
/// InputError if it exists and is not ours, or cannot be made.
void make_notes(const std::filesystem::path& folder);
/// Checks that a notes folder contains no pipe and no link, because shells and Ninja also write into it: they would wait for a
/// pipe and write through a link. Errors: InputError if it contains one; DiskError.
void check_notes(const std::filesystem::path& folder);
/// Removes our files from a notes folder, and the folder if it is empty then. Leaves any other folder unchanged.
void remove_notes(const std::filesystem::path& folder);

/// Removes a temporary folder of this program with its content. Parts that cannot be removed stay.
void remove_temporary(const std::filesystem::path& folder);

}  // namespace dresslife::pipeline
