#include "pipeline/advise/calibrate/service_records.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <set>

#include "pipeline/base/csv_rows.h"
#include "pipeline/base/exported.h"
#include "pipeline/base/joined.h"
#include "pipeline/base/lists.h"
#include "pipeline/base/plain_file.h"
#include "pipeline/base/readable.h"
#include "pipeline/base/text.h"
#include "pipeline/base/warning_words.h"
#include "pipeline/job/job.h"
#include "pipeline/life/likely_age.h"
#include "pipeline/resolve/catalogue.h"
#include "pipeline/resolve/document_kind.h"
#include "pipeline/resolve/job_text.h"
#include "pipeline/resolve/sources.h"
#include "pipeline/settings/problems.h"

namespace dresslife::pipeline {
namespace {

enum Column { robot, dresspack, installed, replaced, reason, hours_per_week, job, column_count };

struct ColumnWords {
  std::string_view name;
  std::vector<std::string_view> titles;  ///< letters a to z only
};
const std::array<ColumnWords, column_count>& columns() {
  static const std::array<ColumnWords, column_count> all{{
      {"robot",
       {"robot", "robotname", "roboter", "machine", "maschine", "anlage", "station", "asset", "equipment", "maquina",
        "mquina", "estacion", "estacin", "equipo"}},
      {"dresspack",
       {"dresspack", "cable", "cablepackage", "cabledress", "umbilical", "component", "schlauchpaket", "kabel",
        "paquete", "paquetedecables", "paquetedemangueras", "mazo", "mazodecables", "manguera"}},
      {"installed", titles_of_installation()},
      {"replaced", {"replaced",          "replacedon",    "replaceddate",    "replacementdate",  "datereplaced",
                    "removed",           "removedon",     "removaldate",     "ausbau",           "ausbaudatum",
                    "ausgebaut",         "ersetzt",       "gewechselt",      "ausgebautam",      "dateofreplacement",
                    "reemplazado",       "reemplazadoel", "reemplazo",       "fechadereemplazo", "fechareemplazo",
                    "sustituido",        "sustituidoel",  "sustitucion",     "sustitucin",       "fechadesustitucion",
                    "fechadesustitucin", "cambiado",      "cambiadoel",      "fechadecambio",    "fechacambio",
                    "retirado",          "retiradoel",    "fechaderetirada", "desmontado",       "fechadedesmontaje"}},
      {"reason",
       {"reason", "removalreason", "replacementreason", "cause", "grund", "ausbaugrund", "ausfallgrund",
        "ausfallursache", "ursache", "motivo", "causa", "razon", "razn"}},
      {"hours_per_week", titles_of_weekly_hours()},
      {"job", {"job", "program", "programm", "programa"}},
  }};
  return all;
}

bool has_any(const std::string& text, std::initializer_list<std::string_view> words) {
  return std::any_of(words.begin(), words.end(), [&](std::string_view word) { return text.find(word) != text.npos; });
}

enum class End { failed, removed, in_use };

/// Returns the kind of end; absent: not known. "unplanned" contains "planned", so failures are tested first. The words omit
/// letters that are not ASCII.
std::optional<End> end_in(const std::string& text) {
  const std::string letters = letters_of(text);
  if (has_any(letters, {"notfail", "nofail", "notdefect", "nodefect",  "notbroke",  "nobreak",   "kein",
                        "nicht",   "ohne",   "kabelio",   "inordnung", "cableok",   "verhinder", "vermied",
                        "avoid",   "evitad", "sinfall",   "sindefect", "sinrotura", "sinaver",   "noroto"}))
    return std::nullopt;
  if ((has_any(letters,
               {"fail",       "broke",    "break",     "defect",    "fault",       "unplanned",    "unscheduled",
                "corrective", "ausfall",  "defekt",    "bruch",     "gebrochen",   "gerissen",     "geplatzt",
                "strung",     "stoerung", "ungeplant", "unplanm",   "auerplanm",   "ausserplanm",  "rotura",
                "cableroto",  "averia",   "fallo",     "correctiv", "noprogramad", "noplanificad", "imprevist"}) ||
       letters == "falla" || letters.ends_with("avera")) &&
      !has_any(letters, {"prevent", "prventiv", "praeventiv", "vorbeug"}))
    // A crash is no failure by wear. But the text may also describe a crash after the cable broke, so the kind is not known.
    return has_any(letters, {"collision", "crash", "kollision"}) ? std::nullopt : std::optional(End::failed);
  if (has_any(letters,
              {"prevent",       "planned",      "scheduled", "maintenance", "inspection", "prventiv",   "praeventiv",
               "vorbeug",       "geplant",      "planm",     "wartung",     "collision",  "crash",      "kollision",
               "conversion",    "modification", "umbau",     "dismantled",  "verschrott", "planificad", "programad",
               "mantenimiento", "inspecci",     "colisi",    "choque",      "modificaci"}))
    return End::removed;
  // "Inbetriebnahme" (start of operation) does not say that the dresspack is in use.
  if (letters.empty() || letters == "inbetrieb" ||
      has_any(letters, {"alive", "inuse", "inservice", "running", "imbetrieb", "imeinsatz", "enuso", "enservicio",
                        "enfuncionamiento"}))
    return End::in_use;
  return std::nullopt;
}

/// Returns whether a text names a hose, sleeve or jacket and not the whole dresspack ("hose pack", "Schlauchpaket").
bool names_hose(const std::string& text) {
  std::string words = " ";
  for (const unsigned char letter : text)
    words += letter < 128 && std::isalpha(letter) ? static_cast<char>(std::tolower(letter)) : ' ';
  for (const std::string_view whole : {"hose pack", "hosepack", "schlauchpaket", "paquete de mangueras", "dress pack"})
    for (std::size_t at = words.find(whole); at != words.npos; at = words.find(whole)) words.erase(at, whole.size());
  return has_any(words + " ",
                 {" hose ", " hoses ", "conduit", "sleeve", "jacket", "schlauch", "wellrohr", "mantel", "manguera"});
}

struct Row {
  int line = 0;
  Where where;
  std::string name;       ///< name of the place: robot and dresspack
  std::string dresspack;  ///< empty: the table has no such column
  Day from{}, to{};
  End end = End::in_use;
  std::string reason;
  bool of_hose = false;  ///< its reason names a hose
  std::optional<double> hours_per_week;
  std::string job;
  Where job_where;
};

/// Returns the names of the jobs in a table's folder.
std::vector<std::string> jobs_beside(const std::filesystem::path& table) {
  std::vector<std::string> jobs;
  for (const std::filesystem::path& file : entries_of(std::filesystem::absolute(table).parent_path())) {
    if (file.extension() != ".yaml" && file.extension() != ".yml") continue;
    try {
      if (kind_of_document(read_document(file)) == DocumentKind::job) jobs.push_back(file.filename().string());
    } catch (const InputError&) {  // a file that is no document is no job
    }
  }
  return jobs;
}

class Export {
 public:
  explicit Export(const ServiceRequest& request)
      : request_(request), job_(request.job), reader_(read_text(request.file), request.file.string(), ";\t,") {
    titles_ = reader_.next();
    if (titles_.empty()) refuse_file("holds no table");
    find_columns();
  }

