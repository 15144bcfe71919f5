#include "myoid/pipeline/design_study.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numeric>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <oneapi/tbb/parallel_for.h>

#include "myoid/core/error.h"
#include "myoid/identification/identifiability.h"
#include "myoid/identification/residual_model.h"
#include "myoid/muscle/fatigue.h"
#include "myoid/pipeline/study_model.h"
#include "myoid/simulation/random.h"

namespace myoid::pipeline {
namespace {

using identification::EstimatorOptions;
using identification::FreeParameter;
using identification::ParameterEstimate;
using identification::ResidualModel;
using identification::StudyData;
using identification::TrialData;

/// What is known before the recording, in the estimator's scale.
struct Knowledge {
  Eigen::VectorXd mean;
  Eigen::MatrixXd covariance;
  Eigen::MatrixXd precision;
};

Knowledge knowledge_of(const std::vector<FreeParameter>& free,
                       const std::optional<EarlierRun>& earlier) {
  const auto p = static_cast<Eigen::Index>(free.size());
  Knowledge known{Eigen::VectorXd(p), Eigen::MatrixXd::Zero(p, p), {}};
  for (Eigen::Index j = 0; j < p; ++j) {
    const FreeParameter& f = free[static_cast<std::size_t>(j)];
    const double sd = f.prior_sd > 0.0 ? f.prior_sd : 0.25 * (f.upper - f.lower);
    known.mean[j] = f.prior_sd > 0.0 ? f.prior_mean : f.start;
    known.covariance(j, j) = sd * sd;
  }
  const Eigen::VectorXd sd_before = known.covariance.diagonal().cwiseSqrt();
  if (earlier) {
    std::vector<std::pair<Eigen::Index, Eigen::Index>> pairs;
    for (Eigen::Index j = 0; j < p; ++j) {
      const auto it = std::find(earlier->parameters.begin(), earlier->parameters.end(),
                                free[static_cast<std::size_t>(j)].label);
      if (it == earlier->parameters.end()) continue;
      const Eigen::Index from = it - earlier->parameters.begin();
      if (std::isfinite(earlier->estimate[from])) pairs.emplace_back(j, from);
    }
    for (const auto& [a, from_a] : pairs) {
      const bool logarithmic = free[static_cast<std::size_t>(a)].field->logarithmic;
      known.mean[a] = logarithmic ? std::log(earlier->estimate[from_a]) : earlier->estimate[from_a];
      for (const auto& [b, from_b] : pairs)
        known.covariance(a, b) = earlier->covariance(from_a, from_b);
    }
  }
  // Relative to what was known before: a direction that the run left undetermined has no variance
  // in its covariance, and is as unknown as it was. None is known better than to a millionth.
  const Eigen::VectorXd unit = sd_before.cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> axes(unit.asDiagonal() * known.covariance *
                                                            unit.asDiagonal());
  if (!axes.eigenvalues().allFinite())
    throw InvalidInput("design: the covariance of the earlier run is not finite");
  Eigen::VectorXd variance = axes.eigenvalues();
  for (double& v : variance) v = v <= 1e-14 ? 1.0 : std::max(v, 1e-12);
  const Eigen::MatrixXd scaled = sd_before.asDiagonal() * axes.eigenvectors();
  known.covariance = scaled * variance.asDiagonal() * scaled.transpose();
  const Eigen::MatrixXd inverse = unit.asDiagonal() * axes.eigenvectors();
  known.precision = inverse * variance.cwiseInverse().asDiagonal() * inverse.transpose();
  return known;
}

/// Persons drawn from the knowledge; the first is its mean.
std::vector<Eigen::VectorXd> draw_persons(const std::vector<FreeParameter>& free,
                                          const Knowledge& known,
                                          const DesignStudyOptions& options) {
  const Eigen::LLT<Eigen::MatrixXd> factor(known.covariance);
  simulation::Random random(simulation::seed_for(options.seed, "design persons"));
  std::vector<Eigen::VectorXd> persons;
  for (int k = 0; k < options.persons; ++k) {
    Eigen::VectorXd z = known.mean;
    if (k > 0) z += factor.matrixL() * random.normals(z.size());
    for (Eigen::Index j = 0; j < z.size(); ++j) {
      const FreeParameter& f = free[static_cast<std::size_t>(j)];
      z[j] = std::clamp(z[j], f.lower, f.upper);
    }
    persons.push_back(std::move(z));
  }
  return persons;
}

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

std::vector<Eigen::Index> targets_of(const std::vector<FreeParameter>& free,
                                     const std::vector<std::string>& wanted) {
  std::vector<Eigen::Index> targets;
  for (std::size_t j = 0; j < free.size(); ++j) {
    const std::string& label = free[j].label;
    const std::size_t dot = label.find('.');
    const std::string owner = label.substr(0, dot);
    const std::string parameter = label.substr(dot + 1);
    const bool nuisance = free[j].field->name == "emg_gain";
    for (const std::string& w : wanted) {
      if (w == label || w == owner || w == parameter || (w == "all" && !nuisance)) {
        targets.push_back(static_cast<Eigen::Index>(j));
        break;
      }
    }
  }
  for (const std::string& w : wanted) {
    const bool known =
        w == "all" || std::any_of(free.begin(), free.end(), [&](const auto& f) {
          const std::size_t dot = f.label.find('.');
          return f.label == w || f.label.substr(0, dot) == w || f.label.substr(dot + 1) == w;
        });
    if (known) continue;
    std::string names;
    for (const FreeParameter& f : free) names += (names.empty() ? "" : ", ") + f.label;
    throw InvalidInput(fmt::format(
        "target '{}' is no parameter, muscle or muscle.parameter that can be identified; there are "
        "{}",
        w, names));
  }
  return targets;
}

/// The run's own row of an unknown (of its first owner, where it is tied), if it has an interval.
const ParameterEstimate* found_by(const std::optional<EarlierRun>& earlier,
                                  const FreeParameter& f) {
  if (!earlier) return nullptr;
  const std::size_t dot = f.label.find('.');
  const std::string owners = f.label.substr(0, dot);
  const std::string owner = owners.substr(0, owners.find('+'));
  for (const ParameterEstimate& e : earlier->estimates) {
    if ((e.muscle == owner || e.muscle == owners) && e.parameter == f.field->name && e.ci_low &&
        e.ci_high && std::isfinite(e.estimate))
      return &e;
  }
  return nullptr;
}

/// What an interval of this width would be called. `found`: what an earlier run says, whose
/// interval becomes `ratio` times as wide.
ParameterEstimate expected_estimate(const FreeParameter& f,
                                    double mean,
                                    double sd,
                                    double prior_sd,
                                    const std::vector<identification::MuscleSetup>& muscles,
                                    double model_error,
                                    const ParameterEstimate* found,
                                    double ratio) {
  ParameterEstimate e;
  const std::size_t dot = f.label.find('.');
  e.muscle = f.label.substr(0, dot);
  e.parameter = f.label.substr(dot + 1);
  e.unit = f.field->unit;
  e.method = "torque";
  e.fit_case = "both";
  e.initial = e.estimate = f.to_value(mean);
  double below = 1.96 * sd, above = 1.96 * sd;
  if (found != nullptr) {
    // Narrower than the run's own interval, by which other routes count too, in the same ratio.
    const auto scaled = [&](double value) {
      return f.field->logarithmic ? std::log(std::max(value, 1e-300)) : value;
    };
    below = ratio * (scaled(found->estimate) - scaled(*found->ci_low));
    above = ratio * (scaled(*found->ci_high) - scaled(found->estimate));
  }
  e.ci_low = f.to_value(std::max(mean - below, f.lower));
  e.ci_high = f.to_value(std::min(mean + above, f.upper));
  e.std_error = f.field->logarithmic ? e.estimate * sd : sd;
  e.prior_mean = e.estimate;
  e.prior_sd = f.field->logarithmic ? e.estimate * prior_sd : prior_sd;
  e.shrinkage = 1.0 - sd * sd / (prior_sd * prior_sd);
  identification::VerdictContext context{.model_error = model_error};
  const auto own = std::find_if(muscles.begin(), muscles.end(),
                                [&](const auto& m) { return m.name == e.muscle; });
  for (const identification::MuscleSetup& other : muscles) {
    if (own != muscles.end() && other.name != own->name && other.emg_channel == own->emg_channel)
      context.shares_electrode_with = other.name;
  }
  identification::judge(e, context);
  return e;
}

/// Mean activation of each muscle over the persons who can do it, per half second.
struct Effort {
  std::vector<std::vector<double>> activation;  ///< Per muscle.
};
constexpr double kFatigueStep_s = 0.5;

Effort effort_of(const std::vector<std::optional<TrialData>>& performances,
                 const std::vector<identification::MuscleSetup>& muscles,
                 double duration_s) {
  Effort effort;
  const auto steps = static_cast<std::size_t>(std::ceil(duration_s / kFatigueStep_s));
  for (const identification::MuscleSetup& setup : muscles) {
    std::vector<double> sum(steps, 0.0);
    double count = 0.0;
    for (const std::optional<TrialData>& trial : performances) {
      if (!trial) continue;
      ++count;
      const Eigen::VectorXd a = trial->activation.column(setup.emg_channel);
      const Eigen::VectorXd& clock = trial->activation.time_s();
      for (std::size_t s = 0; s < steps; ++s) {
        const double from = static_cast<double>(s) * kFatigueStep_s;
        const auto begin =
            std::lower_bound(clock.data(), clock.data() + clock.size(), from) - clock.data();
        const auto end =
            std::lower_bound(clock.data(), clock.data() + clock.size(), from + kFatigueStep_s) -
            clock.data();
        if (end > begin) sum[s] += a.segment(begin, end - begin).mean();
      }
    }
    for (double& x : sum) x /= std::max(count, 1.0);
    effort.activation.push_back(std::move(sum));
  }
  return effort;
}

using Tiredness = std::vector<muscle::FatigueState<double>>;

double worst(const Tiredness& state) {
  double most = 0.0;
  for (const auto& s : state) most = std::max(most, s.fatigued);
  return most;
}

void work(const Effort& effort, const muscle::FatigueRates<double>& rates, Tiredness& state) {
  for (std::size_t k = 0; k < state.size(); ++k) {
    for (const double a : effort.activation[k])
      state[k] = muscle::step_fatigue(rates, a, state[k], kFatigueStep_s);
  }
}

void rest(double duration_s, const muscle::FatigueRates<double>& rates, Tiredness& state) {
  for (auto& s : state) s = muscle::step_fatigue(rates, 0.0, s, duration_s);
}

/// Puts rests before movements until none ends with more than the budget.
void plan_rests(const std::vector<const Effort*>& efforts,
                double budget,
                const muscle::FatigueRates<double>& rates,
                std::vector<PlannedMovement>& plan) {
  if (plan.empty()) return;
  Tiredness state(efforts.front()->activation.size());
  for (std::size_t i = 0; i < plan.size(); ++i) {
    Tiredness before = state;
    constexpr double kRestStep_s = 15.0;
    constexpr double kLongestRest_s = 1800.0;
    for (;;) {
      state = before;
      work(*efforts[i], rates, state);
      if (worst(state) <= budget || plan[i].rest_before_s >= kLongestRest_s) break;
      plan[i].rest_before_s += kRestStep_s;
      rest(kRestStep_s, rates, before);
    }
    plan[i].fatigued_share = worst(state);
  }
}

/// A row of parameters.json; empty without a number.
std::optional<ParameterEstimate> row_of(const nlohmann::json& row) {
  const auto number = [&](const char* key) -> std::optional<double> {
    const auto found = row.find(key);
    return found != row.end() && found->is_number() ? std::optional<double>(found->get<double>())
                                                    : std::nullopt;
  };
  const std::optional<double> estimate = number("estimate");
  if (!estimate) return std::nullopt;
  ParameterEstimate e;
  e.muscle = row.at("muscle");
  e.parameter = row.at("parameter");
  e.estimate = *estimate;
  e.std_error = number("std_error");
  e.ci_low = number("ci_low");
  e.ci_high = number("ci_high");
  e.reason = row.value("reason", "");
  const std::string verdict = row.value("verdict", "");
  for (const auto known :
       {identification::Verdict::identified, identification::Verdict::weak,
        identification::Verdict::prior_dominated, identification::Verdict::not_identifiable,
        identification::Verdict::non_physical}) {
    if (verdict == identification::name(known)) e.verdict = known;
  }
  return e;
}

}  // namespace

EarlierRun read_earlier_run(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "parameters.json";
  std::ifstream stream(file);
  if (!stream)
    throw ReadError(file, 0,
                    "there is no such file; --after must name the folder of a finished "
                    "`myoid run` or `myoid identify`");
  try {
    const nlohmann::json all = nlohmann::json::parse(stream);
    for (const nlohmann::json& method : all.at("methods")) {
      if (method.at("method") != "torque") continue;
      EarlierRun run;
      run.parameters = method.at("covariance").at("parameters");
      const nlohmann::json& rows = method.at("covariance").at("matrix");
      const auto p = static_cast<Eigen::Index>(run.parameters.size());
      run.covariance.resize(p, p);
      run.estimate.setConstant(p, std::nan(""));
      for (Eigen::Index a = 0; a < p; ++a) {
        for (Eigen::Index b = 0; b < p; ++b)
          run.covariance(a, b) =
              rows.at(static_cast<std::size_t>(a)).at(static_cast<std::size_t>(b));
      }
      for (const nlohmann::json& e : method.at("estimates")) {
        const std::string label =
            e.at("muscle").get<std::string>() + "." + e.at("parameter").get<std::string>();
        if (auto row = row_of(e)) run.estimates.push_back(std::move(*row));
        const auto it = std::find(run.parameters.begin(), run.parameters.end(), label);
        if (it == run.parameters.end()) continue;
        run.estimate[it - run.parameters.begin()] = e.at("estimate").get<double>();
      }
      run.torque_sd_nm = method.at("torque_sd_nm");
      run.emg_cv = method.at("emg_cv");
      if (method.contains("model_error") && method.at("model_error").is_number())
        run.model_error = method.at("model_error");
      return run;
    }
  } catch (const nlohmann::json::exception& error) {
    throw ReadError(
        file, 0,
        fmt::format("is not what `myoid run` writes ({}); run the study again", error.what()));
  }
  throw ReadError(file, 0, "holds no fit by method torque; run the study with method = \"torque\"");
}

EarlierRun earlier_run(const identification::IdentificationResult& fit) {
  EarlierRun run{.parameters = fit.free_parameters,
                 .estimate = Eigen::VectorXd::Constant(
                     static_cast<Eigen::Index>(fit.free_parameters.size()), std::nan("")),
                 .covariance = fit.covariance,
                 .torque_sd_nm = fit.torque_sd_nm,
                 .emg_cv = fit.emg_cv,
                 .model_error = fit.model_error,
                 .estimates = fit.estimates};
  for (const ParameterEstimate& e : fit.estimates) {
    const auto it =
        std::find(run.parameters.begin(), run.parameters.end(), e.muscle + "." + e.parameter);
    if (it != run.parameters.end()) run.estimate[it - run.parameters.begin()] = e.estimate;
  }
  return run;
}

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
  const model::BodyModel model = load_model(study);
  StudyData data;
  data.muscles = muscle_setups(study, model);
  if (data.muscles.empty()) throw InvalidInput("design: the study has no [[muscle]]");
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
  const MovementModels models = movement_models(study);
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
  const std::vector<FreeParameter> free = shape->parameters().free();
  const Knowledge known = knowledge_of(free, options.earlier);
  const std::vector<Eigen::VectorXd> persons = draw_persons(free, known, options);
  const double torque_sd = options.earlier && options.earlier->torque_sd_nm > 1e-3
                               ? options.earlier->torque_sd_nm
                               : options.torque_sd_nm;
  const double emg_cv = options.earlier && options.earlier->torque_sd_nm > 1e-3
                            ? options.earlier->emg_cv
                            : options.emg_cv;

