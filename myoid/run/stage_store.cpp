#include "myoid/run/stage_store.h"

#include <cstring>

#include <nlohmann/json.hpp>

#include "myoid/ground/core/build_identity.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/core/json_text.h"
#include "myoid/ground/core/provenance.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/study/study_text.h"

namespace myoid::run {
namespace {

using nlohmann::json;
using Bytes = std::vector<std::uint8_t>;

/// Packs the bytes of the doubles, so that NaN and the last bit survive.
json packed(const double* values, Eigen::Index count) {
  Bytes bytes(static_cast<std::size_t>(count) * sizeof(double));
  if (count > 0) std::memcpy(bytes.data(), values, bytes.size());
  return json::binary(std::move(bytes));
}

Eigen::VectorXd unpacked(const json& value) {
  const Bytes& bytes = value.get_binary();
  Eigen::VectorXd values(static_cast<Eigen::Index>(bytes.size() / sizeof(double)));
  if (values.size() > 0)
    std::memcpy(values.data(), bytes.data(), static_cast<std::size_t>(values.size()) * sizeof(double));
  return values;
}

json to_json(const TimeSeries& series) {
  json channels = json::array();
  for (const Channel& c : series.channels()) channels.push_back({c.name, static_cast<int>(c.unit)});
  return {{"time", packed(series.time_s().data(), series.time_s().size())},
          {"channels", channels},
          {"values", packed(series.values().data(), series.values().size())}};
}

/// Returns the enumerator of a number. Throws InvalidInput for a number that is none's.
template <typename Enumeration>
Enumeration enumerator(int number, Enumeration last) {
  if (number < 0 || number > static_cast<int>(last)) throw InvalidInput("the stored enumerator is unknown");
  return static_cast<Enumeration>(number);
}

TimeSeries series_from(const json& value) {
  const Eigen::VectorXd time = unpacked(value.at("time"));
  std::vector<Channel> channels;
  for (const json& c : value.at("channels"))
    channels.push_back({c.at(0).get<std::string>(), enumerator(c.at(1).get<int>(), Unit::volt)});
  const Eigen::VectorXd flat = unpacked(value.at("values"));
  const auto columns = static_cast<Eigen::Index>(channels.size());
  if (flat.size() != time.size() * columns) throw InvalidInput("the stored size is wrong");
  const Eigen::Map<const Eigen::MatrixXd> values(flat.data(), time.size(), columns);
  return {time, std::move(channels), values};
}

}  // namespace

std::filesystem::path StageStore::file(const std::string& key) const { return folder_ / ("ik-" + key + ".cbor"); }

void StageStore::mark_used(const std::string& key) {
  const std::scoped_lock lock(mutex_);
  used_.insert(file(key).filename().string());
}

std::optional<body::IkResult> StageStore::find(const std::string& key) {
  const std::optional<std::string> bytes = recorded_content(file(key));
  if (!bytes) return std::nullopt;
  try {
    const json stored = json::from_cbor(*bytes);
    body::IkResult result;
    result.q = series_from(stored.at("q"));
    result.errors = series_from(stored.at("errors"));
    for (const int status : stored.at("status").get<std::vector<int>>())
      result.status.push_back(enumerator(status, body::FrameStatus::no_markers));
    const Eigen::VectorXd objective = unpacked(stored.at("objective"));
    result.objective.assign(objective.data(), objective.data() + objective.size());
    result.frames_not_converged = stored.at("frames_not_converged");
    result.frames_without_markers = stored.at("frames_without_markers");
    result.open_coordinates = stored.at("undetermined").get<std::vector<std::string>>();
    for (std::string text : stored.at("notes").get<std::vector<std::string>>())
      result.notes.push_back({.code = RemarkCode::reading, .severity = Severity::note, .says = std::move(text)});
    mark_used(key);
    return result;
  } catch (const json::exception&) {
    return std::nullopt;
  } catch (const InvalidInput&) {
    return std::nullopt;
  }
}

bool StageStore::is_damaged(const std::string& key) const { return standing_of(file(key)) == Standing::changed; }

void StageStore::keep(const std::string& key, const body::IkResult& result) {
  std::vector<int> status;
  status.reserve(result.status.size());
  for (const body::FrameStatus s : result.status) status.push_back(static_cast<int>(s));
  const json stored = {
      {"q", to_json(result.q)},
      {"errors", to_json(result.errors)},
      {"status", status},
      {"objective", packed(result.objective.data(), static_cast<Eigen::Index>(result.objective.size()))},
      {"frames_not_converged", result.frames_not_converged},
      {"frames_without_markers", result.frames_without_markers},
      {"undetermined", result.open_coordinates},
      {"notes", sentences(result.notes)},
  };
  const Bytes bytes = json::to_cbor(stored);
  try {
    write_file(file(key), {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    mark_used(key);
  } catch (const InvalidInput&) {
    return;
  }
}

void StageStore::remove_unused() {
  remove_results(folder_, used_);
  record_.finish();
}

std::string ik_key(const study::Study& study, std::string_view model_text, const MarkerSeries& markers) {
  const json settings = parse_json(study::study_json(study));
  std::string what = build_identity() + '\n' + sha256(model_text) + '\n';
  for (const char* section : {"model", "markers", "ik"}) what += json_text(settings.at(section), -1) + '\n';
  for (const std::string& name : markers.names) what += name + '\n';
  const auto add = [&what](const double* values, Eigen::Index count) {
    what.append(reinterpret_cast<const char*>(values), static_cast<std::size_t>(count) * sizeof(double));
  };
  add(markers.time_s.data(), markers.time_s.size());
  add(markers.positions_m.data(), markers.positions_m.size());
  return sha256(what);
}

}  // namespace myoid::run
