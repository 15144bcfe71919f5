#include "myoid/body/dynamics/external_loads.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "myoid/body/dynamics/load_units.h"
#include "myoid/body/kinematics/motion_plausibility.h"
#include "myoid/body/osim/osim_xml.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/core/nearest_word.h"
#include "myoid/ground/files/named_file.h"
#include "myoid/ground/files/text_file.h"
#include "myoid/recording/recording.h"
#include "myoid/recording/signals/clock_gaps.h"
#include "myoid/recording/tables/storage_reader.h"

namespace myoid::body {
namespace {

using body::OsimXml;

constexpr double kFarAway_m = 1000.0;

/// Returns the columns whose names begin with the identifier, in the file's order.
std::vector<Eigen::Index> columns_of(const TimeSeries& data, const std::string& identifier) {
  std::vector<Eigen::Index> columns;
  for (std::size_t c = 0; c < data.channels().size(); ++c) {
    if (data.channels()[c].name.starts_with(identifier)) columns.push_back(static_cast<Eigen::Index>(c));
  }
  return columns;
}

/// Returns the beginning of the names of a force's, point's or torque's columns. A <PrescribedForce>, the form of
/// documents before 20301, names columns by its functions: the column of x, or "#" and its number.
std::string identifier_of(const OsimXml& xml,
                          pugi::xml_node node,
                          const std::string& quantity,
                          const TimeSeries& data) {
  if (std::string_view(node.name()) == "ExternalForce") return xml.word(node, (quantity + "_identifier").c_str());
  const std::string set_name = quantity + "Functions";
  auto set = node.child(set_name.c_str());
  if (!set) set = node.find_child_by_attribute("name", set_name.c_str());
  if (const auto inner = set.child("FunctionSet")) set = inner;
  const auto function = OsimXml::first_element(set.child("objects"));
  std::string name = OsimXml::name_of(function);
  if (name.starts_with('#')) {
    const auto column = parse_number(name.substr(1));
    const auto count = static_cast<double>(data.channel_count());
    if (!column || !(*column >= 1.0 && *column <= count)) {
      xml.fail(function, fmt::format("PrescribedForce '{}': function '{}', expected #1 to #{}", OsimXml::name_of(node),
                                     name, count));
    }
    name = data.channels()[static_cast<std::size_t>(*column) - 1].name;
  }
  if (!name.empty()) name.pop_back();
  return name;
}

Eigen::MatrixX3d values_of(const OsimXml& xml,
                           pugi::xml_node node,
                           const std::string& quantity,
                           const TimeSeries& data,
                           const std::filesystem::path& file) {
  const std::string identifier = identifier_of(xml, node, quantity, data);
  if (identifier.empty() || identifier == "Unassigned") return {};
  const auto columns = columns_of(data, identifier);
  if (columns.size() != 3) {
    xml.fail(node,
             fmt::format("{} '{}': the {} identifier '{}' begins {} columns of {}, expected 3; its columns are {}",
                         node.name(), OsimXml::name_of(node), quantity, identifier, columns.size(), file.string(),
                         channel_names(data)));
  }
  Eigen::MatrixX3d values(data.sample_count(), 3);
  for (Eigen::Index k = 0; k < 3; ++k) values.col(k) = data.values().col(columns[static_cast<std::size_t>(k)]);
  return values;
}

/// Replaces points without meaning, where no load acts, by straight lines between points under load.
Eigen::Index mend_points(Eigen::MatrixX3d& point, const std::vector<bool>& is_loaded) {
  const auto bad = [&](Eigen::Index i) {
    return !point.row(i).allFinite() || (!is_loaded[static_cast<std::size_t>(i)] && point.row(i).norm() > kFarAway_m);
  };
  const Eigen::Index n = point.rows();
  Eigen::Index mended = 0;
  for (Eigen::Index i = 0; i < n;) {
    if (!bad(i)) {
      ++i;
      continue;
    }
    Eigen::Index end = i;
    while (end < n && bad(end)) ++end;
    const Eigen::RowVector3d zero = Eigen::RowVector3d::Zero();
    const Eigen::RowVector3d after = end < n ? Eigen::RowVector3d(point.row(end)) : zero;
    const Eigen::RowVector3d before = i > 0 ? Eigen::RowVector3d(point.row(i - 1)) : after;
    const Eigen::RowVector3d last = end < n ? after : before;
    for (Eigen::Index k = i; k < end; ++k, ++mended) {
      const double share = static_cast<double>(k - i + 1) / static_cast<double>(end - i + 1);
      point.row(k) = before + share * (last - before);
    }
    i = end;
  }
  return mended;
}

/// Clock of the data file; empty if the file has one row.
using Clock = std::optional<math::SplineKnots>;

LoadColumns fit(const Clock& clock, const Eigen::MatrixX3d& values) {
  if (clock) return LoadColumns::interpolate(*clock, values);
  return {.constant = values.row(0).transpose()};
}

body::BodyIndex body_named(const OsimXml& xml,
                           pugi::xml_node node,
                           const char* property,
                           const body::BodyModel& model) {
  std::string name = xml.word(node, property);
  if (const auto slash = name.rfind('/'); slash != std::string::npos) name.erase(0, slash + 1);
  if (name.empty() || name == "Unassigned") name = "ground";
  if (name == "ground") return 0;
  if (const auto body = model.find_body(name)) return *body;
  xml.fail(node, fmt::format("ExternalForce '{}': <{}> names '{}', which is no body of the model{}",
                             OsimXml::name_of(node), property, name, not_among(name, model.bodies, &body::Body::name)));
}

void check_finite(const Eigen::MatrixX3d& values,
                  const TimeSeries& data,
                  const std::string& what,
                  const std::filesystem::path& file) {
  for (Eigen::Index i = 0; i < values.rows(); ++i) {
    if (values.row(i).allFinite()) continue;
    throw InvalidInput(fmt::format("{}: the {} is not a number at {} s; fill the gap (0 where nothing is measured)",
                                   file.string(), what, data.time_s()[i]));
  }
}

ExternalForce read_force(const OsimXml& xml,
                         pugi::xml_node node,
                         const body::BodyModel& model,
                         const TimeSeries& data,
                         const Clock& clock,
                         const std::filesystem::path& file,
                         std::vector<Remark>& notes) {
  ExternalForce force;
  force.name = OsimXml::name_of(node);
  const bool is_old = std::string_view(node.name()) == "PrescribedForce";
  force.body = body_named(xml, node, is_old ? "body" : "applied_to_body", model);
  if (!is_old) {
    force.force_frame = body_named(xml, node, "force_expressed_in_body", model);
    force.point_frame = body_named(xml, node, "point_expressed_in_body", model);
  }
  const Eigen::MatrixX3d f = values_of(xml, node, "force", data, file);
  Eigen::MatrixX3d p = values_of(xml, node, "point", data, file);
  Eigen::MatrixX3d t = values_of(xml, node, "torque", data, file);
  if (f.rows() == 0 && t.rows() == 0) {
    xml.fail(node, fmt::format("{} '{}' names neither columns of a force nor of a torque", node.name(), force.name));
  }
  check_finite(f, data, "force of '" + force.name + "'", file);
  check_finite(t, data, "torque of '" + force.name + "'", file);
  for (const std::string& said : mend_load_units(f, p, t))
    notes.push_back({.code = RemarkCode::reading,
                     .severity = Severity::note,
                     .says = fmt::format("{}: '{}': {}", file.string(), force.name, said)});
  if (p.rows() > 0) {
    std::vector<bool> is_loaded(static_cast<std::size_t>(p.rows()), false);
    if (f.rows() > 0) {
      const Eigen::VectorXd size = f.rowwise().norm();
      // An empty plate's noise is up to a thousandth of the peak.
      const double least = 1e-3 * size.maxCoeff();
      for (Eigen::Index i = 0; i < size.size(); ++i) is_loaded[static_cast<std::size_t>(i)] = size[i] > least;
    }
    for (Eigen::Index i = 0; i < p.rows(); ++i) {
      if (is_loaded[static_cast<std::size_t>(i)] && !p.row(i).allFinite()) {
        throw InvalidInput(fmt::format("{}: the point of '{}' is not a number at {} s, while its force acts",
                                       file.string(), force.name, data.time_s()[i]));
      }
    }
    if (const Eigen::Index mended = mend_points(p, is_loaded); mended > 0) {
      notes.push_back(
          {.code = RemarkCode::reading,
           .severity = Severity::note,
           .says = fmt::format(
               "{}: the point of '{}' means nothing in {} rows where no force acts; straight lines between the "
               "others stand there",
               file.string(), force.name, mended)});
    }
    force.point = fit(clock, p);
  }
  if (p.rows() == 0 && f.rows() > 0 && !f.isZero(0.0) && force.body != 0) {
    notes.push_back(
        {.code = RemarkCode::reading,
         .severity = Severity::note,
         .says = fmt::format("{}: {}: '{}' names no point: its force acts at the origin of body '{}', as in OpenSim; "
                             "<point_identifier> names the columns of its point",
                             xml.path().string(), xml.place_of(node), force.name,
                             model.bodies[static_cast<std::size_t>(force.body)].name)});
  }
  if (f.rows() > 0) force.force = fit(clock, f);
  if (t.rows() > 0) force.torque = fit(clock, t);
  return force;
}

}  // namespace

LoadColumns LoadColumns::interpolate(const math::SplineKnots& knots, const Eigen::MatrixX3d& values) {
  LoadColumns columns;
  for (Eigen::Index k = 0; k < 3; ++k) columns.splines.push_back(knots.interpolate(values.col(k)));
  return columns;
}

Vec3 LoadColumns::at(double time_s) const {
  if (splines.empty()) return constant;
  return {splines[0].at(time_s).value, splines[1].at(time_s).value, splines[2].at(time_s).value};
}

double ExternalLoads::data_time_s(double motion_time_s) const {
  return (motion_time_s - offset_s) / (1.0 + 1e-6 * drift_ppm);
}

void ExternalLoads::set_clock(double offset, double drift) {
  const double first_s = data_time_s(start_s);
  const double last_s = data_time_s(end_s);
  offset_s = offset;
  drift_ppm = drift;
  start_s = first_s + offset + 1e-6 * drift * first_s;
  end_s = last_s + offset + 1e-6 * drift * last_s;
}

void ExternalLoads::append_wrenches(const body::BodyState& state,
                                    double motion_time_s,
                                    std::vector<body::BodyWrench>& wrenches) const {
  const double time_s = data_time_s(motion_time_s);
  for (const ExternalForce& force : forces) {
    if (force.body == 0) continue;
    const Pose& X_GB = state.X_GB[static_cast<std::size_t>(force.body)];
    const Mat3& R_GE = state.X_GB[static_cast<std::size_t>(force.force_frame)].R;
    body::BodyWrench wrench{force.body, Vec3::Zero(), Vec3::Zero()};
    if (force.force) {
      wrench.f_G = R_GE * force.force->at(time_s);
      if (force.point) {
        const Vec3 p_G = state.X_GB[static_cast<std::size_t>(force.point_frame)] * force.point->at(time_s);
        wrench.m_G = (p_G - X_GB.p).cross(wrench.f_G);
      }
    }
    if (force.torque) wrench.m_G += R_GE * force.torque->at(time_s);
    wrenches.push_back(wrench);
  }
}

ExternalLoads read_external_loads(const body::BodyModel& model, const std::filesystem::path& path) {
  const std::string text = read_text_file(path);
  OsimXml xml(text, path, OsimXml::Root::any);
  const auto set = xml.root().child("ExternalLoads");
  if (!set) {
    xml.fail(xml.root(), "expected <ExternalLoads>; this is another kind of file (give the .xml, not the data)");
  }
  xml.set_prototypes(set.child("defaults"));
  const std::string name = xml.word(set, "datafile");
  if (name.empty() || name == "Unassigned") {
    xml.fail(set, "expected <datafile> with the measured loads (.mot, .sto)");
  }
  const NamedFile named = find_named_file(path.parent_path(), name);
  if (!named.exists) {
    xml.fail(set.child("datafile"),
             fmt::format("<datafile> names '{}', and {}", name, missing_file(path.parent_path(), name)));
  }
  const std::filesystem::path& file = named.path;
  const recording::Storage table = recording::read_storage(file);
  const TimeSeries& data = table.data;
  if (data.empty()) throw InvalidInput(fmt::format("{}: there are no rows", file.string()));
  if (const std::string slow = slow_clock(data.time_s()); !slow.empty()) throw ReadError(file, 0, slow);
  ExternalLoads loads;
  for (const auto* sentences : {&xml.repairs(), &xml.ignored()})
    for (const std::string& sentence : *sentences)
      loads.notes.push_back({.code = RemarkCode::reading,
                             .severity = Severity::note,
                             .says = fmt::format("{}: {}", path.string(), sentence)});
  if (!named.note.empty())
    loads.notes.push_back({.code = RemarkCode::reading,
                           .severity = Severity::note,
                           .says = fmt::format("{}: <datafile>: {}", path.string(), named.note)});
  for (const Repair& repair : table.repairs)
    loads.notes.push_back(recording::remark_of(repair, recording::to_string(file, repair)));
  if (const recording::ClockGaps gaps = recording::find_clock_gaps(data.time_s()); gaps.count > 0)
    loads.notes.push_back(
        {.code = RemarkCode::clock_pause,
         .says = fmt::format("{}: {} in its clock, bridged by a spline", file.filename().string(), gaps.text())});
  loads.start_s = data.time_s()[0];
  loads.end_s = data.time_s()[data.sample_count() - 1];
  Clock clock;
  if (data.sample_count() > 1) loads.rate_hz = data.mean_rate_hz();
  if (data.sample_count() > 1) clock.emplace(data.time_s(), data.sample_count() >= 4 ? 3 : 1);
  for (const auto node : OsimXml::objects(set)) {
    const std::string_view kind = node.name();
    const bool is_old = kind == "PrescribedForce";
    if (kind != "ExternalForce" && !is_old) xml.fail(node, fmt::format("expected <ExternalForce>, found <{}>", kind));
    if (xml.flag(node, "isDisabled", false) || !xml.flag(node, "appliesForce", true)) {
      loads.notes.push_back({.code = RemarkCode::reading,
                             .severity = Severity::note,
                             .says = fmt::format("{}: '{}' is switched off", path.string(), OsimXml::name_of(node))});
      continue;
    }
    constexpr int kFirstOfExternalForces = 20301;
    if (is_old && xml.version() >= kFirstOfExternalForces) {
      loads.notes.push_back(
          {.code = RemarkCode::reading,
           .severity = Severity::note,
           .says = fmt::format(
               "{}: '{}' is a PrescribedForce, as in documents before {}, and acts as there; OpenSim converts "
               "it only where the document's version ({}) is before that",
               path.string(), OsimXml::name_of(node), kFirstOfExternalForces, xml.version())});
    }
    loads.forces.push_back(read_force(xml, node, model, data, clock, file, loads.notes));
  }
  if (loads.forces.empty())
    loads.notes.push_back({.code = RemarkCode::reading,
                           .severity = Severity::note,
                           .says = fmt::format("{}: no external force acts", path.string())});
  return loads;
}

}  // namespace myoid::body
