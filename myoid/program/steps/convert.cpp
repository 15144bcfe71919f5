#include "myoid/program/steps/convert.h"

#include <algorithm>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "myoid/body/model/opensim_defects/compat.h"
#include "myoid/body/osim/osim_updater.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/ground/files/byte_source.h"
#include "myoid/ground/files/file_format.h"
#include "myoid/ground/files/output_file.h"
#include "myoid/ground/files/result_record.h"
#include "myoid/ground/files/text_file.h"
#include "myoid/program/steps/check_options.h"
#include "myoid/program/steps/convert_parts.h"
#include "myoid/program/steps/stage_input.h"
#include "myoid/recording/bids_derivative.h"
#include "myoid/recording/c3d/c3d_reader.h"
#include "myoid/recording/c3d/c3d_writer.h"
#include "myoid/recording/c3d/make_c3d.h"
#include "myoid/recording/channel_choice.h"
#include "myoid/recording/channel_writer.h"
#include "myoid/recording/emg_reader.h"
#include "myoid/recording/ground_reaction.h"
#include "myoid/recording/plate_standing.h"
#include "myoid/recording/signals/plate_quality.h"
#include "myoid/recording/signals/resample.h"
#include "myoid/recording/tables/storage_reader.h"
#include "myoid/recording/tables/storage_writer.h"
#include "myoid/recording/tables/text_rows.h"
#include "myoid/recording/trc_writer.h"

namespace myoid::program {
namespace {

namespace fs = std::filesystem;
using ground::FileFormat;

class Converter {
 public:
  Converter(const ConvertOptions& options, Remarks& remarks)
      : o_(options),
        remarks_(remarks),
        R_(rotation_of(options, recording::axis_vector(options.up).value_or(Vec3::UnitY()))) {}

  /// Writes the files and returns their names.
  std::vector<std::string> run() {
    const fs::path out = o_.out;
    const std::string to = extension_of(out);
    const bool folder = to.empty();
    if (!folder && !is_written_ending(to))
      throw InvalidInput(fmt::format("{}: files of kind '{}' are not written; expected {}, or a folder", o_.out, to,
                                     written_endings_text()));
    const auto format = format_of(out);
    if (folder) {
      everything(out);
    } else if (format == FileFormat::c3d) {
      to_c3d(out);
    } else if (format == FileFormat::trc || o_.what == RecordingPart::markers) {
      if (format != FileFormat::trc) throw InvalidInput("markers are written as .trc or .c3d");
      markers(out);
    } else if (o_.what == RecordingPart::plates) {
      recording::Recording file = recording::read_recording(o_.in);
      stand(file);
      plates(out, std::move(file));
    } else {
      channels(out);
    }
    return std::move(written_);
  }

 private:
  void claim(const fs::path& path) const { check_output(path, {o_.in, o_.analog}, o_.call.overwrite); }

  void report(const std::vector<Repair>& repairs) const { report(o_.in, repairs); }
  void report(const std::string& path, const std::vector<Repair>& repairs) const {
    warn_of_repairs(path, repairs, remarks_);
  }

  /// Returns the voltages of a file, in --unit if the file states none.
  [[nodiscard]] TimeSeries voltages(const std::string& path) const {
    recording::EmgFile file =
        recording::read_emg(path, o_.unit, false, path == o_.in ? o_.channels : std::vector<std::string>());
    report(path, file.repairs);
    if (!file.unit_conflict.empty()) remarks_.warn(fmt::format("{}: {}", path, file.unit_conflict));
    return std::move(file.data);
  }

  [[nodiscard]] static bool states_voltage(const std::string& file) {
    return is_storage(file) && recording::stated_voltage(recording::read_storage(file));
  }

  void wrote(const fs::path& path) { written_.push_back(path.string()); }

  void write_markers(const fs::path& out, MarkerSeries markers, std::vector<Repair>& repairs) {
    claim(out);
    without_blanks(markers, repairs);
    recording::write_trc(out, rotated(at_rate(cut(std::move(markers), o_.call)), R_));
    wrote(out);
  }

