#include "mesh/child_process.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace monocular_eye_hand {
namespace {

[[noreturn]] void fail(int error, const std::string& what) {
  throw std::system_error(error, std::generic_category(), what);
}

/// A file without a name in memory: unlike with pipes neither side ever waits for the other one, and a child
/// that dies early sends no SIGPIPE.
class MemoryFile {
 public:
  explicit MemoryFile(const char* name) : fd_(memfd_create(name, MFD_CLOEXEC)) {
    if (fd_ < 0) fail(errno, "memfd_create");
  }
  ~MemoryFile() { close(fd_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  int fd() const { return fd_; }

  void write(const std::string& bytes) {
    for (size_t at = 0; at < bytes.size();) {
      const ssize_t n = pwrite(fd_, bytes.data() + at, bytes.size() - at, off_t(at));
      if (n < 0 && errno != EINTR) fail(errno, "write");
      if (n > 0) at += size_t(n);
    }
  }

  std::string read() const {
    struct stat info;
    if (fstat(fd_, &info) != 0) fail(errno, "fstat");
    std::string bytes(size_t(info.st_size), '\0');
    for (size_t at = 0; at < bytes.size();) {
      const ssize_t n = pread(fd_, &bytes[at], bytes.size() - at, off_t(at));
      if (n == 0) break;
      if (n < 0 && errno != EINTR) fail(errno, "read");
      if (n > 0) at += size_t(n);
    }
    return bytes;
  }

 private:
  int fd_;
};

/// posix_spawn rather than fork: between fork and exec of a process with threads hardly any call is allowed,
/// and a large process takes long to copy.
class Spawn {
 public:
  Spawn(int input, int output) {
    posix_spawn_file_actions_init(&files_);
    posix_spawn_file_actions_adddup2(&files_, input, STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&files_, output, STDOUT_FILENO);

    // A signal that the caller ignores or blocks must still end a child that takes too long.
    sigset_t none, limits;
    sigemptyset(&none);
    sigemptyset(&limits);
    for (const int signal : {SIGALRM, SIGXCPU}) sigaddset(&limits, signal);
    posix_spawnattr_init(&attributes_);
    posix_spawnattr_setsigmask(&attributes_, &none);
    posix_spawnattr_setsigdefault(&attributes_, &limits);
    posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  }
  ~Spawn() {
    posix_spawnattr_destroy(&attributes_);
    posix_spawn_file_actions_destroy(&files_);
  }
  Spawn(const Spawn&) = delete;
  Spawn& operator=(const Spawn&) = delete;

  pid_t start(const std::string& program, const std::vector<std::string>& arguments) {
    std::vector<char*> words{const_cast<char*>(program.c_str())};
    for (const std::string& word : arguments) words.push_back(const_cast<char*>(word.c_str()));
    words.push_back(nullptr);
    pid_t child = 0;
    const int error = posix_spawn(&child, program.c_str(), &files_, &attributes_, words.data(), environ);
    if (error != 0) fail(error, program);
    return child;
  }

 private:
  posix_spawn_file_actions_t files_;
  posix_spawnattr_t attributes_;
};

}  // namespace

ChildResult runChild(const std::string& program, const std::vector<std::string>& arguments,
                     const std::string& input) {
  MemoryFile in("input"), out("output");
  in.write(input);
  const pid_t child = Spawn(in.fd(), out.fd()).start(program, arguments);

  ChildResult result;
  // Where SIGCHLD is ignored there is no status, and the output alone tells.
  while (waitpid(child, &result.status, 0) < 0 && errno == EINTR) {
  }
  result.output = out.read();
  return result;
}

std::string fileOf(const void* address) {
  Dl_info info;
  return dladdr(address, &info) != 0 && info.dli_fname ? info.dli_fname : "";
}

}  // namespace monocular_eye_hand
