#pragma once

#include <string>

namespace myoid::page {

/// The data of an SVG path, to a tenth of a unit. A point is written as its difference from the point before. Both
/// positions are rounded first, so that no error adds up. A point in the same tenth as the point before is left out.
class SvgPath {
 public:
  void move(double x, double y);  ///< Begins a curve, in absolute numbers.
  void line(double x, double y);  ///< Begins a curve if there is none.
  void close();                   ///< Closes the curve; the next point begins another one.
  [[nodiscard]] bool is_open() const { return open_; }
  void lift() { open_ = false; }  ///< The next point begins another curve.
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string text_;
  bool open_ = false;
  bool differences_ = false;  ///< The last numbers are differences.
  long x_ = 0, y_ = 0;        ///< The last point, in tenths.
};

}  // namespace myoid::page
