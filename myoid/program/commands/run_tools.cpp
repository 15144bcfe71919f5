#include "myoid/program/commands/run_tools.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <iterator>
#include <mutex>
#include <optional>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/in_jobs.h"
#include "myoid/ground/core/json_text.h"
#include "myoid/ground/files/result_record.h"
#include "myoid/opensim/setup_list.h"
#include "myoid/opensim/tool_folders.h"

namespace myoid::program {
namespace {

namespace fs = std::filesystem;

/// All set-ups of a call and what they have in common.
class SetupRuns {
 public:
  explicit SetupRuns(const RunToolsOptions& options) : options_(options), remarks_(options.call) {
    setups_ = opensim::list_setups({options.setups.begin(), options.setups.end()});
    for (const opensim::NamedSetup& setup : setups_) outcomes_.push_back({.setup = setup.name.string()});
    ended_.resize(setups_.size());
    for (std::size_t i = 0; i < setups_.size(); ++i) places_.push_back(place_of(i));
  }

  std::vector<SetupOutcome> run() {
    for (int place = 0; place <= 3; ++place) run_place(place);
    for (std::string& note : folders_.finish()) remarks_.note(std::move(note));
    return std::move(outcomes_);
  }

 private:
  [[nodiscard]] opensim::SetupFiles files_of(std::size_t i) const {
    return {.model = options_.files.model,
            .out = options_.files.out.empty() ? fs::path() : options_.files.out / setups_[i].name};
  }

  /// Empty for a set-up that cannot be read: its outcome says why.
  std::optional<int> place_of(std::size_t i) {
    try {
      return opensim::place_in_study(opensim::OpensimSetup(setups_[i].file, files_of(i)));
    } catch (const InvalidInput& error) {
      end(i, {.setup = outcomes_[i].setup, .status = SetupStatus::failed, .message = error.what()});
      return std::nullopt;
    }
  }

  /// The set-ups of earlier places: those that did not run, and the files of the others.
  struct Earlier {
    std::vector<std::string> failed;
    std::vector<fs::path> files;
  };

  [[nodiscard]] Earlier earlier() const {
    Earlier all;
    for (std::size_t i = 0; i < setups_.size(); ++i) {
      if (!ended_[i]) continue;
      if (outcomes_[i].status >= SetupStatus::failed) all.failed.push_back(outcomes_[i].setup);
      std::ranges::copy(outcomes_[i].result.tool.files, std::back_inserter(all.files));
    }
    return all;
  }

  void run_place(int place) {
    std::vector<std::size_t> now;
    for (std::size_t i = 0; i < setups_.size(); ++i)
      if (places_[i] == place) now.push_back(i);
    const Earlier before = earlier();
    in_jobs(now.size(), 0, [&](std::size_t k) {
      options_.call.progress.check();
      end(now[k], outcome_of(now[k], before));
    });
  }

  SetupOutcome outcome_of(std::size_t i, const Earlier& before) {
    SetupOutcome outcome{.setup = outcomes_[i].setup};
    try {
      if (const fs::path stale = stale_input(i, before); !stale.empty()) {
        outcome.status = SetupStatus::not_run;
        outcome.message = fmt::format("{} is a result of an earlier call, and {} did not run in this one",
                                      stale.string(), fmt::join(before.failed, ", "));
        return outcome;
      }
      outcome.result = run_tool(call_of(i));
      outcome.status = outcome.result.good() ? SetupStatus::done : SetupStatus::gate_failed;
    } catch (const InvalidInput& error) {
      outcome.message = error.what();
    } catch (const fs::filesystem_error& error) {  // the disk is full, a folder cannot be read
      outcome.message = error.what();
    }
    return outcome;
  }

  /// Returns an input that an earlier call of `run-tool` wrote and no set-up of this call, if one did not run.
  [[nodiscard]] fs::path stale_input(std::size_t i, const Earlier& before) const {
    if (before.failed.empty()) return {};
    for (const fs::path& input : opensim::OpensimSetup(setups_[i].file, files_of(i)).inputs()) {
      std::error_code ignored;
      const bool is_new =
          std::ranges::any_of(before.files, [&](const fs::path& file) { return fs::equivalent(file, input, ignored); });
      if (!is_new && author_of(input) == "run-tool") return input;
    }
    return {};
  }

  RunToolOptions call_of(std::size_t i) {
    RunToolOptions one = options_;
    one.setup = setups_[i].file.string();
    one.files = files_of(i);
    one.folders = &folders_;
    one.call.progress.report = nullptr;
    one.call.listener = [this, name = outcomes_[i].setup](const Remark& remark) {
      Remark named = remark;
      named.says = name + ": " + named.says;
      const std::scoped_lock lock(mutex_);
      remarks_.add(std::move(named));
    };
    return one;
  }

  void end(std::size_t i, SetupOutcome outcome) {
    const std::scoped_lock lock(mutex_);
    ended_[i] = true;
    outcomes_[i] = std::move(outcome);
    const auto done = static_cast<double>(std::ranges::count(ended_, true));
    options_.call.progress.tell(done / static_cast<double>(setups_.size()),
                                fmt::format("{} of {} set-ups", done, setups_.size()));
    if (options_.heard) options_.heard(outcomes_[i]);
  }

  const RunToolsOptions& options_;
  Remarks remarks_;
  opensim::ToolFolders folders_;
  std::mutex mutex_;
  std::vector<opensim::NamedSetup> setups_;
  std::vector<SetupOutcome> outcomes_;
  std::vector<std::optional<int>> places_;
  std::vector<bool> ended_;
};

}  // namespace

std::string_view status_word(SetupStatus status) {
  static constexpr std::array<std::string_view, 4> kWords{"done", "not all frames", "failed", "not run"};
  return kWords[static_cast<std::size_t>(status)];
}

void visit(RunToolsOptions& o, study::SettingVisitor& v) {
  v.paths(
      "setup", o.setups,
      {.says = "Set-up files (.xml) and folders of set-up files.", .required = "a file", .option = {.by_place = true}});
  visit_setup_run(o, v);
}

std::vector<SetupOutcome> run_tools(const RunToolsOptions& options) {
  if (!options.files.motion.empty() || !options.files.external_loads.empty())
    throw InvalidInput("--motion and --external-loads name the files of one trial; give one set-up with them");
  return SetupRuns(options).run();
}

std::string run_tools_json(const std::vector<SetupOutcome>& outcomes) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const SetupOutcome& each : outcomes) {
    nlohmann::ordered_json row{{"setup", each.setup}, {"status", status_word(each.status)}, {"message", each.message}};
    row.update(run_tool_object(each.result));
    list.push_back(std::move(row));
  }
  return json_text(list) + "\n";
}

}  // namespace myoid::program
