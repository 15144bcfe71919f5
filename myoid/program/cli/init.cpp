#include "myoid/program/commands/init.h"

#include <string>

#include <nlohmann/json.hpp>

#include "myoid/ground/core/json_text.h"
#include "myoid/ground/files/quoted_text.h"
#include "myoid/program/cli/context.h"
#include "myoid/program/cli/options.h"
#include "myoid/program/cli/say.h"
#include "myoid/study/open_question.h"

namespace myoid::program {
namespace {

/// Prints the questions of a draft with their lines, by which an editor finds them.
void print_questions(const std::string& toml) {
  for (const study::OpenQuestion& question : study::open_questions_in(toml))
    say("TODO line {}: {}\n", question.line, question.text);
}

void carry_out(Context& context, const InitOptions& o, const CLI::App& /*command*/) {
  const std::filesystem::path file = program::study_file(o);
  context.prepare_file(file, {});
  const program::InitResult result = program::init(o);
  program::write_init(result, file, o.call);
  const std::vector<std::string>& todos = result.draft.todo;
  if (context.json) {
    say_whole(json_text(nlohmann::ordered_json{{"file", file.string()}, {"todo", todos}}) + "\n");
    return;
  }
  say("{}\n", file.string());
  print_questions(result.draft.toml);
  say("next: myoid check {}\n", shell_word(file.string()));
}

}  // namespace

void add_init(CLI::App& app, Context& context) {
  add_command<InitOptions>(app, context, "init",
                           "Writes a commented study.toml to start from: finds recordings, pairs EMG "
                           "channels with muscles, and leaves TODO lines where it cannot know.\n"
                           "Example: myoid init study --from recordings --model arm.osim",
                           {.threads = false, .seed = false, .range = false}, carry_out);
}

}  // namespace myoid::program
