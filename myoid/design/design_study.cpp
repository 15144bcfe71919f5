#include "myoid/design/design_study.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>

#include "myoid/core/error.h"
#include "myoid/design/design_fatigue.h"
#include "myoid/design/design_knowledge.h"
#include "myoid/identification/residual_model.h"
#include "myoid/intervals/identifiability.h"
#include "myoid/muscle/fatigue.h"
#include "myoid/simulation/random.h"
#include "myoid/study/study_model.h"

namespace myoid {
namespace {

using identification::EstimatorOptions;
using identification::ParameterEstimate;
using identification::ResidualModel;
using identification::StudyData;
using identification::TrialData;
using identification::Unknown;

/// J' W J nu of one trial at the truth: the estimator's weights and effective number of samples.
Eigen::MatrixXd information_of(const StudyData& data,
                               const EstimatorOptions& torque,
                               const Eigen::VectorXd& z,
                               double torque_sd_nm,
                               double emg_cv) {
  const ResidualModel model(data, torque);
  identification::Evaluation at;
  model.evaluate(z, ResidualModel::Depth::noise, at);
  const Eigen::ArrayXd power = at.channel_torque.colwise().squaredNorm().transpose();
  const Eigen::VectorXd weight = (torque_sd_nm * torque_sd_nm + emg_cv * emg_cv * power).inverse();
  const double share = std::min(1.0, 2.0 * torque.residual_cutoff_hz.value() / model.rate_hz());
  return share * at.gradient * weight.asDiagonal() * at.gradient.transpose();
}

}  // namespace

double relative_half_width(const ParameterEstimate& estimate) {
  const double half = identification::half_width(estimate);
  if (estimate.parameter == "emg_delay") return 1e3 * half;
  const bool zero = identification::zero_by_nature(estimate.parameter) && estimate.prior_sd;
  return 100.0 * half / (zero ? 1.96 * *estimate.prior_sd : std::abs(estimate.estimate));
}

int identified_count(const std::vector<ParameterEstimate>& estimates) {
  return static_cast<int>(std::count_if(estimates.begin(), estimates.end(), [](const auto& e) {
    return e.verdict == identification::Verdict::identified;
  }));
}

double median_half_width(const std::vector<ParameterEstimate>& estimates) {
  std::vector<double> widths;
  for (const ParameterEstimate& e : estimates) {
    const bool of_value =
        e.parameter != "emg_delay" && !identification::zero_by_nature(e.parameter);
    if (of_value || estimates.size() == 1) widths.push_back(relative_half_width(e));
  }
  if (widths.empty()) return 0.0;
  const auto middle = widths.begin() + static_cast<std::ptrdiff_t>(widths.size() / 2);
  std::nth_element(widths.begin(), middle, widths.end());
  return *middle;
}

DesignStudyResult design_study(const Study& study, const DesignStudyOptions& options) {
  return design_study(study, load_model(study), options);
}

DesignStudyResult design_study(const Study& study,
                               const model::BodyModel& model,
                               const DesignStudyOptions& options) {
  StudyData data;
  data.muscles = muscle_setups(study, model);
  if (data.muscles.empty()) throw InvalidInput("design: the study has no [[muscle]]");
  identification::free_speeds(data, identification::unstated_speeds(data, study.identify.muscles));
  EstimatorOptions torque;
  torque.muscles = study.identify.muscles;
  torque.delay_s = study.emg.delay_s;
  torque.max_rate_hz = 25.0;
  for (const identification::MuscleSetup& m : data.muscles)
    torque.gain_prior_sd[m.emg_channel] = options.gain_sd;

  const model::Coordinate& coordinate =
      model.coordinates[static_cast<std::size_t>(model.coordinate_index(study.model.coordinate))];
  CatalogueOptions catalogue_options = options.catalogue;
  catalogue_options.coordinate = coordinate.name;
  catalogue_options.planes = catalogue_options.planes && !study.model.file;
  if (study.model.file && !study.model.held_mass) catalogue_options.held_masses_kg = {0.0};
  const std::vector<Movement> movements =
      movement_catalogue(coordinate.lower, coordinate.upper, catalogue_options);

  options.progress.tell(0.05, "movements");
  const MovementModels models = movement_models(study, model);
  std::vector<MovementCourse> courses(movements.size());
  oneapi::tbb::parallel_for(std::size_t{0}, movements.size(), [&](std::size_t i) {
    options.progress.check();
    courses[i] = movement_course(study, models, movements[i]);
  });

  // The estimator's parameters: from any trial that someone can do.
  const auto person_of = [&](const identification::ModelValues& values, int k) {
    MovementPerson person;
    person.muscles = values.muscles;
    person.emg_delay_s = values.channels.empty() ? person.emg_delay_s
                                                 : values.channels.front()[identification::kDelay];
    person.seed = simulation::seed_for(options.seed, fmt::format("person {}", k));
    return person;
  };
  identification::ModelValues start;
  for (const identification::MuscleSetup& m : data.muscles)
    start.muscles.push_back(identification::muscle_values(m.start, m.extras));
  std::optional<ResidualModel> shape;
  for (std::size_t i = 0; i < courses.size() && !shape; ++i) {
    if (auto trial = perform(courses[i], data.muscles, person_of(start, 0))) {
      data.trials = {std::move(*trial)};
      shape.emplace(data, torque);
    }
  }
  DesignStudyResult result;
  result.catalogue_size = movements.size();
  if (!shape) {
    result.too_hard = movements.size();
    return result;
  }
  const std::vector<Unknown> free = shape->parameters().free();
  const Knowledge known = knowledge_of(free, options.earlier);
  const std::vector<Eigen::VectorXd> persons =
      draw_persons(free, known, options.persons, options.seed);
  const double torque_sd = options.earlier && options.earlier->torque_sd_nm > 1e-3
                               ? options.earlier->torque_sd_nm
                               : options.torque_sd_nm;
  const double emg_cv = options.earlier && options.earlier->torque_sd_nm > 1e-3
                            ? options.earlier->emg_cv
                            : options.emg_cv;

  options.progress.tell(0.2, "information");
  identification::DesignProblem problem;
  for (const Unknown& f : free) problem.parameters.push_back(f.label);
  problem.prior_precision = known.precision;
  problem.targets = targets_of(free, options.targets);
  problem.catalogue.resize(movements.size());
  std::vector<Effort> efforts(movements.size());
  const muscle::FatigueRates<double> rates = muscle::published_fatigue_rates("elbow_rest");
  std::vector<char> tiring(movements.size(), 0);
  oneapi::tbb::parallel_for(std::size_t{0}, movements.size(), [&](std::size_t i) {
    options.progress.check();
    identification::MovementInformation& information = problem.catalogue[i];
    information.name = movements[i].description();
    information.duration_s = movements[i].duration_s;
    std::vector<std::optional<TrialData>> performances;
    for (std::size_t k = 0; k < persons.size(); ++k) {
      std::optional<TrialData> trial =
          perform(courses[i], data.muscles,
                  person_of(shape->parameters().values(persons[k]), static_cast<int>(k)));
      if (trial) {
        StudyData one;
        one.muscles = data.muscles;
        one.rules = data.rules;
        one.trials = {*trial};
        information.per_person.push_back(
            information_of(one, torque, persons[k], torque_sd, emg_cv));
      } else {
        information.per_person.emplace_back();
      }
      performances.push_back(std::move(trial));
    }
    efforts[i] = effort_of(performances, data.muscles, movements[i].duration_s);
    if (fatigued_share(efforts[i], rates) > options.fatigued_share) {
      tiring[i] = 1;
      for (Eigen::MatrixXd& m : information.per_person) m.resize(0, 0);
    }
  });

  options.progress.tell(0.6, "choice");
  const identification::DesignResult choice =
      identification::choose_movements(problem, options.choice);

  result.too_tiring = static_cast<std::size_t>(std::accumulate(tiring.begin(), tiring.end(), 0));
  result.too_hard = choice.infeasible.size() - result.too_tiring;
  result.exchanges = choice.exchanges;
  const auto expected = [&](const Eigen::VectorXd& sd, bool now) {
    std::vector<ParameterEstimate> estimates;
    for (const Eigen::Index j : problem.targets) {
      const Unknown& f = free[static_cast<std::size_t>(j)];
      const double prior_sd = f.prior.sd > 0.0 ? f.prior.sd : choice.prior_sd[j];
      const ParameterEstimate* found = found_by(options.earlier, f);
      const double ratio = choice.prior_sd[j] > 0.0 ? sd[j] / choice.prior_sd[j] : 1.0;
      estimates.push_back(
          expected_estimate(f,
                            {.mean = known.mean[j],
                             .sd = sd[j],
                             .prior_sd = prior_sd,
                             .model_error = options.earlier ? options.earlier->model_error : 0.0,
                             .found = found,
                             .ratio = ratio},
                            data.muscles));
      if (found == nullptr || !now) continue;
      // What is known now has been judged with all that a run knows: profiles, trials left out.
      estimates.back().verdict = found->verdict;
      estimates.back().reason = found->reason;
    }
    return estimates;
  };
  result.beforehand = expected(choice.prior_sd, true);
  std::vector<const Effort*> chosen;
  for (const identification::DesignStep& step : choice.steps) {
    result.plan.push_back({movements[step.movement], 0.0, 0.0, expected(step.sd, false)});
    chosen.push_back(&efforts[step.movement]);
  }
  const std::vector<PlannedRest> rests = plan_rests(chosen, options.fatigued_share, rates);
  for (std::size_t i = 0; i < rests.size(); ++i) {
    result.plan[i].rest_before_s = rests[i].before_s;
    result.plan[i].fatigued_share = rests[i].fatigued_share;
  }
  options.progress.tell(1.0, "done");
  return result;
}

}  // namespace myoid
