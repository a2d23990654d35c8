#include "pipeline/commands/pictures.h"

#include <fstream>

#include "pipeline/base/errors.h"
#include "pipeline/base/whole_file.h"
#include "pipeline/report/chart_style.h"

namespace dresslife::pipeline {

namespace fs = std::filesystem;

std::string beginning_of(const fs::path& file, std::size_t bytes) {
  std::string begin(bytes, '\0');
  std::ifstream(file, std::ios::binary).read(begin.data(), static_cast<std::streamsize>(bytes));
  return begin;
}

void check_picture(const fs::path& file) {
  check_replaceable(file);
  std::error_code failure;
  if (!fs::exists(file, failure)) return;
  const std::string begin = beginning_of(file, 4);
  if (begin != "<svg" && begin != "\x89PNG")
    throw InputError({file.string()}, "is there already and no picture", "name another file after -o");
}

void write_picture(const fs::path& file, const std::string& svg) {
  write_text_if_changed(file, file.extension() == ".png" ? png_of(svg) : svg);
}

}  // namespace dresslife::pipeline
