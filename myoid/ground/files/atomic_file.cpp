#include "myoid/ground/files/atomic_file.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/input_log.h"
#include "myoid/ground/files/result_record.h"

namespace myoid::inline ground {
namespace {

/// Returns the pattern of the temporary file beside a target. A name at the system's limit is cut,
/// so that the pattern fits.
std::string temporary_pattern(const std::filesystem::path& target) {
  constexpr std::size_t kLongest = 200;
  const std::string name = "." + target.filename().string().substr(0, kLongest) + std::string(kTemporaryMark) +
                           std::string(kTemporaryRandom);
  return (target.parent_path() / name).string();
}

/// Opens a temporary file and locks it, so that no other process sweeps it away; returns -1 with errno on failure.
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

/// Returns 0, or the error number.
int write_all(int descriptor, std::string_view content) {
  for (std::size_t done = 0; done < content.size();) {
    const ssize_t written = write(descriptor, content.data() + done, content.size() - done);
    if (written < 0 && errno != EINTR) return errno;
    if (written > 0) done += static_cast<std::size_t>(written);
  }
  return 0;
}

/// Returns the permissions of a new file: those that the process's umask leaves of rw-rw-rw-. The umask is read from
/// the system's record, because the call that returns the umask also sets it, for every thread.
unsigned new_permissions() {
  unsigned umask = 022;
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> status(std::fopen("/proc/self/status", "re"), &std::fclose);
  char line[256];
  while (status && std::fgets(line, sizeof line, status.get()) != nullptr)
    if (std::sscanf(line, "Umask: %o", &umask) == 1) break;
  return 0666U & ~umask;
}

/// Follows a chain of symbolic links to its end, whether a file is there or not.
std::filesystem::path behind_links(std::filesystem::path path) {
  std::error_code ignored;
  for (int links = 0; links < 40 && std::filesystem::is_symlink(path, ignored); ++links) {
    const std::filesystem::path next = std::filesystem::read_symlink(path, ignored);
    if (ignored) break;
    path = path.parent_path() / next;
  }
  return path;
}

}  // namespace

FileInParts::FileInParts(std::filesystem::path path, Flush flush) : path_(std::move(path)), flush_(flush) {
  if (path_.empty()) throw InvalidInput("the name of the file to write is empty");
  make_way(path_);
  // A path that neither exists nor is a link is its own end.
  struct stat existing {};
  bool exists = lstat(path_.c_str(), &existing) == 0;
  const bool is_link = exists && S_ISLNK(existing.st_mode);
  if (is_link) exists = stat(path_.c_str(), &existing) == 0;
  if (exists && S_ISDIR(existing.st_mode)) {
    throw InvalidInput("{}: is a folder; name a file in it", path_.string());
  }
  if (exists && !S_ISREG(existing.st_mode)) {
    descriptor_ = open(path_.c_str(), O_WRONLY | O_CLOEXEC);
    if (descriptor_ < 0) fail("cannot be written", errno);
    return;
  }
  replaces_ = exists;
  permissions_ = exists ? existing.st_mode & 07777 : new_permissions();
  target_ = is_link ? behind_links(path_) : path_;
  descriptor_ = open_temporary(target_, temporary_);
  if (descriptor_ < 0 && (errno == ENOENT || errno == ENOTDIR) && target_.has_parent_path()) {
    std::error_code error;
    std::filesystem::create_directories(target_.parent_path(), error);
    if (error) {
      throw InvalidInput("{}: cannot create the folder {}: {}", path_.string(), target_.parent_path().string(),
                         error.message());
    }
    descriptor_ = open_temporary(target_, temporary_);
  }
  if (descriptor_ < 0) fail("cannot be written", errno);
}

FileInParts::~FileInParts() {
  if (descriptor_ < 0) return;
  close(descriptor_);
  if (!temporary_.empty()) unlink(temporary_.c_str());
}

void FileInParts::fail(std::string_view what, int cause) {
  throw InvalidInput("{}: {}: {}{}", path_.string(), what, std::strerror(cause),
                     cause == ENOSPC ? "; free some space or choose another folder" : "");
}

void FileInParts::append(std::string_view piece) {
  if (const int cause = write_all(descriptor_, piece); cause != 0) fail("writing failed", cause);
}

void FileInParts::finish() {
  const int descriptor = std::exchange(descriptor_, -1);
  int cause = 0;
  if (temporary_.empty()) {
    if (close(descriptor) != 0) fail("writing failed", errno);
    return;
  }
  try {
    record_file(path_, descriptor);
  } catch (...) {
    unlink(temporary_.c_str());
    close(descriptor);
    throw;
  }
  if (fchmod(descriptor, permissions_) != 0 || (flush_ == Flush::now && fsync(descriptor) != 0)) cause = errno;
  // A close reports late errors of the disk; the other descriptor keeps the lock.
  if (close(dup(descriptor)) != 0 && cause == 0) cause = errno;
  // Some file systems flush a file that replaces another, but not a file under a free name.
  if (cause == 0 && replaces_ && flush_ == Flush::later) unlink(target_.c_str());
  if (cause == 0 && rename(temporary_.c_str(), target_.c_str()) != 0) cause = errno;
  if (cause != 0) unlink(temporary_.c_str());
  if (cause == 0) note_own_file(descriptor);
  close(descriptor);
  if (cause != 0) fail("writing failed", cause);
}

void write_file(const std::filesystem::path& path, std::string_view content, Flush flush) {
  FileInParts file(path, flush);
  file.append(content);
  file.finish();
}

bool is_temporary(const std::filesystem::path& name) {
  const std::string file = name.filename().string();
  return file.size() > 1 + kTemporaryMark.size() + kTemporaryRandom.size() && file[0] == '.' &&
         file.compare(file.size() - kTemporaryRandom.size() - kTemporaryMark.size(), kTemporaryMark.size(),
                      kTemporaryMark) == 0;
}

std::size_t sweep_temporaries(const std::filesystem::path& folder) {
  namespace fs = std::filesystem;
  constexpr int kDeepest = 3;  // person, trial, figures: results are no deeper
  std::error_code error;
  std::vector<fs::path> found;
  for (auto it = fs::recursive_directory_iterator(folder, fs::directory_options::skip_permission_denied, error);
       !error && it != fs::recursive_directory_iterator(); it.increment(error)) {
    if (it.depth() >= kDeepest) it.disable_recursion_pending();
    if (is_temporary(it->path()) && it->symlink_status(error).type() == fs::file_type::regular)
      found.push_back(it->path());
  }
  return static_cast<std::size_t>(std::count_if(found.begin(), found.end(), [](const fs::path& file) {
    const int descriptor = open(file.c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW);
    if (descriptor < 0) return false;
    const bool dead = flock(descriptor, LOCK_EX | LOCK_NB) == 0;
    const bool removed = dead && unlink(file.c_str()) == 0;
    close(descriptor);
    return removed;
  }));
}

}  // namespace myoid::inline ground
