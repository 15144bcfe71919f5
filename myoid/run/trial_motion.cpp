#include "myoid/run/trial_motion.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "myoid/body/kinematics/motion_plausibility.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/core/parallel.h"
#include "myoid/recording/signals/resample.h"
#include "myoid/study/checks/marker_distance.h"
#include "myoid/study/intake/trial_input.h"
#include "myoid/study/intake/trial_model.h"

namespace myoid::run {
namespace {

/// Returns the model of a trial: a copy only where it differs from the study's.
std::shared_ptr<const body::BodyModel> model_of(const StudySource& source,
                                                const study::TrialSpec& spec,
                                                const study::TrialInput& input) {
  auto own = study::trial_model(source.study, *source.model, spec, input);
  return own ? std::make_shared<const body::BodyModel>(std::move(*own)) : source.model;
}

/// Solves inverse kinematics, or takes the result of an earlier run from the same input.
void solve_ik(const StudySource& source, const MarkerSeries& markers, StageStore* store, TrialMotion& motion) {
  const std::string key = store != nullptr ? ik_key(source.study, source.model_text, markers) : "";
  if (store != nullptr) motion.ik = store->find(key);
  motion.ik_reused = motion.ik.has_value();
  if (motion.ik_reused) return;
  motion.ik_was_damaged = store != nullptr && store->is_damaged(key);
  motion.ik = body::inverse_kinematics(*motion.model, markers, {.marker_weights = source.study.markers.weight});
  if (store != nullptr) store->keep(key, *motion.ik);
}

/// Adds the coordinates at the times of given lengths, else on the clock of the analysis, smoothed as the study says,
/// with derivatives.
void add_joint_motion(const study::Study& study, const study::GivenStages& given, TimeSeries q, TrialMotion& motion) {
  body::MotionOptions options;
  options.cutoff_hz = study::motion_cutoff_hz(study);
  const double rate = q.mean_rate_hz();
  const double wanted = options.cutoff_hz ? study.motion.rate_hz : rate;
  if (options.cutoff_hz && *options.cutoff_hz >= 0.45 * rate) {
    study::add_notes({fmt::format("motion at {:.0f} Hz is too slow to be smoothed at {:.3g} Hz: not smoothed", rate,
                                  *options.cutoff_hz)},
                     motion.remarks);
    options.cutoff_hz.reset();
  }
  const Eigen::VectorXd& clock = q.time_s();
  if (given.lengths)
    options.time_s = given.lengths->time_s();
  else if (std::abs(wanted - rate) > 0.01 * rate || !q.is_uniform())
    options.time_s = recording::even_clock(clock[0], clock[clock.size() - 1], wanted);
  // Frequencies that a slower clock cannot hold are removed first, if the smoothing spline, whose
  // gain is 1 / (1 + (f/f_c)^6), leaves more than a thousandth of them at half the new rate.
  const bool smoothed_away = options.cutoff_hz && std::pow(0.5 * wanted / *options.cutoff_hz, 6) >= 999.0;
  if (options.time_s && !given.lengths && !smoothed_away && q.is_uniform()) q = recording::anti_aliased(q, wanted);
  body::MotionResult result = body::joint_motion(*motion.model, q, options);
  motion.joints = std::move(result.motion);
  std::ranges::move(result.notes, std::back_inserter(motion.remarks));
}

}  // namespace

TrialMotion trial_motion(const StudySource& source,
                         const study::TrialSpec& spec,
                         const study::TrialInput& input,
                         StageStore* store) {
  TrialMotion motion;
  motion.model = model_of(source, spec, input);
  if (input.markers) {
    solve_ik(source, *input.markers, store, motion);
    std::ranges::copy(motion.ik->notes, std::back_inserter(motion.remarks));
    if (auto far = study::far_markers(source.study, spec, *motion.model, *input.markers, *motion.ik))
      motion.remarks.push_back(std::move(*far));
    add_joint_motion(source.study, input.given, motion.ik->q, motion);
    std::vector<Remark> found = body::implausible_motion(motion.ik->q);
    std::ranges::move(body::remarks_on_ends(*motion.model, motion.ik->q), std::back_inserter(found));
    for (Remark& remark : found) remark.where = spec.name;
    std::ranges::move(found, std::back_inserter(motion.remarks));
  } else if (input.motion && input.motion->channel_count() == 0) {
    const TimeSeries times(input.given.lengths->time_s(), {}, Eigen::MatrixXd(input.given.lengths->sample_count(), 0));
    motion.joints = {times, times, times};
  } else if (input.motion) {
    add_joint_motion(source.study, input.given, *input.motion, motion);
  }
  return motion;
}

std::vector<TrialMotion> study_motion(const StudyInputs& inputs, StageStore* store, const Progress& progress) {
  const std::vector<study::TrialSpec>& specs = inputs.source.study.trials;
  std::vector<TrialMotion> motions(specs.size());
  std::atomic<int> done = 0;
  parallel_each(specs.size(), [&](std::size_t i) {
    progress.check();
    try {
      motions[i] = trial_motion(inputs.source, specs[i], inputs.trials[i], store);
    } catch (const InvalidInput& error) {
      motions[i].model = inputs.source.model;
      motions[i].failure = error.what();
    }
    progress.tell(++done / static_cast<double>(specs.size()), specs[i].name);
  });
  return motions;
}

}  // namespace myoid::run
