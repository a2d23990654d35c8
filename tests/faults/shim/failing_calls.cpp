// A library that is preloaded into a program: some of the program's calls fail, as on a full or broken disk, on a file system
// without some feature, or without memory.
//
//   FAULT_PROGRAM  name of the program with faults; programs that it starts have none
//   FAULT_CALL     write, sync, close, cut, rename: of files that are being written (their names end in .part)
//                  read, look, open, list, lock, make, remove, link: of any file whose path holds FAULT_PATH
//                  allocate: any allocation
//   FAULT_AT       number of the first call that fails, from 1; 0: none
//   FAULT_MORE     how many further calls fail; "all"
//   FAULT_MODE     an error (EIO, ENOSPC, ENOTSUP ...); of a read or write: short (half of it); of a read: end (as
//                  at the end of the file), flip (one bit turned); without it ENOSPC of a write, EIO of others
//   FAULT_COUNT    a file for the number of matching calls, written at the end
#include <dirent.h>
#include <dlfcn.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>

extern "C" {
void* __libc_malloc(size_t);
void* __libc_calloc(size_t, size_t);
void* __libc_realloc(void*, size_t);
void* __libc_memalign(size_t, size_t);
}

namespace {

struct Fault {
  bool is_meant = false;
  const char *call = "", *path = "", *mode = "";
  long first = 0, last = 0;
};
Fault fault;
std::atomic<long> calls{0};

const char* setting(const char* name) {
  const char* const value = std::getenv(name);
  return value ? value : "";
}

__attribute__((constructor(101))) void read_settings() {
  fault.call = setting("FAULT_CALL");
  fault.path = setting("FAULT_PATH");
  fault.mode = setting("FAULT_MODE");
  fault.first = std::atol(setting("FAULT_AT"));
  const char* const more = setting("FAULT_MORE");
  fault.last = std::strcmp(more, "all") == 0 ? 1L << 40 : fault.first + std::atol(more);
  fault.is_meant = std::strcmp(setting("FAULT_PROGRAM"), ::program_invocation_short_name) == 0;
}

__attribute__((destructor)) void write_count() {
  const char* const name = setting("FAULT_COUNT");
  if (!fault.is_meant || *name == '\0') return;
  fault.is_meant = false;
  if (std::FILE* const file = std::fopen(name, "w")) {
    std::fprintf(file, "%ld\n", calls.load());
    std::fclose(file);
  }
}

int error_of(const char* call) {
  struct Named {
    const char* name;
    int error;
  };
  constexpr Named named[]{{"EIO", EIO},         {"ENOSPC", ENOSPC}, {"EDQUOT", EDQUOT}, {"EACCES", EACCES},
                          {"EMFILE", EMFILE},   {"EROFS", EROFS},   {"ESTALE", ESTALE}, {"EINTR", EINTR},
                          {"ENOTSUP", ENOTSUP}, {"ENOLCK", ENOLCK}, {"EPERM", EPERM},   {"ENOMEM", ENOMEM}};
  for (const Named& one : named)
    if (std::strcmp(fault.mode, one.name) == 0) return one.error;
  return std::strcmp(call, "write") == 0 ? ENOSPC : EIO;
}

bool is_meant(const char* call) { return fault.is_meant && std::strcmp(fault.call, call) == 0; }

bool counts() {
  const long number = ++calls;
  return fault.first > 0 && number >= fault.first && number <= fault.last;
}

bool is_part(const char* path) {
  const std::size_t length = std::strlen(path);
  return length > 5 && std::strcmp(path + length - 5, ".part") == 0;
}

/// Returns whether this call fails; then errno is set.
bool fails(const char* call, const char* path) {
  if (!is_meant(call) || !path) return false;
  const bool of_parts = std::strstr("write sync close cut rename", call) != nullptr;
  if (of_parts ? !is_part(path) : std::strstr(path, fault.path) == nullptr) return false;
  if (!counts()) return false;
  errno = error_of(call);
  return true;
}
bool fails(const char* call, int descriptor) {
  if (!is_meant(call)) return false;
  char link[64], path[4096];
  std::snprintf(link, sizeof link, "/proc/self/fd/%d", descriptor);
  const ssize_t length = ::readlink(link, path, sizeof path - 1);
  if (length < 0) return false;
  path[length] = '\0';
  return fails(call, path);
}
bool allocation_fails() {
  if (!is_meant("allocate") || !counts()) return false;
  errno = ENOMEM;
  return true;
}

bool has_mode(const char* mode) { return std::strcmp(fault.mode, mode) == 0; }

template <class Function>
Function* real(const char* name) {
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

template <class Read>
ssize_t read_or_fail(int descriptor, void* bytes, size_t size, const Read& read) {
  if (!fails("read", descriptor)) return read(size);
  if (has_mode("end")) return 0;
  if (has_mode("short")) return read(size > 1 ? size / 2 : size);
  if (!has_mode("flip")) return -1;
  const ssize_t got = read(size);
  if (got > 0) static_cast<char*>(bytes)[got / 2] ^= 4;
  return got;
}

template <class Write>
ssize_t write_or_fail(int descriptor, size_t size, const Write& write) {
  if (!fails("write", descriptor)) return write(size);
  return has_mode("short") ? write(size > 1 ? size / 2 : size) : -1;
}

}  // namespace

// A call of the C library with a replacement; `fail` is the return value of a failing call.
#define FAILING(kind, result, name, fail, file, parameters, ...) \
  result name parameters {                                       \
    static auto* const call = real<result parameters>(#name);    \
    return fails(kind, file) ? (fail) : call(__VA_ARGS__);       \
  }

extern "C" {

FAILING("sync", int, fsync, -1, d, (int d), d)
FAILING("cut", int, ftruncate, -1, d, (int d, off_t length), d, length)
FAILING("cut", int, ftruncate64, -1, d, (int d, off64_t length), d, length)
FAILING("rename", int, rename, -1, from, (const char* from, const char* to), from, to)
FAILING("link", int, link, -1, from, (const char* from, const char* to), from, to)
FAILING("remove", int, unlink, -1, path, (const char* path), path)
FAILING("remove", int, remove, -1, path, (const char* path), path)
FAILING("remove", int, unlinkat, -1, path, (int d, const char* path, int flags), d, path, flags)
FAILING("remove", int, rmdir, -1, path, (const char* path), path)
FAILING("make", int, mkdir, -1, path, (const char* path, mode_t mode), path, mode)
FAILING("make", char*, mkdtemp, nullptr, path, (char* path), path)
FAILING("lock", int, flock, -1, d, (int d, int operation), d, operation)
FAILING("list", DIR*, opendir, nullptr, path, (const char* path), path)
FAILING("list", struct dirent*, readdir, nullptr, ::dirfd(dir), (DIR * dir), dir)
FAILING("look", int, access, -1, path, (const char* path, int mode), path, mode)
FAILING("look", ssize_t, readlink, -1, path, (const char* path, char* link, size_t n), path, link, n)
FAILING("look", char*, realpath, nullptr, path, (const char* path, char* name), path, name)
FAILING("look", int, stat, -1, path, (const char* path, struct stat* s), path, s)
FAILING("look", int, stat64, -1, path, (const char* path, struct stat64* s), path, s)
FAILING("look", int, lstat, -1, path, (const char* path, struct stat* s), path, s)
FAILING("look", int, lstat64, -1, path, (const char* path, struct stat64* s), path, s)
FAILING("look", int, fstat, -1, d, (int d, struct stat* s), d, s)
FAILING("look", int, fstat64, -1, d, (int d, struct stat64* s), d, s)
FAILING("open", std::FILE*, fopen, nullptr, path, (const char* path, const char* mode), path, mode)
FAILING("open", std::FILE*, fopen64, nullptr, path, (const char* path, const char* mode), path, mode)

ssize_t write(int d, const void* bytes, size_t size) {
  static auto* const call = real<ssize_t(int, const void*, size_t)>("write");
  return write_or_fail(d, size, [&](size_t n) { return call(d, bytes, n); });
}
ssize_t pwrite(int d, const void* bytes, size_t size, off_t at) {
  static auto* const call = real<ssize_t(int, const void*, size_t, off_t)>("pwrite");
  return write_or_fail(d, size, [&](size_t n) { return call(d, bytes, n, at); });
}
ssize_t pwrite64(int d, const void* bytes, size_t size, off64_t at) {
  static auto* const call = real<ssize_t(int, const void*, size_t, off64_t)>("pwrite64");
  return write_or_fail(d, size, [&](size_t n) { return call(d, bytes, n, at); });
}

int close(int descriptor) {
  static auto* const call = real<int(int)>("close");
  const bool failing = fails("close", descriptor);
  const int status = call(descriptor);
  if (!failing) return status;
  errno = error_of("close");
  return -1;
}

ssize_t pread(int d, void* bytes, size_t size, off_t at) {
  static auto* const call = real<ssize_t(int, void*, size_t, off_t)>("pread");
  return read_or_fail(d, bytes, size, [&](size_t n) { return call(d, bytes, n, at); });
}
ssize_t pread64(int d, void* bytes, size_t size, off64_t at) {
  static auto* const call = real<ssize_t(int, void*, size_t, off64_t)>("pread64");
  return read_or_fail(d, bytes, size, [&](size_t n) { return call(d, bytes, n, at); });
}
ssize_t read(int d, void* bytes, size_t size) {
  static auto* const call = real<ssize_t(int, void*, size_t)>("read");
  return read_or_fail(d, bytes, size, [&](size_t n) { return call(d, bytes, n); });
}

#define FAILING_OPEN(name)                                                          \
  int name(const char* path, int flags, ...) {                                      \
    static auto* const call = real<int(const char*, int, mode_t)>(#name);           \
    va_list rest;                                                                   \
    va_start(rest, flags);                                                          \
    const auto mode = static_cast<mode_t>(flags & O_CREAT ? va_arg(rest, int) : 0); \
    va_end(rest);                                                                   \
    return fails("open", path) ? -1 : call(path, flags, mode);                      \
  }
FAILING_OPEN(open)
FAILING_OPEN(open64)

void* malloc(size_t n) { return allocation_fails() ? nullptr : __libc_malloc(n); }
void* calloc(size_t n, size_t each) { return allocation_fails() ? nullptr : __libc_calloc(n, each); }
void* realloc(void* old, size_t n) { return allocation_fails() ? nullptr : __libc_realloc(old, n); }
void* memalign(size_t to, size_t n) { return allocation_fails() ? nullptr : __libc_memalign(to, n); }
void* aligned_alloc(size_t to, size_t n) { return allocation_fails() ? nullptr : __libc_memalign(to, n); }
int posix_memalign(void** made, size_t to, size_t n) {
  if (allocation_fails()) return ENOMEM;
  *made = __libc_memalign(to, n);
  return *made ? 0 : ENOMEM;
}
}
