#include "myoid/program/steps/paths.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/body/arm/arm4.h"
#include "myoid/body/kinematics/surrogate_file.h"
#include "myoid/body/model/path_survey.h"
#include "myoid/body/osim/osim_document.h"
#include "myoid/program/steps/check_options.h"
#include "myoid/program/steps/stage_input.h"
#include "myoid/results/stage_files.h"

namespace myoid::program {
namespace {

using body::PathSurrogate;

/// Notes the errors of the polynomials, and the muscles without polynomials.
void tell_errors(const std::vector<PathSurrogate>& surrogates, const std::string& path, Remarks& remarks) {
  double length_mm = 0.0, arm_mm = 0.0;
  std::vector<std::string> outside;
  for (const PathSurrogate& s : surrogates) {
    if (!s.within_tolerance) {
      outside.push_back(fmt::format("{} ({:.2g} mm)", s.muscle, 1e3 * s.length_error_m));
      continue;
    }
    length_mm = std::max(length_mm, 1e3 * s.length_error_m);
    arm_mm = std::max(arm_mm, 1e3 * s.arm_error_m);
  }
  remarks.note(fmt::format(
      "{}: polynomials for {} of {} muscles, errors at most {:.2g} mm in length and {:.2g} mm in moment arm", path,
      surrogates.size() - outside.size(), surrogates.size(), length_mm, arm_mm));
  if (!outside.empty()) {
    remarks.warn(
        fmt::format("no polynomial is within tolerance for {}; their paths are computed", fmt::join(outside, ", ")));
  }
}

/// Reads the polynomials of the file; fits new ones if the file has none of this model.
std::vector<PathSurrogate> load_surrogates(const PathsOptions& o, const body::BodyModel& model, Remarks& remarks) {
  const body::SurrogateOptions options{.length_tolerance_m = 1e-3 * o.tolerance_mm,
                                       .arm_tolerance_m = 5e-3 * o.tolerance_mm,
                                       .progress = o.call.progress};
  const std::string text = o.model == "arm4" ? body::arm4_osim() : body::read_whole_text(o.model);
  const std::string key = body::surrogate_key(text, model.compat, options);
  auto surrogates = body::read_surrogates(o.surrogates, model, key);
  if (!surrogates) {
    surrogates = body::fit_surrogates(model, options);
    body::write_surrogates(o.surrogates, model, key, *surrogates);
  }
  tell_errors(*surrogates, o.surrogates, remarks);
  return std::move(*surrogates);
}

}  // namespace

void visit(PathsOptions& o, study::SettingVisitor& v) {
  visit_model(o.model, v);
  visit_motion(o.motion, v, "");
  v.folder("out", o.out,
           {.says = "Folder for MuscleAnalysis_*.sto [m, m/s], or sweep_*.csv and .svg.", .required = "a folder"});
  visit_lowpass(o.cutoff_hz, v);
  v.path("surrogate", o.surrogates,
         {.says = "File of fitted polynomials (.json) to use in the place of paths where they are within tolerance; "
                  "made if it is not there or belongs to another model."});
  v.number("surrogate-tolerance", o.tolerance_mm,
           {.says = "Greatest error of a length; five times that for moment arms [mm/rad].",
            .limits = study::above_zero("mm")});
  v.flag("check-jumps", o.check_jumps,
         {.says = "Tell where a length or moment arm jumps over the range of a coordinate."});
  visit_compat(o.compat, v);
}

PathsResult paths(const PathsOptions& o) {
  check_options(o);
  Remarks remarks(o.call);
  const auto [model, motion] = load_moved_model(o.model, o.compat, o.motion, o.cutoff_hz, o.call, remarks);
  if (o.check_jumps) {
    for (const body::PathJump& jump : body::find_jumps(model)) remarks.warn(body::describe(model, jump));
  }
  std::vector<PathSurrogate> surrogates;
  if (!o.surrogates.empty()) surrogates = load_surrogates(o, model, remarks);
  PathsResult result;
  result.samples = motion.sample_count();
  result.muscles = body::muscle_kinematics(
      model, motion, {.surrogates = surrogates.empty() ? nullptr : &surrogates, .progress = o.call.progress});
  if (!surrogates.empty()) {
    remarks.note(fmt::format("{} of {} paths are from polynomials", result.muscles.from_surrogates,
                             result.samples * result.muscles.length.channel_count()));
  }
  result.remarks = remarks.list();
  return result;
}

void write_paths(const PathsResult& result, const std::filesystem::path& folder) {
  results::write_muscle_kinematics(result.muscles, folder);
}

}  // namespace myoid::program
