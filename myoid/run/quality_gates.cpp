#include "myoid/run/quality_gates.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/body/dynamics/ground_support.h"
#include "myoid/body/dynamics/torque_plausibility.h"
#include "myoid/body/forces/sharing_plausibility.h"
#include "myoid/ground/core/units.h"
#include "myoid/run/effort_prior.h"
#include "myoid/run/prediction_gates.h"
#include "myoid/run/recording_faults.h"
#include "myoid/study/checks/stated_loads.h"
#include "myoid/study/intake/limits.h"

namespace myoid::run {
namespace {

using fit::IdentificationResult;
using fit::Verdict;
using page::Gate;
using page::GateStatus;

/// Returns the range of the study's coordinate in the trial that moves it most; empty if no trial is a movement.
std::optional<double> largest_range_deg(const study::Study& study, const std::vector<TrialResult>& trials) {
  std::optional<double> largest;
  for (const TrialResult& t : trials) {
    const bool still = t.spec.use == study::Use::mvc || t.spec.use == study::Use::static_pose ||
                       t.spec.use == study::Use::isometric || t.spec.external_torque;
    const auto angle = t.motion.joints.q.find(study.model.coordinate);
    if (!t.has_motion() || still || !angle) continue;
    const Eigen::VectorXd q = t.motion.joints.q.values().col(*angle) / kDegree;
    largest = std::max(largest.value_or(0.0), q.maxCoeff() - q.minCoeff());
  }
  return largest;
}

/// Muscles of the model that act on the study's joints but are in no [[muscle]] table, and their
/// largest share of a joint's summed strength F_max |r|.
struct MissingMuscles {
  std::vector<std::string> names;
  double share = 0.0;
};

MissingMuscles missing_muscles(const StudyResult& result) {
  MissingMuscles missing;
  const auto count = static_cast<Eigen::Index>(result.source.model->muscles.size());
  std::vector<bool> there(result.source.model->muscles.size(), false);
  for (const study::MuscleSpec& spec : result.source.study.muscles) {
    for (const std::string& name : spec.osim)
      there[static_cast<std::size_t>(result.source.model->muscle_index(name))] = true;
  }
  for (const std::string& coordinate : study::study_coordinates(result.source.study.model)) {
    Eigen::VectorXd strength_nm = Eigen::VectorXd::Zero(count);
    for (const TrialResult& t : result.trials) {
      const auto arms = t.forces.muscles.moment_arm.find(coordinate);
      if (!t.has_motion() || arms == t.forces.muscles.moment_arm.end()) continue;
      strength_nm = strength_nm.cwiseMax(arms->second.values().cwiseAbs().colwise().mean().transpose());
    }
    for (Eigen::Index m = 0; m < count; ++m)
      strength_nm[m] *= result.source.model->muscles[static_cast<std::size_t>(m)].properties.max_isometric_force_n;
    const double all_nm = strength_nm.sum();
    double missing_nm = 0.0;
    for (Eigen::Index m = 0; m < count; ++m) {
      const auto i = static_cast<std::size_t>(m);
      if (there[i] || strength_nm[m] <= 0.002 * all_nm) continue;
      missing_nm += strength_nm[m];
      const std::string& name = result.source.model->muscles[i].name;
      if (std::ranges::find(missing.names, name) == missing.names.end()) missing.names.push_back(name);
    }
    if (all_nm > 0.0) missing.share = std::max(missing.share, missing_nm / all_nm);
  }
  return missing;
}

/// Returns a gate for a trial whose torque exceeds any joint's capacity; empty if there is none.
std::optional<Gate> torque_gate(const StudyResult& result) {
  for (const TrialResult& t : result.trials) {
    // Torques that are given with moment arms are compared with them (given_check.h).
    if (!t.has_motion() || (t.spec.given.torques && !t.spec.given.moment_arms.empty())) continue;
    const std::vector<Remark> found = body::implausible_torques(*result.source.model, t.forces.muscle_torque,
                                                                result.source.study.subject.mass_kg.value_or(0.0));
    if (found.empty()) continue;
    return Gate{"Torques that a joint can make", GateStatus::fail,
                fmt::format("'{}': {}", t.spec.name, found.front().says), "none beyond",
                "Masses, loads or their units are wrong, or the clock of the motion is."};
  }
  return std::nullopt;
}

/// Returns the gate of the loads that act on the person beside gravity.
Gate loads_gate(const std::vector<TrialResult>& trials) {
  std::vector<study::TrialSpec> specs;
  for (const TrialResult& t : trials) specs.push_back(t.spec);
  const std::optional<Remark> silent = study::unstated_loads(specs);
  return {"External loads stated", silent ? GateStatus::warn : GateStatus::pass,
          silent ? sentence(*silent) : std::string("in every trial"), "in every trial that is fitted or predicted",
          "A mass that was held and not stated makes every muscle weaker than it is."};
}

/// Returns a gate for a trial in which, at some times or always, no force carries a body whose
/// weight the study's joint supports; empty if there is none.
std::optional<Gate> support_gate(const StudyResult& result) {
  for (const TrialResult& t : result.trials) {
    if (t.forces.uncarried)
      return Gate{"Something carries the body", GateStatus::warn,
                  fmt::format("'{}': nothing measured does in {:.0f} % of the time", t.spec.name,
                              100.0 * t.forces.uncarried->share),
                  "no time in which half of the weight is on the joint to the ground",
                  "Torques of the legs there lack the ground reaction; they are not fitted."};
    const bool measured = t.spec.external_torque || t.spec.given.torques;
    if (!t.has_motion() || measured || t.forces.generalized.empty()) continue;
    const auto weight = body::unsupported_weight(*t.motion.model, t.forces.generalized);
    if (!weight) continue;
    const auto wrong =
        t.input.loads ? body::wrong_support(*t.motion.model, *t.input.loads, t.motion.joints.q.time_s()) : std::nullopt;
    const std::string says =
        wrong ? wrong->sentence() : weight->sentence(t.input.loads ? "" : "external_loads or force_plates");
    for (const std::string& name : study::study_coordinates(result.source.study.model)) {
      if (!body::bears_the_body(*t.motion.model, name, t.motion.joints.q.values().row(0).transpose(),
                                result.source.study.subject.mass_kg.value_or(0.0)))
        continue;
      return Gate{"Something carries the body", GateStatus::warn, fmt::format("'{}': {}", t.spec.name, says),
                  "less than half of the weight on the joint to the ground",
                  fmt::format("Unless the person hangs, sits or lies, the torque of {} is wrong.", name)};
    }
  }
  return std::nullopt;
}

/// Judges inverse kinematics. Empty if no trial has markers.
std::vector<Gate> marker_gates(const std::vector<TrialResult>& trials) {
  int frames = 0;
  int unconverged = 0;
  int blind = 0;
  double worst_rms = 0.0;
  double sum_of_squares = 0.0;
  double frames_with_markers = 0.0;
  bool any_ik = false;
  std::set<std::string> open;
  for (const TrialResult& t : trials) {
    if (!t.motion.ik) continue;
    const body::IkResult& ik = *t.motion.ik;
    any_ik = true;
    frames += static_cast<int>(ik.status.size());
    unconverged += ik.frames_not_converged;
    blind += ik.frames_without_markers;
    const Eigen::VectorXd rms = ik.errors.column("marker_error_RMS");
    for (const double v : rms) {
      if (!std::isfinite(v)) continue;
      worst_rms = std::max(worst_rms, v);
      sum_of_squares += v * v;
      ++frames_with_markers;
    }
    open.insert(ik.open_coordinates.begin(), ik.open_coordinates.end());
  }
  std::vector<Gate> list;
  if (!any_ik) return list;
  const int lost = unconverged + blind;
  list.push_back({"Inverse kinematics converged",
                  lost == 0                                        ? GateStatus::pass
                  : lost > study::kGateLimits.lost_frames * frames ? GateStatus::fail
                                                                   : GateStatus::warn,
                  fmt::format("{} of {} frames", frames - lost, frames),
                  fmt::format("all frames; fails below {:.0f} %", 100.0 * (1.0 - study::kGateLimits.lost_frames)),
                  "A frame that did not converge has no trustworthy angle."});
  const double rms = std::sqrt(sum_of_squares / std::max(frames_with_markers, 1.0));
  list.push_back({"Markers fit the model",
                  rms >= 2.0 * study::kGateLimits.marker_error_m   ? GateStatus::fail
                  : worst_rms >= study::kGateLimits.marker_error_m ? GateStatus::warn
                                                                   : GateStatus::pass,
                  fmt::format("{:.1f} mm rms, {:.1f} mm in the worst frame", 1000.0 * rms, 1000.0 * worst_rms),
                  "every frame below 20 mm; fails at 40 mm rms",
                  "Larger errors mean wrong labels or units, or a model of another size."});
  if (!open.empty()) {
    list.push_back({"Markers determine every coordinate", GateStatus::warn,
                    fmt::format("open: {}", fmt::join(open, ", ")), "none open",
                    "These coordinates keep their value where the markers do not tell."});
  }
  return list;
}

/// Returns the gates of the motion, from which all parameters are computed.
std::vector<Gate> motion_gates(const study::Study& study, const std::vector<TrialResult>& trials) {
  std::vector<Gate> list = marker_gates(trials);
  if (const auto range = largest_range_deg(study, trials); range && *range < study::kGateLimits.least_range_deg) {
    list.push_back({"The joint moves", GateStatus::fail,
                    fmt::format("{:.2g} degrees in the trial that moves it most", *range), "5 degrees or more",
                    "Were radians declared as degrees, or is the coordinate another one?"});
  }
  return list;
}

/// Tests whether the study has all muscles of the joint. Empty if so.
std::vector<Gate> model_gates(const StudyResult& result) {
  std::vector<Gate> list;
  if (const MissingMuscles missing = missing_muscles(result); !missing.names.empty()) {
    list.push_back(
        {"Every muscle of the joint is in the study",
         missing.share > study::kGateLimits.missing_share ? GateStatus::warn : GateStatus::info,
         fmt::format("without {}: {:.0f} % of the joint's strength", fmt::join(missing.names, ", "),
                     100.0 * missing.share),
         fmt::format("at most {:.0f} % missing", 100.0 * study::kGateLimits.missing_share),
         "What these muscles do is laid to the others: add them, or name them in a [[muscle]]'s osim list."});
  }
  return list;
}

/// Tests whether the shared forces produce the torque.
std::vector<Gate> sharing_gates(const study::Study& study, const std::vector<TrialResult>& trials) {
  int sharing_frames = 0;
  int unsolved = 0;
  int reserves = 0;
  for (const TrialResult& t : trials) {
    if (!t.has_motion()) continue;
    sharing_frames += static_cast<int>(t.forces.shared.status.size());
    unsolved += t.forces.shared.frames_not_solved;
    reserves += t.forces.shared.frames_with_reserve;
  }
  std::vector<Gate> list;
  if (sharing_frames == 0) return list;
  // No result of the recording rests on the forces that method paper alone fits.
  const bool counts = std::ranges::find(study.identify.methods, fit::Method::force) != study.identify.methods.end();
  list.push_back({std::string(kSharingGate),
                  unsolved == 0 ? GateStatus::pass
                  : counts      ? GateStatus::fail
                                : GateStatus::info,
                  fmt::format("{} of {} frames", sharing_frames - unsolved, sharing_frames),
                  "all frames, residual below 1e-9", "Concerns the shared forces that methods paper and force fit."});
  const double share = sharing_frames > 0 ? static_cast<double>(reserves) / sharing_frames : 0.0;
  list.push_back({"Muscles strong enough for the torque",
                  share < body::kReserveShare ? GateStatus::pass : GateStatus::warn, body::reserve_words(share),
                  fmt::format("below {:g} %", 100.0 * body::kReserveShare),
                  "Where a reserve acts, the literature's muscles could not provide the torque."});
  return list;
}

/// Tests whether activation 1 is a maximal contraction. Empty for EMG that is given as activation.
std::vector<Gate> reference_gates(const study::Study& study, const study::EmgScale& emg, const MistakenEmg* mistaken) {
  if (emg.normalisation.empty()) return {};
  const bool mvc = std::ranges::all_of(emg.normalisation, [](const auto& n) { return n.from_mvc; });
  std::map<std::string, std::vector<std::string>> channels;  // by the trial of their largest effort
  for (const auto& n : emg.normalisation) channels[n.source_trial].push_back(n.channel);
  std::vector<std::string> sources;
  for (const auto& [trial, names] : channels) sources.push_back(fmt::format("{}: {}", trial, fmt::join(names, ", ")));
  return {{"EMG relative to a maximal contraction", mvc ? GateStatus::pass : GateStatus::warn,
           fmt::format("largest effort in {}", fmt::join(sources, "; in ")), "every channel from an MVC trial",
           mistaken != nullptr && mistaken->is_gain() ? mistaken->remedy() + "."
           : mvc                                      ? "F_max means the maximal force."
                                                      : meaning_of_strength(study, false)}};
}

/// Tests whether the search of method torque converged, and how many parameters it determines.
std::vector<Gate> parameter_gates(const IdentificationResult& torque) {
  std::vector<Gate> list{{"Fit converged",
                          torque.termination == math::Termination::converged ? GateStatus::pass : GateStatus::fail,
                          torque.message, "converged", "Only a converged fit is an answer."}};
  for (page::Gate& gate : fit_gates(torque)) list.push_back(std::move(gate));
  const auto count = [&](Verdict v) {
    return std::ranges::count_if(torque.estimates, [&](const auto& e) {
      return e.verdict == v && e.tied_to.empty() && !fit::is_nuisance(e) && !fit::is_voluntary(e.parameter);
    });
  };
  list.push_back(
      {"Parameters that this recording tells",
       count(Verdict::identified) + count(Verdict::reproducible) > 0 ? GateStatus::pass : GateStatus::warn,
       fmt::format("{} identified, {} reproducible, {} weak, {} prior-dominated, {} not identifiable, {} "
                   "non-physical",
                   count(Verdict::identified), count(Verdict::reproducible), count(Verdict::weak),
                   count(Verdict::prior_dominated), count(Verdict::not_identifiable), count(Verdict::non_physical)),
       "those you need", "Use a number only if its verdict allows it."});
  return list;
}

/// Returns a gate for questions of `init` that the study leaves open: each may change every number.
std::optional<Gate> question_gate(const StudyResult& result) {
  const std::optional<Remark>& asked = result.source.unanswered;
  if (!asked) return std::nullopt;
  return Gate{"Questions of the study file answered", GateStatus::warn, asked->says, "every line with TODO",
              "Change the line below each, or delete the TODO: myoid check lists them."};
}

/// Returns a gate for the unit of a joint's angle or torque that its numbers contradict; empty if there is none. A
/// joint that hardly moves besides is a second witness.
std::optional<Gate> unit_gate(const StudyResult& result, const MistakenEmg* mistaken) {
  const std::vector<Remark> doubts = doubtful_units(result);
  if (doubts.empty()) return std::nullopt;
  const bool still =
      largest_range_deg(result.source.study, result.trials).value_or(360.0) < study::kGateLimits.least_range_deg;
  return Gate{"Units as the headers state", still ? GateStatus::fail : GateStatus::warn,
              doubts.size() == 1 ? sentence(doubts[0])
                                 : fmt::format("{} (and {} more)", sentence(doubts[0]), doubts.size() - 1),
              "numbers that people reach, and that fit the other trials'",
              mistaken != nullptr ? mistaken->remedy() + "."
                                  : "Every number of the fit rests on angles and torques: correct the unit first."};
}

constexpr const char* kOneClock = "EMG and torque on one clock";
constexpr const char* kMovesClock = "[sync] offset_s moves the clock of the EMG; every number of the fit rests on it.";

Gate emg_gate(const MistakenEmg& mistaken) {
  // A person whose synergists differ more than usual could explain an exchange, too.
  return {
      .name = mistaken.is_exchange() ? "Electrodes on the muscles that they are named for"
              : mistaken.is_clock()  ? kOneClock
                                     : "One gain in every trial",
      .status = mistaken.spoils_all(study::kGateLimits.explains) ? GateStatus::fail : GateStatus::warn,
      .value = mistaken.sentence(),
      .threshold = fmt::format("no exchange of two channels, no gain and no clock of a trial by which the recording is "
                               "{:.0f} times as probable; fails where the fit explains less than half of the torque "
                               "(R2 0.5), and by a gain or a clock of {:.0e} times",
                               std::exp(kMistakenOdds), std::exp(kSureOdds)),
      .why = mistaken.is_exchange() ? "Every number of the two muscles is then the other's."
             : mistaken.is_clock()  ? kMovesClock
                                    : "Or its torque is in another unit, or a held mass is wrong: every number rests "
                                      "on both.",
      .explains = true};
}

Gate clock_gate(const fit::ShiftedEmg& shifted) {
  return {kOneClock, GateStatus::warn, shifted.sentence(),
          "no other clock of the EMG with which the muscles make the torque better", kMovesClock};
}

Gate scales_gate(const TorqueScales& scales) {
  return {
      "Dynamometer and masses agree", GateStatus::warn, scales.sentence(),
      fmt::format("a ratio from {:.2f} to {:.2f} in the interval", 1.0 - scales.usual, 1.0 + scales.usual),
      "Compare the dynamometer with a known mass on a known lever; [subject] mass_kg and held_mass_kg with a scale. "
      "Forces and torques lie between the two."};
}

Gate choice_gate(const OtherChoice& choice) {
  return {"Numbers do not depend on what is believed of muscles without EMG",
          choice.outside() > 0 ? GateStatus::warn : GateStatus::pass, choice.sentence(),
          "every number in its interval by either choice", "Record the EMG of these muscles, or of their synergists."};
}

}  // namespace

std::vector<page::Gate> quality_gates(const StudyResult& result) {
  std::vector<Gate> list;
  const MistakenEmg* const mistaken = named_mistake(result);
  if (mistaken != nullptr) list.push_back(emg_gate(*mistaken));
  if (auto gate = question_gate(result)) list.push_back(std::move(*gate));
  if (auto gate = unit_gate(result, mistaken)) list.push_back(std::move(*gate));
  if (auto gate = torque_gate(result)) list.push_back(std::move(*gate));
  if (auto gate = support_gate(result)) list.push_back(std::move(*gate));
  if (const int failed = failed_trials(result.trials); failed > 0) {
    list.push_back({"Every trial could be computed", GateStatus::fail,
                    fmt::format("{} of {} failed", failed, result.trials.size()), "all",
                    "The others are reported; the failures are listed under the trials."});
  }
  list.push_back(recordings_gate(result));
  list.push_back(loads_gate(result.trials));
  if (result.fit.shifted) list.push_back(clock_gate(*result.fit.shifted));
  if (result.fit.scales && result.fit.scales->differ()) list.push_back(scales_gate(*result.fit.scales));
  if (result.fit.other_choice) list.push_back(choice_gate(*result.fit.other_choice));
  const auto add = [&list](std::vector<Gate> gates) { std::ranges::move(gates, std::back_inserter(list)); };
  add(motion_gates(result.source.study, result.trials));
  add(model_gates(result));
  add(sharing_gates(result.source.study, result.trials));
  add(reference_gates(result.source.study, result.emg, mistaken));
  if (const IdentificationResult* torque = torque_of(result.fit)) {
    add(parameter_gates(*torque));
    const bool other_gain =
        std::ranges::find(result.level_faults, RemarkCode::emg_gain, &Remark::code) != result.level_faults.end();
    add(fold_gates(result.folds, result.source.study.identify.cross_validate,
                   mistaken != nullptr && mistaken->is_gain() ? mistaken->remedy() + "."
                   : other_gain ? "Correct the gain that the recordings' faults name first."
                                : std::string(kRecordMore)));
  }
  return list;
}

bool motion_is_unreliable(const study::Study& study, const std::vector<TrialResult>& trials) {
  const std::vector<Gate> gates = motion_gates(study, trials);
  return std::ranges::any_of(gates, [](const Gate& gate) { return gate.status == GateStatus::fail; });
}

}  // namespace myoid::run
