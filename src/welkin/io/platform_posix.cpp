// All that the library asks of a POSIX system: files, memory, signals, streams.
// It is over 400 lines because this is the one file with code for one kind of system.
#include <fcntl.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>
#include <cerrno>
#include <climits>
#include <cstdio>
#include <cstring>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "welkin/base/error.h"
#include "welkin/io/output_file.h"
#include "welkin/io/process.h"

namespace welkin::io {
namespace {

namespace fs = std::filesystem;

static_assert(sizeof(off_t) == 8, "files over 2 GiB need 64-bit offsets");

/// A pipe has no length, so one that never ends is refused here.
constexpr std::size_t kLongestPipe = std::size_t{8} << 30;

/// A standard stream that was taken as a file.
struct TakenStream {
  fs::path name;
  int descriptor = -1;  ///< none: it was not taken

  bool is(const fs::path& path) const { return descriptor >= 0 && path == name; }
};
TakenStream taken_input, taken_output;

std::string reason(int error) {
  return std::generic_category().message(error);
}

ErrorKind kind_of(int error) {
  switch (error) {
    case ENOENT:
    case ENOTDIR:
      return ErrorKind::not_found;
    case EACCES:
    case EPERM:
    case EROFS:
      return ErrorKind::denied;
    case EISDIR:
      return ErrorKind::bad_request;
    default:
      return ErrorKind::system;
  }
}

[[noreturn]] void fail() {
  throw Error(kind_of(errno), reason(errno));
}

/// Another descriptor of the same open file, none of the standard streams'.
int duplicate(int descriptor) {
  return ::fcntl(descriptor, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
}

class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() { close_now(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int number() const { return number_; }
  /// False with errno when the system reports a late write error.
  bool close_now() { return number_ < 0 || ::close(std::exchange(number_, -1)) == 0; }

 private:
  int number_;
};

void write_fully(int descriptor, const std::byte* data, std::size_t size) {
  while (size > 0) {
    const ssize_t written = ::write(descriptor, data, size);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail();
    data += written;
    size -= static_cast<std::size_t>(written);
  }
}

// The names of unfinished outputs, where a signal handler can read them: no lock, no allocation. A slot goes
// free → filling → active → free; the handler looks at active ones only.

enum SlotState : int { kFree, kFilling, kActive };

struct Slot {
  std::atomic<int> state{kFree};
  pid_t process = 0;
  char path[PATH_MAX] = {};
};
static_assert(std::atomic<int>::is_always_lock_free);

std::array<Slot, 256> unfinished;

/// Registers a temporary file for as long as it lives.
class Registration {
 public:
  explicit Registration(const std::string& path) {
    if (path.size() >= PATH_MAX) throw Error(kind_of(ENAMETOOLONG), reason(ENAMETOOLONG));
    for (Slot& slot : unfinished) {
      int expected = kFree;
      if (!slot.state.compare_exchange_strong(expected, kFilling)) continue;
      std::memcpy(slot.path, path.c_str(), path.size() + 1);
      slot.process = ::getpid();
      slot.state.store(kActive);
      slot_ = &slot;
      return;
    }
    throw Error(ErrorKind::system,
                "more than " + std::to_string(unfinished.size()) + " files are being written at once");
  }
  ~Registration() { slot_->state.store(kFree); }
  Registration(const Registration&) = delete;
  Registration& operator=(const Registration&) = delete;

 private:
  Slot* slot_ = nullptr;
};

/// Where the bytes must finally go: the path with symbolic links followed, even one whose target does not
/// exist yet.
fs::path follow_links(fs::path path) {
  constexpr int kMaxLinks = 40;
  for (int i = 0; i < kMaxLinks; ++i) {
    std::error_code error;
    if (!fs::is_symlink(fs::symlink_status(path, error))) return path;
    const fs::path target = fs::read_symlink(path, error);
    if (error) throw Error(ErrorKind::system, error.message());
    path = target.is_absolute() ? target : path.parent_path() / target;
  }
  throw Error(kind_of(ELOOP), reason(ELOOP));
}

/// A unique name beside `target`: hidden, with the process's number and a count.
fs::path temporary_name(const fs::path& target) {
  static std::atomic<unsigned> count{0};
  constexpr std::size_t kMaxNameLength = 200;
  std::string name = ".";
  name += target.filename().string().substr(0, kMaxNameLength);
  name += '.';
  name += std::to_string(::getpid()) + "-" + std::to_string(count++) + ".tmp";
  return target.parent_path() / name;
}

/// A file without a name, gone when it is closed.
int open_spool() {
  std::string name = (fs::temp_directory_path() / "welkin-XXXXXX").string();
  const int descriptor = ::mkstemp(name.data());
  if (descriptor < 0) fail();
  ::unlink(name.c_str());
  return descriptor;
}

}  // namespace

/// A regular target is written beside itself and renamed. A device or a pipe cannot be replaced, so its bytes
/// are spooled, which lets every format seek, and copied to it by `commit`.
struct OutputFile::State {
  fs::path target;
  fs::path temporary;  ///< empty for a spool
  std::unique_ptr<Registration> registration;
  std::unique_ptr<Descriptor> file;
  std::uint64_t position = 0;
  std::uint64_t size = 0;

  bool spooled() const { return temporary.empty(); }
  void discard() {
    if (spooled() || registration == nullptr) return;
    ::unlink(temporary.c_str());
    registration.reset();
  }
};

OutputFile::OutputFile(const fs::path& path) : state_(std::make_unique<State>()) {
  State& state = *state_;
  if (path.empty()) throw Error(kind_of(ENOENT), reason(ENOENT));
  struct stat old {};
  const bool exists = !taken_output.is(path) && ::stat(path.c_str(), &old) == 0;
  if (!exists && !taken_output.is(path) && errno != ENOENT) fail();
  if (exists && S_ISDIR(old.st_mode)) throw Error(kind_of(EISDIR), reason(EISDIR));
  if (exists && ::access(path.c_str(), W_OK) != 0) fail();
  const std::string text = path.lexically_normal().string();
  const bool kernel_file =
      (text.starts_with("/dev/") && !text.starts_with("/dev/shm/")) || text.starts_with("/proc/");
  if (taken_output.is(path) || (exists && (!S_ISREG(old.st_mode) || kernel_file))) {
    state.target = path;
    state.file = std::make_unique<Descriptor>(open_spool());
    return;
  }
  state.target = follow_links(path);
  // A crashed process may have left a file of the very same number and count: take the next name.
  constexpr int kMaxAttempts = 100;
  for (int attempt = 0; state.file == nullptr; ++attempt) {
    state.temporary = temporary_name(state.target);
    state.registration = std::make_unique<Registration>(state.temporary.string());
    const int descriptor = ::open(state.temporary.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor >= 0) {
      state.file = std::make_unique<Descriptor>(descriptor);
    } else if (errno != EEXIST || attempt == kMaxAttempts) {
      fail();
    }
    if (descriptor < 0) state.registration.reset();
  }
  if (exists && ::fchmod(state.file->number(), old.st_mode & 0777) != 0) {
    const int error = errno;
    state.discard();
    throw Error(kind_of(error), reason(error));
  }
}

OutputFile::~OutputFile() {
  state_->discard();
}

void OutputFile::write(std::span<const std::byte> data) {
  State& state = *state_;
  const std::byte* bytes = data.data();
  std::size_t size = data.size();
  while (size > 0) {
    const ssize_t written = ::pwrite(state.file->number(), bytes, size, static_cast<off_t>(state.position));
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail();
    bytes += written;
    size -= static_cast<std::size_t>(written);
    state.position += static_cast<std::uint64_t>(written);
    state.size = std::max(state.size, state.position);
  }
}

std::size_t OutputFile::read_at(std::uint64_t offset, void* data, std::size_t size) {
  auto* bytes = static_cast<char*>(data);
  std::size_t done = 0;
  while (done < size) {
    const ssize_t got =
        ::pread(state_->file->number(), bytes + done, size - done, static_cast<off_t>(offset + done));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail();
    if (got == 0) break;
    done += static_cast<std::size_t>(got);
  }
  return done;
}

void OutputFile::seek(std::uint64_t offset) {
  state_->position = offset;
}
std::uint64_t OutputFile::tell() const {
  return state_->position;
}
std::uint64_t OutputFile::size() const {
  return state_->size;
}

void OutputFile::commit() {
  State& state = *state_;
  require(state.file->number() >= 0, "an output file is committed once");
  if (state.spooled()) {
    Descriptor target(taken_output.is(state.target) ? duplicate(taken_output.descriptor)
                                                    : ::open(state.target.c_str(), O_WRONLY | O_CLOEXEC));
    if (target.number() < 0) fail();
    std::vector<std::byte> block(std::size_t{1} << 20);
    for (std::uint64_t at = 0; at < state.size;) {
      const std::size_t got = read_at(at, block.data(), block.size());
      if (got == 0) throw Error(ErrorKind::system, "the spooled bytes have vanished");
      write_fully(target.number(), block.data(), got);
      at += got;
    }
    if (!target.close_now()) fail();
    state.file->close_now();
    return;
  }
  if (!state.file->close_now()) fail();
  if (::rename(state.temporary.c_str(), state.target.c_str()) != 0) fail();
  state.registration.reset();
}

InputFile::InputFile(const fs::path& path) {
  const auto fail_named = [&] { throw Error(kind_of(errno), path.string(), reason(errno)); };
  const bool taken = taken_input.is(path);
  Descriptor file(taken ? duplicate(taken_input.descriptor) : ::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  struct stat status {};
  if (file.number() < 0 || ::fstat(file.number(), &status) != 0) fail_named();
  if (S_ISDIR(status.st_mode)) throw Error(kind_of(EISDIR), path.string(), reason(EISDIR));

  const auto map = [&](std::size_t size, int protection, int flags, int descriptor) {
    void* address = ::mmap(nullptr, size, protection, flags, descriptor, 0);
    if (address == MAP_FAILED) fail_named();
    bytes_ = {static_cast<const std::byte*>(address), size};
    return address;
  };
  const bool from_the_start = !taken || ::lseek(file.number(), 0, SEEK_CUR) == 0;
  if (S_ISREG(status.st_mode) && status.st_size > 0 && from_the_start) {
    map(static_cast<std::size_t>(status.st_size), PROT_READ, MAP_PRIVATE, file.number());
    return;
  }
  // A pipe, a device, or a file of /proc, whose length says 0: read it to its end.
  std::vector<std::byte> read;
  for (;;) {
    constexpr std::size_t kBlock = std::size_t{1} << 20;
    const std::size_t before = read.size();
    if (before > kLongestPipe) throw Error(ErrorKind::too_large, path.string(), "does not end within 8 GiB");
    read.resize(before + kBlock);
    const ssize_t got = ::read(file.number(), read.data() + before, kBlock);
    if (got < 0 && errno != EINTR) fail_named();
    read.resize(before + (got > 0 ? static_cast<std::size_t>(got) : 0));
    if (got == 0) break;
  }
  if (read.empty()) return;
  void* address = map(read.size(), PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1);
  std::memcpy(address, read.data(), read.size());
}

InputFile::~InputFile() {
  if (!bytes_.empty()) ::munmap(const_cast<std::byte*>(bytes_.data()), bytes_.size());
}

void remove_unfinished_outputs() noexcept {
  const int saved = errno;
  const pid_t process = ::getpid();
  for (Slot& slot : unfinished) {
    if (slot.state.load() == kActive && slot.process == process) ::unlink(slot.path);
  }
  errno = saved;
}

bool standard_error_is_terminal() {
  return isatty(STDERR_FILENO) != 0;
}

bool standard_output_is_terminal() {
  return isatty(STDOUT_FILENO) != 0;
}

fs::path take_standard_input() {
  taken_input = {"standard input", STDIN_FILENO};
  return taken_input.name;
}

fs::path take_standard_output(std::string_view extension) {
  require(taken_output.descriptor < 0, "standard output is taken once");
  std::fflush(stdout);
  const int descriptor = duplicate(STDOUT_FILENO);
  if (descriptor < 0 || ::dup2(STDERR_FILENO, STDOUT_FILENO) < 0) fail();
  taken_output = {"standard output." + std::string(extension), descriptor};
  return taken_output.name;
}

std::size_t read_standard_input(std::span<std::byte> bytes) {
  std::size_t had = 0;
  while (had < bytes.size()) {
    const ssize_t count = ::read(STDIN_FILENO, bytes.data() + had, bytes.size() - had);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail();
    if (count == 0) break;
    had += static_cast<std::size_t>(count);
  }
  return had;
}

void write_standard_output(std::span<const std::byte> bytes) {
  static const int descriptor = [] {
    ::signal(SIGPIPE, SIG_IGN);  // it is an error of writing instead
    std::fflush(stdout);
    const int taken = duplicate(STDOUT_FILENO);
    if (taken < 0 || ::dup2(STDERR_FILENO, STDOUT_FILENO) < 0) fail();
    return taken;
  }();
  while (!bytes.empty()) {
    const ssize_t count = ::write(descriptor, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0 && errno == EPIPE)
      throw Error(ErrorKind::system, "the program that reads the stream has closed it");
    if (count < 0) fail();
    bytes = bytes.subspan(static_cast<std::size_t>(count));
  }
}

void hold_standard_streams() {
  for (int descriptor = STDIN_FILENO; descriptor <= STDERR_FILENO; ++descriptor) {
    // The lowest free number is taken: the closed one's, as those below are open by now.
    if (fcntl(descriptor, F_GETFD) < 0) ::open("/dev/null", descriptor == STDIN_FILENO ? O_WRONLY : O_RDONLY);
  }
}

void remove_outputs_on_signals() {
  ::signal(SIGXFSZ, SIG_IGN);
  struct sigaction action {};
  action.sa_handler = [](int signal) {
    remove_unfinished_outputs();
    _exit(128 + signal);
  };
  for (const int each : {SIGINT, SIGTERM, SIGHUP}) {
    // A signal that the caller ignores (nohup) stays ignored.
    struct sigaction before {};
    sigaction(each, nullptr, &before);
    if (before.sa_handler != SIG_IGN) sigaction(each, &action, nullptr);
  }
}

}  // namespace welkin::io
