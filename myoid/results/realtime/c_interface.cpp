#include "myoid/results/realtime/c_interface.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <exception>
#include <new>
#include <vector>

#include "myoid/ground/core/normal.h"
#include "myoid/ground/core/numbers.h"
#include "myoid/ground/core/provenance.h"
#include "myoid/results/realtime/read_predictor.h"

// Every function hands on to the library and lets no exception out.
struct myoid_model {
  myoid::results::Predictor predictor;
};
struct myoid_workspace {
  myoid::results::PredictorWorkspace space;
};

namespace {

template <typename Element>
int count_of(const myoid_model* model, std::vector<Element> myoid::results::Predictor::*list) {
  return model == nullptr ? -1 : static_cast<int>((model->predictor.*list).size());
}

template <typename Element>
const Element* element_of(const myoid_model* model, std::vector<Element> myoid::results::Predictor::*list, int index) {
  return index >= 0 && index < count_of(model, list) ? &(model->predictor.*list)[static_cast<std::size_t>(index)]
                                                     : nullptr;
}

template <typename Element>
const char* name_of(const myoid_model* model, std::vector<Element> myoid::results::Predictor::*list, int index) {
  const Element* element = element_of(model, list, index);
  return element == nullptr ? nullptr : element->name.c_str();
}

bool all_at_most(const double* values, std::size_t count, double most) {
  return std::all_of(values, values + count, [most](double value) { return std::abs(value) <= most; });
}

bool all_are_envelopes(const double* values, std::size_t count) {
  return std::all_of(values, values + count, [](double value) { return std::isfinite(value) && value >= 0.0; });
}

/// Reads the caller's places, which an older header may have made shorter.
myoid_output places_of(const myoid_output& given) {
  myoid_output places{};
  std::memcpy(&places, &given, std::min(given.size, sizeof places));
  return places;
}

/// Writes value and band of each number; NaN where none was computed.
void put(
    const Eigen::VectorXd& value, const Eigen::VectorXd& sd, bool done, double* middle, double* low, double* high) {
  for (Eigen::Index i = 0; i < value.size(); ++i) {
    const double half = myoid::kNormal95 * sd[i];
    if (middle != nullptr) middle[i] = done ? value[i] : myoid::kNan;
    if (low != nullptr) low[i] = done ? value[i] - half : myoid::kNan;
    if (high != nullptr) high[i] = done ? value[i] + half : myoid::kNan;
  }
}

myoid_model* open_by(
    myoid::results::Reading reading, const char* results, const char* study, char* error, std::size_t size) {
  if (results == nullptr) {
    if (error != nullptr && size > 0) std::snprintf(error, size, "the folder of the results is NULL");
    return nullptr;
  }
  try {
    return new myoid_model{myoid::results::read_predictor(results, study == nullptr ? "" : study, reading)};
  } catch (const std::exception& problem) {
    if (error != nullptr && size > 0) std::snprintf(error, size, "%s", problem.what());
    return nullptr;
  }
}

}  // namespace

extern "C" {

const char* myoid_version(void) {
  static const std::string version(myoid::version());
  return version.c_str();
}

myoid_model* myoid_open(const char* results, const char* study, char* error, size_t size) {
  return open_by(myoid::results::Reading::person, results, study, error, size);
}

myoid_model* myoid_open_given(const char* results, const char* study, char* error, size_t size) {
  return open_by(myoid::results::Reading::geometry_and_sensors_exact, results, study, error, size);
}

void myoid_close(myoid_model* model) { delete model; }

int myoid_channel_count(const myoid_model* model) { return count_of(model, &myoid::results::Predictor::channels); }
int myoid_joint_count(const myoid_model* model) { return count_of(model, &myoid::results::Predictor::joints); }
int myoid_muscle_count(const myoid_model* model) { return count_of(model, &myoid::results::Predictor::muscles); }
const char* myoid_channel_name(const myoid_model* model, int channel) {
  return name_of(model, &myoid::results::Predictor::channels, channel);
}
const char* myoid_joint_name(const myoid_model* model, int joint) {
  return name_of(model, &myoid::results::Predictor::joints, joint);
}
const char* myoid_muscle_name(const myoid_model* model, int muscle) {
  return name_of(model, &myoid::results::Predictor::muscles, muscle);
}

double myoid_delay_s(const myoid_model* model, int channel) {
  const auto* element = element_of(model, &myoid::results::Predictor::channels, channel);
  return element == nullptr ? myoid::kNan : element->pure_delay_s;
}

double myoid_length_error_m(const myoid_model* model) {
  if (model == nullptr) return myoid::kNan;
  double worst = 0.0;
  for (const auto& path : model->predictor.paths) worst = std::max(worst, path.length_error_m);
  return worst;
}

myoid_workspace* myoid_workspace_new(const myoid_model* model) {
  if (model == nullptr) return nullptr;
  try {
    return new myoid_workspace{myoid::results::workspace_for(model->predictor)};
  } catch (const std::exception&) {
    return nullptr;
  }
}

void myoid_workspace_free(myoid_workspace* workspace) { delete workspace; }

int myoid_follow(
    const myoid_model* model, myoid_workspace* workspace, const double* envelope, double step_s, double* acting) {
  if (model == nullptr || workspace == nullptr || envelope == nullptr || acting == nullptr)
    return MYOID_MISSING_ARGUMENT;
  const std::size_t count = model->predictor.channels.size();
  if (!std::isfinite(step_s) || step_s <= 0.0 || !all_are_envelopes(envelope, count)) {
    std::fill(acting, acting + count, myoid::kNan);
    return MYOID_NOT_A_NUMBER;
  }
  myoid::results::follow(model->predictor, {envelope, count}, step_s, workspace->space, {acting, count});
  return all_at_most(envelope, count, 1.0) ? MYOID_DONE : MYOID_IMPLAUSIBLE;
}

int myoid_evaluate(const myoid_model* model,
                   myoid_workspace* workspace,
                   const double* envelope,
                   const double* angle_rad,
                   const double* speed_radps,
                   const myoid_output* output) {
  if (model == nullptr || workspace == nullptr || envelope == nullptr || angle_rad == nullptr ||
      speed_radps == nullptr || output == nullptr || output->size < sizeof output->size)
    return MYOID_MISSING_ARGUMENT;
  const myoid_output places = places_of(*output);
  const myoid::results::Predictor& p = model->predictor;
  myoid::results::PredictorWorkspace& w = workspace->space;
  const bool with_bands = places.torque_low_nm != nullptr || places.torque_high_nm != nullptr ||
                          places.force_low_n != nullptr || places.force_high_n != nullptr;
  const myoid::results::Prediction end = myoid::results::predict(
      p, {envelope, p.channels.size()}, {angle_rad, p.joints.size()}, {speed_radps, p.joints.size()}, w, with_bands);
  const bool done = end == myoid::results::Prediction::done;
  put(w.torque_nm, w.torque_sd_nm, done, places.torque_nm, places.torque_low_nm, places.torque_high_nm);
  put(w.force_n, w.force_sd_n, done, places.force_n, places.force_low_n, places.force_high_n);
  if (end == myoid::results::Prediction::not_a_number) return MYOID_NOT_A_NUMBER;
  if (!done) return MYOID_OUT_OF_RANGE;
  const bool plausible =
      all_at_most(envelope, p.channels.size(), 1.0) && all_at_most(speed_radps, p.joints.size(), MYOID_FASTEST_RADPS);
  return plausible ? MYOID_DONE : MYOID_IMPLAUSIBLE;
}

}  // extern "C"
