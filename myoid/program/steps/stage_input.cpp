#include "myoid/program/steps/stage_input.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/body/arm/arm4.h"
#include "myoid/body/dynamics/ground_support.h"
#include "myoid/body/kinematics/motion_plausibility.h"
#include "myoid/body/model/model_plausibility.h"
#include "myoid/body/model/path_survey.h"
#include "myoid/body/osim/osim_reader.h"
#include "myoid/ground/core/angle_unit.h"
#include "myoid/ground/core/error.h"
#include "myoid/recording/recording.h"
#include "myoid/recording/signals/clock_gaps.h"
#include "myoid/recording/tables/storage_reader.h"
#include "myoid/study/checks/load_points.h"
#include "myoid/study/trial_up.h"

namespace myoid::program {
namespace {

TimeSeries in_si(const recording::Storage& file, const body::BodyModel& model) {
  return recording::to_si(file, [&](const std::string& name) {
    const auto c = model.find_coordinate(name);
    return c && model.coordinates[static_cast<std::size_t>(*c)].motion == body::MotionType::rotational;
  });
}

}  // namespace

void warn_of_repairs(const std::filesystem::path& path, const std::vector<Repair>& repairs, Remarks& remarks) {
  for (const Repair& repair : repairs) remarks.warn(recording::to_string(path, repair));
}

void warn_of_path_differences(const body::BodyModel& model, const std::string& name, Remarks& remarks) {
  constexpr int kPostures = 40;
  if (model.compat != body::Compat{}) return;
  int count = 0;
  std::string worst;
  for (const body::PathDifference& d : body::compare_with_opensim(model, kPostures)) {
    if (d.postures_above_1mm == 0) continue;
    if (++count <= 3) worst += (worst.empty() ? "" : ", ") + model.muscles[static_cast<std::size_t>(d.muscle)].name;
  }
  if (count == 0) return;
  remarks.warn(
      fmt::format("{}: {} of {} muscles ({}{}) are somewhere more than 1 mm longer or shorter than in OpenSim 4.5.2; "
                  "`myoid info {} --compare-compat` lists them, --compat opensim reproduces OpenSim",
                  name, count, model.muscles.size(), worst, count > 3 ? ", ..." : "", name));
}

body::BodyModel load_model(const std::string& name, body::Compatibility compat, Remarks& remarks) {
  std::error_code ignored;
  if (!name.ends_with(".osim") && name != "arm4" && !std::filesystem::exists(name, ignored)) {
    throw ReadError(name, 0, "there is no such file, and the only built-in model is arm4");
  }
  const body::OsimOptions options{.compat = body::compat_of(compat)};
  body::BodyModel model =
      name == "arm4" ? body::parse_osim(body::arm4_osim(), "arm4.osim", options) : body::read_osim(name, options);
  body::require_lengths_in_m(model, name);
  for (const std::string& text : model.unsupported) remarks.warn(fmt::format("{}: {}", name, text));
  for (const std::string& text : sentences(model.notes)) remarks.detail(fmt::format("{}: {}", name, text));
  remarks.add(body::implausible(model), name);
  return model;
}

TimeSeries cut(const TimeSeries& series, const Call& call) {
  if (!call.start_s && !call.end_s) return series;
  TimeSeries result = series.slice(call.start_s.value_or(-1e300), call.end_s.value_or(1e300));
  if (result.empty()) {
    throw InvalidInput(fmt::format("nothing lies between --start and --end; the data go from {} to {} s",
                                   series.time_s()[0], series.time_s()[series.sample_count() - 1]));
  }
  return result;
}

MarkerSeries cut(MarkerSeries markers, const Call& call) {
  if (!call.start_s && !call.end_s) return markers;
  const double start_s = call.start_s.value_or(-1e300), end_s = call.end_s.value_or(1e300);
  Eigen::Index first = 0;
  while (first < markers.frame_count() && markers.time_s[first] < start_s) ++first;
  Eigen::Index last = markers.frame_count();
  while (last > first && markers.time_s[last - 1] > end_s) --last;
  if (last == first) throw InvalidInput("no frames lie between --start and --end");
  markers.time_s = markers.time_s.segment(first, last - first).eval();
  markers.positions_m = markers.positions_m.middleRows(first, last - first).eval();
  return markers;
}

MovedModel load_moved_model(const std::string& model,
                            body::Compatibility compat,
                            const std::filesystem::path& motion,
                            std::optional<double> cutoff_hz,
                            const Call& call,
                            Remarks& remarks) {
  body::BodyModel loaded = load_model(model, compat, remarks);
  if (!call.quiet) warn_of_path_differences(loaded, model, remarks);
  body::JointMotion moved = load_motion(loaded, motion, cutoff_hz, call, remarks, body::HeldValues::of_model);
  return {std::move(loaded), std::move(moved)};
}

body::JointMotion with_derivatives(body::JointMotion motion,
                                   const body::BodyModel& model,
                                   const std::filesystem::path& speeds,
                                   const std::filesystem::path& accelerations,
                                   const Call& call,
                                   Remarks& remarks) {
  const auto replace = [&](TimeSeries& derivative, const std::filesystem::path& path) {
    if (path.empty()) return;
    const recording::Storage file = recording::read_storage(path);
    warn_of_repairs(path, file.repairs, remarks);
    const TimeSeries given = cut(in_si(file, model), call);
    const Eigen::VectorXd& time_s = derivative.time_s();
    if (given.sample_count() != time_s.size() || (given.time_s() - time_s).cwiseAbs().maxCoeff() > 1e-9) {
      throw ReadError(
          path, 0,
          fmt::format("has {} samples from {} to {} s; expected the times of the motion, {} samples from {} to {} s",
                      given.sample_count(), given.time_s()[0], given.time_s()[given.sample_count() - 1], time_s.size(),
                      time_s[0], time_s[time_s.size() - 1]));
    }
    Eigen::MatrixXd values = derivative.values();
    bool any = false;
    for (std::size_t k = 0; k < model.coordinates.size(); ++k) {
      const auto column = given.find(model.coordinates[k].name);
      if (!column) continue;
      any = true;
      values.col(static_cast<Eigen::Index>(k)) = given.values().col(*column);
    }
    if (!any) throw ReadError(path, 0, "no column is a coordinate of the model");
    derivative = TimeSeries(time_s, derivative.channels(), std::move(values));
  };
  replace(motion.qdot, speeds);
  replace(motion.qddot, accelerations);
  return motion;
}

Mat3 onto_model(const body::BodyModel& model, const std::string& markers, const std::string& up, Remarks& remarks) {
  if (const auto told = recording::axis_vector(up)) return study::rotation_onto(model, *told);
  const recording::LaboratoryUp own = study::trial_up(study::kUpOfTheFile, markers, model);
  if (*own.up_L != study::model_up(model))
    remarks.note(fmt::format("note: {}: {}", markers, study::up_note(own, model)));
  return study::rotation_onto(model, *own.up_L);
}

body::JointMotion load_motion(const body::BodyModel& model,
                              const std::filesystem::path& path,
                              std::optional<double> cutoff_hz,
                              const Call& call,
                              Remarks& remarks,
                              body::HeldValues held) {
  const recording::Storage file = recording::read_storage(path);
  warn_of_repairs(path, file.repairs, remarks);
  const TimeSeries q = in_si(file, model);
  if (const std::string doubt = check_angle_unit(path, file.in_degrees, q); !doubt.empty())
    remarks.warn(fmt::format("{}: {}", path.filename().string(), doubt));
  const Stretch asked{call.start_s.value_or(-1e300), call.end_s.value_or(1e300)};
  remarks.add(body::implausible_motion(model, q, asked), path.string());
  if (const recording::ClockGaps gaps = recording::find_clock_gaps(q.time_s()); gaps.count > 0)
    remarks.warn(
        fmt::format("{}: {}; a spline bridges the gaps, and its derivatives beside a gap are not to be relied on",
                    path.string(), gaps.text()));
  body::MotionOptions options{.held = held};
  if (cutoff_hz) {
    if (*cutoff_hz >= 0.5 * q.mean_rate_hz()) {
      throw InvalidInput(fmt::format("--lowpass {} Hz: {} has {:.4g} Hz; give less than half of that, or leave it out",
                                     *cutoff_hz, path.string(), q.mean_rate_hz()));
    }
    options.cutoff_hz = *cutoff_hz;
  }
  body::MotionResult result = body::joint_motion(model, q, options);
  for (std::string& note : sentences(result.notes)) remarks.warn(std::move(note));
  const body::JointMotion& whole = result.motion;
  return {cut(whole.q, call), cut(whole.qdot, call), cut(whole.qddot, call)};
}

body::ExternalLoads load_external_loads(const body::BodyModel& model,
                                        const std::filesystem::path& path,
                                        const body::JointMotion& motion,
                                        Remarks& remarks) {
  body::ExternalLoads loads = body::read_external_loads(model, path);
  for (std::string& note : sentences(loads.notes)) remarks.warn(std::move(note));
  const Eigen::VectorXd& time_s = motion.q.time_s();
  if (time_s[0] < loads.start_s - 1e-3 || time_s[time_s.size() - 1] > loads.end_s + 1e-3) {
    remarks.warn(
        fmt::format("{}: the loads are known from {} to {} s, the motion goes from {} to {} s; beyond, they are "
                    "guessed by straight lines",
                    path.string(), loads.start_s, loads.end_s, time_s[0], time_s[time_s.size() - 1]));
  }
  if (const auto wrong = body::wrong_support(model, loads, time_s);
      wrong && body::stands(model, motion.q.values().row(0).transpose()))
    remarks.warn(fmt::format("{}: {}", path.string(), wrong->sentence()));
  const study::ContactTable table = study::contact_table(model, loads, {model, nullptr, &motion.q});
  for (Remark& found : study::misplaced_loads(model, table, path.string())) remarks.add(std::move(found));
  return loads;
}

}  // namespace myoid::program
