#include "myoid/results/sensitivity_files.h"

#include <fmt/format.h>

#include "myoid/tables/storage_writer.h"

namespace myoid {

void write_sensitivities(const simulation::Sensitivities& s,
                         const std::vector<std::string>& muscles,
                         const Provenance& provenance,
                         const std::filesystem::path& folder) {
  std::vector<Channel> channels;
  for (const std::string& name : s.parameters) channels.push_back({name, Unit::dimensionless});
  const auto write = [&](const std::string& file, const Eigen::MatrixXd& values, const std::string& what) {
    recording::write_storage(
        folder / "sensitivities" / (file + ".sto"), {s.time_s, channels, values},
        {.title = fmt::format("d({})/d(parameter), SI", what),
         .comments = {fmt::format("{} {}: {}", provenance.program, provenance.version, provenance.command)}});
  };
  write("angle", s.angle, "elbow flexion");
  write("speed", s.speed, "its speed");
  write("acceleration", s.acceleration, "its acceleration");
  write("torque", s.torque, "torque of the muscles");
  write("device", s.device, "torque of the device");
  for (std::size_t i = 0; i < muscles.size(); ++i) {
    write(muscles[i] + "_activation", s.activation[i], "activation of " + muscles[i]);
    write(muscles[i] + "_fiber_length", s.fiber_length[i], "fiber length of " + muscles[i]);
    write(muscles[i] + "_tendon_force", s.tendon_force[i], "tendon force of " + muscles[i]);
  }
}

}  // namespace myoid
