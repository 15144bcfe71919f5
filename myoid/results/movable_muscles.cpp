#include "myoid/results/movable_muscles.h"

#include <algorithm>
#include <string>

#include "myoid/identification/parameter_fields.h"
#include "myoid/report/typeset.h"
#include "myoid/results/log_covariance.h"

namespace myoid {
namespace {

using identification::IdentificationResult;

/// The names of a muscle's numbers in the order of identification::MuscleField.
std::vector<std::string> field_names() {
  std::vector<std::string> names(identification::kMuscleFieldCount);
  for (const identification::ParameterField& field : identification::parameter_fields()) {
    if (field.scope == identification::Scope::muscle && field.field >= 0 &&
        field.field < identification::kMuscleFieldCount)
      names[static_cast<std::size_t>(field.field)] = std::string(field.name);
  }
  return names;
}

report::MovableMuscle movable(const IdentificationResult& fit,
                              const identification::MuscleSetup& setup,
                              std::size_t m,
                              const std::vector<std::string>& fields) {
  const identification::MuscleValues start =
      identification::muscle_values(setup.start, setup.extras);
  const identification::MuscleValues& found = fit.values.muscles[m];
  report::MovableMuscle muscle{
      setup.name, {start.begin(), start.end()}, {found.begin(), found.end()}, {}, {}};
  std::vector<std::string> names;
  for (const int field :
       {identification::kFiberLength, identification::kWidth, identification::kMaxForce}) {
    const auto f = static_cast<std::size_t>(field);
    names.push_back(fields[f]);
    report::MovableNumber number{
        .field = field,
        .name = report::spelled(fields[f]),
        .unit = std::string(symbol(identification::parameter_field(fields[f]).unit)),
        .lower = 0.5 * std::min(start[f], found[f]),
        .upper = 1.6 * std::max(start[f], found[f]),
        .sd_log = 0.0,
        .verdict = ""};
    for (const identification::ParameterEstimate& e : fit.estimates) {
      if (e.muscle == setup.name && e.parameter == fields[f])
        number.verdict = report::spelled(identification::name(e.verdict));
    }
    muscle.numbers.push_back(std::move(number));
  }
  const Eigen::MatrixXd covariance = log_covariance(fit, setup.name, names);
  const Eigen::VectorXd sd = covariance.diagonal().cwiseSqrt();
  muscle.correlation = Eigen::MatrixXd::Identity(sd.size(), sd.size());
  for (Eigen::Index i = 0; i < sd.size(); ++i) {
    muscle.numbers[static_cast<std::size_t>(i)].sd_log = sd[i];
    for (Eigen::Index j = 0; j < sd.size(); ++j)
      if (i != j && sd[i] > 0.0 && sd[j] > 0.0)
        muscle.correlation(i, j) = covariance(i, j) / (sd[i] * sd[j]);
  }
  return muscle;
}

}  // namespace

void add_movable_muscles(const IdentificationResult& fit,
                         const std::vector<identification::MuscleSetup>& muscles,
                         report::Workbench& workbench) {
  workbench.fields = field_names();
  for (std::size_t m = 0; m < muscles.size(); ++m)
    workbench.muscles.push_back(movable(fit, muscles[m], m, workbench.fields));
}

}  // namespace myoid
