#include "pipeline/study/rate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "pipeline/base/csv_rows.h"
#include "pipeline/base/joined.h"
#include "pipeline/base/lists.h"
#include "pipeline/base/plain_file.h"
#include "pipeline/base/readable.h"
#include "pipeline/job/job.h"
#include "pipeline/resolve/cable_alone.h"
#include "pipeline/resolve/catalogue.h"
#include "pipeline/resolve/job_text.h"
#include "pipeline/settings/fields.h"
#include "pipeline/settings/units.h"

namespace dresslife::pipeline {
namespace {

namespace fs = std::filesystem;

bool tells_friction(const Node& component) {
  const Node* parts = component.find("components");
  return !parts || std::ranges::all_of(parts->items, [](const Node& part) {
    return part.find("friction_coefficient") && part.find("radial_line_load_N_per_m") && tells_friction(part);
  });
}

/// Returns strain.slip for a job of this cable alone: "free", then "friction" if all its parts have its keys, else "free".
std::string slip_of_cable(const Node& alone) {
  const Node& cable = alone.find("components")->items.front();
  const bool rubs = tells_friction(cable);
  std::vector<std::string> words{"free"};
  for (int level = 1; level < levels_of(cable); ++level) words.push_back(rubs ? "friction" : "free");
  return fmt::format("[{}]", joined(words, ", "));
}

std::string fit_for_a_folder(std::string text) {
  for (char& letter : text)
    if (!std::isalnum(static_cast<unsigned char>(letter)) && letter != '-') letter = '_';
  return text;
}

class RatedStudyMaker {
 public:
  RatedStudyMaker(const fs::path& file, const std::vector<std::string>& sets)
      : file_(file), sets_{"uncertainty.enabled=false"} {
    sets_.insert(sets_.end(), sets.begin(),
                 sets.end());  // the rating is compared with the model's life by the scatter of wires only
  }

  RateStudy make(const fs::path& rigs) {
    made_.study.name = "rate_" + fit_for_a_folder(file_.stem().string());
    Node job;  // used only to look up names in the dresspack
    job.where = {file_.string()};
    job["dresspack"] = read_yaml(file_);
    const Node& written = *job.find("dresspack");
    if (!written.is_map() || written.find("motion"))
      throw InputError({file_.string()}, "holds no dresspack and no cable", "name a file of the keys of job.dresspack");
    resolve_job(job);
    const Node dresspack = *job.find("dresspack");
    const std::vector<std::string> cables = cables_of(dresspack);
    if (cables.empty())
      throw InputError({file_.string()}, "holds no cable (a part that holds parts)", "name another dresspack");
    if (const Node* const estimates = dresspack.find("estimates")) made_.estimates = estimates->text;
    for (const std::string& cable : cables) add_cable(dresspack, cable, cables.size() > 1, rigs);
    refuse_common_fault();
    return std::move(made_);
  }

 private:
  /// Throws if all jobs have the same fault, which then lies in their common input: settings or the dresspack.
  void refuse_common_fault() const {
    const std::vector<StudyJob>& jobs = made_.study.jobs;
    const std::string& fault = jobs.front().failure;
    if (!fault.empty() && std::ranges::all_of(jobs, [&](const StudyJob& job) { return job.failure == fault; }))
      throw InputError(fault);
  }

  void add_cable(const Node& dresspack, const std::string& name, bool among_others, const fs::path& rigs) {
    const Node cable = cable_alone(dresspack, name, {file_.string()});
    const std::string prefix = among_others ? fit_for_a_folder(name) + "-" : "";
    for (const fs::path& file : entries_of(rigs)) {
      if (file.extension() != ".yaml") continue;
      Node job = read_yaml(file);
      const Node* motion = job.find("motion");
      const Node* words = motion ? motion->find("name") : nullptr;
      add({prefix + file.stem().string(), name, words ? words->text : file.stem().string(), 0, ""}, std::move(job),
          cable);
    }
    const Node* ratings = cable.find("components")->items.front().find("ratings");
    int number = 0;
    for (const Node& written : ratings ? ratings->items : std::vector<Node>{}) {
      Rating rating;
      read_fields(written, rating);
      Node job;
      job.kind = Node::Kind::map;
      job.where = written.where;
      job["motion"]["rig"] = *written.find("rig");
      add({fmt::format("{}rating_{}", prefix, ++number), name, rig_words(rating.rig), rating.cycles, rating.source},
          std::move(job), cable);
    }
  }

  void add(RatedTest test, Node job, const Node& cable) {
    // Names of two cables may differ only in letters that do not fit a folder.
    const std::string name = test.job;
    for (int n = 2; find_in(made_.tests, &RatedTest::job, test.job); ++n) test.job = fmt::format("{}_{}", name, n);
    StudyJob made;
    made.name = test.job;
    job["dresspack"] = cable;
    job["strain"]["slip"] = parse_yaml(slip_of_cable(cable), file_.string());
    try {
      made.job = std::make_shared<const Job>(job_from(std::move(job), sets_));
    } catch (const InputError& problem) {
      made.failure = problem.what();
    }
    made_.study.jobs.push_back(std::move(made));
    made_.tests.push_back(std::move(test));
  }

