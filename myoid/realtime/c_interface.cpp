#include "myoid/realtime/c_interface.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <new>

#include "myoid/core/normal.h"
#include "myoid/core/numbers.h"
#include "myoid/core/provenance.h"
#include "myoid/realtime/read_predictor.h"

// Every function hands on to the library and lets no exception out.
struct myoid_model {
  myoid::Predictor predictor;
};
struct myoid_workspace {
  myoid::PredictorWorkspace space;
};

namespace {

template <typename List>
int count_of(const List& list) {
  return static_cast<int>(list.size());
}

template <typename List>
const char* name_of(const List& list, int index) {
  return index >= 0 && index < count_of(list) ? list[static_cast<std::size_t>(index)].name.c_str() : nullptr;
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

}  // namespace

extern "C" {

const char* myoid_version(void) {
  static const std::string version(myoid::version());
  return version.c_str();
}

myoid_model* myoid_open(const char* results, const char* study, char* error, size_t size) {
  try {
    return new myoid_model{myoid::read_predictor(results, study == nullptr ? "" : study)};
  } catch (const std::exception& problem) {
    if (error != nullptr && size > 0) std::snprintf(error, size, "%s", problem.what());
    return nullptr;
  }
}

void myoid_close(myoid_model* model) { delete model; }

int myoid_channel_count(const myoid_model* model) { return count_of(model->predictor.channels); }
int myoid_joint_count(const myoid_model* model) { return count_of(model->predictor.joints); }
int myoid_muscle_count(const myoid_model* model) { return count_of(model->predictor.muscles); }
const char* myoid_channel_name(const myoid_model* model, int channel) {
  return name_of(model->predictor.channels, channel);
}
const char* myoid_joint_name(const myoid_model* model, int joint) { return name_of(model->predictor.joints, joint); }
const char* myoid_muscle_name(const myoid_model* model, int muscle) {
  return name_of(model->predictor.muscles, muscle);
}

double myoid_delay_s(const myoid_model* model, int channel) {
  const auto& channels = model->predictor.channels;
  if (channel < 0 || channel >= count_of(channels)) return myoid::kNan;
  return channels[static_cast<std::size_t>(channel)].pure_delay_s;
}

double myoid_length_error_m(const myoid_model* model) {
  double worst = 0.0;
  for (const auto& path : model->predictor.paths) worst = std::max(worst, path.length_error_m);
  return worst;
}

myoid_workspace* myoid_workspace_new(const myoid_model* model) {
  try {
    return new myoid_workspace{myoid::workspace_for(model->predictor)};
  } catch (const std::exception&) {
    return nullptr;
  }
}

void myoid_workspace_free(myoid_workspace* workspace) { delete workspace; }

void myoid_follow(
    const myoid_model* model, myoid_workspace* workspace, const double* envelope, double step_s, double* acting) {
  const std::size_t count = model->predictor.channels.size();
  myoid::follow(model->predictor, {envelope, count}, step_s, workspace->space, {acting, count});
}

int myoid_evaluate(const myoid_model* model,
                   myoid_workspace* workspace,
                   const double* envelope,
                   const double* angle_rad,
                   const double* speed_radps,
                   const myoid_output* output) {
  const myoid::Predictor& p = model->predictor;
  myoid::PredictorWorkspace& w = workspace->space;
  const bool with_bands = output->torque_low_nm != nullptr || output->torque_high_nm != nullptr ||
                          output->force_low_n != nullptr || output->force_high_n != nullptr;
  const myoid::Prediction end = myoid::predict(p, {envelope, p.channels.size()}, {angle_rad, p.joints.size()},
                                               {speed_radps, p.joints.size()}, w, with_bands);
  const bool done = end == myoid::Prediction::done;
  put(w.torque_nm, w.torque_sd_nm, done, output->torque_nm, output->torque_low_nm, output->torque_high_nm);
  put(w.force_n, w.force_sd_n, done, output->force_n, output->force_low_n, output->force_high_n);
  return end == myoid::Prediction::done           ? MYOID_DONE
         : end == myoid::Prediction::not_a_number ? MYOID_NOT_A_NUMBER
                                                  : MYOID_OUT_OF_RANGE;
}

}  // extern "C"
