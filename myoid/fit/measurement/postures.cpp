#include "myoid/fit/measurement/postures.h"

#include <algorithm>
#include <cmath>

#include "myoid/ground/core/units.h"

namespace myoid::fit {
namespace {

constexpr double kAngleStep_rad = 4.0 * kDegree;
constexpr double kLengthSteps = 30.0;  // steps over a muscle's recorded lengths
constexpr std::size_t kMostSamples = 4000;

/// The samples of one trial at one joint, n.
struct View {
  Eigen::VectorXd angle_rad, velocity_radps;  ///< n, or empty.
  Eigen::MatrixXd length_m, arm_m;            ///< n x muscles
};

/// Returns the joint's samples of the trials that have moment arms there, at most kMostSamples of each.
std::vector<View> views_of(const StudyData& data, const std::string& joint) {
  std::vector<View> views;
  const auto add = [&](const TrialData& trial, const JointData& of) {
    const Eigen::Index n = trial.time_s.size();
    std::vector<Eigen::Index> rows = included_rows(trial);
    if (of.joint != joint || of.moment_arm_m.rows() != n || rows.empty()) return;
    const std::size_t stride = 1 + rows.size() / kMostSamples;
    std::vector<Eigen::Index> kept;
    for (std::size_t i = 0; i < rows.size(); i += stride) kept.push_back(rows[i]);
    const auto picked = [&](const Eigen::VectorXd& x) {
      return x.size() == n ? Eigen::VectorXd(x(kept)) : Eigen::VectorXd();
    };
    views.push_back({picked(of.angle_rad), picked(of.velocity_radps), trial.length_m(kept, Eigen::all),
                     of.moment_arm_m(kept, Eigen::all)});
  };
  for (const TrialData& trial : data.trials) {
    for (std::size_t j = 0; trial.calibration && j < joint_count(trial); ++j) add(trial, joint_at(trial, j));
  }
  return views;
}

/// Means of the samples in bins of one width.
struct Bins {
  double first = 0.0, width = 1.0;
  Eigen::VectorXd samples;          ///< Per bin.
  Eigen::VectorXd place;            ///< Per bin: mean.
  Eigen::MatrixXd length_m, arm_m;  ///< bins x muscles: means.

