#include "myoid/body/kinematics/limb_fit.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "myoid/body/kinematics/joint_angles.h"
#include "myoid/ground/core/index.h"
#include "myoid/ground/math/sobol.h"

namespace myoid::body {
namespace {

constexpr Eigen::Index kMostPostures = 256;  ///< Of a table.
constexpr Eigen::Index kMostAssembled = 64;  ///< The same where constraints must be met.
constexpr std::size_t kStarts = 16;          ///< Postures of the table from which a limb is searched,
constexpr int kFirstSteps = 4;               ///< so far,
constexpr std::size_t kSemifinalists = 10;   ///< so many on,
constexpr std::size_t kFinalists = 5;        ///< and so many of these by the whole model.
constexpr int kLastSteps = 30;
constexpr double kMet_rad = 0.05;  ///< Searches that are nearer to each other go to one minimum.
constexpr double kElsewhere_rad = 0.02;
constexpr double kPerfect_m2 = 1e-12;  ///< A part of 2 J that no posture needs to lower.

bool floats(const body::BodyModel& model, const body::Joint& joint) {
  int free = 0;
  for (const body::TransformAxis& axis : joint.translation)
    if (axis.coordinate >= 0 && !model.is_constrained(axis.coordinate)) ++free;
  return joint.parent == 0 && free == 3;
}

/// Returns the bodies that carry a marker that counts, themselves or by the bodies that hang from them.
std::vector<bool> marker_carriers(const body::BodyModel& model, const std::vector<PoseFit::Pair>& pairs) {
  std::vector<bool> carries(model.bodies.size(), false);
  for (const PoseFit::Pair& pair : pairs)
    if (pair.weight > 0.0) carries[at(model.markers[pair.model].body)] = true;
  for (std::size_t j = model.joints.size(); j-- > 0;)
    if (carries[at(model.joints[j].child)]) carries[at(model.joints[j].parent)] = true;
  return carries;
}

int branches_of(const body::BodyModel& model, int body, const std::vector<bool>& carries) {
  return static_cast<int>(std::count_if(model.joints.begin(), model.joints.end(), [&](const body::Joint& joint) {
    return joint.parent == body && carries[at(joint.child)];
  }));
}

bool begins_limb(const body::BodyModel& model, std::size_t joint, const std::vector<bool>& carries) {
  const body::Joint& j = model.joints[joint];
  if (!carries[at(j.child)]) return false;
  if (j.parent == 0) return !floats(model, j);
  const int above = model.joint_of_body[at(j.parent)];
  return floats(model, model.joints[at(above)]) || branches_of(model, j.parent, carries) > 1;
}

}  // namespace

LimbFit::LimbFit(const body::BodyModel& whole,
                 std::size_t first_joint,
                 const IkOptions& options,
                 const std::vector<PoseFit::Pair>& pairs)
    : options_{.max_iterations = kLastSteps} {
  const std::vector<bool> carries = marker_carriers(whole, pairs);
  add_bodies(whole, first_joint, carries);
  add_coordinates(whole);
  add_constraints(whole);
  choose_varied(whole, first_joint, carries);
  std::vector<PoseFit::Pair> own;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const body::Marker& marker = whole.markers[pairs[i].model];
    const int body = limb_body_[at(marker.body)];
    if (body < 0 || marker.body == base_ || pairs[i].weight == 0.0) continue;
    own.push_back({model_.markers.size(), pairs[i].file, pairs[i].weight});
    model_.markers.push_back({marker.name, body, marker.p_BM});
    pairs_of_whole_.push_back(i);
  }
  for (const CoordinateTask& task : options.tasks)
    if (model_.find_coordinate(task.coordinate)) options_.tasks.push_back(task);
  fit_ = std::make_unique<PoseFit>(model_, options_, std::move(own));
}

