#include "pipeline/report/job_page.h"

#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <optional>

#include "pipeline/base/digest.h"
#include "pipeline/base/joined.h"
#include "pipeline/base/readable.h"
#include "pipeline/base/whole_file.h"
#include "pipeline/cable/stiffness.h"
#include "pipeline/files/checksum.h"
#include "pipeline/files/motion_layout.h"
#include "pipeline/report/cross_section.h"
#include "pipeline/report/damage_tables.h"
#include "pipeline/report/figures.h"
#include "pipeline/report/json.h"
#include "pipeline/report/life_data.h"
#include "pipeline/report/motion_checks.h"
#include "pipeline/report/motion_data.h"
#include "pipeline/report/page_shell.h"
#include "pipeline/report/plot.h"
#include "pipeline/report/scene_data.h"
#include "pipeline/report/section_data.h"
#include "pipeline/report/stored_job.h"
#include "pipeline/study/ranking.h"
#include "pipeline/study/row_warnings.h"
#include "pipeline/study/row_words.h"

namespace dresslife::pipeline {
namespace {

using Reader = std::unique_ptr<const FileReader>;

Reader opened(const std::filesystem::path& file, const Format& format, std::vector<std::string>& notes) {
  if (kind_of(file) != FileKind::absent) return std::make_unique<FileReader>(file, format);
  notes.push_back(fmt::format("{} is not there (run the job again)", file.filename().string()));
  return nullptr;
}

std::string paragraph(const std::string& words) {
  return words.empty() ? "" : fmt::format("<p>{}</p>\n", escaped(words));
}

/// Returns the action and each failure mode.
std::string headline(const RankingRow& row) {
  const std::string action = action_words(row);
  const bool named =
      action.find(row.not_evaluated) != std::string::npos;  // true also if all parts and modes are evaluated
  return fmt::format("<h1>{}</h1>\n<p><b>{}</b></p>\n", escaped(row.job), escaped(action)) + failure_table(row) +
         (named ? "" : paragraph(fmt::format("Not evaluated: {}.", row.not_evaluated)));
}

std::string tenth_words(double hours) {
  return std::isfinite(hours) ? fmt::format("10 % would have failed after {}", printed_hours(hours))
                              : "fewer than 10 % would fail";
}

/// Returns the distribution of the life, the test that would narrow it, and the worst wire.
std::string lives(const RankingRow& row) {
  const double hours = row.headline_hours();
  std::string words;
  if (std::isfinite(hours))
    words += fmt::format("{} of motion, {} repeats of {:.1f} s: by then {}. ", printed_hours(hours),
                         printed(row.headline_repeats()), row.repeat_seconds,
                         row.planned()
                             ? "10 % of such dresspacks have a conductor that has lost its share of wires at one place"
                             : "the worst wire breaks (median)");
  if (row.planned() && std::isfinite(row.planned_hours[2]))
    words += fmt::format("Half have failed after {}, 90 % after {}. ", printed_hours(row.planned_hours[1]),
                         printed_hours(row.planned_hours[2]));
  if (!std::isnan(row.glued_hours[0]))
    words += fmt::format("If everything inside the cables were glued, {}; if it slipped without friction, {}. ",
                         tenth_words(row.glued_hours[0]), tenth_words(row.free_hours[0]));
  if (const std::string own = own_values_words(row); !own.empty()) words += own + " ";
  if (row.damaged()) words += fmt::format("The median of the worst wire is {}.", printed_hours(row.life_hours));
  return paragraph(words) + paragraph(uncertainty_words(row)) + paragraph(failure_words(row));
}

/// Returns the simulated stiffnesses of each dresspack: "E I 25 N m2, G J 20 N m2, E A 1e+05 N"; empty if an older file does not
/// contain them.
std::string stiffness_words(const FileReader& motion) {
  if (!motion.has("/dresspack/bending_stiffness")) return "";
  const auto bending = motion.read<double>("/dresspack/bending_stiffness"),
             torsional = motion.read<double>("/dresspack/torsional_stiffness"),
             axial = motion.read<double>("/dresspack/axial_stiffness");
  const std::vector<std::string> names = dresspack_names(motion);
  std::vector<std::string> words;
  for (std::size_t d = 0; d < bending.size() && d < names.size(); ++d)
    if (bending[d] > 0)
      words.push_back(fmt::format("{}E I {:.3g} N m2, G J {:.3g} N m2, E A {:.3g} N",
                                  names[d].empty() ? "" : names[d] + ": ", bending[d], torsional[d], axial[d]));
  return joined(words, "; ");
}

/// Returns, for each dresspack with a stiffness from its construction, the values without this rule.
std::string construction_words(const Setup& setup) {
  std::string words;
  for (const MountedDresspack& mounted : setup.dresspacks)
    if (is_from_construction(mounted.dresspack)) words += stiffness_text(mounted.dresspack);
  return words;
}

/// Returns the keys of one section of the resolved job with single-word values: "stress cyclic, counting repeating"; empty: none.
std::string settings_words(const Node& job, const std::string& part) {
  std::vector<std::string> words;
  if (const Node* settings = job.find(part); settings && settings->is_map())
    for (const Entry& entry : settings->entries)
      if (entry.value.is_scalar()) words.push_back(entry.key + " " + entry.value.text);
  return joined(words, ", ");
}

/// Returns the settings with most influence, in their final form. job: resolved.
std::string assumptions(const RankingRow& row, const Node& job, const FileReader* motion, const FileReader* strain,
                        const Setup* setup) {
  std::string list;
  const auto fact = [&](const std::string& name, const std::string& value) {
    list += fmt::format("<dt>{}</dt><dd>{}</dd>\n", name, value);
  };
  for (const Warning& warning : warnings_of(row)) fact(title(warning.kind), "<b>" + escaped(warning.text()) + "</b>");
  if (has_paths(row)) fact("paths in warnings", "relative to the study's folder, which contains that of this page");
  if (!row.estimates.empty()) fact("ESTIMATE, not in the dresspack", escaped(row.estimates));
  if (row.force_ok() && row.largest_force_share.value_or(0) > 0)
    fact("forces", fmt::format("at most {:.2g} of the force that breaks a cable", *row.largest_force_share));
  if (strain && strain->has_attribute("loose_mesh_error"))
    fact("mesh of loose cables", fmt::format("discretisation error of their curvature: {:.2g} % (a warning above 1 %)",
                                             100 * strain->number_attribute("loose_mesh_error")));
  const std::string stiffness = motion ? stiffness_words(*motion) : "";
  if (!stiffness.empty()) fact("hose as simulated", escaped(stiffness));
  if (const std::string words = setup ? construction_words(*setup) : ""; !words.empty())
    fact("from construction", "<pre>" + escaped(words) + "</pre>");
  if (motion && motion->has_attribute("time_step"))
    fact("time step", fmt::format("{:.3g} ms{}", 1e3 * motion->number_attribute("time_step"),
                                  motion->has_attribute("curvature_error")
                                      ? fmt::format(", which leaves an error of {:.2g} % in the curvature",
                                                    100 * motion->number_attribute("curvature_error"))
                                      : ""));
  for (const char* part : {"simulation", "strain", "fatigue"})
    if (const std::string words = settings_words(job, part); !words.empty()) fact(part, escaped(words));
  return list.empty() ? "" : "<dl>\n" + list + "</dl>\n";
}

/// Returns the names of the limits that the motion exceeds; empty: none.
std::string broken_limits(const FileReader& motion) {
  if (!motion.has("/check/warning")) return "";
  const auto names = motion.read<std::string>("/check/name");
  const auto warnings = motion.read<std::int32_t>("/check/warning");
  std::vector<std::string> broken;
  for (std::size_t k = 0; k < names.size(); ++k)
    if (warnings[k]) broken.push_back(names[k]);
  return broken.empty() ? "" : fmt::format("Limits of the motion are broken: {} (see below)", joined(broken, ", "));
}

/// Returns the layers of each dresspack as text.
std::string layers(const Setup& setup) {
  std::string text;
  for (std::size_t d = 0; d < setup.dresspacks.size(); ++d) text += construction_text(setup.dresspacks[d].dresspack);
  return text;
}

std::string folded(const std::string& summary, const std::string& text) {
  return fmt::format("<details><summary>{}</summary>\n<pre>{}</pre></details>\n", summary, escaped(text));
}

class Page {
 public:
  explicit Page(const JobFolder& files)
      : files_(files),
        life_(files.life(), life_format()),
        motion_(opened(files.motion(), motion_format(), notes_)),
        strain_(opened(files.strain(), strain_format(), notes_)),
        row_(read_ranking({{files.name, files.life(), ""}}).front()) {
    if (!row_.done()) throw InputError(life_.where(), row_.failure, "run the job again");
    check_of_one_job({files.motion(), files.strain(), files.life()});
    if (!motion_) return;
    if (const std::string limits = broken_limits(*motion_); !limits.empty()) notes_.push_back(limits);
    // The setup comes from life.h5: motion.h5 may belong to another job with the same motion but with other cables in the hose.
    setup_ = setup_from(stored_job(life_));
  }

