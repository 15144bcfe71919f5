/// Simulation-based calibration of the posterior (Talts, Betancourt, Simpson, Vehtari
/// and Gelman, 2018): the truth, drawn from the priors, has a uniform rank among the posterior's
/// draws. `calibration --help` prints the options.

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "myoid/fit/measurement/parameters.h"
#include "myoid/fit/posterior/exploration.h"
#include "myoid/ground/core/parallel.h"
#include "myoid/ground/math/random.h"
#include "myoid/ground/math/statistics.h"

#include "tests/coverage/made_person.h"

namespace myoid::test {
namespace {

constexpr int kRanks = 20;  // of the truth among 19 draws

struct Settings {
  int persons = 200, first = 0;
  std::string folder;
  double limit = 0.01;  ///< Of p after Bonferroni.
  MadePersonOptions person;
  int draws = 0;  ///< EstimatorOptions::posterior_draws
};

/// One parameter of one person.
struct Place {
  int rank = 0;
  double share = 0.0;   ///< Of the posterior's weight below the truth.
  double score = 0.0;   ///< (truth - mean) / sd of the posterior.
  double shrunk = 0.0;  ///< sd of the posterior.
  double truth = 0.0;
};

struct PersonResult {
  std::vector<Place> places;
  double rhat = 0.0;
  bool approximate = false, converged = false;
};

PersonResult judge(const Settings& settings, int number) {
  MadePersonOptions options = settings.person;
  options.seed = static_cast<std::uint64_t>(settings.first + number + 1);
  const MadePerson person = made_person(options);
  fit::EstimatorOptions estimator = person.options;
  estimator.posterior_draws = settings.draws;
  const fit::Exploration explored = fit::explore(person.data, estimator);
  const fit::Sample& sample = explored.sample;
  PersonResult result{.places = {},
                      .rhat = sample.rhat,
                      .approximate = sample.approximate,
                      .converged = explored.modes.front().mode.converged};
  math::Random random(options.seed, 99);
  std::vector<Eigen::Index> chosen(kRanks - 1);
  for (Eigen::Index& i : chosen) {
    double u = random.uniform();
    for (i = 0; i + 1 < sample.weight.size() && u >= sample.weight[i]; ++i) u -= sample.weight[i];
  }
  const Eigen::Index p = person.z.size();
  for (Eigen::Index j = 0; j < p + sample.noise.rows(); ++j) {
    Place& place = result.places.emplace_back();
    place.truth = j < p ? person.z[j] : person.noise[j - p];
    const Eigen::VectorXd x = j < p ? sample.z.row(j) : sample.noise.row(j - p);
    for (const Eigen::Index i : chosen) place.rank += x[i] < place.truth;
    for (Eigen::Index i = 0; i < x.size(); ++i)
      if (x[i] < place.truth) place.share += sample.weight[i];
    const double mean = x.dot(sample.weight);
    place.shrunk = std::sqrt((x.array() - mean).square().matrix().dot(sample.weight));
    place.score = (place.truth - mean) / place.shrunk;
  }
  return result;
}

/// A parameter, or all of one kind together.
struct Row {
  std::string name;
  std::vector<Place> places;
  [[nodiscard]] std::vector<double> counts() const {
    std::vector<double> n(kRanks, 0.0);
    for (const Place& p : places) n[static_cast<std::size_t>(p.rank)] += 1.0;
    return n;
  }
  [[nodiscard]] double p_value() const {
    const double expected = static_cast<double>(places.size()) / kRanks;
    double sum = 0.0;
    for (const double n : counts()) sum += (n - expected) * (n - expected) / expected;
    return math::chi_squared_tail(sum, kRanks - 1.0);
  }
};

void print_header() {
  fmt::print("{:36} {:>6} {:>9} {:>7} {:>7} {:>7} {:>7} {:>7}\n", "parameter", "n", "p(chi2)", "bias", "sd", "<2.5%",
             ">97.5%", "in50%");
}

/// Bias and spread are of (truth - mean)/sd: 0 and 1 of a posterior that is right.
void print_row(const Row& row) {
  double mean = 0.0, square = 0.0, below = 0.0, above = 0.0, middle = 0.0;
  const auto n = static_cast<double>(row.places.size());
  for (const Place& p : row.places) {
    mean += p.score / n;
    square += p.score * p.score / n;
    below += (p.share < 0.025) / n;
    above += (p.share > 0.975) / n;
    middle += (p.share > 0.25 && p.share < 0.75) / n;
  }
  fmt::print("{:36} {:6} {:9.2g} {:7.2f} {:7.2f} {:7.1f} {:7.1f} {:7.1f}\n", row.name, row.places.size(), row.p_value(),
             mean, std::sqrt(square - mean * mean), 100.0 * below, 100.0 * above, 100.0 * middle);
}

std::string histogram(const Row& row, double x0, double y0) {
  constexpr double kWide = 150.0, kHigh = 70.0;
  const double n = static_cast<double>(row.places.size()) / kRanks;
  // 95 % of a count of that many, normal.
  const double half = 1.96 * std::sqrt(n * (1.0 - 1.0 / kRanks));
  const double scale = kHigh / std::max(2.5 * n, 1.0);
  std::string svg = fmt::format(
      "<rect x='{:.1f}' y='{:.1f}' width='{}' height='{:.1f}' fill='#d8d8d8'/>"
      "<text x='{:.1f}' y='{:.1f}'>{}</text>\n",
      x0, y0 + kHigh - scale * (n + half), kWide, scale * 2.0 * half, x0, y0 - 4.0, row.name);
  const std::vector<double> counts = row.counts();
  for (int i = 0; i < kRanks; ++i) {
    const double high = std::min(kHigh, scale * counts[static_cast<std::size_t>(i)]);
    svg += fmt::format(
        "<rect x='{:.1f}' y='{:.1f}' width='{:.1f}' height='{:.1f}' fill='#2a6496' "
        "fill-opacity='0.75'/>\n",
        x0 + kWide * i / kRanks + 0.5, y0 + kHigh - high, kWide / kRanks - 1.0, high);
  }
  return svg;
}

void write_figure(const std::string& path, const std::vector<Row>& rows) {
  constexpr std::size_t kColumns = 5;
  const std::size_t lines = (rows.size() + kColumns - 1) / kColumns;
  std::ofstream file(path);
  file << fmt::format(
      "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 {} {}' font-family='sans-serif' "
      "font-size='9'>\n<rect width='100%' height='100%' fill='white'/>\n",
      kColumns * 170 + 20, lines * 100 + 20);
  for (std::size_t i = 0; i < rows.size(); ++i)
    file << histogram(rows[i], 15.0 + 170.0 * static_cast<double>(i % kColumns),
                      20.0 + 100.0 * static_cast<double>(i / kColumns));
  file << "</svg>\n";
}

void write_ranks(const std::string& path,
                 const std::vector<std::string>& names,
                 const std::vector<PersonResult>& persons,
                 int first) {
  std::ofstream file(path);
  file << "person,parameter,rank,share_below,score,posterior_sd,truth,rhat,approximate,converged\n";
  for (std::size_t i = 0; i < persons.size(); ++i) {
    for (std::size_t j = 0; j < persons[i].places.size(); ++j) {
      const PersonResult& person = persons[i];
      const Place& p = person.places[j];
      file << fmt::format("{},{},{},{:.4f},{:.4f},{:.5g},{:.6g},{:.2f},{},{}\n", first + static_cast<int>(i) + 1,
                          names[j], p.rank, p.share, p.score, p.shrunk, p.truth, person.rhat,
                          static_cast<int>(person.approximate), static_cast<int>(person.converged));
    }
  }
}

std::vector<std::string> names_of(const Settings& settings) {
  const MadePerson person = made_person(settings.person);
  std::vector<std::string> names;
  const fit::ParameterMap map(person.data, person.options);
  for (const fit::Unknown& u : map.free()) names.push_back(u.label);
  constexpr std::array<const char*, fit::kNoiseFieldCount> kNoise{
      "noise.torque_sd", "noise.torque_time", "noise.emg",        "noise.model",
      "noise.arm_slope", "noise.crosstalk",   "noise.gain_drift", "noise.rise_and_fall"};
  names.insert(names.end(), kNoise.begin(), kNoise.end());
  for (const fit::TrialData& trial : person.data.trials) names.push_back(trial.name + ".torque_share");
  return names;
}

std::string kind_of(const std::string& name) {
  return name.starts_with("noise.") ? name : "all." + name.substr(name.rfind('.') + 1);
}

int run(const Settings& settings) {
  const std::vector<std::string> names = names_of(settings);
  std::vector<PersonResult> persons(static_cast<std::size_t>(settings.persons));
  std::atomic<int> done = 0;
  const auto begin = std::chrono::steady_clock::now();
  parallel_ranges(settings.persons, 1, [&](const auto& range) {
    for (int i = range.begin(); i < range.end(); ++i) {
      persons[static_cast<std::size_t>(i)] = judge(settings, i);
      const int now = ++done;
      if (now % 20 == 0)
        fmt::print(stderr, "{} persons, {:.1f} s\n", now,
                   std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
    }
  });
  std::vector<Row> rows, kinds;
  double approximate = 0.0, lost = 0.0;
  for (const PersonResult& person : persons) {
    approximate += person.approximate;
    lost += !person.converged;
  }
  for (std::size_t j = 0; j < names.size(); ++j) {
    Row& row = rows.emplace_back(Row{names[j], {}});
    const std::string kind = kind_of(names[j]);
    auto at = std::find_if(kinds.begin(), kinds.end(), [&](const Row& r) { return r.name == kind; });
    if (at == kinds.end()) at = kinds.insert(kinds.end(), Row{kind, {}});
    for (const PersonResult& person : persons) {
      row.places.push_back(person.places[j]);
      at->places.push_back(person.places[j]);
    }
  }
  fmt::print("{} persons; search not converged {:.0f}, chains that differ {:.0f}\n", settings.persons, lost,
             approximate);
  print_header();
  for (const Row& row : kinds) print_row(row);
  fmt::print("\n");
  print_header();
  int wrong = 0;
  for (const Row& row : rows) {
    print_row(row);
    wrong += row.p_value() * static_cast<double>(rows.size()) < settings.limit;
  }
  fmt::print("{} of {} parameters are not uniform at p = {} after Bonferroni\n", wrong, rows.size(), settings.limit);
  if (!settings.folder.empty()) {
    std::filesystem::create_directories(settings.folder);
    write_ranks(settings.folder + "/ranks.csv", names, persons, settings.first);
    write_figure(settings.folder + "/calibration.svg", rows);
    write_figure(settings.folder + "/calibration_kinds.svg", kinds);
  }
  return wrong == 0 ? 0 : 1;
}

constexpr const char* kHelp =
    "calibration [--persons N] [--first N] [--out FOLDER] [--draws N] [--limit P] "
    "[--of-the-model]\n"
    "            [--two-muscles] [--bandwidth HZ] [--drive HZ] [--rate HZ] [--trials N] "
    "[--seconds S]\n"
    "Ranks of persons drawn from the priors in their posteriors. Writes ranks.csv and\n"
    "calibration.svg to FOLDER, and fails where a parameter's ranks are not uniform at P.\n"
    "--of-the-model: torques are drawn from the model itself, given the envelopes.\n"
    "--draws: by Hamiltonian Monte Carlo; 0: of the approximation. --bandwidth: of the raw EMG.\n";

int main_of(int argc, char** argv) {
  Settings settings;
  for (int i = 1; i < argc; ++i) {
    const std::string name = argv[i];
    if (name == "--of-the-model") {
      settings.person.of_the_model = true;
    } else if (name == "--two-muscles") {
      settings.person.two_muscles = true;
    } else if (name == "--help" || i + 1 == argc) {
      fmt::print("{}", kHelp);
      return name == "--help" ? 0 : 2;
    } else {
      const std::string value = argv[++i];
      if (name == "--persons")
        settings.persons = std::stoi(value);
      else if (name == "--first")
        settings.first = std::stoi(value);
      else if (name == "--out")
        settings.folder = value;
      else if (name == "--draws")
        settings.draws = std::stoi(value);
      else if (name == "--limit")
        settings.limit = std::stod(value);
      else if (name == "--bandwidth")
        settings.person.emg_bandwidth_hz = std::stod(value);
      else if (name == "--drive")
        settings.person.drive_hz = std::stod(value);
      else if (name == "--rate")
        settings.person.rate_hz = std::stod(value);
      else if (name == "--trials")
        settings.person.trials = std::stoi(value);
      else if (name == "--seconds")
        settings.person.seconds = std::stod(value);
      else {
        fmt::print("{}", kHelp);
        return 2;
      }
    }
  }
  if (settings.person.of_the_model) settings.person.rate_hz = std::min(settings.person.rate_hz, 20.0);
  return run(settings);
}

}  // namespace
}  // namespace myoid::test

int main(int argc, char** argv) {
  try {
    return myoid::test::main_of(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "calibration: %s\n", error.what());
    return 2;
  }
}
