#include "pipeline/resolve/sources.h"

#include "pipeline/base/ownership.h"
#include "pipeline/base/plain_file.h"

namespace dresslife::pipeline {
namespace {

namespace fs = std::filesystem;

/// The Sources of this thread. It is global because look-ups are many calls below the reading of a job, and most callers do not
/// need one.
thread_local Sources* current = nullptr;

bool is_file_now(const fs::path& path) { return kind_of(path) == FileKind::file; }
bool is_folder_now(const fs::path& path) { return kind_of(path) == FileKind::folder; }

}  // namespace

Sources::Sources() : outer_(std::exchange(current, this)) {}
Sources::~Sources() { current = outer_; }

Sources* Sources::of_this_thread() { return current; }
Sources::Guest::Guest(Sources* host) : outer_(std::exchange(current, host)) {}
Sources::Guest::~Guest() { current = outer_; }

bool look(std::map<std::string, bool> Sources::*known, const fs::path& path, bool (*now)(const fs::path&)) {
  if (!current) return now(path);
  const std::lock_guard lock(current->mutex_);
  const auto found = (current->*known).find(path.string());
  if (found != (current->*known).end()) return found->second;
  return (current->*known)[path.string()] = now(path);
}

std::string read_source(const fs::path& file) {
  if (!current) {
    note_input(file);
    return read_text(file);
  }
  const std::lock_guard lock(current->mutex_);
  const auto known = current->texts_.find(file.string());
  if (known != current->texts_.end()) return known->second;
  note_input(file);
  return current->texts_[file.string()] = read_text(file);
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

fs::path found_once(const std::string& wanted, const std::function<fs::path()>& search) {
  if (!current) return search();
  const std::lock_guard lock(current->mutex_);
  if (const auto known = current->found_.find(wanted); known != current->found_.end()) return known->second;
  fs::path file = search();
  if (!file.empty()) current->found_.emplace(wanted, file);
  return file;
}

bool is_file(const fs::path& path) { return look(&Sources::files_, path, is_file_now); }
bool is_folder(const fs::path& path) { return look(&Sources::folders_, path, is_folder_now); }

}  // namespace dresslife::pipeline