void LimbFit::add_bodies(const body::BodyModel& whole, std::size_t first_joint, const std::vector<bool>& carries) {
  const body::Joint& first = whole.joints[first_joint];
  base_ = first.parent;
  limb_body_.assign(whole.bodies.size(), -1);
  limb_body_[0] = 0;
  model_.gravity_G = whole.gravity_G;
  model_.bodies.push_back(whole.bodies[0]);
  model_.joint_of_body.push_back(-1);
  const auto add = [&](body::Joint joint, int parent) {
    limb_body_[at(joint.child)] = static_cast<int>(model_.bodies.size());
    model_.bodies.push_back(whole.bodies[at(joint.child)]);
    model_.joint_of_body.push_back(static_cast<int>(model_.joints.size()));
    joint.parent = parent;
    joint.child = limb_body_[at(joint.child)];
    model_.joints.push_back(std::move(joint));
  };
  if (base_ != 0) {
    body::Joint weld;
    weld.name = "base";
    weld.class_name = "WeldJoint";
    weld.child = base_;
    add(std::move(weld), 0);
  }
  for (std::size_t j = first_joint; j < whole.joints.size(); ++j) {
    const body::Joint& joint = whole.joints[j];
    const bool below = joint.parent != base_ && joint.parent != 0 && limb_body_[at(joint.parent)] >= 0;
    if ((j == first_joint || below) && carries[at(joint.child)]) add(joint, limb_body_[at(joint.parent)]);
  }
}

void LimbFit::add_coordinates(const body::BodyModel& whole) {
  limb_coordinate_.assign(whole.coordinates.size(), -1);
  for (std::size_t c = 0; c < whole.coordinates.size(); ++c) {
    const body::Coordinate& coordinate = whole.coordinates[c];
    const int child = whole.joints[at(coordinate.joint)].child;
    if (limb_body_[at(child)] < 0 || child == base_) continue;
    limb_coordinate_[c] = static_cast<int>(model_.coordinates.size());
    whole_coordinate_.push_back(static_cast<Eigen::Index>(c));
    model_.coordinates.push_back(coordinate);
    model_.coordinates.back().joint = model_.joint_of_body[at(limb_body_[at(child)])];
  }
  const auto renumber = [&](int& c) { c = c < 0 ? c : limb_coordinate_[at(c)]; };
  for (body::Joint& joint : model_.joints) {
    for (int& c : joint.coordinates) renumber(c);
    for (body::TransformAxis& axis : joint.rotation) renumber(axis.coordinate);
    for (body::TransformAxis& axis : joint.translation) renumber(axis.coordinate);
  }
}

/// Keeps the constraints within the limb and its base. A coordinate that follows one of another limb stands still.
void LimbFit::add_constraints(const body::BodyModel& whole) {
  for (body::CoordinateCoupler coupler : whole.couplers) {
    coupler.dependent = limb_coordinate_[at(coupler.dependent)];
    coupler.independent = limb_coordinate_[at(coupler.independent)];
    if (coupler.dependent < 0) continue;
    if (coupler.independent < 0) {
      model_.coordinates[at(coupler.dependent)].locked = true;
    } else {
      model_.couplers.push_back(std::move(coupler));
    }
  }
  for (body::LoopConstraint constraint : whole.constraints) {
    bool within = true;
    const auto renumber = [&](int& index, const std::vector<int>& here) {
      index = here[at(index)];
      within = within && index >= 0;
    };
    std::visit(
        [&](auto& law) {
          if constexpr (requires { law.body1; }) {
            renumber(law.body1, limb_body_);
            renumber(law.body2, limb_body_);
          } else if constexpr (requires { law.coupler; }) {
            renumber(law.coupler.dependent, limb_coordinate_);
            renumber(law.coupler.independent, limb_coordinate_);
          } else {
            renumber(law.dependent, limb_coordinate_);
            for (int& c : law.independent) renumber(c, limb_coordinate_);
          }
        },
        constraint.law);
    if (within) model_.constraints.push_back(std::move(constraint));
  }
}

