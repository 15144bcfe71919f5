#include "myoid/study/study_settings.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "myoid/study/muscle_table.h"
#include "myoid/study/study_ids.h"
#include "myoid/study/trial_table.h"
#include "myoid/study/trial_up.h"

namespace myoid::study {

void visit(SubjectSpec& subject, SettingVisitor& v) {
  v.text("name", subject.name, {.says = "The person's name or number, for the report."});
  must_be_name(v, "name", subject.name);
  v.number("mass_kg", subject.mass_kg,
           {.says = "Body mass, for the segments of the built-in arm.",
            .limits = within(10.0, 350.0, "kg"),
            .otherwise = "the literature's person"});
  v.choice("sex", subject.sex, {.says = "Selects the literature's segment masses.", .otherwise = "not stated"});
  v.texts("notes", subject.assumptions, {.says = "Assumptions of your own, printed among the report's."});
}

void visit(HeldMassSpec& held, SettingVisitor& v) {
  v.text("body", held.body,
         {.says = "The body that carries the held mass.", .required = "the body that carries the held mass"});
  std::vector<double> at_m{held.p_BP_m.x(), held.p_BP_m.y(), held.p_BP_m.z()};
  const bool given = v.numbers("at_m", at_m,
                               {.says = "The point where it acts, in the body's frame.",
                                .limits = any_number("m"),
                                .otherwise = "required",
                                .count = 3});
  held.p_BP_m = Vec3(at_m[0], at_m[1], at_m[2]);
  v.must(given, "at_m", "expected the point's three coordinates in the body [m]");
  constexpr double kFarthest_m = 2.0;  // the end of a pole in a person's hands
  v.must(held.p_BP_m.norm() <= kFarthest_m, "at_m",
         fmt::format("found a point {:.3g} m from the body's origin, expected less than {} m; is it in cm or mm?",
                     held.p_BP_m.norm(), kFarthest_m));
}

namespace {

/// Visits the joints of a study, which form one list, the main joint first.
void visit_coordinates(ModelSpec& model, SettingVisitor& v) {
  std::vector<std::string> names = study_coordinates(model);
  v.texts("coordinate", names,
          {.says = "The joint whose torque the muscles share, or [several](#several-joints) that the same muscles "
                   "cross: `[\"knee_angle_r\", \"ankle_angle_r\"]`."});
  v.must(!names.empty(), "coordinate", "expected the name of a joint coordinate");
  for (auto it = names.begin(); it != names.end(); ++it)
    v.must(std::find(names.begin(), it, *it) == it, "coordinate", fmt::format("'{}' is named twice", *it));
  model.coordinate = names.front();
  model.more_coordinates.assign(names.begin() + 1, names.end());
}

}  // namespace

void visit(ModelSpec& model, SettingVisitor& v) {
  static constexpr std::string_view kBuiltIn[] = {"", "arm4", "none"};
  static constexpr std::string_view kPlanes[] = {"vertical", "horizontal"};
  constexpr SettingLimits kArms = within(0.08, 0.5, "m");  // arms of people, including children
  v.path("file", model.file, {.says = "The model, `.osim`."});
  v.text(
      "builtin", model.builtin,
      {.says = "`arm4`: trunk, upper arm, forearm with hand; BIC, BRA, BRD, TRI. `none`: trials [give](#given-stages) "
               "the muscles' paths and torques.",
       .otherwise = "without a `file`: `none` if every trial gives all, else `arm4`",
       .words = kBuiltIn});
  v.must(!model.file || model.builtin.empty(), "builtin", "give either 'file' or 'builtin', not both");
  v.number("upper_arm_length_m", model.upper_arm_length_m,
           {.says = "Of the built-in arm.", .limits = kArms, .otherwise = "from markers, else the literature"});
  v.number("forearm_length_m", model.forearm_length_m,
           {.says = "Of the built-in arm, from elbow to wrist.",
            .limits = kArms,
            .otherwise = "from markers, else the literature"});
  v.either("plane", model.horizontal, {.says = "Plane of the built-in arm's movement.", .words = kPlanes});
  v.flag("forearm_rotations", model.forearm_rotations,
         {.says = "The built-in arm has a movable base, a carrying angle and forearm rotation, for landmarks that all "
                  "move with the forearm."});
  visit_coordinates(model, v);
  v.table("held_mass", model.held_mass,
          {.says = "The place where a trial's `held_mass_kg` acts.", .otherwise = "the built-in arm's palm"});
}

void visit(MotionSpec& motion, SettingVisitor& v) {
  const bool stated = v.choice("smoothing", motion.smoothing,
                               {.says = "`auto`: as the EMG's `lowpass_hz`, so that torque and prediction hold the "
                                        "same band; `cutoff`: at `cutoff_hz`."});
  std::optional<double> cutoff_hz;
  if (motion.smoothing == Smoothing::cutoff) cutoff_hz = motion.cutoff_hz;
  const bool given = v.number(
      "cutoff_hz", cutoff_hz,
      {.says = "Smoothing at this frequency, −3 dB of both passes together; below 0.45 of the recording's rate.",
       .limits = within(0.1, 500.0, "Hz"),
       .otherwise = "6 with `smoothing = \"cutoff\"`"});
  if (given) {
    v.must(!stated || motion.smoothing == Smoothing::cutoff, "smoothing",
           "it stands beside cutoff_hz, which says how to smooth; expected cutoff");
    motion.smoothing = Smoothing::cutoff;
    motion.cutoff_hz = *cutoff_hz;
  }
  v.number("rate_hz", motion.rate_hz,
           {.says = "Rate of the samples that are analyzed.", .limits = within(10.0, 2000.0, "Hz")});
}

void visit(MarkerSpec& markers, SettingVisitor& v) {
  static constexpr std::string_view kUps[] = {"auto", "x", "y", "z"};
  std::string up = markers.up == kUpOfTheFile ? "auto" : std::string(1, markers.up);
  v.text("up", up,
         {.says = "The laboratory's vertical, of markers and force plates, turned onto the model's. `auto`: [as each "
                  "`.c3d` file says](c3d.md#which-way-is-up), else the model's.",
          .words = kUps});
  markers.up = up == "auto" ? kUpOfTheFile : up.front();
  v.texts_by_name("rename", markers.rename, {.says = "Marker name of the file = that of the model."});
  v.numbers_by_name("weight", markers.weight,
                    {.says = "Weight in inverse kinematics, by the model's marker name.",
                     .limits = zero_or_more(),
                     .otherwise = "1 each"});
  v.flag("undo_swaps", markers.undo_swaps, {.says = "Exchanged labels are exchanged back."});
  v.flag("fill_gaps", markers.fill_gaps,
         {.says = "[Gaps are filled](check.md#what-is-mended) where neighbors or the segment show them."});
}

void visit(CalibrationSpec& calibrate, SettingVisitor& v) {
  v.numbers(
      "window_s", calibrate.window_s,
      {.says = "Start and end of the known posture.", .limits = any_number("s"), .otherwise = "required", .count = 2});
  v.must(calibrate.window_s.size() == 2 && calibrate.window_s[0] < calibrate.window_s[1], "window_s",
         "expected [start, end] in seconds, start before end");
  v.texts("free", calibrate.free, {.says = "The coordinates that are found there.", .otherwise = "required"});
  v.must(!calibrate.free.empty(), "free", "expected the coordinates to find in the window");
  const bool held =
      v.texts("hold", calibrate.hold, {.says = "Which of them stay fixed afterwards.", .otherwise = "all of `free`"});
  if (!held && calibrate.hold.empty()) calibrate.hold = calibrate.free;
}

void visit(IkSpec& ik, SettingVisitor& v) {
  v.texts("unlock", ik.unlock, {.says = "Coordinates that are freed although the model locks them."});
  v.texts("lock", ik.lock, {.says = "Coordinates that are held at their default value."});
  v.table("calibrate", ik.calibrate, {.says = "Coordinates that are found once and then held."});
}

void visit(EmgSpec& emg, SettingVisitor& v) {
  static constexpr std::string_view kNotch[] = {"none", "auto"};
  static constexpr std::string_view kNormalise[] = {"max"};
  v.choice("kind", emg.kind, {.says = "How far the EMG is processed already."});
  v.text("unit", emg.unit,
         {.says = "`V`, `mV` or `uV`, if the file does not say, or says V for numbers beyond 10 V.",
          .otherwise = "as the file says"});
  v.flag("rectify", emg.chain.rectify, {.says = "First step of [the chain](emg.md) after the high-pass."});
  v.either("notch", emg.chain.notch,
           {.says = "`auto`: takes mains hum out [where it is found](check.md).", .words = kNotch});
  v.flag("remove_ecg", emg.chain.remove_ecg,
         {.says = "Takes the heart out of channels that hold it, as those of the trunk do ([where it is found]"
                  "(check.md))."});
  bool whitens = emg.chain.whitening.value_or(true);
  v.flag("whitening", whitens,
         {.says = "Raw EMG is [whitened](../theory/emg.md#whitening) before it is rectified, in all channels or in "
                  "none, as the recording allows. `false`: in none."});
  emg.chain.whitening = whitens ? std::nullopt : std::optional(false);
  v.number("highpass_hz", emg.chain.highpass_hz, {.says = "High-pass of raw EMG.", .limits = above_zero("Hz")});
  v.number("lowpass_hz", emg.chain.lowpass_hz,
           {.says = "Low-pass of the rectified EMG, −3 dB of both passes together.", .limits = above_zero("Hz")});
  v.flag("as_published", emg.chain.as_published,
         {.says = "The source paper's design: no high-pass, uncorrected low-pass."});
  std::string normalise(kNormalise[0]);
  v.text("normalise", normalise,
         {.says = "`max`: the largest effort over all maximal and task trials counts as 1; the report names it.",
          .words = kNormalise});
  v.number("normalise_window_s", emg.normalise_window_s,
           {.says = "Length of the moving mean that counts as 1.", .limits = within(0.01, 60.0, "s")});
  v.number(
      "mvc_effort", emg.mvc_effort,
      {.says =
           "Share of the muscles' full force that the `mvc` trials reach, e.g. 0.9; see [below](#what-f_max-means).",
       .limits = within(0.3, 1.0)});
  v.number("mvc_effort_sd", emg.mvc_effort_sd,
           {.says = "How widely people differ in it, e.g. 0.06.", .limits = within(0.0, 0.3)});
  bool estimated = !emg.delay_s;
  v.number("delay_s", emg.delay_s, estimated,
           {.says = "Delay between EMG and force.", .limits = within(0.0, 0.3, "s"), .word = "estimate"});
}

void visit(LoadCellSpec& cell, SettingVisitor& v) {
  v.texts("channels", cell.channels,
          {.says = "Six channels, in the order of the matrix's columns.", .otherwise = "required", .count = 6});
  v.must(!cell.channels.empty(), "channels", "expected six names: the channels of the matrix's columns");
  v.path("calibration", cell.calibration,
         {.says = "File of six rows (Fx, Fy, Fz, Mx, My, Mz) of six numbers, N and N m for each volt.",
          .required = "the file of the 6 x 6 matrix [N/V] and [N m/V]"});
  v.number("sign", cell.sign,
           {.says = "`-1` where the cell measures the opposite of the load on the body.", .limits = within(-1.0, 1.0)});
  v.must(cell.sign == 1.0 || cell.sign == -1.0, "sign", "expected 1 or -1");
  v.numbers("zero_s", cell.zero_s,
            {.says = "Start and end of a time when nothing acts on it; its median is the zero.",
             .limits = any_number("s"),
             .count = 2});
  v.must(cell.zero_s[0] < cell.zero_s[1], "zero_s", "expected [start, end] in seconds, start before end");
  v.path("instrument", cell.instrument,
         {.says = "`.osim` of the object that holds the cell; the trial's markers pose it.",
          .otherwise = "the study's model"});
  v.text("frame", cell.frame,
         {.says = "The body of the instrument that is the cell.",
          .required = "the body of the instrument that is the cell"});
  v.text("body", cell.body,
         {.says = "The body of the person that feels the load.",
          .required = "the body of the person that feels the load"});
  v.number("lowpass_hz", cell.lowpass_hz,
           {.says = "Smoothing, −3 dB of both passes together.",
            .limits = above_zero("Hz"),
            .otherwise = "as the motion is smoothed"});
}

void visit(SharingSpec& sharing, SettingVisitor& v) {
  v.choice("objective", sharing.objective,
           {.says = "The quantity of which [force sharing](so.md) uses the least, for method `paper`."});
  v.number("exponent", sharing.exponent,
           {.says = "Exponent of the sum; 2 or 3 is usual.", .limits = {.lower = 1.0, .above_lower = true}});
  v.number("reserve_nm", sharing.reserve_nm,
           {.says = "Optimal torque of the reserve on the coordinate.", .limits = above_zero("N m")});
}

void visit(PhasesSpec& phases, SettingVisitor& v) {
  v.flag("search", phases.search, {.says = "Fatigue is looked for."});
  v.choices("exclude", phases.exclude,
            {.says = "The phases that are not fitted. Fatigue that no raw EMG confirms stays in.",
             .words = choice_names(PhaseKind{}).first<3>()});  // all but `regular`
}

namespace {

/// Settings of [identify] of earlier versions, which had a second estimator, and the reason why they have no effect.
constexpr std::pair<std::string_view, std::string_view> kRetired[] = {
    {"estimator", "the posterior is the only estimator"},
    {"priors", "the posterior rests on priors; data without noise are fitted without"},
    {"force_loop", "the muscles of the torque share the forces (EmgInformed_force.sto)"},
    {"loss", "the posterior has the spread of its errors as unknowns"},
    {"bootstrap", "the posterior has one route to its intervals"},
    {"profile", "the posterior has one route to its intervals"},
    {"max_rate_hz", "the rate of the fitted samples follows from the low-pass of the residuals"}};

/// Visits [identify]: the fit itself.
void visit_fit(IdentifySpec& identify, SettingVisitor& v) {
  static constexpr std::string_view kTendons[] = {"rigid", "elastic"};
  v.choices("method", identify.methods,
            {.says = "The methods, one or several. Without the setting, a study in which a muscle has `without_emg` "
                     "takes `torque` alone."});
  v.texts("muscles", identify.muscles, {.says = "The muscles whose parameters are found.", .word = "all"});
  v.count("posterior_draws", identify.posterior_draws,
          {.says = "So many draws by Hamiltonian Monte Carlo make the intervals, in place of an "
                   "approximation; 1000 take some ten times as long. 0: none.",
           .limits = within(0, 100000)});
  v.flag("gain", identify.gain, {.says = "The uncertainty of the EMG's normalization widens the intervals."});
  v.count(
      "starts", identify.starts,
      {.says = "Method `paper`: above 1, searches from Sobol points over ± 2 standard deviations of the priors, too. "
               "The numbers are still those of the first start; a table of where the searches ended goes to the "
               "report and parameters.json (`searches`).",
       .limits = within(1, 1000),
       .otherwise = "1; of `compare_solvers` 3"});
  v.flag("compare_solvers", identify.compare_solvers,
         {.says = "Method `paper`: four solvers from the same starts ([which solver](identify.md#which-solver)), a "
                  "table in the report and `solvers.csv`."});
  v.choice("eccentric", identify.eccentric,
           {.says = "Unknown of the lengthening branch: `product` (V_sh V_shl), `slope_ratio` (lengthening over "
                    "shortening), `smooth` (ratio 1), `automatic` (the ratio where it has a prior)."});
  v.flag("normalised", identify.normalised, {.says = "l_mˢʰ and v_max keep their ratio to l_m⁰."});
  v.choice("muscle_law", identify.muscle_law,
           {.says = "`paper`: neither pennation nor passive force; `model`: as the model's muscles have them; "
                    "`automatic`: `model` with an OpenSim model, else `paper`. Not of method `paper`."});
  v.either("tendon", identify.elastic_tendon,
           {.says = "`elastic`: quasi-static, with the strain that the model's muscles have. Not of method `paper`.",
            .words = kTendons});
}

/// Visits [identify]: the law by which a muscle follows its EMG.
void visit_lag(IdentifySpec& identify, SettingVisitor& v) {
  v.flag("dynamics", identify.dynamics,
         {.says = "A third way, not beside `lag`: activation follows the envelope by [two "
                  "lags](#how-activation-follows-emg), and `emg_delay` is the delay left beside them."});
  const bool stated =
      v.choice("lag", identify.lag,
               {.says = "`delay`: the envelope of `emg_delay` ago; `shared`: a pure delay and lags; `automatic`: the "
                        "one that the recording prefers ([how](#how-activation-follows-emg)).",
                .words = choice_names(identify.lag).first<3>(),  // `dynamics` is the fourth
                .silent = identify.dynamics});
  v.must(!identify.dynamics || !stated, "lag",
         "it stands beside dynamics = true, which is a third way to follow the EMG; leave one of both out");
  v.flag("delay_per_channel", identify.delay_per_channel, {.says = "Each EMG channel has a delay of its own."});
}

/// Visits [identify]: validation, intervals and the fitted samples.
void visit_data(IdentifySpec& identify, SettingVisitor& v) {
  v.flag("cross_validate", identify.cross_validate,
         {.says = "A part of the data is left out of the fit and predicted, each part in turn."});
  v.choice("folds", identify.folds,
           {.says = "What is left out: a trial; all trials of one `condition`; `block`: a fifth of every trial with "
                    "half a second on either side."});
  v.count("next_movements", identify.next_movements,
          {.says = "Movements to suggest for the [next recording](design.md), from this one's result; 0: none.",
           .limits = within(0, 50)});
  v.number("angle_sd_deg", identify.angle_sd_deg,
           {.says = "Error of the joint angle, propagated into the weights.", .limits = zero_or_more("deg")});
  v.number("angle_rate_sd_degps", identify.angle_rate_sd_degps,
           {.says = "Error of the angle's rate.", .limits = zero_or_more("deg/s")});
  for (const auto& [key, why] : kRetired) v.retired(key, why, identify.without_effect);
}

}  // namespace

void visit(IdentifySpec& identify, SettingVisitor& v) {
  visit_fit(identify, v);
  visit_lag(identify, v);
  visit_data(identify, v);
}

void visit(fit::UnseenSpreads& beliefs, SettingVisitor& v) {
  constexpr SettingLimits kSpread = within(0.0, 1.0);
  v.number(
      "moment_arm_sd", beliefs.moment_arm,
      {.says = "Relative error of the size of a muscle's moment arms; 0 where they were measured.", .limits = kSpread});
  v.number("moment_arm_slope_sd", beliefs.moment_arm_slope,
           {.says = "Change of that error from the middle to an end of the recorded lengths.", .limits = kSpread});
  v.number("tendon_strain", beliefs.tendon_strain,
           {.says = "Strain at F_max of a tendon that is taken to be rigid.", .limits = within(0.0, 0.2)});
  v.number("torque_scale_sd", beliefs.torque_scale,
           {.says = "Relative error of a dynamometer's scale, and of that of weight and inertia.", .limits = kSpread});
  v.number("crosstalk_sd", beliefs.crosstalk,
           {.says = "Share of another electrode's envelope in an envelope.", .limits = kSpread});
  v.number("gain_drift_sd", beliefs.gain_drift,
           {.says = "Relative change of an EMG channel's gain over the session.", .limits = kSpread});
  v.number("effort_sd", beliefs.effort,
           {.says = "Force of a maximal voluntary contraction: relative difference from that of a completely active "
                    "muscle. Not beside `mvc_effort_sd` of `[emg]`.",
            .limits = kSpread});
  v.number("model_error_sd", beliefs.model_error,
           {.says = "Relative size of the muscle law's systematic errors.",
            .limits = {.lower = 0.0, .upper = 1.0, .above_lower = true}});
  v.number("strength_sd", beliefs.strength,
           {.says = "Strength of the person over the model's, common to the F_max of all muscles; spread of the "
                    "logarithm, beside that of each muscle.",
            .limits = kSpread});
  v.number("independent_rows", beliefs.independent_rows,
           {.says = "Rows (of 0.22 s) of a trial, per joint, that count as independent evidence; 0: all.",
            .limits = zero_or_more("")});
  v.number("fascicle_sd_m", beliefs.fascicle_error_m,
           {.says = "Error of a measured fascicle length.", .limits = above_zero("m")});
  v.number("fascicle_scale_sd", beliefs.fascicle_scale,
           {.says = "Relative error of the scale of these lengths.", .limits = kSpread});
  v.number("fascicle_offset_sd_m", beliefs.fascicle_offset_m,
           {.says = "Error that all of them share.", .limits = zero_or_more("m")});
}

void visit(NormSpec& norm, SettingVisitor& v) {
  v.text("name", norm.name,
         {.says = "The group, for legends: `\"adults, N = 24\"`.",
          .required = "the name of the group, such as \"adults, N = 24\""});
  v.path("file", norm.file,
         {.says = "[Table of mean and standard deviation](report.md#norms) over percent of the movement, `.csv`.",
          .required = "the table of mean and standard deviation over percent of the movement"});
  v.texts("trials", norm.trials, {.says = "The movements that it belongs to.", .word = "all"});
}

void visit(Study& study, SettingVisitor& v) {
  v.table("subject", study.subject, {.says = "The person."});
  v.table("model", study.model, {.says = "The model of the body."});
  v.table("motion", study.motion, {.says = "Smoothing and rate of the joint angles."});
  v.table("markers", study.markers, {.says = "The markers of all trials."});
  v.table("ik", study.ik, {.says = "Inverse kinematics."});
  v.table("emg", study.emg, {.says = "The EMG of all trials."});
  v.table("sync", study.sync, {.says = "The clocks of all trials."});
  v.table("load_cell", study.load_cell,
          {.says = "A load cell in something that the person holds; it acts in the trials that name a `load_cell`."});
  v.table("sharing", study.sharing, {.says = "Force sharing, for method `paper`."});
  v.table("phases", study.phases, {.says = "Fatigue."});
  v.table("identify", study.identify, {.says = "The identification."});
  v.table("beliefs", study.beliefs, {.says = "What is believed about errors that residuals hardly show."});
  v.tables("muscle", study.muscles, {.says = "A muscle, or group, to identify."});
  v.tables("trial", study.trials, {.says = "A recording."});
  v.tables("parameter", study.parameters, {.says = "A wish for a parameter; later tables win."});
  v.tables("norm", study.norms, {.says = "Curves of a group of people, which the report draws behind the person's."});
  v.table("truth", study.truth.has_value(), {.says = "A virtual recording's true values."},
          [&study](SettingVisitor& inside) {
            inside.path("file", study.truth,
                        {.says = "True values of a virtual recording, printed beside the estimates.",
                         .required = "the table of true values, truth.csv"});
          });
}

}  // namespace myoid::study
