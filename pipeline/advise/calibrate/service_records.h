// Dresspacks of a plant, from the export of a maintenance system: one row for each that was put in.
//
//   robot;dresspack;installed;replaced;reason
//   R17;body side;02.03.2025;14.01.2026;failed
//   R17;body side;14.01.2026;;
//
// Columns have usual names in English, German or Spanish, in any order, beside any others. `replaced` is empty for one in use.
// `job` names a job, or several with their shares of the hours of operation: "sills.yaml 60 % + doors.yaml 25 %". They
// differ only in motion. The programs are taken to load the same place, so that their damage adds up.
// Removals for other reasons than a failure end the observation (censored).
// A system that begins at a day holds no dresspacks that were removed before. Those that were put in before that day are
// therefore known only because they reached it (left-truncated): their life counts from their age then.
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
  std::string job;  ///< one or several, of the rows without one of their own; empty: each row has one
  std::optional<Day>
      since;  ///< the first day of the records; absent: that of the first removal, which does not count then
  Day today;  ///< until which dresspacks in use have lived
  std::vector<std::string> sets;  ///< of the jobs
};

struct ServiceTests {
  std::vector<ObservedTest> tests;  ///< one per cell of the column job
  /// What was read from which columns, which rows count, and a warning of failures whose reason names a hose.
  std::string words;
};

/// Errors: InputError at line and column for a missing column, two columns for one thing, a date that is none or is not
/// in order, a reason that is not known, a row without a job, shares of programs that are none, two rows of one dresspack at the same time; where nothing can
/// be learned.
ServiceTests read_service_tests(const ServiceRequest& request);

}  // namespace dresslife::pipeline
