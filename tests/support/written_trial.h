#pragma once

#include <cmath>
#include <string>

#include <fmt/format.h>

#include "myoid/body/arm/arm4.h"
#include "myoid/body/osim/osim_reader.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/study/intake/read_trial.h"
#include "myoid/study/read_study.h"

#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace myoid::test_trials {

using myoid::test::message_of;

/// A study of the built-in arm whose EMG comes as envelopes of four muscles.
inline study::Study arm_study(const std::string& more = "") {
  std::string text = more + "[emg]\nkind = \"envelope\"\n";
  for (const char* muscle : {"BIC", "BRA", "BRD", "TRI"})
    text += fmt::format("[[muscle]]\nname = \"{0}\"\nemg = \"{0}\"\n", muscle);
  return study::parse_study(text + "[[trial]]\nname = \"t\"\nmotion = \"m.mot\"\nemg = \"e.sto\"\n", "study.toml");
}

inline const body::BodyModel& arm() {
  static const body::BodyModel model = body::parse_osim(body::arm4_osim(), "arm4.osim");
  return model;
}

/// A trial of an elbow that turns with this time step, with EMG from 0 s for `emg_s` seconds.
struct WrittenTrial {
  myoid::test::TemporaryFolder folder;
  study::TrialSpec spec;

  WrittenTrial(double motion_step, double emg_s, double hole_s = 0.0) {
    std::string motion = "motion\nversion=1\ninDegrees=yes\nendheader\ntime\telbow_flexion\n";
    for (int i = 0; i < 500; ++i) {
      motion +=
          fmt::format("{:.6f}\t{:.4f}\n", motion_step * i + (i < 250 ? 0.0 : hole_s), 40.0 + 30.0 * std::sin(0.02 * i));
    }
    std::string emg = "EMG\nendheader\ntime\tBIC\tBRA\tBRD\tTRI\n";
    for (int i = 0; i <= static_cast<int>(100.0 * emg_s); ++i)
      emg += fmt::format("{:.2f}\t0.1\t0.1\t0.1\t0.1\n", 0.01 * i);
    write_file(folder / "m.mot", motion);
    write_file(folder / "e.sto", emg);
    spec.name = "t";
    spec.motion = folder / "m.mot";
    spec.emg = folder / "e.sto";
  }
  [[nodiscard]] study::TrialInput read(const study::Study& study) const {
    return study::read_trial_input(study, spec, arm());
  }
};

}  // namespace myoid::test_trials
