#include "myoid/study/checks/given_check.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "myoid/body/dynamics/joint_capacity.h"
#include "myoid/body/dynamics/torque_plausibility.h"
#include "myoid/fit/methods/prediction.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/files/text_file.h"
#include "myoid/ground/math/statistics.h"
#include "myoid/recording/signals/emg_levels.h"
#include "myoid/study/checks/fiber_room.h"
#include "myoid/study/checks/length_changes.h"
#include "myoid/study/checks/torque_sign.h"
#include "myoid/study/checks/trial_plausibility.h"

namespace myoid::study {
namespace {

using fit::StudyData;
using fit::TrialData;

constexpr double kShortestPath_m = 0.01, kLongestPath_m = 1.0;
constexpr double kCertainlyShort_m = 0.002, kCertainlyLong_m = 3.0;
constexpr double kLargestArm_m = 0.2, kCertainlyLargeArm_m = 0.5;
constexpr double kAsGiven = 0.9;          // share of dl that -r dq explains where the files are not exchanged
constexpr double kLongestMuscle_m = 1.0;  // no musculotendon unit is longer: such numbers are no exchanged lengths
constexpr double kHighestActivation = 1.25, kCertainlyHigh = 2.0;
constexpr double kPercent = 20.0;  ///< the largest activation in percent exceeds this
constexpr double kLowestActivation = -0.01, kCertainlyLow = -0.1;
constexpr double kSpike_s = 0.1;        ///< a shorter time above kCertainlyHigh is an artefact
constexpr double kRests = 0.1;          ///< share of the samples at rest that shows the resting torque
constexpr double kRestingTorque = 0.1;  ///< over the torque's peak; a smaller one is the offset of a sensor
constexpr double kTogether = 0.9, kAgainst = -0.8, kDoubtful = 0.5, kClearly = 0.3, kLargestFactor = 3.0;

/// Optimal fiber lengths beyond which fibers make hardly any active force.
constexpr double kShortestActive = 0.4, kLongestActive = 1.8;

/// Returns true if a file's name is that of musculotendon lengths in OpenSim or CEINMS.
bool names_whole_muscles(const std::string& path) {
  const std::string name = small_letters(std::filesystem::path(path).stem().string());
  return name.ends_with("muscleanalysis_length") || name.find("lmt") != std::string::npos ||
         name.find("muscletendon") != std::string::npos || name.find("musculotendon") != std::string::npos;
}

double median_of(const Eigen::VectorXd& x) { return math::median({x.begin(), x.end()}); }

double correlation(const Eigen::VectorXd& x, const Eigen::VectorXd& y) {
  const Eigen::VectorXd a = x.array() - x.mean(), b = y.array() - y.mean();
  const double size = a.norm() * b.norm();
  return size > 0.0 ? a.dot(b) / size : 0.0;
}

[[noreturn]] void fail(const std::string& file, const std::string& what) {
  throw InvalidInput(fmt::format("{}: {}", file, what));
}

/// Checks one trial and collects remarks.
class TrialCheck {
 public:
  TrialCheck(const StudyData& data, const TrialData& trial, const TrialFiles& files)
      : data_(data), trial_(trial), files_(files), windows_(change_windows(trial.time_s)) {}

  std::vector<std::string> run() {
    exchanged();
    lengths();
    activations();
    velocities();
    moment_arms();
    length_changes();
    torque_sizes();
    torques();
    torque_at_rest();
    return std::move(remarks_);
  }

 private:
  [[nodiscard]] const std::string& muscle(Eigen::Index k) const {
    return data_.muscles[static_cast<std::size_t>(k)].name;
  }
  void remark(const std::string& file, const std::string& what) {
    remarks_.push_back(fmt::format("{}: {}", file, what));
  }

