#include "myoid/body/model/path_contacts.h"

#include <Eigen/LU>

#include "myoid/body/model/wrap_surfaces.h"
#include "myoid/ground/core/index.h"

namespace myoid::body {
namespace {

using Mat6 = Eigen::Matrix<double, 6, 6>;

template <typename T>
std::optional<ContactOf<T>> contact_with(const WrapObject& object,
                                         WrapMethod method,
                                         const Vector3<T>& p_W,
                                         const Vector3<T>& q_W) {
  if (const auto* cylinder = std::get_if<CylinderShape>(&object.shape))
    return wrap_cylinder<T>(*cylinder, object.quadrant, p_W, q_W);
  if (const auto* sphere = std::get_if<SphereShape>(&object.shape))
    return wrap_sphere<T>(*sphere, object.quadrant, p_W, q_W);
  if (const auto* torus = std::get_if<TorusShape>(&object.shape))
    return wrap_torus<T>(*torus, object.quadrant, p_W, q_W);
  return wrap_ellipsoid<T>(std::get<EllipsoidShape>(object.shape), object.quadrant, method, p_W, q_W);
}

/// One contact, and the derivatives of its tangent points and arc by the ends of its straight pieces.
struct Sensitivity {
  std::size_t station = 0;  ///< Station of the first tangent point.
  Pose X_GW;
  Vec6 place;    ///< Tangent points for these ends, in the wrap's frame.
  Mat6 points;   ///< Their derivatives by (end before, end after), all in the wrap's frame.
  Vec6 arc;      ///< Derivatives of the arc's length by the ends.
  Vec6 tension;  ///< Derivatives of the straight pieces' length by the tangent points.
  Vec6 total;    ///< Derivatives of the length by the tangent points, effects on neighboring contacts
                 ///< included.
  Vec6 effect;   ///< Derivatives of the length by the ends, through this contact.
};

/// Returns every contact of the path, in order; a contact that is lost at the very edge of touching is left out.
std::vector<Sensitivity> contacts_of(const PosedPath& posed, const std::vector<PathStation>& stations) {
  const auto& [model, path, state] = posed;
  std::vector<Sensitivity> contacts;
  for (std::size_t i = 1; i + 2 < stations.size(); ++i) {
    if (!stations[i].on_wrap_after) continue;
    const PathWrap& wrap = path.wraps[at(stations[i].wrap)];
    const WrapObject& object = model.wrap_objects[at(wrap.wrap_object)];
    Sensitivity s;
    s.station = i;
    s.X_GW = state.X_GB[at(object.body)] * object.X_BW;
    const Pose X_WG = s.X_GW.inverse();
    const Vec3 p = X_WG * stations[i - 1].p_G;
    const Vec3 q = X_WG * stations[i + 2].p_G;
    Vector3<Jet6> pj, qj;
    for (int k = 0; k < 3; ++k) {
      pj[k] = Jet6(p[k], k);
      qj[k] = Jet6(q[k], k + 3);
    }
    const auto contact = contact_with<Jet6>(object, wrap.method, pj, qj);
    if (!contact) continue;
    for (int k = 0; k < 3; ++k) {
      s.points.row(k) = contact->first_W[k].v.transpose();
      s.points.row(k + 3) = contact->second_W[k].v.transpose();
    }
    s.place << value_of(contact->first_W), value_of(contact->second_W);
    s.arc = contact->arc_length_m.v;
    const Mat3 R_WG = X_WG.R;
    s.tension << R_WG * straight_direction(stations[i - 1], stations[i]),
        -(R_WG * straight_direction(stations[i + 1], stations[i + 2]));
    s.total = s.tension;
    contacts.push_back(s);
  }
  return contacts;
}

/// Returns true if contact k + 1 follows k without a point between them, so that each is the other's end.
bool are_neighbors(const std::vector<Sensitivity>& contacts, Eigen::Index k) {
  return contacts[at(k)].station + 2 == contacts[at(k + 1)].station;
}

}  // namespace

Vec3 straight_direction(const PathStation& a, const PathStation& b) {
  const Vec3 along = b.p_G - a.p_G;
  const double length = along.norm();
  return length > 0.0 ? Vec3(along / length) : Vec3::Zero();
}

std::optional<WrapContact> contact_over(const WrapObject& object, WrapMethod method, const Vec3& p_W, const Vec3& q_W) {
  return contact_with<double>(object, method, p_W, q_W);
}

void refine_contacts(const PosedPath& posed, PathWorkspace& workspace) {
  auto& stations = workspace.stations;
  const std::vector<Sensitivity> contacts = contacts_of(posed, stations);
  const auto n = static_cast<Eigen::Index>(contacts.size());
  Eigen::Index there = 0;
  for (const PathStation& s : stations) there += s.on_wrap_after ? 1 : 0;
  if (n < 2 || n != there) return;
  // Each contact's points x_k = f_k(x_k-1, x_k+1): (1 - df/dx) step = f(x) - x, in wrap frames.
  Eigen::MatrixXd left = Eigen::MatrixXd::Identity(6 * n, 6 * n);
  Eigen::VectorXd right(6 * n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const Sensitivity& s = contacts[at(k)];
    const Pose X_WG = s.X_GW.inverse();
    right.segment<6>(6 * k) = s.place;
    right.segment<3>(6 * k) -= X_WG * stations[s.station].p_G;
    right.segment<3>(6 * k + 3) -= X_WG * stations[s.station + 1].p_G;
    const auto couple = [&](Eigen::Index by, int own_end, int other_end) {
      const Mat3 turn = X_WG.R * contacts[at(by)].X_GW.R;
      left.block<6, 3>(6 * k, 6 * by + other_end) = -s.points.middleCols<3>(own_end) * turn;
    };
    if (k > 0 && are_neighbors(contacts, k - 1)) couple(k - 1, 0, 3);
    if (k + 1 < n && are_neighbors(contacts, k)) couple(k + 1, 3, 0);
  }
  const Eigen::VectorXd step = left.partialPivLu().solve(right);
  if (!step.allFinite()) return;
  for (Eigen::Index k = 0; k < n; ++k) {
    const Sensitivity& s = contacts[at(k)];
    stations[s.station].p_G += s.X_GW.R * step.segment<3>(6 * k);
    stations[s.station + 1].p_G += s.X_GW.R * step.segment<3>(6 * k + 3);
  }
}

void add_contact_motion(const PosedPath& posed, const std::vector<PathStation>& stations, Eigen::VectorXd& arm) {
  std::vector<Sensitivity> contacts = contacts_of(posed, stations);
  // The tangent points of a contact are the ends of its neighbors' straight pieces: all derivatives
  // are solved together.
  const auto n = static_cast<Eigen::Index>(contacts.size());
  if (n > 1) {
    Eigen::MatrixXd left = Eigen::MatrixXd::Identity(6 * n, 6 * n);
    Eigen::VectorXd right(6 * n);
    for (Eigen::Index k = 0; k < n; ++k) right.segment<6>(6 * k) = contacts[at(k)].tension;
    // The neighbor `by` acts on contact `of` through the effect on their common end.
    const auto couple = [&](Eigen::Index of, Eigen::Index by, int end_of, int end_by) {
      const Sensitivity& a = contacts[at(of)];
      const Sensitivity& b = contacts[at(by)];
      const Mat3 turn = a.X_GW.R.transpose() * b.X_GW.R;
      left.block<3, 6>(6 * of + end_of, 6 * by) = -turn * b.points.transpose().middleRows<3>(end_by);
      right.segment<3>(6 * of + end_of) += turn * b.arc.segment<3>(end_by);
    };
    for (Eigen::Index k = 0; k + 1 < n; ++k) {
      if (!are_neighbors(contacts, k)) continue;
      couple(k + 1, k, 0, 3);
      couple(k, k + 1, 3, 0);
    }
    const Eigen::VectorXd total = left.partialPivLu().solve(right);
    for (Eigen::Index k = 0; k < n; ++k) contacts[at(k)].total = total.segment<6>(6 * k);
  }
  for (Sensitivity& s : contacts) {
    s.effect = s.points.transpose() * s.total + s.arc;
    const PathStation& tangent = stations[s.station];
    const auto add = [&](const PathStation& end, const Vec3& by_end_W) {
      const Vec3 by_end_G = s.X_GW.R * by_end_W;
      add_pair_moment(posed.model, posed.state, tangent.body, end.p_G, end.body, end.p_G, by_end_G, arm);
      if (const PathPoint* point = moving_point(posed.path, end)) {
        for_each_moving_rate(posed, *point, false,
                             [&](int coordinate, const Vec3& rate) { arm[coordinate] -= by_end_G.dot(rate); });
      }
    };
    add(stations[s.station - 1], s.effect.head<3>());
    add(stations[s.station + 2], s.effect.tail<3>());
  }
}

}  // namespace myoid::body
