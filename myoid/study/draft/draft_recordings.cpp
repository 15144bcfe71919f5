#include "myoid/study/draft/draft_recordings.h"

#include <algorithm>
#include <set>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/body/model/kinematic_tree.h"
#include "myoid/body/osim/osim_xml.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/files/file_format.h"
#include "myoid/ground/files/record_list.h"
#include "myoid/ground/files/text_file.h"
#include "myoid/recording/channel_choice.h"
#include "myoid/recording/emg_reader.h"
#include "myoid/recording/recording.h"
#include "myoid/recording/tables/instrument_names.h"
#include "myoid/recording/tables/storage_reader.h"
#include "myoid/study/trial_up.h"

namespace myoid::study {
namespace {

namespace fs = std::filesystem;
using ground::FileFormat;

std::string small(std::string text) {
  for (char& c : text) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
  return text;
}

/// Returns true for the tables that describe a BIDS recording and hold no samples.
bool is_bids_description(const fs::path& path) {
  const std::string name = path.filename().string();
  const auto ends = [&](const char* ending) { return name.ends_with(ending); };
  return ends("_channels.tsv") || ends("_electrodes.tsv") || ends("_events.tsv") || ends("_scans.tsv") ||
         ends("_sessions.tsv") || name == "participants.tsv";
}

/// Returns the words of a name. A minus between a separator and a digit is a number's sign: "pas_-10" is not "pas_10".
std::vector<std::string> words_of(const std::string& stem) {
  std::vector<std::string> words(1);
  const std::string text = small(stem);
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    const bool is_sign =
        c == '-' && words.back().empty() && i + 1 < text.size() && text[i + 1] >= '0' && text[i + 1] <= '9';
    if (!is_sign && (c == '_' || c == '-' || c == ' ' || c == '.')) {
      if (!words.back().empty()) words.emplace_back();
    } else {
      words.back() += c;
    }
  }
  if (words.back().empty() && words.size() > 1) words.pop_back();
  return words;
}

/// True if the name of a file or channel, or a title, in small letters says that it holds EMG or what follows from it.
bool says_emg(const std::string& text) {
  const auto has = [&](const char* word) { return text.find(word) != std::string::npos; };
  return has("emg") || has("electromyo") || has("excitation") || has("activation");
}

/// Returns the files of a folder that its record names as results of a command that computes. Other commands write
/// recordings, or a file that a study may take.
std::set<fs::path> results_in(const fs::path& folder) {
  static const std::set<std::string, std::less<>> kComputing{"run",     "identify",   "so",     "paths",  "predict",
                                                             "compare", "twin-study", "report", "cohort", "design"};
  std::set<fs::path> found;
  for (const auto& [name, written] : read_record(folder).files)
    if (kComputing.contains(written.back().command)) found.insert((folder / name).lexically_normal());
  return found;
}

/// Returns true for a folder inside the named ones that holds results, or a virtual person's truth.
bool holds_results(const fs::path& folder) {
  constexpr std::string_view kTruth = "truth";
  if (!results_in(folder).empty() || read_record(folder).files.contains("parameters.json")) return true;
  if (folder.filename() != kTruth) return false;
  const RecordContent around = read_record(folder.parent_path());
  return std::ranges::any_of(around.files,
                             [&](const auto& entry) { return entry.first.starts_with(fmt::format("{}/", kTruth)); });
}

}  // namespace

std::string trial_stem(const fs::path& path) {
  static const std::set<std::string, std::less<>> kKinds{
      "emg",      "raw",    "uv",       "mv",      "v",      "env",          "envelope",   "envelopes",  "filt",
      "filtered", "emgraw", "emgfilt",  "imu",     "ik",     "motion",       "landmarks",  "kalman",     "elbow",
      "angles",   "mocap",  "markers",  "marker",  "analog", "trc",          "c3d",        "mot",        "grf",
      "forces",   "loads",  "external", "devices", "device", "trajectories", "trajectory", "dynamometer"};
  std::vector<std::string> words = words_of(path.stem().string());
  const fs::path folder = fs::absolute(path).lexically_normal().parent_path().filename();
  if (!folder.empty() && std::ranges::all_of(words, [](const std::string& w) { return kKinds.contains(w); }))
    words = words_of(folder.string());
  while (words.size() > 1 && kKinds.contains(words.back())) words.pop_back();
  while (words.size() > 1 && kKinds.contains(words.front())) words.erase(words.begin());
  return fmt::format("{}", fmt::join(words, "_"));
}

