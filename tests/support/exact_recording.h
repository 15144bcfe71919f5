#pragma once

#include <filesystem>

#include "myoid/lab/twin/write_recording.h"
#include "myoid/lab/virtual_person/protocol.h"
#include "myoid/study/read_study.h"

#include "tests/support/places.h"

namespace myoid::test {

/// Writes a virtual recording without noise into the folder; returns its study, without a cross-validation.
inline study::Study exact_recording(const std::filesystem::path& folder) {
  const auto protocol = lab::read_protocol(source_dir() / "examples/protocols/noise_free.toml");
  lab::write_virtual_recording(lab::make_virtual_recording(protocol, 3), folder);
  study::Study study = study::read_study(folder / "study.toml");
  study.identify.cross_validate = false;
  return study;
}

}  // namespace myoid::test
