#include "myoid/model/expression.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/core/error.h"

namespace myoid::model {
namespace {

using Operation = Expression::Operation;

struct Named {
  std::string_view name;
  Operation operation;
  int arguments;
};

constexpr Named kFunctions[] = {
    {"sqrt", Operation::sqrt_, 1},   {"exp", Operation::exp_, 1},       {"log", Operation::log_, 1},
    {"sin", Operation::sin_, 1},     {"cos", Operation::cos_, 1},       {"sec", Operation::sec_, 1},
    {"csc", Operation::csc_, 1},     {"tan", Operation::tan_, 1},       {"cot", Operation::cot_, 1},
    {"asin", Operation::asin_, 1},   {"acos", Operation::acos_, 1},     {"atan", Operation::atan_, 1},
    {"sinh", Operation::sinh_, 1},   {"cosh", Operation::cosh_, 1},     {"tanh", Operation::tanh_, 1},
    {"erf", Operation::erf_, 1},     {"erfc", Operation::erfc_, 1},     {"step", Operation::step_, 1},
    {"delta", Operation::delta_, 1}, {"square", Operation::square_, 1}, {"cube", Operation::cube_, 1},
    {"recip", Operation::recip_, 1}, {"abs", Operation::abs_, 1},       {"floor", Operation::floor_, 1},
    {"ceil", Operation::ceil_, 1},   {"min", Operation::min_, 2},       {"max", Operation::max_, 2},
    {"atan2", Operation::atan2_, 2}, {"select", Operation::select_, 3},
};

/// Returns the number of values that the operation takes from the stack.
int arguments_of(Operation operation) {
  switch (operation) {
    case Operation::number:
    case Operation::variable:
      return 0;
    case Operation::add:
    case Operation::subtract:
    case Operation::multiply:
    case Operation::divide:
    case Operation::power:
    case Operation::min_:
    case Operation::max_:
    case Operation::atan2_:
      return 2;
    case Operation::select_:
      return 3;
    default:
      return 1;
  }
}

double apply(Operation operation, const double* x) {
  switch (operation) {
    case Operation::add:
      return x[0] + x[1];
    case Operation::subtract:
      return x[0] - x[1];
    case Operation::multiply:
      return x[0] * x[1];
    case Operation::divide:
      return x[0] / x[1];
    case Operation::power:
      return std::pow(x[0], x[1]);
    case Operation::negate:
      return -x[0];
    case Operation::sqrt_:
      return std::sqrt(x[0]);
    case Operation::exp_:
      return std::exp(x[0]);
    case Operation::log_:
      return std::log(x[0]);
    case Operation::sin_:
      return std::sin(x[0]);
    case Operation::cos_:
      return std::cos(x[0]);
    case Operation::sec_:
      return 1.0 / std::cos(x[0]);
    case Operation::csc_:
      return 1.0 / std::sin(x[0]);
    case Operation::tan_:
      return std::tan(x[0]);
    case Operation::cot_:
      return 1.0 / std::tan(x[0]);
    case Operation::asin_:
      return std::asin(x[0]);
    case Operation::acos_:
      return std::acos(x[0]);
    case Operation::atan_:
      return std::atan(x[0]);
    case Operation::sinh_:
      return std::sinh(x[0]);
    case Operation::cosh_:
      return std::cosh(x[0]);
    case Operation::tanh_:
      return std::tanh(x[0]);
    case Operation::erf_:
      return std::erf(x[0]);
    case Operation::erfc_:
      return std::erfc(x[0]);
    case Operation::step_:
      return x[0] >= 0.0 ? 1.0 : 0.0;
    case Operation::delta_:
      return x[0] == 0.0 ? 1.0 : 0.0;
    case Operation::square_:
      return x[0] * x[0];
    case Operation::cube_:
      return x[0] * x[0] * x[0];
    case Operation::recip_:
      return 1.0 / x[0];
    case Operation::abs_:
      return std::abs(x[0]);
    case Operation::floor_:
      return std::floor(x[0]);
    case Operation::ceil_:
      return std::ceil(x[0]);
    case Operation::min_:
      return std::min(x[0], x[1]);
    case Operation::max_:
      return std::max(x[0], x[1]);
    case Operation::atan2_:
      return std::atan2(x[0], x[1]);
    case Operation::select_:
      return x[0] != 0.0 ? x[1] : x[2];
    case Operation::number:
    case Operation::variable:
      break;
  }
  return 0.0;
}

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

constexpr int kDeepest = 200;            // parentheses and signs within each other
constexpr std::size_t kLongest = 20000;  // steps; definitions are inserted where they are named

}  // namespace

/// Parses one text by recursive descent; definitions are read where they are named.
class ExpressionParser {
 public:
  ExpressionParser(std::string_view text, const std::vector<std::string>& variables)
      : text_(text), variables_(variables) {
    std::size_t begin = 0;
    while (begin <= text.size()) {
      const std::size_t end = std::min(text.find(';', begin), text.size());
      if (begin == 0) {
        formula_ = {0, end};
      } else if (std::any_of(text.begin() + static_cast<std::ptrdiff_t>(begin),
                             text.begin() + static_cast<std::ptrdiff_t>(end), [](char c) { return !is_blank(c); })) {
        const std::size_t equal = text.find('=', begin);
        std::size_t name = begin;
        while (name < end && is_blank(text[name])) ++name;
        std::size_t stop = name;
        while (stop < end && (is_letter(text[stop]) || is_digit(text[stop]))) ++stop;
        if (equal >= end || stop == name) fail(begin, "expected a definition, name=formula");
        definitions_[std::string(text.substr(name, stop - name))] = {equal + 1, end};
      }
      begin = end + 1;
    }
  }