  fs::path file_;
  std::vector<std::string> sets_;
  RateStudy made_;
};

/// Returns "respected" if half of such cables reach the maker's rating.
std::string verdict(double rated, double predicted) {
  if (rated == 0 || std::isnan(predicted)) return "";
  if (predicted >= rated) return "respected";
  return fmt::format("missed by {}", readable(rated / predicted, 2));
}

}  // namespace

int levels_of(const Node& component) {
  const Node* const parts = component.find("components");
  return 1 + (parts ? largest_of(parts->items, 0, levels_of) : 0);
}

std::string rig_words(const Rig& rig) {
  const Node keys = echo_fields(rig);
  const auto has_unit = [](const Entry& entry) { return entry.key != "kind" && entry.key != "cycles_per_minute"; };
  const auto words =
      mapped(filtered(keys.entries, has_unit), [](const Entry& entry) { return entry.key + " " + entry.value.text; });
  return fmt::format("{}: {}", word(rig.kind), joined(words, ", "));
}

RateStudy rate_study(const fs::path& file, const fs::path& rigs, const std::vector<std::string>& sets) {
  return RatedStudyMaker(file, sets).make(rigs);
}

CycleLives cycles_of(const RankingRow& row) {
  CycleLives lives{row.life_repeats, row.life_repeats_all_stick, row.life_repeats_all_free, {}};
  for (std::size_t i = 0; i < 3; ++i)
    lives.conductor[i] = (row.planned() ? row.by_scatter() : row.conductor_hours)[i] * 3600 / row.repeat_seconds;
  if (std::isnan(row.glued_hours[1])) return lives;
  lives.all_stick = row.glued_hours[1] * 3600 / row.repeat_seconds;
  lives.all_free = row.free_hours[1] * 3600 / row.repeat_seconds;
  return lives;
}

std::string rate_table(const RateStudy& rated, const std::vector<RankingRow>& rows) {
  std::string text, cable;
  const std::size_t wide =
      largest_of(rated.tests, std::size_t{46}, [](const RatedTest& test) { return columns_of(test.rig); });
  for (const RatedTest& test : rated.tests) {
    if (test.cable != cable) text += fmt::format("{}{}\n", text.empty() ? "" : "\n", test.cable);
    if (test.cable != cable)
      text += fmt::format("  {:<{}} {:>12} {:>27} {:>27}  {}\n", "rig", wide, "cycles", "10 .. 90 %",
                          "inside glued .. free", "maker");
    cable = test.cable;
    const RankingRow* row = find_in(rows, &RankingRow::job, test.job);
    if (!row || !row->done()) {
      text += fmt::format("  {:<{}} {}\n", test.rig, wide, row ? row->failure : "not computed");
      continue;
    }
    const CycleLives lives = cycles_of(*row);
    std::string maker = test.rated_cycles > 0 ? readable(test.rated_cycles) : "";
    if (const std::string words = verdict(test.rated_cycles, lives.conductor[1]); !words.empty())
      maker += " (" + words + ")";
    text += fmt::format("  {:<{}} {:>12} {:>27} {:>27}  {}\n", test.rig, wide, life_text(lives.conductor[1]),
                        life_text(lives.conductor[0]) + " .. " + life_text(lives.conductor[2]),
                        life_text(lives.all_stick) + " .. " + life_text(lives.all_free), maker);
  }
  return text +
         "\ncycles: by then half of such cables have a conductor that has lost its share of wires "
         "(fatigue.failed_wires_percent) at one place.\n10 .. 90 %: the same for 10 and 90 of 100 cables, by the scatter of "
         "wires. inside glued .. free: cycles if the parts inside the cable cannot slide, and if they slide without friction.\n"
         "All cycles are for the cable's own values (uncertainty.enabled=false). dresslife run of a rig also counts other values of "
         "uncertain inputs\nand makers' ratings, so its lives differ by large factors.\n"
         "rolling_flex: a cycle is a round trip. torsion: held ends pull at a cable that the twist shortens. A cable that it "
         "lengthens bows.\nA free lower end moves with the length of the cable. Which of both lives longer depends on the lay. "
         "A heavier weight shortens the life.\n";
}

std::string rate_csv(const RateStudy& rated, const std::vector<RankingRow>& rows) {
  std::string text =
      "cable,job,rig,status,cycles_p10,cycles_p50,cycles_p90,worst_wire_cycles,cycles_all_stick,cycles_all_free,"
      "rated_cycles,source\n";
  for (const RatedTest& test : rated.tests) {
    const RankingRow* row = find_in(rows, &RankingRow::job, test.job);
    const bool done = row && row->done();
    std::vector<std::string> cells{csv_cell(test.cable), csv_cell(test.job), csv_cell(test.rig),
                                   done ? "done" : csv_cell(row ? row->failure : "to do")};
    const CycleLives lives = done ? cycles_of(*row) : CycleLives{};
    for (const double value : {lives.conductor[0], lives.conductor[1], lives.conductor[2], lives.worst_wire,
                               lives.all_stick, lives.all_free})
      cells.push_back(done && !std::isnan(value) ? shortest_text(value) : "");
    cells.push_back(test.rated_cycles > 0 ? shortest_text(test.rated_cycles) : "");
    cells.push_back(csv_cell(test.source));
    text += fmt::format("{}\n", joined(cells, ","));
  }
  return text;
}

}  // namespace dresslife::pipeline
