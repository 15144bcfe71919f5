#include "myoid/recording/ground_reaction.h"

#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"

namespace myoid::recording {
namespace {

/// The columns of one plate, three axes each.
struct Column {
  std::string_view kind, letter;
  Unit unit;
};
constexpr std::array kColumns = {Column{"force", "v", Unit::newton}, Column{"force", "p", Unit::meter},
                                 Column{"torque", "", Unit::newton_meter}};

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&') {
      out += "&amp;";
    } else if (c == '<') {
      out += "&lt;";
    } else if (c == '>') {
      out += "&gt;";
    } else if (c == '"') {
      out += "&quot;";
    } else {
      out += c;
    }
  }
  return out;
}

/// Fills rows that are NaN linearly between their neighbors and constantly at the ends; with
/// `fallback` if all rows are NaN.
void bridge(Eigen::Ref<Eigen::MatrixXd> points, const Vec3& fallback) {
  Eigen::Index last = -1;
  const Eigen::Index n = points.rows();
  for (Eigen::Index i = 0; i <= n; ++i) {
    if (i < n && !points.row(i).allFinite()) continue;
    for (Eigen::Index k = last + 1; k < i; ++k) {
      if (last < 0 && i == n) {
        points.row(k) = fallback.transpose();
      } else if (last < 0) {
        points.row(k) = points.row(i);
      } else if (i == n) {
        points.row(k) = points.row(last);
      } else {
        const double share = static_cast<double>(k - last) / static_cast<double>(i - last);
        points.row(k) = (1.0 - share) * points.row(last) + share * points.row(i);
      }
    }
    last = i;
  }
}

}  // namespace

TimeSeries ground_reaction(const std::vector<ForcePlate>& plates,
                           const GroundReactionOptions& options,
                           std::vector<Repair>& repairs) {
  if (plates.empty()) throw InvalidInput("there are no force plates that are understood");
  const Mat3& R = options.R_YG;
  const Eigen::Index samples = plates[0].time_s.size();
  std::vector<Channel> channels;
  Eigen::MatrixXd values(samples, static_cast<Eigen::Index>(9 * plates.size()));
  for (std::size_t k = 0; k < plates.size(); ++k) {
    const ForcePlate& plate = plates[k];
    for (const auto& [kind, letter, unit] : kColumns) {
      for (const char axis : {'x', 'y', 'z'})
        channels.push_back({fmt::format("ground_{}_{}_{}{}", kind, plate.number, letter, axis), unit});
    }
    auto block = values.middleCols(static_cast<Eigen::Index>(9 * k), 9);
    Eigen::Index unloaded = 0;
    Eigen::Index broken = 0;
    for (Eigen::Index i = 0; i < samples; ++i) {
      if (!plate.force_n.row(i).allFinite()) ++broken;
      block.row(i).setZero();
      const auto action = action_on_person(plate, i, options.least_force_n);
      if (!action) {
        ++unloaded;
        block.block<1, 3>(i, 3).setConstant(std::nan(""));
        continue;
      }
      block.block<1, 3>(i, 0) = (R * action->force_n).transpose();
      block.block<1, 3>(i, 3) = (R * action->point_m).transpose();
      block.block<1, 3>(i, 6) = (R * action->moment_nm).transpose();
    }
    bridge(block.middleCols(3, 3), R * plate.p_GP_m);
    if (broken > 0) note(repairs, "force plate {}: {} samples are no numbers; taken as 0", plate.number, broken);
    if (unloaded == samples) {
      note(repairs, "force plate {} is never loaded with {} N", plate.number, options.least_force_n);
    } else if (unloaded > 0) {
      note(repairs, "force plate {}: {} of {} samples are below {} N and set to 0", plate.number, unloaded, samples,
           options.least_force_n);
    }
  }
  return {plates[0].time_s, std::move(channels), std::move(values)};
}

std::string format_external_loads(const std::string& name,
                                  const std::vector<int>& plate_numbers,
                                  const std::vector<std::string>& bodies,
                                  const std::string& data_file) {
  std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\" ?>\n<OpenSimDocument Version=\"40000\">\n";
  text += fmt::format("\t<ExternalLoads name=\"{}\">\n\t\t<objects>\n", escaped(name));
  for (std::size_t k = 0; k < plate_numbers.size() && k < bodies.size(); ++k) {
    if (bodies[k].empty()) continue;
    const int n = plate_numbers[k];
    text += fmt::format("\t\t\t<ExternalForce name=\"plate_{}\">\n", n);
    text += fmt::format("\t\t\t\t<applied_to_body>{}</applied_to_body>\n", escaped(bodies[k]));
    text += "\t\t\t\t<force_expressed_in_body>ground</force_expressed_in_body>\n";
    text += "\t\t\t\t<point_expressed_in_body>ground</point_expressed_in_body>\n";
    text += fmt::format("\t\t\t\t<force_identifier>ground_force_{}_v</force_identifier>\n", n);
    text += fmt::format("\t\t\t\t<point_identifier>ground_force_{}_p</point_identifier>\n", n);
    text += fmt::format("\t\t\t\t<torque_identifier>ground_torque_{}_</torque_identifier>\n", n);
    text += "\t\t\t</ExternalForce>\n";
  }
  text += fmt::format("\t\t</objects>\n\t\t<groups />\n\t\t<datafile>{}</datafile>\n", escaped(data_file));
  text += "\t</ExternalLoads>\n</OpenSimDocument>\n";
  return text;
}

}  // namespace myoid::recording
