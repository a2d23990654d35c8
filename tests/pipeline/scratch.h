// A temporary folder for one test, the message of an error, and captured output.
#pragma once

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "pipeline/base/errors.h"
#include "tests/catch.h"

namespace dresslife::pipeline {

class Scratch {
 public:
  Scratch();
  ~Scratch();
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  std::filesystem::path operator/(const std::string& name) const { return folder_ / name; }
  const std::filesystem::path& folder() const { return folder_; }
  std::filesystem::path write(const std::string& name, const std::string& text) const;
  std::size_t entries() const;

 private:
  std::filesystem::path folder_;
};

std::string bytes_of(const std::filesystem::path& file);

/// The message of the InputError that `call` throws; "" when it throws none.
template <class Call>
std::string message_of(Call&& call) {
  try {
    call();
  } catch (const InputError& problem) {
    return problem.what();
  }
  return "";
}

/// Captures what is written to a standard stream between the constructor and text().
class Captured {
 public:
  explicit Captured(int stream);
  ~Captured() { restore(); }
  Captured(const Captured&) = delete;
  Captured& operator=(const Captured&) = delete;

  std::string text();

 private:
  void restore();
  int stream_, saved_ = -1;
  std::FILE* file_;
};

/// Returns "FILE:line:column" of the first occurrence of `needle` in `text`.
std::string place_of(const std::string& text, const std::string& needle, const std::string& file);

/// Returns `text` with `from` replaced by `to`. Precondition: `from` occurs exactly once.
std::string edited(std::string text, const std::string& from, const std::string& to);

/// Returns `text` with every occurrence of `from` replaced by `to`.
std::string replaced_all(std::string text, const std::string& from, const std::string& to);

/// Returns the number of occurrences of `part` in `text`.
std::size_t count_of(const std::string& text, const std::string& part);

}  // namespace dresslife::pipeline
