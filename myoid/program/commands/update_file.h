#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "myoid/program/commands/call.h"

namespace myoid::program {

/// Options of the conversion of an OpenSim model, set-up or set to the newest version.
struct UpdateFileOptions {
  Call call;
  std::string file;              ///< .osim, .xml
  std::string compat = "exact";  ///< opensim: rounds offsets to six digits, as OpenSim does.
};

struct UpdateFileResult {
  std::string text;
  int old_version = 0, version = 0;
  std::vector<Remark> remarks;
};

[[nodiscard]] UpdateFileResult update_file(const UpdateFileOptions& options);

/// Writes the updated text.
void write_update_file(const UpdateFileResult& result, const std::filesystem::path& path);

}  // namespace myoid::program
