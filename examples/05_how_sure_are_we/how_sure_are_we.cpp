// Problem: a fit always gives numbers. Which of them does the recording determine, and how well?
//
//   how_sure_are_we STUDY.toml
#include <cstdio>
#include <exception>
#include <map>
#include <string>

#include "myoid/ground/core/error.h"
#include "myoid/program/commands/run.h"

namespace {

using myoid::fit::ParameterEstimate;

// A row of the table: the estimate with its 95 % interval, which may be open on a side.
void tell_strength(const ParameterEstimate& number) {
  if (!number.ci_low || !number.ci_high) return;
  std::printf("strength of %s: %.6g N, 95 %% interval %.6g to %.6g N, %s\n", number.muscle.c_str(), number.estimate,
              *number.ci_low, *number.ci_high, std::string(name(number.verdict)).c_str());
}

// Every number has a verdict, and every verdict but the best a reason.
void tell_all(const char* study) {
  const myoid::program::RunResult result = myoid::program::run({.study = study});
  const auto* fit = myoid::run::torque_of(result.study.fit);
  if (fit == nullptr) throw myoid::InvalidInput("the study does not ask for the method torque");
  std::map<std::string, int> count;
  for (const ParameterEstimate& number : fit->estimates) {
    if (number.parameter == "max_isometric_force") tell_strength(number);
    ++count[std::string(name(number.verdict))];
  }
  for (const auto& [verdict, numbers] : count) {
    std::printf("%s: %d\n", verdict.c_str(), numbers);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return std::fputs("how_sure_are_we STUDY.toml\n", stderr), 2;
  try {
    tell_all(argv[1]);
  } catch (const std::exception& error) {
    return std::fprintf(stderr, "%s\n", error.what()), 3;
  }
}
