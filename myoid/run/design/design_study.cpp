#include "myoid/run/design/design_study.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "myoid/fit/posterior/density.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/core/parallel.h"
#include "myoid/ground/math/random.h"
#include "myoid/ground/math/statistics.h"
#include "myoid/muscle/fatigue.h"
#include "myoid/run/design/design_fatigue.h"
#include "myoid/run/design/design_knowledge.h"
#include "myoid/run/design/human_range.h"
#include "myoid/run/design/posterior_information.h"
#include "myoid/study/study_model.h"

namespace myoid::run {
namespace {

using fit::EstimatorOptions;
using fit::ParameterEstimate;
using fit::StudyData;
using fit::TrialData;
using fit::Unknown;

/// Noise of the planned recording.
struct Noise {
  double torque_sd_nm = 0.0, emg_cv = 0.0;
};

/// Returns the earlier run's noise if it stems from a recording, not from simulated data; else the options' noise.
Noise noise_of(const DesignStudyOptions& options) {
  if (options.earlier && options.earlier->torque_sd_nm > 1e-3)
    return {.torque_sd_nm = options.earlier->torque_sd_nm, .emg_cv = options.earlier->emg_cv};
  return {.torque_sd_nm = options.torque_sd_nm, .emg_cv = options.emg_cv};
}

/// Returns the study's muscles without trials; unstated v_max are free.
StudyData muscles_of(const study::Study& study, const body::BodyModel& model) {
  StudyData data;
  data.muscles = study::muscle_setups(study, model);
  if (data.muscles.empty()) throw InvalidInput("design: the study has no [[muscle]]");
  fit::free_speeds(data, fit::unstated_speeds(data, study.identify.muscles));
  return data;
}

EstimatorOptions estimator_of(const study::Study& study, const StudyData& data, double gain_sd) {
  EstimatorOptions torque;
  torque.muscles = study.identify.muscles;
  torque.delay_s = study.emg.delay_s;
  torque.max_rate_hz = 25.0;
  torque.unseen = study.beliefs;
  for (const fit::MuscleSetup& m : data.muscles) torque.state(m.emg_channel).gain_sd = gain_sd;
  return torque;
}

/// Returns the movements that the study's equipment allows.
std::vector<Movement> catalogue_of(const study::Study& study, const ProposedRange& range, CatalogueOptions options) {
  options.coordinate = study.model.coordinate;
  options.planes = options.planes && !study.model.file;
  if (study.model.file && !study.model.held_mass) options.held_masses_kg = {0.0};
  return movement_catalogue(range.low_rad, range.high_rad, options);
}

std::vector<MovementCourse> courses_of(const study::Study& study,
                                       const body::BodyModel& model,
                                       const std::vector<Movement>& movements,
                                       const Progress& progress) {
  const MovementModels models = movement_models(study, model);
  std::vector<MovementCourse> courses(movements.size());
  parallel_each(movements.size(), [&](std::size_t i) {
    progress.check();
    courses[i] = movement_course(study, models, movements[i]);
  });
  return courses;
}

/// Returns person k with these numbers.
MovementPerson person_of(const fit::ModelValues& values, std::size_t k, std::uint64_t seed) {
  MovementPerson person;
  person.muscles = values.muscles;
  if (!values.channels.empty()) person.emg_delay_s = values.channels.front()[fit::kDelay];
  person.seed = math::seed_for(seed, fmt::format("person {}", k));
  return person;
}

/// Returns the fit's parameters, from the first movement within the strength of a person with
/// the starting values; empty if there is none.
std::optional<fit::ParameterMap> parameters_of(const StudyData& muscles,
                                               const EstimatorOptions& torque,
                                               const std::vector<MovementCourse>& courses,
                                               std::uint64_t seed) {
  fit::ModelValues start;
  for (const fit::MuscleSetup& m : muscles.muscles) start.muscles.push_back(fit::muscle_values(m.start, m.extras));
  for (const MovementCourse& course : courses) {
    if (auto trial = perform(course, muscles.muscles, person_of(start, 0, seed))) {
      StudyData data = muscles;
      data.trials = {std::move(*trial)};
      return fit::ParameterMap(data, torque);
    }
  }
  return std::nullopt;
}

/// Returns the information of the trial of a person who has the numbers z in the solver's scale.
using Information = std::function<Eigen::MatrixXd(const TrialData& trial, const Eigen::VectorXd& z)>;

/// Returns true if the earlier run is by the posterior.
bool has_shares(const std::optional<EarlierRun>& earlier) {
  return earlier && std::ranges::any_of(earlier->estimates,
                                        [](const ParameterEstimate& e) { return e.variance_shares.has_value(); });
}

/// Returns the errors for a plan by the posterior: the earlier run's; else the options' noise, and
/// the median of the belief about the model's error.
PlannedErrors planned_errors(const DesignStudyOptions& options, const EstimatorOptions& torque) {
  constexpr double kMedian = 0.6745;  // of the half normal distribution
  const Noise noise = noise_of(options);
  PlannedErrors errors{.torque_sd_nm = noise.torque_sd_nm,
                       .emg_factor = noise.emg_cv / fit::envelope_spread(torque, ""),
                       .model_error = kMedian * torque.unseen.model_error};
  if (options.earlier) errors.model_error = options.earlier->model_error;
  if (has_shares(options.earlier)) return errors;
  // Without a known bandwidth the envelopes' noise is the noise below 2 Hz.
  const fit::EnvelopeError plain(torque.envelope_cutoff_hz, {});
  const Eigen::VectorXd frequency = plain.frequencies_hz();
  double below = 0.0;
  for (Eigen::Index i = 0; i < frequency.size() && frequency[i] < 2.0; ++i) below += plain.spectrum()[i];
  errors.emg_factor /= std::sqrt(below);
  return errors;
}

/// One movement as every person performs it.
struct Performance {
  MovementInformation information;
  Effort effort;
};

/// Performs a movement. `persons`: numbers of each person in the solver's scale.
Performance performance_of(const MovementCourse& course,
                           const StudyData& muscles,
                           const fit::ParameterMap& parameters,
                           const std::vector<Eigen::VectorXd>& persons,
                           std::uint64_t seed,
                           const Information& information_in) {
  Performance result;
  result.information.name = course.movement.description();
  result.information.duration_s = course.movement.duration_s;
  std::vector<std::optional<TrialData>> trials;
  for (std::size_t k = 0; k < persons.size(); ++k) {
    trials.push_back(perform(course, muscles.muscles, person_of(parameters.values(persons[k]), k, seed)));
    Eigen::MatrixXd& information = result.information.per_person.emplace_back();
    if (trials.back()) information = information_in(*trials.back(), persons[k]);
  }
  result.effort = effort_of(trials, muscles.muscles, course.movement.duration_s);
  return result;
}

/// Returns all movements of the catalogue that a person with these numbers can do.
std::vector<TrialData> session_of(const std::vector<MovementCourse>& courses,
                                  const StudyData& muscles,
                                  const fit::ModelValues& values,
                                  std::uint64_t seed) {
  std::vector<TrialData> session;
  for (const MovementCourse& course : courses) {
    if (auto trial = perform(course, muscles.muscles, person_of(values, 0, seed))) session.push_back(std::move(*trial));
  }
  return session;
}

/// The information that the posterior takes from a movement, and the further quantities
/// that it informs: the posterior's unseen quantities, which all movements of a person share.
struct Teller {
  Information information;
  std::vector<std::string> quantities;
};

Teller teller_of(const StudyData& muscles,
                 const EstimatorOptions& torque,
                 const std::vector<MovementCourse>& courses,
                 const fit::ModelValues& start,
                 const DesignStudyOptions& options) {
  // Moment arms, tendons and scales are the same as in an earlier run, so a further recording does
  // not narrow their part of the intervals.
  const auto posterior = std::make_shared<const PosteriorInformation>(
      muscles, session_of(courses, muscles, start, options.seed), torque, planned_errors(options, torque),
      has_shares(options.earlier) ? fit::Believed::geometry_and_sensors_exact : fit::Believed::nothing_exact);
  return {[posterior](const TrialData& trial, const Eigen::VectorXd& z) { return posterior->of(trial, z); },
          posterior->quantities()};
}

/// Returns the choice of movements: unknowns, then quantities of precision 1.
DesignProblem problem_of(const std::vector<Unknown>& free,
                         const Knowledge& known,
                         const std::vector<std::string>& quantities,
                         const std::vector<std::string>& targets) {
  DesignProblem problem;
  for (const Unknown& f : free) problem.parameters.push_back(f.label);
  problem.parameters.insert(problem.parameters.end(), quantities.begin(), quantities.end());
  const auto size = static_cast<Eigen::Index>(problem.parameters.size());
  problem.prior_precision.setIdentity(size, size);
  problem.prior_precision.topLeftCorner(known.precision.rows(), known.precision.cols()) = known.precision;
  problem.targets = targets_of(free, targets);
  return problem;
}

/// The targets with expected standard deviations `sd`.
struct Expected {
  const std::vector<Unknown>& free;
  const Knowledge& known;
  const std::vector<Eigen::Index>& targets;
  const Eigen::VectorXd& prior_sd;
  const std::optional<EarlierRun>& earlier;

