#include "pipeline/study/stage_program.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <system_error>
#include <utility>

#include "pipeline/base/errors.h"
#include "pipeline/base/installation.h"
#include "pipeline/base/ownership.h"
#include "pipeline/base/whole_file.h"

namespace dresslife::pipeline {

int run_stage_program(const std::string& program, const std::vector<std::string>& arguments, StageWords said) {
  return run_stage_program(program, arguments, std::filesystem::path(said == StageWords::dropped ? "/dev/null" : ""));
}

int run_stage_program(const std::string& program, const std::vector<std::string>& arguments,
                      const std::filesystem::path& errors) {
  const std::string file = (program_folder() / program).string();
  std::vector<char*> words{const_cast<char*>(file.c_str())};
  for (const std::string& argument : arguments) words.push_back(const_cast<char*>(argument.c_str()));
  words.push_back(nullptr);
  constexpr int not_there = 127;
  std::fflush(nullptr);
  std::optional<SignalsHeld> until_it_is_noted(std::in_place);
  const pid_t parent = ::getpid(), child = ::fork();
  if (child < 0) throw std::system_error(errno, std::generic_category(), "fork");
  if (child == 0) {
    release_signals();
    ::prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (const int there = errors.empty() ? -1 : ::open(errors.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600); there >= 0)
      ::dup2(there, STDERR_FILENO);
    if (::getppid() == parent) ::execv(file.c_str(), words.data());
    ::_exit(not_there);
  }
  const EndedAtTheEnd ended_at_the_end(child);
  until_it_is_noted.reset();
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) != not_there) return WEXITSTATUS(status);
  throw InputError({file},
                   WIFSIGNALED(status) ? fmt::format("was killed by signal {}", WTERMSIG(status)) : "cannot be started",
                   "install dresslife's programs into one folder, and look for what kills them");
}

PassingFile::PassingFile(const std::string& name) {
  const char* const wanted = std::getenv("TMPDIR");
  const std::filesystem::path folder = wanted && *wanted ? wanted : "/tmp";
  std::string own = (folder / "dresslife-XXXXXX").string();
  const SignalsHeld until_it_is_noted;
  if (!::mkdtemp(own.data()))
    throw MachineFault({folder.string()}, fmt::format("takes no temporary folder ({})", std::strerror(errno)),
                       "make room there, or set TMPDIR to a folder that may be written");
  file_ = std::filesystem::path(own) / name;
  folder_at_the_end_.emplace(own);
  file_at_the_end_.emplace(file_);
}

PassingFile::~PassingFile() { remove_temporary(file_.parent_path()); }

}  // namespace dresslife::pipeline
