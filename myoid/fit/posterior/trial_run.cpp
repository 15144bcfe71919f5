#include "myoid/fit/posterior/trial_run.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "myoid/fit/posterior/drive.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/core/parallel.h"

namespace myoid::fit {
namespace {

constexpr double kLongest_s = 8.0;
constexpr Eigen::Index kFewest = 8;  // samples of a run

/// Cuts the stretch into pieces of equal length, none longer than kLongest_s apart from the samples
/// that neighbors share.
std::vector<std::vector<Eigen::Index>> pieces(const std::vector<Eigen::Index>& rows,
                                              const Eigen::VectorXd& time_s,
                                              std::optional<double> cutoff_hz) {
  const double span = time_s[rows.back()] - time_s[rows.front()];
  const auto count = static_cast<std::size_t>(std::max(1.0, std::ceil(span / kLongest_s)));
  const double rate_hz = static_cast<double>(rows.size() - 1) / std::max(span, 1e-9);
  const auto shared = static_cast<std::size_t>(shared_samples(rate_hz, cutoff_hz));
  const std::size_t own = rows.size() > shared ? (rows.size() - shared) / count : 0;
  std::vector<std::vector<Eigen::Index>> found;
  for (std::size_t k = 0; k < count; ++k) {
    const auto first = rows.begin() + static_cast<std::ptrdiff_t>(k * own);
    found.emplace_back(first, k + 1 == count ? rows.end() : first + static_cast<std::ptrdiff_t>(own + shared));
  }
  return found;
}

using Drives = std::vector<std::shared_ptr<const Drive>>;  // by channel

/// Returns the drive behind the envelope of each channel. An activation without EMG has no noise.
Drives drives_of(const TrialData& trial, const EstimatorOptions& options, const ParameterMap& map) {
  const EnvelopeError plain(options.envelope_cutoff_hz, {});
  const auto memory = options.drives ? options.drives : std::make_shared<DriveMemory>();
  Drives drives;
  for (std::size_t c = 0; c < map.channels().size(); ++c) {
    const std::string& name = map.channels()[c];
    const double noise_sd = map.unseen_activation(c) ? 0.0 : envelope_spread(options, name);
    drives.push_back(
        memory->behind(trial.activation, name, noise_sd, options.rest_level(name), plain, options.envelope_cutoff_hz));
  }
  return drives;
}

/// The envelopes of a trial that a run reads: lags and memory grow with the run, and not with its trial.
struct Reads {
  static constexpr double kLagsForget_s = 2.0, kSplineForgets_s = 0.5;
  double first_s = -std::numeric_limits<double>::infinity(), last_s = std::numeric_limits<double>::infinity();
};

void add_envelopes(const TrialData& trial,
                   const Drives& drives,
                   const EstimatorOptions& options,
                   const ParameterMap& map,
                   const Reads& reads,
                   TrialRun& run) {
  run.envelope_sd.resize(static_cast<Eigen::Index>(drives.size()));
  run.parts.resize(drives.size());
  run.rest.resizeLike(run.envelope_sd);
  for (std::size_t c = 0; c < drives.size(); ++c) {
    const std::string& name = map.channels()[c];
    const auto column = static_cast<Eigen::Index>(c);
    run.envelopes.push_back(drives[c]->envelope.within(reads.first_s, reads.last_s));
    run.rest[column] = options.rest_level(name);
    if (const std::optional<UnseenActivation>& unseen = map.unseen_activation(c)) {
      run.envelope_sd[column] = unseen->sd;
      run.errors.emplace_back(unseen->cutoff_hz, std::array<double, 2>{});
      for (const std::string& part : unseen->parts)
        run.parts[c].push_back(
            Envelope(trial.activation.time_s(), trial.activation.column(part)).within(reads.first_s, reads.last_s));
      continue;
    }
    run.envelope_sd[column] = envelope_spread(options, name);
    run.errors.push_back(EnvelopeError(options.envelope_cutoff_hz, lag_times_s(map.held().channels[c], options.law))
                             .behind(drives[c]->left));
  }
}

/// Fills the rows of the run's j-th joint from the trial's view of it (of_joint).
void add_joint(const TrialData& view,
               const std::vector<Eigen::Index>& rows,
               std::size_t j,
               const ParameterMap& map,
               TrialRun& run) {
  const Eigen::Index n = run.time_s.size(), m = run.reduction.outputs(), first = run.first_row(j);
  const auto& names = map.joints();
  run.joints[j] = static_cast<int>(std::find(names.begin(), names.end(), view.joint) - names.begin());
  run.arm_m.middleRows(first, n) = view.moment_arm_m(rows, Eigen::all);
  run.resting_nm.segment(first, n) = resting_torque_nm(view)(rows);
  if (run.dynamics_nm.size() > 0) run.dynamics_nm.segment(first, n) = view.dynamics_nm(rows);
  run.measured_nm.segment(static_cast<Eigen::Index>(j) * m, m) =
      run.reduction.apply(Eigen::VectorXd(view.torque_nm(rows)));
  if (const Eigen::MatrixXd motion = motion_of(view, view.time_s.size()); motion.size() > 0)
    run.motion.middleRows(first, n) = motion(rows, Eigen::all);
}

/// Adds the fascicles that these rows of the trial measure.
void add_fascicles(const TrialData& trial, const std::vector<Eigen::Index>& rows, TrialRun& run) {
  if (trial.fascicle_m.size() == 0) return;
  const Eigen::Index m = run.reduction.outputs();
  for (Eigen::Index k = 0; k < trial.fascicle_m.cols(); ++k) {
    const Eigen::VectorXd length_m = run.reduction.apply(Eigen::VectorXd(trial.fascicle_m(rows, k)));
    if (!length_m.array().isFinite().any()) continue;
    run.fascicles.push_back(static_cast<std::size_t>(k));
    run.measured_m.conservativeResize(run.measured_m.size() + m);
    run.measured_m.tail(m) = length_m;
  }
}

TrialRun make_run(const TrialData& trial,
                  const std::vector<Eigen::Index>& rows,
                  const Drives& drives,
                  const EstimatorOptions& options,
                  const ParameterMap& map,
                  const Reads& reads) {
  const auto n = static_cast<Eigen::Index>(rows.size());
  const std::size_t joints = joint_count(trial);
  const double span = trial.time_s[rows.back()] - trial.time_s[rows.front()];
  const double rate_hz = static_cast<double>(n - 1) / span;
  TrialRun run{.joints = std::vector<int>(joints),
               .time_s = trial.time_s(rows),
               .length_m = trial.length_m(rows, Eigen::all),
               .velocity_mps = trial.velocity_mps(rows, Eigen::all),
               .interval_s = 1.0 / rate_hz,
               .reduction = Reduction(n, rate_hz, options.residual_cutoff_hz)};
  run.arm_m.resize(run.row_count(), trial.moment_arm_m.cols());
  run.motion.setZero(run.row_count(), 3);
  run.resting_nm.resize(run.row_count());
  run.dynamics_nm.resize(trial.dynamics_nm.size() > 0 ? run.row_count() : 0);
  run.measured_nm.resize(static_cast<Eigen::Index>(joints) * run.reduction.outputs());
  for (std::size_t j = 0; j < joints; ++j) add_joint(of_joint(trial, j), rows, j, map, run);
  add_fascicles(trial, rows, run);
  add_envelopes(trial, drives, options, map, reads, run);
  return run;
}

bool is_fitted(const TrialData& trial) { return trial.calibration; }

/// The fitted trials in their order, as the time of the session.
class Session {
 public:
  explicit Session(const StudyData& data) {
    double references = 0.0, of_references = 0.0;
    for (const TrialData& trial : data.trials) {
      if (!trial.calibration) continue;
      if (trial.reference) {
        references += 1.0;
        of_references += trials_ + 0.5;
      }
      trials_ += 1.0;
    }
    if (references > 0.0) reference_ = of_references / references;
  }
  /// Returns the place behind so many fitted trials (TrialRun::session).
  [[nodiscard]] double place(double before) const { return (std::min(before, trials_) - reference_) / trials_; }

