// The report of a run in a browser, used as a person uses it.
#include <cmath>
#include <sstream>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/fit/measurement/muscle_law.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/ground/math/random.h"
#include "myoid/recording/tables/storage_reader.h"

#include "program.h"
#include "workbench_page.h"

namespace {

using myoid::test::Browser;
using myoid::test::myoid;
using myoid::test::WorkbenchPage;
using nlohmann::json;
using testing::HasSubstr;

/// A number as the page writes it, with a true minus.
double number(std::string text) {
  if (text.starts_with("−")) text = "-" + text.substr(std::string("−").size());
  return std::stod(text);
}

TEST_F(WorkbenchPage, PointingShowsTheNumberOfTheFile) {
  struct Case {
    const char *kind, *title, *line, *file, *column;
  };
  for (const Case& c : {Case{"angle", "elbow flexion", "angle", "ik.mot", "elbow_flexion"},
                        Case{"force", "BIC", "identified", "identified_forces.sto", "BIC_identified"},
                        Case{"force", "TRI", "shared", "identified_forces.sto", "TRI_reference"},
                        Case{"activation", "activation by EMG", "BRD", "activation.sto", "BRD"}}) {
    const auto file = myoid::recording::read_storage(*folder_ / "result/swing_2kg" / c.file).data;
    const Place place = plot(c.kind, c.title);
    for (const double t : {2.0, 3.76, 7.5}) {
      const double x = std::round(x_of(place, t));
      browser_->move(x, place.top + 0.5 * place.height);
      const json read =
          js(fmt::format("(() => {{ const i = plot.curves.findIndex((c) => c.name === '{}'); const c = "
                         "plot.curves[i];"
                         " return [plot.readouts[i].value.textContent, plot.atPixel({} - "
                         "plot.svg.getBoundingClientRect().left), c.places, Math.max(...c.y) - Math.min(...c.y), "
                         "[...c.x]]; }})()",
                         c.line, x));
      // The sample that is nearest to the mouse.
      const double at = read[1];
      double time = read[4][0];
      for (const json& other : read[4])
        if (std::abs(other.get<double>() - at) < std::abs(time - at)) time = other;
      Eigen::Index row = 0;
      (file.time_s().array() - time).abs().minCoeff(&row);
      ASSERT_NEAR(file.time_s()[row], time, 1e-6);
      // Half of the last digit, and half a step of the packing. An angle's file is in radians here.
      const double scale = file.channels()[static_cast<std::size_t>(file.index(c.column))].unit == myoid::Unit::radian
                               ? 180.0 / M_PI
                               : 1.0;
      const double tolerance = 0.5 * std::pow(10.0, -read[2].get<double>()) + read[3].get<double>() / 4094.0 + 1e-9;
      EXPECT_NEAR(number(read[0]), scale * file.column(c.column)[row], tolerance) << c.title;
    }
  }
}

TEST_F(WorkbenchPage, AClickAtAPeakMovesTheBodyThere) {
  const Place place = plot("angle", "elbow flexion");
  const double peak_s = js("plot.curves[0].x[plot.curves[0].y.indexOf(Math.max(...plot.curves[0].y))]");
  const double peak_deg = js("Math.max(...plot.curves[0].y)");
  browser_->click(x_of(place, peak_s), place.top + 0.4 * place.height);
  browser_->wait_for("!myoid.replay.dirty");
  // The drawn frame is the nearest of the scene's, and the body's elbow is at the peak there.
  const int frame = js("myoid.replay.figure.frame");
  EXPECT_EQ(js("Number(document.body.dataset.frame)").get<int>(), frame);
  const double frame_s = js(fmt::format("myoid.replay.trial.times[{}]", frame));
  EXPECT_NEAR(frame_s, peak_s, 0.03);
  const double elbow_deg =
      js(fmt::format("myoid.replay.trial.coordinate({}, "
                     "myoid.replay.trial.model.coordinates.findIndex((c) => c.name === 'elbow_flexion'))",
                     frame));
  EXPECT_NEAR(elbow_deg, peak_deg, 0.5);
  EXPECT_NEAR(js("myoid.plots[1].cursor").get<double>(), js("myoid.t").get<double>(), 1e-12);
}

TEST_F(WorkbenchPage, DraggingZoomsEveryPlotAndADoubleClickShowsTheWholeTrial) {
  const Place place = plot("torque", "elbow flexion");
  const double y = place.top + 0.5 * place.height;
  browser_->drag(x_of(place, 2.0), x_of(place, 5.0), y);
  const json view = js("myoid.view");
  ASSERT_TRUE(view.is_array());
  const double pixel_s = 2.0 * 10.0 / place.width;
  EXPECT_NEAR(view[0].get<double>(), 2.0, pixel_s);
  EXPECT_NEAR(view[1].get<double>(), 5.0, pixel_s);
  EXPECT_EQ(js("myoid.plots.every((p) => p.shown[0] === myoid.view[0] && p.shown[1] === "
               "myoid.view[1]) && myoid.carpet.shown[0] === myoid.view[0]"),
            true);
  browser_->click(x_of(place, 3.0), y, 2);
  EXPECT_TRUE(js("myoid.view").is_null());
}

TEST_F(WorkbenchPage, KeysMoveTheCursorTheViewAndTheTrial) {
  plot("torque", "elbow flexion");
  browser_->press("End");
  EXPECT_EQ(js("myoid.t === myoid.domain[1]"), true);
  browser_->press("Home");
  EXPECT_EQ(js("myoid.t === myoid.domain[0]"), true);
  browser_->press(".");
  EXPECT_EQ(js("myoid.t === myoid.steps[1]"), true);
  browser_->press(",");
  EXPECT_EQ(js("myoid.t === myoid.steps[0]"), true);
  browser_->press("z");
  EXPECT_EQ(js("myoid.view !== null"), true);
  browser_->press("Escape");
  EXPECT_TRUE(js("myoid.view").is_null());
  browser_->press(" ");
  EXPECT_EQ(js("myoid.playing"), true);
  browser_->wait_for("myoid.t > myoid.domain[0] + 0.1");
  browser_->press(" ");
  EXPECT_EQ(js("myoid.playing"), false);
  const int before = js("myoid.index");
  browser_->press("]");
  EXPECT_EQ(js("myoid.index").get<int>(), before + 1);
}

TEST_F(WorkbenchPage, TheAddressHoldsWhatIsShown) {
  js("myoid.open(myoid.trials.findIndex((t) => t.name === 'lowering_4kg'))");
  js("myoid.zoom([1, 3])");
  js("myoid.seek(2)");
  js("myoid.boxes.emg.querySelector('input').click()");
  browser_->wait_for("location.hash.includes('hide=emg') && location.hash.includes('from=1.000')");
  const std::string hash = js("location.hash.slice(1)");
  EXPECT_THAT(hash, HasSubstr("trial=lowering_4kg"));
  open(hash);
  EXPECT_EQ(js("myoid.trial.name"), "lowering_4kg");
  EXPECT_EQ(js("myoid.t"), 2.0);
  EXPECT_EQ(js("myoid.view"), json({1, 3}));
  EXPECT_EQ(js("myoid.plots.some((p) => p.kind === 'emg')"), false);
  EXPECT_EQ(js("myoid.plots.some((p) => p.kind === 'torque')"), true);
}

/// The value of a column at a time, between the rows of a file.
double value_at(const std::filesystem::path& path, const std::string& column, double time_s) {
  const auto file = myoid::recording::read_storage(path).data;
  const Eigen::VectorXd& t = file.time_s();
  Eigen::Index k = 0;
  while (k + 2 < t.size() && t[k + 1] <= time_s) ++k;
  const double share = (time_s - t[k]) / (t[k + 1] - t[k]);
  return (1.0 - share) * file.column(column)[k] + share * file.column(column)[k + 1];
}

TEST_F(WorkbenchPage, TheBandOfRepetitionsIsTheirMeanAndStandardDeviation) {
  EXPECT_EQ(js("myoid.compare.options[1].disabled"), true);  // the names are of three movements
  const json trials = js("myoid.trials.map((t) => [t.name, ...t.extent])");
  ASSERT_GE(trials.size(), 3U);
  js("myoid.trials.slice(0, 3).forEach((t, i) => (t.name = `lift_${i + 1}`)); myoid.open(0);"
     "myoid.compare.value = 1; myoid.compare.dispatchEvent(new Event('change'))");
  EXPECT_EQ(js("myoid.compare.options[1].disabled"), false);
  plot("angle", "elbow flexion");
  const json band =
      js("(() => { const c = plot.curves.find((c) => c.role === 'spread');"
         " return [c.name, [...c.x], [...c.y], [...c.upper]]; })()");
  EXPECT_EQ(band[0], "mean ± 1 SD of 3 repetitions");
  int compared = 0;
  for (const int percent : {20, 50, 80}) {
    Eigen::Vector3d values;
    for (int i = 0; i < 3; ++i) {
      const double from = trials[i][1], to = trials[i][2];
      values[i] = value_at(*folder_ / "result" / trials[i][0].get<std::string>() / "ik.mot", "elbow_flexion",
                           from + 0.01 * percent * (to - from));
    }
    const double mean = values.mean();
    const double sd = std::sqrt((values.array() - mean).square().sum() / 2.0);
    if (band[2][percent].is_null()) continue;
    EXPECT_NEAR(band[2][percent].get<double>(), mean - sd, 0.1) << percent;
    EXPECT_NEAR(band[3][percent].get<double>(), mean + sd, 0.1) << percent;
    ++compared;
  }
  EXPECT_GE(compared, 2);
  browser_->wait_for("location.hash.includes('repetitions=1')");
}

TEST_F(WorkbenchPage, ANormLiesBehindTheAngleOfItsTrial) {
  EXPECT_EQ(js("myoid.plots.some((p) => p.curves.some((c) => c.role === 'norm'))"), false);
  open("trial=ramp");
  plot("angle", "elbow flexion");
  const json band =
      js("(() => { const c = plot.curves[0]; return [c.role, c.name, c.x[1], c.y[1], c.upper[1]]; "
         "})()");
  EXPECT_EQ(band[0], "norm");
  EXPECT_EQ(band[1], "adults, N = 24, mean ± 1 SD");
  const auto time = myoid::recording::read_storage(*folder_ / "result/ramp/ik.mot").data.time_s();
  EXPECT_NEAR(band[2].get<double>(), 0.5 * (time[0] + time[time.size() - 1]), 0.01);
  EXPECT_NEAR(band[3].get<double>(), 90.0, 0.01);
  EXPECT_NEAR(band[4].get<double>(), 110.0, 0.01);
}

TEST_F(WorkbenchPage, TheChooserOpensATrialInEveryPart) {
  const json place =
      js("(() => { const chip = myoid.chips[myoid.trials.findIndex((t) => t.name === 'ramp')];"
         " chip.scrollIntoView({block: 'center'}); const b = chip.getBoundingClientRect();"
         " return [b.left + b.width / 2, b.top + b.height / 2]; })()");
  browser_->click(place[0], place[1]);
  EXPECT_EQ(js("myoid.trial.name"), "ramp");
  EXPECT_EQ(js("myoid.replay.trial.name"), "ramp");
  EXPECT_EQ(js("myoid.carpet.trial.name"), "ramp");
  // The virtual markers are off by millimeters: far from dark.
  EXPECT_THAT(js("myoid.carpet.says.textContent").get<std::string>(), HasSubstr("marker error 20 mm"));
  EXPECT_EQ(js("document.querySelectorAll('.chip[aria-pressed=true]').length"), 1);
  EXPECT_THAT(js("myoid.remarks.textContent").get<std::string>(), HasSubstr("ramp"));
}

TEST_F(WorkbenchPage, SavesNumbersAndDrawings) {
  plot("force", "BIC");
  js("[...plot.element.querySelectorAll('.tools button')].find((b) => b.textContent === "
     "'CSV').click()");
  const std::string csv = js("window.myoidSaved.blob.text()");
  EXPECT_THAT(csv, testing::StartsWith("panel,series,role,x,y,y_upper\n"));
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'),
            1 + js("plot.curves.reduce((n, c) => n + c.x.length, 0)").get<std::ptrdiff_t>());
  js("[...plot.element.querySelectorAll('.tools button')].find((b) => b.textContent === "
     "'SVG').click()");
  EXPECT_THAT(js("window.myoidSaved.name").get<std::string>(), testing::EndsWith(".svg"));
  EXPECT_EQ(js("window.myoidSaved.blob.text().then((t) => new DOMParser().parseFromString(t, "
               "'image/svg+xml').querySelectorAll('parsererror').length)"),
            0);
  js("myoid.carpet.saveCsv()");
  EXPECT_THAT(js("window.myoidSaved.blob.text()").get<std::string>(),
              HasSubstr("channel,kind,unit,begin_s,end_s,greatest"));
  js("myoid.picture()");
  browser_->wait_for("window.myoidSaved.name.endsWith('.png') && window.myoidSaved.blob.size > 1000");
}

