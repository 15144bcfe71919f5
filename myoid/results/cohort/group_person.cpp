#include "myoid/results/cohort/group_person.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/json_text.h"
#include "myoid/ground/files/record_list.h"
#include "myoid/ground/files/text_file.h"
#include "myoid/ground/math/statistics.h"
#include "myoid/page/plain_unit.h"
#include "myoid/page/read_gates.h"
#include "myoid/results/comparison/change_sentences.h"

namespace myoid::results {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using recording::CsvTable;

constexpr int kDeepest = 3;  // below the folder that is named

std::string cell(const CsvTable& table, const std::vector<std::string>& row, const char* name) {
  const auto found = std::ranges::find(table.names, name);
  return found == table.names.end() ? "" : row[static_cast<std::size_t>(found - table.names.begin())];
}

std::string chosen_method(const CsvTable& table) {
  std::string method;
  for (const auto& row : table.rows) {
    const std::string here = cell(table, row, "method");
    if (method.empty() || here == "torque") method = here;
  }
  return method;
}

std::optional<GroupNumber> number_of(const CsvTable& table, const std::vector<std::string>& row) {
  const std::string written = cell(table, row, "unit");
  const auto known = parse_unit(written);
  const page::PlainUnit unit = known && known->to_si == 1.0 ? page::plain_unit(known->unit) : page::PlainUnit{written};
  const auto value = [&](const char* name) {
    std::optional<double> number = parse_number(cell(table, row, name));
    if (number) *number *= unit.per_si;
    return number;
  };
  const auto estimate = value("estimate");
  if (!estimate) return std::nullopt;
  const auto fit_case = choice_named<fit::FitCase>(cell(table, row, "case"));
  return GroupNumber{
      .parameter = cell(table, row, "parameter") + branch_text(fit_case.value_or(fit::FitCase::both), ", "),
      .muscle = cell(table, row, "muscle"),
      .unit = std::string(unit.symbol),
      // A word that is no verdict vouches for nothing.
      .verdict = choice_named<fit::Verdict>(cell(table, row, "verdict")).value_or(fit::Verdict::not_identifiable),
      .estimate = *estimate,
      .low = value("ci_low"),
      .high = value("ci_high"),
      .given = value("given_estimate"),
      .given_low = value("given_ci_low"),
      .given_high = value("given_ci_high"),
      .truth = value("truth")};
}

json read_json(const fs::path& file) {
  try {
    return parse_json(read_text_file(file));
  } catch (const json::exception& error) {
    throw ReadError(file, 0, fmt::format("is damaged: {}; run the study again", json_error_text(error)));
  }
}

/// Questions that the recording or the fit did not pass.
void add_questions(const page::UnpassedGates& gates, std::vector<Quality>& quality) {
  quality.push_back({.name = "questions not passed",
                     .unit = {},
                     .value = static_cast<double>(gates.failed.size() + gates.warned.size()),
                     .status = !gates.failed.empty()   ? page::GateStatus::fail
                               : !gates.warned.empty() ? page::GateStatus::warn
                                                       : page::GateStatus::pass});
}

void add_fit(const json& parameters, std::vector<Quality>& quality) {
  for (const json& method : parameters.at("methods")) {
    if (method.at("method") == "torque" && method.at("r2").is_number())
      quality.push_back({"R2 of the fitted samples", "", method.at("r2").get<double>()});
  }
  std::vector<double> r2, rmse_nm;
  for (const json& fold : parameters.value("leave_one_trial_out", json::array())) {
    const json identified = fold.value("identified", json::object());
    if (identified.value("r2", json()).is_number()) r2.push_back(identified.at("r2"));
    if (identified.value("rmse_nm", json()).is_number()) rmse_nm.push_back(identified.at("rmse_nm"));
  }
  if (!r2.empty()) quality.push_back({"R2 of trials left out", "", math::median(r2)});
  if (!rmse_nm.empty()) quality.push_back({"torque error, left out", "N m", math::median(rmse_nm)});
}

void add_markers(const json& run, std::vector<Quality>& quality) {
  std::vector<double> errors_mm;
  for (const json& trial : run.value("trials", json::array())) {
    const json error_m = trial.value("marker_error_m", json());
    if (error_m.is_number()) errors_mm.push_back(1000.0 * error_m.get<double>());
  }
  if (!errors_mm.empty()) quality.push_back({"marker error, median frame", "mm", math::median(std::move(errors_mm))});
}

/// Finds the folders of runs in this one, in the order of their names.
void find_runs(const fs::path& folder, int depth, std::vector<fs::path>& runs) {
  if (fs::exists(folder / "parameters.csv")) {
    runs.push_back(folder);
    return;
  }
  if (depth == kDeepest) return;
  std::vector<fs::path> inside;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (entry.is_directory()) inside.push_back(entry.path());
  std::ranges::sort(inside);
  for (const fs::path& each : inside) find_runs(each, depth + 1, runs);
}

/// Adds each person of a twin-study by the seed.
bool add_virtual_persons(const fs::path& folder, std::vector<GroupPerson>& persons) {
  const fs::path file = folder / "persons.csv";
  if (!fs::exists(file)) return false;
  const CsvTable all = recording::read_csv_table(file);
  if (std::ranges::find(all.names, "seed") == all.names.end()) return false;
  std::map<long, CsvTable> by_seed;
  for (const auto& row : all.rows) {
    const auto seed = parse_number(cell(all, row, "seed"));
    if (!seed) continue;
    CsvTable& of = by_seed[static_cast<long>(*seed)];
    of.names = all.names;
    of.rows.push_back(row);
  }
  for (const auto& [seed, rows] : by_seed)
    persons.push_back(
        {.name = fmt::format("person {}", seed), .page = {}, .numbers = group_numbers(rows), .quality = {}});
  return true;
}

/// Returns the names without their common beginning and end.
std::vector<std::string> names_of(const std::vector<fs::path>& runs) {
  std::vector<std::vector<std::string>> parts;
  for (const fs::path& run : runs) {
    std::vector<std::string>& of = parts.emplace_back();
    for (const fs::path& part : fs::absolute(run).lexically_normal())
      if (!part.empty() && part != "/") of.push_back(part.string());
  }
  const auto alike = [&](std::size_t i, bool from_end) {
    return std::ranges::all_of(parts, [&](const auto& of) {
      return i + 1 < of.size() &&
             (from_end ? of[of.size() - 1 - i] == parts[0][parts[0].size() - 1 - i] : of[i] == parts[0][i]);
    });
  };
  std::size_t front = 0, back = 0;
  if (parts.size() > 1) {
    while (alike(front, false)) ++front;
    while (alike(back, true)) ++back;
  }
  std::vector<std::string> names;
  for (const auto& of : parts) {
    std::string name;
    const std::size_t first = parts.size() > 1 ? front : of.size() - 1;
    for (std::size_t i = first; i < of.size() - back; ++i) name += (name.empty() ? "" : "/") + of[i];
    names.push_back(name.empty() ? of.back() : name);
  }
  return names;
}

}  // namespace

