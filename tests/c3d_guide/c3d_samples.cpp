// c3d_samples FOLDER: files of every processor and kind whose numbers follow from their place, for
// the independent reader c3d_by_the_guide.py, which holds the same formulas.
#include <filesystem>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "myoid/recording/c3d/c3d_writer.h"

int main(int argc, char** argv) {
  using namespace myoid::recording;
  if (argc != 2) return 2;
  constexpr int kPoints = 300;  // more than 255: LABELS2
  constexpr int kFrames = 5;
  C3dFile file;
  file.point_rate_hz = 50.0;
  file.first_frame = 7;
  file.point_unit = "mm";
  file.point_scale = 0.25F;
  file.points.resize(kFrames, 4 * kPoints);
  for (int m = 0; m < kPoints; ++m) {
    file.point_labels.push_back(fmt::format("M{}", m + 1));
    for (int k = 0; k < kFrames; ++k) {
      const bool missing = (k + m) % 11 == 0;
      for (int axis = 0; axis < 3; ++axis) {
        const int steps = (37 * m + 11 * k + 5 * axis) % 4001 - 2000;
        file.points(k, 4 * m + axis) = missing ? 0.0F : 0.25F * static_cast<float>(steps);
      }
      file.points(k, 4 * m + 3) = missing ? -1.0F : 0.0F;
    }
  }
  file.analog_per_frame = 3;
  C3dGroup analog{2, "ANALOG", "", false, {}};
  analog.parameters.push_back({"GEN_SCALE", "", false, C3dType::real, {}, "", {0.125}});
  file.groups = {analog};
  file.channels = {{"Fz", "N", 12.0, 0.5 * 0.125}, {"EMG µ", "mV", -16.0, -0.0625 * 0.125}};
  file.analog.resize(3 * kFrames, 2);
  for (int n = 0; n < 3 * kFrames; ++n) {
    file.analog(n, 0) = static_cast<float>((211 * n) % 60001 - 30000);
    file.analog(n, 1) = static_cast<float>(-2500 * (n % 13));
  }
  file.events = {{0.125, "On", "Left", "S"}};
  const std::filesystem::path folder = argv[1];
  std::filesystem::create_directories(folder);
  for (const auto& [name, processor] : {std::pair("intel", C3dProcessor::intel), std::pair("dec", C3dProcessor::dec),
                                        std::pair("sgi", C3dProcessor::sgi)}) {
    for (const bool integer : {false, true})
      write_c3d(folder / fmt::format("{}_{}.c3d", name, integer ? "integer" : "real"), file, {processor, integer});
  }
  return 0;
}