  [[nodiscard]] std::vector<ParameterEstimate> with(const Eigen::VectorXd& sd) const {
    std::vector<ParameterEstimate> estimates;
    for (const Eigen::Index j : targets) {
      const Unknown& f = free[static_cast<std::size_t>(j)];
      estimates.push_back(expected_estimate(f, {.mean = known.mean[j],
                                                .sd = sd[j],
                                                .prior_sd = f.prior.sd > 0.0 ? fit::prior_spread(f) : prior_sd[j],
                                                .model_error = earlier ? earlier->model_error : 0.0,
                                                .found = found_by(earlier, f),
                                                .ratio = ratio(j, sd)}));
    }
    return estimates;
  }

  /// Returns the interval relative to the one beforehand. The part by moment arms, tendons and the
  /// torque's scale stays.
  [[nodiscard]] double ratio(Eigen::Index j, const Eigen::VectorXd& sd) const {
    if (!(prior_sd[j] > 0.0)) return 1.0;
    const double narrower = sd[j] / prior_sd[j];
    const ParameterEstimate* found = found_by(earlier, free[static_cast<std::size_t>(j)]);
    if (found == nullptr || !found->variance_shares) return narrower;
    using fit::Source;
    const fit::SourceShares& shares = *found->variance_shares;
    const double stays = std::min(1.0, shares[static_cast<std::size_t>(Source::geometry)] +
                                           shares[static_cast<std::size_t>(Source::torque_scale)]);
    return std::sqrt(stays + (1.0 - stays) * narrower * narrower);
  }

