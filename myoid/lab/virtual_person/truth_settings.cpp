#include "myoid/lab/virtual_person/truth_settings.h"

#include <array>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/muscle/hill_parameters.h"

namespace myoid::lab {
namespace {

constexpr std::array<std::string_view, 4> kCurves = {"any", "paper", "de_groote", "millard"};

constexpr std::array<std::string_view, muscle::kHillFields.size()> hill_names() {
  std::array<std::string_view, muscle::kHillFields.size()> names{};
  for (std::size_t i = 0; i < names.size(); ++i) names[i] = muscle::kHillFields[i].name;
  return names;
}
constexpr std::array kHillNames = hill_names();

/// Visits a setting [low, high].
void range(study::SettingVisitor& v, std::string_view key, Range& value, study::About about) {
  std::vector<double> both = {value.lower, value.upper};
  about.count = 2;
  if (!v.numbers(key, both, about)) return;
  v.must(both[0] <= both[1], key, fmt::format("found [{:g}, {:g}], expected a range [low, high]", both[0], both[1]));
  value = {both[0], both[1]};
}

void visit_person(TruthSpec& truth, study::SettingVisitor& v) {
  v.number("spread", truth.spread,
           {.says = "Standard deviations of the priors by which persons differ.", .limits = study::within(0.0, 3.0)});
  v.number("offset", truth.offset,
           {.says = "Standard deviations of the priors by which the persons' mean is off.",
            .limits = study::within(-3.0, 3.0)});
  v.texts("vary", truth.vary,
          {.says = "Parameters that differ from the literature (L0, L1). A table `[truth.BIC]` gives values of a "
                   "single muscle.",
           .otherwise = "F_max, l_m⁰, l_mˢʰ, V_sh, V_ml, P",
           .words = kHillNames});
  v.flag("beside_muscles", truth.beside_muscles,
         {.says = "Draws the shift of the optimum with activation, the joint's own torque and the exponents of the EMG "
                  "as a fit expects them (L0, L1); otherwise there are none."});
  range(v, "emg_delay_s", truth.emg_delay_s,
        {.says = "Range of the electromechanical delay, within 0 to 0.2 s (L0, L1).",
         .limits = study::within(0.0, 0.2, "s")});
  v.number("inertia_sd", truth.inertia_sd,
           {.says = "Relative error of the model's inertia and weight (L2).", .limits = study::within(0.0, 0.3)});
}

void visit_sensors(SensorTruth& sensors, study::SettingVisitor& v) {
  v.number("emg_exponent", sensors.emg_exponent,
           {.says = "p of every muscle, excitation = amplitude^p, in place of the range `exponent` of `[emg]`.",
            .limits = study::within(0.3, 3.0),
            .otherwise = "`exponent` of `[emg]`"});
  v.number(
      "crosstalk", sensors.crosstalk,
      {.says = "Share of every other channel's raw EMG in each channel, beside the neighbors' `crosstalk` of `[emg]`.",
       .limits = study::within(0.0, 0.5)});
  v.number("emg_gain_drift", sensors.emg_gain_drift,
           {.says = "Relative growth of the EMG per excitation from the first to the last minute of the session, rests "
                    "included.",
            .limits = study::within(-0.5, 2.0)});
  v.flag("emg_noise", sensors.emg_noise,
         {.says = "The amplitudes of the EMG wander at random, without regard to the muscles."});
  v.number("torque_scale", sensors.torque_scale,
           {.says = "The dynamometer shows scale · torque + offset.", .limits = study::within(0.5, 2.0)});
  v.number("torque_offset_nm", sensors.torque_offset_nm,
           {.says = "The offset of the above.", .limits = study::within(-20.0, 20.0, "N m")});
  v.number("fascicle_sd_m", sensors.fascicle_sd_m,
           {.says = "Above 0: lengths of fascicles with this error, and with a scale and an offset of each muscle.",
            .limits = study::within(0.0, 0.02, "m")});
}

std::string text_of(const study::SettingValue& value) {
  if (const auto* flag = std::get_if<bool>(&value)) return *flag ? "1" : "0";
  if (const auto* number = std::get_if<double>(&value)) return fmt::format("{}", *number);
  if (const auto* list = std::get_if<std::vector<double>>(&value)) return fmt::format("{}", fmt::join(*list, " to "));
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  return "";
}

class Values : public study::FlatSettingVisitor {
 public:
  std::vector<WorldSetting> list;

 protected:
  bool met(const study::Setting& setting, const study::SettingValue& now, const Set& /*set*/) override {
    const std::string_view unit = setting.about.limits.unit;
    list.push_back({std::string(setting.key), unit.empty() ? "1" : std::string(unit), text_of(now)});
    return false;
  }
};

std::vector<WorldSetting> world_of(TruthSpec truth) {
  Values values;
  visit_world(truth, values);
  return values.list;
}

}  // namespace

void visit_world(TruthSpec& truth, study::SettingVisitor& v) {
  v.text("curves", truth.curves,
         {.says = "Curves of active force over length and velocity. `any`: De Groote's or Millard's by chance.",
          .otherwise = "`\"paper\"`; L2 `\"any\"`",
          .words = kCurves});
  range(v, "tendon_strain", truth.tendon_strain,
        {.says = "Range of the tendons' strain at F_max, within 0.005 to 0.15.",
         .limits = study::within(0.005, 0.15),
         .otherwise = "rigid; L2 `[0.03, 0.06]`"});
  v.number("moment_arm_sd", truth.moment_arm_sd,
           {.says = "Relative error of the model's moment arms, a factor of each muscle. The muscle's length follows.",
            .limits = study::within(0.0, 0.3),
            .otherwise = "0; L2 0.1"});
  v.number("moment_arm_slope_sd", truth.moment_arm_slope_sd,
           {.says = "Relative error of the moment arms per radian from the angle at which the muscle is optimal; of "
                    "each muscle.",
            .limits = study::within(0.0, 0.3, "1/rad")});
  visit_sensors(truth.sensors, v);
}

void visit(TruthSpec& truth, study::SettingVisitor& v) {
  visit_person(truth, v);
  visit_world(truth, v);
}

study::SettingTable truth_reference() {
  TruthSpec usual = default_protocol(Level::noisy).truth;
  study::OptionRows rows(study::SettingNotation::file);
  visit(usual, rows);
  return {"[truth]", "The person, and the world where it is other than the identification believes.", rows.rows};
}

std::vector<WorldSetting> stated_world(const Protocol& protocol) {
  const std::vector<WorldSetting> usual = world_of(default_protocol(protocol.level).truth);
  std::vector<WorldSetting> stated;
  const std::vector<WorldSetting> all = world_of(protocol.truth);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].value != usual[i].value) stated.push_back(all[i]);
  }
  return stated;
}

}  // namespace myoid::lab
