#include "myoid/ground/files/byte_source.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/input_log.h"

namespace myoid::inline ground {

void require_regular_file(const std::filesystem::path& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) {
    throw ReadError(path, 0,
                    "there is no such file; check the path (paths inside a file are relative to that file's folder)");
  }
  if (std::filesystem::is_directory(status)) throw ReadError(path, 0, "this is a folder; name a file inside it");
  if (!std::filesystem::is_regular_file(status))
    throw ReadError(path, 0, "this is no regular file; save it to the disk first");
}

void throw_empty(const std::filesystem::path& path) {
  throw ReadError(path, 0, "the file is empty; export it again from the program that made it");
}

ByteSource::ByteSource(const std::filesystem::path& path) : path_(path) {
  require_regular_file(path);
  descriptor_ = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  struct stat info {};
  if (descriptor_ < 0 || fstat(descriptor_, &info) != 0) {
    const int cause = errno;
    if (descriptor_ >= 0) close(descriptor_);
    throw ReadError(path, 0, "cannot be opened: {}", std::strerror(cause));
  }
  note_input(descriptor_);
  size_ = static_cast<std::uint64_t>(info.st_size);
  if (size_ == 0) {
    close(descriptor_);
    throw_empty(path);
  }
}

ByteSource::ByteSource(std::span<const std::byte> memory, std::filesystem::path path)
    : path_(std::move(path)), memory_(memory), size_(memory.size()) {
  if (size_ == 0) throw_empty(path_);
}

ByteSource::~ByteSource() {
  if (descriptor_ >= 0) close(descriptor_);
}

std::span<const std::byte> ByteSource::view(std::uint64_t offset, std::size_t count) {
  if (descriptor_ < 0) return memory_.subspan(offset, count);
  if (buffer_.size() < count) buffer_.resize(count);
  for (std::size_t done = 0; done < count;) {
    const ssize_t got = pread(descriptor_, buffer_.data() + done, count - done, static_cast<off_t>(offset + done));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw ReadError(path_, 0, "reading failed: {}", std::strerror(errno));
    if (got == 0) throw ReadError(path_, 0, "the file became shorter while it was read; copy it again");
    done += static_cast<std::size_t>(got);
  }
  return {buffer_.data(), count};
}

TextMarks text_marks(ByteSource& source, std::uint64_t most) {
  constexpr std::uint64_t kPart = std::uint64_t{1} << 18U;
  TextMarks marks;
  unsigned char before = 0, second = 0;  // the last byte and the one before it
  const std::uint64_t end = std::min(most, source.size());
  for (std::uint64_t at = 0; at < end; at += kPart) {
    for (const std::byte b : source.view(at, static_cast<std::size_t>(std::min(kPart, end - at)))) {
      const auto byte = static_cast<unsigned char>(b);
      if (byte == '\n') {
        ++marks.line_feeds;
        if (before == '\r') ++marks.returned;
      }
      if (second == 0xEF && before == 0xBF && byte == 0xBD) ++marks.replaced;
      second = before;
      before = byte;
    }
  }
  return marks;
}

void refuse_text_transfer(ByteSource& source, const std::filesystem::path& path) {
  constexpr std::uint64_t kLeast = 16;
  const TextMarks marks = text_marks(source, std::uint64_t{1} << 20U);
  if (marks.all_returned(kLeast))
    throw ReadError(path, 0,
                    "a carriage return stands before every line feed of this binary file: it was transferred as text, "
                    "which shifts its bytes; copy it again in binary mode");
  if (marks.replaced >= kLeast)
    throw ReadError(path, 0,
                    "{} places of this binary file hold the sign for a byte that is no text: it was saved as text, and "
                    "bytes are lost; copy the original again",
                    marks.replaced);
}

std::string read_bytes(const std::filesystem::path& path) {
  ByteSource source(path);
  std::string bytes;
  bytes.reserve(source.size());
  constexpr std::uint64_t kChunk = std::uint64_t{1} << 20U;
  for (std::uint64_t at = 0; at < source.size(); at += kChunk) {
    const auto part = source.view(at, static_cast<std::size_t>(std::min(kChunk, source.size() - at)));
    bytes.append(reinterpret_cast<const char*>(part.data()), part.size());
  }
  return bytes;
}

}  // namespace myoid::inline ground
