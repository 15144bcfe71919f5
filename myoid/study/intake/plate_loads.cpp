#include "myoid/study/intake/plate_loads.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/nearest_word.h"
#include "myoid/recording/signals/filter.h"
#include "myoid/recording/signals/resample.h"
#include "myoid/study/intake/body_points.h"
#include "myoid/study/study_model.h"

namespace myoid::study {
namespace {

constexpr double kMerged_s = 0.02;  ///< longest pause within a contact

/// Samples of a plate in the model's ground.
struct Wrench {
  Eigen::MatrixX3d force_n,
      moment_nm;             ///< Moment about the middle of the surface; both are 0 without load.
  Eigen::MatrixX3d point_m;  ///< Center of pressure; NaN without load.
  std::vector<bool> loaded;
};

struct Contact {
  Eigen::Index first = 0, end = 0;  ///< Samples.
};

Wrench wrench_of(const recording::ForcePlate& plate, const Mat3& R, double least_force_n) {
  const Eigen::Index n = plate.time_s.size();
  Wrench w;
  w.force_n = Eigen::MatrixX3d::Zero(n, 3);
  w.moment_nm = Eigen::MatrixX3d::Zero(n, 3);
  w.point_m = Eigen::MatrixX3d::Constant(n, 3, std::numeric_limits<double>::quiet_NaN());
  w.loaded.assign(static_cast<std::size_t>(n), false);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto action = recording::action_on_person(plate, i, least_force_n);
    if (!action) continue;
    w.loaded[static_cast<std::size_t>(i)] = true;
    w.force_n.row(i) = (R * action->force_n).transpose();
    w.moment_nm.row(i) = (R * plate.moment_nm.row(i).transpose()).transpose();
    w.point_m.row(i) = (R * action->point_m).transpose();
  }
  return w;
}

std::vector<Contact> contacts_of(const Wrench& w, const Eigen::VectorXd& time_s) {
  std::vector<Contact> contacts;
  const auto n = static_cast<Eigen::Index>(w.loaded.size());
  for (Eigen::Index i = 0; i < n; ++i) {
    if (!w.loaded[static_cast<std::size_t>(i)]) continue;
    if (contacts.empty() || time_s[i] - time_s[contacts.back().end - 1] > kMerged_s) contacts.push_back({i, i});
    contacts.back().end = i + 1;
  }
  std::erase_if(contacts,
                [&](const Contact& c) { return time_s[c.end - 1] - time_s[c.first] < kLimits.contacts.least_s; });
  return contacts;
}

/// Returns the mean distance of the center of pressure from the nearest marker of each body, over the frames.
std::map<body::BodyIndex, double> distances(const body::BodyModel& model,
                                            const MarkerSeries& markers,
                                            const Wrench& w,
                                            const Eigen::VectorXd& time_s,
                                            const Contact& contact) {
  std::map<body::BodyIndex, double> sum;
  std::map<body::BodyIndex, int> count;
  BodyPoints points(model, &markers, nullptr);
  for (Eigen::Index f = 0; f < markers.frame_count(); ++f) {
    const double t = markers.time_s[f];
    if (t < time_s[contact.first] || t > time_s[contact.end - 1]) continue;
    const auto at = std::lower_bound(time_s.data() + contact.first, time_s.data() + contact.end, t) - time_s.data();
    const Vec3 p = w.point_m.row(std::min<Eigen::Index>(at, contact.end - 1)).transpose();
    if (!p.allFinite()) continue;
    points.pose(f);
    for (std::size_t b = 0; b < model.bodies.size(); ++b) {
      const auto body = static_cast<body::BodyIndex>(b);
      const double d = points.of_one(p, body);
      if (!std::isfinite(d)) continue;
      sum[body] += d;
      ++count[body];
    }
  }
  for (auto& [body, d] : sum) d /= count[body];
  return sum;
}

body::BodyIndex body_named(const body::BodyModel& model, const std::string& name) {
  if (const auto body = model.find_body(name)) return *body;
  throw InvalidInput(fmt::format("force_plates: there is no body '{}'{}", name, not_among(name, body_names(model))));
}

body::LoadColumns splined(const TimeSeries& series, Eigen::Index first) {
  body::LoadColumns columns;
  for (Eigen::Index k = 0; k < 3; ++k)
    columns.splines.push_back(math::Spline::interpolate(series.time_s(), series.values().col(first + k), 3));
  return columns;
}

/// Returns the samples of these contacts as a force on a body.
body::ExternalForce force_of(const recording::ForcePlate& plate,
                             const Wrench& w,
                             const std::vector<Contact>& contacts,
                             const Mat3& R,
                             body::BodyIndex body,
                             std::optional<double> cutoff_hz) {
  Eigen::MatrixXd values = Eigen::MatrixXd::Zero(plate.time_s.size(), 6);
  for (const Contact& c : contacts) {
    values.block(c.first, 0, c.end - c.first, 3) = w.force_n.middleRows(c.first, c.end - c.first);
    values.block(c.first, 3, c.end - c.first, 3) = w.moment_nm.middleRows(c.first, c.end - c.first);
  }
  TimeSeries series(plate.time_s,
                    {{"fx", Unit::newton},
                     {"fy", Unit::newton},
                     {"fz", Unit::newton},
                     {"mx", Unit::newton_meter},
                     {"my", Unit::newton_meter},
                     {"mz", Unit::newton_meter}},
                    std::move(values));
  if (cutoff_hz && *cutoff_hz < 0.45 * series.mean_rate_hz()) {
    series = recording::zero_phase_filter(series, math::FilterBand::low_pass, *cutoff_hz);
    // Enough for the remaining frequencies, and less data.
    const double enough_hz = 20.0 * *cutoff_hz;
    const Eigen::VectorXd& t = series.time_s();
    if (series.mean_rate_hz() > 2.0 * enough_hz)
      series = recording::resample(series, recording::even_clock(t[0], t[t.size() - 1], enough_hz));
  }
  body::ExternalForce force;
  force.name = fmt::format("plate_{}", plate.number);
  force.body = body;
  force.force = splined(series, 0);
  force.torque = splined(series, 3);
  force.point = body::LoadColumns{.splines = {}, .constant = R * plate.p_GP_m};
  return force;
}

}  // namespace

