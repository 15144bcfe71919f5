// A virtual recording beside a real one: raw EMG, envelope, spectrum and angle of ten seconds each,
// as a figure, and what can be counted of them, as a table. Both go through the same functions.
//
//   beside_a_recording ANGLE_A EMG_A FROM_S  ANGLE_B EMG_B FROM_S  OUT.svg
//
// Angles are the first channel of a .mot or .sto file; of the EMG the channels that look for the
// biceps, the brachioradialis and the triceps are taken.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/units.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/page/report.h"
#include "myoid/page/svg_plot.h"
#include "myoid/recording/emg_reader.h"
#include "myoid/recording/signals/emg_envelope.h"
#include "myoid/recording/signals/spectrum.h"
#include "myoid/recording/tables/storage_reader.h"

namespace {

using myoid::TimeSeries;
namespace page = myoid::page;
namespace recording = myoid::recording;

constexpr double kWindow_s = 10.0;
constexpr double kMicrovolt = 1e6;

struct Muscle {
  std::string_view name;
  std::array<std::string_view, 2> channels;  ///< What a channel's name may begin with.
};
constexpr std::array<Muscle, 3> kMuscles = {
    {{"biceps", {"BIC", "biceps"}}, {"brachioradialis", {"BRD", "brachiorad"}}, {"triceps", {"TRI", "triceps"}}}};

/// One side of the figure.
struct Side {
  std::string title;
  double from_s = 0.0;
  TimeSeries angle;
  recording::EmgStages emg;
  std::array<std::size_t, 3> channel{};
};

std::size_t channel_of(const TimeSeries& emg, const Muscle& muscle) {
  for (std::size_t c = 0; c < emg.channels().size(); ++c) {
    for (const std::string_view start : muscle.channels) {
      if (emg.channels()[c].name.starts_with(start)) return c;
    }
  }
  throw myoid::InvalidInput(fmt::format("no EMG channel for the {}", muscle.name));
}

Side read_side(std::string title, const char* angle, const char* emg, const char* from_s) {
  Side side;
  side.title = std::move(title);
  side.from_s = std::strtod(from_s, nullptr);
  const myoid::recording::Storage storage = myoid::recording::read_storage(angle);
  side.angle = myoid::recording::to_si(storage, [](const std::string&) { return true; });
  side.emg = recording::process_emg(myoid::recording::read_emg(emg, "", false).data);
  for (std::size_t m = 0; m < kMuscles.size(); ++m) side.channel[m] = channel_of(side.emg.raw, kMuscles[m]);
  return side;
}

/// The window's samples of a column, times on the window's own clock.
page::Series window(const TimeSeries& series,
                    std::size_t channel,
                    double from_s,
                    double scale,
                    const std::string& name,
                    page::Role role) {
  page::Series curve{.name = name, .role = role};
  for (Eigen::Index k = 0; k < series.sample_count(); ++k) {
    const double t = series.time_s()(k) - from_s;
    if (t < 0.0 || t >= kWindow_s) continue;
    curve.x.push_back(t);
    curve.y.push_back(scale * series.values()(k, static_cast<Eigen::Index>(channel)));
  }
  return curve;
}

/// The window's EMG itself, as the amplifier gave it.
Eigen::VectorXd raw_window(const Side& side, std::size_t muscle) {
  const page::Series curve = window(side.emg.raw, side.channel[muscle], side.from_s, 1.0, "", page::Role::raw);
  return Eigen::Map<const Eigen::VectorXd>(curve.y.data(), static_cast<Eigen::Index>(curve.y.size()));
}

void add_row(page::Figure& figure,
             const std::array<Side, 2>& sides,
             const page::Axis& x,
             const page::Axis& y,
             const auto& series_of) {
  for (const Side& side : sides) {
    page::Panel panel{.title = side.title + ": " + y.label, .x = x, .y = y};
    panel.series = series_of(side);
    figure.panels.push_back(std::move(panel));
  }
}

page::Figure figure_of(const std::array<Side, 2>& sides) {
  page::Figure figure{
      .id = "beside_a_recording", .title = "Ten seconds of a person and of a virtual one", .columns = 2};
  const page::Axis time{.label = "time", .unit = "s", .lower = 0.0, .upper = kWindow_s};
  add_row(figure, sides, time, {.label = "elbow flexion", .unit = "deg"}, [](const Side& side) {
    return std::vector{window(side.angle, 0, side.from_s, 1.0 / myoid::kDegree, "", page::Role::reference)};
  });
  for (std::size_t m = 0; m < kMuscles.size(); ++m) {
    add_row(figure, sides, time, {.label = fmt::format("raw EMG, {}", kMuscles[m].name), .unit = "µV"},
            [m](const Side& side) {
              return std::vector{window(side.emg.raw, side.channel[m], side.from_s, kMicrovolt, "", page::Role::truth)};
            });
  }
  constexpr std::array<page::Role, 3> kRoles = {page::Role::reference, page::Role::identified, page::Role::literature};
  add_row(figure, sides, time, {.label = "envelope over its maximum"}, [&](const Side& side) {
    std::vector<page::Series> curves;
    for (std::size_t m = 0; m < kMuscles.size(); ++m) {
      const double most = side.emg.envelope.values().col(static_cast<Eigen::Index>(side.channel[m])).maxCoeff();
      curves.push_back(window(side.emg.envelope, side.channel[m], side.from_s, 1.0 / most,
                              std::string(kMuscles[m].name), kRoles[m]));
    }
    return curves;
  });
  add_row(figure, sides, {.label = "frequency", .unit = "Hz", .lower = 0.0, .upper = 400.0},
          {.label = "power per Hz over all of it"}, [&](const Side& side) {
            std::vector<page::Series> curves;
            for (std::size_t m = 0; m < kMuscles.size(); ++m) {
              const recording::PowerSpectrum spectrum =
                  recording::power_spectrum(raw_window(side, m), side.emg.raw.mean_rate_hz(), 0.25);
              const double all = recording::band_power(spectrum, 0.0, 1e4);
              page::Series curve{.name = std::string(kMuscles[m].name), .role = kRoles[m]};
              for (Eigen::Index k = 0; k < spectrum.density.size(); ++k) {
                if (spectrum.frequency_hz(k) > 400.0) break;
                curve.x.push_back(spectrum.frequency_hz(k));
                curve.y.push_back(spectrum.density(k) / all);
              }
              curves.push_back(std::move(curve));
            }
            return curves;
          });
  return figure;
}

/// What can be counted of a channel in the window.
std::string counted(const Side& side, std::size_t m) {
  const double rate_hz = side.emg.raw.mean_rate_hz();
  const Eigen::VectorXd raw = raw_window(side, m);
  const recording::PowerSpectrum spectrum = recording::power_spectrum(raw, rate_hz, 0.5);
  const double all = recording::band_power(spectrum, 0.0, 1e4);
  std::vector<double> envelope =
      window(side.emg.envelope, side.channel[m], side.from_s, kMicrovolt, "", page::Role::reference).y;
  const page::Series filtered =
      window(side.emg.filtered, side.channel[m], side.from_s, kMicrovolt, "", page::Role::raw);
  // Kurtosis of the EMG over its envelope, where the muscle is at work.
  std::vector<double> sorted = envelope;
  std::sort(sorted.begin(), sorted.end());
  const auto at = [&sorted](double share) {
    return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
  };
  double second = 0.0, fourth = 0.0, count = 0.0;
  for (std::size_t k = 0; k < envelope.size(); ++k) {
    if (envelope[k] < at(0.8)) continue;
    const double z2 = std::pow(filtered.y[k] / envelope[k], 2);
    second += z2;
    fourth += z2 * z2;
    count += 1.0;
  }
  return fmt::format("| {} | {} | {:.0f} | {:.1f} | {:.0f} | {:.0f} | {:.0f} | {:.1f} | {:.1f} |\n", side.title,
                     kMuscles[m].name, at(0.99), 100.0 * at(0.05) / at(0.99),
                     recording::median_frequency_hz(spectrum, 20.0, 400.0),
                     100.0 * recording::band_power(spectrum, 0.0, 15.0) / all,
                     100.0 * recording::band_power(spectrum, 150.0, 1e4) / all,
                     1e4 * recording::band_power(spectrum, 500.0, 1e4) / all, fourth * count / (second * second) - 3.0);
}

void run(char** argv) {
  const std::array<Side, 2> sides = {read_side("a person", argv[1], argv[2], argv[3]),
                                     read_side("virtual, L2", argv[4], argv[5], argv[6])};
  myoid::write_file(argv[7], page::svg_plot(figure_of(sides)));
  fmt::print(
      "| | muscle | peak of the envelope [µV] | rest / peak [%] | median frequency [Hz] | below 15 "
      "Hz [%] | above 150 Hz [%] | above 500 Hz [1e-4] | excess kurtosis |\n"
      "| --- | --- | --- | --- | --- | --- | --- | --- | --- |\n");
  for (std::size_t m = 0; m < kMuscles.size(); ++m) {
    for (const Side& side : sides) fmt::print("{}", counted(side, m));
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 8) {
    fmt::print(stderr, "beside_a_recording ANGLE_A EMG_A FROM_S  ANGLE_B EMG_B FROM_S  OUT.svg\n");
    return 2;
  }
  try {
    run(argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 3;
  }
  return 0;
}