  std::string text(const std::string& made_from) {
    const Json data = this->data();
    return whole_page(files_.name + ": dresspack in motion", made_from, body(), data.text);
  }

 private:
  Json data() {
    Json data{{"title", files_.name}, {"life", life_data(life_, strain_.get())}};
    if (setup_) {
      const Json scene = scene_data(*setup_, notes_);
      if (const auto section = section_data(life_, *setup_)) data.add("section", *section);
      data.add("scene", scene).add("motion", motion_data(*motion_, strain_.get(), *setup_));
    }
    return data;
  }

  std::string body() const {
    std::string text = headline(row_);
    for (const std::string& note : notes_) text += fmt::format("<p class=\"failed\">{}</p>\n", escaped(note));
    text +=
        "<div id=\"view\"></div>\n<div class=\"beside\"><div id=\"timeline\"></div>\n<div id=\"place\"></div></div>\n"
        "<div id=\"section\"></div>\n<div id=\"wire\"></div>\n";
    if (row_.has_wires()) text += "<h2>Lives of the wires</h2>\n" + lives(row_);
    if (row_.damaged()) {
      const LifeSummary life = read_life(files_.life());
      text += "<h2>Where the damage comes from</h2>\n" + damage_along(life, row_) + damage_tables(life, row_);
    }
    text += "<h2>What the numbers rest on</h2>\n" +
            assumptions(row_, stored_job(life_), motion_.get(), strain_.get(), setup_ ? &*setup_ : nullptr);
    if (motion_) text += check_table(files_.motion());
    text += "<p class=\"soft\" id=\"shown\"></p>\n";
    if (setup_) text += folded("What the dresspack is made of", layers(*setup_));
    return text + folded("Settings", life_.text_attribute("job")) +
           folded("How it was run", life_.text_attribute("history"));
  }

