#include "pipeline/study/ranking.h"

#include <fmt/format.h>

#include <algorithm>

#include "tests/catch.h"

namespace dresslife::pipeline {
namespace {

/// Returns `done` jobs with decreasing lives, then `failed` jobs.
std::vector<RankingRow> ranking(int done, int failed) {
  std::vector<RankingRow> rows;
  for (int k = 0; k < done + failed; ++k) {
    RankingRow& row = rows.emplace_back();
    row.job = fmt::format("job_{}", k + 1);
    row.life_hours = 1e6 - k;
    if (k >= done) row.failure = "job.yaml: error: no; correct it";
  }
  return rows;
}

TEST_CASE("shown rows: a short ranking is shown whole") {
  const ShownRows shown = shown_rows(ranking(35, 5));
  CHECK(shown.indices.size() == 40);
  CHECK(shown.summary.empty());
  CHECK(shown_rows({}).indices.empty());
}

TEST_CASE("shown rows: of a long ranking the best, the worst, the failed and the warned of") {
  std::vector<RankingRow> rows = ranking(1900, 100);
  for (std::size_t k = 0; k < 1900; ++k) rows[k].rank = k + 1;
  for (std::size_t k = 500; k < 550; ++k) rows[k].largest_force_share = 3;  // times a cable's strength
  const ShownRows shown = shown_rows(rows);
  std::vector<std::size_t> wanted{0, 1, 2};
  for (std::size_t k = 0; k < 10; ++k) wanted.push_back(500 + k);
  for (std::size_t k = 0; k < 10; ++k) wanted.push_back(1890 + k);
  for (std::size_t k = 0; k < 10; ++k) wanted.push_back(1900 + k);
  CHECK(shown.indices == wanted);
  CHECK(shown.summary.starts_with("2000 jobs: 1900 done, 50 of them warned of, 100 not done; shown are the best 3, "));

  const std::string table = ranking_table(rows);
  CHECK(std::count(table.begin(), table.end(), '\n') < 100);
  CHECK(table.find("\n1900  job_1900") != std::string::npos);  // its rank among all rows
  CHECK(table.find("job_1901") != std::string::npos);
  CHECK(table.find("job_1000") == std::string::npos);
  CHECK(table.ends_with(shown.summary));
}

TEST_CASE("shown rows: where all or none are done") {
  CHECK(shown_rows(ranking(0, 50)).indices.size() == 10);
  CHECK(shown_rows(ranking(50, 0)).indices.size() == 13);
  CHECK(shown_rows(ranking(4, 46)).indices.size() == 14);
}

}  // namespace
}  // namespace dresslife::pipeline
