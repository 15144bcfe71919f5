#include "myoid/results/mat/results_mat.h"

#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/json_text.h"
#include "myoid/ground/core/numbers.h"
#include "myoid/ground/files/name_ids.h"
#include "myoid/ground/files/text_file.h"
#include "myoid/recording/tables/csv_reader.h"
#include "myoid/recording/tables/result_units.h"
#include "myoid/recording/tables/storage_reader.h"

namespace myoid::results {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using recording::CsvTable;

std::size_t column_of(const CsvTable& table, const std::string& name, const fs::path& path) {
  const auto it = std::find(table.names.begin(), table.names.end(), name);
  if (it == table.names.end()) throw ReadError(path, table.header_line, "has no column '{}'", name);
  return static_cast<std::size_t>(it - table.names.begin());
}

/// Returns a column of texts, of `true` and `false`, or of numbers with NaN for an empty cell.
MatValue column(const CsvTable& table, std::size_t c) {
  static const std::set<std::string> texts{"muscle", "parameter", "unit", "method", "case", "verdict", "reason"};
  static const std::set<std::string> flags{"at_bound", "routes_disagree"};
  if (texts.contains(table.names[c])) {
    MatTexts cells;
    for (const auto& row : table.rows) cells.texts.push_back(row[c]);
    return cells;
  }
  if (flags.contains(table.names[c])) {
    std::vector<bool> cells;
    for (const auto& row : table.rows) cells.push_back(row[c] == "true");
    return cells;
  }
  Eigen::MatrixXd cells(static_cast<Eigen::Index>(table.rows.size()), 1);
  for (std::size_t i = 0; i < table.rows.size(); ++i)
    cells(static_cast<Eigen::Index>(i), 0) = parse_number(table.rows[i][c]).value_or(kNan);
  return cells;
}

MatStruct parameters_of(const CsvTable& table) {
  MatStruct parameters;
  std::vector<std::string> names = table.names;
  std::ranges::replace(names, "case", "fit_case");
  const std::vector<std::string> fields = ids_of(names, IdFor::variable);
  for (std::size_t c = 0; c < fields.size(); ++c) parameters.fields.emplace_back(fields[c], column(table, c));
  return parameters;
}

MatStruct draws_of(const fs::path& path, const CsvTable& parameters, const fs::path& units_path) {
  std::map<std::string, std::string> units;
  const std::size_t name = column_of(parameters, "parameter", units_path);
  const std::size_t unit = column_of(parameters, "unit", units_path);
  for (const auto& row : parameters.rows) units[row[name]] = row[unit];
  const CsvTable table = recording::read_csv_table(path);
  const std::size_t weight = column_of(table, "weight", path);
  MatTexts names{.row = true}, name_units{.row = true};
  Eigen::MatrixXd values(static_cast<Eigen::Index>(table.rows.size()),
                         static_cast<Eigen::Index>(table.names.size()) - 1);
  Eigen::Index k = 0;
  for (std::size_t c = 0; c < table.names.size(); ++c) {
    if (c == weight) continue;
    names.texts.push_back(table.names[c]);
    name_units.texts.push_back(units[table.names[c].substr(table.names[c].rfind('.') + 1)]);
    values.col(k++) = std::get<Eigen::MatrixXd>(column(table, c));
  }
  return {{{"names", names}, {"units", name_units}, {"values", values}, {"weights", column(table, weight)}}};
}

/// Returns the series of a storage file; `repairs` gets those of its reader.
MatStruct series_of(const fs::path& path, std::vector<Repair>* repairs = nullptr) {
  const recording::Storage file = recording::read_storage(path);
  if (repairs != nullptr) *repairs = file.repairs;
  MatTexts names{.row = true}, units{.row = true};
  for (const Channel& channel : file.data.channels()) {
    names.texts.push_back(channel.name);
    units.texts.push_back(recording::result_unit(path.stem().string(), channel.name, file.in_degrees));
  }
  return {{{"names", names},
           {"units", units},
           {"time", Eigen::MatrixXd(file.data.time_s())},
           {"values", Eigen::MatrixXd(file.data.values())},
           {"in_degrees", std::vector<bool>{file.in_degrees}},
           {"title", file.title}}};
}

/// Returns all series in the folder of a trial, in the order of their names.
MatStruct all_series(const fs::path& folder) {
  std::vector<fs::path> files;
  if (fs::is_directory(folder)) {
    for (const auto& entry : fs::directory_iterator(folder)) {
      const fs::path ending = entry.path().extension();
      if (ending == ".sto" || ending == ".mot") files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  std::vector<std::string> stems;
  for (const fs::path& file : files) stems.push_back(file.stem().string());
  const std::vector<std::string> fields = ids_of(stems, IdFor::variable);
  MatStruct all;
  for (std::size_t i = 0; i < files.size(); ++i)
    all.fields.emplace_back(fields[i], std::vector<MatStruct>{series_of(files[i])});
  return all;
}

/// `place`: the folder of the trial's series.
MatStruct trial(const fs::path& place, const std::string& name, const std::string& use, const std::string& failure) {
  return {{{"name", name}, {"use", use}, {"failure", failure}, {"series", std::vector<MatStruct>{all_series(place)}}}};
}

/// Returns the trials of a folder without run.json: the folders with series.
std::vector<MatStruct> trials_by_folder(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.is_directory()) names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  std::vector<MatStruct> trials;
  for (const std::string& name : names) {
    if (!all_series(folder / name).fields.empty()) trials.push_back(trial(folder / name, name, "", ""));
  }
  return trials;
}

/// A remark of a run; `begin_s` and `end_s` are NaN where it has no time.
struct RemarkRow {
  std::string trial, code, level, channel;
  double begin_s = kNan, end_s = kNan;
  std::string text;
};

void add_faults(const std::string& trial, const json& faults, std::vector<RemarkRow>& rows) {
  for (const json& fault : faults)
    rows.push_back({trial, fault.at("fault").get<std::string>(), fault.at("level").get<std::string>(),
                    fault.at("channel").get<std::string>(), fault.at("begin_s").get<double>(),
                    fault.at("end_s").get<double>(), fault.at("message").get<std::string>()});
}

MatStruct remark_columns(const std::vector<RemarkRow>& rows) {
  const auto texts = [&](std::string RemarkRow::*field) {
    MatTexts column;
    for (const RemarkRow& row : rows) column.texts.push_back(row.*field);
    return column;
  };
  const auto numbers = [&](double RemarkRow::*field) {
    Eigen::MatrixXd column(std::ssize(rows), 1);
    for (std::size_t i = 0; i < rows.size(); ++i) column(static_cast<Eigen::Index>(i), 0) = rows[i].*field;
    return column;
  };
  return {{{"trial", texts(&RemarkRow::trial)},
           {"code", texts(&RemarkRow::code)},
           {"level", texts(&RemarkRow::level)},
           {"channel", texts(&RemarkRow::channel)},
           {"begin_s", numbers(&RemarkRow::begin_s)},
           {"end_s", numbers(&RemarkRow::end_s)},
           {"text", texts(&RemarkRow::text)}}};
}

/// Trials, remarks and the run itself, of run.json.
void add_run(const fs::path& folder, MatStruct& variables) {
  const json run = parse_json(read_text_file(folder / "run.json"));
  std::vector<MatStruct> trials;
  std::vector<RemarkRow> remarks;
  add_faults("", run.at("faults"), remarks);
  for (const json& t : run.at("trials")) {
    const auto name = t.at("name").get<std::string>();
    const fs::path place = folder / t.value("folder", name);
    trials.push_back(trial(place, name, t.at("use").get<std::string>(), t.at("failure").get<std::string>()));
    add_faults(name, t.at("faults"), remarks);
    for (const json& note : t.at("notes"))
      remarks.push_back({.trial = name, .code = {}, .level = "note", .channel = {}, .text = note.get<std::string>()});
  }
  if (!trials.empty()) variables.fields.emplace_back("trials", std::move(trials));
  variables.fields.emplace_back("remarks", std::vector<MatStruct>{remark_columns(remarks)});
  MatStruct about;
  for (const char* key : {"program", "version", "command", "study"})
    about.fields.emplace_back(key, run.at(key).get<std::string>());
  variables.fields.emplace_back("run", std::vector<MatStruct>{std::move(about)});
}

}  // namespace

MatStruct matlab_results(const fs::path& results, std::vector<Repair>* repairs) {
  if (!fs::is_directory(results)) {
    if (results.extension() == ".csv")
      return {{{"parameters", std::vector<MatStruct>{parameters_of(recording::read_csv_table(results))}}}};
    return {{{"series", std::vector<MatStruct>{series_of(results, repairs)}}}};
  }
  const fs::path file = results / "parameters.csv";
  const CsvTable parameters = recording::read_csv_table(file);
  MatStruct variables;
  variables.fields.emplace_back("parameters", std::vector<MatStruct>{parameters_of(parameters)});
  if (fs::exists(results / "posterior.csv"))
    variables.fields.emplace_back("draws",
                                  std::vector<MatStruct>{draws_of(results / "posterior.csv", parameters, file)});
  if (fs::exists(results / "run.json")) {
    try {
      add_run(results, variables);
    } catch (const json::exception& error) {
      throw ReadError(results / "run.json", 0, "is no record of a run of this version: {}; run the study again",
                      json_error_text(error));
    }
  } else if (std::vector<MatStruct> trials = trials_by_folder(results); !trials.empty()) {
    variables.fields.emplace_back("trials", std::move(trials));
  }
  return variables;
}

void check_mat_file(const fs::path& file) {
  if (file.extension() != ".mat")
    throw InvalidInput("{}: expected the name of a MATLAB file, which ends in .mat", file.string());
  require_matio();
}

std::vector<Repair> write_results_mat(const fs::path& results, const fs::path& file) {
  std::vector<Repair> repairs;
  write_mat_file(file, matlab_results(results, &repairs));
  return repairs;
}

}  // namespace myoid::results
