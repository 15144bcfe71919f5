#include "myoid/recording/series_file.h"

#include <utility>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/file_format.h"
#include "myoid/recording/makers/emg_table.h"
#include "myoid/recording/tables/storage_reader.h"
#include "myoid/recording/tables/storage_writer.h"

namespace myoid::recording {

SeriesFile read_series(const std::filesystem::path& path) {
  if (format_of(path) == FileFormat::text_table) {
    CsvSeries file = parse_emg_table(read_text_file(path), path);
    return {std::move(file.data), std::move(file.repairs), std::move(file.to_si)};
  }
  Storage file = read_storage(path);
  return {std::move(file.data), std::move(file.repairs)};
}

void write_series(const std::filesystem::path& path,
                  const TimeSeries& series,
                  const std::string& title,
                  const std::vector<std::string>& remarks) {
  const std::string extension = extension_of(path);
  std::error_code ignored;
  const auto status = std::filesystem::status(path, ignored);
  if (extension == ".csv") {
    write_csv(path, series, remarks);
  } else if (format_of(path) == FileFormat::storage ||
             (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))) {
    write_storage(path, series, {.title = title, .comments = remarks});
  } else {
    throw InvalidInput(
        fmt::format("{}: expected a name that ends in .sto, .mot or .csv, found '{}'", path.string(), extension));
  }
}

}  // namespace myoid::recording
