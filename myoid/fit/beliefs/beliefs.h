#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "myoid/ground/core/prior.h"

namespace myoid::fit {

/// The quantity whose standard deviation a belief states.
enum class SpreadOf {
  value,          ///< The number itself, in its unit.
  logarithm,      ///< Its logarithm: a relative spread.
  fiber_length,   ///< The number, in optimal fiber lengths of the muscle.
  joint_strength  ///< The number, over the sum of largest |r| times F_max of the joint's muscles.
};

/// An expectation about a number before a recording is looked at.
struct Belief {
  std::string_view name;  ///< Name of the parameter, as in parameters.csv, or of another quantity.
  std::string_view mean;  ///< The expected value in words, "the model's"; empty: `value` says it.
  double value = 0.0;     ///< The expected value as a number.
  double sd = 0.0;        ///< Standard deviation.
  SpreadOf spread = SpreadOf::value;
  std::string_view unit;  ///< Unit of the mean and, for SpreadOf::value, of the standard deviation.
  std::string_view when;  ///< The case in which the estimator uses it.
  std::string_view source;

  /// Returns this belief with its case, or with its source.
  [[nodiscard]] constexpr Belief used(std::string_view in) const {
    return {name, mean, value, sd, spread, unit, in, source};
  }
  [[nodiscard]] constexpr Belief from(std::string_view where) const {
    return {name, mean, value, sd, spread, unit, when, where};
  }
  [[nodiscard]] constexpr Belief judged(std::string_view in) const { return used(in).from("judgment"); }
};

/// All beliefs of the identification. The estimator uses these constants, and docs/theory/priors.md
/// prints them. The twin draws its persons' muscles from them, but F_max, l_m^0 and the slack
/// length, whose beliefs hold the error of the model, too (lab/virtual_person/draw_truth.h).
namespace beliefs {

using enum SpreadOf;

/// An expected value: a number, or words.
struct Expected {
  std::string_view words;
  double value = 0.0;