void LimbFit::choose_varied(const body::BodyModel& whole, std::size_t first_joint, const std::vector<bool>& carries) {
  int body = whole.joints[first_joint].child;
  for (;;) {
    for (const int c : whole.joints[at(whole.joint_of_body[at(body)])].coordinates) {
      const int here = limb_coordinate_[at(c)];
      if (here < 0 || whole.is_constrained(c) || model_.coordinates[at(here)].locked) continue;
      if (turns(whole.joints[at(whole.joint_of_body[at(body)])], c)) varied_.push_back(at(here));
    }
    if (branches_of(whole, body, carries) != 1) return;
    for (const body::Joint& joint : whole.joints)
      if (joint.parent == body && carries[at(joint.child)]) {
        body = joint.child;
        break;
      }
  }
}

std::vector<Eigen::Index> LimbFit::turning() const {
  std::vector<Eigen::Index> turning;
  for (const std::size_t v : varied_) turning.push_back(whole_coordinate_[v]);
  return turning;
}

void LimbFit::stand(const PoseFit& whole, const Eigen::VectorXd& q, const MarkerSeries& markers, Eigen::Index frame) {
  if (base_ != 0) model_.joints[0].X_PF = whole.state().X_GB[at(base_)];
  for (std::size_t c = 0; c < whole_coordinate_.size(); ++c)
    if (model_.coordinates[c].locked) model_.coordinates[c].default_value = q[whole_coordinate_[c]];
  fit_->forget_posture();
  fit_->set_targets(markers, frame);
  fit_->set_scale(whole.scale());
}

/// Fills the ranges of the varied coordinates evenly; the others have their default values.
void LimbFit::make_table() {
  const auto varied = static_cast<Eigen::Index>(std::min<std::size_t>(varied_.size(), math::kSobolMaxDimensions));
  Eigen::Index count = 8;
  for (Eigen::Index i = 0; i < varied && count < kMostPostures; ++i) count *= 3;
  count = std::min(count, model_.constraints.empty() ? kMostPostures : kMostAssembled);
  const Eigen::MatrixXd shares = math::sobol_points(count, static_cast<int>(varied), {.first = 1});
  Eigen::MatrixXd postures = model_.default_q().transpose().replicate(count, 1);
  for (Eigen::Index v = 0; v < varied; ++v) {
    const auto c = static_cast<Eigen::Index>(varied_[at(v)]);
    const body::Coordinate& of = model_.coordinates[at(c)];
    const double width = of.upper - of.lower;
    const bool ranged = width > 0.0 && width < 2.0 * kPi;
    const double lower = ranged ? of.lower : of.default_value - kPi;
    postures.col(c) = lower + shares.col(v).array() * (ranged ? width : 2.0 * kPi);
  }
  Eigen::MatrixXd places(count, static_cast<Eigen::Index>(3 * pairs_of_whole_.size()));
  const myoid::Pose to_base = base().inverse();
  for (Eigen::Index row = 0; row < count; ++row) {
    (void)fit_->place_within(postures.row(row).transpose());
    fit_->locate(places, row);
    for (Eigen::Index m = 0; m < places.cols(); m += 3)
      places.block<1, 3>(row, m) = (to_base * Vec3(places.block<1, 3>(row, m).transpose())).transpose();
  }
  table_.emplace(std::move(postures), places);
}

/// Returns the targets of the frame as the base sees them.
std::vector<PostureTable::Target> LimbFit::targets() const {
  std::vector<PostureTable::Target> targets(fit_->pairs().size());
  const myoid::Pose to_base = base().inverse();
  for (std::size_t i = 0; i < targets.size(); ++i)
    if (const auto& target = fit_->target(i)) targets[i] = {to_base * *target, fit_->pairs()[i].weight};
  return targets;
}