  [[nodiscard]] Eigen::Index of(double value) const {
    const auto bin = static_cast<Eigen::Index>(std::floor((value - first) / width));
    return std::clamp<Eigen::Index>(bin, 0, samples.size() - 1);
  }
};

Bins bins_of(const std::vector<View>& views, const std::vector<Eigen::VectorXd>& places, double width) {
  double low = places.front().minCoeff(), high = places.front().maxCoeff();
  for (const Eigen::VectorXd& of_view : places) {
    low = std::min(low, of_view.minCoeff());
    high = std::max(high, of_view.maxCoeff());
  }
  const Eigen::Index count = std::max<Eigen::Index>(1, std::lround((high - low) / width)),
                     muscles = views.front().length_m.cols();
  Bins bins{.first = low,
            .width = std::max((high - low) / static_cast<double>(count), 1e-12),
            .samples = Eigen::VectorXd::Zero(count),
            .place = Eigen::VectorXd::Zero(count),
            .length_m = Eigen::MatrixXd::Zero(count, muscles),
            .arm_m = Eigen::MatrixXd::Zero(count, muscles)};
  for (std::size_t v = 0; v < views.size(); ++v) {
    for (Eigen::Index i = 0; i < places[v].size(); ++i) {
      const Eigen::Index bin = bins.of(places[v][i]);
      bins.samples[bin] += 1.0;
      bins.place[bin] += places[v][i];
      bins.length_m.row(bin) += views[v].length_m.row(i);
      bins.arm_m.row(bin) += views[v].arm_m.row(i);
    }
  }
  for (Eigen::Index bin = 0; bin < count; ++bin) {
    if (bins.samples[bin] == 0.0) continue;
    bins.place[bin] /= bins.samples[bin];
    bins.length_m.row(bin) /= bins.samples[bin];
    bins.arm_m.row(bin) /= bins.samples[bin];
  }
  return bins;
}

/// Fills the even places, the edges of the bins, from the bins that have samples.
void interpolate(const Bins& bins, Postures& postures) {
  std::vector<Eigen::Index> filled;
  for (Eigen::Index bin = 0; bin < bins.samples.size(); ++bin)
    if (bins.samples[bin] > 0.0) filled.push_back(bin);
  const bool one = filled.size() < 2;
  const Eigen::Index count = one ? 1 : bins.samples.size() + 1, muscles = bins.length_m.cols();
  postures.place =
      Eigen::VectorXd::LinSpaced(count, bins.first, bins.first + bins.width * static_cast<double>(bins.samples.size()));
  if (one) postures.place[0] = bins.place[filled.front()];
  postures.length_m.resize(count, muscles);
  postures.arm_m.resize(count, muscles);
  std::size_t before = 0;
  for (Eigen::Index i = 0; i < count; ++i) {
    const double at = postures.place[i];
    while (before + 2 < filled.size() && bins.place[filled[before + 1]] < at) ++before;
    const Eigen::Index left = filled[before], right = filled[std::min(before + 1, filled.size() - 1)];
    const double apart = bins.place[right] - bins.place[left];
    const double share = apart > 0.0 ? (at - bins.place[left]) / apart : 0.0;  // beyond the outer bins, too
    postures.length_m.row(i) = (1.0 - share) * bins.length_m.row(left) + share * bins.length_m.row(right);
    postures.arm_m.row(i) = (1.0 - share) * bins.arm_m.row(left) + share * bins.arm_m.row(right);
  }
}

/// Returns the scatter of the lengths about those of their bin, less what the angle makes within the bin, r = -dl/dq.
Eigen::VectorXd scatter_m(const std::vector<View>& views,
                          const std::vector<Eigen::VectorXd>& places,
                          const Bins& bins) {
  Eigen::ArrayXd squares = Eigen::ArrayXd::Zero(bins.length_m.cols());
  for (std::size_t v = 0; v < views.size(); ++v) {
    for (Eigen::Index i = 0; i < places[v].size(); ++i) {
      const Eigen::Index bin = bins.of(places[v][i]);
      const auto expected = bins.length_m.row(bin) - bins.arm_m.row(bin) * (places[v][i] - bins.place[bin]);
      squares += (views[v].length_m.row(i) - expected).array().square().transpose();
    }
  }
  return (squares / bins.samples.sum()).sqrt().matrix();
}

}  // namespace

Postures postures(const StudyData& data, const std::string& joint, std::size_t muscle) {
  std::vector<View> views = views_of(data, joint);
  const auto has_angle = [](const View& view) { return view.angle_rad.size() > 0; };
  Postures found{.over_angle = std::any_of(views.begin(), views.end(), has_angle)};
  if (found.over_angle) std::erase_if(views, [&](const View& view) { return !has_angle(view); });
  if (views.empty()) return found;
  std::vector<Eigen::VectorXd> places;
  double shortest = 1e9, longest = -1e9;
  for (const View& view : views) {
    places.push_back(found.over_angle ? view.angle_rad
                                      : Eigen::VectorXd(view.length_m.col(static_cast<Eigen::Index>(muscle))));
    shortest = std::min(shortest, places.back().minCoeff());
    longest = std::max(longest, places.back().maxCoeff());
    if (view.velocity_radps.size() == 0) continue;
    found.fastest_radps = std::max(found.fastest_radps, view.velocity_radps.maxCoeff());
    found.fastest_back_radps = std::max(found.fastest_back_radps, -view.velocity_radps.minCoeff());
  }
  const double width = found.over_angle ? kAngleStep_rad : std::max((longest - shortest) / kLengthSteps, 1e-4);
  const Bins bins = bins_of(views, places, width);
  interpolate(bins, found);
  found.scatter_m = found.over_angle ? scatter_m(views, places, bins) : Eigen::VectorXd::Zero(bins.length_m.cols());
  return found;
}

}  // namespace myoid::fit
