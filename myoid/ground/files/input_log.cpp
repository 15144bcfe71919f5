#include "myoid/ground/files/input_log.h"

#include <fstream>
#include <mutex>
#include <set>
#include <string>
#include <utility>

namespace myoid::inline ground {
namespace {

using FileIdentity = std::pair<dev_t, ino_t>;

struct LoggedFiles {
  std::mutex mutex;
  int logs = 0;  ///< Objects that live.
  std::set<FileIdentity> inputs, own;
};

LoggedFiles& logged_files() {
  static LoggedFiles files;
  return files;
}

/// Adds the file behind a descriptor to a set, and takes it from the other.
void note_in(std::set<FileIdentity> LoggedFiles::*wanted, std::set<FileIdentity> LoggedFiles::*other, int descriptor) {
  LoggedFiles& files = logged_files();
  const std::scoped_lock lock(files.mutex);
  struct stat status {};
  if (files.logs == 0 || fstat(descriptor, &status) != 0 || !S_ISREG(status.st_mode)) return;
  const FileIdentity file{status.st_dev, status.st_ino};
  if (wanted == &LoggedFiles::inputs && files.own.contains(file)) return;
  (files.*wanted).insert(file);
  (files.*other).erase(file);
}

}  // namespace

InputLog::InputLog() {
  LoggedFiles& files = logged_files();
  const std::scoped_lock lock(files.mutex);
  ++files.logs;
}

InputLog::~InputLog() {
  LoggedFiles& files = logged_files();
  const std::scoped_lock lock(files.mutex);
  if (--files.logs > 0) return;
  files.inputs.clear();
  files.own.clear();
}

void note_input(int descriptor) { note_in(&LoggedFiles::inputs, &LoggedFiles::own, descriptor); }

void note_own_file(int descriptor) { note_in(&LoggedFiles::own, &LoggedFiles::inputs, descriptor); }

bool is_input(const struct stat& file) {
  LoggedFiles& files = logged_files();
  const std::scoped_lock lock(files.mutex);
  return files.inputs.contains({file.st_dev, file.st_ino});
}

bool is_input(const std::filesystem::path& path) {
  struct stat status {};
  return stat(path.c_str(), &status) == 0 && is_input(status);
}

bool begins_with(const std::filesystem::path& path, std::string_view bytes) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return false;
  std::ifstream file(path, std::ios::binary);
  std::string head(bytes.size(), '\0');
  return file.read(head.data(), static_cast<std::streamsize>(head.size())) && head == bytes;
}

}  // namespace myoid::inline ground
