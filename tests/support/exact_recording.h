#pragma once

#include <filesystem>

#include "myoid/study/read_study.h"
#include "myoid/twin/write_recording.h"
#include "myoid/virtual_person/protocol.h"

#include "tests/support/places.h"

namespace myoid::test {

/// Writes a virtual recording without noise into the folder; returns its study, without a cross-validation.
inline Study exact_recording(const std::filesystem::path& folder) {
  const auto protocol = twin::read_protocol(source_dir() / "examples/protocols/noise_free.toml");
  twin::write_virtual_recording(twin::make_virtual_recording(protocol, 3), folder);
  Study study = read_study(folder / "study.toml");
  study.identify.cross_validate = false;
  return study;
}

}  // namespace myoid::test
