#include "myoid/study/intake/trial_loads.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "myoid/body/dynamics/instrument_load.h"
#include "myoid/body/kinematics/inverse_kinematics.h"
#include "myoid/body/osim/osim_reader.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/core/nearest_word.h"
#include "myoid/ground/files/text_file.h"
#include "myoid/recording/plate_standing.h"
#include "myoid/recording/recording.h"
#include "myoid/recording/signals/filter.h"
#include "myoid/recording/signals/load_cell.h"
#include "myoid/recording/signals/plate_quality.h"
#include "myoid/study/intake/plate_loads.h"
#include "myoid/study/intake/trial_clock.h"
#include "myoid/study/intake/trial_input.h"
#include "myoid/study/study_model.h"
#include "myoid/study/trial_up.h"

namespace myoid::study {
namespace {

/// Reads six rows of six numbers, separated by commas, semicolons, tabs or blanks.
recording::LoadCell::Matrix read_calibration(const std::filesystem::path& path) {
  const std::string text = read_text_file(path);
  const auto lines = split_lines(text);
  recording::LoadCell::Matrix matrix;
  Eigen::Index row = 0;
  for (std::size_t n = 0; n < lines.size(); ++n) {
    if (trim(lines[n]).empty() || trim(lines[n]).starts_with('#')) continue;
    std::string cells(lines[n]);
    std::ranges::replace_if(
        cells, [](char c) { return c == ',' || c == ';'; }, ' ');
    const auto words = split_words(cells);
    if (row == 6 || words.size() != 6) {
      throw ReadError(
          path, n + 1,
          fmt::format("row {} of the calibration matrix has {} numbers; expected 6 rows (Fx, Fy, Fz, Mx, My, Mz) of 6",
                      row + 1, words.size()));
    }
    for (Eigen::Index c = 0; c < 6; ++c) {
      const auto number = parse_number(words[static_cast<std::size_t>(c)]);
      if (!number)
        throw ReadError(path, n + 1, fmt::format("expected a number, found '{}'", words[static_cast<std::size_t>(c)]));
      matrix(row, c) = *number;
    }
    ++row;
  }
  if (row != 6) throw ReadError(path, 0, fmt::format("the calibration matrix has {} rows, expected 6", row));
  return matrix;
}

body::BodyIndex body_of(const body::BodyModel& model, const std::string& name, const std::string& what) {
  if (const auto body = model.find_body(name)) return *body;
  throw InvalidInput(
      fmt::format("[load_cell] {}: there is no body '{}'{}", what, name, not_among(name, body_names(model))));
}

body::ExternalForce read_load_cell(const Study& study,
                                   const TrialSpec& trial,
                                   const body::BodyModel& model,
                                   const std::optional<MarkerSeries>& markers,
                                   const Remember& remember,
                                   std::vector<Remark>& remarks) {
  const LoadCellSpec& spec = *study.load_cell;
  const std::filesystem::path& file = *trial.load_cell;
  remember(file);
  remember(spec.calibration);
  const recording::Recording recorded = recording::read_recording(file);
  add_repairs(file, recorded.repairs, remarks);
  const AnalogChannels& channels = recorded.analog;
  if (channels.empty()) throw ReadError(file, 0, "there are no channels, so no load cell");
  TimeSeries wrench;
  try {
    wrench =
        recording::load_cell_wrench(channels.select(spec.channels), {.channels = spec.channels,
                                                                     .calibration = read_calibration(spec.calibration),
                                                                     .sign = spec.sign,
                                                                     .zero_start_s = spec.zero_s[0],
                                                                     .zero_end_s = spec.zero_s[1]});
  } catch (const ReadError&) {
    throw;
  } catch (const InvalidInput& error) {
    throw ReadError(file, 0, error.what());
  }
  if (const auto clock = loads_clock(study, trial, file)) wrench = recording::on_study_clock(std::move(wrench), *clock);
  const std::optional<double> cutoff = spec.lowpass_hz ? spec.lowpass_hz : motion_cutoff_hz(study);
  if (cutoff && *cutoff < 0.45 * wrench.mean_rate_hz())
    wrench = recording::zero_phase_filter(wrench, math::FilterBand::low_pass, *cutoff);
  const double most = wrench.values().leftCols(3).rowwise().norm().maxCoeff();
  add_notes({fmt::format("{}: load cell, up to {:.3g} N on '{}'", file.filename().string(), most, spec.body)}, remarks);
  const body::BodyIndex body = body_of(model, spec.body, "body");
  if (!spec.instrument) return body::instrument_load(body_of(model, spec.frame, "frame"), wrench, body, "load cell");

  remember(*spec.instrument);
  const body::BodyModel object = body::read_osim(*spec.instrument);
  if (!markers) {
    throw InvalidInput(
        "[load_cell] instrument: its pose comes from markers, and the trial has none; give the trial 'markers', or "
        "leave 'instrument' out where the study's model holds the cell");
  }
  const body::IkResult pose = body::inverse_kinematics(object, *markers);
  add_notes({fmt::format("{}: pose of '{}' with {:.2g} mm rms", spec.instrument->filename().string(), spec.frame,
                         1e3 * pose.errors.column("marker_error_RMS").mean())},
            remarks);
  return body::instrument_load(object, pose.q, body_of(object, spec.frame, "frame"), wrench, body, "load cell");
}

body::ExternalLoads read_plates(const Study& study,
                                const TrialSpec& trial,
                                const body::BodyModel& model,
                                const std::optional<MarkerSeries>& markers,
                                const Remember& remember,
                                std::vector<Remark>& remarks) {
  const PlateSpec& spec = *trial.plates;
  const auto name = spec.file.filename().string();
  if (!trial.markers || *trial.markers != spec.file) remember(spec.file);
  recording::Recording file = recording::read_recording(spec.file);
  recording::LaboratoryUp up;
  try {
    up = recording::stand_plates(file, stated_up(study.markers.up), spec.least_force_n);
  } catch (const InvalidInput& error) {
    throw ReadError(spec.file, 0, error.what());
  }
  add_repairs(spec.file, file.repairs, remarks);
  add_notes({fmt::format("{}: {}", name, up_note(up, model))}, remarks);
  std::vector<recording::ForcePlate> plates = file.force_plates();
  for (const recording::ForcePlate& plate : plates) {
    for (Remark& fault : recording::check_plate_pressure(plate)) {
      fault.where = trial.name;
      fault.says = fmt::format("{}: {}", name, fault.says);
      remarks.push_back(std::move(fault));
    }
  }
  if (const auto clock = loads_clock(study, trial, spec.file)) {
    for (recording::ForcePlate& plate : plates) {
      for (double& t : plate.time_s) t = clock->study_time_s(t);
    }
  }
  try {
    body::ExternalLoads loads =
        plate_loads(plates, rotation_onto(model, up.up_L.value_or(model_up(model))), model, spec.bodies, markers,
                    spec.least_force_n, spec.lowpass_hz ? spec.lowpass_hz : motion_cutoff_hz(study));
    for (const std::string& note : sentences(loads.notes)) add_notes({fmt::format("{}: {}", name, note)}, remarks);
    if (markers && markers->frame_count() > 0 &&
        (markers->time_s[0] < loads.start_s - 0.05 ||
         markers->time_s[markers->frame_count() - 1] > loads.end_s + 0.05)) {
      throw InvalidInput(
          fmt::format("the force plates were recorded from {:.4g} to {:.4g} s, the markers from {:.4g} to {:.4g} s; "
                      "give start_s and end_s",
                      loads.start_s, loads.end_s, markers->time_s[0], markers->time_s[markers->frame_count() - 1]));
    }
    return loads;
  } catch (const InvalidInput& error) {
    throw ReadError(spec.file, 0, error.what());
  }
}

}  // namespace

std::optional<body::ExternalLoads> read_trial_loads(const Study& study,
                                                    const TrialSpec& trial,
                                                    const body::BodyModel& model,
                                                    const std::optional<MarkerSeries>& markers,
                                                    const Remember& remember,
                                                    std::vector<Remark>& remarks) {
  if (!trial.external_loads && !trial.load_cell && !trial.plates) return std::nullopt;
  body::ExternalLoads loads;
  if (trial.external_loads) {
    remember(*trial.external_loads);
    loads = body::read_external_loads(model, *trial.external_loads);
    remarks.insert(remarks.end(), loads.notes.begin(), loads.notes.end());
    if (const auto clock = loads_clock(study, trial, *trial.external_loads))
      loads.set_clock(clock->offset_s, clock->drift_ppm);
    if (study.markers.up != 'y' && study.markers.up != kUpOfTheFile)
      add_notes({fmt::format("{}: taken as y up, as OpenSim has it; only markers are turned",
                             trial.external_loads->filename().string())},
                remarks);
  }
  if (trial.load_cell) loads.forces.push_back(read_load_cell(study, trial, model, markers, remember, remarks));
  if (trial.plates) {
    body::ExternalLoads plates = read_plates(study, trial, model, markers, remember, remarks);
    std::ranges::move(plates.forces, std::back_inserter(loads.forces));
  }
  return loads;
}

}  // namespace myoid::study
