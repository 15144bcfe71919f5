#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "myoid/arm/arm4.h"
#include "myoid/cli/context.h"
#include "myoid/cli/model_page.h"
#include "myoid/cli/stage_input.h"
#include "myoid/contents/contents_text.h"
#include "myoid/contents/model_contents.h"
#include "myoid/contents/recording_contents.h"
#include "myoid/core/error.h"
#include "myoid/core/json_text.h"
#include "myoid/files/text_file.h"
#include "myoid/osim/osim_reader.h"
#include "myoid/recording/recording.h"
#include "myoid/study/study.h"

namespace myoid::cli {
namespace {

using nlohmann::ordered_json;

/// An .osim file, or the name of the built-in arm.
bool is_model(const std::filesystem::path& path) {
  return recording::extension_of(path) == ".osim" ||
         (path == "arm4" && !std::filesystem::exists(path));
}

ordered_json study_file_json(const std::filesystem::path& path) {
  const Study study = read_study(path);
  ordered_json j{{"kind", "study"},
                 {"subject", study.subject.name},
                 {"coordinate", study.model.coordinate},
                 {"methods", study.identify.methods}};
  for (const auto& m : study.muscles)
    j["muscles"].push_back(fmt::format("{} <- EMG {}", m.name, m.emg));
  for (const auto& t : study.trials)
    j["trials"].push_back(fmt::format("{} ({})", t.name, name(t.use)));
  return j;
}

ordered_json file_json(const std::filesystem::path& path,
                       const ModelQuestions& ask,
                       const Context& context) {
  if (auto contents = recording_contents(path)) return *std::move(contents);
  if (is_model(path)) {
    const model::OsimOptions options{.compat = model::parse_compat(context.compat)};
    return model_contents(path == "arm4"
                              ? model::parse_osim(model::arm4_osim(), "arm4.osim", options)
                              : model::read_osim(path, options),
                          ask);
  }
  const std::string extension = recording::extension_of(path);
  if (extension == ".toml") return study_file_json(path);
  (void)recording::read_text_file(path);  // a missing or empty file is told as such
  throw ReadError(
      path, 0,
      fmt::format(
          "files of kind '{}' are not known; known are .c3d, .trc, .mot, .sto, .csv, .tsv, .txt, "
          ".edf, .bdf, .anc, .osim and .toml",
          extension));
}

}  // namespace

void add_info(CLI::App& app, Context& context) {
  CLI::App& command =
      *app.add_subcommand("info",
                          "Says what a file holds: channels, units, rates, duration, gaps, "
                          "repairs; of a model also what is not supported.\n"
                          "Example: myoid info arm.osim flex.trc");
  const auto files = std::make_shared<std::vector<std::string>>();
  const auto ask = std::make_shared<ModelQuestions>();
  const auto page = std::make_shared<ModelPageOptions>();
  command.add_flag("--compare-compat", ask->compare_compat,
                   "Of a model: for which muscles exact paths differ from OpenSim 4.5.2's, and by "
                   "how much, over random postures");
  command.add_option("--postures", ask->postures, "Random postures for --compare-compat")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  command.add_flag("--jumps", ask->jumps,
                   "Of a model: where a muscle's length or moment arm jumps over the range of a "
                   "coordinate");
  add_model_page_options(command, *page);
  add_compat_option(command, context);
  command
      .add_option("files", *files,
                  ".c3d, .trc, .mot, .sto, .csv, .edf, .bdf, .anc, .osim or study.toml; or arm4")
      ->required();
  add_common_options(command, context);
  command.callback([&context, files, ask, page] {
    if (!page->html.empty()) {
      if (files->size() != 1 || !is_model(files->front()))
        throw InvalidInput("--html shows one model: give one .osim, or arm4");
      const std::string done = write_model_page(files->front(), *page, context);
      if (context.json) {
        fmt::print("{}\n", json_text(ordered_json{{"html", page->html}}));
      } else {
        fmt::print("{}\n", done);
      }
      return;
    }
    if (context.start_s || context.end_s)
      context.warn("--start and --end have no effect without --html");
    ask->seed = context.seed;
    ordered_json all = ordered_json::array();
    for (const std::string& file : *files) {
      ordered_json j{{"file", file}};
      j.update(file_json(file, *ask, context));
      if (!context.json) {
        fmt::print("{}{}", contents_text(j), files->size() > 1 ? "\n" : "");
      }
      all.push_back(std::move(j));
    }
    if (context.json) fmt::print("{}\n", json_text(all));
  });
}

}  // namespace myoid::cli
