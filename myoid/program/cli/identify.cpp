#include "myoid/program/commands/identify.h"

#include <memory>
#include <string>

#include "myoid/ground/files/output_file.h"
#include "myoid/program/cli/context.h"
#include "myoid/program/cli/options.h"
#include "myoid/program/cli/run.h"

namespace myoid::program {

namespace {

/// The files without which there is nothing to identify, unless a project has them.
constexpr const char* kFilesOfTrials[] = {"--muscles", "--activations", "--lengths"};

}  // namespace

void add_identify(CLI::App& app, Context& context) {
  CLI::App& command = *app.add_subcommand(
      "identify",
      "Muscle parameters straight from files, where the earlier stages are done elsewhere.\n"
      "Example: myoid identify --muscles muscles.csv --activations a.sto --lengths l.sto --velocities v.sto\n"
      "                        --moment-arms r.sto --torques id.sto --method torque --out results");
  program::IdentifyOptions defaults;
  OptionDeclarer declarer(command);
  visit(defaults, declarer);
  for (const char* option : kFilesOfTrials) command.get_option(option)->required(false);  // --from has them
  for (const char* option : {"--free", "--hold"}) command.get_option(option)->delimiter(',');
  const auto out = std::make_shared<std::string>();
  command.add_option("--out", *out, "Folder of the results")->required();
  const auto exports = std::make_shared<std::vector<results::ExportFormat>>();
  add_export_option(command, *exports);
  const MatOption mat(command);
  command.add_flag("--strict", context.strict, "Exit with 4 if a parameter is not identifiable");
  add_common_options(command, context);
  command.callback([&context, &command, out, exports, mat] {
    program::IdentifyOptions o;
    OptionReader reader(command);
    visit(o, reader);
    for (const char* option : kFilesOfTrials)
      if (o.from.empty() && command.get_option(option)->count() == 0) throw CLI::RequiredError(option);
    o.folder = *out;
    mat.prepare(context, {o.muscles.string()});
    context.prepare_folder(*out);
    protect_files(*out, program::kIdentifyFiles, {o.muscles.string()});
    o.exports = *exports;
    o.call = context.call();
    program::IdentifyResult result = program::identify(o);
    program::write_identify(result, *out);
    context.end_progress();
    mat.write(*out);
    say_run(context, result.run, *out);
  });
}

}  // namespace myoid::program
