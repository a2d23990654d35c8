#include "tests/pipeline/scratch.h"

namespace dresslife::pipeline {

Scratch::Scratch() {
  std::string name = (std::filesystem::temp_directory_path() / "dresslife-test-XXXXXX").string();
  REQUIRE(::mkdtemp(name.data()) != nullptr);
  folder_ = std::filesystem::canonical(name);
}

Scratch::~Scratch() {
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

std::filesystem::path Scratch::write(const std::string& name, const std::string& text) const {
  const auto file = folder_ / name;
  std::filesystem::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary) << text;
  return file;
}

std::size_t Scratch::entries() const {
  std::size_t count = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder_)) ++count;
  return count;
}

std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

Captured::Captured(int stream) : stream_(stream), file_(std::tmpfile()) {
  std::fflush(nullptr);
  saved_ = ::dup(stream_);
  ::dup2(::fileno(file_), stream_);
}

std::string Captured::text() {
  restore();
  std::string words;
  std::rewind(file_);
  for (int letter = std::fgetc(file_); letter != EOF; letter = std::fgetc(file_)) words += static_cast<char>(letter);
  return words;
}

void Captured::restore() {
  if (saved_ < 0) return;
  std::fflush(nullptr);
  ::dup2(saved_, stream_);
  ::close(saved_);
  saved_ = -1;
}

std::string place_of(const std::string& text, const std::string& needle, const std::string& file) {
  const std::size_t at = text.find(needle);
  REQUIRE(at != std::string::npos);
  const std::size_t line =
      1 + static_cast<std::size_t>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
  const std::size_t before = text.rfind('\n', at == 0 ? std::string::npos : at - 1);
  const std::size_t column = before == std::string::npos || at == 0 ? at + 1 : at - before;
  return fmt::format("{}:{}:{}", file, line, column);
}

std::string edited(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  REQUIRE(text.find(from, at + 1) == std::string::npos);
  return text.replace(at, from.size(), to);
}

std::string replaced_all(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += part.size()) ++count;
  return count;
}

}  // namespace dresslife::pipeline
