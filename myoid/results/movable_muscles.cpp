#include "myoid/results/movable_muscles.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "myoid/fit/measurement/parameter_fields.h"
#include "myoid/ground/core/index.h"
#include "myoid/page/typeset.h"
#include "myoid/run/log_covariance.h"

namespace myoid::results {
namespace {

using fit::IdentificationResult;

/// Returns the names of a muscle's numbers in the order of fit::MuscleField.
std::vector<std::string> field_names() {
  std::vector<std::string> names(fit::kMuscleFieldCount);
  for (const fit::ParameterField& field : fit::parameter_fields()) {
    if (field.scope == fit::Scope::muscle && field.field >= 0 && field.field < fit::kMuscleFieldCount)
      names[at(field.field)] = std::string(field.name);
  }
  return names;
}

/// Returns draws of a muscle's numbers; a held number is the same in all draws. For an unknown that
/// several muscles share, the fit has the first muscle's value; the others keep their ratio to it.
Eigen::MatrixXd draws_of(const IdentificationResult& fit,
                         const std::vector<fit::MuscleSetup>& muscles,
                         std::size_t m,
                         const std::vector<page::MovableNumber>& numbers,
                         const std::vector<std::string>& fields) {
  Eigen::MatrixXd draws(static_cast<Eigen::Index>(numbers.size()), fit.draws.cols());
  for (Eigen::Index k = 0; k < draws.rows(); ++k) {
    const std::size_t f = at(numbers[at(k)].field);
    const double found = fit.values.muscles[m][f];
    draws.row(k).setConstant(found);
    const std::optional<Eigen::Index> row = run::unknown_of(fit, muscles[m].name, fields[f]);
    if (!row || *row >= fit.draws.rows()) continue;
    const std::string& label = fit.free_parameters[at(*row)];
    const std::string first = label.substr(0, label.find_first_of("+."));
    for (std::size_t owner = 0; owner < muscles.size(); ++owner)
      if (muscles[owner].name == first) draws.row(k) = found / fit.values.muscles[owner][f] * fit.draws.row(*row);
  }
  return draws;
}

page::MovableMuscle movable(const IdentificationResult& fit,
                            const std::vector<fit::MuscleSetup>& muscles,
                            std::size_t m,
                            const std::vector<std::string>& fields) {
  const fit::MuscleSetup& setup = muscles[m];
  const fit::MuscleValues start = fit::muscle_values(setup.start, setup.extras);
  const fit::MuscleValues& found = fit.values.muscles[m];
  page::MovableMuscle muscle{setup.name, {start.begin(), start.end()}, {found.begin(), found.end()}};
  std::vector<std::string> names;
  for (const int field : {fit::kFiberLength, fit::kWidth, fit::kMaxForce}) {
    const std::size_t f = at(field);
    names.push_back(fields[f]);
    std::string verdict;
    for (const fit::ParameterEstimate& e : fit.estimates) {
      if (e.muscle != setup.name || e.parameter != fields[f]) continue;
      verdict = page::spelled(fit::name(e.verdict));
      if (e.prior_mean) muscle.literature[f] = *e.prior_mean;
    }
    page::MovableNumber number{.field = field,
                               .name = page::spelled(fields[f]),
                               .unit = std::string(symbol(fit::parameter_field(fields[f]).unit)),
                               .lower = 0.5 * std::min(muscle.literature[f], found[f]),
                               .upper = 1.6 * std::max(muscle.literature[f], found[f]),
                               .sd_log = 0.0,
                               .verdict = std::move(verdict)};
    muscle.numbers.push_back(std::move(number));
  }
  const Eigen::MatrixXd covariance = run::log_covariance(fit, setup.name, names);
  const Eigen::VectorXd sd = covariance.diagonal().cwiseSqrt();
  muscle.correlation = Eigen::MatrixXd::Identity(sd.size(), sd.size());
  for (Eigen::Index i = 0; i < sd.size(); ++i) {
    muscle.numbers[at(i)].sd_log = sd[i];
    for (Eigen::Index j = 0; j < sd.size(); ++j)
      if (i != j && sd[i] > 0.0 && sd[j] > 0.0) muscle.correlation(i, j) = covariance(i, j) / (sd[i] * sd[j]);
  }
  if (fit.draws.size() > 0) {
    muscle.draws = draws_of(fit, muscles, m, muscle.numbers, fields);
    muscle.draw_weights = fit.draw_weights;
  }
  return muscle;
}

}  // namespace

void add_movable_muscles(const IdentificationResult& fit,
                         const std::vector<fit::MuscleSetup>& muscles,
                         page::Workbench& workbench) {
  workbench.fields = field_names();
  for (std::size_t m = 0; m < muscles.size(); ++m)
    workbench.muscles.push_back(movable(fit, muscles, m, workbench.fields));
}

}  // namespace myoid::results
