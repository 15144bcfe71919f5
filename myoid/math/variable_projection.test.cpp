#include "myoid/math/variable_projection.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include <Eigen/QR>
#include <gtest/gtest.h>

#include "myoid/core/error.h"
#include "myoid/math/covariance.h"
#include "myoid/math/random.h"

#include "tests/support/nist_problems.h"

namespace myoid::math {
namespace {

using test::NistJet;
using test::NistProblem;

/// Which parameters enter NIST's models linearly (Chwirut has none; Roszman1 a part without any).
const std::map<std::string, std::vector<int>>& linear_parameters() {
  static const std::map<std::string, std::vector<int>> map{
      {"Misra1a", {0}},        {"Misra1b", {0}},        {"Misra1c", {0}},
      {"Misra1d", {0}},        {"BoxBOD", {0}},         {"DanWood", {0}},
      {"MGH09", {0}},          {"MGH10", {0}},          {"Rat42", {0}},
      {"Rat43", {0}},          {"Bennett5", {0}},       {"Eckerle4", {0}},
      {"Lanczos1", {0, 2, 4}}, {"Lanczos2", {0, 2, 4}}, {"Lanczos3", {0, 2, 4}},
      {"Gauss1", {0, 2, 5}},   {"Gauss2", {0, 2, 5}},   {"Gauss3", {0, 2, 5}},
      {"Kirby2", {0, 1, 2}},   {"Hahn1", {0, 1, 2, 3}}, {"Thurber", {0, 1, 2, 3}},
      {"Nelson", {0, 1}},      {"MGH17", {0, 1, 2}},    {"ENSO", {0, 1, 2, 4, 5, 7, 8}}};
  return map;
}

struct Separated {
  SeparableProblem problem;
  std::vector<int> order;  ///< NIST's index of each parameter, linear ones first.
  Eigen::Index linear = 0;

