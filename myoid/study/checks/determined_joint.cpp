#include "myoid/study/checks/determined_joint.h"

#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/body/kinematics/open_coordinates.h"
#include "myoid/ground/core/error.h"
#include "myoid/study/study_model.h"

namespace myoid::study {

std::optional<Remark> open_joint(const Study& study,
                                 const body::BodyModel& model,
                                 const TrialSpec& trial,
                                 const MarkerSeries& markers) {
  std::vector<std::string> open;
  try {
    open = body::open_coordinates(model, markers);
  } catch (const InvalidInput&) {
    return std::nullopt;  // markers of which the model has none are told elsewhere
  }
  std::vector<std::string> own;
  for (const std::string& name : study_coordinates(study.model)) {
    const bool held =
        study.ik.calibrate && std::ranges::find(study.ik.calibrate->hold, name) != study.ik.calibrate->hold.end();
    if (!held && std::ranges::find(open, name) != open.end()) own.push_back(name);
  }
  if (own.empty()) return std::nullopt;
  std::vector<std::string> known;
  for (const std::string& name : markers.names) {
    if (model.find_marker(name)) known.push_back(name);
  }
  return Remark{.code = RemarkCode::joint_undetermined,
                .severity = Severity::error,
                .where = trial.name,
                .about = own.front(),
                .says = fmt::format("the markers of the recording that the model has ({}) leave {} open: they would be "
                                    "as near at another angle",
                                    fmt::join(known, ", "), fmt::join(own, ", ")),
                .remedy =
                    "name markers on both sides of the joint ([markers] rename), or lock the coordinates that turn "
                    "with it ([ik] lock)"};
}

}  // namespace myoid::study
