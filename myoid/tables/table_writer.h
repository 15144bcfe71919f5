#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "myoid/tables/storage_writer.h"
#include "myoid/tables/text_rows.h"

namespace myoid::recording {

/// Writes a storage file (format_storage) to `sink`, or to a file completely or not at all. Rows are asked for block by
/// block. Throws InvalidInput, naming channel and time, for the first row with a value that is not finite.
void put_storage(const RowSource& source, const StorageFormat& format, const TextSink& sink);
void write_storage(const std::filesystem::path& path, const RowSource& source, const StorageFormat& format);

/// Writes a plain table (write_csv) of such rows.
void write_csv(const std::filesystem::path& path,
               const RowSource& source,
               const std::vector<std::string>& remarks = {});

}  // namespace myoid::recording
