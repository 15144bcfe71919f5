#pragma once

#include <filesystem>
#include <vector>

#include <Eigen/Core>

#include "myoid/body/model/body_model.h"
#include "myoid/ground/core/remark.h"
#include "myoid/ground/core/time_series.h"
#include "myoid/study/study.h"

namespace myoid::study {

/// Reads measured fascicle lengths [m], on the clock of the motion, in columns named as the study's muscles; NaN is an
/// absent length. Throws ReadError for a file without such a column or lengths, for another unit, and for lengths that
/// are below 0.2 or above 4 times the optimal fiber length of the model's muscle.
[[nodiscard]] TimeSeries read_fascicles(const Study& study,
                                        const body::BodyModel& model,
                                        const std::filesystem::path& path,
                                        std::vector<Remark>& remarks);

/// Throws ReadError for lengths of other times than the trial's, those of its motion or of its muscles' lengths.
void require_times_of_trial(const std::filesystem::path& path,
                            const TimeSeries& fascicles,
                            const Eigen::VectorXd& trial_s);

/// Returns the lengths of the study's muscles at these times, n x muscles, by straight lines between samples: NaN where
/// there is none, outside the file's times and in its gaps of more than 0.2 s.
[[nodiscard]] Eigen::MatrixXd fascicles_at(const TimeSeries& fascicles,
                                           const std::vector<MuscleSpec>& muscles,
                                           const Eigen::VectorXd& time_s);

}  // namespace myoid::study
