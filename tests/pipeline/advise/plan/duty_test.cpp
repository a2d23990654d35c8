#include "pipeline/advise/plan/duty.h"

#include "tests/catch.h"
#include "tests/pipeline/scratch.h"

using namespace dresslife::pipeline;

namespace {

DutyFile read(const std::string& text) {
  const Scratch scratch;
  scratch.write("duties.yaml", text);
  return read_duties(scratch / "duties.yaml");
}

std::string refusal(const std::string& text) {
  try {
    read(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::string of_programs(const std::string& programs, const std::string& more = "") {
  return "study: s\nduties:\n  - name: d\n" + more + "    programs:\n" + programs;
}

}  // namespace

TEST_CASE("ten repeats an hour in every unit") {
  constexpr double seconds = 36;
  for (const char* words : {"repeats_per_hour: 10", "repeats_per_shift: 60", "percent_of_time: 10", "percent_of_repeats: 40"}) {
    INFO(words);
    const DutyFile file =
        read(of_programs(std::string("      - {job: a, ") + words + "}\n", "    shift_hours: 6\n    repeats_per_hour: 25\n"));
    const Duty& duty = file.duties.front();
    CHECK(duty.programs.front().rate(seconds, duty.shift_hours, duty.repeats_per_hour) == Approx(10).epsilon(1e-12));
  }
}

TEST_CASE("a file of duties that contradicts itself is refused at its place") {
  CHECK(refusal(of_programs("      - {job: a}\n")).find("duties.yaml:5:9: error: 'a' has 0 numbers") != std::string::npos);
  CHECK(refusal(of_programs("      - {job: a, repeats_per_hour: 1, percent_of_time: 2}\n")).find("'a' has 2 numbers") !=
        std::string::npos);
  CHECK(refusal(of_programs("      - {job: a, repeats_per_hour: -1}\n")).find("repeats_per_hour") != std::string::npos);
  CHECK(refusal(of_programs("      - {job: a, percent_of_repeats: 10}\n")).find("give repeats_per_hour of the duty") !=
        std::string::npos);
  CHECK(refusal(of_programs("      - {job: a, repeats_per_hour: 1}\n      - {job: a, repeats_per_hour: 2}\n")).find("occurs twice") !=
        std::string::npos);
  CHECK(refusal(of_programs("      - {job: a, percent_of_repeats: 60}\n      - {job: b, percent_of_repeats: 60}\n",
                            "    repeats_per_hour: 5\n"))
            .find("adds up to 120 %") != std::string::npos);
  CHECK(refusal(of_programs("      - {job: a, repeats_per_hour: 1}\n", "    history: [{duty: dd, hours: 5}]\n"))
            .find("did you mean 'd'?") != std::string::npos);
  CHECK(refusal(of_programs("      - {job: a, repeat_per_hour: 1}\n")).find("did you mean 'repeats_per_hour'") != std::string::npos);
  CHECK(refusal("study: s\nduties: []\n").find("duties") != std::string::npos);
  CHECK(refusal("duties: [{name: d, programs: [{job: a, percent_of_time: 5}]}]\n").find("study") != std::string::npos);
}
