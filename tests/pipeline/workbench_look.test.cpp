// The report of a run in a browser, as it looks: in a window of any width, in light and dark, on paper, without script.
#include <filesystem>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "workbench_page.h"

namespace {

using myoid::test::WorkbenchPage;
using nlohmann::json;
using testing::HasSubstr;

TEST_F(WorkbenchPage, TheFirstPictureComesWithinASecondAndAHalf) {
  double best_s = 1e9;
  for (int i = 0; i < 3; ++i) {  // other programs may hold up one of them
    open();
    browser_->wait_for("performance.getEntriesByName('first-contentful-paint').length > 0");
    best_s = std::min(best_s,
                      js("performance.getEntriesByName('first-contentful-paint')[0].startTime / 1000").get<double>());
  }
  EXPECT_LT(best_s, 1.5);
}

TEST_F(WorkbenchPage, ABodyThatRestsIsDrawnFinely) {
  const double width = js("myoid.canvas.clientWidth");
  // As on a slow computer: the coarsest level while it plays.
  js("myoid.replay.pace.moving = 5; myoid.toggle()");
  browser_->wait_for(fmt::format("myoid.canvas.width < {}", width));
  js("myoid.toggle()");
  browser_->wait_for(fmt::format("myoid.canvas.width === 2 * {}", width));
}

TEST_F(WorkbenchPage, FitsTheWindowAtEveryWidth) {
  for (const int width : {1280, 1920, 390}) {
    browser_->resize(width, 900);
    open();
    EXPECT_LE(js("document.documentElement.scrollWidth").get<int>(), width);
    EXPECT_EQ(js("myoid.plots.every((p) => p.svg.getBoundingClientRect().width <= "
                 "p.element.clientWidth + 1 && p.width > 200)"),
              true)
        << width;
    EXPECT_GT(js("myoid.canvas.getBoundingClientRect().width").get<double>(), 250.0);
    // A verdict is of two lines at most, not of a letter a line.
    EXPECT_LT(
        js("Math.max(0, ...[...document.querySelectorAll('.forest .badge')].map((b) => b.offsetHeight))").get<double>(),
        40.0)
        << width;
  }
}

/// An expression: texts that stand out too little from their ground (WCAG 2.1: 4.5), each with its contrast.
constexpr const char* kFaintTexts = R"js((() => {
  const rgba = (text) => { const n = text.match(/[\d.]+/g).map(Number); return [n[0], n[1], n[2], n.length > 3 ? n[3] : 1]; };
  const over = (top, ground) => [0, 1, 2].map((k) => top[3] * top[k] + (1 - top[3]) * ground[k]).concat(1);
  const light = (c) => c.slice(0, 3).map((v) => v / 255).map((v) => (v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4))
    .reduce((sum, v, k) => sum + v * [0.2126, 0.7152, 0.0722][k], 0);
  const ground = (e) => {
    const layers = [];
    for (let at = e; at; at = at.parentElement) layers.unshift(rgba(getComputedStyle(at).backgroundColor));
    return layers.reduce((below, layer) => over(layer, below), [255, 255, 255, 1]);
  };
  const faint = [];
  const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  for (let node = walker.nextNode(); node; node = walker.nextNode()) {
    const e = node.parentElement;
    if (!node.textContent.trim() || ['SCRIPT', 'STYLE', 'TITLE', 'DESC', 'OPTION'].includes(e.tagName.toUpperCase())) continue;
    if (!e.getClientRects().length || getComputedStyle(e).visibility === 'hidden') continue;
    const style = getComputedStyle(e);
    const color = rgba(e instanceof SVGElement ? style.fill : style.color);
    for (let at = e; at; at = at.parentElement) color[3] *= Number(getComputedStyle(at).opacity);
    const below = ground(e);
    const [a, b] = [light(over(color, below)), light(below)].sort((p, q) => q - p);
    if ((a + 0.05) / (b + 0.05) < 4.5) faint.push(`${node.textContent.trim().slice(0, 30)}: ${((a + 0.05) / (b + 0.05)).toFixed(2)} <${e.tagName} ${e.getAttribute('class') || ''}>`);
  }
  return faint;
})())js";

TEST_F(WorkbenchPage, IsReadableInALightAndInADarkScheme) {
  for (const char* scheme : {"light", "dark"}) {
    browser_->prefer("prefers-color-scheme", scheme);
    open();
    const bool dark = std::string(scheme) == "dark";
    // Everything that can be opened is open.
    js("document.querySelectorAll('details').forEach((d) => (d.open = true));"
       "document.querySelectorAll('.fold[aria-expanded=false]').forEach((b) => b.click());"
       "document.querySelectorAll('.reading').forEach((r) => (r.hidden = false))");
    EXPECT_EQ(js(kFaintTexts), json::array()) << scheme;
    EXPECT_EQ(js("getComputedStyle(document.body).backgroundColor"), dark ? "rgb(20, 24, 29)" : "rgb(255, 255, 255)");
    // Curves and marks, of the page's own drawings and of the workbench's.
    EXPECT_EQ(js("getComputedStyle(myoid.plots[0].svg.querySelector('path')).stroke"),
              dark ? "rgb(127, 182, 242)" : "rgb(31, 95, 168)");
  }
  browser_->prefer("prefers-color-scheme", "light");
}

