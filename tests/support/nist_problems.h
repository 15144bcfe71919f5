// The 27 nonlinear regression problems of NIST's Statistical Reference Datasets
// (https://www.itl.nist.gov/div898/strd/nls/nls_main.shtml): parameters and their standard
// deviations are certified to 11 digits, found by NIST in 128-bit arithmetic from two starts each.
#pragma once

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <ceres/jet.h>

#include "myoid/ground/math/least_squares.h"

#include "tests/support/places.h"

namespace myoid::test {

constexpr int kMostNistParameters = 9;
using NistJet = ceres::Jet<double, kMostNistParameters>;

/// One problem, as in tests/reference/nist/<name>.csv. Numbers are read as long double: in double,
/// the responses of Lanczos1 alone would be rounded by a thousandth of its residuals.
struct NistProblem {
  std::string name;
  std::vector<Eigen::VectorXd> starts;
  Eigen::VectorXd certified, standard_deviation;
  double residual_sum_of_squares = 0.0;
  std::vector<long double> response;
  std::vector<std::vector<long double>> predictors;  ///< Per observation.
};

/// Correct digits: -log10 of the relative error, at most 11.
inline double correct_digits(double found, double certified) {
  return std::min(11.0, -std::log10(std::abs(found - certified) / std::abs(certified) + 1e-300));
}

inline NistProblem read_nist(const std::string& name) {
  std::ifstream file(source_dir() / "tests/reference/nist" / (name + ".csv"));
  if (!file) throw std::runtime_error("no reference data of " + name);
  NistProblem problem;
  problem.name = name;
  std::string line;
  bool data = false;
  while (std::getline(file, line)) {
    if (line.starts_with('#')) continue;
    std::stringstream stream(line);
    std::string word, key;
    if (!data) std::getline(stream, key, ',');
    if (key == "data") {
      data = true;
      continue;
    }
    std::vector<long double> numbers;
    while (std::getline(stream, word, ',')) numbers.push_back(std::stold(word));
    Eigen::VectorXd vector(static_cast<Eigen::Index>(numbers.size()));
    for (Eigen::Index i = 0; i < vector.size(); ++i)
      vector[i] = static_cast<double>(numbers[static_cast<std::size_t>(i)]);
    if (data) {
      problem.response.push_back(numbers.front());
      problem.predictors.emplace_back(numbers.begin() + 1, numbers.end());
    } else if (key.starts_with("start")) {
      problem.starts.push_back(vector);
    } else if (key == "certified") {
      problem.certified = vector;
    } else if (key == "standard_deviation") {
      problem.standard_deviation = vector;
    } else if (key == "residual_sum_of_squares") {
      problem.residual_sum_of_squares = vector[0];
    }
  }
  return problem;
}

/// The problem's model at one observation, for long double and for Jets.
template <typename T>
T nist_model(const std::string& name, const std::vector<T>& b, const std::vector<long double>& at) {
  using std::atan;
  using std::cos;
  using std::exp;
  using std::log;
  using std::pow;
  using std::sin;
  using std::sqrt;
  using Number = std::conditional_t<std::is_same_v<T, long double>, long double, double>;
  const auto x = static_cast<Number>(at.front());
  const Number one = 1;
  const Number pi = std::numbers::pi_v<Number>;
  if (name == "Misra1a" || name == "BoxBOD") return b[0] * (one - exp(-b[1] * x));
  if (name == "Misra1b") {
    const T root = one + b[1] * x / Number(2);
    return b[0] * (one - one / (root * root));
  }
  if (name == "Misra1c") return b[0] * (one - one / sqrt(one + Number(2) * b[1] * x));
  if (name == "Misra1d") return b[0] * b[1] * x / (one + b[1] * x);
  if (name == "Chwirut1" || name == "Chwirut2") return exp(-b[0] * x) / (b[1] + b[2] * x);
  if (name == "DanWood") return b[0] * exp(b[1] * log(x));
  if (name.starts_with("Lanczos")) return b[0] * exp(-b[1] * x) + b[2] * exp(-b[3] * x) + b[4] * exp(-b[5] * x);
  if (name.starts_with("Gauss")) {
    const T u = (x - b[3]) / b[4];
    const T v = (x - b[6]) / b[7];
    return b[0] * exp(-b[1] * x) + b[2] * exp(-u * u) + b[5] * exp(-v * v);
  }
  if (name == "Kirby2") return (b[0] + b[1] * x + b[2] * x * x) / (one + b[3] * x + b[4] * x * x);
  if (name == "Hahn1" || name == "Thurber") {
    return (b[0] + b[1] * x + b[2] * x * x + b[3] * x * x * x) / (one + b[4] * x + b[5] * x * x + b[6] * x * x * x);
  }
  if (name == "Nelson") return b[0] - b[1] * x * exp(-b[2] * static_cast<Number>(at[1]));
  if (name == "MGH09") return b[0] * (x * x + x * b[1]) / (x * x + x * b[2] + b[3]);
  if (name == "MGH10") return b[0] * exp(b[1] / (x + b[2]));
  if (name == "MGH17") return b[0] + b[1] * exp(-x * b[3]) + b[2] * exp(-x * b[4]);
  if (name == "Rat42") return b[0] / (one + exp(b[1] - b[2] * x));
  if (name == "Rat43") return b[0] / exp(log(one + exp(b[1] - b[2] * x)) / b[3]);
  if (name == "Roszman1") return b[0] - b[1] * x - atan(b[2] / (x - b[3])) / pi;
  if (name == "Bennett5") return b[0] * exp(-log(b[1] + x) / b[2]);
  if (name == "Eckerle4") {
    const T u = (x - b[2]) / b[1];
    return b[0] / b[1] * exp(Number(-0.5) * u * u);
  }
  if (name == "ENSO") {
    const Number year = Number(2) * pi * x / Number(12);
    const T second = Number(2) * pi * x / b[3];
    const T third = Number(2) * pi * x / b[6];
    return b[0] + b[1] * cos(year) + b[2] * sin(year) + b[4] * cos(second) + b[5] * sin(second) + b[7] * cos(third) +
           b[8] * sin(third);
  }
  throw std::runtime_error("no model of " + name);
}

/// What is fitted: the response, or its logarithm where NIST's model says so.
inline long double nist_response(const NistProblem& problem, std::size_t i) {
  return problem.name == "Nelson" ? std::log(problem.response[i]) : problem.response[i];
}

/// Residuals in extended precision, then rounded; exact derivatives in double.
inline math::LeastSquaresProblem least_squares(const NistProblem& nist) {
  math::LeastSquaresProblem problem;
  problem.residual_count = static_cast<Eigen::Index>(nist.response.size());
  problem.evaluate = [&nist](const Eigen::VectorXd& b, Eigen::VectorXd& r, Eigen::MatrixXd* jacobian) {
    const std::vector<long double> exact(b.data(), b.data() + b.size());
    std::vector<NistJet> jets;
    for (Eigen::Index j = 0; j < b.size(); ++j) jets.emplace_back(b[j], static_cast<int>(j));
    for (std::size_t i = 0; i < nist.response.size(); ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      r[row] = static_cast<double>(nist_model(nist.name, exact, nist.predictors[i]) - nist_response(nist, i));
      if (jacobian != nullptr)
        jacobian->row(row) = nist_model(nist.name, jets, nist.predictors[i]).v.head(b.size()).transpose();
    }
  };
  return problem;
}

/// Names of all problems, in NIST's order of difficulty.
inline const std::vector<std::string>& nist_names() {
  static const std::vector<std::string> names{
      "Misra1a", "Chwirut2", "Chwirut1", "Lanczos3", "Gauss1",   "Gauss2", "DanWood",  "Misra1b", "Kirby2",
      "Hahn1",   "Nelson",   "MGH17",    "Lanczos1", "Lanczos2", "Gauss3", "Misra1c",  "Misra1d", "Roszman1",
      "ENSO",    "MGH09",    "Thurber",  "BoxBOD",   "Rat42",    "MGH10",  "Eckerle4", "Rat43",   "Bennett5"};
  return names;
}

}  // namespace myoid::test