 private:
  double trials_ = 0.0, reference_ = 0.0;
};

}  // namespace

std::vector<TrialRun> trial_runs(const StudyData& data, const EstimatorOptions& options, const ParameterMap& map) {
  const Session session(data);
  std::vector<Drives> drives(data.trials.size());
  parallel_ranges(data.trials.size(), std::size_t{1}, [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      if (data.trials[i].calibration) drives[i] = drives_of(data.trials[i], options, map);
    }
  });
  std::vector<TrialRun> runs;
  double before = 0.0;
  for (std::size_t i = 0; i < data.trials.size(); ++i) {
    const TrialData& trial = data.trials[i];
    if (!trial.calibration) continue;
    const double begin = trial.time_s[0], span = trial.time_s[trial.time_s.size() - 1] - begin;
    for (const auto& stretch : fitted_stretches(trial, options.max_rate_hz, map.longest_delay_s())) {
      if (static_cast<Eigen::Index>(stretch.size()) < kFewest) continue;
      for (const auto& rows : pieces(stretch, trial.time_s, options.residual_cutoff_hz)) {
        if (static_cast<Eigen::Index>(rows.size()) < kFewest) continue;
        const Reads reads{trial.time_s[rows.front()] - map.longest_delay_s() - Reads::kLagsForget_s,
                          trial.time_s[rows.back()] + Reads::kSplineForgets_s};
        TrialRun& run = runs.emplace_back(make_run(trial, rows, drives[i], options, map, reads));
        run.trial = static_cast<int>(i);
        const double middle = 0.5 * (run.time_s[0] + run.time_s[run.time_s.size() - 1]) - begin;
        run.session = session.place(before + middle / span);
      }
    }
    before += 1.0;
  }
  if (runs.empty())
    throw InvalidInput("identification: no calibration sample is left; EMG and motion must overlap in time");
  return runs;
}