TEST_F(WorkbenchPage, SavesAFilmOfTheBodyThatPlays) {
  js("myoid.zoom([2, 5])");
  js("myoid.film()");
  EXPECT_EQ(js("myoid.playing"), true);
  browser_->wait_for("window.myoidSaved && window.myoidSaved.name === 'swing_2kg.webm'");
  EXPECT_EQ(js("myoid.playing"), false);
  // The browser plays it: it has the canvas's shape and moves. A film without an index tells its
  // length only when it is asked for its end.
  const json film =
      js("(async () => { const v = document.createElement('video'); v.muted = true;"
         " v.src = URL.createObjectURL(window.myoidSaved.blob);"
         " await new Promise((done, failed) => { v.onloadeddata = done; v.onerror = () => "
         "failed(v.error.message); });"
         " const pen = Object.assign(document.createElement('canvas'), {width: v.videoWidth, "
         "height: v.videoHeight}).getContext('2d', {willReadFrequently: true});"
         " const picture = () => { pen.drawImage(v, 0, 0);"
         " return pen.getImageData(0, 0, v.videoWidth, v.videoHeight).data; };"
         " const seek = (t) => new Promise((done) => { v.onseeked = done; v.currentTime = t; });"
         " const first = picture(); await seek(1e9); const length = v.currentTime;"
         // A busy browser says that it has found the place before it shows the picture there.
         " let different = 0;"
         " for (let tries = 0; tries < 60 && different <= 100; ++tries) {"
         " await new Promise((done) => setTimeout(done, 50));"
         " const last = picture(); different = 0;"
         " for (let i = 0; i < first.length; i += 4)"
         " if (Math.abs(first[i] - last[i]) > 40) ++different; }"
         " return [v.videoWidth / v.videoHeight, length, different]; })()");
  const double shape = js("myoid.canvas.clientWidth / myoid.canvas.clientHeight");
  EXPECT_NEAR(film[0].get<double>(), shape, 0.01);
  EXPECT_GT(film[1].get<double>(), 0.0);  // 3 s where the browser is idle; a busy one records fewer or later pictures
  EXPECT_GT(film[2].get<double>(), 100.0);
}

