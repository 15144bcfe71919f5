#include "myoid/recording/bids_derivative.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/json_text.h"
#include "myoid/ground/core/provenance.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/ground/files/name_ids.h"
#include "myoid/ground/files/result_record.h"
#include "myoid/recording/tables/csv_reader.h"
#include "myoid/recording/tables/storage_reader.h"

namespace myoid::recording {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

std::string cell(std::string text) {
  std::replace(text.begin(), text.end(), '\t', ' ');
  return text.empty() ? "n/a" : text;
}

std::string parameters_tsv(const CsvTable& table) {
  std::string text;
  for (std::size_t c = 0; c < table.names.size(); ++c) text += (c == 0 ? "" : "\t") + table.names[c];
  text += '\n';
  for (const auto& row : table.rows) {
    for (std::size_t c = 0; c < row.size(); ++c) text += (c == 0 ? "" : "\t") + cell(row[c]);
    text += '\n';
  }
  return text;
}

ordered_json parameters_columns(const CsvTable& table) {
  const ordered_json known{
      {"muscle", "Muscle or group of muscles"},
      {"parameter", "Parameter of the Hill-type muscle"},
      {"unit", "Unit of initial, estimate, std_error, ci_low, ci_high, prior_mean and prior_sd"},
      {"method", "Estimator"},
      {"case", "Samples used: shortening, lengthening or both"},
      {"initial", "Starting value"},
      {"estimate", "Identified value"},
      {"std_error", "Standard error"},
      {"ci_low", "Lower end of the confidence interval"},
      {"ci_high", "Upper end of the confidence interval"},
      {"given_estimate", "Value if geometry and sensors were exact"},
      {"given_ci_low", "Lower end of its confidence interval"},
      {"given_ci_high", "Upper end of its confidence interval"},
      {"prior_mean", "Mean of the prior"},
      {"prior_sd", "Standard deviation of the prior"},
      {"shrinkage", "Share of the prior's spread that the data removed"},
      {"at_bound", "Whether the estimate leans on a bound"},
      {"verdict", "identified, reproducible, weak, prior_dominated, not_identifiable or non_physical"},
      {"reason", "Why"}};
  ordered_json json = ordered_json::object();
  for (const std::string& name : table.names)
    json[name] = {{"Description", known.contains(name) ? known[name].get<std::string>() : name}};
  return json;
}

bool is_translation(const std::string& name) {
  return name.ends_with("_tx") || name.ends_with("_ty") || name.ends_with("_tz");
}

}  // namespace

std::vector<fs::path> write_bids_derivative(const fs::path& results, const fs::path& out, const std::string& subject) {
  const CsvTable table = read_csv_table(results / "parameters.csv");
  std::vector<fs::path> written;
  const auto write = [&](const fs::path& path, const std::string& text) {
    write_file(path, text);
    written.push_back(path);
  };
  if (const std::string reason = name_refusal(subject); !reason.empty()) throw InvalidInput("the subject: {}", reason);
  const std::string sub = "sub-" + ids_of({subject}, IdFor::label).front();
  const ordered_json description{{"Name", "Muscle parameters identified by Myoid"},
                                 {"BIDSVersion", "1.10.0"},
                                 {"DatasetType", "derivative"},
                                 {"GeneratedBy", ordered_json::array({{{"Name", "Myoid"}, {"Version", version()}}})}};
  const fs::path about = out / "dataset_description.json";
  const bool ours = standing_of(about) != Standing::foreign;
  write_unless_foreign(about, json_text(description) + '\n');
  if (ours) written.push_back(about);
  const std::string stem = sub + "_desc-identified_parameters";
  write(out / sub / (stem + ".tsv"), parameters_tsv(table));
  write(out / sub / (stem + ".json"), json_text(parameters_columns(table)) + '\n');

  std::vector<fs::path> trials;
  for (const auto& entry : fs::directory_iterator(results)) {
    if (entry.is_directory() && fs::exists(entry.path() / "ik.mot")) trials.push_back(entry.path());
  }
  std::sort(trials.begin(), trials.end());
  std::vector<std::string> names;
  for (const fs::path& trial : trials) names.push_back(trial.filename().string());
  const std::vector<std::string> tasks = ids_of(names, IdFor::label);
  for (std::size_t t = 0; t < trials.size(); ++t) {
    const fs::path& trial = trials[t];
    const std::string& task = tasks[t];
    const Storage motion = read_storage(trial / "ik.mot");
    const auto base = out / sub / "motion";
    const std::string name = fmt::format("{}_task-{}_tracksys-model", sub, task);
    std::string channels = "name\tcomponent\ttype\ttracked_point\tunits\n";
    std::size_t angles = 0;
    for (const Channel& channel : motion.data.channels()) {
      const bool moves = is_translation(channel.name);
      angles += moves ? 0 : 1;
      channels += fmt::format("{0}\t{1}\t{2}\t{0}\t{3}\n", cell(channel.name),
                              moves ? channel.name.substr(channel.name.size() - 1) : "n/a", moves ? "POS" : "JNTANG",
                              moves               ? "m"
                              : motion.in_degrees ? "deg"
                                                  : "rad");
    }
    std::string rows;
    for (Eigen::Index i = 0; i < motion.data.sample_count(); ++i) {
      for (Eigen::Index c = 0; c < motion.data.channel_count(); ++c) {
        rows += c == 0 ? "" : "\t";
        rows += format_number(motion.data.values()(i, c));
      }
      rows += '\n';
    }
    const ordered_json sidecar{{"TaskName", task},
                               {"SamplingFrequency", motion.data.mean_rate_hz()},
                               {"TrackingSystemName", "model"},
                               {"Description", "Coordinates of a musculoskeletal model by inverse kinematics"},
                               {"StartTime", motion.data.time_s()[0]},
                               {"MotionChannelCount", motion.data.channel_count()},
                               {"JNTANGChannelCount", angles},
                               {"MissingValues", "n/a"}};
    write(base / (name + "_motion.tsv"), rows);
    write(base / (name + "_motion.json"), json_text(sidecar) + '\n');
    write(base / (name + "_channels.tsv"), channels);
  }
  return written;
}

}  // namespace myoid::recording
