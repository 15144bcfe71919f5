#include "myoid/pipeline/run_study.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>

#include "myoid/core/error.h"
#include "myoid/dynamics/held_mass.h"
#include "myoid/dynamics/inverse_dynamics.h"
#include "myoid/identification/force.h"
#include "myoid/model/arm4.h"
#include "myoid/model/thelen_properties.h"
#include "myoid/pipeline/lumped_muscles.h"
#include "myoid/pipeline/nuisances.h"
#include "myoid/pipeline/quality_gates.h"
#include "myoid/pipeline/stage_store.h"
#include "myoid/pipeline/study_model.h"
#include "myoid/pipeline/study_phases.h"
#include "myoid/pipeline/trial_input.h"
#include "myoid/pipeline/trial_quality.h"
#include "myoid/recording/csv_reader.h"
#include "myoid/signals/emg_quality.h"
#include "myoid/signals/resample.h"

namespace myoid::pipeline {
namespace {

/// Measures the stages and tells how far the run is.
class Stages {
 public:
  Stages(const RunOptions& options, std::vector<StageTime>& times)
      : options_(options), times_(times) {}

  template <typename Work>
  void run(const std::string& name, double from, Work work) {
    options_.progress.check();
    options_.progress.tell(from, name);
    const auto begin = std::chrono::steady_clock::now();
    work();
    times_.push_back(
        {name, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count()});
  }

