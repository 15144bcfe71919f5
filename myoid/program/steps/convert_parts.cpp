#include "myoid/program/steps/convert_parts.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/units.h"
#include "myoid/ground/files/file_format.h"
#include "myoid/recording/plate_standing.h"

namespace myoid::program {

Mat3 rotation_of(const ConvertOptions& o, const Vec3& up_L) {
  Mat3 R = recording::rotation_to_y_up(up_L);
  for (const std::string& turn : o.turns) {
    const auto degrees =
        turn.size() > 2 && turn[1] == ':' ? parse_number(std::string_view(turn).substr(2)) : std::nullopt;
    if (!degrees || std::string_view("xyz").find(turn[0]) == std::string_view::npos || !std::isfinite(*degrees))
      throw InvalidInput(fmt::format("--rotate {}: expected AXIS:DEGREES, as x:-90", turn));
    const Vec3 axis = turn[0] == 'x'   ? Vec3::UnitX().eval()
                      : turn[0] == 'y' ? Vec3::UnitY().eval()
                                       : Vec3::UnitZ().eval();
    R = Eigen::AngleAxisd(*degrees * kDegree, axis).toRotationMatrix() * R;
  }
  // Turns by right angles stay exact.
  return R.unaryExpr([](double x) { return std::abs(x - std::round(x)) < 1e-15 ? std::round(x) : x; });
}

void without_blanks(MarkerSeries& markers, std::vector<Repair>& repairs) {
  std::size_t changed = 0;
  for (std::string& name : markers.names) {
    if (name.find_first_of(" \t") == std::string::npos) continue;
    std::ranges::replace(name, ' ', '_');
    std::ranges::replace(name, '\t', '_');
    ++changed;
  }
  if (changed > 0) repairs.push_back({0, fmt::format("blanks in {} marker names became '_'", changed)});
}

bool is_storage(const std::string& file) { return format_of(file) == FileFormat::storage; }

std::vector<std::string> other_clocks(const recording::Recording& file) {
  std::vector<std::string> names;
  for (const AnalogChannels& clock : file.other_clocks) {
    for (const Channel& channel : clock.channels()) names.push_back(channel.name);
  }
  return names;
}

std::vector<int> plate_numbers(const ConvertOptions& o, const recording::Recording& file) {
  std::vector<int> numbers;
  for (const recording::PlateSetup& plate : file.plates) numbers.push_back(plate.number);
  const std::size_t given = o.bodies.size();
  if (given == 0 || given == numbers.size()) return numbers;
  throw InvalidInput(
      fmt::format("--body: {} {} for {} force {} of {} ({}); give one for each, in this order, and \"\" for a plate on "
                  "which nobody stands",
                  given, given == 1 ? "body" : "bodies", numbers.size(), numbers.size() == 1 ? "plate" : "plates", o.in,
                  fmt::join(numbers, ", ")));
}

Eigen::VectorXd new_clock(const ConvertOptions& o, const Eigen::VectorXd& old) {
  const double length_s = old[old.size() - 1] - old[0];
  const auto intervals = static_cast<Eigen::Index>(std::floor(length_s * *o.rate_hz + 1e-6));
  if (intervals < 1 || intervals > 100'000'000)
    throw InvalidInput(
        fmt::format("--rate {}: that makes {} samples of {:.3g} s", *o.rate_hz, intervals + 1, length_s));
  return Eigen::VectorXd::LinSpaced(intervals + 1, old[0], old[0] + static_cast<double>(intervals) / *o.rate_hz);
}

}  // namespace myoid::program
