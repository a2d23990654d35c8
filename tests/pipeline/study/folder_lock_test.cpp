#include "pipeline/base/plain_file.h"
#include "pipeline/study/folder_lock.h"

#include <unistd.h>

#include "pipeline/settings/document.h"
#include "tests/catch.h"
#include "tests/pipeline/scratch.h"

namespace dresslife::pipeline {

TEST_CASE(
    "folder lock: tells its owner in as many bytes whoever it is, as a full disk has no room for more") {
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

}  // namespace dresslife::pipeline