 private:
  const RunOptions& options_;
  std::vector<StageTime>& times_;
};

/// Coordinates that are the same throughout a trial: found where the posture is known, then held.
void calibrate(const CalibrationSpec& spec,
               const recording::MarkerSeries& markers,
               model::BodyModel& model) {
  model::BodyModel posed = model;
  for (model::Coordinate& c : posed.coordinates) c.locked = true;
  for (const std::string& name : spec.free)
    posed.coordinates[static_cast<std::size_t>(posed.coordinate_index(name))].locked = false;
  recording::MarkerSeries window;
  window.names = markers.names;
  Eigen::Index first = 0;
  while (first < markers.frame_count() && markers.time_s[first] < spec.window_s[0]) ++first;
  Eigen::Index last = first;
  while (last < markers.frame_count() && markers.time_s[last] <= spec.window_s[1]) ++last;
  if (last - first < 2)
    throw InvalidInput(fmt::format("[ik] calibrate: no frames between {} and {} s",
                                   spec.window_s[0], spec.window_s[1]));
  window.time_s = markers.time_s.segment(first, last - first);
  window.positions_m = markers.positions_m.middleRows(first, last - first);
  const kinematics::IkResult pose = kinematics::inverse_kinematics(posed, window);
  for (const std::string& name : spec.hold) {
    Eigen::VectorXd values = pose.q.column(name);
    std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
    model::Coordinate& c =
        model.coordinates[static_cast<std::size_t>(model.coordinate_index(name))];
    c.default_value = values[values.size() / 2];
    c.locked = true;
  }
}

/// Inverse kinematics, or what an earlier run found from the same input.
void solve_ik(const Study& study,
              const recording::MarkerSeries& markers,
              std::string_view model_text,
              StageStore* store,
              TrialResult& trial) {
  const std::string key = store != nullptr ? ik_key(study, model_text, markers) : "";
  if (store != nullptr) trial.ik = store->find(key);
  trial.ik_reused = trial.ik.has_value();
  if (trial.ik_reused) return;
  kinematics::IkOptions options;
  options.marker_weights = study.markers.weight;
  trial.ik = kinematics::inverse_kinematics(trial.model, markers, options);
  if (store != nullptr) store->keep(key, *trial.ik);
}

void compute_motion(const Study& study,
                    const TrialInput& input,
                    std::string_view model_text,
                    StageStore* store,
                    TrialResult& trial) {
  TimeSeries q;
  if (input.markers) {
    trial.markers = input.markers;
    if (study.ik.calibrate) calibrate(*study.ik.calibrate, *input.markers, trial.model);
    solve_ik(study, *input.markers, model_text, store, trial);
    trial.notes.insert(trial.notes.end(), trial.ik->notes.begin(), trial.ik->notes.end());
    q = trial.ik->q;
  } else if (input.motion) {
    q = *input.motion;
  } else {
    return;
  }
  kinematics::MotionOptions options;
  options.cutoff_hz = motion_cutoff_hz(study);
  const double rate = q.mean_rate_hz();
  const double wanted = options.cutoff_hz ? study.motion.rate_hz : rate;
  if (options.cutoff_hz && *options.cutoff_hz >= 0.45 * rate) {
    trial.notes.push_back(
        fmt::format("motion at {:.0f} Hz is too slow to be smoothed at {:.3g} Hz: not smoothed",
                    rate, *options.cutoff_hz));
    options.cutoff_hz.reset();
  }
  const Eigen::VectorXd& clock = q.time_s();
  if (std::abs(wanted - rate) > 0.01 * rate || !q.is_uniform())
    options.time_s = signals::even_clock(clock[0], clock[clock.size() - 1], wanted);
  // What a slower clock cannot hold goes first, where the smoothing spline, whose gain is
  // 1 / (1 + (f/f_c)^6), leaves more than a thousandth of it at half the new rate.
  const bool smoothed_away =
      options.cutoff_hz && std::pow(0.5 * wanted / *options.cutoff_hz, 6) >= 999.0;
  if (options.time_s && !smoothed_away && q.is_uniform()) q = signals::anti_aliased(q, wanted);
  kinematics::MotionResult result = kinematics::joint_motion(trial.model, q, options);
  trial.motion = std::move(result.motion);
  trial.notes.insert(trial.notes.end(), result.notes.begin(), result.notes.end());
}

void compute_forces(const Study& study, const TrialInput& input, bool share, TrialResult& trial) {
  trial.generalized_forces = dynamics::inverse_dynamics(
      trial.model, trial.motion, {.loads = input.loads ? &*input.loads : nullptr});
  trial.muscles = kinematics::muscle_kinematics(trial.model, trial.motion);
  const std::vector<std::string> coordinates = study_coordinates(study.model);
  std::vector<Channel> columns;
  std::vector<TimeSeries> moment_arms;
  Eigen::MatrixXd torque(trial.motion.sample_count(),
                         static_cast<Eigen::Index>(coordinates.size()));
  for (const std::string& name : coordinates) {
    const auto index = static_cast<std::size_t>(trial.model.coordinate_index(name));
    columns.push_back(
        {dynamics::generalized_force_name(trial.model.coordinates[index]), Unit::newton_meter});
    torque.col(static_cast<Eigen::Index>(moment_arms.size())) =
        trial.generalized_forces.column(columns.back().name);
    moment_arms.push_back(trial.muscles.moment_arm.at(name));
  }
  // What the surroundings exert on the coordinates, the muscles need not.
  if (input.external_torque)
    torque -= signals::resample(*input.external_torque, trial.motion.q.time_s()).values();
  trial.muscle_torque = TimeSeries(trial.motion.q.time_s(), std::move(columns), torque);

  if (!share) return;
  const auto count = static_cast<Eigen::Index>(trial.model.muscles.size());
  Eigen::MatrixXd optimal(trial.motion.sample_count(), count);
  Eigen::VectorXd greatest(count);
  for (Eigen::Index m = 0; m < count; ++m) {
    const muscle::ThelenParameters p =
        model::thelen_parameters(trial.model.muscles[static_cast<std::size_t>(m)].properties);
    greatest[m] = p.max_isometric_force_n;
    for (Eigen::Index i = 0; i < optimal.rows(); ++i) {
      optimal(i, m) = muscle::thelen_optimal_force(p, trial.muscles.length.values()(i, m),
                                                   trial.muscles.velocity.values()(i, m));
    }
  }
  trial.shared = forces::share(moment_arms, trial.muscle_torque, optimal, greatest,
                               {.objective = study.sharing.objective,
                                .exponent = study.sharing.exponent,
                                .reserve_nm = study.sharing.reserve_nm});
}

/// The envelope at no more than `rate_hz`, low-passed for it: splines through it are quicker.
/// Negative values of the filter's undershoot are set to 0.
TimeSeries thinned(const TimeSeries& series, double rate_hz) {
  if (series.mean_rate_hz() < 2.0 * rate_hz) return series;
  const Eigen::VectorXd& t = series.time_s();
  TimeSeries slow = signals::resample(series, signals::even_clock(t[0], t[t.size() - 1], rate_hz));
  return {slow.time_s(), slow.channels(), slow.values().cwiseMax(0.0)};
}

identification::TrialData trial_data(const Study& study,
                                     const TrialResult& trial,
                                     const std::vector<MuscleGroup>& groups) {
  identification::TrialData data;
  data.name = trial.spec.name;
  data.calibration = trial.spec.use == Use::calibration || trial.spec.use == Use::isometric;
  data.time_s = trial.motion.q.time_s();
  LumpedMuscles lumped = lumped_muscles(trial.muscles, groups, study.model.coordinate);
  data.length_m = std::move(lumped.length_m);
  data.velocity_mps = std::move(lumped.velocity_mps);
  data.moment_arm_m = std::move(lumped.moment_arm_m);
  if (!trial.shared.force.empty()) {
    data.force_n = Eigen::MatrixXd::Zero(data.length_m.rows(), data.length_m.cols());
    for (Eigen::Index g = 0; g < data.force_n.cols(); ++g) {
      for (const int head : groups[static_cast<std::size_t>(g)].members)
        data.force_n.col(g) += trial.shared.force.values().col(head);
    }
  }
  data.torque_nm = trial.muscle_torque.values().col(0);
  data.condition = trial.spec.condition;
  data.joint = study.model.coordinate;
  data.angle_rad = trial.motion.q.column(study.model.coordinate);
  data.velocity_radps = trial.motion.qdot.column(study.model.coordinate);
  data.acceleration_radps2 = trial.motion.qddot.column(study.model.coordinate);
  for (std::size_t j = 0; j < study.model.more_coordinates.size(); ++j) {
    const std::string& name = study.model.more_coordinates[j];
    data.more_joints.push_back(
        {.name = name,
         .torque_nm = trial.muscle_torque.values().col(static_cast<Eigen::Index>(j) + 1),
         .moment_arm_m = lumped_moment_arm_m(trial.muscles, groups, name),
         .angle_rad = trial.motion.q.column(name),
         .velocity_radps = trial.motion.qdot.column(name),
         .acceleration_radps2 = trial.motion.qddot.column(name)});
  }
  data.activation = trial.activation;
  return data;
}

std::vector<TrueValue> read_truth(const std::filesystem::path& path) {
  const recording::CsvTable table = recording::read_csv_table(path);
  const auto column = [&](std::string_view name) {
    const auto it = std::find(table.names.begin(), table.names.end(), name);
    if (it == table.names.end()) throw ReadError(path, 1, fmt::format("no column '{}'", name));
    return static_cast<std::size_t>(it - table.names.begin());
  };
  const std::size_t muscle = column("muscle");
  const std::size_t parameter = column("parameter");
  const std::size_t value = column("value");
  std::vector<TrueValue> truth;
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    const auto number = recording::parse_number(table.rows[r][value]);
    if (!number)
      throw ReadError(path, table.lines[r],
                      fmt::format("expected a number, found '{}'", table.rows[r][value]));
    truth.push_back({table.rows[r][muscle], table.rows[r][parameter], *number});
  }
  return truth;
}

void process_all_emg(const Study& study,
                     const std::vector<TrialInput>& inputs,
                     StudyResult& result) {
  const auto with_emg = [&](std::size_t i) { return inputs[i].emg.has_value(); };
  if (study.emg.kind == EmgKind::raw) {
    const signals::EnvelopeOptions options = envelope_options(study);
    oneapi::tbb::parallel_for(std::size_t{0}, inputs.size(), [&](std::size_t i) {
      if (with_emg(i)) result.trials[i].emg = signals::clean_emg(*inputs[i].emg, options);
    });
    std::vector<const signals::EmgStages*> clean;
    for (const TrialResult& trial : result.trials) {
      if (trial.emg) clean.push_back(&*trial.emg);
    }
    result.whitening = signals::find_whitening(clean, options);
    oneapi::tbb::parallel_for(std::size_t{0}, inputs.size(), [&](std::size_t i) {
      if (with_emg(i)) signals::add_envelope(*result.trials[i].emg, options, result.whitening);
    });
    for (TrialResult& trial : result.trials) {
      if (trial.emg)
        trial.notes.insert(trial.notes.end(), trial.emg->findings.begin(),
                           trial.emg->findings.end());
    }
  }
  if (study.emg.kind == EmgKind::activation) {
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      if (with_emg(i)) result.trials[i].activation = *inputs[i].emg;
    }
    return;
  }
  std::vector<signals::TrialEnvelope> envelopes;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    if (!with_emg(i)) continue;
    const TimeSeries& envelope =
        study.emg.kind == EmgKind::raw ? result.trials[i].emg->envelope : *inputs[i].emg;
    envelopes.push_back(
        {study.trials[i].name, study.trials[i].use == Use::mvc, &envelope,
         result.trials[i].emg ? result.trials[i].emg->bandwidth_hz : Eigen::VectorXd()});
  }
  result.level_faults = signals::check_emg_levels(envelopes);
  result.normalisation =
      signals::find_normalisation(envelopes, {.window_s = study.emg.normalise_window_s});
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    if (!with_emg(i)) continue;
    const TimeSeries& envelope =
        study.emg.kind == EmgKind::raw ? result.trials[i].emg->envelope : *inputs[i].emg;
    result.trials[i].activation =
        thinned(signals::normalise(envelope, result.normalisation), 250.0);
  }
}

