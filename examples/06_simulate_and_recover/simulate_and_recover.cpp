// Problem: does the method find the truth? A virtual person, whose muscles are known, is recorded
// and identified, and a trial that took no part in the fit is predicted.
//
//   simulate_and_recover PROTOCOL.toml OUT      OUT: folder for the recording and the results
#include <cstdio>
#include <exception>
#include <filesystem>

#include "myoid/ground/core/error.h"
#include "myoid/program/commands/predict.h"
#include "myoid/program/commands/run.h"
#include "myoid/program/commands/twin.h"

namespace {

namespace program = myoid::program;

// The seed makes the person: muscles, EMG, noise.
myoid::lab::Truth record(const char* protocol, const std::filesystem::path& folder) {
  program::TwinOptions options;
  options.call.seed = 2;
  options.protocol = protocol;
  const program::TwinResult person = program::twin(options);
  program::write_twin(person, folder);
  return person.recording.truth;
}

void recover(const char* protocol, const std::filesystem::path& out) {
  const myoid::lab::Truth truth = record(protocol, out / "recording");

  // The study of the recording, with the muscles of the literature as a start.
  const program::RunResult run = program::run({.study = (out / "recording" / "study.toml").string()});
  program::write_run(run, out / "results");
  const auto* fit = myoid::run::torque_of(run.study.fit);
  if (fit == nullptr) throw myoid::InvalidInput("the study does not ask for the method torque");
  for (std::size_t m = 0; m < truth.muscles.size(); ++m) {
    std::printf("strength of %s: %.1f N found, %.1f N true\n", run.study.source.study.muscles[m].name.c_str(),
                fit->muscles[m].max_isometric_force_n, truth.muscles[m].max_isometric_force_n);
  }

  // The trials of the use `validation` took no part.
  for (const auto& trial : program::predict({.folder = (out / "results").string()}).trials) {
    std::printf("torque of %s: R2 %.4f, error %.4f N m rms\n", trial.trial.c_str(), trial.score.r2(),
                trial.score.rmse_nm());
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return std::fputs("simulate_and_recover PROTOCOL.toml OUT\n", stderr), 2;
  try {
    recover(argv[1], argv[2]);
  } catch (const std::exception& error) {
    return std::fprintf(stderr, "%s\n", error.what()), 3;
  }
}
