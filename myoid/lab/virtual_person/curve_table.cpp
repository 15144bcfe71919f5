#include "myoid/lab/virtual_person/curve_table.h"

#include <cmath>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"

namespace myoid::lab {

CurveTable::CurveTable(const std::function<muscle::CurvePoint<double>(double)>& curve,
                       double first,
                       double last,
                       int intervals)
    : first_(first), last_(last), per_interval_(intervals / (last - first)) {
  if (!(first < last) || intervals < 1)
    throw InvalidInput(fmt::format("a table from {} to {} in {} intervals holds nothing", first, last, intervals));
  node_.resize(static_cast<std::size_t>(intervals) + 1);
  for (std::size_t k = 0; k < node_.size(); ++k) {
    const double x = k + 1 == node_.size() ? last : first + static_cast<double>(k) / per_interval_;
    node_[k] = curve(x);
    if (!std::isfinite(node_[k].value) || !std::isfinite(node_[k].slope))
      throw InvalidInput(
          fmt::format("a curve is {} with slope {} at {}; expected finite numbers", node_[k].value, node_[k].slope, x));
  }
}

}  // namespace myoid::lab
