#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "myoid/ground/files/byte_source.h"
#include "myoid/ground/files/text_file.h"

namespace myoid::recording {

/// A signal as the header of an EDF or BDF file describes it.
struct EdfSignal {
  std::string label, dimension;
  double physical_min = 0.0, physical_max = 0.0, digital_min = 0.0, digital_max = 0.0;
  std::size_t per_record = 0;
  std::size_t offset = 0;  ///< Place of its samples in a record [bytes].
  bool annotations = false;
};

/// The header of an EDF or BDF file.
struct EdfHeader {
  bool bdf = false;
  bool gaps = false;  ///< EDF+D: each record states its own time.
  bool plus = false;
  std::size_t bytes = 0;
  std::int64_t records = -1;
  double record_s = 0.0;
  std::vector<EdfSignal> signals;
  std::size_t sample_bytes = 2;
  std::uint64_t record_bytes = 0;
};

/// Reads the header, with a note on each repair. Throws ReadError if the file is of another kind, cut off within its
/// header, or if the header makes no sense.
[[nodiscard]] EdfHeader read_edf_header(ByteSource& source,
                                        const std::filesystem::path& path,
                                        std::vector<Repair>& repairs);

}  // namespace myoid::recording
