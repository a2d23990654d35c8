#include "pipeline/resolve/sources.h"

#include "pipeline/base/ownership.h"
#include "pipeline/base/plain_file.h"
#include "pipeline/base/program_files.h"

namespace dresslife::pipeline {
namespace {

namespace fs = std::filesystem;

/// The Sources of this thread. It is global because look-ups are many calls below the reading of a job, and most callers do not
/// need a record.
thread_local Sources* current = nullptr;

const char* word(bool yes) { return yes ? "yes" : "no"; }

bool is_file_now(const fs::path& path) { return kind_of(path) == FileKind::file; }
bool is_folder_now(const fs::path& path) { return kind_of(path) == FileKind::folder; }

std::string program_names(const fs::path& program) {
  std::string names;
  try {
    for (const fs::path& file : program_files(program)) names += file.string() + '\n';
  } catch (const InputError& problem) {
    return problem.what();
  }
  return names;
}

}  // namespace

Sources::Sources() : outer_(std::exchange(current, this)) {}
Sources::~Sources() { current = outer_; }

Sources* Sources::of_this_thread() { return current; }
Sources::Guest::Guest(Sources* host) : outer_(std::exchange(current, host)) {}
Sources::Guest::~Guest() { current = outer_; }

std::string Sources::found_at(Kind kind, const fs::path& path) {
  switch (kind) {
    case Kind::text:
      try {
        return read_text(path);
      } catch (const InputError&) {
        return word(false);
      }
    case Kind::file:
      return word(is_file_now(path));
    case Kind::folder:
      return word(is_folder_now(path));
    case Kind::program:
      break;
  }
  return program_names(path);
}

void note_source(Sources::Kind kind, const fs::path& path, const std::string& found) {
  if (!current) return;
  const std::lock_guard lock(current->mutex_);
  current->found_.try_emplace({kind, path.string()}, found);
}

/// Returns the result of the first look-up, so that all jobs of a study are built from the same files.
bool look(Sources::Kind kind, const fs::path& path, bool (*now)(const fs::path&)) {
  if (!current) return now(path);
  const std::lock_guard lock(current->mutex_);
  const auto [entry, fresh] = current->found_.try_emplace({kind, path.string()});
  if (fresh) entry->second = word(now(path));
  return entry->second == word(true);
}

std::string read_source(const fs::path& file) {
  if (current) {
    const std::lock_guard lock(current->mutex_);
    const auto known = current->found_.find({Sources::Kind::text, file.string()});
    if (known != current->found_.end() && known->second != word(false)) return known->second;
  }
  std::string text;
  note_input(file);
  try {
    text = read_text(file);
  } catch (const InputError&) {
    note_source(Sources::Kind::text, file, word(false));
    throw;
  }
  note_source(Sources::Kind::text, file, text);
  return text;
}

Node read_document(const fs::path& file) {
  if (!current) {
    note_input(file);
    return read_yaml(file);
  }
  const auto known = [&] {
    const std::lock_guard lock(current->mutex_);
    std::shared_ptr<const Node>& document = current->documents_[file.string()];
    if (!document) document = std::make_shared<const Node>(parse_yaml(read_source(file), file.string()));
    return document;
  }();
  return *known;
}

bool is_file(const fs::path& path) { return look(Sources::Kind::file, path, is_file_now); }
bool is_folder(const fs::path& path) { return look(Sources::Kind::folder, path, is_folder_now); }

std::vector<fs::path> files_of_program(const fs::path& program) {
  if (!program.empty()) note_source(Sources::Kind::program, program, program_names(program));
  return program_files(program);
}

}  // namespace dresslife::pipeline
