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

void write_file(const std::filesystem::path& path, std::string_view content) {
  const auto fail = [&](std::string_view what) {
    const int cause = errno;
    throw InvalidInput(
        fmt::format("{}: {}: {}{}", path.string(), what, std::strerror(cause),
                    cause == ENOSPC ? "; free some space or choose another folder" : ""));
  };
  std::error_code error;
  if (path.has_parent_path()) {
    std::filesystem::create_directories(path.parent_path(), error);
    if (error) {
      throw InvalidInput(fmt::format("{}: cannot create the folder {}: {}", path.string(),
                                     path.parent_path().string(), error.message()));
    }
  }
  std::string temporary = path.string() + ".XXXXXX";
  const int descriptor = mkstemp(temporary.data());
  if (descriptor < 0) fail("cannot be written");
  const auto give_up = [&](std::string_view what) {
    const int cause = errno;
    close(descriptor);
    unlink(temporary.c_str());
    errno = cause;
    fail(what);
  };
  for (std::size_t done = 0; done < content.size();) {
    const ssize_t written = write(descriptor, content.data() + done, content.size() - done);
    if (written < 0) {
      if (errno == EINTR) continue;
      give_up("writing failed");
    }
    done += static_cast<std::size_t>(written);
  }
  if (fchmod(descriptor, 0644) != 0 || fsync(descriptor) != 0) give_up("writing failed");
  if (close(descriptor) != 0) fail("writing failed");
  if (rename(temporary.c_str(), path.c_str()) != 0) {
    const int cause = errno;
    unlink(temporary.c_str());
    errno = cause;
    fail("cannot be replaced");
  }
}

}  // namespace myoid::recording