identification::TorqueOptions torque_options(const Study& study,
                                             const StudyResult& result,
                                             const Progress& progress) {
  identification::TorqueOptions options;
  options.muscles = study.identify.muscles;
  options.priors = study.identify.priors;
  options.delay_s = study.emg.delay_s;
  options.max_rate_hz = study.identify.max_rate_hz;
  options.weights = study.identify.priors;
  const IdentifySpec& spec = study.identify;
  options.intervals = {.bootstrap = spec.bootstrap, .profile = spec.profile};
  options.loss = spec.loss == "huber"    ? identification::Loss::huber
                 : spec.loss == "cauchy" ? identification::Loss::cauchy
                                         : identification::Loss::square;
  options.eccentric = spec.eccentric == "product"       ? identification::Eccentric::product
                      : spec.eccentric == "slope_ratio" ? identification::Eccentric::slope_ratio
                      : spec.eccentric == "smooth"      ? identification::Eccentric::smooth
                                                        : identification::Eccentric::automatic;
  options.normalised = spec.normalised;
  options.dynamics = spec.dynamics;
  options.delay_per_channel = spec.delay_per_channel;
  options.angle_sd_rad = spec.angle_sd_rad;
  options.angle_rate_sd_radps = spec.angle_rate_sd_radps;
  options.from_mvc = study.emg.has_mvc || study.emg.kind == EmgKind::activation;
  options.progress.stop = progress.stop;
  if (study.identify.gain) {
    for (const signals::ChannelNormalisation& n : result.normalisation) {
      // Activation 1 is the greatest effort of the MVC trials: a share of what the muscle can do.
      const bool known = study.emg.has_mvc;
      const double effort = known ? study.emg.mvc_effort : 1.0;
      const double spread = known ? study.emg.mvc_effort_sd / effort : 0.0;
      options.gain_prior_sd[n.channel] = std::hypot(n.relative_sd, spread);
      options.gain_prior_mean[n.channel] = effort * (1.0 + n.relative_bias);
    }
  }
  options.envelope_cutoff_hz = study.emg.lowpass_hz;
  for (const signals::ChannelNormalisation& n : result.normalisation)
    options.emg_bandwidth_hz[n.channel] = n.bandwidth_hz;
  return options;
}

