#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "myoid/cli/context.h"
#include "myoid/cli/model_page.h"
#include "myoid/cli/stage_input.h"
#include "myoid/core/error.h"
#include "myoid/model/arm4.h"
#include "myoid/model/osim_reader.h"
#include "myoid/model/path_survey.h"
#include "myoid/pipeline/study.h"
#include "myoid/recording/c3d_signals.h"
#include "myoid/recording/c3d_survey.h"
#include "myoid/recording/csv_reader.h"
#include "myoid/recording/emg_reader.h"
#include "myoid/recording/recording.h"
#include "myoid/recording/storage_reader.h"
#include "myoid/recording/trc_reader.h"

namespace myoid::cli {
namespace {

using nlohmann::ordered_json;

ordered_json repairs_json(const std::vector<recording::Repair>& repairs) {
  ordered_json list = ordered_json::array();
  for (const recording::Repair& r : repairs) list.push_back(recording::to_string(r));
  return list;
}

ordered_json series_json(const TimeSeries& series) {
  ordered_json j;
  j["samples"] = series.sample_count();
  j["start_s"] = series.time_s()[0];
  j["duration_s"] = series.time_s()[series.sample_count() - 1] - series.time_s()[0];
  j["rate_hz"] = series.mean_rate_hz();
  j["evenly_sampled"] = series.is_uniform();
  j["channels"] = ordered_json::array();
  for (std::size_t c = 0; c < series.channels().size(); ++c) {
    const Eigen::VectorXd x = series.values().col(static_cast<Eigen::Index>(c));
    double low = INFINITY;
    double high = -INFINITY;
    int gaps = 0;
    for (const double v : x) {
      if (std::isfinite(v)) {
        low = std::min(low, v);
        high = std::max(high, v);
      } else {
        ++gaps;
      }
    }
    ordered_json channel{{"name", series.channels()[c].name}};
    if (series.channels()[c].unit != Unit::dimensionless)
      channel["unit"] = std::string(symbol(series.channels()[c].unit));
    if (low <= high) {
      channel["lowest"] = low;
      channel["highest"] = high;
    }
    if (gaps > 0) channel["gaps"] = gaps;
    j["channels"].push_back(channel);
  }
  return j;
}

ordered_json trc_json(const std::filesystem::path& path) {
  const recording::TrcFile file = recording::read_trc(path);
  ordered_json j{
      {"kind", "markers (.trc)"}, {"unit", file.unit}, {"frames", file.markers.frame_count()}};
  const auto& t = file.markers.time_s;
  j["start_s"] = t[0];
  j["duration_s"] = t[t.size() - 1] - t[0];
  j["rate_hz"] = t.size() > 1 ? static_cast<double>(t.size() - 1) / (t[t.size() - 1] - t[0]) : 0.0;
  j["markers"] = ordered_json::array();
  for (Eigen::Index m = 0; m < file.markers.marker_count(); ++m) {
    Eigen::Index missing = 0;
    for (Eigen::Index f = 0; f < file.markers.frame_count(); ++f)
      missing += file.markers.missing(f, m) ? 1 : 0;
    ordered_json marker{{"name", file.markers.names[static_cast<std::size_t>(m)]}};
    if (missing > 0) marker["missing_frames"] = missing;
    j["markers"].push_back(marker);
  }
  j["repairs"] = repairs_json(file.repairs);
  return j;
}

ordered_json events_json(const std::vector<recording::C3dEvent>& events) {
  ordered_json list = ordered_json::array();
  for (const recording::C3dEvent& e : events) {
    ordered_json j{{"name", e.label.empty() ? "event" : e.label}, {"time_s", e.time_s}};
    if (!e.context.empty()) j["context"] = e.context;
    list.push_back(j);
  }
  return list;
}

/// Everything a C3D file says, with the numbers of its channels in the unit as written.
ordered_json c3d_json(const std::filesystem::path& path) {
  const recording::C3dSurvey survey = recording::survey_c3d(path);
  const recording::C3dFile& file = survey.file;
  const Eigen::Index frames = survey.frames;
  ordered_json j{{"kind", "C3D"},
                 {"processor", file.processor == recording::C3dProcessor::intel ? "Intel"
                               : file.processor == recording::C3dProcessor::dec ? "DEC"
                                                                                : "SGI"},
                 {"samples", file.integer ? "16-bit integers" : "32-bit reals"},
                 {"frames", frames},
                 {"first_frame", file.first_frame},
                 {"start_s", file.start_s()},
                 {"duration_s", static_cast<double>(frames - 1) / file.point_rate_hz},
                 {"rate_hz", file.point_rate_hz}};
  if (!file.point_labels.empty()) j["point_unit"] = file.point_unit;
  const auto columns = recording::marker_columns(file);
  j["markers"] = ordered_json::array();
  std::vector<bool> is_marker(file.point_labels.size(), false);
  for (const Eigen::Index c : columns) {
    is_marker[static_cast<std::size_t>(c)] = true;
    const Eigen::Index missing = survey.missing_frames[static_cast<std::size_t>(c)];
    ordered_json marker{{"name", file.point_labels[static_cast<std::size_t>(c)]}};
    if (missing > 0) marker["missing_frames"] = missing;
    j["markers"].push_back(marker);
  }
  j["other_points"] = ordered_json::array();
  for (std::size_t c = 0; c < is_marker.size(); ++c)
    if (!is_marker[c]) j["other_points"].push_back(file.point_labels[c]);
  if (!file.channels.empty()) j["analog_rate_hz"] = file.analog_rate_hz();
  j["channels"] = ordered_json::array();
  for (std::size_t c = 0; c < file.channels.size(); ++c) {
    ordered_json entry{{"name", file.channels[c].name}};
    if (!file.channels[c].unit_text.empty()) entry["unit"] = file.channels[c].unit_text;
    entry["lowest"] = survey.lowest[static_cast<Eigen::Index>(c)];
    entry["highest"] = survey.highest[static_cast<Eigen::Index>(c)];
    j["channels"].push_back(entry);
  }
  j["force_plates"] = ordered_json::array();
  for (std::size_t p = 0; p < survey.plates.size(); ++p) {
    j["force_plates"].push_back({{"name", fmt::format("plate {}", survey.plates[p].number)},
                                 {"type", survey.plates[p].type},
                                 {"largest_force_n", survey.largest_force_n[p]}});
  }
  j["events"] = events_json(file.events);
  j["repairs"] = repairs_json(survey.repairs);
  return j;
}

/// EDF, BDF, ANC: channels in SI.
ordered_json recording_json(const std::filesystem::path& path, const char* kind) {
  const recording::Recording file = recording::read_recording(path);
  ordered_json j{{"kind", kind}};
  j.update(series_json(file.analog.series()));
  j["events"] = events_json(file.events);
  j["repairs"] = repairs_json(file.repairs);
  return j;
}

ordered_json storage_json(const std::filesystem::path& path) {
  const recording::Storage file = recording::read_storage(path);
  ordered_json j{{"kind", "storage (.mot, .sto)"}, {"title", file.title}};
  // An EMG file has no angles; one that does not speak of them may have none either.
  if (const auto to_volt = recording::stated_voltage(file)) {
    j["emg_unit"] = recording::voltage_name(*to_volt) + ", as the header says";
  } else if (std::any_of(file.header.begin(), file.header.end(), [](const auto& entry) {
               return recording::equal_ignoring_case(entry.first, "inDegrees");
             })) {
    j["angles"] = file.in_degrees ? "degrees" : "radians";
  } else if (file.in_degrees) {
    j["angles"] = "degrees (the header does not say; files of this kind are)";
  }
  j.update(series_json(file.data));
  j["repairs"] = repairs_json(file.repairs);
  return j;
}

ordered_json csv_json(const std::filesystem::path& path) {
  try {
    return recording_json(path, "time series (.csv)");
  } catch (const ReadError& error) {
    const recording::CsvTable table = recording::read_csv_table(path);
    return {{"kind", "table (.csv)"},
            {"rows", table.rows.size()},
            {"columns", table.names},
            {"no_recording", error.what()}};
  }
}

/// What `info` is asked to say of a model beside its contents.
struct ModelQuestions {
  bool compare_compat = false;
  bool jumps = false;
  int postures = 1000;
};

/// Muscles whose exact paths differ from OpenSim's, and by how much.
ordered_json differences_json(const model::BodyModel& m, int postures, std::uint64_t seed) {
  ordered_json list = ordered_json::array();
  for (const model::PathDifference& d : model::compare_with_opensim(m, postures, seed)) {
    list.push_back(fmt::format(
        "{}: length by up to {:.3g} mm (rms {:.3g} mm, above 1 mm in {} of {} postures), moment "
        "arm "
        "by up to {:.3g} mm",
        m.muscles[static_cast<std::size_t>(d.muscle)].name, 1e3 * d.length_m,
        1e3 * d.typical_length_m, d.postures_above_1mm, postures, 1e3 * d.moment_arm_m));
  }
  return list;
}

ordered_json jumps_json(const model::BodyModel& m) {
  ordered_json list = ordered_json::array();
  for (const model::PathJump& jump : model::find_jumps(m)) list.push_back(model::describe(m, jump));
  return list;
}

/// An .osim file, or the name of the built-in arm.
bool is_model(const std::filesystem::path& path) {
  return recording::extension_of(path) == ".osim" ||
         (path == "arm4" && !std::filesystem::exists(path));
}

/// What a coordinate's values in files are in. One that turns a body by another law than its own
/// angle, or follows an angle, is in radians there, whatever OpenSim calls its motion.
std::string unit_of(const model::BodyModel& m, int index) {
  const model::Coordinate& c = m.coordinates[static_cast<std::size_t>(index)];
  if (c.motion == model::MotionType::rotational) return "deg";
  for (const model::TransformAxis& axis : m.joints[static_cast<std::size_t>(c.joint)].rotation)
    if (axis.coordinate == index) return "rad";
  for (const model::CoordinateCoupler& coupler : m.couplers) {
    const auto leader = static_cast<std::size_t>(coupler.independent);
    if (coupler.dependent == index && m.coordinates[leader].motion == model::MotionType::rotational)
      return "rad";
  }
  return c.motion == model::MotionType::translational ? "m" : "coupled";
}

ordered_json osim_json(const std::filesystem::path& path,
                       const ModelQuestions& ask,
                       const Context& context) {
  const model::OsimOptions options{.compat = model::parse_compat(context.compat)};
  const model::BodyModel m = path == "arm4"
                                 ? model::parse_osim(model::arm4_osim(), "arm4.osim", options)
                                 : model::read_osim(path, options);
  ordered_json j{{"kind", "OpenSim model"}, {"name", m.name}};
  double mass = 0.0;
  for (std::size_t b = 1; b < m.bodies.size(); ++b) {
    mass += m.bodies[b].mass_kg;
    j["bodies"].push_back(fmt::format("{} ({:.4g} kg)", m.bodies[b].name, m.bodies[b].mass_kg));
  }
  j["mass_kg"] = mass;
  j["gravity_mps2"] = {m.gravity_G.x(), m.gravity_G.y(), m.gravity_G.z()};
  for (const model::Joint& joint : m.joints) {
    j["joints"].push_back(fmt::format("{} ({}): {} -> {}", joint.name, joint.class_name,
                                      m.bodies[static_cast<std::size_t>(joint.parent)].name,
                                      m.bodies[static_cast<std::size_t>(joint.child)].name));
  }
  for (std::size_t k = 0; k < m.coordinates.size(); ++k) {
    const model::Coordinate& c = m.coordinates[k];
    const bool angle = c.motion == model::MotionType::rotational;
    const double scale = angle ? 1.0 / kDegree : 1.0;
    j["coordinates"].push_back(fmt::format("{} [{}] {:.4g} to {:.4g}{}", c.name,
                                           unit_of(m, static_cast<int>(k)), c.lower * scale,
                                           c.upper * scale, c.locked ? ", locked" : ""));
  }
  j["muscles"] = ordered_json::array();
  for (const model::Muscle& muscle : m.muscles) {
    j["muscles"].push_back(fmt::format(
        "{} ({}): F_max {:.4g} N, l0 {:.4g} m, tendon {:.4g} m, {} points, {} wraps", muscle.name,
        muscle.class_name, muscle.properties.max_isometric_force_n,
        muscle.properties.optimal_fiber_length_m, muscle.properties.tendon_slack_length_m,
        muscle.path.points.size(), muscle.path.wraps.size()));
  }
  for (const model::Marker& marker : m.markers) j["markers"].push_back(marker.name);
  j["document_version"] = m.document_version;
  for (const model::CoordinateCoupler& c : m.couplers) {
    j["couplers"].push_back(fmt::format(
        "{}: {} follows {}", c.name, m.coordinates[static_cast<std::size_t>(c.dependent)].name,
        m.coordinates[static_cast<std::size_t>(c.independent)].name));
  }
  for (const model::LoopConstraint& c : m.constraints)
    j["constraints"].push_back(fmt::format("{} ({})", c.name, c.class_name));
  for (const model::CoordinateActuator& a : m.actuators) j["actuators"].push_back(a.name);
  for (const model::PointActuator& a : m.point_actuators) j["actuators"].push_back(a.name);
  for (const model::TorqueActuator& a : m.torque_actuators) j["actuators"].push_back(a.name);
  for (const model::PathActuator& a : m.path_actuators) j["actuators"].push_back(a.name);
  for (const model::PassiveForce& f : m.passive_forces)
    j["passive_forces"].push_back(fmt::format("{} ({})", f.name, f.class_name));
  if (ask.compare_compat)
    j["differs_from_opensim"] = differences_json(m, ask.postures, context.seed);
  if (ask.jumps) j["jumps"] = jumps_json(m);
  j["not_supported_count"] = m.unsupported.size();
  j["not_supported"] = m.unsupported;
  j["notes"] = m.notes;
  return j;
}

ordered_json study_file_json(const std::filesystem::path& path) {
  const pipeline::Study study = pipeline::read_study(path);
  ordered_json j{{"kind", "study"},
                 {"subject", study.subject.name},
                 {"coordinate", study.model.coordinate},
                 {"methods", study.identify.methods}};
  for (const auto& m : study.muscles)
    j["muscles"].push_back(fmt::format("{} <- EMG {}", m.name, m.emg));
  for (const auto& t : study.trials)
    j["trials"].push_back(fmt::format("{} ({})", t.name, name(t.use)));
  return j;
}

ordered_json file_json(const std::filesystem::path& path,
                       const ModelQuestions& ask,
                       const Context& context) {
  const std::string extension = recording::extension_of(path);
  if (extension == ".trc") return trc_json(path);
  if (extension == ".mot" || extension == ".sto") return storage_json(path);
  if (extension == ".csv" || extension == ".tsv" || extension == ".txt" || extension == ".emt")
    return csv_json(path);
  if (extension == ".c3d") return c3d_json(path);
  if (extension == ".edf" || extension == ".bdf") return recording_json(path, "EMG (.edf, .bdf)");
  if (extension == ".anc") return recording_json(path, "analog channels (.anc)");
  if (is_model(path)) return osim_json(path, ask, context);
  if (extension == ".toml") return study_file_json(path);
  (void)recording::read_text_file(path);  // a missing or empty file is told as such
  throw ReadError(
      path, 0,
      fmt::format(
          "files of kind '{}' are not known; known are .c3d, .trc, .mot, .sto, .csv, .tsv, .txt, "
          ".edf, .bdf, .anc, .osim and .toml",
          extension));
}

void print(const ordered_json& j, int indent) {
  const std::string space(static_cast<std::size_t>(indent), ' ');
  for (const auto& [key, value] : j.items()) {
    std::string label = key;
    std::replace(label.begin(), label.end(), '_', ' ');
    if (value.is_array()) {
      if (value.empty()) continue;
      const bool vector = value[0].is_number();
      if (vector) {
        fmt::print("{}{}: {}\n", space, label, value.dump());
        continue;
      }
      fmt::print("{}{} ({}):\n", space, label, value.size());
      for (const auto& item : value) {
        if (item.is_string()) {
          fmt::print("{}  {}\n", space, item.get<std::string>());
        } else {
          std::string line;
          for (const auto& [k, v] : item.items()) {
            line += line.empty() ? "" : k == "unit" ? " [" : "  ";
            line += k == "name" ? v.get<std::string>()
                    : k == "unit"
                        ? v.get<std::string>() + "]"
                        : fmt::format("{} {}", k,
                                      v.is_number_float() ? fmt::format("{:.5g}", v.get<double>())
                                                          : v.dump());
          }
          fmt::print("{}  {}\n", space, line);
        }
      }
    } else {
      fmt::print("{}{}: {}\n", space, label,
                 value.is_string()         ? value.get<std::string>()
                 : value.is_number_float() ? fmt::format("{:.6g}", value.get<double>())
                                           : value.dump());
    }
  }
}

}  // namespace

void add_info(CLI::App& app, Context& context) {
  CLI::App& command =
      *app.add_subcommand("info",
                          "Says what a file holds: channels, units, rates, duration, gaps, "
                          "repairs; of a model also what is not supported.\n"
                          "Example: myoid info arm.osim flex.trc");
  const auto files = std::make_shared<std::vector<std::string>>();
  const auto ask = std::make_shared<ModelQuestions>();
  const auto page = std::make_shared<ModelPageOptions>();
  command.add_flag("--compare-compat", ask->compare_compat,
                   "Of a model: for which muscles exact paths differ from OpenSim 4.5.2's, and by "
                   "how much, over random postures");
  command.add_option("--postures", ask->postures, "Random postures for --compare-compat")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  command.add_flag("--jumps", ask->jumps,
                   "Of a model: where a muscle's length or moment arm jumps over the range of a "
                   "coordinate");
  add_model_page_options(command, *page);
  add_compat_option(command, context);
  command
      .add_option("files", *files,
                  ".c3d, .trc, .mot, .sto, .csv, .edf, .bdf, .anc, .osim or study.toml; or arm4")
      ->required();
  add_common_options(command, context);
  command.callback([&context, files, ask, page] {
    if (!page->html.empty()) {
      if (files->size() != 1 || !is_model(files->front()))
        throw InvalidInput("--html shows one model: give one .osim, or arm4");
      const std::string done = write_model_page(files->front(), *page, context);
      if (context.json) {
        fmt::print("{}\n", ordered_json{{"html", page->html}}.dump(2));
      } else {
        fmt::print("{}\n", done);
      }
      return;
    }
    if (context.start_s || context.end_s)
      context.warn("--start and --end have no effect without --html");
    ordered_json all = ordered_json::array();
    for (const std::string& file : *files) {
      ordered_json j{{"file", file}};
      j.update(file_json(file, *ask, context));
      if (!context.json) {
        print(j, 0);
        if (files->size() > 1) fmt::print("\n");
      }
      all.push_back(std::move(j));
    }
    if (context.json) fmt::print("{}\n", all.dump(2));
  });
}

}  // namespace myoid::cli
