#include "myoid/program/steps/emg.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/ground/files/output_file.h"
#include "myoid/ground/files/quoted_text.h"
#include "myoid/ground/files/result_record.h"
#include "myoid/ground/files/text_file.h"
#include "myoid/program/steps/check_options.h"
#include "myoid/program/steps/emg_input.h"
#include "myoid/program/steps/stage_input.h"
#include "myoid/recording/series_file.h"

namespace myoid::program {
namespace {

/// Warns of the levels and returns the channels that are nothing but noise, which are left out. Throws InvalidInput if
/// such a channel was asked for, or there is no other.
std::vector<std::string> noise_by_levels(const std::vector<recording::TrialEnvelope>& trials,
                                         bool asked_for,
                                         Remarks& remarks) {
  const std::vector<Remark> faults = recording::check_emg_levels(trials);
  const auto is_noise = [](const Remark& fault) {
    return fault.code == RemarkCode::emg_low_signal && fault.severity == Severity::error;
  };
  const auto all = trials.front().envelope->channel_count();
  if (asked_for || std::count_if(faults.begin(), faults.end(), is_noise) == all) {
    const auto first = std::find_if(faults.begin(), faults.end(), is_noise);
    if (first != faults.end()) throw InvalidInput(sentence(*first));
  }
  GroupedWarnings warnings(remarks);
  std::vector<std::string> noise;
  for (const Remark& fault : faults) {
    const bool left_out = is_noise(fault);
    if (left_out) noise.push_back(fault.about);
    if (fault.severity != Severity::note)
      warnings.add(fault.code, fmt::format("'{}'", fault.about), left_out ? "noise" : "channels",
                   left_out ? fault.says + ": it is left out; was the electrode connected?" : sentence(fault));
  }
  return noise;
}

/// The EMG of all files, cleaned, whitened and smoothed. Either all files are whitened or none.
struct SmoothedFiles {
  std::vector<recording::EmgStages> stages;
  recording::Whitening whitening;