/// What would tell more than this recording did; without a dynamometer's movements, with the masses
/// that the laboratory has. Empty if the fit is none to go on from.
std::optional<DesignStudyResult> next_recording(const StudyResult& result, const RunOptions& run) {
  const Study& study = result.study;
  DesignStudyOptions options;
  options.choice.movements = study.identify.next_movements;
  options.catalogue.dynamometer = false;
  std::vector<double> masses{0.0};
  for (const TrialSpec& trial : study.trials) {
    if (std::find(masses.begin(), masses.end(), trial.held_mass_kg) == masses.end())
      masses.push_back(trial.held_mass_kg);
  }
  if (masses.size() > 1) options.catalogue.held_masses_kg = masses;
  options.progress.stop = run.progress.stop;
  for (const identification::IdentificationResult& method : result.methods) {
    if (method.method != "torque") continue;
    if (method.termination != math::Termination::converged || !method.covariance.allFinite())
      return std::nullopt;
    options.earlier = earlier_run(method);
  }
  return design_study(study, options);
}

}  // namespace

StudyInputs read_inputs(Study& study) {
  StudyInputs inputs;
  const model::BodyModel model = load_model(study);
  inputs.files.push_back({study.file.string(), sha256(recording::read_text_file(study.file))});
  if (study.model.file)
    inputs.files.push_back({study.model.file->string(), sha256(model_text(study))});
  if (study.truth) inputs.truth = read_truth(*study.truth);
  std::vector<std::vector<TrialPart>> parts(study.trials.size());
  oneapi::tbb::parallel_for(std::size_t{0}, study.trials.size(), [&](std::size_t i) {
    try {
      parts[i] = read_trial_parts(study, study.trials[i], model);
    } catch (const InvalidInput& error) {
      throw InvalidInput(fmt::format("{} (trial '{}')", error.what(), study.trials[i].name));
    }
  });
  study.trials.clear();
  for (std::vector<TrialPart>& of_one : parts) {
    for (TrialPart& part : of_one) {
      study.trials.push_back(std::move(part.spec));
      inputs.trials.push_back(std::move(part.input));
    }
  }
  for (const TrialInput& trial : inputs.trials) {
    for (const InputFile& file : trial.files) {
      const bool known = std::any_of(inputs.files.begin(), inputs.files.end(),
                                     [&](const InputFile& f) { return f.path == file.path; });
      if (!known) inputs.files.push_back(file);
    }
  }
  return inputs;
}