  void markers(const fs::path& out) {
    recording::MarkerFile file = recording::read_markers(o_.in);
    tell_vertical();
    write_markers(out, std::move(file.markers), file.repairs);
    report(file.repairs);
  }

  /// Writes channels that are in SI.
  void write_read(const fs::path& out, const recording::RowSource& rows) const {
    require_channels(rows.channels);
    recording::write_channels(out, rows, recording::statement_of(rows.channels, o_.in));
  }

  void require_channels(const std::vector<Channel>& channels) const {
    if (channels.empty())
      throw ReadError(o_.in, 0, "every channel has samples that are no numbers; a .csv file holds them");
  }

  void storage_channels(const fs::path& out) {
    recording::Storage file = recording::read_storage(o_.in);
    report(file.repairs);
    const recording::ChannelStatement all = recording::statement_of(file);
    recording::ChannelStatement said{all.title, all.in_degrees, {}};
    const AnalogChannels read = std::move(file.data);
    const bool as_read = stays(read, out);
    const AnalogChannels changed = as_read ? AnalogChannels() : chosen(read, out, o_.in);
    const AnalogChannels& written = as_read ? read : changed;
    require_channels(written.channels());
    for (const Channel& c : written.channels())
      said.units.push_back(all.units[static_cast<std::size_t>(*read.find(c.name))]);
    recording::write_channels(out, recording::rows_of(written), said);
  }

  /// Returns true if all channels are written unchanged, in the compact form of their file.
  [[nodiscard]] bool stays(const AnalogChannels& channels, const fs::path& out) const {
    return o_.channels.empty() && !o_.call.start_s && !o_.call.end_s && !o_.rate_hz &&
           (!is_storage(out.string()) || channels.all_finite());
  }

  /// Selects the channels, the time and the rate that the options name. Neither a storage file nor
  /// a low-pass can hold a gap: channels with gaps are left out, with a warning.
  [[nodiscard]] TimeSeries chosen(const AnalogChannels& channels, const fs::path& out, const std::string& from) const {
    return chosen(std::vector{&channels}, out, from);
  }
  [[nodiscard]] TimeSeries chosen(const std::vector<const AnalogChannels*>& clocks,
                                  const fs::path& out,
                                  const std::string& from) const {
    TimeSeries series = cut(recording::choose_channels(clocks, o_.channels, from), o_.call);
    if (!is_storage(out.string()) && !o_.rate_hz) return series;
    std::vector<Repair> gaps;
    series = recording::without_gaps(series, gaps);
    report(from, gaps);
    return at_rate(series);
  }

  /// Resamples to the even clock of --rate, after a low-pass where the new clock is slower.
  [[nodiscard]] TimeSeries at_rate(const TimeSeries& series) const {
    if (!o_.rate_hz || series.sample_count() < 4) return series;
    return recording::resample(series, new_clock(o_, series.time_s()));
  }
  [[nodiscard]] MarkerSeries at_rate(MarkerSeries markers) const {
    if (!o_.rate_hz || markers.frame_count() < 4) return markers;
    return recording::resample(markers, new_clock(o_, markers.time_s));
  }
  void channels(const fs::path& out) {
    claim(out);
    if (o_.what == RecordingPart::emg || !o_.unit.empty()) {
      write_read(out, recording::rows_of(chosen(voltages(o_.in), out, o_.in)));
    } else if (is_storage(o_.in)) {
      storage_channels(out);
    } else {
      recording::Recording file = recording::read_recording(o_.in);
      report(file.repairs);
      if (file.analog.empty())
        throw ReadError(o_.in, 0, "there are no analog channels to write; markers go to a .trc file");
      if (!file.other_clocks.empty() && o_.channels.empty())
        remarks_.warn(
            fmt::format("{}: {}; a folder as OUT takes all", o_.in, recording::first_clock_alone(other_clocks(file))));
      if (stays(file.analog, out)) {
        write_read(out, recording::rows_of(file.analog));
      } else {
        write_read(out, recording::rows_of(chosen(file.clocks(), out, o_.in)));
      }
    }
    wrote(out);
  }

