// Remedies of the readers as lines of a job.
#include "sim/program/interpreter/job_words.h"

#include "tests/catch.h"

namespace dresslife::sim {

TEST_CASE("remedies are lines of a job, with quotes where YAML would read another text") {
  CHECK(values_of_job({"di1"}) == "motion.values: [{name: di1, value: VALUE}]");
  CHECK(values_of_job({"di1", "R[5]"}) == "motion.values: [{name: di1, value: VALUE}, {name: 'R[5]', value: VALUE}]");
  CHECK(values_of_job({"it's"}, "\"cm/min\"") == "motion.values: [{name: 'it''s', value: '\"cm/min\"'}]");
  CHECK(assume_of_job("q.mod:5") == "motion.assume: [{line: 'q.mod:5', take: then}] or take: else");
  CHECK(assume_of_job("5", "VALUE (1, 2, else)") == "motion.assume: [{line: 5, take: VALUE}] (1, 2, else)");
}

}  // namespace dresslife::sim
