#include "myoid/core/error.h"

#include <utility>

#include <fmt/format.h>

namespace myoid {

ReadError::ReadError(std::filesystem::path path, std::size_t line, const std::string& message)
    : InvalidInput(line == 0 ? fmt::format("{}: {}", path.string(), message)
                             : fmt::format("{}:{}: {}", path.string(), line, message)),
      path_(std::move(path)),
      line_(line) {}

}  // namespace myoid
