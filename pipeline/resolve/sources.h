// What the reading of jobs finds in the file system. Who has expanded a study and finds all of it as it was
// needs not expand it again (pipeline/study/known_study.h).
//
// While a Sources lives, whatever its thread looks up through the functions below is noted, and a document is
// read from the disk and parsed once, however many jobs name it.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
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
  /// What a look found: the text, or "yes" and "no", or the names of a program's files, line by line. The
  /// same look without a Sources. A text that cannot be read: "no".
  static std::string found_at(Kind kind, const std::filesystem::path& path);
  /// Looks by what they were for and where, and what each found first.
  using Looks = std::map<std::pair<Kind, std::string>, std::string>;
  Looks take() { return std::move(found_); }

 private:
  friend Node read_document(const std::filesystem::path&);
  friend std::string read_source(const std::filesystem::path&);
  friend void note_source(Kind, const std::filesystem::path&, const std::string&);
  friend bool look(Kind, const std::filesystem::path&, bool (*)(const std::filesystem::path&));
  Looks found_;
  std::map<std::string, std::shared_ptr<const Node>> documents_;
  Sources* outer_;
};

/// As read_yaml(). Errors: InputError.
Node read_document(const std::filesystem::path& file);
/// As read_text(). Errors: InputError.
std::string read_source(const std::filesystem::path& file);
bool is_file(const std::filesystem::path& path);    ///< or a link to one
bool is_folder(const std::filesystem::path& path);  ///< or a link to one
/// As program_files().
std::vector<std::filesystem::path> files_of_program(const std::filesystem::path& program);

}  // namespace dresslife::pipeline
