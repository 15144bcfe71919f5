#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace myoid::body {

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

  struct Operation {
    std::string_view name;
    int arguments;  ///< Number of values that it takes from the stack.
    double (*apply)(const double* arguments);
  };

 private:
  /// A step of a stack machine; operands precede their operation. Without an operation it is a variable or a number.
  struct Step {
    const Operation* operation = nullptr;
    std::optional<std::size_t> variable{};
    double number = 0.0;
  };
  friend class ExpressionParser;
  std::vector<Step> steps_;
};

}  // namespace myoid::body