TEST_F(WorkbenchPage, MovesNothingByItselfForThoseWhoWishSo) {
  browser_->prefer("prefers-reduced-motion", "reduce");
  open();
  EXPECT_EQ(js("myoid.playing"), false);
  EXPECT_EQ(js("document.getAnimations().length"), 0);
  EXPECT_EQ(js("[...document.querySelectorAll('*')].filter((e) => getComputedStyle(e).transitionDuration !== '0s' || "
               "getComputedStyle(e).scrollBehavior === 'smooth').length"),
            0);
  browser_->prefer("prefers-reduced-motion", "no-preference");
}

TEST_F(WorkbenchPage, EveryPlotHasWordsForThoseWhoDoNotSeeIt) {
  EXPECT_EQ(js("[...document.querySelectorAll('.plot > svg')].every((s) => "
               "s.getAttribute('role') === 'img' && s.getAttribute('aria-label').length > 20)"),
            true);
  EXPECT_EQ(js("[...document.querySelectorAll('.workbench .plot')].every((f) => "
               "[...f.querySelectorAll('button')].some((b) => b.textContent === '?'))"),
            true);
  EXPECT_THAT(js("myoid.plots.find((p) => p.kind === 'torque').svg.getAttribute('aria-label')").get<std::string>(),
              testing::AllOf(HasSubstr("measured"), HasSubstr("N m")));
}

TEST_F(WorkbenchPage, PrintsOnA4) {
  const std::string pdf = browser_->pdf();
  ASSERT_THAT(pdf, testing::StartsWith("%PDF"));
  // A4 is 595 x 842 points.
  const std::size_t at = pdf.find("/MediaBox [0 0 ");
  ASSERT_NE(at, std::string::npos);
  std::istringstream size(pdf.substr(at + 15, 40));
  double width = 0.0, height = 0.0;
  size >> width >> height;
  EXPECT_NEAR(width, 595.0, 1.5);
  EXPECT_NEAR(height, 842.0, 1.5);
}

TEST_F(WorkbenchPage, OnPaperTheMarkOfANumberStandsOnItsInterval) {
  browser_->show_on("print");
  const nlohmann::json apart = js(R"js([...document.querySelectorAll('.forest svg.bar')].flatMap((bar) => {
    const [mark, line] = [bar.querySelector('svg svg > *'), bar.querySelector('line[stroke-width]')];
    const middle = (e) => (e.getBoundingClientRect().top + e.getBoundingClientRect().bottom) / 2;
    return mark && line ? [Math.abs(middle(mark) - middle(line))] : [];
  }))js");
  browser_->show_on("");
  ASSERT_GT(apart.size(), 4U);
  for (const double pixels : apart) EXPECT_LT(pixels, 1.0);
}

TEST_F(WorkbenchPage, WithoutScriptTheStaticFiguresStay) {
  browser_->set_scripts(false);
  const std::string page = "file://" + std::string(*folder_ / "result/report.html");
  const auto shown = [](const std::string& what) {
    return js(
        fmt::format("(() => {{ const e = document.querySelector('{}'); return e !== null && "
                    "e.getBoundingClientRect().height > 50; }})()",
                    what));
  };
  js("location.href = '" + page + "?'");
  browser_->wait_for("document.readyState === 'complete' && location.href.endsWith('?')");
  EXPECT_EQ(shown("figure[id^=forces_torque] > svg"), true);
  EXPECT_EQ(shown("figure[id^=curves_BIC] > svg"), true);
  EXPECT_EQ(shown("#forest table"), true);
  EXPECT_EQ(shown("#workbench"), false);
  browser_->set_scripts(true);
  open();
  EXPECT_EQ(shown("figure[id^=forces_torque] > svg"), false);
  EXPECT_EQ(shown("#workbench"), true);
}

TEST_F(WorkbenchPage, IsSmallAndOneFile) {
  const std::string text = myoid::test::read_text(*folder_ / "result/report.html");
  EXPECT_LT(text.size(), 5'000'000U);
  EXPECT_EQ(text.find("src=\""), std::string::npos);
  EXPECT_EQ(text.find("url(http"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(*folder_ / "result/motion.html"));
}

}  // namespace