TrialRun whole_run(const TrialData& trial,
                   const StudyData& data,
                   const EstimatorOptions& options,
                   const ParameterMap& map) {
  std::vector<Eigen::Index> rows(static_cast<std::size_t>(trial.time_s.size()));
  std::iota(rows.begin(), rows.end(), Eigen::Index{0});
  TrialRun run = make_run(trial, rows, drives_of(trial, options, map), options, map, {});
  const auto here =
      std::find_if(data.trials.begin(), data.trials.end(), [&](const TrialData& of) { return of.name == trial.name; });
  const auto before = static_cast<double>(std::count_if(data.trials.begin(), here, is_fitted));
  run.trial = static_cast<int>(here - data.trials.begin());
  run.session = Session(data).place(before + 0.5);
  return run;
}

TimeSeries drives(const TrialRun& run, const std::vector<std::string>& channels) {
  const auto finest =
      std::max_element(run.envelopes.begin(), run.envelopes.end(),
                       [](const Envelope& a, const Envelope& b) { return a.time_s().size() < b.time_s().size(); });
  if (finest == run.envelopes.end()) return {};
  const Eigen::VectorXd& time = finest->time_s();
  std::vector<Channel> columns;
  Eigen::MatrixXd values(time.size(), static_cast<Eigen::Index>(run.envelopes.size()));
  for (std::size_t c = 0; c < run.envelopes.size(); ++c) {
    columns.push_back({channels[c], Unit::dimensionless});
    values.col(static_cast<Eigen::Index>(c)) = time.unaryExpr([&](double t) { return run.envelopes[c].at(t).value; });
  }
  return {time, std::move(columns), std::move(values)};
}

}  // namespace myoid::fit
