#include "myoid/results/realtime/read_predictor.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "myoid/body/model/body_model.h"
#include "myoid/fit/measurement/options.h"
#include "myoid/fit/measurement/parameter_fields.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/core/json_text.h"
#include "myoid/ground/core/numbers.h"
#include "myoid/ground/files/text_file.h"
#include "myoid/muscle/force_velocity.h"
#include "myoid/study/read_study.h"
#include "myoid/study/study_model.h"

namespace myoid::results {
namespace {

namespace fs = std::filesystem;
using namespace fit;
using nlohmann::json;

/// Length and moment arms of the polynomials come closer to the paths than a fit could notice.
constexpr double kLengthTolerance = 5e-5;  // [m]
constexpr double kArmTolerance = 3e-4;     // [m]
constexpr int kMaxDegree = 16;

json read_json(const fs::path& path) {
  try {
    return parse_json(read_text_file(path));
  } catch (const json::exception& error) {
    throw ReadError(path, 0, "is no result of a run: {}; run the study again", json_error_text(error));
  }
}

using Chains = std::vector<Predictor::Chain>;

/// A number of the model and the chains of its owner.
struct Place {
  double* value;
  Chains* chains;
};

/// The numbers of the model under way: values by owner, and ratios of the eccentric slopes.
struct Numbers {
  Predictor* predictor;
  std::vector<double> slope_ratio;  ///< By muscle; 0: the product is the parameter.

  /// Returns the numbers of an owner; none if the owner has none of this scope.
  [[nodiscard]] std::vector<Place> of(const ParameterField& field, std::string_view owner) {
    std::vector<Place> found;
    const auto f = static_cast<std::size_t>(field.field);
    const auto is = [&](const std::string& name) { return owner == name || owner == "subject"; };
    for (std::size_t k = 0; field.scope == Scope::muscle && k < predictor->muscles.size(); ++k) {
      Predictor::Muscle& muscle = predictor->muscles[k];
      if (!is(muscle.name)) continue;
      found.push_back({field.field == kSlopeRatio ? &slope_ratio[k] : &muscle.values[f], &muscle.chains});
    }
    for (Predictor::Channel& channel : predictor->channels) {
      if (field.scope == Scope::channel && is(channel.name)) found.push_back({&channel.values[f], &channel.chains});
    }
    for (Predictor::Joint& joint : predictor->joints) {
      if (field.scope == Scope::joint && is(joint.name)) found.push_back({&joint.values[f], &joint.chains});
    }
    return found;
  }
};

/// Returns a row's value by a reading; NaN where it has none.
double value_of(const json& row, Reading reading) {
  const json given = row.value("given_estimate", json());
  const json& value = reading == Reading::person || !given.is_number() ? row.at("estimate") : given;
  return value.is_number() ? value.get<double>() : kNan;
}

void set_values(const study::Study& study, const json& method, Reading reading, Numbers& numbers) {
  for (const ParameterRule& rule : study.parameters) {
    if (!rule.value) continue;
    const std::vector<std::string> all{"subject"};
    for (const std::string& owner : rule.owners.empty() ? all : rule.owners)
      for (const Place& place : numbers.of(parameter_field(rule.parameter), owner)) *place.value = *rule.value;
  }
  for (const json& row : method.at("estimates")) {
    const double value = value_of(row, reading);
    if (std::isnan(value)) continue;
    const auto name = row.at("parameter").get<std::string>();
    if (name.starts_with("voluntary_")) continue;  // follows from the muscles' numbers
    for (const Place& place : numbers.of(parameter_field(name), row.at("muscle").get<std::string>()))
      *place.value = value;
  }
  for (std::size_t k = 0; k < numbers.slope_ratio.size(); ++k) {
    MuscleValues& m = numbers.predictor->muscles[k].values;
    if (numbers.slope_ratio[k] > 0.0)
      m[kProduct] = std::max(
          muscle::curvature_product_from_slope_ratio(numbers.slope_ratio[k], m[kCurvature], m[kPlateau]), 1e-12);
  }
}

/// Adds the chains of the product of a muscle whose slope ratio S is the unknown:
///   P = (V_ml - 1) V_sh / (S (1 + V_sh)).
void add_product_chains(const MuscleValues& m, double ratio, Chains& chains) {
  const double product = m[kProduct];
  for (const Predictor::Chain& c : Chains(chains)) {
    double by = 0.0;
    if (c.field == kSlopeRatio) by = -product / ratio;
    if (c.field == kCurvature) by = product / (m[kCurvature] * (1.0 + m[kCurvature]));
    if (c.field == kPlateau) by = product / (m[kPlateau] - 1.0);
    if (by != 0.0 && std::isfinite(by)) chains.push_back({kProduct, c.variable, by * c.slope});
  }
  std::erase_if(chains, [](const Predictor::Chain& c) { return c.field == kSlopeRatio; });
}

/// An unknown of the fit by its label, "BIC+BRA.optimal_fiber_length".
struct LabeledUnknown {
  explicit LabeledUnknown(const std::string& label)
      : point(label.rfind('.')), field(parameter_field(label.substr(point == std::string::npos ? 0 : point + 1))) {
    if (point == std::string::npos) throw InvalidInput("found the unknown '{}', expected OWNER.PARAMETER", label);
    for (const std::string_view owner : split(std::string_view(label).substr(0, point), '+'))
      owners.emplace_back(owner);
  }

