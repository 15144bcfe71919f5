#include "myoid/pipeline/finding.h"

#include <utility>

namespace myoid::pipeline {

std::string_view name(Finding::Level level) {
  switch (level) {
    case Finding::Level::error:
      return "error";
    case Finding::Level::warning:
      return "warning";
    case Finding::Level::note:
      return "note";
  }
  return "?";
}

Finding finding(std::string where, signals::Fault fault) {
  Finding result{fault.grave ? Finding::Level::warning : Finding::Level::note, std::move(where),
                 sentence(fault)};
  result.fault = std::move(fault);
  return result;
}

}  // namespace myoid::pipeline
