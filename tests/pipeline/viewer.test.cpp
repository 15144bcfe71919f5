// Pages with a moving model, written by the program and opened in a browser.
#include <cmath>
#include <cstdlib>
#include <regex>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "browser.h"
#include "program.h"
#include "tests/support/places.h"
#include "tests/support/temporary_folder.h"

namespace {

using myoid::test::Finished;
using myoid::test::myoid;
using myoid::test::read_text;
using myoid::test::TemporaryFolder;
using myoid::test::there_is;
using myoid::test::write_text;
using testing::AllOf;
using testing::HasSubstr;

/// The elbow from 0 to 90 degrees in a second, at 100 Hz.
std::string motion() {
  std::string text = "flexion\nversion=1\nnRows=101\nnColumns=2\ninDegrees=yes\nendheader\n";
  text += "time\telbow_flexion\n";
  for (int k = 0; k <= 100; ++k) text += fmt::format("{}\t{}\n", 0.01 * k, 45.0 - 45.0 * std::cos(M_PI * 0.01 * k));
  return text;
}

/// One muscle pulls ever harder.
std::string forces() {
  std::string text = "forces\nversion=1\nnRows=101\nnColumns=3\ninDegrees=no\nendheader\n";
  text += "time\tBIC\tTRI\n";
  for (int k = 0; k <= 100; ++k) text += fmt::format("{}\t{}\t{}\n", 0.01 * k, 5.0 * k, 20.0);
  return text;
}

/// A marker that rests, at 100 Hz.
std::string markers(const std::string& name, double x_mm, double y_mm, double z_mm) {
  std::string text = "PathFileType\t4\t(X/Y/Z)\tm.trc\n";
  text +=
      "DataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\tOrigDataRate\tOrigDataStartFrame\t"
      "OrigNumFrames\n100\t100\t101\t1\tmm\t100\t1\t101\n";
  text += "Frame#\tTime\t" + name + "\n\t\tX1\tY1\tZ1\n\n";
  for (int k = 0; k <= 100; ++k) text += fmt::format("{}\t{}\t{}\t{}\t{}\n", k + 1, 0.01 * k, x_mm, y_mm, z_mm);
  return text;
}

/// Opens a page and returns the document as it is after `virtual_ms` of the page's own time.
std::string opened(const TemporaryFolder& folder, const std::string& page, int virtual_ms) {
  const std::string command = fmt::format(
      "chromium --headless --no-sandbox --disable-gpu --use-angle=swiftshader "
      "--enable-unsafe-swiftshader --disable-dev-shm-usage --no-first-run "
      "--user-data-dir='{0}' --window-size=640,420 --virtual-time-budget={1} --dump-dom "
      "'file://{2}' > '{3}' 2> '{4}'",
      std::string(folder / "profile"), virtual_ms, page, std::string(folder / "dom"), std::string(folder / "log"));
  if (std::system(("timeout 60 " + command).c_str()) != 0) return read_text(folder / "log");
  return read_text(folder / "dom");
}

/// What viewer_probe.js found out.
std::map<std::string, std::string> found_in(const std::string& document) {
  std::map<std::string, std::string> found;
  const std::size_t begin = document.rfind("<pre id=\"found\">");
  if (begin == std::string::npos) return found;
  const std::string text = document.substr(begin + 16, document.find("</pre>", begin) - begin - 16);
  const std::regex line("([^:\n]+): ?([^\n]*)");
  for (std::sregex_iterator it(text.begin(), text.end(), line), end; it != end; ++it) found[(*it)[1]] = (*it)[2];
  return found;
}

TEST(Viewer, ShowsAndPlaysTheModelInABrowser) {
  if (!there_is("chromium")) GTEST_SKIP() << "needs the package chromium";
  const TemporaryFolder folder;
  write_text(folder / "m.mot", motion());
  write_text(folder / "f.sto", forces());
  write_text(folder / "m.trc", markers("c7", -48.0, 1460.0, 0.0));
  const Finished done = myoid({"info", "arm4", "--html", folder / "arm.html", "--motion", folder / "m.mot", "--forces",
                               folder / "f.sto", "--markers", folder / "m.trc"});
  if (done.err.find("built without three.js") != std::string::npos)
    GTEST_SKIP() << "needs a program built with the packages libjs-three and esbuild";
  ASSERT_EQ(done.exit_code, 0) << done.err;

  std::string page = read_text(folder / "arm.html");
  const std::string listener =
      "<head><script>window.probeErrors = [];"
      "addEventListener('error', (e) => probeErrors.push(e.message));"
      "for (const kind of ['error', 'warn'])"
      "  console[kind] = (...words) => probeErrors.push(words.join(' '));</script>";
  page.replace(page.find("<head>"), 6, listener);
  const std::string probe = read_text(myoid::test::source_dir() / "tests/pipeline/viewer_probe.js");
  page.insert(page.rfind("</body>"), "<script>" + probe + "</script>");
  write_text(folder / "arm.html", page);
  const std::string document = opened(folder, folder / "arm.html", 3000);
  auto found = found_in(document);
  ASSERT_FALSE(found.empty()) << document.substr(0, 3000);

  // The scene is there.
  EXPECT_EQ(found["errors"], "");
  EXPECT_EQ(found["state"], "ready");
  EXPECT_EQ(found["bodies"], "4");
  EXPECT_EQ(found["muscles"], "4");
  EXPECT_EQ(found["listed"], "4");
  EXPECT_EQ(found["coordinates"], "4");
  EXPECT_EQ(found["frames"], "51");  // of 101: 50 per second
  EXPECT_THAT(found["legend"], AllOf(HasSubstr("force [N]"), HasSubstr("500")));
  // It is drawn: a thin arm covers some hundreds of 100,000 pixels.
  EXPECT_GT(std::stod(found["not_background"]), 400.0);
  EXPECT_LT(std::stod(found["not_background"]), 0.5 * std::stod(found["pixels"]));
  EXPECT_GT(std::stod(found["moved"]), 300.0);
  EXPECT_GT(std::stod(found["muscles_colored"]), 100.0);
  EXPECT_GT(std::stod(found["views_differ"]), 1000.0);
  // Numbers are those of the files.
  EXPECT_EQ(found["errors_drawn"], "1");
  EXPECT_NEAR(std::stod(found["error_mm"]), 12.0, 0.05);  // the model's c7 is at -60 mm
  EXPECT_NEAR(std::stod(found["angle"]), 0.0, 1e-6);      // the shoulder, which the file leaves out
  // It plays, by key.
  EXPECT_EQ(found["playing"], "true");
  EXPECT_GT(std::stod(found["played_s"]), 0.0);
  EXPECT_EQ(found["paused"], "true");
  EXPECT_EQ(found["last"], "50");
  EXPECT_THAT(found["pointed"], AllOf(HasSubstr("BIC"), HasSubstr("force"), HasSubstr("N")));
}

TEST(Viewer, SaysWhatItCannotShow) {
  const TemporaryFolder folder;
  write_text(folder / "m.mot", motion());
  write_text(folder / "f.sto", forces());
  const std::string page = folder / "p.html";
  const Finished alone = myoid({"info", "arm4", "--html", page, "--forces", folder / "f.sto"});
  EXPECT_EQ(alone.exit_code, 3);
  EXPECT_THAT(alone.err, HasSubstr("--motion"));
  const Finished no_model = myoid({"info", folder / "m.mot", "--html", page});
  EXPECT_EQ(no_model.exit_code, 3);
  EXPECT_THAT(no_model.err, HasSubstr("one .osim, or arm4"));
  const Finished no_page = myoid({"info", "arm4", "--motion", folder / "m.mot"});
  EXPECT_EQ(no_page.exit_code, 2);
  EXPECT_THAT(no_page.err, HasSubstr("--html"));
  EXPECT_FALSE(std::filesystem::exists(page));
}

}  // namespace
