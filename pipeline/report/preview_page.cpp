#include "pipeline/report/preview_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <limits>

#include "pipeline/base/lists.h"
#include "pipeline/base/warnings.h"
#include "pipeline/cable/bend_limit.h"
#include "pipeline/files/files.h"
#include "pipeline/job/setup.h"
#include "pipeline/report/cross_section.h"
#include "pipeline/report/json.h"
#include "pipeline/report/motion_data.h"
#include "pipeline/report/page_shell.h"
#include "pipeline/report/plot.h"
#include "pipeline/report/scene_data.h"
#include "pipeline/report/stored_job.h"

namespace dresslife::pipeline {
namespace {

/// A length that was tried by the simulation.
struct TriedLength {
  double length = 0, bend_radius = 0;  ///< [m]; bend radius 0: no equilibrium was found
};

/// Dresspack between two of its clamps.
struct SpanPreview {
  std::string subject;  ///< "dresspack 'main hose' between the base clamp and clamp 1"
  double length = 0;    ///< [m]
  double least_way = 0, most_way = 0;
  double here[2]{}, program[2]{};  ///< suitable lengths [m]
  double least_bend_radius = 0;    ///< smallest allowed bend radius [m]
  std::vector<TriedLength> tried;
  bool hangs() const { return !(most_way > 0); }
  bool works() const { return hangs() || (length >= program[0] && length <= program[1]); }
};

std::vector<SpanPreview> spans_of(const FileReader& file, const Setup& setup) {
  const auto dresspacks = file.read<std::int32_t>("/span/dresspack");
  const auto names = file.read<std::string>("/span/name");
  const auto lengths = file.read<double>("/span/length"), ways = file.read<double>("/span/way"),
             working = file.read<double>("/span/working_length");
  std::vector<SpanPreview> spans(lengths.size());
  for (std::size_t k = 0; k < spans.size(); ++k) {
    SpanPreview& span = spans[k];
    const auto dresspack = static_cast<std::size_t>(dresspacks[k]);
    if (dresspack >= setup.dresspacks.size())
      throw InputError(file.where(), fmt::format("/span/dresspack names dresspack {}", dresspack),
                       "make the file again");
    span.subject = dresspack_words(setup, dresspack) + names[k];
    span.subject.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(span.subject.front())));
    span.length = lengths[k];
    span.least_way = std::numeric_limits<double>::infinity();
    for (std::size_t at = k; at < ways.size(); at += spans.size()) {
      span.least_way = std::min(span.least_way, ways[at]);
      span.most_way = std::max(span.most_way, ways[at]);
    }
    for (std::size_t end = 0; end < 2; ++end) {
      span.here[end] = working[4 * k + end];
      span.program[end] = working[4 * k + 2 + end];
    }
    span.least_bend_radius = least_bend_radius(setup.dresspacks[dresspack].dresspack);
  }
  if (!file.has("/scan/span")) return spans;
  const auto of = file.read<std::int32_t>("/scan/span");
  const auto length = file.read<double>("/scan/length"), radius = file.read<double>("/scan/bend_radius");
  for (std::size_t k = 0; k < of.size(); ++k)
    spans.at(static_cast<std::size_t>(of[k])).tried.push_back({length[k], radius[k]});
  return spans;
}

/// Returns the lengths that keep the bend radius at rest, or the length with the least bend. bends: whether a check, which
/// includes the contact of the dresspack, warns of its bends.
std::string bend_words(const SpanPreview& span, bool bends) {
  const TriedLength *first = nullptr, *last = nullptr, *best = nullptr;
  for (const TriedLength& tried : span.tried) {
    if (!(tried.bend_radius > 0)) continue;
    if (!best || tried.bend_radius > best->bend_radius) best = &tried;
    if (tried.bend_radius < span.least_bend_radius) continue;
    if (!first) first = &tried;
    last = &tried;
  }
  if (!best || (!first && !bends)) return "";
  const double allowed = 1e3 * span.least_bend_radius;
  if (!first)
    return fmt::format(
        " At rest and without the robot, none of the lengths that were tried keeps the bend radius of {:.4g} mm. {:.2f} m comes nearest, with "
        "{:.0f} mm: turn the clamps toward each other, or move them apart.",
        allowed, best->length, 1e3 * best->bend_radius);
  const bool keeps_with_robot = !bends && span.works() && (span.length < first->length || span.length > last->length);
  return fmt::format(
      " At rest and without the robot, {} the bend radius of {:.4g} mm.{} Motion and contact bend the hose more.",
      first == last ? fmt::format("{:.2f} m keeps", first->length)
                    : fmt::format("{:.2f} .. {:.2f} m keep", first->length, last->length),
      allowed, keeps_with_robot ? fmt::format(" With the robot, {:.3f} m keeps it, too.", span.length) : "");
}

