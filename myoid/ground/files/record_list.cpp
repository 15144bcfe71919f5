#include "myoid/ground/files/record_list.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <openssl/evp.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/text_file.h"

namespace myoid::inline ground {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kRecordHashDigits = 64;

std::string unescaped(std::string_view text) {
  std::string path;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '\\' || i + 1 == text.size()) {
      path += text[i];
      continue;
    }
    ++i;
    path += text[i] == 'n' ? '\n' : text[i] == 'r' ? '\r' : text[i];
  }
  return path;
}

/// Returns true for a path that stays in its folder.
bool stays_inside(const fs::path& path) {
  return !path.empty() && path.is_relative() &&
         std::ranges::none_of(path, [](const fs::path& part) { return part == ".." || part == "." || part.empty(); });
}

}  // namespace

std::optional<std::string> content_of(int descriptor) {
  struct stat status {};
  if (fstat(descriptor, &status) != 0) return std::nullopt;
  std::string content;
  content.reserve(static_cast<std::size_t>(status.st_size));
  std::array<char, std::size_t{1} << 16U> part{};
  for (;;) {
    const ssize_t got = pread(descriptor, part.data(), part.size(), static_cast<off_t>(content.size()));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return std::nullopt;
    if (got == 0) return content;
    content.append(part.data(), static_cast<std::size_t>(got));
  }
}

std::string hash_of(int descriptor) {
  const std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context(EVP_MD_CTX_new(), EVP_MD_CTX_free);
  std::array<char, std::size_t{1} << 16U> part{};
  if (!context || EVP_DigestInit_ex(context.get(), EVP_sha256(), nullptr) != 1) return "";
  for (off_t at = 0;;) {
    const ssize_t got = pread(descriptor, part.data(), part.size(), at);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0 || EVP_DigestUpdate(context.get(), part.data(), static_cast<std::size_t>(got)) != 1) return "";
    if (got == 0) break;
    at += got;
  }
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned int size = 0;
  if (EVP_DigestFinal_ex(context.get(), digest.data(), &size) != 1) return "";
  return fmt::format("{:02x}", fmt::join(digest.begin(), digest.begin() + size, ""));
}

std::string record_line(const std::string& sha256, const std::string& path) {
  std::string escaped;
  for (const char c : path) {
    if (c == '\\') {
      escaped += "\\\\";
    } else if (c == '\n') {
      escaped += "\\n";
    } else if (c == '\r') {
      escaped += "\\r";
    } else {
      escaped += c;
    }
  }
  return fmt::format("{}{}  {}\n", escaped == path ? "" : "\\", sha256, escaped);
}

RecordContent parse_record(std::string_view text) {
  RecordContent record;
  if (!text.starts_with(kSignature)) return record;
  record.exists = true;
  std::string command;
  bool whole = true;
  for (const std::string_view line : split(text, '\n')) {
    if (line.starts_with(kBy)) {
      whole = !line.ends_with(kUnfinished);
      command = line.substr(kBy.size(), line.size() - kBy.size() - (whole ? 0 : kUnfinished.size()));
      record.commands.insert(command);
      continue;
    }
    const std::size_t begin = line.starts_with('\\') ? 1 : 0;
    if (line.starts_with('#') || line.size() < begin + kRecordHashDigits + 3) continue;
    const std::string_view name = line.substr(begin + kRecordHashDigits + 2);
    const std::string path = begin == 1 ? unescaped(name) : std::string(name);
    if (!stays_inside(path)) continue;
    RecordedFile statement{std::string(line.substr(begin, kRecordHashDigits)), command, whole};
    std::vector<RecordedFile>& earlier = record.files[path];
    std::erase_if(earlier, [&](const RecordedFile& other) {
      return other.sha256 == statement.sha256 && other.command == statement.command;
    });
    earlier.push_back(std::move(statement));
  }
  return record;
}

std::string record_text(const RecordContent& record) {
  std::string text(kSignature);
  for (const std::string& command : record.commands) {
    for (const bool whole : {true, false}) {
      std::string lines;
      for (const auto& [path, statements] : record.files) {
        for (const RecordedFile& statement : statements)
          if (statement.command == command && statement.whole == whole) lines += record_line(statement.sha256, path);
      }
      if (whole || !lines.empty()) text += fmt::format("{}{}{}\n{}", kBy, command, whole ? "" : kUnfinished, lines);
    }
  }
  return text;
}

RecordContent read_record(const fs::path& folder) {
  const OpenFile file(open((folder / kRecordFile).c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW));
  if (!file) return {};
  return parse_record(content_of(file.get()).value_or(""));
}

std::vector<std::string> changed_since_written(const fs::path& folder, const std::vector<std::string>& names) {
  const RecordContent record = read_record(folder);
  std::vector<std::string> sentences;
  for (const std::string& name : names) {
    const auto listed = record.files.find(name);
    if (listed == record.files.end()) continue;
    const OpenFile file(open((folder / name).c_str(), O_RDONLY | O_CLOEXEC));
    if (!file) continue;
    const std::string hash = hash_of(file.get());
    const bool is_own =
        std::ranges::any_of(listed->second, [&](const RecordedFile& statement) { return statement.sha256 == hash; });
    if (is_own) continue;
    sentences.push_back(
        fmt::format("{}: was changed since 'myoid {}' wrote it, by the list {} beside it; its numbers may be others "
                    "than the result's: repeat the command",
                    (folder / name).string(), listed->second.back().command, kRecordFile));
  }
  return sentences;
}

OpenFile open_record(const fs::path& folder) {
  const fs::path path = folder / kRecordFile;
  for (;;) {  // a list that another process replaces meanwhile is opened again
    OpenFile file(open(path.c_str(), O_RDWR | O_APPEND | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666));
    struct stat opened {};
    struct stat named {};
    if (!file || fstat(file.get(), &opened) != 0 || !S_ISREG(opened.st_mode))
      throw InvalidInput("cannot write into the folder {}: {}: {}", folder.string(), kRecordFile, std::strerror(errno));
    (void)flock(file.get(), LOCK_EX);  // a file system without locks has one process at a time
    if (stat(path.c_str(), &named) != 0 || named.st_ino != opened.st_ino || named.st_dev != opened.st_dev) continue;
    std::string begin(kSignature.size(), '\0');
    if (opened.st_size == 0 || (pread(file.get(), begin.data(), begin.size(), 0) > 0 && begin == kSignature))
      return file;
    throw InvalidInput("{} is no list of this program's results; move it elsewhere, or give another --out",
                       path.string());
  }
}

void append_text(const fs::path& folder, const OpenFile& file, std::string_view text) {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t written = write(file.get(), text.data() + done, text.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0)
      throw InvalidInput("cannot write into the folder {}: {}: {}", folder.string(), kRecordFile, std::strerror(errno));
    done += static_cast<std::size_t>(written);
  }
}

}  // namespace myoid::inline ground
