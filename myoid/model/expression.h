#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace myoid::model {

/// A formula in named variables, as in OpenSim's expression-based forces: numbers, + - * / ^
/// (^ first, from the right; then the sign, so that -x^2 is -(x^2)), parentheses, and the functions sqrt exp log sin
/// cos sec csc tan cot asin acos atan sinh cosh tanh erf erfc step (0 below 0, else 1) delta (1 at 0, else 0) square
/// cube recip abs floor ceil, min max atan2 of two and select of three (select(x, a, b): b where x is 0, else a).
/// Definitions may follow: "k*y; y=d-0.2; k=50".
class Expression {
 public:
  /// Builds the formula 0.
  Expression() = default;
  /// Parses the text. Throws InvalidInput with the place (counted from 1) and the kind of an error.
  Expression(std::string_view text, const std::vector<std::string>& variables);

  /// Returns the value; `variables` in the order of the names. NaN outside a function's domain.
  [[nodiscard]] double operator()(std::span<const double> variables) const;

  enum class Operation {
    number,
    variable,
    add,
    subtract,
    multiply,
    divide,
    power,
    negate,
    sqrt_,
    exp_,
    log_,
    sin_,
    cos_,
    sec_,
    csc_,
    tan_,
    cot_,
    asin_,
    acos_,
    atan_,
    sinh_,
    cosh_,
    tanh_,
    erf_,
    erfc_,
    step_,
    delta_,
    square_,
    cube_,
    recip_,
    abs_,
    floor_,
    ceil_,
    min_,
    max_,
    atan2_,
    select_
  };

 private:
  /// Steps of a stack machine: operands precede their operation.
  struct Step {
    Operation operation = Operation::number;
    double number = 0.0;
    std::size_t variable = 0;
  };
  friend class ExpressionParser;
  std::vector<Step> steps_;
};

}  // namespace myoid::model
