#include <fmt/format.h>

#include "myoid/cli/context.h"
#include "myoid/core/error.h"
#include "myoid/simulation/protocol.h"
#include "myoid/simulation/write_recording.h"

namespace myoid::cli {

void add_twin(CLI::App& app, Context& context) {
  CLI::App& command = *app.add_subcommand(
      "twin",
      "A virtual recording whose truth is known: markers, raw EMG, model, study.toml, truth.csv.\n"
      "Example: myoid twin --model arm4 --protocol examples/demo/protocol.toml --seed 1 --out rec");
  struct Options {
    std::string model = "arm4";
    std::string protocol;
    std::string out;
  };
  const auto options = std::make_shared<Options>();
  command.add_option("--model", options->model, "Built-in arm: arm4 (default)");
  command.add_option("--protocol", options->protocol, "What is recorded, a .toml file")->required();
  command.add_option("--out", options->out, "Folder for the recording")->required();
  add_common_options(command, context);
  command.callback([&context, options] {
    if (options->model != "arm4")
      throw InvalidInput(
          fmt::format("--model {}: virtual recordings are made with arm4 only", options->model));
    const simulation::Protocol protocol = simulation::read_protocol(options->protocol);
    const simulation::VirtualRecording recording =
        simulation::make_virtual_recording(protocol, context.seed);
    simulation::write_virtual_recording(recording, options->out, context.overwrite);
    context.log(fmt::format("{} trials, seed {}", recording.trials.size(), context.seed));
    fmt::print("{}/study.toml\n", options->out);
  });
}

}  // namespace myoid::cli
