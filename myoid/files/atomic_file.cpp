#include "myoid/files/atomic_file.h"

#include <algorithm>
#include <string>
#include <vector>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include "myoid/files/file_in_parts.h"

namespace myoid::recording {

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

}  // namespace myoid::recording