  constexpr Expected(double number) : value(number) {}
  constexpr Expected(std::string_view text, double number = 0.0) : words(text), value(number) {}
};

constexpr Belief belief(std::string_view name, Expected mean, double sd, SpreadOf spread, std::string_view unit) {
  return {name, mean.words, mean.value, sd, spread, unit, {}, {}};
}

inline constexpr std::string_view kModels = "the model's";
inline constexpr std::string_view kStart = "the start";
inline constexpr std::string_view kAlways = "always";
inline constexpr std::string_view kWhenFree = "where a study frees it without a prior of its own";
inline constexpr std::string_view kPublished = "judgment from the spread between published sets of parameters";
inline constexpr std::string_view kNuisance = "judgment; left out, the fit takes it for a property of the muscles";

// A muscle's parameters, about the starting values.
inline constexpr Belief kMaxForce = belief("max_isometric_force", kModels, 0.25, logarithm, "N")
                                        .used(kAlways)
                                        .from(
                                            "two public models of a leg and two of an arm: ln 0.21 and ln 0.39 per "
                                            "model (`tests/coverage/public_models.py`)");
inline constexpr Belief kFiberLength = belief("optimal_fiber_length", kModels, 0.15, fiber_length, "m")
                                           .used(kAlways)
                                           .from(
                                               "two public models of a leg and two of an arm: ln 0.15 and ln 0.14 per "
                                               "model (`tests/coverage/public_models.py`)");
inline constexpr Belief kWidth =
    belief("force_length_width", kModels, 0.12, fiber_length, "m").used(kAlways).from(kPublished);
inline constexpr Belief kCurvature =
    belief("concentric_curvature", kModels, 0.30, logarithm, "")
        .used("always; with `max_shortening_speed` free the spread of v_max adds: √(0.30² + ((1 + V_sh) 0.20)²) = 0.39")
        .from(kPublished);
inline constexpr Belief kProduct = belief("eccentric_curvature_product", kModels, 0.65, logarithm, "")
                                       .used("`eccentric = \"product\"`")
                                       .from("the spreads of V_ml, V_sh and of the slope ratio together");
inline constexpr Belief kSlopeRatio = belief("eccentric_slope_ratio", kModels, 0.5, logarithm, "")
                                          .used("always, in place of the product")
                                          .from(kPublished);
inline constexpr Belief kPlateau = belief("eccentric_plateau", kModels, 0.15, value, "").used(kAlways).from(kPublished);
inline constexpr Belief kSpeed = belief("max_shortening_speed", kModels, 0.20, logarithm, "m/s")
                                     .used("unless a study states it as known")
                                     .from(kPublished);
inline constexpr Belief kTendonSlack =
    belief("tendon_slack_length", kModels, 0.10, logarithm, "m")
        .used("an unknown, unless the length is stated as measured; exact in the reading given geometry")
        .from(
            "of 25 leg muscles with tendons above 0.1 m, gait2392 (Delp 1990) and Rajagopal (2016) differ by a robust "
            "ln 0.13, 0.09 to each");
inline constexpr Belief kPennation = belief("pennation_angle", kModels, 0.05, value, "rad").judged(kWhenFree);
inline constexpr Belief kPassiveForce = belief("passive_force", kModels, 0.5, value, "").judged(kWhenFree);
inline constexpr Belief kPassiveStrain = belief("passive_strain", kModels, 0.2, logarithm, "").judged(kWhenFree);
inline constexpr Belief kPassiveShape = belief("passive_shape", kModels, 0.3, logarithm, "").judged(kWhenFree);
inline constexpr Belief kLengthActivation =
    belief("length_activation", 0.0, 0.1, value, "")
        .used("always, one for all muscles")
        .from("fibers that are little active are at their best when longer, by 15 % (Lloyd and Besier 2003)");
inline constexpr Belief kTendonStrain = belief("tendon_strain", kModels, 0.4, logarithm, "").judged(kWhenFree);
inline constexpr Belief kActivationShare = belief("activation_share", 1.0, 0.3, logarithm, "").judged(kWhenFree);

// An EMG channel's numbers. `emg_delay` is the electromechanical delay.
inline constexpr Belief kEmgDelay = belief("emg_delay", 0.060, 0.020, value, "s")
                                        .used(kAlways)
                                        .from("delays between EMG envelope and force in the literature, 30 to 100 ms");
inline constexpr Belief kEmgDelayBesideLags =
    belief("emg_delay", 0.010, 0.010, value, "s")
        .judged("`dynamics = true`: the delay left beside the lags of equation (1)");
inline constexpr Belief kEmgGain =
    belief("emg_gain", Expected("1, or `mvc_effort`", 1.0), 0.1, logarithm, "")
        .used("always; in place of this spread that of the EMG's normalization in the recording, with `mvc_effort_sd`")
        .from("recording/signals/emg_envelope.h");
inline constexpr Belief kEmgShape = belief("emg_shape", 0.0, 0.8, value, "").judged(kWhenFree);
inline constexpr Belief kEmgExponent = belief("emg_exponent", 1.0, 0.2, logarithm, "")
                                           .used("EMG with a maximal contraction, of channels that reach half of it")
                                           .from(kNuisance);
inline constexpr Belief kExcitationTime = belief("excitation_time", kStart, 0.25, logarithm, "s").judged(kWhenFree);
inline constexpr Belief kActivationTime = belief("activation_time", kStart, 0.25, logarithm, "s").judged(kWhenFree);
inline constexpr Belief kDeactivationTime = belief("deactivation_time", kStart, 0.25, logarithm, "s").judged(kWhenFree);

// A joint's own torque beside the muscles', relative to the greatest torque of its muscles together (`run`), and as
// numbers of an elbow (for a study that frees one without a prior, and in the twin).
inline constexpr std::string_view kJointSource = "a relaxed elbow's own torque: 1 N m/rad, 1 N m, 0.2 N m s/rad";
inline constexpr std::string_view kKnownMotion = "always, of joints whose motion is known";
inline constexpr Belief kStiffnessShare =
    belief("joint_stiffness", 0.0, 0.008, joint_strength, "N m/rad").used(kKnownMotion).from(kJointSource);
inline constexpr Belief kOffsetShare =
    belief("joint_torque_offset", 0.0, 0.008, joint_strength, "N m").used(kKnownMotion).from(kJointSource);
inline constexpr Belief kViscosityShare =
    belief("joint_viscosity", 0.0, 0.0016, joint_strength, "N m s/rad").used(kKnownMotion).from(kJointSource);
inline constexpr Belief kStiffness =
    belief("joint_stiffness", 0.0, 1.0, value, "N m/rad").used(kWhenFree).from(kJointSource);
inline constexpr Belief kOffset =
    belief("joint_torque_offset", 0.0, 1.0, value, "N m").used(kWhenFree).from(kJointSource);
inline constexpr Belief kViscosity =
    belief("joint_viscosity", 0.0, 0.2, value, "N m s/rad").used(kWhenFree).from(kJointSource);
inline constexpr Belief kInertia = belief("joint_inertia", 0.0, 0.01, value, "kg m²").judged(kWhenFree);

// Quantities other than parameters.
inline constexpr Belief kLeastEffort =
    belief("least share of its maximum that a muscle's greatest effort is", 0.05, 0.0, value, "")
        .used(
            "no maximal contraction was recorded: every ratio to 1 is as likely, ln 0.22 ± 0.86, half"
            " of the variance common; the belief about `emg_gain`")
        .from(
            "antagonists reach 5 to 20 % of their maximum (Kellis 1998), muscles of walking 10 to 80 % (Perry and "
            "Burnfield 2010)");
inline constexpr Belief kEmgNoise =
    belief("noise of an EMG envelope, over that expected from its bandwidth", 1.0, 0.3, logarithm, "")
        .judged("where every channel's bandwidth is known");
inline constexpr Belief kEmgBandwidth = belief("statistical bandwidth of raw EMG", 150.0, 0.0, value, "Hz")
                                            .used("where the raw signal is not known")
                                            .from("usual of surface EMG");
inline constexpr Belief kModelError =
    belief("relative size of a systematic error of the model", Expected("0 in one case of two"), 0.1, value, "")
        .judged("half normal in the other cases");
inline constexpr Belief kRestingWeight =
    belief("weight of limb and instrument in a passive trial", 0.0, 10.0, value, "N m").judged("passive trials");
inline constexpr Belief kRestingTissue =
    belief("departure of a passive torque from the sine of a weight", 0.0, 1.0, value, "N m").judged("passive trials");

// Quantities that residuals hardly determine.
inline constexpr std::string_view kPosterior = "every fit of a torque or force";
inline constexpr Belief kTorqueNoise =
    belief("error of the torque, over its root mean square", 0.05, 1.5, logarithm, "").judged(kPosterior);
inline constexpr Belief kTorqueNoiseTime =
    belief("time after which the error of the torque is another", 0.3, 0.5, logarithm, "s")
        .used(kPosterior)
        .from(
            "judgment: of skin, filters and a muscle model that errs with the posture; errors that last are unknowns "
            "of their own");
inline constexpr Belief kTrialTorqueNoise =
    belief("torque error of a trial over all", 1.0, 1.0, logarithm, "").judged(kPosterior);
inline constexpr Belief kStrength =
    belief("strength of a person, over the model's: a factor of F_max that all muscles share", 1.0, 0.38, logarithm, "")
        .used("beside the spread of each muscle's F_max")
        .from(
            "the muscles of ten arms (Holzbaur 2007): ln 0.37; public models: ln 0.32 and ln 0.57 per model "
            "(`tests/coverage/public_models.py`)");
inline constexpr Belief kIndependentRows =
    belief("rows of a trial, 0.22 s each, that count as independent evidence, per joint", 16.0, 0.0, value, "")
        .used(kPosterior)
        .from("judgment: repetitions repeat the EMG's and the model's errors (coarsening, Miller and Dunson 2019)");
inline constexpr Belief kUnlikeness =
    belief("spread of a person's muscles about the model's, over the spreads stated above", 1.0, 0.3, logarithm, "")
        .used("of the spreads that are judgments")
        .from(
            "a standard deviation from n people or cadavers is known to 1/sqrt(2 (n - 1)): 0.16 to 0.35 for n of 20 to "
            "5");
inline constexpr Belief kRiseAndFall =
    belief("half of the difference between the times in which activation falls and rises", 0.0, 0.018, value, "s")
        .used("about none: the root mean square is the spread")
        .from("15 ms rising, 50 ms falling (Thelen 2003)");
inline constexpr std::string_view kMomentArmSource =
    "of 40 moment arms, two public models: 0.09 to 0.18 per model in size, 0.12 to 0.18 in slope "
    "(`tests/coverage/public_models.py`)";
inline constexpr Belief kMomentArm =
    belief("size of a muscle's moment arms, over the model's", 1.0, 0.15, logarithm, "")
        .used(kPosterior)
        .from(kMomentArmSource);
inline constexpr Belief kMomentArmSlope =
    belief("change of that over half of the recorded range of lengths", 0.0, 0.12, value, "")
        .used(kPosterior)
        .from(kMomentArmSource);
inline constexpr Belief kTorqueScale = belief("scale of the torque, over the true one", 1.0, 0.03, logarithm, "")
                                           .used(kPosterior)
                                           .from("judgment: calibration of a dynamometer, inertia of the segments");
inline constexpr Belief kTendonStretch =
    belief("strain at F_max of a tendon that the study takes to be rigid", 0.049, 0.02, value, "")
        .used("about no strain: the root mean square, 0.053, is the spread")
        .from("4.9 % is the strain of Millard's tendon (2013); the spread is judgment");
inline constexpr Belief kCrossTalk = belief("share of another electrode's envelope in an envelope", 0.0, 0.1, value, "")
                                         .used(kPosterior)
                                         .from("judgment: surface electrodes over neighboring muscles share 5 to 15 %");
inline constexpr Belief kGainDrift =
    belief("change of an EMG channel's gain from the maximal contraction to the session's end", 0.0, 0.1, value, "")
        .used(kPosterior)
        .from("judgment: fatigue and sweat change amplitudes by 10 to 20 %");
inline constexpr Belief kVoluntaryEffort =
    belief("force of a maximal voluntary contraction, over that of a completely active muscle", 1.0, 0.06, value, "")
        .used(
            "about 1: the root mean square is the spread; not where a study states "
            "`mvc_effort_sd`")
        .from("voluntary activation of healthy people is 0.9 to 1 (Gandevia 2001)");
inline constexpr Belief kUnknownEmgNoise =
    belief("noise of an EMG envelope, over that of a bandwidth of 150 Hz", 1.0, 1.0, logarithm, "")
        .judged("where no bandwidth is known");

inline constexpr Belief kUnseenActivation =
    belief("activation of a muscle without EMG", 0.12, 0.12, value, "")
        .used("`without_emg`; the spread in time of `unseen`")
        .from("muscles of the leg in walking, means over a cycle of 5 to 20 % (Perry and Burnfield 2010)");
inline constexpr Belief kUnseenLevel =
    belief("level of that activation and of its error, over the expected one: `emg_gain`", 1.0, 0.7, logarithm, "")
        .used("`without_emg`")
        .from("the same range");
inline constexpr Belief kSynergyWeight =
    belief("weight of a synergy of the measured EMG in a muscle without EMG", 1.0, 1.0, value, "")
        .used("`without_emg = \"synergies\"`")
        .from("judgment: not negative");
inline constexpr Belief kOwnActivation =
    belief("activation that no synergy explains", 0.0, 0.06, value, "")
        .used("`without_emg = \"synergies\"`")
        .from("judgment: synergies leave 10 to 25 % of the variance of measured EMG (Ivanenko 2004)");

inline constexpr std::string_view kFascicles = "measured fascicles";
inline constexpr Belief kFascicleError =
    belief("error of a fascicle's length", 0.002, 0.5, logarithm, "m")
        .used(kFascicles)
        .from("judgment; 0.4 mm a degree between probe and fascicles (Bolsterlee 2016)");
inline constexpr Belief kFascicleErrorTime =
    belief("time that this error lasts", 1.0, 0.0, value, "s").judged(kFascicles);
inline constexpr Belief kFascicleScale =
    belief("scale of a fascicle's lengths, over the fibers'", 1.0, 0.05, value, "")
        .used(kFascicles)
        .from("judgment; repeated measurements differ by 4.3 to 14 % (Aeles 2017)");
inline constexpr Belief kFascicleOffset =
    belief("offset of a fascicle's lengths", 0.0, 0.002, value, "m").used(kFascicles).from("judgment: five degrees");

}  // namespace beliefs

/// The spreads that a study may state for its person, model and
/// instruments (`[beliefs]`). At 0 the quantity is exact.
struct UnseenSpreads {
  double moment_arm = beliefs::kMomentArm.sd;  ///< Spread of the logarithm.
  /// Spread over half the range of lengths.
  double moment_arm_slope = beliefs::kMomentArmSlope.sd;
  double tendon_strain = 0.053;  ///< Root mean square of kTendonStretch about no strain.
  double torque_scale = beliefs::kTorqueScale.sd;
  double crosstalk = beliefs::kCrossTalk.sd;
  double gain_drift = beliefs::kGainDrift.sd;
  double effort = beliefs::kVoluntaryEffort.sd;  ///< Of a maximal contraction.
  double model_error = beliefs::kModelError.sd;  ///< Half normal.
  double strength = beliefs::kStrength.sd;       ///< Common to all muscles' F_max; logarithm.
  /// Rows of a trial, per joint, that count as independent; 0: all.
  double independent_rows = beliefs::kIndependentRows.value;
  double fascicle_error_m = beliefs::kFascicleError.value;
  double fascicle_scale = beliefs::kFascicleScale.sd;
  double fascicle_offset_m = beliefs::kFascicleOffset.sd;
  bool operator==(const UnseenSpreads&) const = default;
};

/// Returns all beliefs, in the order of the page.
[[nodiscard]] std::span<const Belief* const> all_beliefs();

/// Returns the belief about a muscle's parameter as a prior about `start`, given the muscle's
/// optimal fiber length; empty if no muscle parameter has this name.
[[nodiscard]] std::optional<Prior> literature_prior(std::string_view parameter,
                                                    double start,
                                                    double optimal_fiber_length_m);

}  // namespace myoid::fit