  /// Finds files of lengths and moment arms that are exchanged. Muscles of the trunk, the hand and the face can be
  /// shorter than their moment arm; dl = -r dq over all muscles tells the two apart. Refuses files that follow it
  /// exchanged and not as given, or by their sizes where nothing moves; asks where fibers alone are short.
  void exchanged() {
    if (files_.lengths.empty()) return;
    for (std::size_t j = 0; j < files_.moment_arms.size(); ++j) {
      std::vector<Eigen::Index> longer;
      for (Eigen::Index k = 0; k < arms(j).cols(); ++k) {
        const double arm = arms(j).col(k).cwiseAbs().maxCoeff();
        const double length = trial_.length_m.col(k).maxCoeff();
        if (length > 0.0 && length < arm && arm <= kLongestMuscle_m) longer.push_back(k);
      }
      if (longer.empty()) continue;
      const Exchange told = exchange(j);
      if (told == Exchange::as_given) continue;
      const Eigen::Index k = longer.front();
      const double arm = arms(j).col(k).cwiseAbs().maxCoeff();
      const double tendon = data_.muscles[static_cast<std::size_t>(k)].start.tendon_slack_length_m;
      const std::string found = fmt::format(
          "moment arm of {} up to {:.4g} m, and its lengths in {} only up to {:.4g} m{}; are the files of lengths and "
          "moment arms exchanged?",
          muscle(k), arm, files_.lengths, trial_.length_m.col(k).maxCoeff(),
          longer.size() > 1 ? fmt::format(", and so of {} muscles", longer.size()) : "");
      const bool most = 2 * static_cast<Eigen::Index>(longer.size()) > arms(j).cols();
      if (told == Exchange::exchanged || (told == Exchange::unknown && most && arm > tendon && tendon > 0.0))
        fail(files_.moment_arms[j], found + " A moment arm is shorter than the muscle");
      remark(files_.moment_arms[j], found + (tendon == 0.0 ? " Fibers are seldom shorter than a moment arm" : ""));
    }
  }

  enum class Exchange { as_given, exchanged, unknown };

  /// Asks dl = -r dq whether lengths and the moment arms of a joint are exchanged.
  [[nodiscard]] Exchange exchange(std::size_t joint) const {
    if (arms(joint).cols() < 3) return Exchange::unknown;
    const auto share = [&](const Eigen::MatrixXd& lengths, const std::vector<const Eigen::MatrixXd*>& r) {
      const Eigen::MatrixXd dl = changes(windows_, lengths);
      return is_moved(dl) ? share_by_arms(windows_, dl, r) : 0.0;
    };
    const double own = share(trial_.length_m, all_arms()), other = share(arms(joint), {&trial_.length_m});
    if (own >= kAsGiven && own >= other) return Exchange::as_given;
    return other > kDoubtful && other > own + kClearly ? Exchange::exchanged : Exchange::unknown;
  }

  void lengths() {
    if (files_.lengths.empty()) return;
    for (Eigen::Index k = 0; k < trial_.length_m.cols(); ++k) {
      const Eigen::VectorXd l = trial_.length_m.col(k);
      const std::string found =
          fmt::format("length of {} from {:.4g} to {:.4g} m", muscle(k), l.minCoeff(), l.maxCoeff());
      if (l.minCoeff() <= 0.0)
        fail(files_.lengths, found +
                                 ", expected positive lengths of 0.01 to 1 m; are the files of lengths and "
                                 "velocities in the wrong order?");
      const double typical = median_of(l);
      const auto& start = data_.muscles[static_cast<std::size_t>(k)].start;
      const double usual = start.tendon_slack_length_m + start.optimal_fiber_length_m;
      if (typical > kCertainlyLong_m)
        fail(files_.lengths, found + fmt::format(", expected 0.01 to 1 m; is it in {}? Write it in m",
                                                 typical > 300.0 * usual ? "mm" : "cm"));
      if (typical < kCertainlyShort_m) fail(files_.lengths, found + ", expected 0.01 to 1 m; write it in m");
      if (typical > kLongestPath_m || typical < kShortestPath_m)
        remark(files_.lengths, found + ", expected 0.01 to 1 m");
      if (start.tendon_slack_length_m == 0.0) {
        lengths_without_tendon(k, typical, found);
        continue;
      }
      const FiberRoom room = fiber_room(muscle(k), typical, start.tendon_slack_length_m, start.optimal_fiber_length_m);
      if (room.none) fail(files_.lengths, room.says + "; are these fiber lengths? Then their tendon_slack_length is 0");
      if (!room.says.empty())
        remark(files_.lengths, room.says + "; check tendon_slack_length and optimal_fiber_length of the start");
    }
  }

  /// Checks that the lengths of a muscle whose tendon has no length are fiber lengths.
  void lengths_without_tendon(Eigen::Index k, double typical_m, const std::string& found) {
    const double optimal_m = data_.muscles[static_cast<std::size_t>(k)].start.optimal_fiber_length_m;
    const double relative = typical_m / optimal_m;
    const std::string against = fmt::format(
        "{}, {:.2g} times its optimal_fiber_length of {:.4g} m, and the start has no tendon_slack_length for it", found,
        relative, optimal_m);
    if (relative > kLongestActive)
      fail(files_.lengths,
           fmt::format(
               "{}; expected fiber lengths, 0.4 to 1.8 times the optimal one. Are these lengths of whole muscles with "
               "their tendons? Then give tendon_slack_length. Else mend optimal_fiber_length",
               against));
    if (relative < kShortestActive)
      fail(files_.lengths, fmt::format("{}; expected fiber lengths, 0.4 to 1.8 times the optimal one; check the unit "
                                       "of both, or whose lengths these are",
                                       against));
    if (names_whole_muscles(files_.lengths))
      remark(files_.lengths, fmt::format("by its name the file has lengths of whole muscles, {}: they are taken for "
                                         "fiber lengths; give tendon_slack_length",
                                         against));
  }