  std::vector<Row> rows() {
    std::vector<Row> rows;
    Problems problems;
    for (CsvRow cells = reader_.next(); !cells.empty(); cells = reader_.next())
      problems.attempt("", reader_.where(cells.front()), [&] { rows.push_back(row_of(cells)); });
    problems.finish(request_.file.string());
    if (rows.empty()) refuse_file("has titles and no row");
    check_overlaps(rows);
    return rows;
  }

  std::string column_words() const {
    std::vector<std::string> words;
    for (std::size_t c = 0; c < column_count; ++c)
      if (at_[c]) words.push_back(fmt::format("{} = '{}'", columns()[c].name, titles_[*at_[c]].text));
    std::vector<std::string> unused;
    for (std::size_t k = 0; k < titles_.size(); ++k)
      if (!titles_[k].text.empty() && std::ranges::find(at_, k) == at_.end())
        unused.push_back("'" + titles_[k].text + "'");
    return joined(words, ", ") + (unused.empty() ? "" : ". Not used: " + joined(unused, ", "));
  }
  /// Returns a line that names the job if neither the table nor the request does.
  const std::string& job_words() const { return job_words_; }

 private:
  [[noreturn]] void refuse_file(const std::string& what) const {
    throw InputError({request_.file.string(), 1, 1}, what,
                     "write the line 'robot,dresspack,installed,replaced,reason', then a row per dresspack");
  }

