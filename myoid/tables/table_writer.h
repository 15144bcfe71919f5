#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "myoid/tables/storage_writer.h"
#include "myoid/tables/text_rows.h"

namespace myoid::recording {

/// A storage file (format_storage) of rows that are asked for block by block, to `sink` or, whole
/// or not at all, to a file. Throws InvalidInput, naming channel and time, for the first row with a
/// value that is not finite.
void put_storage(const RowSource& source, const StorageFormat& format, const TextSink& sink);
void write_storage(const std::filesystem::path& path,
                   const RowSource& source,
                   const StorageFormat& format);

/// A plain table (write_csv) of such rows.
void write_csv(const std::filesystem::path& path,
               const RowSource& source,
               const std::vector<std::string>& remarks = {});

}  // namespace myoid::recording
