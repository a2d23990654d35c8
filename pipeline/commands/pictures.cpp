#include "pipeline/commands/pictures.h"

#include "pipeline/base/errors.h"
#include "pipeline/base/ownership.h"
#include "pipeline/base/whole_file.h"
#include "pipeline/report/chart_style.h"

namespace dresslife::pipeline {

void check_picture(const std::filesystem::path& file) {
  if (file.extension() != ".svg" && file.extension() != ".png")
    throw InputError({file.string()}, "is neither an .svg nor a .png", "name the picture accordingly");
  check_replaceable(file);
}

void write_picture(const std::filesystem::path& file, const std::string& svg) {
  const bool png = file.extension() == ".png";
  write_text_if_changed(file, png ? with_mark(png_of(svg), Mark::png) : with_mark(svg, Mark::xml));
}

}  // namespace dresslife::pipeline
