// Problem: how strong is the triceps of the person who was recorded, and at which length is it strongest?
//
//   identify_triceps STUDY.toml MVC_EMG TRIAL_EMG
#include <cstdio>
#include <exception>
#include <string>

#include "myoid/ground/core/error.h"
#include "myoid/program/commands/run.h"
#include "myoid/program/steps/emg.h"

namespace {

// Raw EMG becomes activation: filter, rectify, smooth, divide by the greatest mean over 4 s of a
// maximal contraction. A study does this for its trials by itself; here one can look at it.
void tell_activation(const char* mvc, const char* trial) {
  myoid::program::EmgOptions options;
  options.in = {trial};
  options.mvc = {mvc};
  options.window_s = 4.0;
  const myoid::TimeSeries activation = myoid::program::emg(options).activations.front();
  const Eigen::VectorXd triceps = activation.column("TRI");
  std::printf("mean activation of TRI: %.4f\n", triceps.mean());
  std::printf("greatest activation of TRI: %.4f\n", triceps.maxCoeff());
}

// The whole way from markers and EMG to the muscles' numbers, in SI units.
void tell_triceps(const char* study) {
  const myoid::program::RunResult result = myoid::program::run({.study = study});
  const auto* fit = myoid::run::torque_of(result.study.fit);
  if (fit == nullptr) throw myoid::InvalidInput("the study does not ask for the method torque");
  for (const auto& number : fit->estimates) {
    if (number.muscle != "TRI" || !number.std_error) continue;
    std::printf("%s: %.6g, standard error %.6g, %s\n", number.parameter.c_str(), number.estimate, *number.std_error,
                std::string(name(number.verdict)).c_str());
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) return std::fputs("identify_triceps STUDY.toml MVC_EMG TRIAL_EMG\n", stderr), 2;
  try {
    tell_activation(argv[2], argv[3]);
    tell_triceps(argv[1]);
  } catch (const std::exception& error) {
    return std::fprintf(stderr, "%s\n", error.what()), 3;
  }
}
