#include "myoid/recording/atomic_file.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "myoid/core/error.h"

namespace myoid::recording {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, std::string_view what, int cause) {
  throw InvalidInput(
      fmt::format("{}: {}: {}{}", path.string(), what, std::strerror(cause),
                  cause == ENOSPC ? "; free some space or choose another folder" : ""));
}

constexpr std::string_view kMark = ".myoid-part.";
constexpr std::string_view kRandom = "XXXXXX";  ///< For mkstemp.

/// The pattern of the temporary file beside a target. A name that is as long as the system allows
/// is cut, so that the pattern fits too.
std::string temporary_pattern(const std::filesystem::path& target) {
  constexpr std::size_t kLongest = 200;
  const std::string name = "." + target.filename().string().substr(0, kLongest) +
                           std::string(kMark) + std::string(kRandom);
  return (target.parent_path() / name).string();
}

/// An open temporary file, locked so that no other process sweeps it away; -1 with errno.
int open_temporary(const std::filesystem::path& target, std::string& name) {
  for (;;) {
    name = temporary_pattern(target);
    const int descriptor = mkostemp(name.data(), O_CLOEXEC);
    if (descriptor < 0) return -1;
    struct stat status {};
    const bool swept = (flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) ||
                       (fstat(descriptor, &status) == 0 && status.st_nlink == 0);
    if (!swept) return descriptor;
    close(descriptor);
  }
}

/// 0, or what went wrong.
int write_all(int descriptor, std::string_view content) {
  for (std::size_t done = 0; done < content.size();) {
    const ssize_t written = write(descriptor, content.data() + done, content.size() - done);
    if (written < 0 && errno != EINTR) return errno;
    if (written > 0) done += static_cast<std::size_t>(written);
  }
  return 0;
}

/// Where a chain of symbolic links ends, whether a file is there or not.
std::filesystem::path behind_links(std::filesystem::path path) {
  std::error_code ignored;
  for (int links = 0; links < 40 && std::filesystem::is_symlink(path, ignored); ++links) {
    const std::filesystem::path next = std::filesystem::read_symlink(path, ignored);
    if (ignored) break;
    path = path.parent_path() / next;
  }
  return path;
}

void write_through(const std::filesystem::path& path, std::string_view content) {
  const int descriptor = open(path.c_str(), O_WRONLY | O_CLOEXEC);
  if (descriptor < 0) fail(path, "cannot be written", errno);
  const int cause = write_all(descriptor, content);
  const int at_end = close(descriptor) != 0 ? errno : 0;
  if (cause != 0 || at_end != 0) fail(path, "writing failed", cause != 0 ? cause : at_end);
}

}  // namespace

void write_file(const std::filesystem::path& path, std::string_view content, Flush flush) {
  if (path.empty()) throw InvalidInput("the name of the file to write is empty");
  // What neither exists nor is a link is where it says.
  struct stat existing {};
  bool exists = lstat(path.c_str(), &existing) == 0;
  const bool is_link = exists && S_ISLNK(existing.st_mode);
  if (is_link) exists = stat(path.c_str(), &existing) == 0;
  if (exists && S_ISDIR(existing.st_mode)) {
    throw InvalidInput(fmt::format("{}: is a folder; name a file in it", path.string()));
  }
  if (exists && !S_ISREG(existing.st_mode)) return write_through(path, content);

  const std::filesystem::path target = is_link ? behind_links(path) : path;
  std::string temporary;
  int descriptor = open_temporary(target, temporary);
  if (descriptor < 0 && (errno == ENOENT || errno == ENOTDIR) && target.has_parent_path()) {
    std::error_code error;
    std::filesystem::create_directories(target.parent_path(), error);
    if (error) {
      throw InvalidInput(fmt::format("{}: cannot create the folder {}: {}", path.string(),
                                     target.parent_path().string(), error.message()));
    }
    descriptor = open_temporary(target, temporary);
  }
  if (descriptor < 0) fail(path, "cannot be written", errno);
  int cause = write_all(descriptor, content);
  const mode_t permissions = exists ? existing.st_mode & 07777 : 0644;
  if (cause == 0 &&
      (fchmod(descriptor, permissions) != 0 || (flush == Flush::now && fsync(descriptor) != 0)))
    cause = errno;
  // A close tells of what the disk refused late; the lock stays with the other descriptor.
  if (close(dup(descriptor)) != 0 && cause == 0) cause = errno;
  // Some file systems flush what replaces another file; what takes a free name, they do not.
  if (cause == 0 && exists && flush == Flush::later) unlink(target.c_str());
  if (cause == 0 && rename(temporary.c_str(), target.c_str()) != 0) cause = errno;
  if (cause != 0) unlink(temporary.c_str());
  close(descriptor);
  if (cause != 0) fail(path, "writing failed", cause);
}

bool is_temporary(const std::filesystem::path& name) {
  const std::string file = name.filename().string();
  return file.size() > 1 + kMark.size() + kRandom.size() && file[0] == '.' &&
         file.compare(file.size() - kRandom.size() - kMark.size(), kMark.size(), kMark) == 0;
}

std::size_t sweep_temporaries(const std::filesystem::path& folder) {
  namespace fs = std::filesystem;
  constexpr int kDeepest = 3;  // person, trial, figures: results lie no deeper
  std::error_code error;
  std::vector<fs::path> found;
  for (auto it = fs::recursive_directory_iterator(
           folder, fs::directory_options::skip_permission_denied, error);
       !error && it != fs::recursive_directory_iterator(); it.increment(error)) {
    if (it.depth() >= kDeepest) it.disable_recursion_pending();
    if (is_temporary(it->path()) && it->symlink_status(error).type() == fs::file_type::regular)
      found.push_back(it->path());
  }
  return static_cast<std::size_t>(
      std::count_if(found.begin(), found.end(), [](const fs::path& file) {
        const int descriptor = open(file.c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW);
        if (descriptor < 0) return false;
        const bool dead = flock(descriptor, LOCK_EX | LOCK_NB) == 0;
        const bool removed = dead && unlink(file.c_str()) == 0;
        close(descriptor);
        return removed;
      }));
}

}  // namespace myoid::recording
