// C3D: any bytes are a file or a ReadError; what was read can be used, and written and read again.
#include "myoid/recording/c3d/c3d_reader.h"
#include "myoid/recording/c3d/c3d_signals.h"
#include "myoid/recording/c3d/c3d_writer.h"
#include "myoid/recording/force_plate.h"

#include "fuzz.h"
#include "tests/support/c3d_plates.h"
#include "tests/support/whole_c3d.h"

namespace rec = myoid::recording;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  myoid::fuzz::read([&] {
    const rec::C3dFile file = rec::parse_c3d(myoid::fuzz::bytes(data, size), "fuzz.c3d");
    std::vector<myoid::Repair> repairs;
    static_cast<void>(rec::force_plates(file, repairs));
    try {
      static_cast<void>(rec::c3d_markers(file, repairs));
    } catch (const myoid::InvalidInput&) {
    }
    try {
      static_cast<void>(rec::c3d_analog(file));
    } catch (const myoid::InvalidInput&) {
    }
    std::vector<std::byte> again;
    try {
      again = rec::format_c3d(file);
    } catch (const myoid::InvalidInput&) {
      return;
    }
    const rec::C3dFile back = rec::parse_c3d(again, "again.c3d");
    myoid::fuzz::require(back.points.rows() == file.points.rows());
    myoid::fuzz::require(back.point_labels == file.point_labels);
    myoid::fuzz::require(back.channels.size() == file.channels.size());
  });
  return 0;
}