  [[nodiscard]] std::vector<const recording::EmgStages*> views() const {
    std::vector<const recording::EmgStages*> list;
    for (const recording::EmgStages& one : stages) list.push_back(&one);
    return list;
  }
};

SmoothedFiles smooth(const EmgOptions& o, const std::vector<std::string>& paths, Remarks& remarks) {
  GroupedWarnings warnings(remarks);
  SmoothedFiles files;
  for (const TimeSeries& raw : read_raw_emg(o, warnings)) files.stages.push_back(recording::clean_emg(raw, o.chain));
  files.whitening = recording::find_whitening(files.views(), o.chain);
  for (std::size_t i = 0; i < paths.size(); ++i) {
    recording::add_envelope(files.stages[i], o.chain, files.whitening);
    remarks.add(files.stages[i].findings, paths[i]);
  }
  for (const recording::WhiteningFilter& filter : files.whitening.filters) {
    if (filter.reason.empty())
      remarks.note(fmt::format("channel '{}': statistical bandwidth {:.0f} Hz, whitened {:.0f} Hz", filter.channel,
                               filter.bandwidth_before_hz, filter.bandwidth_after_hz));
  }
  return files;
}

/// Returns the bursts and windows of every normalized channel of a file.
std::vector<EmgMeasures> measures_of(const std::string& file,
                                     const TimeSeries& filtered,
                                     const std::vector<std::string>& channels,
                                     std::optional<double> window_s) {
  constexpr double kSlowest_hz = 100.0;  // onsets are looked for below 25 Hz
  std::vector<EmgMeasures> found;
  if (filtered.mean_rate_hz() < kSlowest_hz) return found;
  for (const std::string& channel : channels) {
    const auto c = filtered.find(channel);
    if (!c) continue;
    EmgMeasures one{.file = file, .channel = channel};
    for (const recording::EmgBurst& burst : recording::emg_bursts(filtered, *c))
      one.bursts.push_back(recording::emg_window(filtered, *c, burst.onset_s, burst.end_s));
    if (window_s) one.windows = recording::emg_windows(filtered, *c, *window_s);
    found.push_back(std::move(one));
  }
  return found;
}

}  // namespace

void visit(EmgOptions& o, study::SettingVisitor& v) {
  static const std::string kInputs =
      fmt::format("EMG ({}); of several files each is normalized by the largest effort of all.", emg_endings_text());
  v.paths("in", o.in, {.says = kInputs, .required = "a file", .option = {.keyword = "inputs", .by_place = true}});
  v.path("out", o.out,
         {.says = "Activation 0..1 (.sto, .mot or .csv); of several inputs a folder, one .sto each.",
          .required = "a file"});
  v.paths("mvc", o.mvc,
          {.says = "Maximal contractions to normalize by, repeated.",
           .otherwise = "the largest effort in the files themselves"});
  v.texts("channel", o.channels,
          {.says = "Only this channel, repeated.", .otherwise = "all of the file's first clock"});
  v.text("unit", o.unit, {.says = "Unit of the numbers where the file does not say: V, mV, uV."});
  v.number("highpass", o.chain.highpass_hz, {.says = "High-pass.", .limits = study::above_zero("Hz")});
  v.number("lowpass", o.chain.lowpass_hz,
           {.says = "Low-pass of the rectified EMG, -3 dB of both passes.", .limits = study::above_zero("Hz")});
  v.unset("no-notch", o.chain.notch, {.says = "Leave mains hum in, where it is found."});
  v.flag("whitening", o.chain.whitening,
         {.says = "Even out the spectrum of all channels before they are rectified.",
          .otherwise = "if the files allow it for every channel"});
  v.unset("no-whitening", o.chain.whitening,
          {.says = "Even it out in no channel.", .option = {.excludes = "whitening"}});
  v.flag("remove-ecg", o.chain.remove_ecg, {.says = "Take the heart out of channels that hold it, as the trunk's do."});
  v.path("measures", o.measures,
         {.says = "Write onset, end, root mean square and median frequency of every burst here (.csv)."});
  v.number("measure-window", o.measure_window_s,
           {.says = "With --measures also root mean square and median frequency of successive windows this long.",
            .limits = study::above_zero("s")});
  v.flag("as-published", o.chain.as_published,
         {.says = "As the source paper: no high-pass, low-pass designed for one pass."});
  v.number("window", o.window_s, {.says = "Window of the mean that counts as 1.", .limits = study::above_zero("s")});
  v.path("envelope", o.envelope, {.says = "Also write the envelope [V] here (.sto, .mot or .csv; or a folder)."});
}

EmgResult emg(const EmgOptions& o) {
  check_options(o);
  Remarks remarks(o.call);
  const std::vector<std::string> paths = emg_paths(o);
  SmoothedFiles files = smooth(o, paths, remarks);
  std::vector<recording::TrialEnvelope> trials;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    trials.push_back({paths[i], i >= o.in.size(), &files.stages[i].envelope, files.stages[i].bandwidth_hz,
                      files.stages[i].flatness});
  }
  const recording::NormalisationOptions window{.window_s = o.window_s};
  EmgResult result;
  result.normalisation = recording::find_normalisation(trials, window);
  const std::vector<std::string> noise = noise_by_levels(trials, !o.channels.empty(), remarks);
  std::erase_if(result.normalisation, [&](const recording::ChannelNormalisation& n) {
    return std::find(noise.begin(), noise.end(), n.channel) != noise.end();
  });
  result.whitening = files.whitening;
  result.chain = recording::envelope_chain(files.views(), o.chain, files.whitening);
  result.envelope_header = recording::header_lines(result.chain);
  recording::add_normalisation(result.normalisation, window, result.chain);
  result.chain.steps.emplace_back("activation dynamics: none in this file");
  result.activation_header = recording::header_lines(result.chain);
  std::vector<std::string> channels;
  for (const recording::ChannelNormalisation& n : result.normalisation) channels.push_back(n.channel);
  for (std::size_t i = 0; i < o.in.size(); ++i) {
    const TimeSeries& envelope = files.stages[i].envelope;
    result.activations.push_back(cut(recording::normalise(envelope, result.normalisation), o.call));
    if (o.keep_envelopes || !o.envelope.empty()) result.envelopes.push_back(cut(envelope.select(channels), o.call));
    for (EmgMeasures& one : measures_of(o.in[i], cut(files.stages[i].filtered, o.call), channels, o.measure_window_s))
      result.measures.push_back(std::move(one));
    files.stages[i] = {};
  }
  result.remarks = remarks.list();
  return result;
}

