#include "myoid/recording/recorded_day.h"

#include <chrono>
#include <optional>
#include <vector>

#include "myoid/ground/core/day_text.h"
#include "myoid/ground/files/byte_source.h"
#include "myoid/ground/files/file_format.h"
#include "myoid/recording/c3d/c3d_reader.h"

namespace myoid::recording {
namespace {

std::string day_of(int year, int month, int day) {
  if (year < 1900 || year > 9999 || month < 1 || day < 1) return "";
  return day_text(std::chrono::year(year) / month / day);
}

std::string c3d_day(ByteSource& source, const std::filesystem::path& path) {
  const C3dHead head = read_c3d_head(source, path);
  const C3dParameter* date = head.file.find("TRIAL", "DATE");
  if (date == nullptr || date->numbers.size() < 3) return "";
  const auto number = [&](std::size_t k) { return static_cast<int>(date->numbers[k]); };
  return day_of(number(0), number(1), number(2));
}

/// Reads "dd.mm.yy" of the header. The years 85 to 99 are of the century before.
std::string edf_day(ByteSource& source) {
  constexpr std::size_t kDate = 168, kLength = 8;
  if (source.size() < kDate + kLength) return "";
  std::string text;
  for (const std::byte b : source.view(kDate, kLength)) text += static_cast<char>(b);
  const auto number = [&](std::size_t at) -> int {
    const bool digits = text[at] >= '0' && text[at] <= '9' && text[at + 1] >= '0' && text[at + 1] <= '9';
    return digits ? 10 * (text[at] - '0') + (text[at + 1] - '0') : -1;
  };
  const int day = number(0), month = number(3), year = number(6);
  if (year < 0) return "";
  const std::string found = day_of(year < 85 ? 2000 + year : 1900 + year, month, day);
  return found == "1985-01-01" ? "" : found;
}

}  // namespace

std::string recorded_day(const std::filesystem::path& path) {
  const std::optional<FileFormat> format = format_of(path);
  if (format != FileFormat::c3d && format != FileFormat::edf) return "";
  ByteSource source(path);
  return format == FileFormat::c3d ? c3d_day(source, path) : edf_day(source);
}

}  // namespace myoid::recording
