#include "myoid/program/commands/info.h"

#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/json_text.h"
#include "myoid/program/cli/context.h"
#include "myoid/program/cli/options.h"
#include "myoid/program/cli/say.h"
#include "myoid/program/commands/model_page.h"
#include "myoid/program/contents/contents_text.h"

namespace myoid::program {
namespace {

/// Several files, and the page of a model.
struct AllInfoOptions : InfoOptions {
  std::vector<std::string> files;
  ModelPageOptions page;
};

void visit(AllInfoOptions& o, study::SettingVisitor& v) {
  static const std::string kFiles = program::known_endings() +
                                    "; arm4; or a project of CEINMS, CEINMS-RT, NMSM or the muscle redundancy solver "
                                    "(its folder, .xml, .osimx or .m)";
  visit_questions(o, v);
  visit(o.page, v);
  v.paths("files", o.files, {.says = kFiles, .required = "a file", .option = {.by_place = true}});
}

/// Writes the page of the model, which must be the only file.
void write_page(const AllInfoOptions& o, const Context& context) {
  if (o.files.size() != 1 || !program::is_model(o.files.front()))
    throw InvalidInput("--html shows one model: give one .osim, or arm4");
  ModelPageOptions options = o.page;
  options.call = o.call;
  options.model = o.files.front();
  options.compat = o.compat;
  const std::string& html = options.out;
  context.prepare_file(html, {options.model, options.motion, options.forces, options.activations, options.markers});
  const program::ModelPageResult result = program::model_page(options);
  const page::Scene& scene = result.page.scenes.front();
  for (const std::string& note : sentences(scene.notes)) context.log(fmt::format("{}: {}", html, note));
  program::write_model_page(result, html);
  context.print({{"html", html}},
                fmt::format("{}: {} bodies, {} muscles, {} frames, {:.2f} MB", html, scene.bodies.size(),
                            scene.muscles.size(), scene.time_s.size(), 1e-6 * static_cast<double>(result.html.size())));
}

void carry_out(Context& context, const AllInfoOptions& o, const CLI::App& /*command*/) {
  if (!o.page.out.empty()) return write_page(o, context);
  if (context.start_s || context.end_s) context.warn("--start and --end have no effect without --html");
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  InfoOptions one = o;
  for (const std::string& file : o.files) {
    one.file = file;
    nlohmann::ordered_json contents = program::info(one);
    if (!context.json) say("{}{}", contents_text(contents), o.files.size() > 1 ? "\n" : "");
    all.push_back(std::move(contents));
  }
  if (context.json) say_whole(json_text(all) + "\n");
}

}  // namespace

void add_info(CLI::App& app, Context& context) {
  add_command<AllInfoOptions>(app, context, "info",
                              "Says what a file holds: channels, units, rates, duration, gaps, repairs; of "
                              "a model also its unsupported elements.\n"
                              "Example: myoid info arm.osim flex.trc",
                              {}, carry_out);
}

}  // namespace myoid::program
