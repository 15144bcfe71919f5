#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/body/kinematics/angular_speeds.h"
#include "myoid/body/kinematics/motion_plausibility.h"
#include "myoid/body/model/model_plausibility.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/core/names.h"
#include "myoid/ground/core/nearest_word.h"
#include "myoid/ground/math/spline.h"
#include "myoid/opensim/analysis_reports.h"
#include "myoid/opensim/opensim_files.h"
#include "myoid/opensim/tool_stages.h"
#include "myoid/recording/signals/opensim_lowpass.h"

namespace myoid::opensim {
namespace {

using body::OsimXml;

struct KnownAnalysis {
  std::string_view class_name;
  void (*run)(AnalysisRun&, pugi::xml_node);
};

constexpr KnownAnalysis kKnown[] = {
    {"Actuation", report_actuation},     {"BodyKinematics", report_bodies},
    {"ForceReporter", report_forces},    {"InverseDynamics", report_inverse_dynamics},
    {"JointReaction", report_reactions}, {"Kinematics", report_kinematics},
    {"MuscleAnalysis", report_muscles},  {"OutputReporter", report_outputs},
    {"PointKinematics", report_point},   {"StaticOptimization", run_static_optimization}};

void run_analysis(AnalysisRun& run, pugi::xml_node node) {
  std::ranges::find(kKnown, std::string_view(node.name()), &KnownAnalysis::class_name)->run(run, node);
  run.result.frames = static_cast<int>(run.motion.sample_count());
}

/// Derivatives of every channel at its samples, by the natural quintic spline.
TimeSeries derivative(const TimeSeries& series, const std::vector<Channel>& channels) {
  Eigen::MatrixXd values(series.sample_count(), series.channel_count());
  // Fewer samples than a spline needs are postures at rest.
  if (series.sample_count() < 4)
    return {series.time_s(), channels, Eigen::MatrixXd::Zero(values.rows(), values.cols())};
  const math::SplineKnots knots(series.time_s());
  for (Eigen::Index c = 0; c < values.cols(); ++c)
    values.col(c) = knots.interpolate(series.values().col(c)).evaluate(series.time_s()).first;
  return {series.time_s(), channels, std::move(values)};
}

std::vector<Channel> channels_of(const body::BodyModel& model, int order) {
  std::vector<Channel> channels;
  for (const body::Coordinate& c : model.coordinates) channels.push_back({c.name, body::coordinate_unit(c, order)});
  return channels;
}

/// Forms positions, speeds and accelerations as OpenSim does: given speeds, or derivatives of the spline through the
/// positions; accelerations are derivatives of the spline through the speeds, or zero if no analysis uses them.
/// Locked and prescribed coordinates have the model's values.
body::JointMotion motion_of(AnalysisRun& run, TimeSeries q, std::optional<TimeSeries> speeds, bool with_accelerations) {
  const body::BodyModel& model = run.model;
  TimeSeries u = speeds ? std::move(*speeds) : derivative(q, channels_of(model, 1));
  TimeSeries udot = with_accelerations ? derivative(u, channels_of(model, 2))
                                       : TimeSeries(u.time_s(), channels_of(model, 2),
                                                    Eigen::MatrixXd::Zero(u.sample_count(), u.channel_count()));
  run.add_notes(body::held_notes(model, q, body::HeldValues::of_model));
  const bool as_opensim = model.compat == body::kOpenSim452;
  return body::with_held_values(model, {std::move(q), std::move(u), std::move(udot)}, !as_opensim);
}

/// Reads the motion. The range is compared with the times of the file, for a filter adds times at both ends.
body::JointMotion read_motion(AnalysisRun& run, std::pair<double, double> range_s, bool with_accelerations) {
  const OpensimSetup& setup = run.setup;
  const auto tool = setup.tool();
  std::vector<Remark>& remarks = run.result.remarks;
  if (const auto states = setup.file(tool, "states_file")) {
    for (const char* other : {"coordinates_file", "speeds_file"}) {
      if (setup.names_file(tool, other)) run.note("<{}> is not read: there is a <states_file>", other);
    }
    TimeSeries q = read_coordinates(run.model, *states, MissingCoordinate::default_value, remarks);
    setup.check_range(range_s, q.time_s(), *states, remarks);
    run.add_remarks(body::implausible_motion(q), states->string());
    read_muscle_states(run, *states);
    return motion_of(run, std::move(q), read_speeds(run.model, *states, false, remarks), with_accelerations);
  }
  const auto path = setup.file(tool, "coordinates_file");
  if (!path) {
    setup.xml().fail(tool, "expected a <states_file> or a <coordinates_file>: the motion to analyze");
  }
  TimeSeries q = read_coordinates(run.model, *path, MissingCoordinate::zero, remarks);
  setup.check_range(range_s, q.time_s(), *path, remarks);
  run.add_remarks(body::implausible_motion(q), path->string());
  const double cutoff_hz = setup.xml().number(tool, "lowpass_cutoff_frequency_for_coordinates", -1.0);
  if (cutoff_hz > 0.0) q = recording::opensim_lowpass(q, cutoff_hz);
  std::optional<TimeSeries> speeds;
  if (const auto file = setup.file(tool, "speeds_file")) {
    speeds = read_speeds(run.model, *file, true, remarks);
    if (!speeds) {
      throw InvalidInput(fmt::format("{}: no column is the speed of a coordinate", file->string()));
    }
    if (speeds->time_s() != q.time_s()) {
      throw InvalidInput(
          fmt::format("{}: its times differ from the coordinates' times ({} and {} rows); use "
                      "<lowpass_cutoff_frequency_for_coordinates> -1 with speeds of the same rows",
                      file->string(), speeds->sample_count(), q.sample_count()));
    }
  }
  return motion_of(run, std::move(q), std::move(speeds), with_accelerations);
}

/// Returns the rows that an analysis records: the first, every row whose number the interval divides, the last.
std::vector<Eigen::Index> recorded_rows(Eigen::Index first, Eigen::Index last, int interval) {
  std::vector<Eigen::Index> rows;
  for (Eigen::Index i = first; i <= last; ++i) {
    if (i == first || i == last || i % std::max(1, interval) == 0) rows.push_back(i);
  }
  return rows;
}

void read_loads(AnalysisRun& run) {
  const auto file = run.setup.file(run.setup.tool(), "external_loads_file");
  if (!file) return;
  run.loads = body::read_external_loads(run.model, *file);
  run.add_notes(run.loads->notes);
}

/// Says that an analysis is not run: OpenSim's own, a misspelt one, or one of a plug-in.
std::string not_run(pugi::xml_node node) {
  static const std::vector<std::string> kOfOpensim{
      "Actuation",       "BodyKinematics",  "ForceReporter", "IMUDataReporter",   "InducedAccelerations",
      "InverseDynamics", "JointReaction",   "Kinematics",    "MomentArmAnalysis", "MuscleAnalysis",
      "OutputReporter",  "PointKinematics", "ProbeReporter", "StatesReporter",    "StaticOptimization"};
  const std::string kind = node.name();
  const bool is_own = std::find(kOfOpensim.begin(), kOfOpensim.end(), kind) != kOfOpensim.end();
  const auto near = is_own ? std::nullopt : nearest_word(kind, kOfOpensim);
  return fmt::format("analysis {}{} is not run, and its files are not written; {} are run", kind,
                     is_own ? std::string()
                     : near ? fmt::format(" is none of OpenSim's (did you mean {}?); it", *near)
                            : std::string(" is none of OpenSim's (is it a plug-in's?); it"),
                     name_list(kKnown, &KnownAnalysis::class_name));
}

/// Returns the analyses that are on and can be run, with a note for each other one. Throws ReadError if there is none.
std::vector<pugi::xml_node> chosen_analyses(const ToolRun& run) {
  const OsimXml& xml = run.setup.xml();
  std::vector<pugi::xml_node> chosen;
  std::string others;
  pugi::xml_node first_other;
  for (const auto node : OsimXml::objects(xml.property(run.setup.tool(), "AnalysisSet"))) {
    if (!xml.flag(node, "on", true)) continue;
    if (is_known_analysis(node.name())) {
      chosen.push_back(node);
    } else {
      if (!first_other) first_other = node;
      others += fmt::format("{}{}", others.empty() ? "" : "; ", not_run(node));
      run.note("{}", not_run(node));
    }
  }
  if (chosen.empty() && !others.empty()) xml.fail(first_other, others);
  if (chosen.empty()) xml.fail(run.setup.tool(), "no analysis is on: there is nothing to do");
  return chosen;
}

}  // namespace

bool is_known_analysis(std::string_view class_name) {
  return std::ranges::find(kKnown, class_name, &KnownAnalysis::class_name) != std::end(kKnown);
}

void run_analyses(const ToolRun& tool_run) {
  const std::vector<pugi::xml_node> analyses = chosen_analyses(tool_run);
  AnalysisRun run{tool_run};
  const auto& xml = run.setup.xml();
  const auto tool = run.setup.tool();
  run.model = setup_model(run.setup, run.options.compat, {}, run.result.remarks);
  run.add_remarks(body::implausible(run.model), run.setup.required_file(tool, "model_file").string());
  run.decimals = static_cast<int>(xml.number(tool, "output_precision", 8.0));
  if (run.decimals < 1 || run.decimals > 30) {
    xml.fail(tool, "<output_precision> {}, expected 1 to 30", run.decimals);
  }
  run.equilibrium = xml.flag(tool, "solve_for_equilibrium_for_auxiliary_states", false);
  read_loads(run);
  const bool accelerates = std::any_of(analyses.begin(), analyses.end(), [](pugi::xml_node node) {
    const std::string_view name = node.name();
    return name == "StaticOptimization" || name == "InverseDynamics";
  });
  const double start_s = xml.number(tool, "initial_time", 0.0);
  const double end_s = xml.number(tool, "final_time", 1.0);
  if (!(start_s <= end_s)) {
    xml.fail(tool, "<initial_time> {} and <final_time> {}, expected the first not after the second", start_s, end_s);
  }
  const body::JointMotion all = read_motion(run, {start_s, end_s}, accelerates);
  const Eigen::VectorXd& times = all.q.time_s();
  const Eigen::Index first = row_at(times, start_s), last = row_at(times, end_s);
  if (run.loads) {
    note_missing_loads(run, *run.loads, *run.setup.file(tool, "external_loads_file"),
                       times.segment(first, last - first + 1));
  }
  for (const auto node : analyses) {
    const auto rows = recorded_rows(first, last, static_cast<int>(xml.number(node, "step_interval", 1.0)));
    if (rows != run.rows) {
      run.motion = rows_of(all, rows);
      run.moved = body::moved_by_speeds(run.model, run.motion);
      run.rows = rows;
      run.state_forces.reset();
      run.accelerations.reset();
    }
    run_analysis(run, node);
  }
}

}  // namespace myoid::opensim