StudyResult run_study(const Study& whole, const RunOptions& options) {
  Study study = whole;
  restrict_trials(study, options.start_s, options.end_s);
  options.progress.tell(0.0, "reading");
  const auto begin = std::chrono::steady_clock::now();
  StudyInputs inputs = read_inputs(study);
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin;
  StudyResult result = analyse(study, std::move(inputs), options);
  result.start_s = options.start_s;
  result.end_s = options.end_s;
  result.times.insert(result.times.begin(), {"reading", elapsed.count()});
  return result;
}

StudyResult analyse(const Study& study, StudyInputs given, const RunOptions& options) {
  if (given.trials.size() != study.trials.size())
    throw InvalidInput(
        fmt::format("{} inputs are given for {} trials", given.trials.size(), study.trials.size()));
  StudyResult result;
  result.study = study;
  result.model_text = model_text(study);
  result.model = load_model(study);
  result.truth = std::move(given.truth);
  result.inputs = std::move(given.files);
  const std::vector<TrialInput> inputs = std::move(given.trials);
  result.trials.resize(inputs.size());
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    result.trials[i].spec = study.trials[i];
    result.trials[i].notes = inputs[i].notes;
    result.trials[i].warnings = inputs[i].warnings;
    result.trials[i].emg_clock = inputs[i].emg_clock;
  }
  Stages stages(options, result.times);
  stages.run("EMG", 0.15, [&] { process_all_emg(study, inputs, result); });
  stages.run("quality", 0.25, [&] {
    oneapi::tbb::parallel_for(std::size_t{0}, inputs.size(), [&](std::size_t i) {
      TrialResult& trial = result.trials[i];
      const TimeSeries envelope = trial.emg       ? trial.emg->envelope
                                  : inputs[i].emg ? *inputs[i].emg
                                                  : TimeSeries();
      trial.faults = trial_faults(study, inputs[i], envelope);
    });
  });

  std::optional<StageStore> store;
  if (options.store) store.emplace(*options.store);
  stages.run("motion and forces", 0.3, [&] {
    std::atomic<int> done = 0;
    oneapi::tbb::parallel_for(std::size_t{0}, study.trials.size(), [&](std::size_t i) {
      options.progress.check();
      TrialResult& trial = result.trials[i];
      try {
        trial.model = load_model(study, inputs[i].markers ? &*inputs[i].markers : nullptr);
        if (trial.spec.held_mass_kg > 0.0) {
          HeldMassSpec held;
          if (study.model.held_mass) {
            held = *study.model.held_mass;
          } else if (!study.model.file) {
            held = {"forearm_hand", model::arm4_held_at_m()};
          } else {
            throw InvalidInput(
                "held_mass_kg is given, but [model] held_mass does not say where it acts");
          }
          trial.model = dynamics::with_held_mass(std::move(trial.model), held.body, held.p_BP_m,
                                                 trial.spec.held_mass_kg);
        }
        compute_motion(study, inputs[i], result.model_text, store ? &*store : nullptr, trial);
        if (trial.motion.q.sample_count() > 0)
          compute_forces(study, inputs[i], options.share_forces, trial);
      } catch (const InvalidInput& error) {
        trial.failure = error.what();
      }
      options.progress.tell(0.3 + 0.4 * ++done / static_cast<double>(study.trials.size()),
                            trial.spec.name);
    });
    for (const TrialResult& trial : result.trials) {
      if (!trial.failure.empty()) ++result.failed_trials;
    }
    if (store) store->remove_unused();
    if (result.failed_trials == static_cast<int>(result.trials.size()))
      throw InvalidInput(result.trials.front().failure);
  });

  stages.run("identification", 0.7, [&] {
    const std::vector<MuscleGroup> groups = muscle_groups(study, result.model);
    result.data.muscles = muscle_setups(study, result.model);
    for (const TrialResult& trial : result.trials) {
      if (!trial.has_motion() || trial.activation.empty()) continue;
      if (trial.spec.use == Use::mvc || trial.spec.use == Use::static_pose ||
          trial.spec.use == Use::passive)
        continue;
      result.data.trials.push_back(trial_data(study, trial, groups));
    }
    if (study.identify.priors) result.data.rules = nuisance_rules(study.emg, result.data);
    result.data.rules.insert(result.data.rules.end(), study.parameters.begin(),
                             study.parameters.end());
    if (study.phases.search && !result.data.trials.empty()) {
      result.phases = study_phases(result, torque_options(study, result, options.progress));
      exclude_phases(study.phases.exclude, result.phases, result.data);
    }
    for (const std::string& method : study.identify.methods) {
      if (method == "paper") {
        result.methods.push_back(identification::identify_paper(
            result.data, {.muscles = study.identify.muscles, .shared_forces = true}));
      } else if (method == "force") {
        identification::EstimatorOptions estimator =
            torque_options(study, result, options.progress);
        estimator.intervals.profile = false;
        result.methods.push_back(identification::identify_force(
            result.data, {.estimator = std::move(estimator), .shared_forces = true}));
      } else {
        result.methods.push_back(identification::identify_torque(
            result.data, torque_options(study, result, options.progress)));
      }
    }
  });
  for (const identification::IdentificationResult& method : result.methods) {
    if (method.method != "torque") continue;
    for (const identification::TrialData& trial : result.data.trials) {
      const identification::Prediction p =
          identification::predict(result.data, trial, method.values, method.dynamics);
      result.informed.push_back(
          identification::informed_forces(trial, p.activation, method.values.muscles));
    }
  }
  if (study.identify.force_loop) {
    stages.run("forces and parameters", 0.8, [&] {
      identification::EstimatorOptions estimator = torque_options(study, result, options.progress);
      estimator.intervals = {};
      result.force_loop = identification::iterate_forces(
          result.data,
          {.force = {.estimator = std::move(estimator), .shared_forces = true}, .delay_s = 0.06});
    });
  }
  const bool torque = std::find(study.identify.methods.begin(), study.identify.methods.end(),
                                "torque") != study.identify.methods.end();
  if (study.identify.cross_validate && torque) {
    stages.run("cross-validation", 0.85, [&] {
      identification::TorqueOptions fold_options = torque_options(study, result, options.progress);
      for (const identification::IdentificationResult& method : result.methods) {
        if (method.method == "torque") fold_options.warm_start = method.solution;
      }
      const identification::FoldKind kind =
          study.identify.folds == "condition" ? identification::FoldKind::condition
          : study.identify.folds == "block"   ? identification::FoldKind::block
                                              : identification::FoldKind::trial;
      result.folds = identification::cross_validate(result.data, fold_options, {.kind = kind});
    });
  }
  if (study.identify.next_movements > 0 && torque) {
    stages.run("next recording", 0.95, [&] { result.next = next_recording(result, options); });
  }
  demote_by_gates(result);
  options.progress.tell(1.0, "done");
  return result;
}

}  // namespace myoid::pipeline