  std::vector<Expression::Step> parse() {
    read(formula_);
    return std::move(steps_);
  }

 private:
  struct Part {
    std::size_t at = 0, end = 0;
  };

  [[noreturn]] void fail(std::size_t at, std::string_view what) const {
    throw InvalidInput(fmt::format("formula '{}': {}, at character {}", text_, what, at + 1));
  }

  void put(Operation operation, double number = 0.0, std::size_t variable = 0) {
    if (steps_.size() >= kLongest) fail(part_.at, "too long");
    steps_.push_back({operation, number, variable});
  }

  void read(Part part) {
    if (++depth_ > kDeepest) fail(part.at, "a definition refers to itself, or too many nest");
    std::swap(part_, part);
    sum();
    skip();
    if (part_.at < part_.end) fail(part_.at, fmt::format("'{}' is not expected", text_[part_.at]));
    std::swap(part_, part);
    --depth_;
  }

  void skip() {
    while (part_.at < part_.end && is_blank(text_[part_.at])) ++part_.at;
  }
  char peek() {
    skip();
    return part_.at < part_.end ? text_[part_.at] : '\0';
  }
  bool take(char c) {
    if (peek() != c) return false;
    ++part_.at;
    return true;
  }

  void sum() {
    product();
    for (;;) {
      if (take('+')) {
        product();
        put(Operation::add);
      } else if (take('-')) {
        product();
        put(Operation::subtract);
      } else {
        return;
      }
    }
  }

  void product() {
    sign();
    for (;;) {
      if (take('*')) {
        sign();
        put(Operation::multiply);
      } else if (take('/')) {
        sign();
        put(Operation::divide);
      } else {
        return;
      }
    }
  }

  void sign() {
    if (++depth_ > kDeepest) fail(part_.at, "nested too deep");
    if (take('-')) {
      sign();
      put(Operation::negate);
    } else {
      (void)take('+');
      power();
    }
    --depth_;
  }

  void power() {
    primary();
    if (!take('^')) return;
    sign();  // from right to left; the exponent may have a sign
    put(Operation::power);
  }

  void primary() {
    const char c = peek();
    const std::size_t begin = part_.at;
    if (take('(')) {
      if (++depth_ > kDeepest) fail(begin, "nested too deep");
      sum();
      if (!take(')')) fail(part_.at, "expected )");
      --depth_;
    } else if (is_digit(c) || c == '.') {
      double value = 0.0;
      const auto [end, error] = std::from_chars(text_.data() + part_.at, text_.data() + part_.end, value);
      if (error != std::errc()) fail(begin, "expected a number");
      part_.at = static_cast<std::size_t>(end - text_.data());
      put(Operation::number, value);
    } else if (is_letter(c)) {
      while (part_.at < part_.end && (is_letter(text_[part_.at]) || is_digit(text_[part_.at]))) ++part_.at;
      name(text_.substr(begin, part_.at - begin), begin);
    } else {
      fail(begin, c == '\0' ? "it ends where a value is expected" : fmt::format("'{}' is not expected", c));
    }
  }

  void name(std::string_view word, std::size_t begin) {
    if (take('(')) {
      const auto* function =
          std::find_if(std::begin(kFunctions), std::end(kFunctions), [&](const Named& f) { return f.name == word; });
      if (function == std::end(kFunctions)) fail(begin, fmt::format("there is no function '{}'", word));
      for (int i = 0; i < function->arguments; ++i) {
        if (i > 0 && !take(',')) {
          fail(part_.at, fmt::format("'{}' takes {} values, expected a comma", word, function->arguments));
        }
        if (++depth_ > kDeepest) fail(begin, "nested too deep");
        sum();
        --depth_;
      }
      if (!take(')')) fail(part_.at, "expected )");
      put(function->operation);
      return;
    }
    if (const auto it = definitions_.find(word); it != definitions_.end()) return read(it->second);
    const auto variable = std::find(variables_.begin(), variables_.end(), word);
    if (variable == variables_.end()) {
      fail(begin, fmt::format("'{}' is neither defined nor one of {}", word, fmt::join(variables_, ", ")));
    }
    put(Operation::variable, 0.0, static_cast<std::size_t>(variable - variables_.begin()));
  }

  std::string_view text_;
  const std::vector<std::string>& variables_;
  std::map<std::string, Part, std::less<>> definitions_;
  Part formula_, part_;
  std::vector<Expression::Step> steps_;
  int depth_ = 0;
};

Expression::Expression(std::string_view text, const std::vector<std::string>& variables)
    : steps_(ExpressionParser(text, variables).parse()) {}

double Expression::operator()(std::span<const double> variables) const {
  if (steps_.empty()) return 0.0;
  std::vector<double> stack;
  stack.reserve(16);
  for (const Step& step : steps_) {
    if (step.operation == Operation::number) {
      stack.push_back(step.number);
    } else if (step.operation == Operation::variable) {
      stack.push_back(variables[step.variable]);
    } else {
      const auto taken = static_cast<std::size_t>(arguments_of(step.operation));
      const double value = apply(step.operation, stack.data() + (stack.size() - taken));
      stack.resize(stack.size() - taken);
      stack.push_back(value);
    }
  }
  return stack.back();
}

}  // namespace myoid::model
