#include "pipeline/stage/stage.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <functional>
#include <thread>

#include "pipeline/base/digest.h"
#include "pipeline/base/installation.h"
#include "pipeline/job/job.h"
#include "pipeline/resolve/job_text.h"
#include "tests/catch.h"
#include "tests/pipeline/files/still_motion.h"
#include "tests/pipeline/sample_job.h"
#include "tests/pipeline/scratch.h"

namespace dresslife::pipeline {
namespace {

const StageInfo info{"dresslife-sample", "Makes samples.", "input.h5", "output.h5",
                     "dresslife-sample input.h5 -o output.h5"};

struct Outcome {
  int status;
  std::string errors, words;
  bool ran = false;
  StageCall call;
};

Outcome run(
    const std::vector<std::string>& arguments,
    const std::function<void(const StageCall&)>& body = [](const StageCall&) {}, const StageInfo& stage = info) {
  std::vector<std::string> words{stage.program};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  Outcome outcome;
  Captured errors(STDERR_FILENO), out(STDOUT_FILENO);
  outcome.status =
      run_stage(stage, static_cast<int>(words.size()), pointers.data(), [&](const StageCall& call, Progress&) {
        outcome.ran = true;
        outcome.call = call;
        body(call);
      });
  outcome.words = out.text();
  outcome.errors = errors.text();
  return outcome;
}

Format small_format() {
  Format format{"dresslife-sample", 1, "dresslife-sample", "tests", {}, {}};
  format.datasets = {{"/a", Type::f64, {"a"}, "1", "numbers"}};
  return format;
}

void write_stamped(const std::filesystem::path& file, const StageCall& call, const Job& job,
                   const std::string& earlier) {
  const Format format = small_format();
  FileWriter writer(file, format);
  writer.append("/a", std::span<const double>(std::vector<double>{1}));
  stamp(writer, call, job, earlier);
  writer.commit();
}

TEST_CASE("stage: the command line arrives as typed") {
  const Outcome outcome =
      run({"in.h5", "-o", "out.h5", "--job", "j.yaml", "--set", "a.b=1", "--set", "c=[1, 2]", "--quiet"});
  CHECK(outcome.status == 0);
  CHECK(outcome.ran);
  CHECK(outcome.errors.empty());
  CHECK(outcome.words.empty());
  CHECK(outcome.call.input == "in.h5");
  CHECK(outcome.call.output == "out.h5");
  CHECK(outcome.call.job_file == "j.yaml");
  CHECK(outcome.call.sets == std::vector<std::string>{"a.b=1", "c=[1, 2]"});
  CHECK(outcome.call.quiet);
}

TEST_CASE("stage: a wrong command line ends with 2 and says what is wrong") {
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{},
                                             {"in.h5"},
                                             {"-o", "out.h5"},
                                             {"in.h5", "-o"},
                                             {"in.h5", "-o", "out.h5", "--fast"},
                                             {"in.h5", "more.h5", "-o", "out.h5"}}) {
    const Outcome outcome = run(arguments);
    CHECK(outcome.status == 2);
    CHECK_FALSE(outcome.ran);
    CHECK_FALSE(outcome.errors.empty());
  }
  CHECK(run({"in.h5", "-o", "out.h5", "--fast"}).errors.find("--fast") != std::string::npos);
}

TEST_CASE("stage: a stage whose input is the job takes no other job") {
  StageInfo first = info;
  first.input_is_job = true;
  CHECK(run(
            {"job.yaml", "-o", "out.h5"}, [](const StageCall&) {}, first)
            .status == 0);
  CHECK(run(
            {"job.yaml", "-o", "out.h5", "--job", "j.yaml"}, [](const StageCall&) {}, first)
            .status == 2);
}

TEST_CASE("stage: help and version go to standard output and end with 0") {
  const Outcome help = run({"--help"});
  CHECK(help.status == 0);
  CHECK_FALSE(help.ran);
  for (const char* part :
       {"Makes samples.", "Example: dresslife-sample input.h5 -o output.h5", "--set", "--job", "--quiet", "--version"})
    CHECK(help.words.find(part) != std::string::npos);
  CHECK(help.errors.empty());
  const Outcome version = run({"--version"});
  CHECK(version.status == 0);
  CHECK(version.words == version_text("dresslife-sample") + "\n");
}