  /// Returns the estimates before the recording. The earlier run's verdicts know its
  /// quality gates, so they stay.
  [[nodiscard]] std::vector<ParameterEstimate> beforehand() const {
    std::vector<ParameterEstimate> estimates = with(prior_sd);
    for (std::size_t t = 0; t < targets.size(); ++t) {
      const ParameterEstimate* found = found_by(earlier, free[static_cast<std::size_t>(targets[t])]);
      if (found != nullptr) fit::keep_verdict(*found, estimates[t]);
    }
    return estimates;
  }
};

}  // namespace

double relative_half_width(const ParameterEstimate& estimate) {
  const double half = std::max(*estimate.ci_high - estimate.estimate, estimate.estimate - *estimate.ci_low);
  if (estimate.parameter == "emg_delay") return 1e3 * half;
  const bool zero = fit::zero_by_nature(estimate.parameter) && estimate.prior_sd;
  return 100.0 * half / (zero ? math::normal_quantile(0.975) * *estimate.prior_sd : std::abs(estimate.estimate));
}

int identified_count(const std::vector<ParameterEstimate>& estimates) {
  return static_cast<int>(
      std::ranges::count_if(estimates, [](const auto& e) { return e.verdict == fit::Verdict::identified; }));
}

double median_half_width(const std::vector<ParameterEstimate>& estimates) {
  std::vector<double> widths;
  for (const ParameterEstimate& e : estimates) {
    const bool of_value = e.parameter != "emg_delay" && !fit::zero_by_nature(e.parameter);
    if (of_value || estimates.size() == 1) widths.push_back(relative_half_width(e));
  }
  if (widths.empty()) return 0.0;
  const auto middle = widths.begin() + static_cast<std::ptrdiff_t>(widths.size() / 2);
  std::nth_element(widths.begin(), middle, widths.end());
  return *middle;
}

DesignStudyResult design_study(const study::Study& study, const DesignStudyOptions& options) {
  return design_study(study, study::load_model(study), options);
}

DesignStudyResult design_study(const study::Study& study,
                               const body::BodyModel& model,
                               const DesignStudyOptions& options) {
  if (study.model.is_none())
    throw InvalidInput(
        "a study without a model has no muscle paths for other movements: give [model] a file to design a recording");
  const StudyData data = muscles_of(study, model);
  const EstimatorOptions torque = estimator_of(study, data, options.gain_sd);
  const body::Coordinate& coordinate =
      model.coordinates[static_cast<std::size_t>(model.coordinate_index(study.model.coordinate))];
  const ProposedRange range = human_range(coordinate.name, coordinate.lower, coordinate.upper);
  const std::vector<Movement> movements = catalogue_of(study, range, options.catalogue);

  options.progress.tell(0.05, "movements");
  const std::vector<MovementCourse> courses = courses_of(study, model, movements, options.progress);
  const auto parameters = parameters_of(data, torque, courses, options.seed);
  DesignStudyResult result;
  result.catalogue_size = movements.size();
  result.range = range.says;
  if (!parameters) {
    result.too_hard = movements.size();
    return result;
  }
  const std::vector<Unknown>& free = parameters->free();
  const Knowledge known = knowledge_of(free, options.earlier);
  const std::vector<Eigen::VectorXd> persons = draw_persons(free, known, options.persons, options.seed);

  options.progress.tell(0.2, "information");
  const Teller teller = teller_of(data, torque, courses, parameters->values(known.mean), options);
  DesignProblem problem = problem_of(free, known, teller.quantities, options.targets);
  problem.catalogue.resize(movements.size());
  std::vector<Effort> efforts(movements.size());
  const muscle::FatigueRates<double> rates = muscle::published_fatigue_rates("elbow_rest");
  std::vector<char> tiring(movements.size(), 0);
  parallel_each(movements.size(), [&](std::size_t i) {
    options.progress.check();
    Performance performance = performance_of(courses[i], data, *parameters, persons, options.seed, teller.information);
    tiring[i] = fatigued_share(performance.effort, rates) > options.fatigued_share ? 1 : 0;
    if (tiring[i] != 0) {
      for (Eigen::MatrixXd& m : performance.information.per_person) m.resize(0, 0);
    }
    problem.catalogue[i] = std::move(performance.information);
    efforts[i] = std::move(performance.effort);
  });

  options.progress.tell(0.6, "choice");
  const DesignResult choice = choose_movements(problem, options.choice);
  result.too_tiring = static_cast<std::size_t>(std::accumulate(tiring.begin(), tiring.end(), 0));
  result.too_hard = choice.infeasible.size() - result.too_tiring;
  result.exchanges = choice.exchanges;
  const Expected expected{free, known, problem.targets, choice.prior_sd, options.earlier};
  result.beforehand = expected.beforehand();
  std::vector<const Effort*> chosen;
  for (const DesignStep& step : choice.steps) {
    result.plan.push_back({movements[step.movement], 0.0, 0.0, expected.with(step.sd)});
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

}  // namespace myoid::run
