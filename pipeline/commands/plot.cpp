#include "pipeline/commands/command.h"

#include <fmt/format.h>

#include <memory>
#include <optional>

#include "pipeline/base/errors.h"
#include "pipeline/commands/pictures.h"
#include "pipeline/report/figures.h"

namespace dresslife::pipeline {
namespace {

namespace fs = std::filesystem;

struct PlotOptions {
  std::string job, what, picture;
  std::optional<double> time;
};

int plot(const PlotOptions& options) {
  const fs::path file = options.picture;
  check_picture(file);
  Figure what{};
  while (word(what) != options.what) what = static_cast<Figure>(static_cast<int>(what) + 1);
  if (options.time && what != Figure::scene && what != Figure::deformation)
    throw InputError({"--time"}, fmt::format("has no effect on the figure {}", word(what)), "leave it out");
  write_picture(file, figure(what, job_files(options.job), options.time));
  return 0;
}

std::vector<std::string> figure_words() {
  std::vector<std::string> words;
  for (Figure what{}; !word(what).empty(); what = static_cast<Figure>(static_cast<int>(what) + 1))
    words.emplace_back(word(what));
  return words;
}

}  // namespace

Command plot_command() {
  const auto options = std::make_shared<PlotOptions>();
  return {"plot",
          "draw one figure of a job's results into a file",
          {{"job", "", "the job's folder, or one of its .h5 files", &options->job, {.required = true}},
           {"--what", "", "which figure", &options->what, {.required = true, .choices = figure_words()}},
           {"-o,--output", "FILE", "picture to write, .svg or .png", &options->picture, {.required = true}},
           {"--time", "SECONDS", "of scene and deformation; without it when the most damaging cycle closes",
            &options->time}},
          [options] { return plot(*options); }};
}

}  // namespace dresslife::pipeline
