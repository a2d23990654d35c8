// Records the files that the reading of jobs looks up. A program that has expanded a study does not expand it again if all of
// them are unchanged (pipeline/study/known_study.h).
//
// While a Sources exists, all look-ups of its thread through the functions below are recorded, and a document is read and parsed
// once for any number of jobs that name it. Other threads can share it.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "pipeline/settings/document.h"

namespace dresslife::pipeline {

class Sources {
 public:
  Sources();
  ~Sources();
  Sources(const Sources&) = delete;
  Sources& operator=(const Sources&) = delete;

  enum class Kind { text, file, folder, program };
  /// Returns the result of a look-up: the text, or "yes" and "no", or the names of a program's files, line by line. The look-up
  /// is done without a Sources. "no": a text that cannot be read.
  static std::string found_at(Kind kind, const std::filesystem::path& path);
  /// Look-ups by kind and path, with the first result of each.
  using LookUps = std::map<std::pair<Kind, std::string>, std::string>;
  LookUps take() { return std::move(found_); }

  static Sources* of_this_thread();  ///< null: there is none
  /// While it exists, its thread uses the Sources of another thread. host: null: none.
  class Guest {
   public:
    explicit Guest(Sources* host);
    ~Guest();
    Guest(const Guest&) = delete;
    Guest& operator=(const Guest&) = delete;

   private:
    Sources* outer_;
  };

 private:
  friend Node read_document(const std::filesystem::path&);
  friend std::string read_source(const std::filesystem::path&);
  friend void note_source(Kind, const std::filesystem::path&, const std::string&);
  friend bool look(Kind, const std::filesystem::path&, bool (*)(const std::filesystem::path&));
  std::recursive_mutex mutex_;  ///< of both maps; recursive, because a document is read while it is held
  LookUps found_;
  std::map<std::string, std::shared_ptr<const Node>> documents_;
  Sources* outer_;
};

/// Like read_yaml(). Errors: InputError.
Node read_document(const std::filesystem::path& file);
/// Like read_text(). Errors: InputError.
std::string read_source(const std::filesystem::path& file);
bool is_file(const std::filesystem::path& path);    ///< or a link to one
bool is_folder(const std::filesystem::path& path);  ///< or a link to one
/// Like program_files().
std::vector<std::filesystem::path> files_of_program(const std::filesystem::path& program);

}  // namespace dresslife::pipeline
