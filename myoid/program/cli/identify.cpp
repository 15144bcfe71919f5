#include "myoid/program/commands/identify.h"

#include <string>

#include "myoid/ground/files/output_file.h"
#include "myoid/program/cli/context.h"
#include "myoid/program/cli/options.h"
#include "myoid/program/cli/run.h"

namespace myoid::program {

namespace {

/// The files without which there is nothing to identify, unless a project has them.
constexpr const char* kFilesOfTrials[] = {"--muscles", "--activations", "--lengths"};

void carry_out(Context& context, const IdentifyOptions& o, const CLI::App& command) {
  for (const char* option : kFilesOfTrials)
    if (o.from.empty() && command.get_option(option)->count() == 0) throw CLI::RequiredError(option);
  prepare_mat(context, o.mat, {o.muscles.string()});
  context.prepare_folder(o.folder);
  protect_files(o.folder, program::identify_files(), {o.muscles.string()});
  program::IdentifyResult result = program::identify(o);
  program::write_identify(result, o.folder);
  context.end_progress();
  write_mat(o.mat, o.folder);
  say_run(context, result.run, o.folder);
}

}  // namespace

void add_identify(CLI::App& app, Context& context) {
  CLI::App* const command = add_command<IdentifyOptions>(
      app, context, "identify",
      "Muscle parameters straight from files, where the earlier stages are done elsewhere.\n"
      "Example: myoid identify --muscles muscles.csv --activations a.sto --lengths l.sto --velocities v.sto\n"
      "                        --moment-arms r.sto --torques id.sto --method torque --out results",
      {}, carry_out);
  for (const char* option : kFilesOfTrials) command->get_option(option)->required(false);  // --from has them
  command->add_flag("--strict", context.strict, "Exit with 4 if a parameter is not identifiable");
}

}  // namespace myoid::program
