#include "myoid/study/intake/trial_clock.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/nearest_word.h"
#include "myoid/recording/recording.h"
#include "myoid/recording/signals/clock_offset.h"
#include "myoid/recording/signals/clock_sync.h"

namespace myoid::study {
namespace {

using recording::ClockMap;
using recording::Instants;
using recording::Recording;

/// Returns a channel of the recording, or one coordinate of a marker, "WRIST.y".
std::optional<TimeSeries> signal_of(const Recording& file, const std::string& name) {
  if (file.analog.find(name)) return file.analog.select({name});
  const MarkerSeries& markers = file.markers;
  for (Eigen::Index m = 0; m < markers.marker_count(); ++m) {
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      if (name != markers.names[static_cast<std::size_t>(m)] + "." + "xyz"[axis]) continue;
      return TimeSeries(markers.time_s, {{name, Unit::meter}}, markers.positions_m.col(3 * m + axis));
    }
  }
  return std::nullopt;
}

double first_time_s(const Recording& file) {
  return file.markers.frame_count() > 0 ? file.markers.time_s[0] : file.analog.time_s()[0];
}

double interval_s(const Recording& file) {
  const Eigen::VectorXd& t = file.markers.frame_count() > 1 ? file.markers.time_s : file.analog.time_s();
  return t.size() > 1 ? (t[t.size() - 1] - t[0]) / static_cast<double>(t.size() - 1) : 0.0;
}

[[noreturn]] void no_such_signal(const std::filesystem::path& path, const Recording& file, const std::string& name) {
  std::vector<std::string> names;
  for (const Channel& c : file.analog.channels()) names.push_back(c.name);
  for (const Event& e : file.events) {
    if (std::ranges::find(names, e.label) == names.end()) names.push_back(e.label);
  }
  std::string list;
  for (const std::string& n : names) {
    if (list.size() > 300) {
      list += ", ...";
      break;
    }
    list += (list.empty() ? "" : ", ") + n;
  }
  throw ReadError(path, 0,
                  fmt::format("[sync]: there is no channel or event '{}' here; there {}{}", name,
                              list.empty() ? "are none, so give trigger_file, or offset_s" : "are " + list,
                              did_you_mean(name, names)));
}

/// Returns the instants of a trigger: edges of a channel, events of that label, or the start.
Instants instants_of(const std::filesystem::path& path,
                     const Recording& file,
                     const std::string& name,
                     const SyncSpec& spec) {
  if (name == "start") return {{first_time_s(file)}, interval_s(file) / std::sqrt(12.0)};
  if (const auto signal = signal_of(file, name)) {
    const bool falling = spec.match == SyncMatch::falling;
    Instants edges = recording::trigger_edges(*signal, name, falling);
    if (edges.time_s.empty()) {
      throw ReadError(path, 0,
                      fmt::format("[sync]: '{}' has no {} edge; is it the right channel, or match = \"{}\"?", name,
                                  choice_name(spec.match), falling ? "rising" : "falling"));
    }
    return edges;
  }
  Instants events;
  for (const Event& event : file.events) {
    if (event.label == name) events.time_s.push_back(event.time_s);
  }
  if (events.time_s.empty()) no_such_signal(path, file, name);
  std::ranges::sort(events.time_s);
  events.sd_s = interval_s(file) / std::sqrt(12.0);
  return events;
}

TrialClock triggered(const SyncSpec& spec,
                     const std::filesystem::path& emg_file,
                     const std::filesystem::path& motion_file) {
  const Recording emg = recording::read_recording(emg_file);
  const Recording motion = recording::read_recording(motion_file);
  if (emg.analog.empty() && emg.events.empty()) throw ReadError(emg_file, 0, "[sync]: there are no channels or events");
  TrialClock result;
  try {
    if (spec.match == SyncMatch::shape) {
      const auto a = signal_of(emg, spec.emg_trigger);
      const auto b = signal_of(motion, spec.motion_trigger);
      if (!a) no_such_signal(emg_file, emg, spec.emg_trigger);
      if (!b) no_such_signal(motion_file, motion, spec.motion_trigger);
      result.clock = recording::match_shape(*a, *b, spec.search_s);
      result.source = fmt::format("by the shape of '{}' and '{}'", spec.emg_trigger, spec.motion_trigger);
    } else {
      const Instants a = instants_of(emg_file, emg, spec.emg_trigger, spec);
      const Instants b = instants_of(motion_file, motion, spec.motion_trigger, spec);
      result.clock = recording::match_instants(a, b);
      const std::size_t count = std::min(a.time_s.size(), b.time_s.size());
      result.source = fmt::format("by {} instant{} of '{}' and '{}'", count, count == 1 ? "" : "s", spec.emg_trigger,
                                  spec.motion_trigger);
    }
  } catch (const ReadError&) {
    throw;
  } catch (const InvalidInput& error) {
    throw ReadError(emg_file, 0,
                    fmt::format("[sync] '{}' and '{}' of {}: {}", spec.emg_trigger, spec.motion_trigger,
                                motion_file.filename().string(), error.what()));
  }
  return result;
}

TrialClock estimated(const SyncSpec& spec,
                     const std::filesystem::path& emg_file,
                     const TimeSeries& movement,
                     const TimeSeries& envelopes) {
  const ClockMap drift{.drift_ppm = spec.drift_ppm};
  const auto lead = movement.empty() ? std::nullopt
                                     : recording::estimate_clock_offset(recording::on_study_clock(envelopes, drift),
                                                                        movement, spec.search_s);
  if (!lead) {
    throw ReadError(
        emg_file, 0,
        fmt::format("[sync] offset_s = \"estimate\": it cannot be told from EMG and motion within {} s (3 s of quick "
                    "movement with EMG that goes with it are needed); give a number, or triggers",
                    spec.search_s));
  }
  return {.clock = {.offset_s = lead->lead_s - kUsualLead_s,
                    .drift_ppm = spec.drift_ppm,
                    .offset_sd_s = std::hypot(lead->sd_s, kUsualLeadSd_s)},
          .source = fmt::format(
              "estimated: it led the motion by {:.0f} ± {:.0f} ms, where people's EMG leads by {:.0f} ± {:.0f} ms",
              1e3 * lead->lead_s, 1e3 * lead->sd_s, 1e3 * kUsualLead_s, 1e3 * kUsualLeadSd_s)};
}

}  // namespace