body::ExternalLoads plate_loads(const std::vector<recording::ForcePlate>& plates,
                                const Mat3& R_YG,
                                const body::BodyModel& model,
                                const std::vector<std::string>& bodies,
                                const std::optional<MarkerSeries>& markers,
                                double least_force_n,
                                std::optional<double> cutoff_hz) {
  if (plates.empty()) throw InvalidInput("there are no force plates that are understood");
  if (bodies.size() > plates.size()) {
    throw InvalidInput(
        fmt::format("force_plates: {} bodies for {} force plates; name one for each plate, \"\" where nobody stands",
                    bodies.size(), plates.size()));
  }
  if (bodies.empty() && !markers)
    throw InvalidInput(
        "force_plates: which body stands on a plate is told from markers, and the trial has none; name the bodies");
  body::ExternalLoads loads;
  for (std::size_t k = 0; k < plates.size(); ++k) {
    const recording::ForcePlate& plate = plates[k];
    if (plate.time_s.size() < 4) throw InvalidInput("force_plates: fewer than 4 samples");
    if (!bodies.empty() && (k >= bodies.size() || bodies[k].empty())) continue;
    const Wrench w = wrench_of(plate, R_YG, least_force_n);
    const std::vector<Contact> contacts = contacts_of(w, plate.time_s);
    if (contacts.empty()) {
      loads.notes.push_back(
          {.code = RemarkCode::reading,
           .severity = Severity::note,
           .says = fmt::format("force plate {} is never loaded with {} N", plate.number, least_force_n)});
      if (!bodies.empty()) (void)body_named(model, bodies[k]);
      continue;
    }
    std::map<body::BodyIndex, std::vector<Contact>> by_body;
    if (!bodies.empty()) {
      by_body[body_named(model, bodies[k])] = contacts;
    } else {
      for (const Contact& c : contacts) {
        const auto near = distances(model, *markers, w, plate.time_s, c);
        const auto best =
            std::ranges::min_element(near, [](const auto& a, const auto& b) { return a.second < b.second; });
        const double begin_s = plate.time_s[c.first];
        const double end_s = plate.time_s[c.end - 1];
        if (best == near.end() || best->second > kFarFromPlate_m) {
          throw InvalidInput(
              fmt::format("force plate {} bears up to {:.0f} N from {:.3g} to {:.3g} s, but no marker of the model is "
                          "within {} m of its center of pressure; name the bodies: force_plates = {{ bodies = [...] }}",
                          plate.number, w.force_n.middleRows(c.first, c.end - c.first).rowwise().norm().maxCoeff(),
                          begin_s, end_s, kFarFromPlate_m));
        }
        loads.notes.push_back(
            {.code = RemarkCode::reading,
             .severity = Severity::note,
             .says = fmt::format(
                 "force plate {} from {:.3g} to {:.3g} s is given to '{}', whose markers are {:.0f} mm from the "
                 "center of pressure",
                 plate.number, begin_s, end_s, model.bodies[static_cast<std::size_t>(best->first)].name,
                 1e3 * best->second)});
        by_body[best->first].push_back(c);
      }
    }
    for (const auto& [body, of_body] : by_body)
      loads.forces.push_back(force_of(plate, w, of_body, R_YG, body, cutoff_hz));
  }
  loads.start_s = plates[0].time_s[0];
  loads.end_s = plates[0].time_s[plates[0].time_s.size() - 1];
  return loads;
}

}  // namespace myoid::study