  /// Turns plates, markers and events to the model's ground, whose y is up: by --up, else by the vertical of the file.
  void stand(recording::Recording& file) {
    try {
      const recording::LaboratoryUp up = recording::stand_plates(file, recording::axis_vector(o_.up), o_.least_force_n);
      if (!up.up_L) return;
      R_ = rotation_of(o_, *up.up_L);
      if (o_.up.empty())
        remarks_.note(fmt::format("note: {}: up is {} ({}); everything is turned to y up", o_.in,
                                  recording::axis_name(*up.up_L), up.because));
    } catch (const InvalidInput& error) {
      throw ReadError(o_.in, 0, error.what());
    }
  }

  /// Without plates only --up turns the recording.
  void tell_vertical() const {
    if (!o_.up.empty() || !o_.turns.empty()) return;
    std::string up;
    try {
      const recording::LaboratoryUp own = recording::read_laboratory_up(o_.in);
      if (own.up_L) up = recording::axis_name(*own.up_L);
    } catch (const ReadError& error) {
      remarks_.warn(error.what());  // the markers stay as they are
    }
    if (!up.empty() && up != "y")
      remarks_.note(
          fmt::format("note: {}: up is {} in this file; the markers are written as recorded; --up {} turns them to y "
                      "up, as models stand",
                      o_.in, up, up));
  }

  void plates(const fs::path& out, recording::Recording file) {
    claim(out);
    if (file.plates.empty()) throw ReadError(o_.in, 0, "there are no force plates that are understood");
    report(file.repairs);
    const std::vector<int> numbers = plate_numbers(o_, file);
    std::vector<Repair> notes;
    const std::vector<recording::ForcePlate> over_time = file.force_plates();
    const TimeSeries loads =
        recording::ground_reaction(over_time, {.R_YG = R_, .least_force_n = o_.least_force_n}, notes);
    report(notes);
    for (const recording::ForcePlate& plate : over_time) {
      for (const Remark& fault : recording::check_plate_pressure(plate)) remarks_.warn(o_.in + ": " + sentence(fault));
    }
    recording::write_storage(out, at_rate(cut(loads, o_.call)), {.title = out.stem().string(), .comments = {}});
    wrote(out);
    if (o_.bodies.empty()) {
      remarks_.note("give --body BODY for each plate to write the ExternalLoads file too (\"\" leaves one out)");
      return;
    }
    const fs::path xml = fs::path(out).replace_extension(".xml");
    check_companion(xml, {o_.in, o_.analog}, o_.call.overwrite,
                    "<?xml version=\"1.0\" encoding=\"UTF-8\" ?>\n<OpenSim");
    write_file(xml, recording::format_external_loads(out.stem().string(), numbers, o_.bodies, out.filename().string()));
    wrote(xml);
  }

  void everything(const fs::path& folder) {
    RecordedFolder held(folder, "convert");
    recording::Recording file = recording::read_recording(o_.in);
    const std::string stem = fs::path(o_.in).stem().string();
    (void)plate_numbers(o_, file);
    if (!file.plates.empty()) {
      stand(file);
    } else if (file.markers.frame_count() > 0) {
      tell_vertical();
    }
    report(file.repairs);
    file.repairs.clear();
    if (file.markers.frame_count() > 0) {
      write_markers(folder / (stem + ".trc"), file.markers, file.repairs);
      report(file.repairs);
      file.repairs.clear();
    }
    if (!file.analog.empty()) write_all_channels(folder, stem, file);
    if (!file.plates.empty()) plates(folder / (stem + "_grf.mot"), std::move(file));
    held.finish();
    for (std::string& note : held.take_notes()) remarks_.note(std::move(note));
  }