/// Keeps the searches with the least cost, one of those that meet.
void LimbFit::keep_best(std::vector<PoseFit::Search>& searches, std::size_t count) {
  std::sort(searches.begin(), searches.end(),
            [](const PoseFit::Search& a, const PoseFit::Search& b) { return a.pose.cost < b.pose.cost; });
  std::vector<PoseFit::Search> kept;
  for (PoseFit::Search& search : searches) {
    if (kept.size() >= count) break;
    const bool met = std::any_of(kept.begin(), kept.end(), [&](const PoseFit::Search& other) {
      return (search.pose.q - other.pose.q).cwiseAbs().maxCoeff() < kMet_rad;
    });
    if (!met) kept.push_back(std::move(search));
  }
  searches = std::move(kept);
}

/// Returns searches on their way from postures of the table and from the other angles of joints that lie at an end of a
/// range.
std::vector<PoseFit::Search> LimbFit::set_out(const Eigen::VectorXd& q) {
  if (!table_) make_table();
  std::vector<PoseFit::Search> searches;
  const auto add = [&](Eigen::VectorXd start) {
    searches.push_back(fit_->begin(std::move(start)));
    fit_->advance(searches.back(), kFirstSteps);
  };
  for (const Eigen::Index row : table_->minima(targets(), kStarts)) {
    Eigen::VectorXd start = q;
    const Eigen::VectorXd posture = table_->posture(row);
    for (const std::size_t v : varied_) start[static_cast<Eigen::Index>(v)] = posture[static_cast<Eigen::Index>(v)];
    add(std::move(start));
  }
  for (const body::Joint& joint : model_.joints) {
    const bool at_end = std::any_of(joint.coordinates.begin(), joint.coordinates.end(),
                                    [&](int c) { return lies_at_end(model_.coordinates[at(c)], q[c]); });
    if (!at_end) continue;
    for (Eigen::VectorXd& twin : twin_angles(model_, joint, q)) add(std::move(twin));
  }
  return searches;
}

/// Brings angles into their ranges by whole turns and by the other angles of a joint; returns false if one strays
/// still.
bool LimbFit::bring_into_ranges(PoseFit::Pose& pose, const Eigen::VectorXd& here) {
  fit_->unwind(pose);
  if (!strays(model_, pose.q, here)) return true;
  for (const body::Joint& joint : model_.joints) {
    for (Eigen::VectorXd& twin : twin_angles(model_, joint, pose.q)) {
      const bool same = std::abs(fit_->place(twin) - pose.cost) <= 1e-9 * pose.cost + kPerfect_m2;
      if (!same || strays(model_, twin, here)) continue;
      pose.q = std::move(twin);
      return true;
    }
  }
  return false;
}

std::vector<Eigen::VectorXd> LimbFit::other_postures(const Eigen::VectorXd& q, double share) {
  const Eigen::VectorXd here = q(whole_coordinate_);
  const double cost = fit_->place(here);
  if (cost < kPerfect_m2) return {};
  std::vector<PoseFit::Search> searches = set_out(here);
  keep_best(searches, kSemifinalists);
  for (PoseFit::Search& search : searches) fit_->advance(search, kLastSteps);
  keep_best(searches, kFinalists);
  std::vector<Eigen::VectorXd> others;
  for (PoseFit::Search& search : searches) {
    const bool elsewhere = (search.pose.q - here).cwiseAbs().maxCoeff() > kElsewhere_rad;
    if (search.pose.cost > share * cost || !elsewhere || !bring_into_ranges(search.pose, here)) continue;
    others.push_back(q);
    others.back()(whole_coordinate_) = search.pose.q;
  }
  return others;
}

std::vector<std::unique_ptr<LimbFit>> limbs_of(const body::BodyModel& model,
                                               const IkOptions& options,
                                               const std::vector<PoseFit::Pair>& pairs) {
  std::vector<std::unique_ptr<LimbFit>> limbs;
  const std::vector<bool> carries = marker_carriers(model, pairs);
  for (std::size_t j = 0; j < model.joints.size(); ++j) {
    if (!begins_limb(model, j, carries)) continue;
    auto limb = std::make_unique<LimbFit>(model, j, options, pairs);
    if (limb->can_move()) limbs.push_back(std::move(limb));
  }
  return limbs;
}

}  // namespace myoid::body
