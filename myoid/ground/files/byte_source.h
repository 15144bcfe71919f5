#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace myoid::inline ground {

/// Throws ReadError with the remedy unless there is a file of the disk at this path.
void require_regular_file(const std::filesystem::path& path);
[[noreturn]] void throw_empty(const std::filesystem::path& path);

/// Reads the bytes of a file, or of memory, part by part, so that large recordings need not be in memory twice.
class ByteSource {
 public:
  /// Throws ReadError with the remedy if the file is missing, a folder, unreadable or empty.
  explicit ByteSource(const std::filesystem::path& path);
  ByteSource(std::span<const std::byte> memory, std::filesystem::path path);
  ~ByteSource();
  ByteSource(const ByteSource&) = delete;
  ByteSource& operator=(const ByteSource&) = delete;

  [[nodiscard]] std::uint64_t size() const { return size_; }

  /// Returns `count` bytes from `offset`, valid until the next call. Precondition: they lie inside
  /// the file. Throws ReadError if the file became shorter meanwhile or cannot be read.
  [[nodiscard]] std::span<const std::byte> view(std::uint64_t offset, std::size_t count);

 private:
  std::filesystem::path path_;
  std::span<const std::byte> memory_;
  std::vector<std::byte> buffer_;
  std::uint64_t size_ = 0;
  int descriptor_ = -1;
};

/// Marks that a transfer of a binary file as text leaves.
struct TextMarks {
  std::uint64_t line_feeds = 0;
  std::uint64_t returned = 0;  ///< Line feeds behind a carriage return.
  std::uint64_t replaced = 0;  ///< U+FFFD in UTF-8, which stands for a byte that is no text.

  /// Returns true if there are line feeds, at least `least`, and a carriage return before every one.
  [[nodiscard]] bool all_returned(std::uint64_t least) const { return line_feeds >= least && returned == line_feeds; }
};

/// Counts the marks in the first `most` bytes of a file.
[[nodiscard]] TextMarks text_marks(ByteSource& source, std::uint64_t most);

/// Throws ReadError if the first megabyte of a binary file shows that a transfer as text has changed its bytes: 16 line
/// feeds or more, each behind a carriage return (by chance once in 256^16), or 16 bytes and more that became U+FFFD.
void refuse_text_transfer(ByteSource& source, const std::filesystem::path& path);

/// Reads the whole file, whatever its content, for its hash. Throws like ByteSource.
[[nodiscard]] std::string read_bytes(const std::filesystem::path& path);

}  // namespace myoid::inline ground