  /// Returns the largest mean over the half second of the EMG's normalization; shorter peaks exceed
  /// 1.
  [[nodiscard]] double largest_mean(const Eigen::VectorXd& a) const {
    return math::greatest_mean(a, trial_.activation.mean_rate_hz(), 0.5);
  }

  void activations() {
    if (files_.activations.empty()) return;
    double largest = 0.0;
    for (const fit::MuscleSetup& setup : data_.muscles) {
      if (setup.unseen) continue;
      const Eigen::VectorXd a = trial_.activation.column(setup.emg_channel);
      const double low = a.minCoeff(), high = a.maxCoeff();
      largest = std::max(largest, high);
      const std::string found = fmt::format("activation '{}' from {:.3g} to {:.3g}", setup.emg_channel, low, high);
      const double rate_hz = trial_.activation.mean_rate_hz();
      const bool spike = high > kCertainlyHigh && recording::time_above_s(a, rate_hz, kCertainlyHigh) < kSpike_s;
      if (spike)
        remark(files_.activations, fmt::format("{}, above {:g} for less than {:g} s: an artefact? Leave that time out "
                                               "or mend the EMG",
                                               found, kCertainlyHigh, kSpike_s));
      if (high > kCertainlyHigh && !spike)
        fail(files_.activations,
             fmt::format("{}, expected 0 to 1 (1: the greatest effort); {}", found,
                         high > kPercent && high <= 200.0
                             ? "in percent? Divide by 100"
                             : "divide by the largest value of a maximal contraction, the same for all trials"));
      if (low < kCertainlyLow)
        fail(files_.activations,
             found + ", expected 0 to 1; is this raw EMG? Rectify, low-pass and normalise it (myoid emg)");
      if (largest_mean(a) > kHighestActivation)
        remark(files_.activations,
               fmt::format("{}, {:.3g} in the mean of half a second, expected 0 to 1, or to {:g} by "
                           "the chance of the envelope: an effort beyond those that count as 1",
                           found, largest_mean(a), kHighestActivation));
      if (low < kLowestActivation) remark(files_.activations, found + ", expected 0 to 1");
    }
    if (largest < kFlatActivation)
      remark(files_.activations, fmt::format("no activation above {:.2g}, expected up to 1 in the greatest effort; is "
                                             "this EMG in volts? Divide by the EMG of a maximal contraction",
                                             largest));
  }

  void velocities() {
    if (files_.velocities.empty()) return;
    const Eigen::MatrixXd of_length = changes(windows_, trial_.length_m);
    const Eigen::MatrixXd by_velocity = integrals(windows_, trial_.velocity_mps, trial_.time_s);
    for (Eigen::Index k = 0; k < of_length.cols(); ++k) {
      const Eigen::VectorXd dl = of_length.col(k), vdt = by_velocity.col(k);
      if (!is_moved(dl)) continue;
      const double factor = vdt.norm() / dl.norm();
      const double r = factor > 0.0 ? dl.dot(vdt) / (dl.norm() * vdt.norm()) : 0.0;
      if (r < -kTogether)
        fail(files_.velocities, fmt::format("velocity of {} is opposite to the change of its length; expected "
                                            "lengthening positive; change the sign",
                                            muscle(k)));
      if (r > kTogether && (factor > kLargestFactor || factor < 1.0 / kLargestFactor))
        fail(files_.velocities,
             fmt::format("velocity of {} is {} times the rate of its length in {}; expected the same, in m/s",
                         muscle(k), factor >= 10.0 ? fmt::format("{:.0f}", factor) : fmt::format("{:.2g}", factor),
                         files_.lengths));
      if (r < kDoubtful)
        remark(files_.velocities, fmt::format("velocity of {} is not the rate of its length in {} (they agree to r = "
                                              "{:.2f}); is it the same trial and clock?",
                                              muscle(k), files_.lengths, r));
    }
  }