  JobFolder files_;
  std::vector<std::string> notes_;
  FileReader life_;
  Reader motion_, strain_;
  RankingRow row_;
  std::optional<Setup> setup_;
};

/// Returns a digest of the results and of this program. Errors: InputError when an existing file has a damaged checksum.
std::string made_from(const JobFolder& files) {
  std::string sources = shell_digest() + files.name;
  for (const auto& file : {files.motion(), files.strain(), files.life()}) {
    const std::optional<std::string> checksum = stored_checksum(file);
    if (!checksum && kind_of(file) == FileKind::file)  // readers report any other kind of file
      throw InputError({file.string()}, "is damaged (it has no checksum)", "make it again with dresslife run");
    sources += checksum.value_or("-");
  }
  return xxh3(sources);
}

constexpr std::string_view before_mark = "<body>\n<p class=\"failed\" id=\"stale\">", behind_mark = "</p>\n";

bool is_marked(const JobFolder& files) { return read_text(files.page()).find(before_mark) != std::string::npos; }

}  // namespace

std::string job_page(const JobFolder& files) { return Page(files).text(made_from(files)); }

bool refresh_job_page(const JobFolder& files, StaleMark mark) {
  if (made_from_of(files.page()) == made_from(files) && (mark == StaleMark::kept || !is_marked(files))) return false;
  write_text_if_changed(files.page(), job_page(files), Sync::never);
  return true;
}

void mark_job_page(const JobFolder& files, const std::string& words) {
  if (made_from_of(files.page()).empty()) return remove_job_page(files);  // the page is damaged, or of another version
  const std::string mark = fmt::format("{}{}{}", before_mark, escaped(words), behind_mark);
  const std::string page = read_text(files.page());
  if (page.find(mark) != std::string::npos) return;
  const std::string marked = changed_page(page, [&](std::string& text) {
    constexpr std::string_view unmarked = "<body>\n";
    const std::size_t mark_at = text.find(before_mark), at = text.find(unmarked);
    if (at == std::string::npos) return;
    const std::size_t end = mark_at == at ? text.find(behind_mark, at) + behind_mark.size() : at + unmarked.size();
    text.replace(at, end - at, mark);
  });
  write_text_if_changed(files.page(), marked, Sync::never);
}

void remove_job_page(const JobFolder& files) { remove_ours(files.page()); }

void remove_old_job_page(const JobFolder& files) {
  if (made_from_of(files.page()) != made_from(files) || is_marked(files)) remove_job_page(files);
}

}  // namespace dresslife::pipeline
