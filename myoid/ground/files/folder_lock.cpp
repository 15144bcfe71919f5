#include "myoid/ground/files/folder_lock.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <ctime>
#include <thread>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/ground/files/result_record.h"
#include "myoid/ground/files/text_file.h"

namespace myoid::inline ground {
namespace {

namespace fs = std::filesystem;

std::string this_host() {
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "unknown";
}

std::string now_utc() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  std::array<char, 32> text{};
  (void)std::strftime(text.data(), text.size(), "%Y-%m-%d %H:%M:%S", &parts);
  return text.data();
}

/// Reads the owner that `sign` wrote; empty for a file without one.
std::optional<FolderOwner> parse_owner(std::string_view text) {
  FolderOwner owner;
  for (const std::string_view line : split_lines(text)) {
    const std::size_t colon = line.find(": ");
    if (colon == std::string_view::npos) continue;
    const std::string_view key = line.substr(0, colon);
    const std::string_view value = line.substr(colon + 2);
    if (key == "process") owner.process = static_cast<long>(parse_number(value).value_or(0.0));
    if (key == "host") owner.host = value;
    if (key == "since") owner.since = value;
    if (key == "command") owner.command = value;
    if (key == "from_empty") owner.from_empty = value == "yes";
  }
  if (owner.process <= 0) return std::nullopt;
  return owner;
}

std::optional<FolderOwner> read_owner(int descriptor) {
  std::array<char, 65536> text{};
  const ssize_t size = pread(descriptor, text.data(), text.size(), 0);
  if (size <= 0) return std::nullopt;
  return parse_owner({text.data(), static_cast<std::size_t>(size)});
}

/// Waits for the owner of a file that another process holds: the owner locks the file an instant before it signs.
std::optional<FolderOwner> await_owner(int descriptor) {
  std::optional<FolderOwner> owner = read_owner(descriptor);
  for (int i = 0; i < 50 && !owner; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    owner = read_owner(descriptor);
  }
  return owner;
}

[[noreturn]] void refuse_folder(const fs::path& folder, const std::optional<FolderOwner>& owner) {
  throw InvalidInput("another myoid is writing into the folder {}{}; wait until it ends, or give another --out",
                     folder.string(), owner ? " (" + owner->sentence() + ")" : "");
}

/// Returns true if the owner is on another host or still runs; for file systems without locks.
bool may_live(const std::optional<FolderOwner>& owner) {
  if (!owner) return false;
  if (owner->host != this_host()) return true;
  return kill(static_cast<pid_t>(owner->process), 0) == 0 || errno == EPERM;
}

/// Returns true if the name still belongs to the open file: an owner that ends removes the file.
bool is_still(const fs::path& path, int descriptor) {
  struct stat opened {};
  struct stat named {};
  return fstat(descriptor, &opened) == 0 && stat(path.c_str(), &named) == 0 && opened.st_dev == named.st_dev &&
         opened.st_ino == named.st_ino;
}

}  // namespace

std::string FolderOwner::sentence() const {
  return fmt::format("process {} on '{}' since {} UTC: {}", process, host, since, command);
}

FolderLock::FolderLock(fs::path folder) : folder_(std::move(folder)) {
  const fs::path path = folder_ / kFile;
  constexpr int kTries = 100;  // each is lost to an owner that ends meanwhile
  for (int i = 0; i < kTries; ++i) {
    const int descriptor = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
    if (descriptor < 0) {
      throw InvalidInput("cannot write into the folder {}: {}", folder_.string(), std::strerror(errno));
    }
    const bool locked = flock(descriptor, LOCK_EX | LOCK_NB) == 0;
    const int cause = locked ? 0 : errno;
    const std::optional<FolderOwner> owner = cause == EWOULDBLOCK ? await_owner(descriptor) : read_owner(descriptor);
    if (cause == EWOULDBLOCK || (!locked && may_live(owner))) {
      close(descriptor);
      refuse_folder(folder_, owner);
    }
    if (is_still(path, descriptor)) {
      descriptor_ = descriptor;
      left_behind_ = owner;
      return;
    }
    close(descriptor);
  }
  refuse_folder(folder_, std::nullopt);
}

FolderLock::~FolderLock() {
  // The name goes first, so that no process locks a file that is about to vanish.
  const bool unfinished = from_empty_ && !finished_ && holds_content(folder_);
  if (!unfinished && (signed_ || !left_behind_)) unlink((folder_ / kFile).c_str());
  close(descriptor_);
}

void FolderLock::sign(std::string_view command, bool from_empty) {
  std::string line(command.substr(0, 4096));
  std::replace(line.begin(), line.end(), '\n', ' ');
  const std::string text = fmt::format("process: {}\nhost: {}\nsince: {}\ncommand: {}\nfrom_empty: {}\n", getpid(),
                                       this_host(), now_utc(), line, from_empty ? "yes" : "no");
  signed_ = true;
  from_empty_ = from_empty;
  if (ftruncate(descriptor_, 0) != 0 ||
      pwrite(descriptor_, text.data(), text.size(), 0) != static_cast<ssize_t>(text.size()))
    throw InvalidInput("cannot write into the folder {}: {}", folder_.string(), std::strerror(errno));
}

bool holds_content(const fs::path& folder, std::string_view unless_only) {
  std::error_code ignored;
  const auto counts = [&](const fs::directory_entry& entry) {
    const fs::path name = entry.path().filename();
    return name != unless_only && name != FolderLock::kFile && name != kRecordFile && !is_temporary(name);
  };
  return std::any_of(fs::directory_iterator(folder, ignored), fs::directory_iterator(), counts);
}

}  // namespace myoid::inline ground