  [[nodiscard]] const Eigen::MatrixXd& arms(std::size_t joint) const { return joint_at(trial_, joint).moment_arm_m; }
  [[nodiscard]] const Eigen::VectorXd& torque(std::size_t joint) const { return joint_at(trial_, joint).torque_nm; }

  void moment_arms() {
    for (std::size_t j = 0; j < files_.moment_arms.size(); ++j) {
      for (Eigen::Index k = 0; k < arms(j).cols(); ++k) {
        const double largest = arms(j).col(k).cwiseAbs().maxCoeff();
        const std::string found = fmt::format("moment arm of {} up to {:.4g} m", muscle(k), largest);
        if (largest > kCertainlyLargeArm_m)
          fail(files_.moment_arms[j], fmt::format("{}, expected at most 0.2 m; is it in {}? Write it in m", found,
                                                  largest > 10.0 ? "mm" : "cm"));
        if (largest > kLargestArm_m) remark(files_.moment_arms[j], found + ", expected at most 0.2 m");
      }
    }
  }

  [[nodiscard]] std::vector<const Eigen::MatrixXd*> all_arms() const {
    std::vector<const Eigen::MatrixXd*> joints;
    for (std::size_t j = 0; j < files_.moment_arms.size(); ++j) joints.push_back(&arms(j));
    return joints;
  }

  /// Names the muscle whose sign or absence makes the changes of length follow from the moment arms.
  [[nodiscard]] std::string suspect(const Eigen::MatrixXd& dl) const {
    double best = 0.0, second = 0.0;
    Eigen::Index turned = 0;
    std::string who;
    const std::vector<const Eigen::MatrixXd*> joints = all_arms();
    for (Eigen::Index k = 0; k < dl.cols(); ++k) {
      if (share_by_arms(windows_, dl, joints, {.without = k}) > kTogether) who = muscle(k);
      const double share = share_by_arms(windows_, dl, joints, {.turned = k});
      second = std::max(second, std::min(share, best));
      if (share > best) turned = k;
      best = std::max(best, share);
    }
    if (best > kDoubtful && best > second + kClearly)
      return fmt::format("; with the sign of {} reversed it explains {:.0f} %: is the sign of {} wrong?",
                         muscle(turned), 100.0 * best, muscle(turned));
    return (who.empty() ? "" : fmt::format("; without {} they do", who)) +
           "; is a sign wrong, or the file of another trial or joint?";
  }

  void length_changes() {
    if (files_.moment_arms.empty() || files_.lengths.empty()) return;
    const Eigen::MatrixXd dl = changes(windows_, trial_.length_m);
    if (!is_moved(dl) || dl.cols() <= static_cast<Eigen::Index>(files_.moment_arms.size())) return;
    const double all = share_by_arms(windows_, dl, all_arms());
    if (all >= kDoubtful) return;
    const std::string found =
        fmt::format("the changes of length do not follow from the moment arms (dl = -r dq explains {:.0f} % of them)",
                    100.0 * std::max(0.0, all));
    remark(files_.moment_arms.front(), found + suspect(dl));
  }

  void torque_sizes() {
    const std::size_t joints = files_.moment_arms.size();
    if (joints == 0 || files_.torques.empty()) return;
    Eigen::VectorXd strength_n(trial_.length_m.cols());
    for (Eigen::Index k = 0; k < strength_n.size(); ++k)
      strength_n[k] = data_.muscles[static_cast<std::size_t>(k)].start.max_isometric_force_n;
    for (std::size_t j = 0; j < joints; ++j) {
      const auto pull_nm = (arms(j) * strength_n.asDiagonal()).eval();
      // The files do not state the person's size: 100 kg at 1 m bound it.
      const body::JointCapacity joint{.positive_nm = pull_nm.cwiseMax(0.0).rowwise().sum().maxCoeff(),
                                      .negative_nm = pull_nm.cwiseMin(0.0).rowwise().sum().cwiseAbs().maxCoeff(),
                                      .lever_m = 1.0,
                                      .body_mass_kg = 100.0};
      const std::string text = body::too_much_torque(joint_at(trial_, j).joint, body::usual_peak(torque(j)),
                                                     joint.greatest_nm(), "the torque");
      if (!text.empty()) fail(files_.torques, text);
    }
  }