TEST_F(WorkbenchPage, TheLawOfThePageIsTheProgramsLaw) {
  namespace fit = myoid::fit;
  myoid::math::Random random(5);
  json cases = json::array();
  std::vector<double> expected;
  for (int k = 0; k < 400; ++k) {
    const auto uniform = [&](double a, double b) { return a + (b - a) * random.uniform(); };
    fit::MuscleValues p{};
    p[fit::kMaxForce] = uniform(100.0, 2000.0);
    p[fit::kFiberLength] = uniform(0.05, 0.2);
    p[fit::kWidth] = uniform(0.3, 0.7) * p[fit::kFiberLength];
    p[fit::kCurvature] = uniform(0.1, 0.5);
    p[fit::kProduct] = uniform(0.02, 0.1);
    p[fit::kPlateau] = uniform(1.1, 1.8);
    p[fit::kSpeed] = 10.0 * p[fit::kFiberLength];
    p[fit::kSlack] = uniform(0.05, 0.3);
    p[fit::kPennation] = k % 2 == 0 ? 0.0 : uniform(0.0, 0.5);
    p[fit::kPassiveForce] = k % 3 == 0 ? 0.0 : uniform(0.1, 1.0);
    p[fit::kPassiveStrain] = uniform(0.4, 0.8);
    p[fit::kPassiveShape] = uniform(2.0, 5.0);
    p[fit::kLengthActivation] = k % 5 == 0 ? 0.0 : uniform(0.0, 0.2);
    p[fit::kTendonStrain] = k % 4 == 0 ? 0.0 : uniform(0.02, 0.08);
    p[fit::kShare] = uniform(0.5, 1.0);
    const double a = uniform(0.0, 1.0);
    const double length = p[fit::kSlack] + uniform(0.4, 1.6) * p[fit::kFiberLength];
    const double velocity = uniform(-1.1, 1.1) * p[fit::kSpeed];
    cases.push_back({a, length, velocity, p});
    expected.push_back(fit::tension(a, length, velocity, p).force_n);
  }
  const json found = js(cases.dump() + ".map(([a, l, v, p]) => myoid.tension(a, l, v, p))");
  // Round-off, relative to F_max: sums of a few terms, and the tendon's root to 1e-16 of its
  // strain, whose force rises by at most some hundred F_max per unit.
  for (std::size_t k = 0; k < expected.size(); ++k)
    EXPECT_NEAR(found[k].get<double>(), expected[k], 1e-9 * cases[k][3][0].get<double>()) << k;
}

