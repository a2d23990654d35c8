#include "pipeline/report/chart_style.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <memory>

#include "pipeline/base/errors.h"

extern char** environ;

namespace dresslife::pipeline {
namespace {

constexpr std::string_view drawing_style = R"(
:root { color-scheme: light dark; --page: #ffffff; --ink: #1b1f24; --soft: #5b6570; --rule: #d5dae0; --grid: #e6e9ed;
  --blue: #0072b2; --hot: #c94f00; --band: #eef1f5; --band-2: #d9dfe7; --arm: #c3ccd6; --arm-2: #b3bdc9; }
@media screen and (prefers-color-scheme: dark) { :root { --page: #14171b; --ink: #e8eaed; --soft: #a0a9b4; --rule: #3a424c;
  --grid: #2a3037; --blue: #56b4e9; --hot: #f08c3a; --band: #242a31; --band-2: #37404a; --arm: #4a5562;
  --arm-2: #57636f; } }
svg { display: block; width: 100%; height: auto; font: 12px system-ui, "Segoe UI", "DejaVu Sans", Arial, sans-serif; }
svg text { fill: var(--ink); } svg .tick, svg .axis-title { fill: var(--soft); } svg .cell { fill: var(--soft);
  font-size: 11px; }
svg .note { paint-order: stroke; stroke: var(--page); stroke-width: 4px; stroke-linejoin: round; }
svg path { fill: none; } svg .grid { stroke: var(--grid); } svg .mark { stroke: var(--soft); }
svg .leader { stroke: var(--hot); stroke-dasharray: 3 3; }
svg .curve { stroke: var(--blue); stroke-width: 1.2; stroke-linejoin: round; } svg .curve-hot { stroke: var(--hot);
  stroke-width: 1.6; }
svg .bar, svg .dot { fill: var(--blue); } svg .bar-hot { fill: var(--hot); } svg .light { fill: var(--band); }
svg .dark { fill: var(--band-2); }
svg line { stroke-linecap: round; } svg .arm { stroke: var(--arm); } svg .arm-2 { stroke: var(--arm-2); }
svg .halo { stroke: var(--page); stroke-linecap: butt; }
svg .hose { stroke: var(--blue); } svg .hose-hot { stroke: var(--hot); }
svg .costly { fill: var(--hot); fill-opacity: .55; }
svg .whisker { stroke: var(--blue); stroke-width: 12; stroke-opacity: .35; }
svg .scatter { stroke: var(--hot); stroke-width: 5; }
)";

/// On a phone a chart scrolls sideways, so that its text stays readable; on paper the whole chart is printed.
constexpr std::string_view chart_rules = R"(
.chart { overflow-x: auto; } @media screen and (max-width: 45rem) { .chart > svg { min-width: 52rem; } }
.picture > svg { max-height: 32rem; } .metered { white-space: nowrap; }
.meter { display: inline-block; width: 6rem; height: .7rem; background: var(--band); margin-right: .5rem; }
.meter > span { display: block; height: 100%; background: var(--hot); }
@media print { .chart, .picture { break-inside: avoid; overflow: visible; } .picture > svg { max-height: 7cm; }
  .meter { width: 3rem; } .meter > span { print-color-adjust: exact; -webkit-print-color-adjust: exact; } }
)";

/// Returns the value of a variable in the first set of colours, which is the light one.
std::string_view light_colour(std::string_view variable) {
  const std::string declared = fmt::format("{}: ", variable);
  const std::size_t at = drawing_style.find(declared) + declared.size();
  return drawing_style.substr(at, drawing_style.find(';', at) - at);
}

/// Returns the rules with the light colours instead of variables.
std::string light_rules() {
  std::string rules(drawing_style.substr(drawing_style.find("svg {")));
  constexpr std::string_view open = "var(";
  for (std::size_t at = rules.find(open); at != std::string::npos; at = rules.find(open, at)) {
    const std::size_t end = rules.find(')', at);
    const std::string variable = rules.substr(at + open.size(), end - at - open.size());
    rules.replace(at, end + 1 - at, light_colour(variable));
  }
  return rules;
}

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;
File temporary_file() {
  File file(std::tmpfile(), std::fclose);
  if (!file) throw InputError({P_tmpdir}, "takes no temporary file", "make room there");
  return file;
}

/// Runs the converter. Returns its exit status; 127: the program is not installed.
int run_converter(std::FILE* in, std::FILE* out) {
  posix_spawn_file_actions_t streams;
  posix_spawn_file_actions_init(&streams);
  posix_spawn_file_actions_adddup2(&streams, ::fileno(in), STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&streams, ::fileno(out), STDOUT_FILENO);
  std::string name = "rsvg-convert", twice = "--zoom=2";
  char* arguments[] = {name.data(), twice.data(), nullptr};
  pid_t process = 0;
  const int failure = ::posix_spawnp(&process, name.c_str(), &streams, nullptr, arguments, environ);
  posix_spawn_file_actions_destroy(&streams);
  if (failure != 0) return 127;
  int status = 0;
  while (::waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 1;
}

}  // namespace

std::string chart_style() { return std::string(drawing_style).append(chart_rules); }

std::string chart_in_page(const std::string& svg) { return "<div class=\"chart\">" + svg + "</div>\n"; }

std::string picture_in_page(const std::string& svg) { return "<div class=\"picture\">" + svg + "</div>\n"; }

std::string standalone(const std::string& chart) {
  constexpr std::string_view begin = "<svg viewBox=\"0 0 ";
  if (!chart.starts_with(begin)) return chart;
  const std::size_t space = chart.find(' ', begin.size()), quote = chart.find('"', begin.size());
  const std::string width = chart.substr(begin.size(), space - begin.size()),
                    height = chart.substr(space + 1, quote - space - 1);
  const std::size_t inside = chart.find('>') + 1;
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" "
      "role=\"img\">\n<style>\n{2}</style>\n<rect width=\"{0}\" height=\"{1}\" fill=\"{3}\"/>\n{4}",
      width, height, light_rules(), light_colour("--page"), chart.substr(inside));
}

std::string png_of(const std::string& svg) {
  const File in = temporary_file(), out = temporary_file();
  if (std::fwrite(svg.data(), 1, svg.size(), in.get()) != svg.size() || std::fflush(in.get()) != 0)
    throw InputError({"/tmp"}, "takes no temporary file of this size", "make room there");
  std::rewind(in.get());
  const int status = run_converter(in.get(), out.get());
  if (status == 127)
    throw InputError({"rsvg-convert"}, "cannot be started (it makes PNG pictures)",
                     "install the Debian package librsvg2-bin, or name a file .svg");
  std::string bytes;
  char block[65536];
  std::rewind(out.get());
  for (std::size_t got; (got = std::fread(block, 1, sizeof block, out.get())) > 0;) bytes.append(block, got);
  if (status != 0 || bytes.empty())
    throw InputError({"rsvg-convert"}, fmt::format("failed with exit status {}", status), "name a file .svg");
  return bytes;
}

}  // namespace dresslife::pipeline
