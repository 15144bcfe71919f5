#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "myoid/cli/context.h"
#include "myoid/core/json_text.h"
#include "myoid/files/atomic_file.h"
#include "myoid/files/text_file.h"
#include "myoid/model/opensim_defects/compat.h"
#include "myoid/osim/osim_updater.h"

namespace myoid::cli {

void add_update_file(CLI::App& app, Context& context) {
  CLI::App& command =
      *app.add_subcommand("update-file",
                          "Write an OpenSim model or set-up of any version in the newest form\n"
                          "Example: myoid update-file gait2392_v2.osim gait2392.osim");
  struct Options {
    std::string old_file, new_file, compat = "exact";
  };
  const auto o = std::make_shared<Options>();
  command.add_option("old", o->old_file, "Model, set-up or set (.osim, .xml)")->required();
  command.add_option("new", o->new_file, "File to write")->required();
  command
      .add_option("--compat", o->compat,
                  "exact: offsets of joints and inertias keep their digits; opensim: they are "
                  "rounded to six, as OpenSim converts them (default exact)")
      ->check(CLI::IsMember({"exact", "opensim"}));
  add_common_options(command, context, {.threads = false, .seed = false, .range = false});
  command.callback([&context, o] {
    context.prepare_file(o->new_file, {o->old_file});
    const std::string text = recording::read_text_file(o->old_file);
    const model::UpdatedOsim updated = model::updated_osim(
        text, o->old_file, {.six_digits = model::parse_compat(o->compat).six_digit_offsets});
    recording::write_file(o->new_file, updated.text);
    context.tell_new_folders();
    for (const std::string& note : updated.notes) context.warn(note);
    if (context.json) {
      const nlohmann::ordered_json json{
          {"file", o->new_file},
          {"old_version", updated.old_version},
          {"version", std::max(updated.old_version, model::kNewestOsimVersion)},
          {"notes", updated.notes}};
      fmt::print("{}\n", json_text(json));
    } else {
      fmt::print("version {} -> {}\n{}\n", updated.old_version,
                 std::max(updated.old_version, model::kNewestOsimVersion), o->new_file);
    }
  });
}

}  // namespace myoid::cli
