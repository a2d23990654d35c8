#include "pipeline/advise/plan/duty.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "pipeline/base/exported.h"
#include "pipeline/base/joined.h"
#include "pipeline/base/lists.h"
#include "pipeline/base/plain_file.h"
#include "pipeline/resolve/document_kind.h"
#include "pipeline/settings/fields.h"

namespace dresslife::pipeline {
namespace {

constexpr double most_repeats = 1e6;  // per hour: the limit means a motion of 3.6 ms

/// key: path of the duty, "duties[2]".
void check(const Duty& duty, const std::string& key, Problems& problems) {
  if (duty.programs.empty() && !problems.touch(key + ".programs"))
    problems.add(duty.where, fmt::format("duty '{}' has no programs", duty.name), "add 'programs:' and a list");
  std::set<std::string> jobs;
  double percent_of_repeats = 0, percent_of_time = 0;
  for (std::size_t k = 0; k < duty.programs.size(); ++k) {
    const DutyProgram& program = duty.programs[k];
    const int given = program.repeats_per_hour.has_value() + program.repeats_per_shift.has_value() +
                      program.percent_of_time.has_value() + program.percent_of_repeats.has_value();
    if (given != 1 && !problems.touch(fmt::format("{}.programs[{}]", key, k + 1)))
      problems.add(program.where,
                   fmt::format("'{}' has {} numbers that say how often it runs (must be one)", program.job, given),
                   "give repeats_per_hour, repeats_per_shift, percent_of_time or percent_of_repeats");
    if (!jobs.insert(program.job).second)
      problems.add(program.where, fmt::format("'{}' occurs twice in duty '{}'", program.job, duty.name),
                   "add both numbers in one entry");
    percent_of_repeats += program.percent_of_repeats.value_or(0);
    percent_of_time += program.percent_of_time.value_or(0);
    if (program.percent_of_repeats && !duty.repeats_per_hour)
      problems.add(program.where, fmt::format("percent_of_repeats of '{}' has no number to refer to", program.job),
                   "give repeats_per_hour of the duty: all programs together");
  }
  const auto in_batches = [](const DutyProgram& program) { return program.batch_size > 0; };
  const auto batch = std::ranges::find_if(duty.programs, in_batches);
  if (batch != duty.programs.end() && !duty.order.empty())
    problems.add(batch->where, fmt::format("'{}' has a batch_size, and duty '{}' an order", batch->job, duty.name),
                 "remove batch_size and give repeats in the order, or remove the order");
  else if (std::ranges::count_if(duty.programs, in_batches) == 1 && !problems.touch(key + ".programs"))
    problems.add(batch->where,
                 fmt::format("'{}' alone has a batch_size, so it changes to no other program", batch->job),
                 "give the batch_size of the other programs, too");
  for (const OrderedProgram& program : duty.order)
    if (!jobs.contains(program.job) && !problems.touch(key + ".order"))
      problems.add(program.where, fmt::format("'{}' in the order is no program of duty '{}'", program.job, duty.name),
                   "add it to programs, with its number of repeats");
  if (duty.order.size() == 1 && !problems.touch(key + ".order"))
    problems.add(duty.order.front().where, "an order of one program has no change to another",
                 "name the other programs, or remove the order");
  constexpr double rounding = 1e-9;
  if (percent_of_repeats > 100 + rounding)
    problems.add(duty.where, fmt::format("percent_of_repeats adds up to {:g} %", percent_of_repeats), "at most 100");
  if (percent_of_time > 100 + rounding)
    problems.add(duty.where, fmt::format("percent_of_time adds up to {:g} %", percent_of_time), "at most 100");
}

}  // namespace

void describe(Fields& f, DutyProgram& program) {
  f.place(program.where);
  f.text("job", program.job, Need::required, "The name of a job of the study: a program on the dresspack.");
  f.maybe_number("repeats_per_hour", program.repeats_per_hour, between(0, most_repeats),
                 "The repeats of the program in an hour of operation.");
  f.maybe_number("repeats_per_shift", program.repeats_per_shift, between(0, 24 * most_repeats),
                 "The repeats of the program in a shift of `shift_hours`.");
  f.maybe_number("percent_of_time", program.percent_of_time, between(0, 100),
                 "The share of the hours of operation in which the robot runs the program.");
  f.maybe_number("percent_of_repeats", program.percent_of_repeats, between(0, 100),
                 "The share of the duty's `repeats_per_hour`.");
  f.integer(
      "batch_size", program.batch_size, Need::optional, between(0, most_repeats),
      "Its repeats in a row before the next program begins: in place of an `order`, where each program runs once in a round. 0: not "
      "known.");
  f.number("deviation_percent", program.deviation_percent, Need::optional, between(0, 100),
           "The standard deviation of the number of repeats, from one dresspack to the next.");
  f.text(
      "recording_of", program.recording_of, Need::optional,
      "Programs with the same name here are recordings of one cycle. The answer states how much their damages differ.");
}

void describe(Fields& f, OrderedProgram& program) {
  f.place(program.where);
  f.text("job", program.job, Need::required, "The name of a job among the programs of the duty.");
  f.integer("repeats", program.repeats, Need::optional, between(1, most_repeats),
            "Its repeats before the next one begins.");
}

void describe(Fields& f, PastDuty& past) {
  f.place(past.where);
  f.text("duty", past.duty, Need::required, "The name of a duty in this file.");
  f.maybe_number("hours", past.hours, at_least(0), "The hours of operation under it.");
  f.text(
      "from", past.from, Need::optional,
      "In place of `hours`: the first day under it, as in 2026-01-05. Each week counts as `hours_per_week` of that duty.");
  f.text("to", past.to, Need::optional, "The last day under it.");
}

void describe(Fields& f, Duty& duty) {
  f.place(duty.where);
  f.text("name", duty.name, Need::required, "The name of the duty.");
  f.number("hours_per_week", duty.hours_per_week, Need::optional, between(0.1, 168),
           "The hours of operation in a week: motion, pauses and waits.");
  f.number("shift_hours", duty.shift_hours, Need::optional, between(0.1, 168), "The hours of a shift.");
  f.maybe_number("repeats_per_hour", duty.repeats_per_hour, between(0, most_repeats),
                 "The repeats of all programs together in an hour of operation, for `percent_of_repeats`.");
  f.list("programs", duty.programs, Need::required, "The programs, and how often each of them runs.");
  f.list(
      "order", duty.order, Need::optional,
      "One round of the programs, which begins again after the last of them. With it the changes between programs count.");
  f.list("history", duty.history, Need::optional,
         "What the dresspack has done so far. With it the remaining life is predicted, and a plan counts it.");
}

namespace {

void describe(Fields& f, DutyFile& file) {
  f.place(file.where);
  f.text("study", file.study, Need::required, "The study with the jobs: a name of config/studies, or a file.");
  f.list("duties", file.duties, Need::required, "The duties.");
}

/// Adds a problem for each key of a program that is written beside `programs`, and removes the key from the document.
void take_out_keys_of_programs(Node& document, Problems& problems) {
  const std::set<std::string> of_programs{"batch_size",         "repeats_per_shift", "percent_of_time",
                                          "percent_of_repeats", "deviation_percent", "recording_of"};
  if (!document.is_map() || !document.find("duties") || !document.find("duties")->is_list()) return;
  for (Node& duty : document["duties"].items)
    std::erase_if(duty.entries, [&](const Entry& entry) {
      if (!of_programs.contains(entry.key)) return false;
      problems.add(entry.where, fmt::format("'{}' is a key of each program, not of the duty", entry.key),
                   fmt::format("write it in the entries of programs: {{job: NAME, {}: {}}}", entry.key,
                               entry.value.is_scalar() ? entry.value.text : "..."));
      return true;
    });
}

}  // namespace

std::array<Day, 2> PastDuty::days(Day today) const {
  const auto day_of = [&](const char* key, const std::string& text) {
    if (const std::optional<Day> day = exported_day(text)) return *day;
    throw InputError(
        where,
        text.empty() ? fmt::format("the history has no '{}'", key) : fmt::format("{} '{}' is no date", key, text),
        day_remedy(text));
  };
  const std::array<Day, 2> days{day_of("from", from), day_of("to", to)};
  if (days[1] < days[0])
    throw InputError(where, fmt::format("the history ends on {}, before it begins", to), "exchange the two dates");
  if (days[0] > today)
    throw InputError(where, fmt::format("the history begins on {}, after today, {}", from, day_text(today)),
                     "give days that are past");
  if (days[1] > today)
    throw InputError(where, fmt::format("the history ends on {}, after today, {}", to, day_text(today)),
                     fmt::format("to: {}, or an earlier day", day_text(today)));
  return days;
}

namespace {

/// Converts the days of a history to hours.
void fill_hours(const DutyFile& file, std::vector<PastDuty>& history, Day today, Problems& problems) {
  std::vector<std::pair<std::array<Day, 2>, const PastDuty*>> periods;
  for (PastDuty& past : history)
    problems.attempt("", past.where, [&] {
      const Duty& duty = duty_named(file, past.duty, past.where);
      const bool dated = !past.from.empty() || !past.to.empty();
      if (dated == past.hours.has_value())
        throw InputError(past.where,
                         dated ? "the history has both hours and dates" : "the history has neither hours nor dates",
                         "give hours, or from and to");
      if (!dated) return;
      const std::array<Day, 2> days = past.days(today);
      past.hours = (days_between(days[0], days[1]) + 1) / 7 * duty.hours_per_week;
      for (const auto& [other, same] : periods)
        if (days[0] <= other[1] && other[0] <= days[1])
          throw InputError(
              past.where,
              fmt::format("the days {} .. {} overlap those of line {}", past.from, past.to, same->where.line),
              "one dresspack has one duty at a time; give a duty of both programs");
      periods.emplace_back(days, &past);
    });
}

}  // namespace

double DutyProgram::rate(double repeat_seconds, double shift_hours, std::optional<double> all_repeats) const {
  if (repeats_per_hour) return *repeats_per_hour;
  if (repeats_per_shift) return *repeats_per_shift / shift_hours;
  if (percent_of_repeats) return *percent_of_repeats / 100 * all_repeats.value_or(0);
  return percent_of_time.value_or(0) / 100 * 3600 / repeat_seconds;
}

DutyFile read_duties(const std::filesystem::path& name, Day today) {
  check_utf8(read_text(name),
             name.string());  // with another encoding the names of duties would differ from those of a fleet
  Node document = read_yaml(name);
  if (document.is_map() && !document.find("duties")) refuse_other_kind(document, DocumentKind::duties);
  DutyFile file;
  Problems problems;
  take_out_keys_of_programs(document, problems);
  read_fields(document, Describe([&](Fields& f) { describe(f, file); }), problems);
  if (file.duties.empty() && !problems.touch("duties"))
    problems.add(file.where, "duties has no entry", "write '- name: ...' with programs");
  std::set<std::string> unique;
  for (std::size_t k = 0; k < file.duties.size(); ++k) {
    const Duty& duty = file.duties[k];
    check(duty, fmt::format("duties[{}]", k + 1), problems);
    if (!unique.insert(duty.name).second)
      problems.add(duty.where, fmt::format("two duties are named '{}'", duty.name), "give each another name");
    if (!problems.touch(fmt::format("duties[{}].history", k + 1)))
      fill_hours(file, file.duties[k].history, today, problems);
  }
  problems.finish(name.string());
  for (Duty& duty : file.duties)
    for (const DutyProgram& program : duty.programs)
      if (program.batch_size > 0) duty.order.push_back({program.where, program.job, program.batch_size});
  return file;
}

const Duty& duty_named(const DutyFile& file, const std::string& name, const Where& named_at) {
  if (const Duty* const duty = find_in(file.duties, &Duty::name, name)) return *duty;
  const std::string near = nearest_word(name, mapped(file.duties, &Duty::name));
  throw InputError(named_at, fmt::format("there is no duty '{}'", name),
                   near.empty() ? fmt::format("the file's duties: {}", joined(mapped(file.duties, &Duty::name), ", "))
                                : fmt::format("did you mean '{}'?", near));
}

std::vector<KeyRow> duty_keys() {
  DutyFile file;
  return key_rows("duties", Describe([&](Fields& f) { describe(f, file); }));
}

}  // namespace dresslife::pipeline