TEST_CASE("stage: the man page and the completions name every option, also of a stage alone, and need no input") {
  StageInfo special = info;
  std::vector<std::string> assumed;
  special.options = {{"--assume", "LINE=then|else", "how a branch goes", &assumed}};
  const auto manual = [&](const std::string& kind) {
    const Outcome outcome = run(
        {"--manual", kind}, [](const StageCall&) {}, special);
    CHECK(outcome.status == 0);
    CHECK_FALSE(outcome.ran);
    CHECK(outcome.errors.empty());
    return outcome.words;
  };
  const std::string man = manual("man"), bash = manual("bash"), zsh = manual("zsh");
  for (const char* option : {"output", "job", "set", "assume", "quiet", "version", "manual", "help"}) {
    INFO(option);
    CHECK(man.find(std::string("\\-\\-") + option) != std::string::npos);
    CHECK(bash.find(std::string(" --") + option) != std::string::npos);
    CHECK(zsh.find(std::string("--") + option + "[") != std::string::npos);
  }
  CHECK(man.find(".SH NAME\ndresslife\\-sample \\- makes samples\n") != std::string::npos);
  CHECK(man.find("\\fB\\-\\-assume\\fR \\fILINE=then|else\\fR\nhow a branch goes\n") != std::string::npos);
  CHECK(man.find("dresslife\\-sample input.h5 \\-o output.h5\n.EE\n") != std::string::npos);
  CHECK(zsh.find("'*--set[") != std::string::npos);            // may be repeated
  CHECK(zsh.find("'(--quiet)--quiet[") != std::string::npos);  // must not be repeated
  const Outcome unknown = run({"--manual", "fish"});
  CHECK(unknown.status == 2);
  CHECK(unknown.errors.find("fish not in {man,bash,zsh}") != std::string::npos);
}

TEST_CASE("stage: the user's mistakes end with 1, ours with 3, each in one line") {
  const Outcome users = run({"in.h5", "-o", "out.h5"}, [](const StageCall&) {
    throw InputError({"job.yaml", 2, 11}, "dresspack.length_m is -1.2 (must be > 0)", "give the length");
  });
  CHECK(users.status == 1);
  CHECK(users.errors == "job.yaml:2:11: error: dresspack.length_m is -1.2 (must be > 0); give the length\n");
  const Outcome ours = run({"in.h5", "-o", "out.h5"}, [](const StageCall&) { throw std::logic_error("axis not set"); });
  CHECK(ours.status == 3);
  CHECK(ours.errors == "dresslife-sample: error: internal fault (axis not set); please report it with the job\n");
  const Outcome memory = run({"in.h5", "-o", "out.h5"}, [](const StageCall&) { throw std::bad_alloc(); });
  CHECK(memory.status == 1);
  CHECK(memory.errors ==
        "dresslife-sample: error: out of memory; run fewer jobs at a time, ask for fewer segments or "
        "samples, or "
        "allow more, then run again\n");
  const Outcome disk = run({"in.h5", "-o", "out.h5"}, [](const StageCall&) {
    throw std::filesystem::filesystem_error("rename", "out.h5.part",
                                            std::make_error_code(std::errc::permission_denied));
  });
  CHECK(disk.status == 1);
  CHECK(disk.errors == "out.h5.part: error: Permission denied; check the folder and its permissions, then run again\n");
}

TEST_CASE("stage: an output that cannot be is refused before any work") {
  const Scratch scratch;
  const auto input = scratch.write("in.h5", "x");
  const Outcome folder = run({input, "-o", (scratch / ".").string()});
  CHECK(folder.status == 1);
  CHECK_FALSE(folder.ran);
  CHECK(folder.errors == (scratch / ".").string() +
                             ": error: is a folder (a result only replaces a plain file); name a file of its own\n");
  const Outcome same = run({input, "-o", input});
  CHECK(same.errors == input.string() + ": error: is one of the files that are read; name another place with -o\n");
  const std::string lost = (scratch / "none/out.h5").string();
  CHECK(run({input, "-o", lost}).errors ==
        lost + ": error: lies in a folder that does not exist; make " + (scratch / "none").string() + " first\n");
}

