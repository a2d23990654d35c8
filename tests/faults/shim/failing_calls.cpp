// Preloaded into a program: the FAULT_AT-th call of FAULT_CALL (write, sync, close, cut, rename) on a file
// that is being written (its name ends in .part) fails, as on a full or broken disk. At the end the number of
// such calls goes to the file FAULT_COUNT. Only in FAULT_PROGRAM: it may start others.
#include <dlfcn.h>
#include <sys/types.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

int calls = 0;

bool is_part(const char* path) {
  const std::size_t length = std::strlen(path);
  return length > 5 && std::strcmp(path + length - 5, ".part") == 0;
}

bool is_part(int descriptor) {
  char link[64], path[4096];
  std::snprintf(link, sizeof link, "/proc/self/fd/%d", descriptor);
  const ssize_t length = ::readlink(link, path, sizeof path - 1);
  if (length < 0) return false;
  path[length] = '\0';
  return is_part(path);
}

/// Whether this process runs the program that was named.
bool is_meant() {
  const char* const program = std::getenv("FAULT_PROGRAM");
  return program && std::strcmp(program, ::program_invocation_short_name) == 0;
}

template <class File>
bool fails(const char* call, File file) {
  const char* const chosen = std::getenv("FAULT_CALL");
  const char* const at = std::getenv("FAULT_AT");
  if (!chosen || std::strcmp(chosen, call) != 0 || !is_meant() || !is_part(file)) return false;
  if (++calls != (at ? std::atoi(at) : 0)) return false;
  errno = std::strcmp(call, "write") == 0 ? ENOSPC : EIO;
  return true;
}

template <class Function>
Function* real(const char* name) {
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

struct Count {
  ~Count() {
    const char* const name = std::getenv("FAULT_COUNT");
    std::FILE* const file = name && is_meant() ? std::fopen(name, "w") : nullptr;
    if (!file) return;
    std::fprintf(file, "%d\n", calls);
    std::fclose(file);
  }
} count;

}  // namespace

extern "C" {

ssize_t write(int descriptor, const void* bytes, size_t size) {
  static auto* const call = real<ssize_t(int, const void*, size_t)>("write");
  return fails("write", descriptor) ? -1 : call(descriptor, bytes, size);
}
ssize_t pwrite(int descriptor, const void* bytes, size_t size, off_t offset) {
  static auto* const call = real<ssize_t(int, const void*, size_t, off_t)>("pwrite");
  return fails("write", descriptor) ? -1 : call(descriptor, bytes, size, offset);
}
ssize_t pwrite64(int descriptor, const void* bytes, size_t size, off64_t offset) {
  static auto* const call = real<ssize_t(int, const void*, size_t, off64_t)>("pwrite64");
  return fails("write", descriptor) ? -1 : call(descriptor, bytes, size, offset);
}
int fsync(int descriptor) {
  static auto* const call = real<int(int)>("fsync");
  return fails("sync", descriptor) ? -1 : call(descriptor);
}
int close(int descriptor) {
  static auto* const call = real<int(int)>("close");
  const bool failing = fails("close", descriptor);
  const int status = call(descriptor);
  if (!failing) return status;
  errno = EIO;
  return -1;
}
int ftruncate(int descriptor, off_t length) {
  static auto* const call = real<int(int, off_t)>("ftruncate");
  return fails("cut", descriptor) ? -1 : call(descriptor, length);
}
int ftruncate64(int descriptor, off64_t length) {
  static auto* const call = real<int(int, off64_t)>("ftruncate64");
  return fails("cut", descriptor) ? -1 : call(descriptor, length);
}
int rename(const char* from, const char* to) {
  static auto* const call = real<int(const char*, const char*)>("rename");
  return fails("rename", from) ? -1 : call(from, to);
}
}