  /// Writes all channels, and a second file of the voltages that may be EMG.
  void write_all_channels(const fs::path& folder, const std::string& stem, const recording::Recording& file) {
    const auto write = [&](const fs::path& out, const recording::RowSource& rows) {
      if (rows.channels.empty()) return;
      claim(out);
      write_read(out, rows);
      wrote(out);
    };
    const fs::path all = folder / (stem + "_analog.sto");
    const bool as_read = stays(file.analog, all);
    const AnalogChannels changed = as_read ? AnalogChannels() : chosen(file.clocks(), all, o_.in);
    const AnalogChannels& series = as_read ? file.analog : changed;
    write(all, recording::rows_of(series));
    if (o_.channels.empty()) {
      for (const AnalogChannels& other : file.other_clocks) {
        const double rate_hz = other.series().mean_rate_hz();
        const fs::path name = folder / fmt::format("{}_analog_{:.0f}Hz.sto", stem, rate_hz);
        const TimeSeries own = chosen(other, name, o_.in);
        write(name, recording::rows_of(own));
      }
    }
    std::vector<std::string> volts = recording::emg_channels(file.analog.channels(), file.plates);
    if (!o_.channels.empty() || volts.size() == file.analog.channels().size()) return;
    std::erase_if(volts, [&](const std::string& name) { return !series.find(name); });
    write(folder / (stem + "_emg.sto"), recording::rows_of(series, volts));
  }

  void to_c3d(const fs::path& out) {
    claim(out);
    if (format_of(o_.in) == FileFormat::c3d) {
      if (!R_.isIdentity(0.0) || o_.call.start_s || o_.call.end_s || o_.rate_hz)
        throw InvalidInput("a C3D file is rewritten as it is; convert it to .trc to turn, cut or resample it");
      recording::C3dFile file = recording::read_c3d(o_.in);
      report(file.repairs);
      recording::write_c3d(out, file);
      wrote(out);
      return;
    }
    recording::Recording file = recording::read_recording(o_.in);
    report(file.repairs);
    AnalogChannels analog = std::move(file.analog);
    if (states_voltage(o_.in)) analog = voltages(o_.in);
    if (!o_.analog.empty()) {
      if (o_.unit.empty() && !states_voltage(o_.analog)) {
        recording::Recording other = recording::read_recording(o_.analog);
        report(o_.analog, other.repairs);
        analog = std::move(other.analog);
      } else {
        analog = voltages(o_.analog);
      }
    }
    MarkerSeries markers = file.markers;
    if (markers.frame_count() > 0) markers = rotated(at_rate(cut(std::move(markers), o_.call)), R_);
    const std::string& channels_from = o_.analog.empty() ? o_.in : o_.analog;
    recording::write_c3d(
        out, recording::make_c3d(markers, analog.empty() ? TimeSeries() : chosen(analog, out, channels_from)));
    wrote(out);
  }

  const ConvertOptions& o_;
  Remarks& remarks_;
  Mat3 R_;
  std::vector<std::string> written_;
};

/// Returns the options with the kind of content that the endings of the names imply.
ConvertOptions with_kind(ConvertOptions o) {
  if (!o.what && extension_of(o.out) == ".mot" && format_of(o.in) == FileFormat::c3d) o.what = RecordingPart::plates;
  return o;
}

bool is_opensim(std::optional<FileFormat> format) {
  return format == FileFormat::model || format == FileFormat::set_up;
}

/// Returns true if the first character of the file, apart from blanks, is that of a markup.
bool is_markup(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored) && trim(read_bytes(path)).starts_with('<');
}

/// Writes an OpenSim file of any version in the newest form.
void write_updated(const ConvertOptions& o, ConvertResult& result, Remarks& remarks) {
  check_output(o.out, {o.in}, o.call.overwrite);
  const body::UpdatedOsim updated =
      body::updated_osim(read_text_file(o.in), o.in, {.six_digits = body::compat_of(o.compat).six_digit_offsets});
  for (const Remark& note : updated.notes) remarks.add(note);
  write_file(o.out, updated.text);
  result.files = {o.out};
  result.old_version = updated.old_version;
  result.version = std::max(updated.old_version, body::kNewestOsimVersion);
}

}  // namespace

