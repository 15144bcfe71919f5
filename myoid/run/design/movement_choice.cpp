#include "myoid/run/design/movement_choice.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Cholesky>
#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/parallel.h"

namespace myoid::run {
namespace {

constexpr double kLeastFeasible = 0.8;  ///< Share of the persons who must be able to do a movement.

/// The information gathered so far, per person.
using Gathered = std::vector<Eigen::MatrixXd>;

class Designer {
 public:
  Designer(const DesignProblem& problem, const DesignOptions& options) : problem_(problem), options_(options) {
    const auto p = static_cast<Eigen::Index>(problem.parameters.size());
    if (problem.prior_precision.rows() != p || problem.prior_precision.cols() != p)
      throw InvalidInput("design: the prior's precision does not have one row per parameter");
    if (problem.targets.empty()) throw InvalidInput("design: there is no target parameter");
    if (problem.catalogue.empty()) throw InvalidInput("design: the catalogue is empty");
    persons_ = problem.catalogue.front().per_person.size();
    for (const MovementInformation& movement : problem.catalogue) {
      if (movement.per_person.size() != persons_ || persons_ == 0)
        throw InvalidInput(fmt::format("design: movement '{}' is not given for every person", movement.name));
      std::size_t able = 0;
      for (const Eigen::MatrixXd& m : movement.per_person) {
        if (m.size() == 0) continue;
        if (m.rows() != p || m.cols() != p)
          throw InvalidInput(fmt::format("design: the information of '{}' has the wrong size", movement.name));
        ++able;
      }
      feasible_.push_back(able > 0 && static_cast<double>(able) >= kLeastFeasible * static_cast<double>(persons_));
    }
    if (std::none_of(feasible_.begin(), feasible_.end(), [](bool f) { return f; }))
      throw InvalidInput("design: no movement of the catalogue can be done by these persons");
    prior_ = covariance(problem.prior_precision);
  }

  [[nodiscard]] DesignResult choose() {
    DesignResult result;
    result.prior_sd = prior_.diagonal().cwiseSqrt();
    result.prior_criterion = criterion_of(prior_);
    for (std::size_t m = 0; m < feasible_.size(); ++m) {
      if (!feasible_[m]) result.infeasible.push_back(m);
    }
    std::vector<std::size_t> chosen;
    while (static_cast<int>(chosen.size()) < options_.movements) {
      const auto [best, value] = best_addition(chosen, gathered(chosen));
      if (best == problem_.catalogue.size()) break;
      chosen.push_back(best);
    }
    result.exchanges = exchange(chosen);
    result.steps = ordered(chosen);
    return result;
  }

 private:
  [[nodiscard]] static Eigen::MatrixXd covariance(const Eigen::MatrixXd& precision) {
    const Eigen::LLT<Eigen::MatrixXd> factor(precision);
    if (factor.info() != Eigen::Success) throw InvalidInput("design: the prior's precision is not positive definite");
    return factor.solve(Eigen::MatrixXd::Identity(precision.rows(), precision.cols()));
  }

  [[nodiscard]] double criterion_of(const Eigen::MatrixXd& s) const {
    if (options_.criterion == DesignCriterion::a_optimal) {
      double sum = 0.0;
      for (const Eigen::Index j : problem_.targets) sum += s(j, j) / prior_(j, j);
      return sum;
    }
    const Eigen::LLT<Eigen::MatrixXd> factor(s(problem_.targets, problem_.targets));
    return 2.0 * factor.matrixLLT().diagonal().array().log().sum();
  }

  [[nodiscard]] Gathered gathered(const std::vector<std::size_t>& chosen) const {
    Gathered sum(persons_, problem_.prior_precision);
    for (const std::size_t m : chosen) add(m, sum);
    return sum;
  }

  void add(std::size_t movement, Gathered& sum) const {
    for (std::size_t person = 0; person < persons_; ++person) {
      const Eigen::MatrixXd& m = problem_.catalogue[movement].per_person[person];
      if (m.size() > 0) sum[person] += m;
    }
  }

  [[nodiscard]] double mean_criterion(const Gathered& information) const {
    double sum = 0.0;
    for (const Eigen::MatrixXd& precision : information) sum += criterion_of(covariance(precision));
    return sum / static_cast<double>(persons_);
  }

  [[nodiscard]] double duration_s(const std::vector<std::size_t>& chosen) const {
    double sum = 0.0;
    for (const std::size_t m : chosen) sum += problem_.catalogue[m].duration_s;
    return sum;
  }

  /// Returns the movement that lowers the criterion most, and the criterion with it; the
  /// catalogue's size if no movement may be added.
  [[nodiscard]] std::pair<std::size_t, double> best_addition(const std::vector<std::size_t>& chosen,
                                                             const Gathered& information) const {
    const std::size_t count = problem_.catalogue.size();
    std::vector<double> value(count, std::numeric_limits<double>::infinity());
    const double spent = duration_s(chosen);
    parallel_each(count, [&](std::size_t m) {
      if (!feasible_[m] || std::count(chosen.begin(), chosen.end(), m) >= options_.most_of_each ||
          (options_.budget_s && spent + problem_.catalogue[m].duration_s > *options_.budget_s))
        return;
      Gathered with = information;
      add(m, with);
      value[m] = mean_criterion(with);
    });
    const auto best = std::min_element(value.begin(), value.end());
    if (!std::isfinite(*best)) return {count, *best};
    return {static_cast<std::size_t>(best - value.begin()), *best};
  }

  int exchange(std::vector<std::size_t>& chosen) const {
    int exchanges = 0;
    double current = mean_criterion(gathered(chosen));
    bool improved = true;
    while (improved && exchanges < 100) {
      improved = false;
      for (std::size_t i = 0; i < chosen.size(); ++i) {
        std::vector<std::size_t> rest = chosen;
        rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(i));
        const auto [best, value] = best_addition(rest, gathered(rest));
        if (best == problem_.catalogue.size() || best == chosen[i]) continue;
        if (value < current - 1e-9 * (1.0 + std::abs(current))) {
          chosen[i] = best;
          current = value;
          ++exchanges;
          improved = true;
        }
      }
    }
    return exchanges;
  }

  /// Orders the chosen movements, the most informative first.
  [[nodiscard]] std::vector<DesignStep> ordered(std::vector<std::size_t> chosen) const {
    std::vector<DesignStep> steps;
    Gathered information(persons_, problem_.prior_precision);
    while (!chosen.empty()) {
      std::size_t best = 0;
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < chosen.size(); ++i) {
        Gathered with = information;
        add(chosen[i], with);
        const double value = mean_criterion(with);
        if (value < least) {
          least = value;
          best = i;
        }
      }
      add(chosen[best], information);
      DesignStep step{chosen[best], least, Eigen::VectorXd::Zero(prior_.rows())};
      for (const Eigen::MatrixXd& precision : information)
        step.sd += covariance(precision).diagonal() / static_cast<double>(persons_);
      step.sd = step.sd.cwiseSqrt().eval();
      steps.push_back(std::move(step));
      chosen.erase(chosen.begin() + static_cast<std::ptrdiff_t>(best));
    }
    return steps;
  }

  const DesignProblem& problem_;
  const DesignOptions& options_;
  std::size_t persons_ = 0;
  std::vector<bool> feasible_;
  Eigen::MatrixXd prior_;
};

}  // namespace

DesignResult choose_movements(const DesignProblem& problem, const DesignOptions& options) {
  return Designer(problem, options).choose();
}

}  // namespace myoid::run
