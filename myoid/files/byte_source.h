#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace myoid::recording {

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

/// Reads the whole file, whatever its content, for its hash. Throws like ByteSource.
[[nodiscard]] std::string read_bytes(const std::filesystem::path& path);

}  // namespace myoid::recording