TEST_F(WorkbenchPage, TheSlidersMoveTheTorqueByTheLaw) {
  js("myoid.learn.element.scrollIntoView({block: 'center'})");
  // With the identified numbers the law gives the program's force, within the packing's steps: half a step of a speed
  // between -1 and 1 m/s is 2.4e-4, over v_max 2e-4, and f_v rises by at most 8 at rest.
  EXPECT_LT(js("Math.max(...myoid.learn.muscles.map((m, i) => { const d = myoid.trial.drives[i];"
               " const y = myoid.trial.plots.find((p) => p.kind === 'force' && p.title === m.name)"
               ".curves.find((c) => c.role === 'identified').y;"
               " return Math.max(...y.map((f, k) => Math.abs(f - myoid.tension(d.activation[k], "
               "d.length[k], d.velocity[k], m.identified)))) / m.identified[0]; }))")
                .get<double>(),
            2e-3);
  const double before = js("myoid.learn.plots[0].curves.find((c) => c.role === 'moved').y[200]");
  // A maximal force of zero takes the muscle's own torque away.
  js("myoid.learn.values[0] = 0; myoid.learn.update()");
  const double after = js("myoid.learn.plots[0].curves.find((c) => c.role === 'moved').y[200]");
  const double part =
      js("(() => { const d = myoid.trial.drives[0]; return d.arms[0][200] * myoid.tension("
         "d.activation[200], d.length[200], d.velocity[200], myoid.learn.muscles[0].identified); "
         "})()");
  EXPECT_NEAR(before - after, part, 1e-9);
  // A slider changes the number and the sentence.
  js("myoid.learn.set(myoid.learn.muscles[0].identified)");
  const std::string sentence = js("myoid.learn.fit.textContent");
  js("(() => { const s = myoid.learn.inputs[0].input; s.value = s.min; s.dispatchEvent(new "
     "Event('input')); })()");
  EXPECT_NE(js("myoid.learn.fit.textContent").get<std::string>(), sentence);
}

