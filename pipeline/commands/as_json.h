// Output of commands as JSON for other programs (--json).
#pragma once

#include <string>
#include <vector>

#include "pipeline/report/json.h"

namespace dresslife::pipeline {

struct CsvTable;
struct DutyResult;
struct Fleet;
struct Node;
struct Plan;
struct RankingRow;
struct StateWords;
struct Warning;

/// Returns a list with one object per row of a table, with the titles of the columns as keys. Cells of text columns are text as it
/// is, without the apostrophe for spreadsheets. Other cells are numbers, but "inf" is text, because JSON has no infinity. Empty
/// cells are null.
Json json_of(const CsvTable& table);

/// Returns the rows of ranking.csv in the same form, each with its warnings as `warning_list`, a list of json_of(Warning).
Json json_of(const std::vector<RankingRow>& rows);

/// Returns the rows of duty_table(), each with the warnings of its program as `warning_list`, and as `do_not_plan` the programs of its
/// duty whose warnings make a plan unreliable (DutyResult::doubtful), as `confirm_first` its doubtful input
/// (DutyResult::unconfirmed). rows: rows of the programs.
Json json_of(const std::vector<DutyResult>& duties, const std::vector<RankingRow>& rows);

/// Returns a list with one object per window: its days, the dresspacks to replace in it, and the mean number of later ones.
Json json_of_windows(const Fleet& fleet, const Plan& plan);

/// Returns an object: kind, where, text (all words), problem, likely_cause, remedy, and remedy_values, the values of the remedy by
/// their keys. Texts that are missing are null.
Json json_of(const Warning& warning);

/// Returns a YAML document as JSON: numbers, true and false keep their type, all other values are text.
Json json_of(const Node& document);

/// Jobs and their states on standard output: one line each, or in JSON one list with all jobs.
class JobList {
 public:
  explicit JobList(bool json) : json_(json) {}
  void add(const std::string& job, const StateWords& words);
  /// Prints `words` below the lines; in JSON prints the list instead.
  void end(const std::string& words) const;

 private:
  bool json_;
  std::vector<Json> jobs_;
};

}  // namespace dresslife::pipeline
