#include "myoid/study/run_record.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/json_text.h"
#include "myoid/ground/files/result_folder.h"
#include "myoid/ground/files/text_file.h"

namespace myoid::study {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

std::optional<double> number_of(const json& run, const char* key) {
  const auto found = run.find(key);
  if (found == run.end() || !found->is_number()) return std::nullopt;
  return found->get<double>();
}

/// Returns how many of the last parts of two paths are the same: 2 of "a/1/l.sto" and "b/1/l.sto".
std::ptrdiff_t common_end(const fs::path& a, const fs::path& b) {
  const std::vector<fs::path> x(a.begin(), a.end()), y(b.begin(), b.end());
  return std::mismatch(x.rbegin(), x.rend(), y.rbegin(), y.rend()).first - x.rbegin();
}

}  // namespace

RunRecord read_run_record(const fs::path& folder) {
  require_results(folder, "run.json");
  const fs::path path = folder / "run.json";
  RunRecord record{.folder = folder};
  try {
    const json run = parse_json(read_text_file(path));
    if (!run.contains("study")) throw ReadError(path, 0, "does not name its study; run the study again");
    record.study = run.at("study").get<std::string>();
    record.command = run.value("command", "");
    record.start_s = number_of(run, "start_s");
    record.end_s = number_of(run, "end_s");
    for (const json& trial : run.value("trials", json::array()))
      record.uses[trial.at("name").get<std::string>()] = trial.at("use").get<std::string>();
    for (const json& input : run.value("inputs", json::array()))
      record.inputs.push_back({input.at("path").get<std::string>(), input.at("sha256").get<std::string>()});
    record.seconds = run.value("seconds", record.seconds);
  } catch (const json::exception& error) {
    throw ReadError(path, 0, fmt::format("not a run's record: {}; run the study again", json_error_text(error)));
  }
  return record;
}

void refuse_changed(const std::vector<InputFile>& inputs, const RunRecord& run, const fs::path& but) {
  for (const InputFile& now : inputs) {
    const fs::path name = fs::path(now.path).filename();
    if (name == but.filename()) continue;
    // The trials of a study may have files of one name in folders of their own: the nearest path counts.
    std::ptrdiff_t nearest = 1;  // the name
    for (const InputFile& recorded : run.inputs) nearest = std::max(nearest, common_end(recorded.path, now.path));
    const auto is_nearest = [&](const InputFile& recorded) { return common_end(recorded.path, now.path) == nearest; };
    const auto same = [&](const InputFile& recorded) { return is_nearest(recorded) && recorded.sha256 == now.sha256; };
    if (std::ranges::none_of(run.inputs, is_nearest) || std::ranges::any_of(run.inputs, same)) continue;
    throw ReadError(
        now.path, 0,
        fmt::format("has changed since the run in {}; run the study again (myoid run)", run.folder.string()));
  }
}

}  // namespace myoid::study
