// The output of --json is JSON that Python reads, with the numbers of the other outputs.
#include <sstream>

#include "pipeline/advise/plan/duty_words.h"
#include "pipeline/advise/plan/evaluated_duties.h"
#include "pipeline/commands/as_json.h"
#include "pipeline/study/ranking.h"
#include "tests/catch.h"
#include "tests/cli/process.h"

using namespace dresslife::tests;

TEST_CASE("json: the ranking has ranking.csv's cells, a job its settings, a study the states of its jobs") {
  Scratch scratch;
  write_small_job(scratch);
  scratch.write("study.yaml", "base: job.yaml\nvary:\n  dresspack.bending_stiffness_Nm2: [2, 3]\n");
  scratch.write("compare.py", R"(import csv, json, sys
rows = json.load(open("ranking.json"))
table = list(csv.DictReader(open("runs/study/ranking.csv")))
assert len(rows) == len(table) == 2
for row, cells in zip(rows, table):
    assert isinstance(row["life_hours"], float) and isinstance(row["job"], str)
    for key, text in cells.items():
        assert (row[key] is None) == (text == ""), key
        assert not isinstance(row[key], float) or row[key] == float(text), key
job = json.load(open("job.json"))
assert job["routing"]["free_length_m"] == 0.9 and job["motion"]["clamp_poses"].endswith("poses.csv")
dry = json.load(open("dry.json"))
assert [job["job"] for job in dry] == sorted(row["job"] for row in rows) and all(job["state"] != "done" for job in dry)
for row in rows:
    assert len(row["warning_list"]) == row["warnings"] > 0
    for warning in row["warning_list"]:
        assert row[warning["kind"] + "_ok"] == "no"
        parts = [("", "problem"), (". Likely cause: ", "likely_cause"), (". Remedy: ", "remedy")]
        assert warning["text"] == "".join(mark + warning[key] for mark, key in parts if warning[key] is not None)
        assert warning["problem"] and warning["remedy"] and "Remedy" not in warning["problem"] + warning["likely_cause"]
check = json.load(open("check.json"))
assert check["job"] == "job.yaml" and check["refusal"] is None and check["not_checked"]
assert check["warnings"][0].keys() == rows[0]["warning_list"][0].keys()
coarse = [warning for warning in check["warnings"] if warning["kind"] == "mesh"][0]
assert coarse["remedy_values"]["simulation.segments"] > 12 and "simulation.segments: " in coarse["remedy"]
assert json.load(open("nothing.json")) == []
assert json.load(open("states.json")) == [{"job": row["job"], "state": "done", "reason": None} for row in sorted(rows, key=lambda r: r["job"])]
for job in json.load(open("stale.json")):
    assert job["state"] == "stale" and "dresspack.mass_kg_per_m" in job["reason"]
refused = json.load(open("refused.json"))
assert len(refused) == 2
for job in refused:
    assert job["state"] == "refused" and "dresspack.mass_kg_per_m is -1" in job["reason"]
)");
  const std::string program = "'" DRESSLIFE_BIN_DIR "/dresslife'";
  const Outcome outcome = run_shell(
      scratch,
      "set -e; " + program + " run study.yaml --json --quiet -n >dry.json; " + program +
          " run study.yaml --json --quiet >ranking.json; " + program +
          " run study.yaml --json --quiet -n >nothing.json; " + program + " show job.yaml --json >job.json; " +
          program + " check job.yaml --set dresspack.bending_stiffness_Nm2=0.03 --json >check.json; " + program +
          " status study.yaml --json >states.json; " + program +
          " status study.yaml --set dresspack.mass_kg_per_m=0.21 --json >stale.json; " + program +
          " run study.yaml --set dresspack.mass_kg_per_m=-1 --json --quiet -n >refused.json || true; python3 compare.py");
  // No progress. Warnings remain, because they concern the validity of the result.
  std::istringstream lines(outcome.err);
  for (std::string line; std::getline(lines, line);) CHECK(line.find(": warning: ") != std::string::npos);
  CHECK(outcome.status == 0);
}

TEST_CASE("json: texts of the ranking are as they were given, also with line feeds, signs and digits alone") {
  dresslife::pipeline::RankingRow row, failed;
  row.job = "7", row.worst_component = "+24V", row.worst_step = "line 1\nline 2", row.settings = "123456789012";
  row.worst_segment_from_tool = 3, row.life_hours = 5;
  failed.job = "two", failed.failure = "it broke";
  const std::string text = dresslife::pipeline::json_of(std::vector{row, failed}).text;
  for (const char* member :
       {R"("job":"7")", R"("worst_component":"+24V")", R"("worst_step":"line 1\u000aline 2")",
        R"("settings":"123456789012")", R"("worst_segment_from_tool":3)", R"("life_hours":5)", R"("status":"done")",
        R"("status":"failed")", R"("message":"it broke")", R"("worst_joint":null)"}) {
    INFO(member);
    CHECK(text.find(member) != std::string::npos);
  }
}

TEST_CASE("json: names of duties and of their jobs are as they were given") {
  dresslife::pipeline::DutyResult duty;
  duty.parts.resize(1);
  duty.lives.share = {1};
  dresslife::pipeline::RankingRow row;
  row.job = duty.parts.front().job = "1e5";
  for (const std::string name : {"#7", "line 1\nline 2", "0012", "=A1", " a, \"b\" "}) {
    duty.name = name;
    const std::string text = dresslife::pipeline::json_of(std::vector{duty}, {row}).text;
    INFO(text);
    CHECK(text.starts_with("[{\"duty\":" + dresslife::pipeline::Json(name).text +
                           R"(,"job":"1e5","repeats_per_hour":0,)"));
  }
}