void visit(ConvertOptions& o, study::SettingVisitor& v) {
  static const std::string kInputs = endings_text([](const FormatEntry& entry) { return is_recording(entry.format); }) +
                                     ", .osim, .xml, or the folder of a finished run";
  constexpr std::string_view kLaboratory = "Laboratory";
  v.path("in", o.in, {.says = kInputs, .required = "a file", .option = {.keyword = "source", .by_place = true}});
  v.path("out", o.out,
         {.says = ".c3d, .trc, .sto, .mot, .csv, or a folder for everything in it; .osim, .xml of an OpenSim file; "
                  ".mat of a storage file or of the folder of a run.",
          .required = "a file",
          .option = {.by_place = true}});
  v.choice("what", o.what,
           {.says = "emg: voltages only.", .otherwise = "markers for .trc, plates for .mot from .c3d, else channels"});
  visit_up(o.up, v,
           {.says = "Vertical axis of the laboratory, turned to y.",
            .otherwise = "with force plates as the file says, else nothing is turned",
            .option = {.group = kLaboratory}});
  v.texts("rotate", o.turns,
          {.says = "AXIS:DEGREES, repeated: further turns, one after another.", .option = {.group = kLaboratory}});
  v.texts("body", o.bodies,
          {.says = "Body of the model that stands on plate 1, 2, ...: writes ExternalLoads too.",
           .option = {.group = kLaboratory}});
  v.number("least-force", o.least_force_n,
           {.says = "Below it a plate counts as unloaded.",
            .limits = study::above_zero("N"),
            .option = {.group = kLaboratory}});
  v.text("unit", o.unit, {.says = "Unit of EMG where the file does not say: V, mV, uV."});
  v.texts("channel", o.channels, {.says = "Only this channel, repeated."});
  v.path("analog", o.analog, {.says = "Channels to go with the markers of a .trc into a .c3d."});
  v.number("rate", o.rate_hz,
           {.says = "Put everything on an even clock of this rate; low-passed first where that is slower (0 dB to 0.4 "
                    "of it, -100 dB from half of it on).",
            .limits = study::above_zero("Hz"),
            .otherwise = "as recorded"});
  v.text("subject", o.subject,
         {.says = "Label of the person where IN is a folder of results, written as a BIDS derivative."});
  v.choice("compat", o.compat,
           {.says = "Of an OpenSim file: exact keeps the digits of the offsets of joints and inertias; opensim rounds "
                    "them to six, as OpenSim converts them."});
}

Conversion conversion_of(const ConvertOptions& o) {
  const auto from = format_of(o.in), to = format_of(o.out);
  const bool to_recording = to && is_recording(*to);
  std::error_code ignored;
  if (fs::is_directory(o.in, ignored)) {
    if (to_recording || is_opensim(to))
      throw InvalidInput(
          fmt::format("{} is a folder; the results in it are written as a BIDS derivative, which is a folder too: give "
                      "one as OUT instead of {}",
                      o.in, o.out));
    return Conversion::derivative;
  }
  if (!is_opensim(from) && !is_opensim(to) && (from || !is_markup(o.in))) return Conversion::recording;
  if (to_recording)
    throw InvalidInput(fmt::format("{}: an OpenSim file is written as .osim or .xml; found the name of {}", o.out,
                                   format_entry(*to).kind));
  return Conversion::opensim_file;
}

ConvertResult convert(const ConvertOptions& options) {
  check_options(options);
  Remarks remarks(options.call);
  const ConvertOptions o = with_kind(options);
  ConvertResult result;
  switch (conversion_of(o)) {
    case Conversion::recording:
      result.files = Converter(o, remarks).run();
      break;
    case Conversion::derivative:
      for (const fs::path& file : recording::write_bids_derivative(o.in, o.out, o.subject))
        result.files.push_back(file.string());
      break;
    case Conversion::opensim_file:
      write_updated(o, result, remarks);
      break;
  }
  result.remarks = remarks.list();
  return result;
}

}  // namespace myoid::program
