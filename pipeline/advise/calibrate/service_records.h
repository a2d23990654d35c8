// Dresspacks of a plant, from the export of a maintenance system: one row for each installed dresspack.
//
//   robot;dresspack;installed;replaced;reason
//   R17;body side;02.03.2025;14.01.2026;failed
//   R17;body side;14.01.2026;;
//
// Columns have usual names in English, German or Spanish, in any order; other columns are allowed. An empty `replaced` means in
// use. `job` names a job, or several with their shares of the hours of operation: "sills.yaml 60 % + doors.yaml 25 %". Such jobs
// differ only in motion. ASSUMPTION: the programs load the same place, so that their damage adds up.
// Removals for other reasons than a failure end the observation (censored).
// A system that begins on some day contains no dresspacks that were removed before. Dresspacks that were installed before that
// day are known only because they reached it (left-truncated): their life counts from their age on that day.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/advise/calibrate/observations.h"
#include "pipeline/base/days.h"

namespace dresslife::pipeline {

struct ServiceRequest {
  std::filesystem::path file;
  std::string
      job;  ///< one or several jobs, for the rows without a job; empty: each row has a job, or the only job in the
            ///< table's folder is meant
  std::optional<Day>
      since;  ///< first day of the records; absent: the day of the first removal, which is then not counted
  Day today;  ///< day until which dresspacks in use have lived
  std::vector<std::string> sets;  ///< `--set` for the jobs
};

struct ServiceTests {
  std::vector<ObservedTest> tests;  ///< one per cell of the column job
  /// Report: the columns that were read, the rows that count, and a warning of failures whose reason names a hose.
  std::string words;
};

/// Reads the records. Errors: InputError with line and column for a missing column, two columns with one meaning, text that is no
/// date, dates in wrong order, an unknown reason, a row without a job, invalid shares of programs, two rows of one dresspack at
/// the same time; and if nothing can be learned.
ServiceTests read_service_tests(const ServiceRequest& request);

}  // namespace dresslife::pipeline
