#include "myoid/program/steps/simulate.h"

#include "myoid/ground/files/output_file.h"
#include "myoid/page/write_report.h"
#include "myoid/program/cli/context.h"
#include "myoid/program/cli/options.h"
#include "myoid/program/cli/say.h"
#include "myoid/results/simulation_files.h"

namespace myoid::program {
namespace {

void draw_paper_figures(const std::string& out, const Context& context) {
  context.prepare_folder(out);
  for (const page::Figure& figure : results::paper_figures()) {
    write_figure(figure, out);
    say("{}/figures/{}.svg\n", out, figure.id);
  }
}

void carry_out(Context& context, const SimulateOptions& o, const CLI::App& command) {
  if (command.count("--paper-figures") > 0) return draw_paper_figures(o.out, context);
  context.prepare_folder(o.out);
  protect_files(o.out, program::kSimulateFiles, {o.model, o.excitations});
  const program::SimulateResult result = program::simulate(o);
  context.end_progress();
  program::write_simulate(result, o.out);
  if (!result.finished()) context.exit_code = kQualityGateFailed;
  context.json ? say_whole(results::simulation_json(result.simulation, result.provenance)) : say("{}\n", o.out);
}

}  // namespace

void add_simulate(CLI::App& app, Context& context) {
  add_command<SimulateOptions>(app, context, "simulate",
                               "Forward dynamics: excitations of the muscles to motion, forces and lengths.\n"
                               "Example: myoid simulate --model arm4 --excite BIC=0.1@0.2+0.3 --end 2 --out sim",
                               {.seed = false}, carry_out)
      ->add_flag_callback(
          "--paper-figures", [] {}, "Only the source paper's figures 2 and 4, drawn by this program");
}

}  // namespace myoid::program
