// Orientations of inertial sensors, as OpenSim's tools read them.
#include "myoid/recording/orientation_reader.h"

#include "fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  namespace fuzz = myoid::fuzz;
  fuzz::write("f.sto", fuzz::text(data, size));
  fuzz::read([&] {
    const auto series = myoid::recording::read_orientations(fuzz::folder() / "f.sto");
    fuzz::require(series.quaternions.cols() == 4 * static_cast<Eigen::Index>(series.names.size()));
    for (Eigen::Index i = 0; i < series.time_s.size(); ++i) {
      const Eigen::Vector4d q = series.quaternions.row(i).head<4>();
      fuzz::require(!q.allFinite() || std::abs(q.norm() - 1.0) < 1e-12);
    }
  });
  return 0;
}