  void find_columns() {
    for (std::size_t k = 0; k < titles_.size(); ++k) {
      const std::string letters = letters_of(titles_[k].text);
      for (std::size_t c = 0; c < column_count; ++c) {
        const auto& known = columns()[c].titles;
        if (std::find(known.begin(), known.end(), letters) == known.end()) continue;
        if (at_[c])
          throw InputError(reader_.where(titles_[k]),
                           fmt::format("columns '{}' and '{}' both mean {}", titles_[*at_[c]].text, titles_[k].text,
                                       columns()[c].name),
                           "keep or rename one of the two");
        at_[c] = k;
      }
    }
    // Without this column a default is used. So an error asks about a column that may contain the hours.
    if (!at_[hours_per_week])
      for (const CsvCell& title : titles_)
        if (has_any(letters_of(title.text),
                    {"week", "woche", "semana", "semaine", "settimana", "hour", "stunde", "hora", "heure"}))
          throw InputError(
              reader_.where(title), fmt::format("column '{}' may mean hours_per_week, and is not known", title.text),
              "name it hours_per_week (of an hour counter: its hours over the weeks since installed), or without a word for "
              "hours or a week if it means something else");
    for (const Column needed : {robot, installed, replaced})
      if (!at_[needed])
        throw InputError(reader_.where(titles_.front()),
                         fmt::format("the table has no column '{}' (it has {})", columns()[needed].name,
                                     joined(mapped(titles_, &CsvCell::text), ", ")),
                         "add it, or rename one");
    if (!at_[job] && job_.empty()) find_job();
  }

  /// Takes the only job beside the table.
  void find_job() {
    const std::vector<std::string> jobs = jobs_beside(request_.file);
    if (jobs.size() != 1)
      throw InputError(reader_.where(titles_.front()), "it is not known which job these dresspacks do",
                       fmt::format("give --job JOB.yaml, or a column job{}",
                                   jobs.empty() ? "" : ". Jobs beside the table: " + joined(jobs, ", ")));
    job_ = (std::filesystem::absolute(request_.file).parent_path() / jobs.front()).string();
    job_words_ = fmt::format("Job: {}, the only job beside the table.\n", jobs.front());
  }

  const CsvCell* cell(const CsvRow& cells, Column column) const { return at_[column] ? &cells[*at_[column]] : nullptr; }
  std::string text(const CsvRow& cells, Column column) const {
    const CsvCell* const found = cell(cells, column);
    return found ? found->text : "";
  }
  [[noreturn]] void refuse(const CsvRow& cells, Column column, const std::string& what,
                           const std::string& remedy) const {
    throw InputError(reader_.where(*cell(cells, column)), what, remedy);
  }

  Day day(const CsvRow& cells, Column column) const {
    const std::string written = text(cells, column);
    const std::optional<Day> day = exported_day(written);
    if (!day) refuse(cells, column, fmt::format("'{}' is no date", written), day_remedy(written));
    if (*day > request_.today)
      refuse(cells, column, fmt::format("{} is after today, {}", day_text(*day), day_text(request_.today)),
             "correct the date, or give --today");
    return *day;
  }

  Row row_of(const CsvRow& cells) const {
    check_width(reader_, titles_, cells);
    Row row;
    row.line = reader_.line(), row.where = reader_.where(*cell(cells, robot)), row.name = text(cells, robot);
    if (row.name.empty()) refuse(cells, robot, "the robot has no name", "fill the cell");
    row.dresspack = text(cells, dresspack);
    if (at_[dresspack]) row.name += ", " + row.dresspack;
    row.from = day(cells, installed);
    read_end(cells, row);
    if (const std::string hours = text(cells, hours_per_week); !hours.empty()) {
      row.hours_per_week = exported_number(hours);
      constexpr double fewest = 0.1, most = 168;  // hours of a week
      if (!row.hours_per_week || !(*row.hours_per_week >= fewest && *row.hours_per_week <= most))
        refuse(cells, hours_per_week, fmt::format("hours_per_week is '{}' (must be {:g} .. {:g})", hours, fewest, most),
               row.hours_per_week ? "write the hours in which the program runs" : number_remedy(hours));
    }
    row.job = text(cells, job), row.job_where = row.job.empty() ? Where{"--job"} : reader_.where(*cell(cells, job));
    if (row.job.empty()) row.job = job_;
    if (row.job.empty())
      throw InputError(row.where, "it is not known which job this dresspack does",
                       "give --job JOB.yaml, or a column job");
    return row;
  }

