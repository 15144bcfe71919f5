#include "myoid/tables/storage_writer.h"

#include "myoid/tables/table_writer.h"

namespace myoid::recording {

std::string format_storage(const TimeSeries& series, const StorageFormat& format) {
  std::string text;
  put_storage(rows_of(series), format, [&](std::string_view part) { text += part; });
  return text;
}

void write_storage(const std::filesystem::path& path, const TimeSeries& series, const StorageFormat& format) {
  require_finite(series, "storage file");
  write_storage(path, rows_of(series), format);
}

void write_csv(const std::filesystem::path& path, const TimeSeries& series, const std::vector<std::string>& remarks) {
  write_csv(path, rows_of(series), remarks);
}

}  // namespace myoid::recording
