#include "myoid/study/checks/study_plausibility.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "myoid/body/dynamics/ground_support.h"
#include "myoid/body/dynamics/torque_plausibility.h"
#include "myoid/body/model/model_plausibility.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/core/units.h"
#include "myoid/study/checks/contact_table.h"
#include "myoid/study/checks/determined_joint.h"
#include "myoid/study/checks/excluded_times.h"
#include "myoid/study/checks/fiber_room.h"
#include "myoid/study/checks/foreign_contacts.h"
#include "myoid/study/checks/load_points.h"
#include "myoid/study/checks/marker_sides.h"
#include "myoid/study/checks/model_mass.h"
#include "myoid/study/checks/stated_body.h"
#include "myoid/study/checks/study_muscles.h"

namespace myoid::study {
namespace {

/// Names the file of a trial's loads.
std::string loads_of(const TrialSpec& trial) {
  if (trial.external_loads) return trial.external_loads->filename().string();
  return trial.plates ? trial.plates->file.filename().string() : "the load cell";
}

/// Finds a coordinate that carries the body in a trial without any measured force, or with wrong ones.
std::optional<Remark> check_support(const Study& study,
                                    const body::BodyModel& model,
                                    const TrialSpec& trial,
                                    const TrialInput& input) {
  if ((!input.loads && trial.use == Use::static_pose) || input.external_torque) return std::nullopt;
  if (!input.motion && !input.markers) return std::nullopt;
  Eigen::VectorXd q = model.default_q();
  if (study.model.is_none() || trial.given.torques) return std::nullopt;
  if (input.motion) {
    for (Eigen::Index c = 0; c < input.motion->channel_count(); ++c) {
      const auto index = model.find_coordinate(input.motion->channels()[static_cast<std::size_t>(c)].name);
      if (index) q[*index] = input.motion->values()(0, c);
    }
  }
  for (const std::string& name : study_coordinates(study.model)) {
    if (!model.find_coordinate(name) || !body::bears_the_body(model, name, q, study.subject.mass_kg.value_or(0.0)))
      continue;
    Remark remark{.code = RemarkCode::body_unsupported,
                  .severity = Severity::warning,
                  .where = trial.name,
                  .about = "ground",
                  .says = {}};
    if (input.loads) {
      const Eigen::VectorXd& time_s = input.markers ? input.markers->time_s : input.motion->time_s();
      const auto wrong = body::wrong_support(model, *input.loads, time_s);
      if (!wrong) return std::nullopt;
      if (wrong->is_misdirected()) remark.severity = Severity::error;
      remark.says = fmt::format("{}: {}", loads_of(trial), wrong->sentence());
      return remark;
    }
    const auto weight = body::unsupported_weight(model);
    if (!weight) return std::nullopt;
    remark.says = weight->sentence("external_loads or force_plates");
    return remark;
  }
  return std::nullopt;
}

/// Returns the findings on the model and its muscles; none without a model.
std::vector<Remark> of_the_model(const Study& study, const body::BodyModel& model) {
  if (study.model.is_none()) return {};
  std::vector<Remark> found = body::implausible(model);
  for (Remark& remark : found) remark.where = "study";
  for (std::vector<Remark> more :
       {idle_muscles(study, model), tendons_too_long(study, model), unlikely_mass(study, model)})
    std::ranges::move(more, std::back_inserter(found));
  return found;
}

/// Finds a joint whose measured torque stays far below its muscles in every effort: another unit than the header's.
std::vector<Remark> small_torques(const Capacities& capacities, const std::map<std::string, double>& peaks_nm) {
  std::vector<Remark> found;
  for (const auto& [name, peak_nm] : peaks_nm) {
    const double least_nm = kLimits.joints.least_torque_share * capacities.at(name).isometric_nm();
    if (!(peak_nm > 0.0) || peak_nm >= least_nm) continue;
    found.push_back({.code = RemarkCode::unit_doubtful,
                     .severity = Severity::warning,
                     .where = "study",
                     .about = name,
                     .value = peak_nm,
                     .says = fmt::format("the measured torque on {} is at most {:.2g} N m in every trial, and the "
                                         "muscles of the model make {:.3g} N m: are its numbers in a larger unit than "
                                         "the header of external_torque says",
                                         name, peak_nm, capacities.at(name).isometric_nm()),
                     .remedy = "write the unit of the numbers in the header, as in '" + name + "_moment [N m]'"});
  }
  return found;
}

/// Finds a joint of which no motion of the study reaches an angle that people bend to, although it moves: radians that
/// are called degrees.
std::vector<Remark> small_angles(const AnglesOfStudy& angles) {
  std::vector<Remark> found;
  for (const auto& [name, trials] : angles) {
    const AngleSpan span = span_of(trials);
    const double largest_deg = std::max(span.greatest_rad, -span.least_rad) / kDegree;
    const double range_deg = (span.greatest_rad - span.least_rad) / kDegree;
    if (largest_deg >= kLimits.joints.least_angle_deg || range_deg < kLimits.joints.least_angle_range_deg) continue;
    found.push_back({.code = RemarkCode::unit_doubtful,
                     .severity = Severity::warning,
                     .where = "study",
                     .about = name,
                     .value = largest_deg,
                     .says = fmt::format("{} goes from {:.2g} to {:.2g} degrees over all trials: are these the radians "
                                         "of {:.0f} to {:.0f} degrees, under a header that says degrees",
                                         name, span.least_rad / kDegree, span.greatest_rad / kDegree,
                                         span.least_rad / kDegree / kDegree, span.greatest_rad / kDegree / kDegree),
                     .remedy = "then write " + name + " [rad] into the headers (of a .mot inDegrees=no)"});
  }
  return found;
}

}  // namespace

StudyPlausibility::StudyPlausibility(const Study& study, const body::BodyModel& model)
    : study_(&study), model_(&model), capacities_(joint_capacities(study, model)) {}

void StudyPlausibility::remember_extremes(const TrialSpec& trial, const TrialInput& input) {
  if (input.external_torque && trial.use != Use::passive && trial.use != Use::static_pose) {
    for (const auto& [name, capacity] : capacities_) {
      if (const auto column = input.external_torque->find(name + "_moment")) {
        double& peak_nm = torque_peaks_nm_[name];
        peak_nm = std::max(peak_nm, body::usual_peak(input.external_torque->values().col(*column)));
      }
    }
  }
  const bool is_doubted =
      std::ranges::find(input.remarks, RemarkCode::unit_doubtful, &Remark::code) != input.remarks.end();
  for (const std::string& name : study_coordinates(study_->model)) {
    const auto column = input.motion ? input.motion->find(name) : std::nullopt;
    if (!column || is_doubted || input.motion->channels()[static_cast<std::size_t>(*column)].unit != Unit::radian)
      continue;
    const auto q = input.motion->values().col(*column);
    const bool moves = (trial.use == Use::calibration || trial.use == Use::validation) && !input.external_torque;
    angles_[name].push_back({trial.name, !moves, {q.minCoeff(), q.maxCoeff()}});
  }
}

void StudyPlausibility::look_at(const TrialSpec& trial, const TrialInput& input) {
  prints_.push_back(print_of(trial, input));
  const std::vector<TrialLengths> lengths = lengths_of(trial, input);
  std::ranges::copy(lengths, std::back_inserter(lengths_));
  remember_extremes(trial, input);
  if (input.markers) sizes_.push_back(size_of(*model_, trial.name, *input.markers));
  if (input.emg) {
    for (const MuscleSpec& muscle : study_->muscles) {
      if (const auto column = input.emg->find(muscle.emg))
        largest_emg_ = std::max(largest_emg_, input.emg->values().col(*column).maxCoeff());
    }
  }
  std::vector<Remark> found = implausible(*study_, *model_, capacities_, trial, input);
  auto sides = input.markers ? exchanged_sides(*model_, trial, *input.markers, study_->markers.weight) : std::nullopt;
  if (!sides && input.markers)
    sides = turned_markers(*model_, trial, *input.markers, input.up_L, study_->markers.weight);
  const auto is_vertical = [](const Remark& f) { return f.code == RemarkCode::vertical_across_trunk; };
  // A trunk with exchanged labels seems to stand on its head.
  if (sides) std::erase_if(found, is_vertical);
  // Exchanged labels, another vertical or another rate put the forces elsewhere.
  const bool places_differ = std::ranges::any_of(found, is_vertical) || is_rate_wrong(lengths);
  std::ranges::move(found, std::back_inserter(of_trials_));
  found = sides ? std::vector<Remark>{*sides} : std::vector<Remark>{};
  const MarkerSeries* markers = input.markers ? &*input.markers : nullptr;
  const TimeSeries* motion = input.motion ? &*input.motion : nullptr;
  foreign_times_.clear();
  if (found.empty() && !places_differ && input.loads && (markers != nullptr || motion != nullptr)) {
    const ContactTable table = contact_table(*model_, *input.loads, {*model_, markers, motion});
    found = misplaced_loads(*model_, table, loads_of(trial));
    for (Remark& remark : found) remark.where = trial.name;
    if (found.empty()) {
      ForeignContacts foreign = foreign_contacts(*model_, trial.name, table, trial.external_loads.has_value());
      foreign_times_ = std::move(foreign.times);
      found = std::move(foreign.remarks);
      if (trial.exclude.foreign_contacts) {
        for (Remark& remark : found) remark.severity = Severity::note;
      }
    }
  }
  std::ranges::move(found, std::back_inserter(of_trials_));
  std::ranges::move(excluded_times(trial, input, foreign_times_), std::back_inserter(of_trials_));
  if (!sides && input.markers && trial.use != Use::mvc) {
    if (auto open = open_joint(*study_, *model_, trial, *input.markers)) of_trials_.push_back(std::move(*open));
  }
  if (auto support = check_support(*study_, *model_, trial, input)) of_trials_.push_back(std::move(*support));
}

std::vector<Remark> StudyPlausibility::findings() const {
  std::vector<Remark> found = grouped(of_trials_);
  std::vector<Remark> same = same_recordings(prints_);
  // Computed activations may be equal for good reason.
  if (study_->emg.kind == EmgKind::activation) {
    for (Remark& f : same) f.severity = Severity::warning;
    if (largest_emg_ > 0.0 && largest_emg_ < kFlatActivation) {
      found.push_back(
          {.code = RemarkCode::flat_activations,
           .severity = Severity::warning,
           .where = "study",
           .says = fmt::format("[emg] kind = \"activation\", but no activation of any trial is above {:.2g}, expected "
                               "up to 1 in the greatest effort: is this EMG in volts? Set [emg] kind = \"envelope\"",
                               largest_emg_)});
    }
  }
  if (auto sizes = unlike_sizes(sizes_)) found.push_back(std::move(*sizes));
  for (std::vector<Remark> more :
       {shared_muscles(*study_), unlike_stated_bodies(*study_), same, small_torques(capacities_, torque_peaks_nm_),
        small_angles(angles_), unlike_angles(angles_), grouped(unlike_lengths(lengths_)),
        of_the_model(*study_, *model_)})
    std::ranges::move(more, std::back_inserter(found));
  return found;
}

void require_plausible(Study& study, const body::BodyModel& model, std::vector<TrialInput>& inputs) {
  StudyPlausibility plausibility(study, model);
  const auto take = [&](std::vector<Remark> findings) {
    for (Remark& f : findings) {
      if (f.severity == Severity::error)
        throw InvalidInput(f.where == "study" ? sentence(f) : fmt::format("{} (trial '{}')", sentence(f), f.where));
      // Findings on the whole study are listed with its first trial.
      std::size_t at = 0;
      while (at < inputs.size() && study.trials[at].name != f.where) ++at;
      inputs[at < inputs.size() ? at : 0].remarks.push_back(std::move(f));
    }
  };
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    plausibility.look_at(study.trials[i], inputs[i]);
    ExcludeSpec& exclude = study.trials[i].exclude;
    if (exclude.foreign_contacts)
      std::ranges::copy(margined(plausibility.foreign_times()), std::back_inserter(exclude.windows));
  }
  take(plausibility.findings());
}

}  // namespace myoid::study