  void read_end(const CsvRow& cells, Row& row) const {
    const std::string written = text(cells, replaced), why = text(cells, reason);
    const std::optional<End> why_end = end_in(why);
    if (!why_end)
      refuse(cells, reason, fmt::format("reason '{}' does not say whether the dresspack failed", why),
             "write failed, preventive or nothing (in use)");
    const bool is_date = exported_day(written).has_value();
    const bool has_digit = written.find_first_of("0123456789") != std::string::npos;
    if (!is_date && (has_digit || end_in(written) != End::in_use))
      refuse(cells, replaced, fmt::format("'{}' is no date", written),
             day_remedy(written) + ", or nothing while it is in use");
    row.to = is_date ? day(cells, replaced) : request_.today;
    row.end = *why_end;
    row.reason = why, row.of_hose = names_hose(why);
    if (is_date && row.end == End::in_use)
      refuse(cells, at_[reason] ? reason : replaced, "a dresspack was removed and no reason is given",
             at_[reason] ? "write failed or preventive as its reason"
                         : "name the column of reasons 'reason', and write failed or preventive into it");
    if (!is_date && row.end == End::failed)
      refuse(cells, replaced, fmt::format("the dresspack has a reason ('{}') and no date", why),
             "write when it was replaced, or no reason");
    if (!is_date) row.end = End::in_use;
    if (row.to < row.from)
      refuse(cells, replaced,
             fmt::format("replaced on {}, before it was installed on {}", day_text(row.to), day_text(row.from)),
             "correct one of the dates");
  }

  /// Throws if a dresspack is in the table twice for the same time, because it would count twice.
  void check_overlaps(const std::vector<Row>& rows) const {
    Problems problems;
    std::map<std::string, std::vector<const Row*>> places;
    // Exports write one name with other capitals and blanks.
    for (const Row& row : rows) {
      std::string name;
      for (const unsigned char letter : row.name)
        if (letter != ' ') name += static_cast<char>(std::tolower(letter));
      places[name].push_back(&row);
    }
    for (auto& [key, at] : places) {
      std::stable_sort(at.begin(), at.end(), [](const Row* a, const Row* b) {
        return std::pair(a->from, a->to) < std::pair(b->from, b->to);
      });
      for (std::size_t k = 1; k < at.size(); ++k)
        if (at[k]->from < at[k - 1]->to || (at[k]->from == at[k - 1]->from && at[k]->to == at[k - 1]->to))
          problems.add(at[k]->where,
                       fmt::format("'{}' is in use from {} on, and line {} has it until {}", at[k]->name,
                                   day_text(at[k]->from), at[k - 1]->line, day_text(at[k - 1]->to)),
                       "correct a date, remove the row that is there twice, or name the dresspack of each");
    }
    problems.finish(request_.file.string());
  }

