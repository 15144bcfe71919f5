#include "myoid/cli/stage_input.h"

#include <fmt/format.h>

#include "myoid/core/error.h"
#include "myoid/model/arm4.h"
#include "myoid/model/osim_reader.h"
#include "myoid/recording/storage_reader.h"

namespace myoid::cli {

model::BodyModel load_model(const std::string& name, const Context& context) {
  model::BodyModel model =
      name == "arm4" ? model::parse_osim(model::arm4_osim(), "arm4.osim") : model::read_osim(name);
  for (const std::string& text : model.unsupported) context.warn(fmt::format("{}: {}", name, text));
  if (context.verbose) {
    for (const std::string& text : model.notes) context.log(fmt::format("{}: {}", name, text));
  }
  return model;
}

TimeSeries cut(const TimeSeries& series, const Context& context) {
  if (!context.start_s && !context.end_s) return series;
  TimeSeries result = series.slice(context.start_s.value_or(-1e300), context.end_s.value_or(1e300));
  if (result.empty()) {
    throw InvalidInput(
        fmt::format("nothing lies between --start and --end; the data go from {} to {} s",
                    series.time_s()[0], series.time_s()[series.sample_count() - 1]));
  }
  return result;
}

kinematics::JointMotion load_motion(const model::BodyModel& model,
                                    const std::filesystem::path& path,
                                    double cutoff_hz,
                                    const Context& context) {
  const recording::Storage file = recording::read_storage(path);
  for (const recording::Repair& repair : file.repairs)
    context.warn(fmt::format("{}:{}: {}", path.string(), repair.line, repair.message));
  const TimeSeries q = recording::to_si(file, [&](const std::string& name) {
    const auto c = model.find_coordinate(name);
    return c &&
           model.coordinates[static_cast<std::size_t>(*c)].motion == model::MotionType::rotational;
  });
  for (Eigen::Index c = 0; c < q.channel_count(); ++c) {
    if (q.channels()[static_cast<std::size_t>(c)].unit == Unit::radian &&
        q.values().col(c).cwiseAbs().maxCoeff() > 4.0 * kPi) {
      throw ReadError(path, 0,
                      fmt::format("column '{}' reaches {:.4g} rad: these are degrees; write "
                                  "inDegrees=yes into the header",
                                  q.channels()[static_cast<std::size_t>(c)].name,
                                  q.values().col(c).cwiseAbs().maxCoeff()));
    }
  }
  kinematics::MotionOptions options;
  if (cutoff_hz > 0.0) options.cutoff_hz = cutoff_hz;
  kinematics::MotionResult result = kinematics::joint_motion(model, cut(q, context), options);
  for (const std::string& note : result.notes) context.warn(note);
  return std::move(result.motion);
}

}  // namespace myoid::cli