  std::size_t point;
  const ParameterField& field;
  std::vector<std::string> owners;
};

void add_chains(const LabeledUnknown& unknown, Eigen::Index variable, Numbers& numbers) {
  std::vector<Place> places;
  for (const std::string& owner : unknown.owners) {
    const std::vector<Place> of_owner = numbers.of(unknown.field, owner);
    places.insert(places.end(), of_owner.begin(), of_owner.end());
  }
  for (const auto& [value, chains] : places) {
    const double first = *places.front().value;
    const double slope = unknown.field.logarithmic ? *value : first != 0.0 ? *value / first : 1.0;
    chains->push_back({unknown.field.field, variable, slope});
  }
}

/// Returns the width of the interval given geometry and sensors over that of the person; 1 where a row has one reading.
double narrower(const json& estimates, const LabeledUnknown& unknown) {
  for (const json& row : estimates) {
    if (row.at("parameter") != unknown.field.name ||
        std::ranges::find(unknown.owners, row.at("muscle").get<std::string>()) == unknown.owners.end())
      continue;
    const auto width = [&](const char* low_name, const char* high_name) {
      const json low = row.value(low_name, json()), high = row.value(high_name, json());
      if (!low.is_number() || !high.is_number()) return kNan;
      return unknown.field.logarithmic ? std::log(high.get<double>() / low.get<double>())
                                       : high.get<double>() - low.get<double>();
    };
    const double ratio = width("given_ci_low", "given_ci_high") / width("ci_low", "ci_high");
    if (std::isfinite(ratio)) return ratio;
  }
  return 1.0;
}

void set_covariance(const json& method, Reading reading, Numbers& numbers) {
  const json& covariance = method.at("covariance");
  const auto labels = covariance.at("parameters").get<std::vector<std::string>>();
  Predictor& p = *numbers.predictor;
  const auto n = static_cast<Eigen::Index>(labels.size());
  p.covariance.setZero(n, n);
  Eigen::VectorXd share = Eigen::VectorXd::Ones(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const json& row = covariance.at("matrix").at(static_cast<std::size_t>(i));
    for (Eigen::Index j = 0; j < n; ++j) {
      const json& cell = row.at(static_cast<std::size_t>(j));
      p.covariance(i, j) = cell.is_number() ? cell.get<double>() : 0.0;
    }
    const LabeledUnknown unknown(labels[static_cast<std::size_t>(i)]);
    add_chains(unknown, i, numbers);
    if (reading != Reading::person) share[i] = narrower(method.at("estimates"), unknown);
  }
  p.covariance = share.asDiagonal() * p.covariance * share.asDiagonal();
  for (std::size_t k = 0; k < p.muscles.size(); ++k) {
    if (numbers.slope_ratio[k] > 0.0)
      add_product_chains(p.muscles[k].values, numbers.slope_ratio[k], p.muscles[k].chains);
  }
  const json& sd = method.at("torque_sd_nm");
  p.torque_sd_nm = sd.is_number() ? sd.get<double>() : 0.0;
}

/// Sets delay and lags of every channel as in the fit.
void set_lags(const json& method, Predictor& p) {
  const json& word = method.at("emg_lag");
  const std::string lag = word.is_string() ? word.get<std::string>() : "delay";
  constexpr LagShares kShare;
  constexpr double kLeast = 1e-4;  // [s], as in the fit
  for (Predictor::Channel& channel : p.channels) {
    const double delay_s = channel.values[kDelay];
    channel.lags = lag != name(EmgLag::delay);
    channel.pure_delay_s = lag == name(EmgLag::shared) ? kShare.pure * delay_s : delay_s;
    if (lag != name(EmgLag::shared)) continue;
    channel.values[kExcitationTime] = std::max(kLeast, kShare.excitation * delay_s);
    channel.values[kActivationTime] = std::max(kLeast, kShare.activation * delay_s);
    channel.values[kDeactivationTime] = std::max(kLeast, kShare.deactivation * delay_s);
  }
}

/// Returns muscles, channels and joints with the values from which the fit started.
Predictor start_of(const study::Study& study, const body::BodyModel& model) {
  Predictor p;
  for (const MuscleSetup& setup : study::muscle_setups(study, model)) {
    if (setup.unseen)
      throw InvalidInput(
          fmt::format("[[muscle]] {}: found without_emg, expected emg: a prediction in real time takes "
                      "every activation from EMG; leave the muscle out of the study",
                      setup.name));
    const auto known = std::find_if(p.channels.begin(), p.channels.end(),
                                    [&](const auto& channel) { return channel.name == setup.emg_channel; });
    const auto index = static_cast<std::size_t>(known - p.channels.begin());
    if (known == p.channels.end())
      p.channels.push_back({setup.emg_channel, {0.0, 1.0, 0.0, 0.040, 0.015, 0.050, 1.0}, {}});
    p.muscles.push_back({.name = setup.name,
                         .channel = index,
                         .values = muscle_values(setup.start, setup.extras),
                         .heads = {},
                         .chains = {}});
  }
  for (const std::string& name : study::study_coordinates(study.model)) {
    const auto found =
        std::find_if(model.coordinates.begin(), model.coordinates.end(), [&](const auto& c) { return c.name == name; });
    p.joints.push_back({name, static_cast<int>(found - model.coordinates.begin()), JointValues{}, {}});
  }
  return p;
}

/// Sets the polynomials of the muscles' heads.
void set_paths(const study::Study& study, const body::BodyModel& model, Predictor& p) {
  const std::vector<body::PathSurrogate> all = body::fit_surrogates(
      model, {.length_tolerance_m = kLengthTolerance, .arm_tolerance_m = kArmTolerance, .max_degree = kMaxDegree});
  const std::vector<body::MuscleGroup> groups = study::muscle_groups(study, model);
  std::map<int, std::size_t> place;
  for (std::size_t k = 0; k < groups.size(); ++k) {
    for (std::size_t i = 0; i < groups[k].members.size(); ++i) {
      const int head = groups[k].members[i];
      const auto [known, is_new] = place.emplace(head, p.paths.size());
      if (is_new) p.paths.push_back(all[static_cast<std::size_t>(head)]);
      p.muscles[k].heads.push_back({known->second, groups[k].weights[i]});
    }
  }
  p.default_q = model.default_q();
}

void refuse_unlike(const study::Study& study, const json& parameters) {
  if (study.identify.normalised) throw InvalidInput("a study with normalised = true cannot be predicted");
  if (!parameters.at("resting_torque").empty())
    throw InvalidInput("a study with measured resting torques cannot be predicted");
  if (study.model.is_none())
    throw InvalidInput(
        "a study without a model has no lengths and moment arms for other postures: give it a model file");
  if (study.model.is_arm() && !study.model.forearm_length_m)
    throw InvalidInput(
        "the built-in arm of this study got its length from the markers; state forearm_length_m in [model], or give a "
        "model file");
}

}  // namespace

Predictor read_predictor(const fs::path& results, const fs::path& study_file, Reading reading) {
  const json parameters = read_json(results / "parameters.json");
  try {
    const fs::path file =
        study_file.empty() ? fs::path(read_json(results / "run.json").at("study").get<std::string>()) : study_file;
    const study::Study study = study::read_study(file);
    refuse_unlike(study, parameters);
    const body::BodyModel model = study::load_model(study);
    Predictor predictor = start_of(study, model);
    for (const json& method : parameters.at("methods")) {
      if (method.at("method") != "torque") continue;
      Numbers numbers{&predictor, std::vector<double>(predictor.muscles.size(), 0.0)};
      set_values(study, method, reading, numbers);
      set_covariance(method, reading, numbers);
      set_lags(method, predictor);
      set_paths(study, model, predictor);
      return predictor;
    }
  } catch (const json::exception& error) {
    throw ReadError(results / "parameters.json", 0, "is no result of a run of this version: {}; run the study again",
                    json_error_text(error));
  }
  throw InvalidInput("{} has no method torque; add it to method in [identify]", (results / "parameters.json").string());
}

}  // namespace myoid::results
