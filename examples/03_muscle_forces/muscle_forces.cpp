// Problem: a muscle is held, shortened and stretched while it is half active. Which force does it
// make at each length and speed?
//
//   muscle_forces MUSCLE.toml LENGTHS.csv
#include <cstdio>
#include <exception>

#include "myoid/program/steps/muscle.h"

namespace {

void tell_forces(const char* muscle, const char* lengths) {
  myoid::program::MuscleOptions options;
  options.muscle = muscle;
  options.lengths = {lengths};
  options.activation = {"0.5"};
  const myoid::program::MuscleResult result = myoid::program::muscle(options);

  // The series has a row for each sample of the file and a column for each quantity.
  const myoid::TimeSeries& series = result.simulated->simulated.series;
  const Eigen::VectorXd length_m = series.column("fiber_length");
  const Eigen::VectorXd speed_mps = series.column("fiber_velocity");
  const Eigen::VectorXd force_n = series.column("tendon_force");
  for (Eigen::Index k = 0; k < series.sample_count(); ++k) {
    std::printf("at %.1f s, fiber %.4f m, %.4f m/s: %.4f N\n", series.time_s()(k), length_m(k), speed_mps(k),
                force_n(k));
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return std::fputs("muscle_forces MUSCLE.toml LENGTHS.csv\n", stderr), 2;
  try {
    tell_forces(argv[1], argv[2]);
  } catch (const std::exception& error) {
    return std::fprintf(stderr, "%s\n", error.what()), 3;
  }
}