const SyncSpec* sync_of(const Study& study, const TrialSpec& trial) {
  if (trial.sync) return &*trial.sync;
  return study.sync ? &*study.sync : nullptr;
}

std::optional<TrialClock> trial_clock(const Study& study,
                                      const TrialSpec& trial,
                                      const TimeSeries& movement,
                                      const std::function<TimeSeries()>& envelopes,
                                      const Remember& remember) {
  const SyncSpec* spec = sync_of(study, trial);
  const auto& motion_file = trial.markers ? trial.markers : trial.motion;
  if (spec == nullptr || !trial.emg || !motion_file || *trial.emg == *motion_file) return std::nullopt;
  if (!spec->emg_trigger.empty()) {
    if (spec->trigger_file) remember(*spec->trigger_file);
    return triggered(*spec, *trial.emg, spec->trigger_file.value_or(*motion_file));
  }
  if (spec->estimate) return estimated(*spec, *trial.emg, movement, envelopes());
  if (!spec->offset_s && spec->drift_ppm == 0.0) return std::nullopt;
  return TrialClock{.clock = {.offset_s = spec->offset_s.value_or(0.0),
                              .drift_ppm = spec->drift_ppm,
                              .offset_sd_s = spec->offset_sd_s},
                    .source = "as the study says"};
}

std::optional<ClockMap> loads_clock(const Study& study, const TrialSpec& trial, const std::filesystem::path& file) {
  const SyncSpec* spec = sync_of(study, trial);
  const auto& motion_file = trial.markers ? trial.markers : trial.motion;
  if (spec == nullptr || (motion_file && *motion_file == file)) return std::nullopt;
  if (spec->loads_offset_s == 0.0 && spec->loads_drift_ppm == 0.0) return std::nullopt;
  return ClockMap{.offset_s = spec->loads_offset_s, .drift_ppm = spec->loads_drift_ppm};
}

}  // namespace myoid::study