TEST_CASE("stage: the stamp names the job, the commands so far and the input's digest, not the output's place") {
  const Scratch scratch;
  const Job job = job_from(parse_yaml(sample_job, "job.yaml"));
  StageCall call;
  call.info = info;
  call.input = scratch.write("deep/in.h5", "abc");
  call.job_file = "some/where/j.yaml";
  call.sets = {"strain.gate=0.001"};
  call.output = scratch / "out.h5";
  write_stamped(scratch / "out.h5", call, job, "dresslife-sim 1: dresslife-sim job.yaml");
  const FileReader reader(scratch / "out.h5", small_format());
  CHECK(reader.text_attribute("job") == job_text(job));
  CHECK(reader.text_attribute("history") == std::string("dresslife-sim 1: dresslife-sim job.yaml\ndresslife-sample ") +
                                                pipeline::version() +
                                                ": dresslife-sample in.h5 --job j.yaml --set strain.gate=0.001");
  CHECK(reader.text_attribute("input_sha256") == sha256("abc"));
  write_stamped(scratch / "elsewhere.h5", call, job, "dresslife-sim 1: dresslife-sim job.yaml");
  CHECK(bytes_of(scratch / "elsewhere.h5") == bytes_of(scratch / "out.h5"));
}

TEST_CASE("stage: settings come from the input's job, from --job and --set, and must fit what was computed") {
  const Scratch scratch;
  const auto job_file = scratch.write("job.yaml", sample_job);
  StageCall call;
  call.info = info;
  call.input = job_file;
  write_stamped(scratch / "in.h5", call, read_job(job_file), "");
  const FileReader input(scratch / "in.h5", small_format());
  const std::vector<JobPart> before{JobPart::sim, JobPart::strain};

  StageCall later;
  later.info = info;
  CHECK(job_text(job_of(later, input, before)) == job_text(read_job(job_file)));
  later.sets = {"fatigue.stress=elastic"};
  CHECK(job_of(later, input, before).fatigue.stress == Stress::elastic);
  later.job_file = scratch.write("other.yaml", edited(sample_job, "listed_sites: 3", "listed_sites: 4"));
  later.sets = {};
  CHECK(job_of(later, input, before).fatigue.listed_sites == 4);

  later.job_file.clear();
  later.sets = {"simulation.segments=21"};
  CHECK(message_of([&] { job_of(later, input, before); }) ==
        (scratch / "in.h5").string() +
            ": error: was made with other settings of robot, motion, dresspack, routing or simulation than "
            "this job has; run the "
            "stage before again with the same --job and --set, then dresslife-sample");
  later.sets = {"strain.gate=0.01"};
  CHECK(message_of([&] {
          job_of(later, input, before);
        }).find("other settings of dresspack.components or strain than") != std::string::npos);
  CHECK(job_of(later, input, {JobPart::sim}).strain.gate == 0.01);
}

TEST_CASE("stage: the warnings of an output that is kept are printed again") {
  const Scratch scratch;
  const auto job = scratch.write("job.yaml", sample_job).string();
  const Warning warning{WarningKind::motion, "job.yaml", "the hose swings"};
  StageInfo sim = info;
  sim.input_is_job = true;
  sim.part = JobPart::sim;
  const auto motion = (scratch / "motion.h5").string(), note = (scratch / "sim.receipt").string();
  const auto run_sim = [&] {
    return run(
        {job, "-o", motion, "--receipt", note},
        [&](const StageCall& call) {
          write_still_motion(call.output, 2, 2,
                             [&](FileWriter& file) { file.attribute("warnings", warnings_text({warning})); });
        },
        sim);
  };
  const Outcome first = run_sim(), second = run_sim();
  CHECK(first.ran);
  CHECK(second.status == 0);
  CHECK_FALSE(second.ran);
  CHECK_THAT(second.errors, Catch::Contains("the hose swings"));
}

TEST_CASE(
    "stage: warnings of the input stand before a stage's own, and nothing is noted where the input does not say its own") {
  const Scratch scratch;
  const Warning swings{WarningKind::motion, "job.yaml", "the hose swings"},
      strained{WarningKind::strain, "", "wires yield"};
  const StageCall call{.info = info, .quiet = true};
  Progress progress("", true);
  const auto noted = [&](const char* name, const std::vector<Warning>& own, const FileReader* before) {
    write_still_motion(scratch / name, 2, 2,
                       [&](FileWriter& file) { note_warnings(file, call, progress, own, before); });
    return std::make_unique<FileReader>(scratch / name, motion_format());
  };
  Captured errors(STDERR_FILENO);
  const auto first = noted("first.h5", {swings}, nullptr), second = noted("second.h5", {strained}, first.get());
  CHECK(first->text_attribute("warnings") == warnings_text({swings}));
  CHECK(second->text_attribute("warnings") == warnings_text({swings, strained}));
  write_still_motion(scratch / "older.h5", 2, 2, [](FileWriter&) {});
  const FileReader older(scratch / "older.h5", motion_format());
  CHECK_FALSE(noted("third.h5", {strained}, &older)->has_attribute("warnings"));
}

