#include "myoid/study/intake/emg_offset.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "myoid/recording/signals/quality_limits.h"

namespace myoid::study {
namespace {

constexpr double kFloor = 0.02;            // the share of the samples below the floor, and above the top
constexpr double kNear = 0.05;             // of the floor
constexpr double kLeastShareOfTop = 0.03;  // a floor below changes nothing
constexpr double kLeastTime = 0.1;         // of the trial, near the floor
constexpr int kLeastVisits = 10;

/// The floor of a channel in one trial.
struct Floor {
  double level = 0.0, top = 0.0;
  bool steady = false;  ///< The envelope comes back to the level many times.
};

double at_share(const Eigen::VectorXd& sorted, double share) {
  return sorted[static_cast<Eigen::Index>(share * static_cast<double>(sorted.size() - 1))];
}

Floor floor_of(const Eigen::VectorXd& envelope) {
  Eigen::VectorXd sorted = envelope;
  std::sort(sorted.begin(), sorted.end());
  Floor found{.level = at_share(sorted, kFloor), .top = at_share(sorted, 1.0 - kFloor)};
  Eigen::Index near = 0;
  int visits = 0;
  bool was_near = false;
  for (const double value : envelope) {
    const bool is_near = value >= (1.0 - kNear) * found.level && value <= (1.0 + kNear) * found.level;
    near += is_near ? 1 : 0;
    visits += is_near && !was_near ? 1 : 0;
    was_near = is_near;
  }
  found.steady =
      visits >= kLeastVisits && static_cast<double>(near) >= kLeastTime * static_cast<double>(envelope.size());
  return found;
}

Remark offset_of(const std::string& trial, const std::string& channel, double level, double elsewhere, bool kept) {
  return {.code = RemarkCode::emg_offset,
          .severity = Severity::warning,
          .where = trial,
          .about = channel,
          .value = level,
          .says = fmt::format(
              "channel '{}' never falls below {:.2g} and comes back to it all the time, while it falls "
              "to {:.2g} in another trial: a constant of the envelope, no activity; {}",
              channel, level, elsewhere,
              kept ? "activations keep it, because they may be computed" : fmt::format("{:.2g} is taken off", level)),
          .remedy = kept ? "take it off the file if these are envelopes of EMG"
                         : "look at the rectification and the baseline of that recording"};
}

}  // namespace

std::vector<Remark> take_off_emg_offsets(const Study& study, std::vector<TrialInput>& inputs) {
  std::vector<Remark> found;
  if (study.emg.kind == EmgKind::raw) return found;
  const bool kept = study.emg.kind == EmgKind::activation;
  std::vector<std::string> channels;
  for (const MuscleSpec& muscle : study.muscles)
    if (std::ranges::find(channels, muscle.emg) == channels.end()) channels.push_back(muscle.emg);
  for (const std::string& channel : channels) {
    std::vector<Floor> floors(inputs.size());
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      const auto column = inputs[i].emg ? inputs[i].emg->find(channel) : std::nullopt;
      if (!column || inputs[i].emg->sample_count() < 2) continue;
      floors[i] = floor_of(inputs[i].emg->values().col(*column));
      if (floors[i].top > 0.0) least = std::min(least, std::max(floors[i].level, 0.0));  // a dead channel tells nothing
    }
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      const Floor& floor = floors[i];
      if (!floor.steady || !(floor.level > kLeastShareOfTop * floor.top) ||
          !(floor.level > recording::kLimits.levels.offset * least))
        continue;
      found.push_back(offset_of(study.trials[i].name, channel, floor.level, least, kept));
      if (kept) continue;
      const TimeSeries& emg = *inputs[i].emg;
      Eigen::MatrixXd values = emg.values();
      auto envelope = values.col(*emg.find(channel));
      envelope = (envelope.array() - floor.level).cwiseMax(0.0);
      inputs[i].emg = TimeSeries(emg.time_s(), emg.channels(), std::move(values));
    }
  }
  return found;
}

}  // namespace myoid::study
