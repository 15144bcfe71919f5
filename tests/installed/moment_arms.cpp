// Moment arms of the built-in arm by the installed library. On a motion of constant speed w the rate of each muscle's
// length is -r w, r its moment arm: the greatest difference [m/s] must be round-off and the spline's error.
#include <cmath>
#include <cstdio>

#include "myoid/ground/core/provenance.h"
#include "myoid/program/steps/paths.h"

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  myoid::program::PathsOptions options;
  options.model = "arm4";
  options.motion = argv[1];
  const myoid::program::PathsResult result = myoid::program::paths(options);
  const auto& arm = result.muscles.moment_arm.at("elbow_flexion").values();
  const auto& rate = result.muscles.velocity.values();
  const double speed = 0.5;  // [rad/s], of the file
  const double difference = (rate + speed * arm).cwiseAbs().maxCoeff();
  std::printf("%s: %ld muscles, %g m/s\n", std::string(myoid::version()).c_str(), long(arm.cols()), difference);
  return arm.cols() == 4 && arm.cwiseAbs().maxCoeff() > 0.01 && difference < 1e-9 ? 0 : 1;
}
