#include "myoid/recording/atomic_file.h"

#include <cerrno>
#include <cstring>
#include <string>

#include <fcntl.h>
#include <fmt/format.h>
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
  std::string temporary = target.string() + ".XXXXXX";
  int descriptor = mkstemp(temporary.data());
  if (descriptor < 0 && (errno == ENOENT || errno == ENOTDIR) && target.has_parent_path()) {
    std::error_code error;
    std::filesystem::create_directories(target.parent_path(), error);
    if (error) {
      throw InvalidInput(fmt::format("{}: cannot create the folder {}: {}", path.string(),
                                     target.parent_path().string(), error.message()));
    }
    temporary = target.string() + ".XXXXXX";
    descriptor = mkstemp(temporary.data());
  }
  if (descriptor < 0) fail(path, "cannot be written", errno);
  int cause = write_all(descriptor, content);
  const mode_t permissions = exists ? existing.st_mode & 07777 : 0644;
  if (cause == 0 &&
      (fchmod(descriptor, permissions) != 0 || (flush == Flush::now && fsync(descriptor) != 0)))
    cause = errno;
  if (close(descriptor) != 0 && cause == 0) cause = errno;
  // Some file systems flush what replaces another file; what takes a free name, they do not.
  if (cause == 0 && exists && flush == Flush::later) unlink(target.c_str());
  if (cause == 0 && rename(temporary.c_str(), target.c_str()) == 0) return;
  if (cause == 0) cause = errno;
  unlink(temporary.c_str());
  fail(path, "writing failed", cause);
}

}  // namespace myoid::recording
