#pragma once

#include <string>
#include <vector>

#include "myoid/identification/study_data.h"
#include "myoid/identify_files/identify_sources.h"

namespace myoid {

/// Looks for values that no muscle has: wrong units, swapped files, wrong signs. A certain fault
/// throws InvalidInput, with the file, the value found, the one expected and the remedy. Each
/// suspicious value returns a sentence.
///
/// - Lengths are 1 cm to 1 m; certain below 2 mm, not positive, above 3 m. With a tendon slack
///   length, fibers are 0.1 to 3 times their optimal length; certain if most are not positive.
///   Without one the lengths are those of fibers: certain to be none where the median lies outside
///   0.4 to 1.8 optimal lengths; a remark where the file is called as lengths of whole muscles are.
/// - Activations are 0 to 1, in the mean of half a second; certain above 2 or below -0.1.
/// - Velocities are dl/dt: over windows of 0.1 s the lengths change by their integral. Certain if
///   both go together (correlation above 0.9) by a factor outside 1/3 to 3, or against each other.
/// - Moment arms are at most 0.2 m; certain above 0.5 m. With more muscles than joints, dl = -r dq
///   leaves little of the lengths' changes: a remark below half.
/// - Torques are certain to be wrong beyond JointCapacity::greatest_nm of the starting values, with
///   100 kg at 1 m: N mm.
/// - Torque and moment arms agree in sign: with the starting values the muscles' torque goes with
///   the one measured (cosine of both); certain below -0.8. Of two joints whose files are in the
///   wrong order, each torque goes with the other's moment arms; certain above a correlation of 0.9
///   where its own leave less than 0.5.
[[nodiscard]] std::vector<std::string> check_identify_trial(const identification::StudyData& data,
                                                            const identification::TrialData& trial,
                                                            const IdentifyFiles& files);

}  // namespace myoid
