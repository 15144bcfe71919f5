#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "myoid/tables/table_layout.h"

namespace myoid::recording {

/// The time [s] of every row of a table. The clock is
///
///   the time column; else with frame f and sub-frame s (f - first frame) / frame rate + s / rate;
///   else with a frame alone (f - first frame) / rate; else row / rate.
///
/// A frame rate that is not stated is the rate over the number of sub-frames of a frame. States as
/// repairs: rows that are missing between two frames or sub-frames, a stated rate that is not the
/// one of the times. Throws ReadError with the line where a row stands twice or goes back, where a
/// frame is no whole number, where the rates contradict the sub-frames, and where there is no
/// clock.
[[nodiscard]] Eigen::VectorXd row_times(const TableLayout& layout,
                                        const TableNumbers& numbers,
                                        const std::filesystem::path& path,
                                        std::vector<Repair>& repairs);

/// States a step of an otherwise even clock that is not as the others: by more than
/// ten times the departure that eight in ten steps stay below, and by more than the last decimal of
/// the times where that is the difference often. `lines` are those of the times.
void state_uneven_step(const Eigen::VectorXd& time_s,
                       const std::vector<std::size_t>& lines,
                       std::string_view name,
                       std::vector<Repair>& repairs);

}  // namespace myoid::recording