/// An expression: how much of the draws' weight a path of the map holds, in per cent. The draws are
/// rows of posterior.csv, `a` and `b` their columns along the map's sides.
std::string share_inside(int path,
                         const std::vector<myoid::test::Row>& draws,
                         const std::string& a,
                         const std::string& b) {
  json places = json::array();
  for (const myoid::test::Row& row : draws)
    places.push_back({std::stod(row.at("weight")), std::stod(row.at(a)), std::stod(row.at(b))});
  return fmt::format(
      "(() => {{ const path = myoid.learn.map.querySelectorAll('.allowed')[{}]; let sum = 0;"
      " for (const [w, a, b] of {}) {{ const [x, y] = myoid.learn.place([a, b]);"
      " if (path.isPointInFill(new DOMPoint(x, y))) sum += 100 * w; }} return sum; }})()",
      path, places.dump());
}

TEST_F(WorkbenchPage, ThePosteriorsContoursHoldTheirSharesOfItsDraws) {
  myoid::write_file(*folder_ / "two.toml",
                    "level = \"L1\"\n[[trial]]\nname = \"mvc\"\nkind = \"mvc\"\ndirection = \"both\"\n"
                    "[[trial]]\nname = \"lift\"\nkind = \"eccentric\"\nheld_mass_kg = 1.0\n");
  const auto twin = myoid({"twin", "--protocol", *folder_ / "two.toml", "--out", *folder_ / "two"});
  ASSERT_EQ(twin.exit_code, 0) << twin.err;
  const std::string out = *folder_ / "posterior";
  const auto run = myoid({"run", *folder_ / "two/study.toml", "--out", out});
  ASSERT_TRUE(run.exit_code == 0 || run.exit_code == 4) << run.err;
  browser_->open("file://" + out + "/report.html#trial=lift");
  const std::vector<myoid::test::Row> draws = myoid::test::read_rows(out + "/posterior.csv");
  EXPECT_THAT(js("myoid.learn.caption.textContent").get<std::string>(),
              HasSubstr(fmt::format("{} draws from the posterior", draws.size())));
  for (const std::string muscle : {"BIC", "TRI"}) {
    js(fmt::format("myoid.learn.open(myoid.learn.muscles.findIndex((m) => m.name === '{}'))", muscle));
    const auto share = [&](int path) {
      return js(share_inside(path, draws, muscle + ".optimal_fiber_length", muscle + ".max_isometric_force"))
          .get<double>();
    };
    // The contours go through a draw; pixels have a tenth, and a thousand draws lie near by.
    EXPECT_NEAR(share(0), 95.0, 1.0) << muscle;
    EXPECT_NEAR(share(1), 50.0, 1.5) << muscle;
  }
}