namespace {

/// Returns the files for results of the inputs: for one input `to` itself, for several a file of each in the folder
/// `to`, none if `to` is empty.
std::vector<std::string> files_of(const std::vector<std::string>& inputs, const std::string& to, const char* option) {
  if (to.empty()) return {};
  if (inputs.size() == 1) return {to};
  std::vector<std::string> files;
  for (const std::string& path : inputs) {
    const std::string name = std::filesystem::path(path).stem().string() + ".sto";
    files.push_back((std::filesystem::path(to) / name).string());
    if (std::ranges::count(files, files.back()) > 1)
      throw InvalidInput(fmt::format(
          "two inputs would be written to {}: rename one of them, or give them to two commands with every --mvc",
          files.back()));
  }
  const std::string ending = std::filesystem::path(to).extension().string();
  if (!ending.empty() && !std::filesystem::is_directory(to))
    throw InvalidInput(fmt::format("{} {}: of {} inputs this is a folder, found a name that ends in '{}'", option, to,
                                   inputs.size(), ending));
  return files;
}

/// Holds the folder of the results of several inputs, whose names the program makes; null for one input.
std::unique_ptr<RecordedFolder> held_folder(const std::vector<std::string>& files) {
  if (files.size() < 2) return nullptr;
  return std::make_unique<RecordedFolder>(std::filesystem::path(files.front()).parent_path(), "emg");
}

void write_emg_files(const std::vector<std::string>& files,
                     const std::vector<TimeSeries>& series,
                     std::string_view title,
                     const std::vector<std::string>& header) {
  const auto held = held_folder(files);
  for (std::size_t i = 0; i < files.size(); ++i)
    recording::write_series(files[i], series[i], std::string(title), header);
  if (held) held->finish();
}

void write_measures(const EmgResult& result, const std::string& path) {
  std::string text = "file,channel,kind,begin_s,end_s,rms_v,median_frequency_hz\n";
  const auto number = [](double value) { return std::isfinite(value) ? format_number(value) : ""; };
  for (const EmgMeasures& one : result.measures) {
    const auto add = [&](const char* kind, const recording::EmgWindow& w) {
      text += fmt::format("{},{},{},{},{},{},{}\n", csv_quoted(one.file), csv_quoted(one.channel), kind,
                          number(w.begin_s), number(w.end_s), number(w.rms), number(w.median_frequency_hz));
    };
    for (const recording::EmgWindow& burst : one.bursts) add("burst", burst);
    for (const recording::EmgWindow& window : one.windows) add("window", window);
  }
  write_file(path, text);
}

}  // namespace

EmgFiles emg_files(const EmgOptions& o) {
  EmgFiles files{files_of(o.in, o.out, "--out"), files_of(o.in, o.envelope, "--envelope"), o.measures};
  const std::vector<std::string> inputs = emg_paths(o), measures(o.measures.empty() ? 0 : 1, o.measures);
  std::vector<std::string> all;
  using Named = std::pair<const char*, const std::vector<std::string>*>;
  for (const auto& [option, named] :
       {Named{"--out", &files.activations}, Named{"--envelope", &files.envelopes}, Named{"--measures", &measures}}) {
    const auto held = held_folder(*named);
    for (const std::string& file : *named) {
      if (std::ranges::find(all, file) != all.end())
        throw InvalidInput(fmt::format("{} and another option both name {}", option, file));
      check_output(file, inputs, o.call.overwrite);
      require_replaceable(file);
    }
    all.insert(all.end(), named->begin(), named->end());
  }
  return files;
}

void write_emg(const EmgResult& result, const EmgFiles& files) {
  write_emg_files(files.activations, result.activations, "Activation", result.activation_header);
  write_emg_files(files.envelopes, result.envelopes, "EMG envelope volt", result.envelope_header);
  if (!files.measures.empty()) write_measures(result, files.measures);
}

}  // namespace myoid::program