void find_emg(const fs::path& path,
              const TimeSeries& analog,
              const std::vector<recording::PlateSetup>& plates,
              FoundRecording& found) {
  found.channels = recording::emg_channels(analog.channels(), plates);
  const auto format = format_of(path);
  const bool storage = format == FileFormat::storage;
  const std::string name = small(path.filename().string());
  if (found.channels.empty() && (storage || format == FileFormat::text_table)) {
    std::string title;
    found.has_unit = false;
    if (storage) {
      const recording::Storage file = recording::read_storage(path);
      found.has_unit = recording::stated_voltage(file).has_value();
      title = small(file.title);
    }
    const bool all = found.has_unit || says_emg(name) || says_emg(title);
    for (const Channel& c : analog.channels()) {
      if (all || (says_emg(small(c.name)) && !recording::named_as_no_emg(c.name))) found.channels.push_back(c.name);
    }
  }
  if (found.channels.empty()) return;
  // Raw EMG goes through its median many times a second, an envelope (below some 10 Hz) does not.
  std::vector<std::string> named;
  for (const std::string& c : found.channels) {
    if (small(c).find("emg") != std::string::npos) named.push_back(c);
  }
  const TimeSeries emg = analog.select(named.empty() ? found.channels : named);
  const Eigen::Index n = emg.sample_count();
  if (n < 3) return;
  const double length_s = emg.time_s()[n - 1] - emg.time_s()[0];
  constexpr double kRaw_hz = 30.0;
  Eigen::Index raw = 0, varying = 0;
  for (Eigen::Index c = 0; c < emg.channel_count(); ++c) {
    const Eigen::VectorXd x = emg.values().col(c);
    if (!(x.maxCoeff() > x.minCoeff())) continue;  // no electrode on it
    ++varying;
    Eigen::VectorXd sorted = x;
    std::nth_element(sorted.begin(), sorted.begin() + n / 2, sorted.end());
    Eigen::Index crossings = 0;
    for (Eigen::Index k = 1; k < n; ++k) {
      if ((x[k] > sorted[n / 2]) != (x[k - 1] > sorted[n / 2])) ++crossings;
    }
    if (static_cast<double>(crossings) > kRaw_hz * length_s) ++raw;
  }
  found.raw = 2 * raw >= varying;
}

fs::path loads_data_file(const fs::path& external_loads) {
  std::string name;
  try {
    const body::OsimXml xml(read_text_file(external_loads), external_loads, body::OsimXml::Root::any);
    name = xml.word(xml.root().child("ExternalLoads"), "datafile");
  } catch (const ReadError&) {
    return {};
  }
  std::ranges::replace(name, '\\', '/');
  return name.empty() ? fs::path() : external_loads.parent_path() / name;
}

std::vector<fs::path> recordings_in(const std::vector<fs::path>& from, FoundBeside& beside) {
  constexpr int kDeep = 6;
  std::vector<fs::path> files;
  for (const fs::path& path : from) {
    std::error_code error;
    if (!fs::is_directory(path, error)) {
      files.push_back(path);
      continue;
    }
    // Recordings may stand beside results in the named folder itself.
    const std::set<fs::path> own = results_in(path);
    if (!own.empty()) beside.results.push_back(path);
    for (auto it = fs::recursive_directory_iterator(path, fs::directory_options::skip_permission_denied, error);
         !error && it != fs::recursive_directory_iterator(); it.increment(error)) {
      if (it.depth() > kDeep) it.disable_recursion_pending();
      if (it->is_directory(error) && holds_results(it->path())) {
        beside.results.push_back(it->path());
        it.disable_recursion_pending();
      }
      if (!it->is_regular_file(error) || own.contains(it->path().lexically_normal())) continue;
      const auto format = format_of(it->path());
      if (!format) continue;
      if (format == FileFormat::model) beside.models.push_back(it->path());
      if (format == FileFormat::set_up && !loads_data_file(it->path()).empty())
        beside.external_loads.push_back(it->path());
      if (is_recording(*format) && !is_bids_description(it->path())) files.push_back(it->path());
    }
  }
  std::ranges::sort(files);
  std::ranges::sort(beside.models);
  std::ranges::sort(beside.external_loads);
  return files;
}

Use guessed_use(const std::string& stem) {
  for (const std::string& word : words_of(stem)) {
    if (word.starts_with("mvc") || word.starts_with("mvic") || word == "max") return Use::mvc;
    if (word == "static" || word == "tpose" || word == "calibration" || word == "anatomical") return Use::static_pose;
    if (word == "passive" || word == "pas" || word == "rest" || word == "resting" || word.starts_with("relax"))
      return Use::passive;
  }
  return Use::calibration;
}

}  // namespace myoid::study
