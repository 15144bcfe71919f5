#include "myoid/recording/c3d/c3d_signals.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/file_words.h"
#include "myoid/ground/files/missing_value.h"
#include "myoid/ground/files/text_file.h"
#include "myoid/ground/files/unique_names.h"

namespace myoid::recording {
namespace {

/// Rows turned into columns at once, so that they stay in the cache.
constexpr Eigen::Index kBlockRows = 64;

/// Returns true for three equal coordinates that stand for a missing position, as -9999 or -999.9 in single precision.
bool is_of_nines(const float* p) {
  if (!(p[0] == p[1] && p[1] == p[2] && std::abs(p[0]) >= 999.0F)) return false;
  return may_stand_for_missing(parse_number(fmt::format("{}", p[0])).value_or(0.0));
}

}  // namespace

std::vector<Eigen::Index> marker_columns(const C3dFile& file) {
  std::set<std::string> derived;
  for (const char* kind : {"ANGLES", "FORCES", "MOMENTS", "POWERS", "SCALARS", "REACTIONS"}) {
    for (std::string& label : all_texts(file, "POINT", kind)) derived.insert(std::move(label));
  }
  std::vector<Eigen::Index> columns;
  for (std::size_t i = 0; i < file.point_labels.size(); ++i) {
    if (!derived.contains(file.point_labels[i])) columns.push_back(static_cast<Eigen::Index>(i));
  }
  return columns;
}

C3dMarkerBuilder::C3dMarkerBuilder(const C3dFile& file, Eigen::Index frames)
    : columns_(marker_columns(file)), points_(file.point_labels.size()), first_frame_(file.first_frame) {
  if (columns_.empty() || frames == 0) throw InvalidInput("the C3D file holds no markers");
  const std::optional<ScaledUnit> unit = parse_file_unit(file.point_unit);
  if (!unit || unit->unit != Unit::meter) {
    throw InvalidInput("POINT:UNITS: found '{}', expected mm, cm or m; correct the file's parameter", file.point_unit);
  }
  to_m_ = unit->to_si;
  if (columns_.size() < points_) {
    note(repairs_,
         "{} points are angles, forces, moments, powers or scalars of another program and no markers; left out",
         points_ - columns_.size());
  }
  markers_.time_s.resize(frames);
  for (Eigen::Index k = 0; k < frames; ++k)
    markers_.time_s[k] = static_cast<double>(file.first_frame - 1 + k) / file.point_rate_hz;

  for (const Eigen::Index c : columns_) markers_.names.push_back(file.point_labels[static_cast<std::size_t>(c)]);
  leave_out_subject(markers_.names, 0, repairs_);
  markers_.positions_m.resize(frames, static_cast<Eigen::Index>(3 * columns_.size()));
}

void C3dMarkerBuilder::add(Eigen::Index first, Eigen::Index count, const float* rows) {
  constexpr double kGap = std::numeric_limits<double>::quiet_NaN();
  const auto width = static_cast<Eigen::Index>(4 * points_);
  for (Eigen::Index begin = 0; begin < count; begin += kBlockRows) {
    const Eigen::Index end = std::min(count, begin + kBlockRows);
    for (std::size_t m = 0; m < columns_.size(); ++m) {
      const float* p = rows + begin * width + 4 * columns_[m];
      const auto to = static_cast<Eigen::Index>(3 * m);
      for (Eigen::Index k = begin; k < end; ++k, p += width) {
        const bool zero = p[0] == 0.0F && p[1] == 0.0F && p[2] == 0.0F;
        const bool nines = is_of_nines(p);
        const bool measured =
            p[3] >= 0.0F && std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]) && !zero && !nines;
        if (zero && p[3] >= 0.0F) zeros_.add(first + k);
        if (nines && p[3] >= 0.0F) nines_.add(first + k);
        for (Eigen::Index axis = 0; axis < 3; ++axis)
          markers_.positions_m(first + k, to + axis) = measured ? to_m_ * static_cast<double>(p[axis]) : kGap;
      }
    }
  }
}

MarkerSeries C3dMarkerBuilder::finish(std::vector<Repair>& repairs) {
  repairs.insert(repairs.end(), repairs_.begin(), repairs_.end());
  for (const auto& [found, what] : {std::pair{zeros_, "exactly 0 0 0"}, {nines_, "nines alone (-9999 -9999 -9999)"}}) {
    if (found.count > 0)
      note(repairs, "{} positions are {} though not marked as missing (the first in frame {}); taken as missing",
           found.count, what, first_frame_ + found.first);
  }
  return std::move(markers_);
}

C3dChannelUnits c3d_channel_units(const C3dFile& file) {
  C3dChannelUnits units;
  for (const C3dChannel& channel : file.channels) {
    const auto unit = parse_file_unit(channel.unit_text);
    units.channels.push_back({channel.name, unit ? unit->unit : Unit::dimensionless});
    units.scales.push_back({channel.offset, channel.scale, unit ? unit->to_si : 1.0});
  }
  return units;
}

}  // namespace myoid::recording
