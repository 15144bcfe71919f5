#pragma once

#include <string>
#include <vector>

#include "myoid/fit/measurement/study_data.h"

namespace myoid::study {

/// The files of one trial that give its stages, for messages; empty names: not given, and not checked.
struct TrialFiles {
  std::string activations, lengths;
  std::string velocities;                ///< Empty: rates of the spline through the lengths.
  std::vector<std::string> moment_arms;  ///< By joint.
  std::string torques;
  bool resting_torque_is_free = false;  ///< The torque of the joint without activity is fitted.
};

/// Finds values that no muscle has: wrong units, swapped files, wrong signs. Throws InvalidInput for a certain fault,
/// with the file, the value found, the expected one and the remedy. Returns a sentence for each suspicious value.
///
/// - Lengths are 1 cm to 1 m; a fault below 2 mm, if not positive, above 3 m. With a tendon slack
/// length, fibers are 0.1 to 3 times their optimal length; a fault if most are not positive.
/// Without one the lengths are fiber lengths: a fault if the median is outside 0.4 to 1.8 optimal
/// lengths; a remark if the file is named as lengths of whole muscles are.
/// - Activations are 0 to 1, in the mean of half a second; a fault above 2 or below -0.1.
/// - Velocities are dl/dt: over windows of 0.1 s the lengths change by their integral. A fault if
/// the two correlate (above 0.9) with a factor outside 1/3 to 3, or with opposite signs.
/// - Moment arms are at most 0.2 m; a fault above 0.5 m. With more muscles than joints, dl = -r dq
/// explains most of the lengths' changes: a remark below half.
/// - Torques beyond JointCapacity::greatest_nm of the starting values, with 100 kg at 1 m, are a
/// fault: N mm.
/// - Torque and moment arms agree in sign: with the starting values the muscles' torque correlates
/// with the measured one (cosine of both); a fault below -0.8. For two joints with files in the
/// wrong order, each torque correlates with the other's moment arms; a fault above a correlation of
/// 0.9 if the own moment arms give less than 0.5.
[[nodiscard]] std::vector<std::string> check_given_trial(const fit::StudyData& data,
                                                         const fit::TrialData& trial,
                                                         const TrialFiles& files);

}  // namespace myoid::study