std::string words(const SpanPreview& span, bool bends) {
  if (span.hangs()) return fmt::format("{} hangs {:.3f} m long from its last clamp.", span.subject, span.length);
  const std::string first_pose =
      std::abs(span.here[0] - span.program[0]) + std::abs(span.here[1] - span.program[1]) < 0.01
          ? ""
          : fmt::format(" ({:.2f} .. {:.2f} m in its first pose alone)", span.here[0], span.here[1]);
  return fmt::format(
      "{} is {:.3f} m long. Over the program its clamps are {:.3f} .. {:.3f} m apart: {}. For the slack alone {:.2f} .. {:.2f} m suit the program{}: 2 to "
      "50 % longer than the largest distance.{}",
      span.subject, span.length, span.least_way, span.most_way,
      span.works()                    ? "its slack fits"
      : span.length < span.most_way   ? "too short"
      : span.length < span.program[0] ? "hardly any slack"
                                      : "long",
      span.program[0], span.program[1], first_pose, bend_words(span, bends));
}

bool warns_of_bends(const FileReader& preview) {
  if (!preview.has_attribute("warnings")) return true;
  const std::vector<Warning> warnings = warnings_from(preview.text_attribute("warnings"));
  return std::ranges::any_of(warnings, [](const Warning& one) { return one.kind == WarningKind::bend_radius; });
}

std::string scan_table(const std::vector<SpanPreview>& spans) {
  std::string rows;
  for (const SpanPreview& span : spans)
    for (const TriedLength& tried : span.tried)
      rows += fmt::format(
          "<tr><td>{}</td><td class=\"number\">{:.2f} m</td><td class=\"number{}\">{}</td><td "
          "class=\"number\">{:.0f} mm</td></tr>\n",
          escaped(span.subject), tried.length, tried.bend_radius < span.least_bend_radius ? " failed" : "",
          tried.bend_radius > 0 ? fmt::format("{:.0f} mm", 1e3 * tried.bend_radius) : "no rest found",
          1e3 * span.least_bend_radius);
  if (rows.empty()) return "";
  return "<h2>Other lengths at rest</h2>\n<p class=\"soft\">Least bend radius in eight poses of the program, "
         "with the dresspack's "
         "weight, free of twist, without contact and speed. Without a position of rest in one of them nothing is shown: "
         "a run may find one.</p>\n" +
         wide_table({"what", "#length", "#least bend radius", "#allowed"}, rows);
}

Json ways_data(const FileReader& file, const std::vector<SpanPreview>& spans) {
  const auto times = file.read<double>("/time"), ways = file.read<double>("/span/way");
  std::vector<Json> rows;
  for (std::size_t k = 0; k < spans.size(); ++k) {
    if (spans[k].hangs()) continue;
    std::vector<double> own;
    for (std::size_t at = k; at < ways.size(); at += spans.size()) own.push_back(ways[at]);
    rows.push_back({{"name", spans[k].subject}, {"length", spans[k].length}, {"ways", own}});
  }
  return {{"time", mapped(times, [&](double time) { return time - times[0]; })}, {"spans", rows}};
}

/// Returns the number between two phrases of a message; NaN: the message does not contain them.
double number_between(std::string_view before, std::string_view after, const std::string& message) {
  const std::size_t end = message.find(after), begin = end == std::string::npos ? end : message.rfind(before, end - 1);
  double number = std::numeric_limits<double>::quiet_NaN();
  if (begin != std::string::npos) std::from_chars(message.data() + begin + before.size(), message.data() + end, number);
  return number;
}

