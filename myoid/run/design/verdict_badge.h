#pragma once

#include "myoid/fit/intervals/result.h"
#include "myoid/page/report.h"

namespace myoid::run {

/// Returns the badge of a verdict.
[[nodiscard]] constexpr page::Badge verdict_badge(fit::Verdict verdict) {
  using enum fit::Verdict;
  switch (verdict) {
    case identified:
      return page::Badge::good;
    case reproducible:
      return page::Badge::repeat;
    case weak:
      return page::Badge::weak;
    case prior_dominated:
      return page::Badge::info;
    case non_physical:
      return page::Badge::bad;
    case not_identifiable:
      break;
  }
  return page::Badge::none;
}

}  // namespace myoid::run