TEST_CASE(
    "stage: an output with a receipt is made again when its settings, its input or itself changed, and else not") {
  const Scratch scratch;
  const auto job = scratch.write("job.yaml", sample_job).string(), note = (scratch / "note").string(),
             input = (scratch / "in.h5").string(), output = (scratch / "out.h5").string();
  const auto make = [](const std::filesystem::path& file, std::size_t segments) {
    write_still_motion(file, segments, 2, [](FileWriter& writer) { writer.attribute("warnings", ""); });
  };
  StageInfo stage = info;
  stage.part = JobPart::sim;
  const auto runs = [&](const std::string& set = "simulation.segments=20") {
    const Outcome of = run(
        {input, "-o", output, "--job", job, "--receipt", note, "--set", set},
        [&](const StageCall&) { make(output, 2); }, stage);
    CHECK(of.status == 0);
    return of.ran;
  };
  make(input, 2);
  CHECK(runs());
  CHECK_FALSE(runs());
  CHECK(runs("simulation.segments=21"));
  CHECK(runs());
  make(scratch / "other.h5", 3);
  std::filesystem::rename(scratch / "other.h5", input);
  CHECK(runs());
  make(output, 3);
  CHECK(runs());
  std::filesystem::remove(note);
  CHECK(runs());
  CHECK_FALSE(runs());
}

TEST_CASE(
    "stage: an input that changes meanwhile is refused, also one whose size and time stay, and another name of it is not") {
  const Scratch scratch;
  const auto job = scratch.write("job.yaml", sample_job), input = scratch / "in.h5";
  write_still_motion(input, 2, 2, [](FileWriter&) {});
  StageInfo stage = info;
  stage.part = JobPart::sim;
  const auto status = [&](const std::function<void()>& change) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));  // two ticks of the slowest clock of file times
    std::filesystem::remove(scratch / "note");
    return run(
               {input.string(), "-o", (scratch / "out.h5").string(), "--job", job.string(), "--receipt",
                (scratch / "note").string()},
               [&](const StageCall& call) {
                 write_still_motion(call.output, 2, 2, [](FileWriter&) {});
                 change();
               },
               stage)
        .status;
  };
  const auto rewrite = [&](const std::filesystem::path& file, const std::string& text) {
    const auto time = std::filesystem::last_write_time(file);
    scratch.write(file.filename().string(), text);
    std::filesystem::last_write_time(file, time);
  };
  CHECK(status([] {}) == 0);
  CHECK(status([&] { std::filesystem::create_hard_link(input, scratch / "second.h5"); }) == 0);
  CHECK(status([&] { rewrite(job, edited(sample_job, "listed_sites: 3", "listed_sites: 4")); }) == 1);
  std::string damaged = bytes_of(input);
  damaged.back() ^= 1;
  CHECK(status([&] { rewrite(input, damaged); }) == 1);
}

TEST_CASE("stage: what was printed and is lost is an error with its reason, also where a library printed it") {
  for (const auto& [device, expected] : {std::pair{"/dev/null", 0}, {"/dev/full", 1}}) {
    Captured errors(STDERR_FILENO);
    const pid_t child = ::fork();
    REQUIRE(child >= 0);
    if (child == 0) {
      ::dup2(::open(device, O_WRONLY), STDOUT_FILENO);
      std::setvbuf(stdout, nullptr, _IONBF, 0);  // the write fails at once, so no buffer remains to flush
      std::fputs("lost", stdout);
      ::_exit(finish_output(0));
    }
    int status = -1;
    ::waitpid(child, &status, 0);
    CHECK(WEXITSTATUS(status) == expected);
    CHECK(errors.text() == (expected == 0
                                ? ""
                                : "standard output: error: cannot be written (No space left on device); free space or "
                                  "name another place\n"));
  }
}

TEST_CASE("stage: progress stays off what is no terminal, notes do not unless quiet") {
  Captured errors(STDERR_FILENO);
  {
    Progress progress("dresslife-sample", false), quiet("dresslife-sample", true);
    progress.show(0.5);
    progress.show("words");
    progress.note("a note");
    quiet.note("not this");
  }
  CHECK(errors.text() == "a note\n");
}

}  // namespace
}  // namespace dresslife::pipeline
