#include "myoid/body/model/expression.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/ground/core/error.h"

namespace myoid::body {
namespace {

using Operation = Expression::Operation;

/// The operations, whose names no formula can call, and the functions.
constexpr Operation kOperations[] = {
    {"+", 2, [](const double* x) { return x[0] + x[1]; }},
    {"-", 2, [](const double* x) { return x[0] - x[1]; }},
    {"*", 2, [](const double* x) { return x[0] * x[1]; }},
    {"/", 2, [](const double* x) { return x[0] / x[1]; }},
    {"^", 2, [](const double* x) { return std::pow(x[0], x[1]); }},
    {"-x", 1, [](const double* x) { return -x[0]; }},
    {"sqrt", 1, [](const double* x) { return std::sqrt(x[0]); }},
    {"exp", 1, [](const double* x) { return std::exp(x[0]); }},
    {"log", 1, [](const double* x) { return std::log(x[0]); }},
    {"sin", 1, [](const double* x) { return std::sin(x[0]); }},
    {"cos", 1, [](const double* x) { return std::cos(x[0]); }},
    {"sec", 1, [](const double* x) { return 1.0 / std::cos(x[0]); }},
    {"csc", 1, [](const double* x) { return 1.0 / std::sin(x[0]); }},
    {"tan", 1, [](const double* x) { return std::tan(x[0]); }},
    {"cot", 1, [](const double* x) { return 1.0 / std::tan(x[0]); }},
    {"asin", 1, [](const double* x) { return std::asin(x[0]); }},
    {"acos", 1, [](const double* x) { return std::acos(x[0]); }},
    {"atan", 1, [](const double* x) { return std::atan(x[0]); }},
    {"sinh", 1, [](const double* x) { return std::sinh(x[0]); }},
    {"cosh", 1, [](const double* x) { return std::cosh(x[0]); }},
    {"tanh", 1, [](const double* x) { return std::tanh(x[0]); }},
    {"erf", 1, [](const double* x) { return std::erf(x[0]); }},
    {"erfc", 1, [](const double* x) { return std::erfc(x[0]); }},
    {"step", 1, [](const double* x) { return x[0] >= 0.0 ? 1.0 : 0.0; }},
    {"delta", 1, [](const double* x) { return x[0] == 0.0 ? 1.0 : 0.0; }},
    {"square", 1, [](const double* x) { return x[0] * x[0]; }},
    {"cube", 1, [](const double* x) { return x[0] * x[0] * x[0]; }},
    {"recip", 1, [](const double* x) { return 1.0 / x[0]; }},
    {"abs", 1, [](const double* x) { return std::abs(x[0]); }},
    {"floor", 1, [](const double* x) { return std::floor(x[0]); }},
    {"ceil", 1, [](const double* x) { return std::ceil(x[0]); }},
    {"min", 2, [](const double* x) { return std::min(x[0], x[1]); }},
    {"max", 2, [](const double* x) { return std::max(x[0], x[1]); }},
    {"atan2", 2, [](const double* x) { return std::atan2(x[0], x[1]); }},
    {"select", 3, [](const double* x) { return x[0] != 0.0 ? x[1] : x[2]; }},
};

/// Returns the operation or function of that name; null if there is none.
const Operation* operation_named(std::string_view name) {
  const auto* found = std::ranges::find(kOperations, name, &Operation::name);
  return found == std::end(kOperations) ? nullptr : found;
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

  void put(Expression::Step step) {
    if (steps_.size() >= kLongest) fail(part_.at, "too long");
    steps_.push_back(step);
  }
  void put(std::string_view operation) { put({.operation = operation_named(operation)}); }

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
        put("+");
      } else if (take('-')) {
        product();
        put("-");
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
        put("*");
      } else if (take('/')) {
        sign();
        put("/");
      } else {
        return;
      }
    }
  }

  void sign() {
    if (++depth_ > kDeepest) fail(part_.at, "nested too deep");
    if (take('-')) {
      sign();
      put("-x");
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
    put("^");
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
      put({.number = value});
    } else if (is_letter(c)) {
      while (part_.at < part_.end && (is_letter(text_[part_.at]) || is_digit(text_[part_.at]))) ++part_.at;
      name(text_.substr(begin, part_.at - begin), begin);
    } else {
      fail(begin, c == '\0' ? "it ends where a value is expected" : fmt::format("'{}' is not expected", c));
    }
  }

  void name(std::string_view word, std::size_t begin) {
    if (take('(')) {
      const Operation* function = operation_named(word);
      if (function == nullptr) fail(begin, fmt::format("there is no function '{}'", word));
      for (int i = 0; i < function->arguments; ++i) {
        if (i > 0 && !take(',')) {
          fail(part_.at, fmt::format("'{}' takes {} values, expected a comma", word, function->arguments));
        }
        if (++depth_ > kDeepest) fail(begin, "nested too deep");
        sum();
        --depth_;
      }
      if (!take(')')) fail(part_.at, "expected )");
      put({.operation = function});
      return;
    }
    if (const auto it = definitions_.find(word); it != definitions_.end()) return read(it->second);
    const auto variable = std::find(variables_.begin(), variables_.end(), word);
    if (variable == variables_.end()) {
      fail(begin, fmt::format("'{}' is neither defined nor one of {}", word, fmt::join(variables_, ", ")));
    }
    put({.variable = static_cast<std::size_t>(variable - variables_.begin())});
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
    if (step.operation == nullptr) {
      stack.push_back(step.variable ? variables[*step.variable] : step.number);
      continue;
    }
    const std::size_t below = stack.size() - static_cast<std::size_t>(step.operation->arguments);
    const double value = step.operation->apply(stack.data() + below);
    stack.resize(below);
    stack.push_back(value);
  }
  return stack.back();
}

}  // namespace myoid::body