  [[nodiscard]] Eigen::VectorXd nonlinear(const Eigen::VectorXd& b) const {
    Eigen::VectorXd a(b.size() - linear);
    for (Eigen::Index j = 0; j < a.size(); ++j)
      a[j] = b[order[static_cast<std::size_t>(linear + j)]];
    return a;
  }
};

/// Column k of the basis is the model with c = e_k, its derivatives those of the Jets.
Separated separated(const NistProblem& nist) {
  Separated result;
  result.order = linear_parameters().at(nist.name);
  result.linear = static_cast<Eigen::Index>(result.order.size());
  for (int j = 0; j < static_cast<int>(nist.certified.size()); ++j) {
    if (std::find(result.order.begin(), result.order.begin() + result.linear, j) ==
        result.order.begin() + result.linear)
      result.order.push_back(j);
  }
  const auto n = static_cast<Eigen::Index>(nist.response.size());
  result.problem.linear_count = result.linear;
  result.problem.response.resize(n);
  for (std::size_t i = 0; i < nist.response.size(); ++i)
    result.problem.response[static_cast<Eigen::Index>(i)] =
        static_cast<double>(test::nist_response(nist, i));
  result.problem.basis = [&nist, order = result.order, linear = result.linear](
                             const Eigen::VectorXd& a, Eigen::MatrixXd& basis,
                             std::vector<Eigen::MatrixXd>* derivatives) {
    for (Eigen::Index k = 0; k < linear; ++k) {
      std::vector<NistJet> b(order.size(), NistJet(0.0));
      b[static_cast<std::size_t>(order[static_cast<std::size_t>(k)])] = NistJet(1.0);
      for (Eigen::Index j = 0; j < a.size(); ++j) {
        b[static_cast<std::size_t>(order[static_cast<std::size_t>(linear + j)])] =
            NistJet(a[j], static_cast<int>(j));
      }
      for (Eigen::Index i = 0; i < basis.rows(); ++i) {
        const NistJet value =
            test::nist_model(nist.name, b, nist.predictors[static_cast<std::size_t>(i)]);
        basis(i, k) = value.a;
        if (derivatives == nullptr) continue;
        for (Eigen::Index j = 0; j < a.size(); ++j)
          (*derivatives)[static_cast<std::size_t>(j)](i, k) = value.v[j];
      }
    }
  };
  return result;
}

/// Exponentials that exchanged their names are the same model: brings them back to NIST's order.
void order_exponentials(const std::string& name, VariableProjectionResult& fit) {
  const Eigen::Index rates = fit.search.x.size();
  const Eigen::Index before = fit.linear.size() - rates;  // MGH17 has a constant in front
  std::vector<Eigen::Index> order(static_cast<std::size_t>(rates));
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = static_cast<Eigen::Index>(k);
  std::sort(order.begin(), order.end(),
            [&](Eigen::Index a, Eigen::Index b) { return fit.search.x[a] < fit.search.x[b]; });
  const VariableProjectionResult found = fit;
  for (std::size_t k = 0; k < order.size(); ++k) {
    const auto to = static_cast<Eigen::Index>(k);
    fit.search.x[to] = found.search.x[order[k]];
    fit.linear[before + to] = found.linear[before + order[k]];
    fit.jacobian.col(before + to) = found.jacobian.col(before + order[k]);
    const Eigen::Index first = fit.linear.size();
    fit.jacobian.col(first + to) = found.jacobian.col(first + order[k]);
  }
  ASSERT_TRUE(name == "MGH17" || name.starts_with("Lanczos"));
}

TEST(VariableProjection, FindsNistsCertifiedParametersAndDeviationsWithoutLinearStarts) {
  for (const auto& [name, linear] : linear_parameters()) {
    const NistProblem nist = test::read_nist(name);
    Separated split = separated(nist);
    // Without its amplitude, MGH10's far start leads through infinity to b3 < 0, where the same
    // decay costs 1.0e6 and the amplitude overflows: b3 is kept positive.
    if (name == "MGH10") split.problem.lower = Eigen::Vector2d::Zero();
    // Lanczos1's response, rounded to double, is a thousandth of its residuals off.
    const double wanted_deviation = name == "Lanczos1" ? 2.5 : 6.0;
    for (std::size_t s = 0; s < 2; ++s) {
      for (const ProjectionJacobian kind :
           {ProjectionJacobian::golub_pereyra, ProjectionJacobian::kaufman}) {
        VariableProjectionResult fit =
            variable_projection(split.problem, split.nonlinear(nist.starts[s]),
                                {.jacobian = kind, .search = {.max_iterations = 2000}});
        const std::string where = name + " start " + std::to_string(s + 1) +
                                  (kind == ProjectionJacobian::kaufman ? " K" : " GP");
        EXPECT_EQ(fit.search.termination, Termination::converged) << where;
        if (name == "MGH17" || name.starts_with("Lanczos")) order_exponentials(name, fit);
        const CovarianceResult spread =
            covariance(fit.jacobian, fit.search.residual, {.rank_tolerance = 1e-14});
        for (Eigen::Index k = 0; k < nist.certified.size(); ++k) {
          const int j = split.order[static_cast<std::size_t>(k)];
          const double found = k < split.linear ? fit.linear[k] : fit.search.x[k - split.linear];
          EXPECT_GE(test::correct_digits(found, nist.certified[j]), 6.0) << where << " b" << j + 1;
          const double deviation = std::sqrt(spread.unscaled(k, k) * spread.residual_variance);
          EXPECT_GE(test::correct_digits(deviation, nist.standard_deviation[j]), wanted_deviation)
              << where << " sd of b" << j + 1;
        }
      }
    }
  }
}

TEST(VariableProjection, ItsJacobianIsTheDerivativeOfItsResidualKaufmansHasTheSameGradient) {
  for (const char* name : {"Gauss1", "Lanczos3", "ENSO", "Hahn1", "Misra1a"}) {
    const NistProblem nist = test::read_nist(name);
    const Separated split = separated(nist);
    const Eigen::VectorXd a = 1.02 * split.nonlinear(nist.certified);
    const LeastSquaresProblem full = reduced_problem(split.problem, a.size());
    const LeastSquaresProblem kaufman =
        reduced_problem(split.problem, a.size(), {.jacobian = ProjectionJacobian::kaufman});
    Eigen::VectorXd r(full.residual_count), other(full.residual_count);
    Eigen::MatrixXd j(full.residual_count, a.size()), k(full.residual_count, a.size());
    full.evaluate(a, r, &j);
    kaufman.evaluate(a, other, &k);
    EXPECT_EQ(r, other);
    for (Eigen::Index p = 0; p < a.size(); ++p) {
      // Central difference: h^2 truncation 1e-10, round-off of r 1e-12 over h 1e-5.
      const double h = 1e-5 * std::abs(a[p]);
      Eigen::VectorXd up(full.residual_count), down(full.residual_count);
      Eigen::VectorXd at = a;
      at[p] = a[p] + h;
      full.evaluate(at, up, nullptr);
      at[p] = a[p] - h;
      full.evaluate(at, down, nullptr);
      const Eigen::VectorXd difference = (up - down) / (2.0 * h);
      EXPECT_LT((j.col(p) - difference).norm(), 1e-6 * difference.norm()) << name << " " << p;
    }
    const Eigen::VectorXd gradient = j.transpose() * r;
    EXPECT_LT((k.transpose() * r - gradient).norm(),
              1e-9 * j.colwise().norm().maxCoeff() * r.norm())
        << name;
    EXPECT_GT((j - k).norm(), 1e-9 * j.norm()) << name;  // they are two
  }
}

TEST(VariableProjection, NonnegativeCoefficientsAreTheBestOfAllSubsets) {
  // Brute force: unbounded solutions of all 2^4 subsets of columns, the best with c >= 0.
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    Random random(seed);
    Eigen::MatrixXd basis(12, 4);
    Eigen::VectorXd y(12);
    for (Eigen::Index i = 0; i < 12; ++i) {
      for (Eigen::Index k = 0; k < 4; ++k) basis(i, k) = random.normal() + 3.0;  // much alike
      y[i] = random.normal() + basis(i, 0) - 0.7 * basis(i, 1) + 0.5 * basis(i, 2);
    }
    double least = y.squaredNorm();
    for (unsigned subset = 1; subset < 16; ++subset) {
      Eigen::MatrixXd columns(12, 0);
      for (Eigen::Index k = 0; k < 4; ++k) {
        if (!((subset >> k) & 1U)) continue;
        columns.conservativeResize(Eigen::NoChange, columns.cols() + 1);
        columns.rightCols(1) = basis.col(k);
      }
      const Eigen::VectorXd c = columns.colPivHouseholderQr().solve(y);
      if ((c.array() >= 0.0).all()) least = std::min(least, (columns * c - y).squaredNorm());
    }
    const Projection found = project(basis, y, true);
    EXPECT_GE(found.linear.minCoeff(), 0.0);
    EXPECT_NEAR(found.residual.squaredNorm(), least, 1e-12) << seed;
  }
}

TEST(VariableProjection, ACoefficientThatWouldBeNegativeIsZeroAndTheRestIsRefitted) {
  // y = 3 e^(-x): with a second exponential, unbounded, any; with c >= 0 and noise-free data the
  // first alone. The rates stay where the data put them.
  SeparableProblem problem;
  problem.linear_count = 2;
  problem.nonnegative = true;
  problem.lower = Eigen::VectorXd::Constant(1, 0.0);
  problem.upper = Eigen::VectorXd::Constant(1, 10.0);
  problem.response.resize(20);
  for (Eigen::Index i = 0; i < 20; ++i)
    problem.response[i] = 3.0 * std::exp(-0.1 * static_cast<double>(i)) - 0.01;
  problem.basis = [](const Eigen::VectorXd& a, Eigen::MatrixXd& basis,
                     std::vector<Eigen::MatrixXd>* derivatives) {
    for (Eigen::Index i = 0; i < 20; ++i) {
      const double x = 0.1 * static_cast<double>(i);
      basis(i, 0) = std::exp(-a[0] * x);
      basis(i, 1) = 1.0;  // the best constant is -0.01: not allowed
      if (derivatives != nullptr) (*derivatives)[0](i, 0) = -x * basis(i, 0);
    }
  };
  const VariableProjectionResult fit =
      variable_projection(problem, Eigen::VectorXd::Constant(1, 0.5));
  EXPECT_EQ(fit.search.termination, Termination::converged);
  EXPECT_EQ(fit.linear[1], 0.0);
  EXPECT_NEAR(fit.linear[0], 3.0, 0.02);
  problem.nonnegative = false;
  const VariableProjectionResult free =
      variable_projection(problem, Eigen::VectorXd::Constant(1, 0.5));
  EXPECT_NEAR(free.linear[0], 3.0, 1e-9);
  EXPECT_NEAR(free.linear[1], -0.01, 1e-9);
  EXPECT_NEAR(free.search.x[0], 1.0, 1e-9);
}

TEST(VariableProjection, TwoColumnsThatAreOneLowerTheRank) {
  Eigen::MatrixXd basis(4, 2);
  basis << 1, 2, 2, 4, 3, 6, 4, 8;
  const Projection found = project(basis, Eigen::Vector4d(2, 4, 6, 8), false);
  EXPECT_EQ(found.rank, 1);
  EXPECT_LT(found.residual.norm(), 1e-13);
  EXPECT_NEAR(found.linear[0], 2.0 * found.linear[1], 1e-12);  // equal shares in scaled columns
}

TEST(VariableProjection, RefusesSizesThatDisagree) {
  EXPECT_THROW((void)project(Eigen::MatrixXd::Ones(3, 1), Eigen::VectorXd::Ones(4), false),
               InvalidInput);
  EXPECT_THROW(
      (void)project(Eigen::MatrixXd::Constant(3, 1, std::nan("")), Eigen::VectorXd::Ones(3), false),
      InvalidInput);
  EXPECT_THROW((void)variable_projection({}, Eigen::VectorXd::Ones(1)), InvalidInput);
}

}  // namespace
}  // namespace myoid::math