/// A film of two seconds, recorded by the browser.
std::string recorded_film(Browser& browser) {
  const std::string text = browser.evaluate(
      "new Promise((done) => { const c = document.createElement('canvas'); c.width = 64; c.height "
      "= "
      "48; const pen = c.getContext('2d'); let k = 0; const timer = setInterval(() => { "
      "pen.fillStyle "
      "= `hsl(${++k * 5}, 90%, 50%)`; pen.fillRect(0, 0, 64, 48); }, 30);"
      "const r = new MediaRecorder(c.captureStream(25), {mimeType: 'video/webm'}); const parts = "
      "[];"
      "r.ondataavailable = (e) => parts.push(e.data);"
      "r.onstop = async () => { clearInterval(timer); const bytes = new Uint8Array(await new "
      "Blob(parts).arrayBuffer()); done([...bytes].map((b) => b.toString(16).padStart(2, "
      "'0')).join('')); }; r.start(); setTimeout(() => r.stop(), 2000); })");
  std::string bytes;
  for (std::size_t i = 0; i + 1 < text.size(); i += 2)
    bytes += static_cast<char>(std::stoi(text.substr(i, 2), nullptr, 16));
  return bytes;
}

TEST_F(WorkbenchPage, AFilmFollowsTheTimeOfTheBody) {
  const std::string film = *folder_ / "rec/swing #1.webm";
  myoid::write_file(film, recorded_film(*browser_));
  const std::filesystem::path out = *folder_ / "filmed";
  std::filesystem::copy(*folder_ / "result", out, std::filesystem::copy_options::recursive);
  const auto report = myoid({"report", out, "--video", "swing_2kg=" + film, "--video-offset", "1.5"});
  ASSERT_EQ(report.exit_code, 0) << report.err;
  browser_->open("file://" + out.string() + "/report.html#trial=swing_2kg&t=2.5");
  browser_->wait_for("!myoid.video.film.hidden && !myoid.video.film.seeking");
  EXPECT_EQ(js("myoid.video.film.videoWidth"), 64);
  const auto shown_s = [] {
    browser_->wait_for("!myoid.video.film.seeking");
    return js("myoid.video.film.currentTime").get<double>();
  };
  EXPECT_NEAR(shown_s(), 2.5 - 1.5, 0.01);
  // A click moves body and film; a new offset moves the film alone.
  const Place place = plot("angle", "elbow flexion");
  browser_->click(std::round(x_of(place, 1.9)), place.top + 0.4 * place.height);
  EXPECT_NEAR(shown_s(), js("myoid.t").get<double>() - 1.5, 0.01);
  js("(() => { myoid.video.offset.value = 1; myoid.video.offset.dispatchEvent(new Event('input')); "
     "})()");
  EXPECT_NEAR(shown_s(), js("myoid.t").get<double>() - 1.0, 0.01);
  // Ahead of its begin the film stands pale at its first picture.
  js("myoid.seek(0.2)");
  EXPECT_EQ(shown_s(), 0.0);
  EXPECT_EQ(js("myoid.video.film.classList.contains('outside')"), true);
  // Another trial has no film; the first keeps the reader's offset.
  js("myoid.open(myoid.index ? 0 : 1)");
  EXPECT_EQ(js("myoid.video.film.hidden && myoid.video.says.hidden"), true);
  js("myoid.open(myoid.trials.findIndex((t) => t.name === 'swing_2kg'))");
  EXPECT_EQ(js("myoid.video.offset.value"), "1");
  browser_->wait_for("!myoid.video.film.hidden");
}

