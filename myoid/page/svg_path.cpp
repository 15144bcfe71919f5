#include "myoid/page/svg_path.h"

#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

namespace myoid::page {
namespace {

/// Appends a number of tenths in as few characters as it has; a minus parts it from a number before.
void append(std::string& text, long tenths) {
  const bool first = text.empty() || text.back() == 'M' || text.back() == 'l';
  if (tenths < 0) {
    text += '-';
  } else if (!first) {
    text += ' ';
  }
  const long size = std::labs(tenths);
  if (size >= 10 || size == 0) text += fmt::format("{}", size / 10);
  if (size % 10 != 0) text += fmt::format(".{}", size % 10);
}

}  // namespace

void SvgPath::move(double x, double y) {
  x_ = std::lround(10.0 * x);
  y_ = std::lround(10.0 * y);
  text_ += 'M';
  append(text_, x_);
  append(text_, y_);
  open_ = true;
  differences_ = false;
}

void SvgPath::line(double x, double y) {
  if (!open_) {
    move(x, y);
    return;
  }
  const long to_x = std::lround(10.0 * x);
  const long to_y = std::lround(10.0 * y);
  if (to_x == x_ && to_y == y_) return;
  if (!differences_) text_ += 'l';
  differences_ = true;
  append(text_, to_x - x_);
  append(text_, to_y - y_);
  x_ = to_x;
  y_ = to_y;
}

void SvgPath::close() {
  if (open_) text_ += 'Z';
  open_ = false;
}

}  // namespace myoid::page
