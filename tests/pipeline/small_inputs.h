#pragma once

#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "program.h"
#include "tests/support/temporary_folder.h"

namespace myoid::test {

/// One second of elbow flexion from 0 to 90 degrees, written in degrees under this header value.
inline std::string ramp_motion(const std::string& in_degrees) {
  std::string text =
      "Coordinates\nversion=1\nnRows=101\nnColumns=2\ninDegrees=" + in_degrees + "\nendheader\ntime\telbow_flexion\n";
  for (int i = 0; i <= 100; ++i) text += std::to_string(0.01 * i) + "\t" + std::to_string(0.9 * i) + "\n";
  return text;
}

/// A short virtual recording in `folder`/rec.
inline std::filesystem::path recording_in(const TemporaryFolder& folder) {
  write_text(folder / "protocol.toml",
             "name = \"short\"\nlevel = \"L0\"\n[motion]\nrate_hz = 100\n[[trial]]\nname = "
             "\"slow\"\nkind = \"flexion\"\nfrequency_hz = 0.5\n"
             "centre_deg = 72\namplitude_deg = 40\nheld_mass_kg = 1.0\nduration_s = 4\n");
  const Finished twin = myoid({"twin", "--protocol", folder / "protocol.toml", "--seed", "1", "--out", folder / "rec"});
  EXPECT_EQ(twin.exit_code, 0) << twin.err;
  return folder / "rec";
}

/// Two channels of EMG with this title and a swelling amplitude, 2 s at 1 kHz.
inline std::string emg_text(const std::string& title) {
  std::string text = title + "\nversion=1\nnRows=2000\nnColumns=3\nendheader\ntime\tBIC\tTRI\n";
  for (int i = 0; i < 2000; ++i) {
    const int x = ((i * 7919) % 200 - 100) * (1 + i / 200);
    text += std::to_string(0.001 * i) + "\t" + std::to_string(x) + "\t" + std::to_string(-x) + "\n";
  }
  return text;
}

}  // namespace myoid::test