TEST_F(WorkbenchPage, AFilmThatIsMissingIsNamed) {
  const std::string film = *folder_ / "rec/lost.webm";
  const std::filesystem::path out = *folder_ / "lost";
  std::filesystem::copy(*folder_ / "result", out, std::filesystem::copy_options::recursive);
  const auto refused = myoid({"report", out, "--video", "swing_2kg=" + film});
  EXPECT_EQ(refused.exit_code, 3);
  EXPECT_THAT(refused.err, testing::AllOf(HasSubstr("lost.webm"), HasSubstr("'swing_2kg'")));
  // The film goes away after the report is made.
  myoid::write_file(film, "no film");
  ASSERT_EQ(myoid({"report", out, "--video", "swing_2kg=" + film}).exit_code, 0);
  std::filesystem::remove(film);
  Browser browser(960, 720);  // its console names the file that it did not find
  browser.open("file://" + out.string() + "/report.html#trial=swing_2kg&t=2.5");
  browser.wait_for("!myoid.video.says.hidden");
  EXPECT_EQ(browser.evaluate("myoid.video.film.hidden"), true);
  EXPECT_THAT(browser.evaluate("myoid.video.says.textContent").get<std::string>(),
              testing::AllOf(HasSubstr("../rec/lost.webm"), HasSubstr("opens another file")));
}

}  // namespace