  void torques() {
    const std::size_t joints = files_.moment_arms.size();
    if (joints == 0 || files_.torques.empty()) return;
    std::vector<muscle::HillParameters<double>> start;
    for (const fit::MuscleSetup& setup : data_.muscles) start.push_back(setup.start);
    constexpr double kUsualDelay_s = 0.05;
    const Eigen::MatrixXd force_n = fit::predict(data_, trial_, start, kUsualDelay_s).force_n;
    const auto predicted = [&](std::size_t j) {
      return Eigen::VectorXd(arms(j).cwiseProduct(force_n).rowwise().sum());
    };
    if (joints == 2) {
      const double own = std::max(correlation(torque(0), predicted(0)), correlation(torque(1), predicted(1)));
      const double other = std::min(correlation(torque(0), predicted(1)), correlation(torque(1), predicted(0)));
      const std::string found = fmt::format(
          "these moment arms make the other joint's torque (with the starting values r is {:.2f} or more, of their own "
          "at most {:.2f}); the files of moment arms come in the order of the coordinates, trial by "
          "trial",
          other, own);
      if (other > kTogether && own < kDoubtful) fail(files_.moment_arms.front(), found);
      if (other > kDoubtful && other > own + kClearly) remark(files_.moment_arms.front(), found);
    }
    for (std::size_t j = 0; j < joints; ++j) {
      // The cosine about zero: a wrong fiber length changes the course of a torque, not its sign.
      const Eigen::VectorXd p = predicted(j);
      const double size = torque(j).norm() * p.norm();
      const double r = size > 0.0 ? torque(j).dot(p) / size : 0.0;
      if (r >= -kDoubtful) continue;
      // Muscles of other strengths may make this torque with its sign.
      const SignsExplained signs = signs_explained(arms(j).cwiseProduct(force_n), torque(j));
      if (signs.reversed < kDoubtful || signs.reversed < signs.as_given + kClearly) continue;
      const std::string found = fmt::format(
          "with the starting values the muscles' torque goes against that of {} (r = {:.2f}); are the signs of the "
          "moment arms (r = -dl/dq) or of the torque reversed, or the electrodes of opposite muscles exchanged?",
          files_.torques, r);
      if (r < kAgainst) fail(files_.moment_arms[j], found);
      remark(files_.moment_arms[j], found);
    }
  }

  /// Returns the samples before which all EMG was quiet, for longer than torque lags behind EMG.
  [[nodiscard]] std::vector<Eigen::Index> resting_rows() const {
    constexpr double kLag_s = 0.3;
    const Eigen::VectorXd& t = trial_.activation.time_s();
    std::vector<Eigen::Index> rows;
    Eigen::Index emg = 0;
    double quiet_since_s = t[0];
    for (Eigen::Index i = 0; i < trial_.time_s.size(); ++i) {
      for (; emg < t.size() && t[emg] <= trial_.time_s[i]; ++emg) {
        if (emg > 0 && t[emg] - t[emg - 1] > kLag_s) quiet_since_s = t[emg];
        for (const fit::MuscleSetup& setup : data_.muscles) {
          if (!setup.unseen &&
              trial_.activation.values()(emg, trial_.activation.index(setup.emg_channel)) >= kFlatActivation)
            quiet_since_s = t[emg];
        }
      }
      const bool has_emg = emg > 0 && trial_.time_s[i] - t[emg - 1] < kLag_s;
      if (has_emg && trial_.time_s[i] - quiet_since_s > kLag_s) rows.push_back(i);
    }
    return rows;
  }

  void torque_at_rest() {
    if (files_.moment_arms.empty() || files_.torques.empty() || files_.resting_torque_is_free) return;
    const std::vector<Eigen::Index> rows = resting_rows();
    if (static_cast<double>(rows.size()) < kRests * static_cast<double>(trial_.time_s.size())) return;
    for (std::size_t j = 0; j < files_.moment_arms.size(); ++j) {
      const Eigen::VectorXd here = torque(j)(rows);
      const double usual = median_of(here);
      if (std::abs(usual) < kRestingTorque * body::usual_peak(torque(j))) continue;
      remark(
          files_.torques,
          fmt::format("{:.3g} to {:.3g} N m{} while all EMG is below {:g}, expected about 0: torque without activity "
                      "is that of gravity and passive tissue. Subtract them, or free "
                      "joint_torque_offset and, with the joint's angle, joint_stiffness",
                      here.minCoeff(), here.maxCoeff(),
                      files_.moment_arms.size() > 1 ? fmt::format(" (joint {})", j + 1) : "", kFlatActivation));
    }
  }

  const StudyData& data_;
  const TrialData& trial_;
  const TrialFiles& files_;
  const ChangeWindows windows_;
  std::vector<std::string> remarks_;
};

}  // namespace

std::vector<std::string> check_given_trial(const StudyData& data, const TrialData& trial, const TrialFiles& files) {
  return TrialCheck(data, trial, files).run();
}

}  // namespace myoid::study
