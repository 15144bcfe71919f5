#pragma once

#include <array>
#include <string_view>

namespace myoid::identification {

/// The origins of an uncertainty.
enum class Source { noise, literature, geometry, electrodes, torque_scale, model };
inline constexpr int kSourceCount = 6;

/// Their names in the columns of files, in the order of `Source`.
inline constexpr std::array<std::string_view, kSourceCount> kSourceColumns = {"noise",      "literature",   "geometry",
                                                                              "electrodes", "torque_scale", "model"};

/// Shares of a variance by source, which add to 1.
using SourceShares = std::array<double, kSourceCount>;

}  // namespace myoid::identification
