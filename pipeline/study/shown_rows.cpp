#include "pipeline/study/shown_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "pipeline/base/order.h"
#include "pipeline/study/row_warnings.h"

namespace dresslife::pipeline {
namespace {

constexpr std::size_t short_ranking = 40;  // jobs of two to four lines each: a reader still reads them all
constexpr std::size_t best = 3, worst = 10, failed = 10, warned = 10;

/// Returns the number of rows in [begin, end) for which `counts` is true; appends the first `most` of them to `shown`.
template <class Counts>
std::size_t take(const std::vector<RankingRow>& rows, std::size_t begin, std::size_t end, std::size_t most,
                 std::set<std::size_t>& shown, const Counts& counts) {
  std::size_t found = 0;
  for (std::size_t k = begin; k < end; ++k)
    if (counts(rows[k]) && ++found <= most) shown.insert(k);
  return found;
}

}  // namespace

ShownRows shown_rows(const std::vector<RankingRow>& rows) {
  if (rows.size() <= short_ranking) return {indices_of(rows.size()), ""};
  const auto first_failed = std::partition_point(rows.begin(), rows.end(), [](const auto& row) { return row.done(); });
  const auto done = static_cast<std::size_t>(first_failed - rows.begin());
  const auto any = [](const RankingRow&) { return true; };
  std::set<std::size_t> shown;
  take(rows, 0, done, best, shown, any);
  take(rows, done - std::min(done, worst), done, worst, shown, any);
  const std::size_t of_warning =
      take(rows, 0, done, warned, shown, [](const RankingRow& row) { return !warnings_of(row).empty(); });
  take(rows, done, rows.size(), failed, shown, any);
  return {{shown.begin(), shown.end()},
          fmt::format(
              "{} jobs: {} done, {} of them warned of, {} not done; shown are the best {}, the worst {} and the first "
              "{} warned of and {} not done, all are in ranking.csv and the report\n",
              rows.size(), done, of_warning, rows.size() - done, best, worst, warned, failed)};
}

}  // namespace dresslife::pipeline
