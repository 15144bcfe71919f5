#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "myoid/cli/context.h"

namespace myoid::cli {

/// The option --mat of commands that fill a folder with results: writes them as one MATLAB file, too.
class MatOption {
 public:
  explicit MatOption(CLI::App& command);
  /// Refuses a file that cannot be written, before anything is computed.
  void prepare(const Context& context, const std::vector<std::string>& inputs) const;
  /// Writes the file if the option is given.
  void write(const std::filesystem::path& folder) const;

 private:
  std::shared_ptr<std::string> file_ = std::make_shared<std::string>();
};

}  // namespace myoid::cli
