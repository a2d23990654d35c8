// The files that the reading of jobs looks up. While a Sources exists, successful look-ups of its thread through the functions below
// are done once for any number of jobs, and give all jobs the same result. Other threads can share it.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

#include "pipeline/settings/document.h"

namespace dresslife::pipeline {

class Sources {
 public:
  Sources();
  ~Sources();
  Sources(const Sources&) = delete;
  Sources& operator=(const Sources&) = delete;

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
  friend bool look(std::map<std::string, bool> Sources::*, const std::filesystem::path&,
                   bool (*)(const std::filesystem::path&));
  friend std::filesystem::path found_once(const std::string&, const std::function<std::filesystem::path()>&);
  friend bool is_file(const std::filesystem::path&);
  friend bool is_folder(const std::filesystem::path&);
  std::recursive_mutex mutex_;  ///< of all maps; recursive, because a document is read while it is held
  std::map<std::string, bool> files_, folders_;
  std::map<std::string, std::string> texts_;
  std::map<std::string, std::filesystem::path> found_;
  std::map<std::string, std::shared_ptr<const Node>> documents_;
  Sources* outer_;
};

/// Like read_yaml(). Errors: InputError.
Node read_document(const std::filesystem::path& file);
/// Like read_text(). Errors: InputError.
std::string read_source(const std::filesystem::path& file);
bool is_file(const std::filesystem::path& path);    ///< or a link to one
bool is_folder(const std::filesystem::path& path);  ///< or a link to one
/// Returns search(). With a Sources, a file that was found is not searched again; `wanted` determines the result.
std::filesystem::path found_once(const std::string& wanted, const std::function<std::filesystem::path()>& search);

}  // namespace dresslife::pipeline