  const ServiceRequest& request_;
  std::string job_, job_words_;  ///< of the rows without a job
  CsvReader reader_;
  CsvRow titles_;
  std::array<std::optional<std::size_t>, column_count> at_{};
};

/// Returns "spot_welding" for "jobs/spot_welding.yaml": fit for a folder.
std::string test_name(const std::string& job) {
  std::string name = std::filesystem::path(job).stem().string();
  for (char& letter : name)
    if (!std::isalnum(static_cast<unsigned char>(letter))) letter = '_';
  return name;
}

struct Program {
  std::string job;
  double share_of_time = 1;
};

/// Reads "a.yaml", or "a.yaml 60 % + b.yaml 25 %".
std::vector<Program> programs_of(const Row& row) {
  const std::string& text = row.job;
  if (!text.ends_with('%')) return {{text, 1}};
  std::vector<Program> programs;
  double sum = 0;
  for (std::string part : parts_between(text, " + ")) {
    while (!part.empty() && (part.back() == ' ' || part.back() == '%')) part.pop_back();
    const std::size_t blank = part.rfind(' ');
    const std::optional<double> percent = blank == part.npos ? std::nullopt : exported_number(part.substr(blank + 1));
    if (!percent || !(*percent > 0 && *percent <= 100))
      throw InputError(row.job_where, fmt::format("'{}' is no job with its share of the hours of operation", part),
                       "write JOB.yaml 60 % + OTHER.yaml 25 %");
    programs.push_back({part.substr(0, part.find_last_not_of(' ', blank) + 1), *percent / 100});
    sum += *percent;
  }
  constexpr double rounding = 0.1;  // per cent, the error of shares with one decimal
  if (sum > 100 + rounding)
    throw InputError(row.job_where, fmt::format("the shares of the programs add up to {:g} %", sum), "at most 100");
  return programs;
}

}  // namespace

ServiceTests read_service_tests(const ServiceRequest& request) {
  Export table(request);
  const std::vector<Row> rows = table.rows();
  std::optional<Day> first_removal;
  for (const Row& row : rows)
    if (row.end != End::in_use) first_removal = std::min(first_removal.value_or(row.to), row.to);
  const std::optional<Day> since = request.since ? request.since : first_removal;
  if (!since)
    throw InputError(
        {request.file.string()}, "has no dresspack that was removed, so the first day of the records is not known",
        "give the day from which the table has every removal, or that of the first installation if no dresspack was ever removed: --records-since DATE");

  ServiceTests read;
  std::map<std::string, std::size_t> known;  // (job) index of its test
  std::set<std::string> names;
  std::map<std::string, double> hours_per_week, robot_life;
  std::vector<Warning> ages, weeks;
  std::size_t failed = 0, removed = 0, in_use = 0, before = 0, early = 0, early_failed = 0;
  std::vector<std::string> hoses;  // one line per failure whose reason names a hose
  Where first_hose;
  std::map<std::string, std::size_t> of_reason;  // (reason) failures
  std::map<std::pair<Day, Day>, std::pair<const Row*, std::size_t>>
      on_day;  // (dates) first failure, number of failures
  for (const Row& row : rows) {
    const auto [at, is_new] = known.try_emplace(row.job, read.tests.size());
    if (is_new) {
      ObservedTest& test = read.tests.emplace_back();
      test.where = row.job_where;
      const auto unique = [&names](std::string name) {
        while (!names.insert(name).second) name += "_";
        return name;
      };
      test.observation.what = "dresspacks of a plant";
      test.observation.source = request.file.filename().string();
      for (const Program& program : programs_of(row)) {
        const std::string name = unique(test_name(program.job));
        test.observation.name += (test.observation.name.empty() ? "" : "+") + name;
        test.variants.push_back(
            {name, catalogue_entry("jobs", program.job, row.job_where, row.job_where), "", program.share_of_time});
      }
      const Fatigue fatigue = job_from(test.variants.front().job, request.sets).fatigue;
      hours_per_week[row.job] = fatigue.operating_hours_per_week, robot_life[row.job] = fatigue.robot_life_hours;
    }
    // Removals on the first day define this day, so they are no evidence of lives (a stopping time).
    const bool too_early = row.to < *since || (!request.since && row.end != End::in_use && row.to == *since);
    if (too_early) {
      ++early;
      early_failed += row.end == End::failed;
      continue;
    }
    if (row.hours_per_week)
      WarningsOfKind(weeks, WarningKind::calibration)
          .week(row.where, "hours_per_week", fmt::format(" of '{}'", row.name), *row.hours_per_week);
    const double hours_per_day = row.hours_per_week.value_or(hours_per_week[row.job]) / 7;
    // At least half a day, for a dresspack that was removed on the day of its installation or on the first day of the records.
    const double entry_days = std::max(0.0, days_between(row.from, *since));
    const double days = std::max(days_between(row.from, row.to), entry_days + 0.5);
    const ServiceRecord record{days * hours_per_day, entry_days * hours_per_day, row.end == End::failed};
    if (const auto doubt =
            doubt_about_age(row.name, row.from, row.to, record.hours, robot_life[row.job], record.failed))
      ages.push_back(
          warning_of(WarningKind::calibration, row.where.text(), doubt->problem, doubt->cause, doubt->remedy));
    ++(row.end == End::failed ? failed : row.end == End::removed ? removed : in_use);
    before += record.entry_hours > 0;
    if (record.failed && row.of_hose) {
      if (hoses.empty()) first_hose = row.where;
      hoses.push_back(std::to_string(row.line));
    }
    if (record.failed) {
      ++of_reason[row.reason];
      ++on_day.try_emplace({row.from, row.to}, &row, 0).first->second.second;
    }
    ObservedTest& test = read.tests[at->second];
    test.observation.service.push_back(record);
    test.text += fmt::format("{} {} {}\n", record.hours, record.entry_hours, record.failed);
  }
  std::erase_if(read.tests, [](const ObservedTest& test) { return test.observation.service.empty(); });
  if (read.tests.empty())
    throw InputError({request.file.string()},
                     fmt::format("no dresspack was in use after {}, the first day of the records", day_text(*since)),
                     "give an earlier day: --records-since DATE");
  for (ObservedTest& test : read.tests)
    for (const ObservedTest::Variant& program : test.variants)
      test.text += (program.share_of_time < 1 ? fmt::format("{} ", program.share_of_time) : "") + to_yaml(program.job);
  read.words = fmt::format("Columns: {}.\n{}", table.column_words(), table.job_words());
  if (std::ranges::any_of(rows, [](const Row& row) { return row.hours_per_week.has_value(); }))
    read.words +=
        "Hours per week are those in which the job's program runs. dresslife plan counts hours of operation, with standstill.\n";
  std::set<std::string> without_hours;
  for (const Row& row : rows)
    if (!row.hours_per_week) without_hours.insert(row.job);
  for (const std::string& of_job : without_hours)
    read.words +=
        fmt::format("Rows of {} without hours per week: {:g} (fatigue.operating_hours_per_week of the job).\n",
                    std::filesystem::path(of_job).filename().string(), hours_per_week[of_job]);
  std::map<std::string, std::set<std::string>> named;  // dresspacks by job
  for (const Row& row : rows)
    if (!row.dresspack.empty()) named[row.job].insert(row.dresspack);
  constexpr std::size_t most_named = 10;  // more are serial numbers, which name no kind of dresspack
  for (const auto& [of_job, of] : named)
    if (of.size() > 1 && of.size() <= most_named)
      read.words += fmt::format("'{}' all count as {}. If they differ, name a job for each in a column job.\n",
                                fmt::join(of, "', '"), std::filesystem::path(of_job).filename().string());
  read.words += fmt::format("{} dresspacks: {} failed, {} were removed without a failure, {} are in use on {}.\n",
                            failed + removed + in_use, failed, removed, in_use, day_text(request.today));
  if (failed > 0)
    read.words += fmt::format(
        "Counted as broken wires by their reasons: {}.\n",
        joined(mapped(of_reason, [](const auto& of) { return fmt::format("'{}' ({})", of.first, of.second); }), ", "));
  for (const auto& [days, of] : on_day) {
    constexpr std::size_t few = 3;  // two dresspacks of one cell may fail on one day
    if (of.second < few || 2 * of.second < failed) continue;
    read.words +=
        warning_of(WarningKind::calibration, of.first->where.text(),
                   fmt::format("{} of {} failures are of dresspacks that were installed on {} and replaced on "
                               "{} (limit fewer than half, or two)",
                               of.second, failed, day_text(days.first), day_text(days.second)),
                   "a planned replacement of all, or the day of the entry instead of that of the failure",
                   "preventive for those that had not failed, and the day of each failure; equal lives leave "
                   "no scatter between dresspacks")
            .line() +
        "\n";
  }
  read.words += fmt::format("Records begin on {}{}. Put in before: {}; these count from their age on that day.\n",
                            day_text(*since), request.since ? "" : ", the day of the first removal", before);
  if (early > 0)
    read.words += fmt::format(
        "Removed {}, not counted: {}, of these failed: {}{}.\n", request.since ? "before" : "on that day", early,
        early_failed,
        request.since ? "" : ". --records-since DATE gives an earlier day from which the records are complete");
  if (!request.since && failed == 0 && early_failed > 0)
    read.words += warning_of(WarningKind::calibration, "",
                             fmt::format("no failure counts: the table's only failures ({}) are on {}, the day of "
                                         "the first removal, and removals of this day do not count",
                                         early_failed, day_text(*since)),
                             "the records are complete from an earlier day",
                             "--records-since DATE: the first day from which the table has every removal")
                      .line() +
                  "\n";
  constexpr std::size_t most_ages = 5;
  for (std::size_t k = 0; k < std::min(most_ages, ages.size()); ++k) read.words += ages[k].line() + "\n";
  if (ages.size() > most_ages)
    read.words += fmt::format("{} further rows have unlikely ages.\n", ages.size() - most_ages);
  if (!weeks.empty()) read.words += weeks.front().line() + "\n";
  if (!hoses.empty())
    read.words +=
        warning_of(WarningKind::calibration, first_hose.text(),
                   fmt::format("the reason names a hose, sleeve or jacket and counts as broken wires (line {})",
                               joined(hoses, ", ")),
                   "a hose that cracked ends a dresspack before its wires do (competing risks)",
                   "if no wire had broken, write preventive: the wires lived at least so long. If a hose of a job with "
                   "hose_material cracked, leave the row out: its wall would count as whole")
            .line() +
        "\n";
  return read;
}

}  // namespace dresslife::pipeline