  options.progress.tell(0.2, "information");
  identification::DesignProblem problem;
  for (const FreeParameter& f : free) problem.parameters.push_back(f.label);
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
        one.trials = {*trial};
        information.per_person.push_back(
            information_of(one, torque, persons[k], torque_sd, emg_cv));
      } else {
        information.per_person.emplace_back();
      }
      performances.push_back(std::move(trial));
    }
    efforts[i] = effort_of(performances, data.muscles, movements[i].duration_s);
    Tiredness fresh(data.muscles.size());
    work(efforts[i], rates, fresh);
    if (worst(fresh) > options.fatigued_share) {
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
      const FreeParameter& f = free[static_cast<std::size_t>(j)];
      const double prior_sd = f.prior_sd > 0.0 ? f.prior_sd : choice.prior_sd[j];
      const ParameterEstimate* found = found_by(options.earlier, f);
      const double ratio = choice.prior_sd[j] > 0.0 ? sd[j] / choice.prior_sd[j] : 1.0;
      estimates.push_back(expected_estimate(f, known.mean[j], sd[j], prior_sd, data.muscles,
                                            options.earlier ? options.earlier->model_error : 0.0,
                                            found, ratio));
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
  plan_rests(chosen, options.fatigued_share, rates, result.plan);
  options.progress.tell(1.0, "done");
  return result;
}

}  // namespace myoid::pipeline
