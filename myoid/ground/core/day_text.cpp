#include "myoid/ground/core/day_text.h"

#include <fmt/format.h>

namespace myoid::inline ground {

std::string day_text(const std::chrono::year_month_day& day) {
  if (!day.ok()) return "";
  return fmt::format("{:04}-{:02}-{:02}", static_cast<int>(day.year()), static_cast<unsigned>(day.month()),
                     static_cast<unsigned>(day.day()));
}

}  // namespace myoid::inline ground
