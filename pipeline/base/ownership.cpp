#include "pipeline/base/ownership.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <mutex>
#include <utility>
#include <vector>

#include "pipeline/base/digest.h"
#include "pipeline/base/whole_file.h"

namespace dresslife::pipeline {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view notes_name = ".stage", notes_mark = "README";
constexpr std::string_view words = "Written by dresslife; ", yours = "yours once it is changed ",
                           ours = "made again once it is changed ";
constexpr std::size_t digest_digits = 32;

/// Names of files that our programs write into a notes folder.
constexpr std::array<std::string_view, 8> notes{notes_mark,   "study",       "failure",     "memory",
                                                ".ninja_log", ".ninja_deps", "build.ninja", ".lock"};
constexpr std::array<std::string_view, 5> ends_of_notes{".receipt", ".log", ".launcher", ".same", ".part"};

/// Beginnings of our files that contain no comment line.
constexpr std::array<std::string_view, 13> beginnings{
    "dresslife file\n",                                      // HDF5 (pipeline/files/checksum.h)
    "recipe ",                                               // receipts
    "dresslife study ",                                      // notes of a run about its study
    "== dresslife-",                                         // logs
    "ninja_required_version = 1.8\nbuilddir = .stage",       // build.ninja
    "job,life_repeats,life_hours,worst_segment_from_tool,",  // ranking.csv
    "trial,feasible,life_hours_p10,",                        // improve.csv
    "cable,job,rig,status,cycles_p10,",                      // rate.csv
    "duty,job,repeats_per_hour,share_of_time,",              // of duty
    "name,duty,installed,age_hours,",                        // of plan
    "name,fails_in_week_of_",
    "BEGIN:VCALENDAR\r\nPRODID:-//dresslife//plan",
    "lines,way,life_hours_p10,times_as_long,"  // of reprogram
};

/// The digest in a mark, and the text behind the mark.
struct OwnershipMark {
  bool is_yours_once_changed = false;
  std::string_view digest, rest;
};
/// Splits a text into its mark and the rest. Without a mark, the digest is empty.
OwnershipMark marked(std::string_view text) {
  const std::size_t at = text.substr(0, ownership_bytes).find(words);
  if (at == std::string_view::npos) return {};
  for (const std::string_view what : {yours, ours}) {
    const std::string_view behind = text.substr(at + words.size());
    if (!behind.starts_with(what)) continue;
    const std::string_view digest = behind.substr(what.size(), digest_digits);
    const std::size_t end = behind.find('\n');
    const bool is_digest = digest.find_first_not_of("0123456789abcdef") == std::string_view::npos;
    if (digest.size() == digest_digits && is_digest)
      return {what == yours, digest, end == std::string_view::npos ? "" : behind.substr(end + 1)};
  }
  return {};
}

/// Returns the checksum of PNG (CRC-32 of ISO 3309).
std::uint32_t crc_of(std::string_view bytes) {
  std::uint32_t crc = ~0u;
  for (const char byte : bytes) {
    crc ^= static_cast<unsigned char>(byte);
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (crc & 1 ? 0xedb88320u : 0);
  }
  return ~crc;
}

std::string big_endian(std::uint32_t number) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(number >> shift & 0xff);
  return bytes;
}

/// A PNG file begins with a signature of 8 bytes and a header of 25 bytes.
constexpr std::size_t png_head = 33;
constexpr std::string_view png_words{"tEXtSoftware\0dresslife", 22};

/// Returns the position of the mark in a text. In some kinds of files it is behind the first line.
std::size_t place_of_mark(std::string_view text, Mark mark) {
  const bool behind_first_line = mark == Mark::script || mark == Mark::page || text.starts_with("<?xml");
  return behind_first_line ? text.find('\n') + 1 : 0;
}

/// Returns whether a folder is a notes folder: it has a mark. After a run that was killed before it wrote the mark: it contains
/// one of our notes or nothing.
bool is_notes(const fs::path& folder) {
  if (kind_of_name(folder) != FileKind::folder) return false;
  const std::vector<fs::path> entries = entries_of(folder);
  const auto is_temporary = [](const fs::path& entry) { return is_part(entry.filename().native()); };
  // A program that was killed before it wrote the mark leaves an empty folder or a temporary file.
  return std::ranges::all_of(entries, is_temporary) || std::ranges::any_of(entries, [](const fs::path& entry) {
           return begins_as_ours(beginning_of(entry, ownership_bytes));
         });
}

struct Policy {
  std::mutex mutex;
  std::multimap<std::pair<dev_t, ino_t>, fs::path>
      inputs;  ///< key: inode; value: the name of the file when it was read
  bool replaces_files_of_others = false;
};
/// Returns the one policy of the program, which applies to all files that it writes.
Policy& policy() {
  static Policy one;
  return one;
}

/// Returns whether a file is an input. A removed input's inode may belong to another file, so only inputs that still have it
/// count.
bool is_input(const fs::path& file) {
  const auto inode = inode_of(file);
  if (!inode) return false;
  const std::lock_guard lock(policy().mutex);
  const auto [begin, end] = policy().inputs.equal_range(*inode);
  return std::any_of(begin, end, [&](const auto& input) { return inode_of(input.second) == inode; });
}

/// Returns whether a plain file has this name. Errors: InputError for a folder, a link, a device or a pipe.
bool is_plain_file(const fs::path& file) {
  const FileKind kind = kind_of_name(file);
  if (kind == FileKind::absent || kind == FileKind::file) return kind == FileKind::file;
  const char* what = kind == FileKind::folder ? "is a folder"
                     : kind == FileKind::link ? "is a link to another file"
                                              : "is a device or a pipe";
  throw InputError({file.string()}, fmt::format("{} (a result only replaces a plain file)", what),
                   "name a file of its own");
}

}  // namespace