std::vector<GroupNumber> group_numbers(const CsvTable& parameters) {
  const std::string method = chosen_method(parameters);
  std::vector<GroupNumber> numbers;
  for (const auto& row : parameters.rows) {
    if (cell(parameters, row, "method") != method) continue;
    if (std::optional<GroupNumber> number = number_of(parameters, row)) numbers.push_back(std::move(*number));
  }
  return numbers;
}

std::vector<Quality> run_quality(const fs::path& folder) {
  std::vector<Quality> quality;
  const fs::path report = folder / "report.json", parameters = folder / "parameters.json", run = folder / "run.json";
  try {
    if (fs::exists(report)) add_questions(page::read_gates(folder), quality);
    if (fs::exists(parameters)) add_fit(read_json(parameters), quality);
    if (fs::exists(run)) add_markers(read_json(run), quality);
  } catch (const json::exception& error) {
    throw ReadError(
        folder, 0,
        fmt::format("is not the result of a run: {}; run the study again (myoid run)", json_error_text(error)));
  }
  return quality;
}

std::vector<GroupRun> group_runs(const std::vector<fs::path>& folders) {
  std::vector<fs::path> runs;
  for (const fs::path& folder : folders) {
    if (!fs::is_directory(folder))
      throw ReadError(folder, 0, "is no folder; give folders of runs, or one that holds them");
    const std::size_t before = runs.size();
    find_runs(folder, 0, runs);
    if (runs.size() == before)
      throw ReadError(folder, 0,
                      "holds no run: no parameters.csv in it or in folders inside; run the studies first (myoid run, "
                      "myoid cohort)");
  }
  const std::vector<std::string> names = names_of(runs);
  std::vector<GroupRun> found;
  for (std::size_t i = 0; i < runs.size(); ++i) found.push_back({names[i], runs[i]});
  return found;
}

std::vector<std::string> changed_files(const GroupRun& run) {
  return changed_since_written(run.folder, {"parameters.csv", "parameters.json", "report.json"});
}

std::string page_of(const GroupRun& run, const fs::path& page_folder) {
  const fs::path page = run.folder / "report.html";
  if (!fs::exists(page)) return "";
  const fs::path from = fs::absolute(page_folder).lexically_normal();
  return fs::absolute(page).lexically_normal().lexically_relative(from).generic_string();
}

std::vector<GroupPerson> read_group_persons(const std::vector<fs::path>& folders, const fs::path& page_folder) {
  std::vector<GroupPerson> persons;
  std::vector<fs::path> others;
  for (const fs::path& folder : folders)
    if (!add_virtual_persons(folder, persons)) others.push_back(folder);
  for (const GroupRun& run : group_runs(others))
    persons.push_back({.name = run.name,
                       .page = page_of(run, page_folder),
                       .numbers = group_numbers(recording::read_csv_table(run.folder / "parameters.csv")),
                       .quality = run_quality(run.folder),
                       .identity = fs::exists(run.folder / "parameters.json") ? study::read_run_identity(run.folder)
                                                                              : study::RunIdentity{},
                       .changed = changed_files(run)});
  return persons;
}

}  // namespace myoid::results
