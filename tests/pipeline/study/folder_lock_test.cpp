#include "pipeline/study/folder_lock.h"
#include "pipeline/base/plain_file.h"

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <memory>
#include <thread>

#include "pipeline/settings/document.h"
#include "tests/catch.h"
#include "tests/pipeline/scratch.h"

namespace dresslife::pipeline {

TEST_CASE("folder lock: reports every owner in equally many bytes, because a full disk has no room for more") {
  const Scratch scratch;
  const std::filesystem::path folder = scratch / "study";
  { const FolderLock alone(folder); }
  const std::string first = read_text(folder / ".lock");
  CHECK(std::stol(first) == ::getpid());
  { const FolderLock shard(folder, FolderLock::Mode::with_shards); }
  const std::string second = read_text(folder / ".lock");
  CHECK(second.find_first_not_of(" \n") == std::string::npos);  // one of several
  CHECK(second.size() == first.size());
}

TEST_CASE("folder lock: a run that lives excludes others by its number, and one that ended is waited for") {
  const Scratch scratch;
  const std::filesystem::path folder = scratch / "study";
  const auto refusal = [&](FolderLock::Mode mode) {
    return message_of([&] { const FolderLock beside(folder, mode); });
  };
  using enum FolderLock::Mode;
  const std::string remedy = "; wait for it, or choose another folder with -o";
  for (const auto& [held, owner] : {std::pair(alone, fmt::format("another run (process {})", ::getpid())),
                                    std::pair(with_shards, std::string("a run of some of its jobs (--shard)"))}) {
    const FolderLock first(folder, held);
    CHECK(refusal(alone) == folder.string() + ": error: is in use by " + owner + remedy);
    CHECK(refusal(with_shards).empty() == (held == with_shards));
  }
  // The number of a process that has ended: its stages end a moment later.
  const pid_t ended = ::fork();
  if (ended == 0) ::_exit(0);
  REQUIRE(::waitpid(ended, nullptr, 0) == ended);
  auto stage = std::make_unique<FolderLock>(folder);
  scratch.write("study/.lock", std::to_string(ended));
  std::thread end([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    stage.reset();
  });
  CHECK(refusal(alone).empty());
  end.join();
}

}  // namespace dresslife::pipeline