/// Returns the time in a message of the simulation, "... at 151.040 s, program step 9 ..."; NaN: the message contains none.
double time_in(const std::string& failure) { return number_between(" at ", " s, program step ", failure); }

/// Returns the place along a dresspack in a message of the simulation, "... 0.42 m from its base clamp" [m]; NaN: none.
double place_in(const std::string& refusal) { return number_between(" ", " m from its base clamp", refusal); }

}  // namespace

std::vector<std::string> length_words(const std::filesystem::path& preview_file) {
  const FileReader file(preview_file, preview_format());
  const bool bends = warns_of_bends(file);
  return mapped(spans_of(file, setup_from(stored_job(file))),
                [&](const SpanPreview& span) { return words(span, bends); });
}

std::string refusal_of(const std::filesystem::path& preview_file) {
  return FileReader(preview_file, preview_format(), FileReader::Scope::attributes).text_attribute("refusal");
}

std::string preview_page(const std::filesystem::path& preview_file, const std::string& name,
                         const std::string& made_from, const std::string& failure) {
  const FileReader file(preview_file, preview_format());
  const Setup setup = setup_from(stored_job(file));
  const std::vector<SpanPreview> spans = spans_of(file, setup);
  std::string refusal = file.text_attribute("refusal");
  double refusal_time = file.has_attribute("refusal_time") ? file.number_attribute("refusal_time")
                                                           : std::numeric_limits<double>::quiet_NaN();
  if (refusal.empty() && !failure.empty()) {
    refusal = failure;
    refusal_time = time_in(failure);
  }
  std::vector<std::string> notes;
  const Json scene = scene_data(setup, notes);
  const Json data{{"title", name},
                  {"scene", scene},
                  {"motion", motion_data(file, nullptr, setup)},
                  {"program", program_data(file)},
                  {"preview", Json{{"refusal", refusal},
                                   {"refusal_time", refusal_time},
                                   {"refusal_share", place_in(refusal) / sum_of(spans, &SpanPreview::length)},
                                   {"ways", ways_data(file, spans)}}}};
  std::string body = fmt::format("<h1>{}: before the run</h1>\n", escaped(name));
  body += refusal.empty() ? "<p>The simulation takes this job.</p>\n"
                          : fmt::format("<p class=\"failed\" id=\"refusal\">{}</p>\n", escaped(refusal));
  const bool bends = warns_of_bends(file);
  std::string well, ill;
  for (const SpanPreview& span : spans)
    (span.works() ? well : ill) += fmt::format("<p>{}</p>\n", escaped(words(span, bends)));
  body += ill;
  for (const std::string& note : notes) body += fmt::format("<p class=\"failed\">{}</p>\n", escaped(note));
  body +=
      "<div id=\"view\"></div>\n<div id=\"clamp\"></div>\n<p class=\"soft\">The dresspack is drawn as a smooth curve of its length "
      "between its clamps, as the "
      "search for its rest begins with: it does not sag, swing or touch yet.</p>\n<div class=\"beside\"><div "
      "id=\"timeline\"></div>\n<div>\n";
  std::string layers;
  for (const MountedDresspack& mounted : setup.dresspacks) {
    const Dresspack& dresspack = mounted.dresspack;
    body += fmt::format(
        "<figure><img alt=\"Cross-section of {0}\" src=\"data:image/svg+xml;base64,{1}\"><figcaption class=\"soft\">{0}</figcaption>"
        "</figure>\n",
        escaped(dresspack.name), base64(cross_section_picture(dresspack, LayerLines::left_out)));
    layers +=
        fmt::format("<h2>{}</h2>\n<pre>{}</pre>\n", escaped(dresspack.name), escaped(construction_text(dresspack)));
  }
  body += "</div></div>\n" + well + scan_table(spans) + layers;
  body += "<p class=\"soft\" id=\"shown\"></p>\n<details><summary>Settings</summary>\n<pre>" +
          escaped(file.text_attribute("job")) + "</pre></details>\n";
  return whole_page(name + ": before the run", made_from, body, data.text);
}

}  // namespace dresslife::pipeline