std::string with_mark(const std::string& text, Mark mark) {
  if (mark == Mark::png) {
    const std::string chunk(png_words);
    return text.substr(0, png_head) + big_endian(static_cast<std::uint32_t>(chunk.size() - 4)) + chunk +
           big_endian(crc_of(chunk)) + text.substr(std::min(png_head, text.size()));
  }
  const std::size_t at = place_of_mark(text, mark);
  const std::string_view rest = std::string_view(text).substr(at);
  const bool in_xml = mark == Mark::xml || mark == Mark::page;
  return fmt::format("{}{}{}{}{}{}\n{}", text.substr(0, at), in_xml ? "<!-- " : "# ", words,
                     mark == Mark::page ? ours : yours, xxh3(rest), in_xml ? " -->" : "", rest);
}

std::string_view without_mark(std::string_view text) {
  const OwnershipMark found = marked(text);
  return found.digest.empty() ? text : found.rest;
}

bool is_as_marked(std::string_view text) {
  const OwnershipMark found = marked(text);
  return !found.digest.empty() && xxh3(found.rest) == found.digest;
}

bool begins_as_ours(std::string_view text) {
  const std::string_view begin = text.substr(0, ownership_bytes);
  return !marked(begin).digest.empty() ||
         (begin.size() >= png_head + 4 && begin.substr(png_head + 4).starts_with(png_words)) ||
         std::ranges::any_of(beginnings, [&](std::string_view known) { return begin.starts_with(known); });
}

bool lies_in_notes(const fs::path& file) {
  for (fs::path at = file.parent_path(); at.has_filename(); at = at.parent_path())
    if (at.filename() == notes_name) return is_notes(at);
  return false;
}

bool is_ours(const fs::path& file) {
  const FileState state = state_of(file);
  if (!state.exists()) return false;
  if (state.size == 0 || lies_in_notes(file)) return true;
  const std::string begin = beginning_of(file, ownership_bytes);
  if (!begins_as_ours(begin)) return false;
  return !marked(begin).is_yours_once_changed || is_as_marked(read_text(file));
}

void check_replaceable(const fs::path& file, const std::string& another_name) {
  if (is_plain_file(file) && is_input(file))
    throw InputError({file.string()}, "is one of the files that are read", another_name);
  if (!policy().replaces_files_of_others && state_of(file).exists() && !is_ours(file))
    throw InputError({file.string()}, "is there already and was not written by dresslife, or was changed since",
                     fmt::format("move it away, {}, or replace it with --force", another_name));
}

void let_replace_files_of_others() { policy().replaces_files_of_others = true; }
bool replaces_files_of_others() { return policy().replaces_files_of_others; }

void note_input(const fs::path& file) {
  const auto inode = inode_of(file);
  if (!inode) return;
  const std::lock_guard lock(policy().mutex);
  const auto [begin, end] = policy().inputs.equal_range(*inode);
  fs::path name = fs::absolute(file);
  if (std::none_of(begin, end, [&](const auto& input) { return input.second == name; }))
    policy().inputs.emplace(*inode, std::move(name));
}

bool remove_ours(const fs::path& file) {
  const FileState state = state_of(file);
  if (!state.exists()) return kind_of_name(file) == FileKind::absent;
  if ((state.size == 0 && !lies_in_notes(file)) || !is_ours(file)) return false;
  std::error_code failure;
  if (fs::remove(file, failure); failure)
    throw MachineFault({file.string()}, fmt::format("cannot be removed ({})", failure.message()), "remove it");
  return true;
}

void remove_empty(const fs::path& folder) {
  std::error_code failure;
  if (fs::is_empty(folder, failure) && !failure) fs::remove(folder, failure);
}

void make_notes(const fs::path& folder) {
  const bool is_there = kind_of_name(folder) != FileKind::absent;
  if (is_there && !is_notes(folder))
    throw InputError({folder.string()}, "is there already and was not made by dresslife",
                     "move it away, or name another place with -o");
  if (!is_there) fs::create_directories(folder);
  const fs::path mark = folder / notes_mark;
  if (!state_of(mark).exists())
    write_text_if_changed(mark, with_mark("What dresslife notes of the results beside this folder.\n", Mark::yaml),
                          Sync::never);
}

void check_notes(const fs::path& folder) {
  for (const fs::path& entry : entries_of(folder))
    if (const FileKind kind = kind_of_name(entry); kind == FileKind::link || kind == FileKind::other)
      throw InputError({entry.string()}, "is a link, a device or a pipe (dresslife writes plain files there)",
                       "remove it");
}

void remove_notes(const fs::path& folder) {
  if (!is_notes(folder)) return;
  std::vector<fs::path> files, folders{folder};
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    const fs::path& path = entry.path();
    const std::string name = path.filename().string(), end = path.extension().string();
    const bool is_note =
        std::ranges::find(notes, name) != notes.end() || std::ranges::find(ends_of_notes, end) != ends_of_notes.end();
    if (entry.is_symlink()) continue;
    if (entry.is_directory())
      folders.push_back(path);
    else if (is_note)
      files.push_back(path);
  }
  std::error_code failure;
  for (const fs::path& file : files) fs::remove(file, failure);
  for (auto at = folders.rbegin(); at != folders.rend(); ++at) remove_empty(*at);
}

void remove_temporary(const fs::path& folder) {
  std::error_code ignored;
  fs::remove_all(folder, ignored);
}

}  // namespace dresslife::pipeline
